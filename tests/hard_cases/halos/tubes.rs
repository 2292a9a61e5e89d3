//! Thin tubes between planes ([HALO-3], [HALO-8]): how much the opacity of a glow beside a tube depends on where planes lie.

use super::{glow, linear};
use crate::common::{Stage, orthographic, volume};
use crate::stability::worst;
use drypoint::scene::glam::DVec3;
use drypoint::scene::tables::{GradientEstimator, Halo, HaloAccumulation, Kernel, Length, SeedBy, SeedValue};

/// Δ, in voxels.
const STEP: f64 = 0.5;
/// Phases of the planes in a step.
const PHASES: usize = 16;

/// A field of tubes.
#[derive(Clone, Copy)]
enum Field {
    /// (R² − ρ²)/2R, which B-splines reproduce: planes alone matter.
    Exact,
    /// R − ρ between voxels by trilinear interpolation.
    Trilinear,
}

/// A tube of a radius along z, seen along y, with nothing shown but its glow; its planes are moved by a part of Δ.
fn tube(field: Field, radius: f64, halo: Halo, moved: f64) -> Stage {
    let side = 2 * (radius as usize + 4);
    let centre = DVec3::new(side as f64 / 2.0, side as f64 / 2.0, 12.0);
    let volume = volume([side + 1, side + 1, 25], |p| {
        let rho = DVec3::new(p.x - centre.x, p.y - centre.y, 0.0).length();
        match field {
            Field::Exact => (radius * radius - rho * rho) / (2.0 * radius),
            Field::Trilinear => radius - rho,
        }
    });
    Stage::regular(volume, &[(-0.5, [0.5; 3], 0.0), (0.5, [0.5; 3], 1.0)]).with(|s| {
        // Two pixels a voxel in one row, whose guard band of 9 pixels lies in the volume.
        s.picture.size = [4 * side, 1];
        s.camera = orthographic(Some(0.5));
        s.camera.direction = DVec3::Y;
        s.camera.direction_given = true;
        s.camera.eye = Some(centre - DVec3::Y * (20.0 + STEP * moved));
        s.sampling.step = Length::World(STEP);
        s.sampling.reference_length = Length::World(1.0);
        if let Field::Exact = field {
            s.sampling.kernel = Kernel::Bspline;
            s.sampling.gradient = GradientEstimator::Analytic;
        }
        s.halos = vec![halo];
    })
}

/// A glow whose opacity is a twentieth of its intensity.
fn halo(by: SeedBy, every: u64, accumulate: HaloAccumulation) -> Halo {
    let mut halo = Halo { every, accumulate, opacity: 1.0, floor: 0.0, profile: linear(0.05), ..glow() };
    halo.seed.value = Some(SeedValue::Nodes(vec![[-0.5, 0.0], [0.5, 1.0]]));
    halo.seed.by = by;
    halo.spread.passes = 3;
    halo
}

/// The mean opacity of the glow in the two pixels from ½ to 1½ voxels beside the tube.
fn opacity(field: Field, radius: f64, halo: &Halo, moved: f64) -> f64 {
    let shown = tube(field, radius, halo.clone(), moved).render_halos_alone();
    let pixels = shown.pixels();
    let first = pixels.len() / 2 + (2.0 * radius) as usize + 1;
    pixels[first..first + 2].iter().map(|p| p[3]).sum::<f64>() / 2.0
}

/// Opacities over all phases of the planes, and all places of a plane in its group.
fn phases(field: Field, radius: f64, halo: &Halo) -> Vec<f64> {
    let all = (0..PHASES * halo.every as usize).map(|i| i as f64 / PHASES as f64);
    all.map(|moved| opacity(field, radius, halo, moved)).collect()
}

fn mean(numbers: &[f64]) -> f64 {
    numbers.iter().sum::<f64>() / numbers.len() as f64
}

/// How far opacities over the phases are off their mean at most, as a share of it.
fn flicker(field: Field, radius: f64, by: SeedBy) -> f64 {
    let all = phases(field, radius, &halo(by, 1, HaloAccumulation::Mean));
    let mean = mean(&all);
    assert!(mean > 1e-4);
    worst(all.iter().map(|opacity| (opacity / mean - 1.0).abs()))
}

pub(super) fn by_curvature() -> f64 {
    worst([1.0, 2.0, 4.0, 8.0].map(|radius| flicker(Field::Exact, radius, SeedBy::Curvature)))
}

pub(super) fn by_curvature_between_voxels() -> f64 {
    worst([2.0, 4.0, 8.0].map(|radius| flicker(Field::Trilinear, radius, SeedBy::Curvature)))
}

pub(super) fn by_power() -> f64 {
    flicker(Field::Exact, 8.0, SeedBy::Power)
}

pub(super) fn groups_of_four() -> f64 {
    worst([Field::Exact, Field::Trilinear].into_iter().flat_map(|field| {
        [2.0, 4.0, 8.0].map(|radius| {
            let of = |every| mean(&phases(field, radius, &halo(SeedBy::Curvature, every, HaloAccumulation::Mean)));
            (of(4) / of(1) - 1.0).abs()
        })
    }))
}

/// Trilinear interpolation makes a prism of a tube as thin as a voxel. Then opacities are up to 14 % off their mean, more than
/// the 10 % of thicker tubes. Seeds by a power flicker more than that on every tube, and the more, the thinner it is.
#[test]
fn thin_tubes_flicker() {
    let curved = flicker(Field::Trilinear, 1.0, SeedBy::Curvature);
    let powers = [1.0, 2.0, 4.0, 8.0].map(|radius| flicker(Field::Exact, radius, SeedBy::Power));
    println!("by curvature, trilinear, R = 1: {curved:.3}; by power, R = 1, 2, 4, 8: {powers:.3?}");
    assert!(curved < 0.15, "{curved}");
    assert!(powers.windows(2).all(|pair| pair[0] > pair[1]) && powers[3] > 0.25, "{powers:?}");
}

/// The largest seeds of a group make a glow as opaque as if all its planes had them: that is why a glow has the mean.
#[test]
fn the_largest_of_a_group_makes_a_glow_too_opaque() {
    let of = |every, accumulate| mean(&phases(Field::Exact, 4.0, &halo(SeedBy::Curvature, every, accumulate)));
    let one = of(1, HaloAccumulation::Mean);
    assert!(of(4, HaloAccumulation::Max) > 1.5 * one && of(4, HaloAccumulation::Mean) < 1.05 * one);
}
