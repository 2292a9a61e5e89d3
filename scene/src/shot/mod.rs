//! One picture with nothing left to decide: what a renderer has to know of a scene.
//!
//! A [`Shot`] is plain data. Lengths are in world units, every `auto` is decided, and what a scene leaves out has its neutral
//! value. A renderer reads the shot and the data that it names (voxels, labels, styles, pixels behind), and nothing else of a
//! scene. Quantities that only voxels can tell, such as a quantile of ‖g‖, are named here and measured by the renderer.

mod clipping;
mod combination;
mod facts;
pub mod halo;
mod lattice;
mod material;
mod mesh;
mod opaque_surface;
mod out_of_sight;
mod query;
mod reconstruction;
pub mod stipples;

pub use crate::picture::LayerKind;
pub use crate::tables::contours::Measured;
pub use crate::tables::{
    Axis, Background, BlendSpace, Cut, Dab, Fuzzy, GradientEstimator, GradientRange, HaloAccumulation, HaloKind,
    HaloSource, HessianEstimator, IntersectionOpacity, Kappa, Kernel, LabelLookup, LightDirection, Mix, Number,
    Outside, ProfileNode, Role, SeedDirection, SeedValue, SphereFrame, StepAlong, Tone, Transparency,
};
pub use clipping::{Cap, Clipping};
pub use combination::{
    Combination, Cutaway, Intersection, IntersectionPaint, MOST_STEPS, Membership, Part, PartFacts, SelectionFacts,
    SelectionParams, placed,
};
pub use halo::{HaloParams, HaloSeed, HaloSpread, Halos, PartSeeds, SeedFocus, SeedSide};
pub use lattice::{Lattice, MOST_PLANES};
pub use material::{
    ContourParams, Illumination, LevelOfDetail, Lighting, LightingParams, LightingSource, Material, PhongParams,
    StyleParams, ToonParams,
};
pub use mesh::MeshParams;
pub use opaque_surface::OpaqueSurface;
pub use out_of_sight::OutOfSight;
pub use query::{KappaSource, SampleQuery};
pub use reconstruction::{NotSmooth, Reconstruction, Rung};
pub use stipples::StippleParams;

use crate::plan::{Pass, Plan, Quantity};
use crate::space::Grid;
use crate::tables::{Iso, Length, NormalSide, Scene, SignFlip};
use crate::transfer::Function;
use crate::view::View;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// One picture of one camera.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shot {
    /// The camera ([SPACE-3], [RAY-5]).
    pub view: View,
    /// The planes of samples ([RAY-1]).
    pub lattice: Lattice,
    /// n of the n×n rays of a pixel ([RAY-6]), before it is refined.
    pub rays_across: usize,
    /// Contrast to a neighbour above which a pixel of one ray gets five or nine ([RAY-7]); none: no pixel is refined.
    pub refine_above: Option<f64>,
    /// The number type of samples.
    pub number: Number,
    /// The volumes that are drawn. The first is that of `[volume]`, the background. The parts of
    /// [`combination`](Self::combination) follow, in the order of that list.
    pub objects: Vec<Object>,
    /// The combination of the objects ([VS-2]); none for the volume alone.
    pub combination: Option<Combination>,
    /// The opaque iso-surface; none: none ([HATCH-14]).
    pub surface: Option<OpaqueSurface>,
    /// Opaque meshes ([VS-12]).
    pub meshes: Vec<MeshParams>,
    /// Clip planes ([RAY-8]).
    pub clipping: Clipping,
    /// Volumetric halos ([HALO-1]).
    pub halos: Halos,
    /// Which numbers are composited ([VAL-3]).
    pub blend_space: BlendSpace,
    /// The background ([IO-6]); of a picture the file.
    pub background: Background,
    /// The opacity A at which a ray ends ([RAY-2]).
    pub stop_at: f64,
    /// Layers of the picture, at least one ([IO-6]).
    pub layers: Vec<LayerKind>,
}

/// A volume with its transfer function and its look.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Object {
    /// How the field is reconstructed from voxels.
    pub reconstruction: Reconstruction,
    /// The highest derivative that is asked of the field anywhere.
    pub rung: Rung,
    /// Whether bricks that can show nothing are skipped ([RAY-2]).
    pub skip_empty: bool,
    /// The transfer function over values of the volume ([STF-3], [STF-4]).
    pub function: Arc<Function>,
    /// Which label lies between voxels ([STF-13]).
    pub label_lookup: LabelLookup,
    /// Δ₀: the length that opacities are given for, in world units ([VAL-4]).
    pub reference_length: f64,
    /// The range of ‖g‖ that |g| from 0 to 1 stands for ([VAL-2]); none where nothing reads |g|.
    pub gradient_range: Option<GradientRange>,
    /// The direction of shading normals ([NORM-1]).
    pub normal: NormalDirection,
    /// The angle that κ along the ray is made of ([STF-5]).
    pub turn: Turn,
    /// The query of every visible sample.
    pub query: SampleQuery,
    /// The query of the first visible sample of a ray beyond that, for layers `first.*`; none: nothing.
    pub first: Option<SampleQuery>,
    /// The query of a sample beyond that where it shades a look that it meets ([VS-4]); none: nothing.
    pub meeting: Option<SampleQuery>,
    /// How samples are coloured.
    pub material: Material,
}

/// The direction of shading normals ([NORM-1]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NormalDirection {
    /// Outwards.
    Outward,
    /// Outwards, flipped to N·v ≥ 0.
    Facing,
    /// Inwards.
    Inward,
}

/// The angle between two normals that κ along the ray is made of ([STF-5]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Turn {
    /// Between the normals, in [0, π].
    OfNormals,
    /// Between the lines that they span, in [0, π/2]: a normal that was flipped towards the eye has not turned.
    OfLines,
}

/// Facts of a volume that a shot depends on.
#[derive(Clone, Copy, Debug)]
pub struct VolumeFacts<'a> {
    /// The voxels' places.
    pub grid: &'a Grid,
    /// Whether the file holds integers ([REC-3]).
    pub is_integer: bool,
}

/// A scene that makes no shot.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ShotError {
    /// A length of the scene has no size in the world.
    #[error("{key} is a length on the page, not in the volume")]
    Length {
        /// The scene key.
        key: &'static str,
    },
    /// The kernel has no second derivatives.
    #[error(transparent)]
    NotSmooth(#[from] NotSmooth),
    /// A length of the scene has no size on the page.
    #[error("{key} is a length in the volume, not on the page")]
    NotOnPage {
        /// The scene key.
        key: &'static str,
    },
    /// An iso-value is still left to the volume.
    #[error("{key} is \"auto\", and no value was found")]
    NoIso {
        /// The scene key.
        key: &'static str,
    },
    /// The picture of a lighting table was not read.
    #[error("shading.table names a picture that was not read")]
    NoLightingTable,
    /// The focus of a halo is still in pixels.
    #[error("the focus of halo {halo} is given in pixels, and was not picked")]
    FocusInPixels {
        /// The halo's place in the list.
        halo: usize,
    },
    /// A motion moves an object out of the range of numbers.
    #[error("the motion of an object leaves the range of numbers")]
    Motion,
    /// An object of so many steps across that its rays have no end.
    #[error("object {object} is about {steps:.1e} steps across, and at most {MOST_STEPS:.0e} are drawn")]
    ObjectTooLarge {
        /// The object's place in the list.
        object: usize,
        /// Steps along the longest diagonal of its box.
        steps: f64,
    },
    /// A label of a halo is still a name.
    #[error("label {label} of halo {halo} is a name, and its id was not looked up")]
    LabelName {
        /// The halo's place in the list.
        halo: usize,
        /// The label's place in `seed.labels`.
        label: usize,
    },
}

impl Shot {
    /// Decides what a scene leaves open: for a volume, a transfer function over its values, and a camera, which need not be the
    /// scene's own.
    ///
    /// # Errors
    /// A length on the page, a Hessian that the kernel does not have, an iso-value that was not found in the data yet, a
    /// focus that was not picked, the name of a label whose id was not looked up, a lighting table that was not read.
    pub fn resolve(
        scene: &Scene,
        plan: &Plan,
        facts: VolumeFacts<'_>,
        function: Arc<Function>,
        view: View,
    ) -> Result<Self, ShotError> {
        let sampling = &scene.sampling;
        let step = in_world(sampling.step, "sampling.step", facts.grid)?;
        let object = Object::resolve(scene, plan, facts, function, &view)?;
        let surface = OpaqueSurface::new(scene, plan, &view)?;
        let halos = Halos::new(scene, plan, facts.grid, &object.function)?;
        let layers = &scene.picture.layers;
        Ok(Self {
            lattice: Lattice { step, along: sampling.step_along, near: near(scene, facts.grid)? },
            rays_across: scene.picture.samples.across(plan.has_equal_rays()),
            refine_above: plan.has_pass(Pass::Refinement).then_some(scene.picture.contrast),
            number: sampling.number,
            clipping: Clipping::new(scene, facts.grid),
            halos,
            objects: vec![object],
            combination: None,
            surface,
            meshes: MeshParams::all(scene, &view),
            blend_space: scene.picture.blend_space,
            background: scene.picture.background.clone(),
            stop_at: stop_at(sampling.stop_below, scene.picture.blend_space),
            layers: if layers.is_empty() { vec![LayerKind::Beauty] } else { layers.clone() },
            view,
        })
    }

    /// The object of `[volume]`.
    ///
    /// # Panics
    /// If there is no object: a shot that was resolved has one.
    pub fn background(&self) -> &Object {
        &self.objects[0]
    }

    /// The selections and ghosts, each with its object.
    pub fn parts(&self) -> impl Iterator<Item = (&Part, &Object)> {
        let parts = self.combination.iter().flat_map(|combination| &combination.parts);
        parts.zip(self.objects.iter().skip(1))
    }

    /// Returns the shot of another view with the same lens and picture. Only the lights depend on it; nothing is planned.
    #[must_use]
    pub fn seen_from(&self, view: View) -> Self {
        let mut shot = self.clone();
        shot.objects.iter_mut().for_each(|object| object.material.turn(&view));
        let lit = shot.surface.iter_mut().map(|surface| &mut surface.lit);
        lit.chain(shot.meshes.iter_mut().map(|mesh| &mut mesh.lit)).for_each(|lit| lit.turn(&view));
        shot.view = view;
        shot
    }

    /// The shot as JSON, for a person who writes another renderer. `serde_json::from_str` reads it as the same shot, to the
    /// bit, and does not check what fields promise of each other.
    ///
    /// # Errors
    /// A volume of the transfer function whose path is no text.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self)
    }
}

impl Object {
    /// Decides what a scene leaves open of a volume, of which lengths are measured by the grid of `facts`.
    fn resolve(
        scene: &Scene,
        plan: &Plan,
        facts: VolumeFacts<'_>,
        function: Arc<Function>,
        view: &View,
    ) -> Result<Self, ShotError> {
        let sampling = &scene.sampling;
        let hessian = sampling.hessian.resolved(sampling.kernel, facts.is_integer)?;
        let reconstruction = Reconstruction { hessian, ..Reconstruction::of(scene, facts.grid)? };
        let (query, first) = query::of_samples(scene, plan, &function);
        Ok(Self {
            reconstruction,
            rung: Rung::of(plan),
            skip_empty: plan.has_pass(Pass::Bricks),
            label_lookup: scene.volume.label_lookup,
            reference_length: in_world(sampling.reference_length, "sampling.reference_length", facts.grid)?,
            gradient_range: plan
                .needs_anywhere(Quantity::GradientMagnitudeRange)
                .then_some(scene.volume.gradient_range),
            normal: NormalDirection::new(sampling.normal, scene.volume.outside),
            turn: Turn::new(sampling.normal, scene.contours.as_ref().map_or(SignFlip::TwoSided, |c| c.sign_flip)),
            meeting: query::of_meetings(scene, plan, query),
            query,
            first,
            material: Material::new(scene, &function, facts.grid, view)?,
            function,
        })
    }
}

impl NormalDirection {
    /// The direction for a scene's setting. The gradient is the outward normal itself where values rise outwards.
    fn new(normal: NormalSide, outside: Outside) -> Self {
        match (normal, outside) {
            (NormalSide::Outward, _) | (NormalSide::Gradient, Outside::High) => Self::Outward,
            (NormalSide::Facing, _) => Self::Facing,
            (NormalSide::Gradient, Outside::Low) => Self::Inward,
        }
    }
}

impl Turn {
    /// The paper's plain angle, except where normals are flipped towards the eye and the scene does not ask for the literal
    /// reading.
    fn new(normal: NormalSide, flip: SignFlip) -> Self {
        match (normal, flip) {
            (NormalSide::Facing, SignFlip::TwoSided) => Self::OfLines,
            _ => Self::OfNormals,
        }
    }
}

/// Returns the near distance of a perspective camera, in world units: a step where the scene gives none ([RAY-1]).
///
/// # Errors
/// A length on the page.
pub fn near(scene: &Scene, grid: &Grid) -> Result<f64, ShotError> {
    match scene.camera.near {
        Some(near) => in_world(near, "camera.near", grid),
        None => in_world(scene.sampling.step, "sampling.step", grid),
    }
}

/// Returns the length of `key` in world units.
///
/// # Errors
/// A length on the page.
pub fn in_world(length: Length, key: &'static str, grid: &Grid) -> Result<f64, ShotError> {
    length.world(grid).ok_or(ShotError::Length { key })
}

/// Returns the iso-value of `key`.
///
/// # Errors
/// A value that was not found in the data yet.
pub fn iso_value(iso: Iso, key: &'static str) -> Result<f64, ShotError> {
    match iso {
        Iso::Value(value) => Ok(value),
        Iso::Auto => Err(ShotError::NoIso { key }),
    }
}

/// The A at which a ray ends, so that what is left out is at most ε·c_max in linear light ([RAY-2]).
///
/// The part that is left out of an encoded sum is at most the encoded c_max times its weight, and is decoded with the sum.
/// The curve f of sRGB has c·f′(c) ≤ 2.4 f(c), also above 1, where shading can lead.
///
/// With ε = 0 a ray ends where A is 1 exactly: every later weight (1 − A)·α is 0, so no bit changes, only the count of samples.
fn stop_at(epsilon: f64, blend_space: BlendSpace) -> f64 {
    match blend_space {
        BlendSpace::Linear => 1.0 - epsilon,
        BlendSpace::Srgb => 1.0 - epsilon / 2.4,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::{Overrides, parse};
    use crate::lighting::LightingTable;
    use crate::tables::Camera;
    use crate::volume::{Volume, Voxels};
    use glam::DVec3;
    use std::path::Path;

    /// Every light, in every model of shading, turns with the view as if the scene were resolved for it.
    #[test]
    fn a_shot_of_another_view_is_that_of_the_scene() {
        let lights = ["\"head\"", "[1, 2, 3]", "{ world = [1, 2, 3] }"];
        let models = [
            "",
            "[shading]\nmodel = \"toon\"\n",
            "[shading]\nmodel = \"lighting-function\"\npreset = \"cartoon-contours\"\n",
            "[shading]\nmodel = \"lighting-function\"\npreset = \"blinn-phong-contours\"\n",
            "[shading]\nmodel = \"lighting-function\"\npreset = \"blinn-phong-contours\"\ncontour = \"printed\"\n",
        ];
        let surfaces = ["phong", "toon"].map(|look| format!("[surface]\niso = 5\nlook = \"{look}\"\n"));
        let mesh = "[[mesh]]\nfile = \"a.ply\"\n";
        let object = "[[object]]\nname = \"part\"\nvalue = [[1, 0], [2, 1]]\nmove = [1, 0, 0]\n\
                      [object.ghost.shading]\nmodel = \"toon\"\n";
        let transfer = "[transfer]\nkind = \"regular\"\nnodes = [{ at = 1, color = \"red\", opacity = 1 }]\n";
        let grid = Grid::with_spacing([9, 9, 9], [0.5, 1.0, 1.0]).unwrap();
        let volume = Volume::new(grid.clone(), Voxels::U8(vec![0; 729]), 1.0, 0.0).unwrap();
        let range = [0.0, 9.0];
        let mut turned = 0;
        let cases = lights.into_iter().flat_map(|light| models.map(|model| (light, model)));
        for (i, (light, model)) in cases.enumerate() {
            let head = format!("drypoint = 1\nlight = {light}\n[volume]\nfile = \"a.nrrd\"\n");
            let text = format!("{head}{transfer}{model}{}{mesh}{object}", surfaces[i % 2]);
            let scene = parse(&text, Path::new("s"), &Overrides::default()).unwrap_or_else(|f| panic!("{f}"));
            let function = Function::new(scene.transfer.as_ref().unwrap(), range, &volume, &|_| None).unwrap();
            let (function, plan) = (Arc::new(function.unwrap()), Plan::new(&scene));
            let of_parts: Vec<Scene> = scene.parts().map(|(object, role)| scene.of_part(object, role)).collect();
            let plans: Vec<Plan> = of_parts.iter().map(Plan::new).collect();
            let views = [DVec3::NEG_Z, DVec3::new(1.0, 1.0, -0.5)].map(|direction| {
                let camera = Camera { direction, direction_given: true, ..Camera::default() };
                View::new(&camera, &grid, [20, 10]).unwrap()
            });
            let [first, second] = views.map(|view| {
                let (grid, is_integer) = (&grid, true);
                let facts = VolumeFacts { grid, is_integer };
                let shot = Shot::resolve(&scene, &plan, facts, function.clone(), view).unwrap();
                let of_parts = of_parts.iter().zip(&plans).map(|(scene, plan)| {
                    let function = function.clone();
                    PartFacts { scene, plan, function, grid, is_integer, range }
                });
                let of_parts: Vec<PartFacts<'_>> = of_parts.collect();
                let selection = SelectionFacts { grid: grid.clone(), index_box: Some(grid.index_box()) };
                shot.with_objects(&scene, facts, range, &[selection], &of_parts).unwrap()
            });
            assert_eq!(first.objects.len(), 3);
            assert_eq!(first.seen_from(second.view.clone()), second, "{text}");
            turned += usize::from(first.objects[0].material != second.objects[0].material);
        }
        // With a light of the world only the exact rule of contours reads the view; without shading nothing does.
        assert_eq!(turned, 2 * 4 + 2);
    }

    /// The table of a preset follows from its numbers; that of a picture is written with its cells.
    #[test]
    fn tables_and_layers_read_back() {
        let table = LightingTable::new(1, 2, vec![[0.1, 1.0 / 3.0, 5e-324, 1.0], [f64::MAX, 0.7, 1e-7, 0.0]]);
        let source = LightingSource::File { path: "a.png".into(), table: Arc::new(table.unwrap()) };
        let text = serde_json::to_string(&source).unwrap();
        assert_eq!(serde_json::from_str::<LightingSource>(&text).unwrap(), source);
        let layers = LayerKind::ALL.into_iter().chain([LayerKind::Halo(3), LayerKind::Part(0)]);
        let layers: Vec<LayerKind> = layers.collect();
        let text = serde_json::to_string(&layers).unwrap();
        assert_eq!(serde_json::from_str::<Vec<LayerKind>>(&text).unwrap(), layers);
        let fault = serde_json::from_str::<LayerKind>("\"halo03\"").unwrap_err().to_string();
        assert_eq!(fault, "there is no layer \"halo03\"");
    }

    #[test]
    fn only_facing_normals_are_lines() {
        for normal in [NormalSide::Outward, NormalSide::Gradient] {
            assert_eq!(Turn::new(normal, SignFlip::TwoSided), Turn::OfNormals);
        }
        assert_eq!(Turn::new(NormalSide::Facing, SignFlip::TwoSided), Turn::OfLines);
        assert_eq!(Turn::new(NormalSide::Facing, SignFlip::Literal), Turn::OfNormals);
    }

    #[test]
    fn the_gradient_points_inwards_where_values_rise_inwards() {
        let direction = |outside| NormalDirection::new(NormalSide::Gradient, outside);
        assert_eq!([Outside::Low, Outside::High].map(direction), [NormalDirection::Inward, NormalDirection::Outward]);
    }

    #[test]
    fn encoded_sums_end_later() {
        assert_eq!(stop_at(0.25, BlendSpace::Linear), 0.75);
        assert_eq!(stop_at(0.24, BlendSpace::Srgb), 1.0 - 0.24 / 2.4);
    }
}
