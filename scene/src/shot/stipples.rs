//! Points and dots with nothing left to decide ([STIP-1] … [STIP-21]).

use super::{Clipping, GradientEstimator, GradientRange, LightDirection, Outside, ShotError, iso_value, near};
use crate::clip::ClipPlanes;
use crate::marks::Page;
use crate::space::Grid;
use crate::tables::{Scene, StippleGradient, Stipples};
use crate::view::View;

pub use crate::tables::{
    Boundary, Curves, CurvesTest, Distance, DotDensity, Even, FactorRange, Ink, Interior, Length, Lighting,
    PointsPerPixel, Resolution, Silhouette, Snap, StippleOrder, Threshold,
};

/// Points on the boundaries of a volume, and the dots that a frame draws of them.
#[derive(Clone, Debug, PartialEq)]
pub struct StippleParams {
    /// The reference camera, the scene's first ([STIP-3]).
    pub view: View,
    /// The near distance of a perspective camera, in world units.
    pub near: f64,
    /// S_max in mm.
    pub size: f64,
    /// The unit of A_vol: the side of a square in pixels, 1 or, for a picture in mm, S_max ([STIP-3]).
    pub square: f64,
    /// Area of a dot of S_max, in pixels.
    pub dot_area: f64,
    /// Values for V = 0 and 1; none: the range of the volume ([VAL-1]).
    pub range: Option<[f64; 2]>,
    /// The range of ‖g‖ for ‖∇V‖ from 0 to 1 ([VAL-2]).
    pub gradient_range: GradientRange,
    /// Which values lie outside ([NORM-1]).
    pub outside: Outside,
    /// ‖∇V‖ above which a voxel gets points ([STIP-4]).
    pub threshold: Threshold,
    /// Points of a voxel for each square of its projection ([STIP-3], [STIP-17]).
    pub k_max: PointsPerPixel,
    /// Key of the random numbers ([RAY-4]).
    pub seed: u64,
    /// Voxels along the side of a box; none: as many as 4.2 asks for ([STIP-2]).
    pub box_side: Option<u64>,
    /// Estimator of V and ∇V ([STIP-1]).
    pub gradient: GradientEstimator,
    /// The largest distance of points from the tangent plane through their voxel. A length in voxels is in those of the
    /// boxes ([STIP-2]).
    pub slab: Length,
    /// Which points are seen when those of a voxel are put in order ([STIP-4]).
    pub order: StippleOrder,
    /// Whether points leave their voxel for the edge ([STIP-4]).
    pub snap: Snap,
    /// Whether only the largest ‖∇V‖ along a normal gets points ([STIP-4]).
    pub thin: bool,
    /// The value of the one surface that gets points; none: all boundaries do ([STIP-20]).
    pub iso: Option<f64>,
    /// The value of the surface that hides points; none: points are transparent ([STIP-15]).
    pub hide_behind: Option<f64>,
    /// How factors are brought into [0, 1] ([STIP-5]).
    pub factors: FactorRange,
    /// T_b of eq. 5; none: 1.
    pub boundary: Option<Boundary>,
    /// T_s of eq. 6; none: 1.
    pub silhouette: Option<Silhouette>,
    /// T_r of eq. 7; none: 1.
    pub resolution: Option<Resolution>,
    /// T_d of eq. 8; none: 1.
    pub distance: Option<Distance>,
    /// T_t of eq. 9; none: 1.
    pub interior: Option<Interior>,
    /// T_l of eq. 10; none: 1.
    pub lighting: Option<Lighting>,
    /// Towards the light of T_l.
    pub light: LightDirection,
    /// Treatment of a fraction of a point ([STIP-5]).
    pub ink: Ink,
    /// The area on which the density of dots is counted ([STIP-21]).
    pub density: DotDensity,
    /// Which points are drawn where there is a choice ([STIP-19]).
    pub even: Even,
    /// Silhouette curves ([STIP-13]).
    pub curves: Option<Curves>,
    /// Planes that cut points away ([RAY-8]).
    pub clip: ClipPlanes,
}

impl StippleParams {
    /// Decides what the dots of a scene leave open, for the grid of its volume and the scene's first camera.
    ///
    /// # Errors
    /// A length in the wrong space, or an iso-value that was not found in the data yet.
    pub fn new(scene: &Scene, stipples: &Stipples, grid: &Grid, view: View) -> Result<Self, ShotError> {
        let page = Page::of(scene);
        let size = page.length(stipples.size).ok_or(ShotError::NotOnPage { key: "stipples.size" })?;
        let in_mm = scene.picture.extent().is_some_and(|e| e.iter().any(|l| matches!(l, Length::Millimetres(_))));
        let diameter = size * page.pixels_per_mm();
        let iso = |iso: Option<_>, key| iso.map(|iso| iso_value(iso, key)).transpose();
        // A nib has no opacity: fading dots would be drawn whole, with too much ink in all ([STIP-5]).
        let ink = if scene.page.as_ref().is_some_and(|page| page.plotter) { Ink::Opaque } else { stipples.ink };
        Ok(Self {
            view,
            near: near(scene, grid)?,
            size,
            square: if in_mm { diameter } else { 1.0 },
            dot_area: 0.25 * std::f64::consts::PI * (diameter * diameter),
            range: scene.volume.range,
            gradient_range: scene.volume.gradient_range,
            outside: scene.volume.outside,
            threshold: stipples.threshold,
            k_max: stipples.k_max,
            seed: stipples.seed,
            box_side: stipples.box_side,
            gradient: match stipples.gradient {
                StippleGradient::Regression => GradientEstimator::Regression,
                StippleGradient::Central => GradientEstimator::Central,
            },
            slab: stipples.slab,
            order: stipples.order,
            snap: stipples.snap,
            thin: stipples.thin,
            iso: iso(stipples.iso, "stipples.iso")?,
            hide_behind: iso(stipples.hide_behind, "stipples.hide_behind")?,
            factors: stipples.factors,
            boundary: stipples.boundary,
            silhouette: stipples.silhouette,
            resolution: stipples.resolution,
            distance: stipples.distance,
            interior: stipples.interior,
            lighting: stipples.lighting,
            light: stipples.lighting.and_then(|t| t.light).unwrap_or(scene.light),
            ink,
            density: stipples.density,
            even: stipples.even,
            curves: stipples.curves,
            clip: Clipping::new(scene, grid).planes,
        })
    }

    /// Whether a face has one layer of voxels with points. A surface of `iso` always has one.
    pub fn is_thin(&self) -> bool {
        self.thin || self.iso.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::{Overrides, parse};
    use std::path::Path;

    fn params(text: &str) -> Result<StippleParams, ShotError> {
        let text = format!("drypoint = 1\nlight = [0, 1, 0]\n[volume]\nfile = \"a.nrrd\"\n{text}");
        let scene = parse(&text, Path::new("s"), &Overrides::default()).unwrap_or_else(|f| panic!("{f}"));
        let grid = Grid::with_spacing([9, 9, 9], [0.5, 1.0, 1.0]).unwrap();
        let view = View::new(&scene.camera, &grid, scene.picture.size).unwrap();
        StippleParams::new(&scene, scene.stipples.as_ref().unwrap(), &grid, view)
    }

    /// At 254 dpi a millimetre has ten pixels: dots of 0.5 mm are five across. A_vol is in squares of that side where the
    /// picture is in mm, else in pixels.
    #[test]
    fn dots_are_measured_on_the_page() {
        let dots = "[stipples]\nsize = \"0.5 mm\"\n";
        for (picture, square) in [("width = \"100 mm\"\nheight = \"80 mm\"", 5.0), ("size = [200, 100]", 1.0)] {
            let params = params(&format!("[picture]\ndpi = 254\n{picture}\n{dots}")).unwrap();
            let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * b, "{a} {b}");
            near(params.size, 0.5);
            near(params.square, square);
            near(params.dot_area, 6.25 * std::f64::consts::PI);
            // `near` is a step of half a voxel.
            near(params.near, 0.25);
        }
    }

    #[test]
    fn a_plotter_draws_whole_dots() {
        let ink = |page| params(&format!("[stipples]\n{page}")).unwrap().ink;
        assert_eq!([ink(""), ink("[page]\nplotter = true\n[[pen]]\nname = \"a\"\n")], [Ink::Fade, Ink::Opaque]);
    }

    /// The light of T_l is its own, or that of the scene.
    #[test]
    fn a_factor_may_have_a_light_of_its_own() {
        let light = |more| params(&format!("[stipples]\n[stipples.lighting]\n{more}")).unwrap().light;
        assert_ne!(light(""), light("light = \"head\""));
        assert_eq!(light("light = \"head\""), LightDirection::Head);
    }

    #[test]
    fn a_value_that_was_not_found_is_told_with_its_key() {
        for key in ["iso", "hide_behind"] {
            let Err(ShotError::NoIso { key: told }) = params(&format!("[stipples]\n{key} = \"auto\"\n")) else {
                panic!("{key} is decided");
            };
            assert_eq!(told, format!("stipples.{key}"));
        }
    }
}
