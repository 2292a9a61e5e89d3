//! Thin tubes between planes ([HALO-3], [HALO-8]): how much the opacity of a glow beside a tube depends on where planes lie.

use super::{glow, linear};
use crate::common::{Stage, orthographic, volume};
use drypoint::scene::glam::DVec3;
use drypoint::scene::tables::{Halo, HaloAccumulation, Length, SeedBy, SeedValue};

/// Δ, in voxels.
const STEP: f64 = 0.5;
/// Phases of the planes in a step.
const PHASES: usize = 16;

/// A tube of a radius along z, seen along y, with nothing shown but its glow; its planes are moved by a part of Δ.
fn tube(radius: f64, halo: Halo, moved: f64) -> Stage {
    let side = 2 * (radius as usize + 4);
    let centre = DVec3::new(side as f64 / 2.0, side as f64 / 2.0, 12.0);
    let field = volume([side + 1, side + 1, 25], |p| radius - DVec3::new(p.x - centre.x, p.y - centre.y, 0.0).length());
    Stage::regular(field, &[(-0.5, [0.5; 3], 0.0), (0.5, [0.5; 3], 1.0)]).with(|s| {
        // Two pixels a voxel, one row, whose guard band of 9 pixels lies in the volume.
        let width = 4 * side;
        s.picture.size = [width, 1];
        s.camera = orthographic(Some(0.5));
        s.camera.direction = DVec3::Y;
        s.camera.direction_given = true;
        s.camera.eye = Some(centre - DVec3::Y * (20.0 + STEP * moved));
        s.sampling.step = Length::World(STEP);
        s.sampling.reference_length = Length::World(1.0);
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

/// The opacity of the glow in the pixels from ½ to 1½ voxels beside the tube.
fn opacity(radius: f64, halo: &Halo, moved: f64) -> f64 {
    let shown = tube(radius, halo.clone(), moved).render_halos_alone();
    let pixels = shown.pixels();
    let middle = pixels.len() / 2;
    let first = middle + (2.0 * radius) as usize + 1;
    pixels[first..first + 2].iter().map(|p| p[3]).sum::<f64>() / 2.0
}

/// Opacities over all phases of the planes, and all places of a plane in its group.
fn phases(radius: f64, halo: &Halo) -> Vec<f64> {
    let all = (0..PHASES * halo.every as usize).map(|i| i as f64 / PHASES as f64);
    all.map(|moved| opacity(radius, halo, moved)).collect()
}

fn mean(numbers: &[f64]) -> f64 {
    numbers.iter().sum::<f64>() / numbers.len() as f64
}

#[test]
#[ignore]
fn numbers() {
    use HaloAccumulation::{Max, Mean};
    for by in [SeedBy::Curvature, SeedBy::Power] {
        for r in [1.0, 2.0, 4.0, 8.0] {
            let all = phases(r, &halo(by, 1, Mean));
            let m = mean(&all);
            let (lo, hi) = all.iter().fold((f64::MAX, 0.0f64), |(a, b), x| (a.min(*x), b.max(*x)));
            print!("{by:?} R {r}: mean {m:.5} −{:.3} +{:.3} p2p {:.3}", 1.0 - lo / m, hi / m - 1.0, (hi - lo) / m);
            for acc in [Mean, Max] {
                for every in [2, 4, 8] {
                    print!(" M{every} {acc:?} {:.3}", mean(&phases(r, &halo(by, every, acc))) / m - 1.0);
                }
            }
            println!();
        }
    }
}
