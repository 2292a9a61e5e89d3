//! Reasons why no ray of a picture meets the volume.

use super::{Lattice, clipping};
use crate::clip::{ClipPlane, ClipPlanes};
use crate::space::Grid;
use crate::tables::{Scene, StepAlong};
use crate::view::View;
use glam::DVec3;
use std::ops::Range;

/// The reason why no ray of a picture meets the volume.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OutOfSight {
    /// The camera looks past its box.
    Camera,
    /// All of it is nearer than `camera.near`.
    Near,
    /// Clips cut all of it away: the first that does so alone, or else all of them, by their places.
    Clips(Vec<usize>),
}

impl OutOfSight {
    /// Returns the reason why no ray of a view meets the box of the volume; none if one does. Rays are looked at on a
    /// raster of at most 128 × 128 over the part of the picture that shows the box.
    pub fn of(scene: &Scene, grid: &Grid, view: &View, lattice: Lattice) -> Option<Self> {
        const ACROSS: usize = 128;
        let shown = pixels_of_box(view, grid);
        let along = |axis: usize| {
            let pixels: Range<usize> = shown[axis].clone();
            let every = pixels.len().div_ceil(ACROSS).max(1);
            pixels.step_by(every).map(|i| i as f64 + 0.5)
        };
        // The box as planes, then those of each clip.
        let ends = grid.index_box();
        let sides = DVec3::AXES.into_iter().flat_map(|axis| [(ends[0], -axis), (ends[1], axis)]);
        let sides: Vec<ClipPlane> = sides.map(|(end, normal)| ClipPlane::in_index(end, normal, grid)).collect();
        let clips: Vec<Vec<ClipPlane>> = scene.clips.iter().map(|clip| clipping::planes(clip, grid)).collect();
        // Whether some ray is beyond `near` inside the box and before the planes.
        let is_met = |near: f64, clips: &[Vec<ClipPlane>]| {
            let planes = ClipPlanes(sides.iter().chain(clips.iter().flatten()).cloned().collect());
            along(1).flat_map(|j| along(0).map(move |i| (i, j))).any(|(i, j)| {
                let ray = view.ray(i, j);
                let first = match (view.perspective, lattice.along) {
                    (false, _) => f64::NEG_INFINITY,
                    (true, StepAlong::Plane) => near,
                    (true, StepAlong::Ray) => near * ray.cos_phi,
                };
                let line = [grid.to_index(ray.origin), grid.inverse_axes() * ray.along];
                planes.kept(line, [first, f64::INFINITY]).is_some()
            })
        };
        let near = lattice.near;
        if !is_met(0.0, &[]) {
            Some(Self::Camera)
        } else if !is_met(near, &[]) {
            Some(Self::Near)
        } else if let Some(alone) = (0..clips.len()).find(|&i| !is_met(near, &clips[i..=i])) {
            Some(Self::Clips(vec![alone]))
        } else {
            let all = || Self::Clips((0..clips.len()).collect());
            (!is_met(near, &clips)).then(all)
        }
    }
}

/// The columns and the rows of pixels that show the box of a volume; all of them if a corner is beside the eye or behind
/// it.
fn pixels_of_box(view: &View, grid: &Grid) -> [Range<usize>; 2] {
    let corners: Option<Vec<[f64; 2]>> = grid.world_corners().into_iter().map(|corner| view.point_of(corner)).collect();
    let Some(corners) = corners else { return view.size.map(|n| 0..n) };
    [0, 1].map(|axis| {
        let along = corners.iter().map(|corner| corner[axis]);
        let (lo, hi) = (along.clone().fold(f64::INFINITY, f64::min), along.fold(f64::NEG_INFINITY, f64::max));
        // Beyond the picture `as` gives 0 or the largest number.
        (lo.floor() as usize).min(view.size[axis])..(hi.floor() as usize).saturating_add(1).min(view.size[axis])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::{Overrides, parse};
    use std::path::Path;

    #[test]
    fn what_hides_the_whole_volume_is_named() {
        let grid = Grid::with_spacing([11, 11, 11], [2.0, 1.0, 1.0]).unwrap();
        let plane = |x: f64, normal: f64| format!("[[clip]]\npoint = [{x}, 0, 0]\nnormal = [{normal}, 0, 0]\n");
        let none = "[[clip]]\nspace = \"index\"\nbox = [[20, 30], [0, 9], [0, 9]]\n";
        let parallel = "[camera]\nprojection = \"orthographic\"\n";
        let ray = "[sampling]\nstep_along = \"ray\"\n[camera]\nnear = ";
        for (rest, expected) in [
            (String::new(), None),
            ("[camera]\ntarget = [1e6, 0, 0]\n".into(), Some(OutOfSight::Camera)),
            ("[camera]\nnear = 1e5\n".into(), Some(OutOfSight::Near)),
            (format!("{ray}1e5\n"), Some(OutOfSight::Near)),
            (format!("{ray}1\n"), None),
            // Parallel rays begin before every volume.
            (format!("{parallel}near = 1e5\n"), None),
            (plane(5.0, 1.0), None),
            (plane(-0.1, 1.0), Some(OutOfSight::Clips(vec![0]))),
            (plane(5.0, 1.0) + none, Some(OutOfSight::Clips(vec![1]))),
            (format!("{parallel}{none}"), Some(OutOfSight::Clips(vec![0]))),
            (plane(5.0, 1.0) + &plane(15.0, -1.0), Some(OutOfSight::Clips(vec![0, 1]))),
            (plane(15.0, 1.0) + &plane(5.0, -1.0), None),
            // A volume of 3 × 2 pixels, between rays on a raster over the whole picture.
            (format!("{parallel}height = 1500\ndirection = [0, 1, 0]\nup = [0, 0, 1]\n"), None),
        ] {
            let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n{rest}");
            let scene = parse(&text, Path::new("scene.toml"), &Overrides::default()).unwrap();
            let view = View::new(&scene.camera, &grid, [300, 200]).unwrap();
            let near = scene.camera.near.and_then(|near| near.world(&grid)).unwrap_or(0.5);
            let lattice = Lattice { step: 0.5, along: scene.sampling.step_along, near };
            assert_eq!(OutOfSight::of(&scene, &grid, &view, lattice), expected, "{rest}");
        }
    }
}
