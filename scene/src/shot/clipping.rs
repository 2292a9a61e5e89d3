//! Clip planes of a picture, with nothing left to decide ([RAY-8]).

use crate::clip::{ClipPlane, ClipPlanes};
use crate::space::Grid;
use crate::tables::{Clip, ClipSpace, PartName, Scene, SphereFrame};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Clip planes and what cuts show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Clipping {
    /// The planes that cut something of the volume's box away, in the order of the tables. A box has six: the lower and
    /// the upper one of each axis.
    pub planes: ClipPlanes,
    /// The caps that planes name by their places.
    pub caps: Vec<Cap>,
    /// The styles of caps, by name. A renderer gets them after those of the transfer function.
    pub styles: Vec<String>,
    /// How normals become places on the spheres of caps.
    pub frame: SphereFrame,
}

/// A cap: what cuts show in place of their own colour.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cap {
    /// A colour, unlit.
    Color {
        /// Linear, straight.
        rgb: [f64; 3],
        /// The factor of a cut's own opacity.
        opacity: f64,
    },
    /// The style at this place in the list of styles, lit by the plane's normal. Its opacity multiplies a cut's own.
    Style(usize),
}

impl Clipping {
    /// The planes of a scene's background that reach into the box of a grid. Every other plane is left out, and changes nothing.
    pub fn new(scene: &Scene, grid: &Grid) -> Self {
        let of_background = |clip: &&Clip| clip.applies.is_empty() || clip.applies.contains(&PartName::Background);
        Self::made_of(scene, scene.clips.iter().filter(of_background), grid, |plane| plane.cuts_box(grid))
    }

    /// The planes of tables of a scene, of those that `keeps` holds for.
    fn made_of<'c>(
        scene: &Scene,
        clips: impl Iterator<Item = &'c Clip>,
        grid: &Grid,
        keeps: impl Fn(&ClipPlane) -> bool,
    ) -> Self {
        let frame = scene.transfer.as_ref().map_or(SphereFrame::Eye, |transfer| transfer.sphere_frame);
        let mut clipping = Self { planes: ClipPlanes::default(), caps: Vec::new(), styles: Vec::new(), frame };
        for clip in clips {
            let mut planes = planes(clip, grid);
            planes.retain(&keeps);
            let cap = if planes.is_empty() { None } else { clipping.cap(clip) };
            planes.iter_mut().for_each(|plane| plane.cap = cap);
            clipping.planes.0.append(&mut planes);
        }
        clipping
    }

    /// The planes of a part's scene on the grid where its data are drawn. `main` is the grid of `[volume]`, whose index space
    /// a plane's coordinates may be in. All of them stay: how many styles caps name depends on the scene alone.
    pub(super) fn of_part(scene: &Scene, main: &Grid, placed: &Grid) -> Self {
        let mut clipping = Self::all(scene, main);
        clipping.planes.0.iter_mut().for_each(|plane| *plane = plane.on(placed));
        clipping
    }

    /// The styles that the caps of a part's scene name.
    pub fn styles_of_part(scene: &Scene, main: &Grid) -> Vec<String> {
        Self::all(scene, main).styles
    }

    /// All planes of a scene.
    fn all(scene: &Scene, grid: &Grid) -> Self {
        Self::made_of(scene, scene.clips.iter(), grid, |_| true)
    }

    /// Adds the cap of a table and returns its place; none if cuts show their own colour.
    fn cap(&mut self, clip: &Clip) -> Option<usize> {
        let cap = match (&clip.style, clip.cap) {
            (Some(name), _) => {
                let known = self.styles.iter().position(|style| style == name);
                Cap::Style(known.unwrap_or_else(|| {
                    self.styles.push(name.clone());
                    self.styles.len() - 1
                }))
            }
            (None, Some([r, g, b, opacity])) => Cap::Color { rgb: [r, g, b], opacity },
            (None, None) => return None,
        };
        self.caps.push(cap);
        Some(self.caps.len() - 1)
    }
}

/// The planes of a table: one, or the six of a box, whose normals point outwards.
pub(super) fn planes(clip: &Clip, grid: &Grid) -> Vec<ClipPlane> {
    let plane = |point, normal| match clip.space {
        ClipSpace::World => ClipPlane::in_world(point, normal, grid),
        ClipSpace::Index => ClipPlane::in_index(point, normal, grid),
    };
    if let Some(extent) = clip.extent {
        let sides = extent.into_iter().zip(DVec3::AXES).flat_map(|([lo, hi], axis)| [(lo, -axis), (hi, axis)]);
        return sides.map(|(at, normal)| plane(normal.abs() * at, normal)).collect();
    }
    clip.point.zip(clip.normal).map(|(point, normal)| plane(point, normal)).into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::{Overrides, parse};
    use glam::DMat3;
    use std::path::Path;

    fn clipping(rest: &str, grid: &Grid) -> Clipping {
        let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n{rest}");
        let scene = parse(&text, Path::new("scene.toml"), &Overrides::default());
        Clipping::new(&scene.unwrap_or_else(|faults| panic!("{faults}")), grid)
    }

    /// A box has the planes that reach into the volume, and each of them its own cap.
    #[test]
    fn a_box_has_up_to_six_planes() {
        let grid = Grid::with_spacing([11, 11, 11], [2.0, 1.0, 1.0]).unwrap();
        let both = "[[clip]]\nbox = [[4, 30], [-5, 20], [2, 8]]\ncap = \"#ff000080\"\n\
                    [[clip]]\npoint = [5, 5, 5]\nnormal = [0, 2, 0]\nspace = \"index\"\nstyle = \"wax\"\n\
                    [[clip]]\npoint = [0, 11, 0]\nnormal = [0, 1, 0]\nstyle = \"gone\"\n";
        let clipping = clipping(&both.replace("\"gone\"", "\"wax\""), &grid);
        let found: Vec<(DVec3, f64, Option<usize>)> =
            clipping.planes.0.iter().map(|plane| (plane.normal, plane.offset, plane.cap)).collect();
        let expected = [
            (DVec3::NEG_X, -4.0, Some(0)),
            (DVec3::NEG_Z, -2.0, Some(0)),
            (DVec3::Z, 8.0, Some(0)),
            (DVec3::Y, 5.0, Some(1)),
        ];
        assert_eq!(found, expected);
        let opacity = 128.0 / 255.0;
        assert_eq!(clipping.caps, [Cap::Color { rgb: [1.0, 0.0, 0.0], opacity }, Cap::Style(0)]);
        assert_eq!(clipping.styles, ["wax"]);
    }

    /// In index space a box follows the grid's axes: it keeps the same voxels in any grid.
    #[test]
    fn a_box_of_voxels_keeps_the_same_voxels_in_a_sheared_grid() {
        let axes = DMat3::from_cols(DVec3::new(1.0, 0.3, 0.0), DVec3::new(-0.4, 2.0, 0.1), DVec3::new(0.0, 0.7, 0.5));
        let sheared = Grid::new([9, 9, 9], axes, DVec3::splat(100.0)).unwrap();
        let clipping = clipping("[[clip]]\nspace = \"index\"\nbox = [[2, 5], [0, 8], [3, 3]]\n", &sheared);
        assert_eq!(clipping.planes.0.len(), 4);
        for i in 0..729 {
            let at = DVec3::new((i % 9) as f64, (i / 9 % 9) as f64, (i / 81) as f64);
            let is_in = (2.0..=5.0).contains(&at.x) && at.z == 3.0;
            assert_eq!(clipping.planes.cut(at), !is_in, "{at}");
        }
    }
}
