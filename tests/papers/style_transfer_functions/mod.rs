//! Bruckner and Gröller 2007.

mod curvature;
mod extraction;
mod lookup;
mod mipmaps;
mod rings;
mod transparency;
mod two_quantities;

use crate::common::{Stage, orthographic};
use drypoint::scene::tables::{Camera, GradientEstimator, HessianEstimator, Kernel, Length};

/// The most exact reconstruction of smooth fields: the quintic B-spline and its derivatives.
fn smooth(shot: &Stage) -> Stage {
    shot.with(|s| {
        s.sampling.kernel = Kernel::Bspline5;
        s.sampling.gradient = GradientEstimator::Analytic;
        s.sampling.hessian = HessianEstimator::Analytic;
    })
}

/// One sample a ray, on the plane through the centre of the volume: planes are farther apart than the volume is long,
/// and opacities are given for their distance, so that nothing is corrected.
fn one_sample(shot: &Stage, direction: [f64; 3], height: f64) -> Stage {
    const APART: f64 = 128.0;
    let centre = shot.volume.grid().centre();
    let u = drypoint::scene::glam::DVec3::from_array(direction).normalize();
    shot.step(APART).with(|s| {
        s.camera = Camera {
            direction: u,
            direction_given: true,
            eye: Some(centre - u * (APART / 2.0)),
            ..orthographic(Some(height))
        };
    })
}

/// Planes this far apart, in world units.
fn planes(shot: &Stage, step: f64) -> Stage {
    shot.with(|s| s.sampling.step = Length::World(step))
}
