//! The planes on which the samples of rays lie ([RAY-1]).

use super::StepAlong;
use crate::space::Grid;
use crate::view::View;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The sample planes (or shells) of a camera: eye depths (k + ½)Δ, k a whole number.
///
/// Sample k of a ray is at `origin + along · ((k + ½)·Δ)`: a function of the pixel and k, never accumulated.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lattice {
    /// Δ in world units.
    pub step: f64,
    /// The direction that Δ is measured along.
    pub along: StepAlong,
    /// Smallest depth (radius, for shells) of a sample in perspective, in world units.
    pub near: f64,
}

/// The number of planes from which on k + ½ is no number of its own.
pub const MOST_PLANES: f64 = (1u64 << 52) as f64;

impl Lattice {
    /// The distance of the farthest point of a grid's box from the eye, before it or behind it, in steps.
    pub fn planes(&self, view: &View, grid: &Grid) -> f64 {
        let away = |corner: DVec3| match self.along {
            StepAlong::Ray if view.perspective => view.to_eye(corner).length(),
            StepAlong::Ray | StepAlong::Plane => view.to_eye(corner).z.abs(),
        };
        grid.world_corners().into_iter().map(away).fold(0.0, f64::max) / self.step
    }

    /// The smallest k of a sample beyond `near`.
    #[inline]
    pub fn first(&self, view: &View) -> i64 {
        if view.perspective { first_beyond(self.near, self.step) } else { i64::MIN }
    }
}

/// The smallest k with (k + ½)Δ > near. Beyond 2⁵² steps, where halves are lost, there is none.
fn first_beyond(near: f64, step: f64) -> i64 {
    if near / step >= MOST_PLANES {
        return i64::MAX;
    }
    let mut k = (near / step - 0.5).floor() as i64 - 1;
    while (k as f64 + 0.5) * step <= near {
        k += 1;
    }
    k
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::Camera;

    #[test]
    fn samples_begin_beyond_near() {
        // near = Δ: depth ½Δ is out, 3/2 Δ is in.
        assert_eq!(first_beyond(0.5, 0.5), 1);
        // near = ½Δ: depth ½Δ is not beyond.
        assert_eq!(first_beyond(0.25, 0.5), 1);
        assert_eq!(first_beyond(0.249, 0.5), 0);
        assert_eq!(first_beyond(1e30, 0.5), i64::MAX);
    }

    #[test]
    fn planes_between_the_eye_and_the_farthest_corner() {
        // A box of 8 × 6 × 4 about (4, 3, 2), seen along x from 6 before its middle: 10 to its far face.
        let grid = Grid::with_spacing([9, 7, 5], [1.0; 3]).unwrap();
        let eye = Some(DVec3::new(-2.0, 3.0, 2.0));
        let camera = Camera { eye, direction: DVec3::X, direction_given: true, ..Camera::default() };
        let view = View::new(&camera, &grid, [4, 4]).unwrap();
        let planes = |along| Lattice { step: 0.5, along, near: 0.5 }.planes(&view, &grid);
        assert_eq!(planes(StepAlong::Plane), 20.0);
        assert_eq!(planes(StepAlong::Ray), 2.0 * (100.0f64 + 9.0 + 4.0).sqrt());
    }
}
