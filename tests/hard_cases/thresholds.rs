//! Thresholds that are met exactly ([STF-3], [STF-7], [RAY-1], [RAY-2]).

use crate::common::strip::ramp;
use crate::common::{Stage, largest_difference, on, orthographic, volume};
use crate::stability::{Case, Theme, worst};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Contours, GradientRange, Kappa, Kernel, Length, Number};
use drypoint::scene::volume::{Volume, Voxels};

pub(crate) static THEME: Theme = Theme::new(
    "Thresholds met exactly",
    &[
        Case {
            name: "a step of the function at a value that samples have",
            breaks: "the surface jumps by a step, with speckle where rounding decides",
            done: "of two nodes at one value the later one holds at the value itself [STF-3]",
            of: "depths of the surface that are not those of the plane with that value; rising and falling steps",
            bound: 0.0,
            why: "values at voxels are the voxels', to the bit, and comparisons are exact",
            measure: steps_at_values,
        },
        Case {
            name: "one step of bytes after the other, all 256",
            breaks: "a node's rounding against a value's: slope and intercept, normalized",
            done: "nodes and values go through one expression [VAL-1]",
            of: "bytes that are seen and should not be, or the reverse; f64 and f32, 3 slopes",
            bound: 0.0,
            why: "the node is the byte's own value",
            measure: every_byte,
        },
        Case {
            name: "|N·v| = τ",
            breaks: "flicker where the view meets the threshold",
            done: "the push outwards and eq. 2 are continuous at τ [STF-8, STF-9]",
            of: "largest difference of a channel between τ = |N·v| and its neighbours in f64",
            bound: 1e-14,
            why: "|dα/dτ| ≤ α_u|ln α_u| < 1 and |dr'/dτ| = r/τ: a few ε",
            measure: contour_threshold,
        },
        Case {
            name: "A = 1 − ε at early termination",
            breaks: "one sample more or less by rounding",
            done: "A ≥ 1 − ε ends the ray [RAY-2]",
            of: "samples too many or too few; α = ½ a sample, ε = 2⁻ⁿ, n = 1 … 40",
            bound: 0.0,
            why: "A is 1 − 2⁻ⁿ after n samples, exactly",
            measure: termination,
        },
    ],
);

#[test]
fn thresholds_met_exactly() {
    THEME.hold();
}

/// One pixel along y, with a plane on every voxel.
fn on_voxels(shot: &Stage) -> Stage {
    shot.layers(&[LayerKind::Z, LayerKind::Counts]).step(1.0).with(|s| {
        s.picture.size = [1, 1];
        s.camera = orthographic(Some(1.0));
        s.camera.direction = DVec3::Y;
        s.camera.eye = Some(DVec3::new(2.0, -0.5, 2.0));
        s.camera.direction_given = true;
    })
}

fn steps_at_values() -> f64 {
    let mut wrong = 0.0;
    // Thirds have no exact binary places; the offset takes digits from them.
    for (scale, offset) in [(1.0, 0.0), (1.0 / 3.0, 0.0), (1.0 / 3.0, 1000.3), (1e30 / 3.0, 0.0)] {
        let value = |i: usize| i as f64 * scale + offset;
        for kernel in [Kernel::Trilinear, Kernel::CatmullRom] {
            for number in [Number::F64, Number::F32] {
                for i in 1..20 {
                    for falling in [false, true] {
                        let field =
                            volume([5, 21, 5], |p| value(if falling { 20 - p.y as usize } else { p.y as usize }));
                        // Seen from the step on, up to the highest value; or below it, where the later node is clear.
                        let nodes = if falling {
                            [(value(i), [1.0; 3], 1.0), (value(i), [1.0; 3], 0.0)]
                        } else {
                            [(value(i), [1.0; 3], 0.0), (value(i), [1.0; 3], 1.0)]
                        };
                        let shot = Stage::regular(field, &nodes).with(|s| {
                            (s.sampling.kernel, s.sampling.number) = (kernel, number);
                        });
                        let depth = on_voxels(&shot).render().one(LayerKind::Z)[0];
                        // The plane of voxel y is at depth y + ½; falling, the first value below the step.
                        let y = if falling { 21 - i } else { i };
                        wrong += f64::from(u8::from(depth != y as f64 + 0.5));
                    }
                }
            }
        }
    }
    wrong
}

fn every_byte() -> f64 {
    let grid = Grid::with_spacing([256, 1, 1], [1.0; 3]).unwrap();
    let mut wrong = 0;
    for (slope, intercept) in [(1.0, 0.0), (0.1, -1000.3), (1.0 / 255.0, 0.0)] {
        let volume = Volume::new(grid.clone(), Voxels::U8((0..=255).collect()), slope, intercept).unwrap();
        for number in [Number::F64, Number::F32] {
            for at in (0..=255).step_by(5) {
                let value = volume.value([at, 0, 0]);
                let shot =
                    Stage::regular(volume.clone(), &[(value, [1.0; 3], 0.0), (value, [1.0; 3], 1.0)]).with(|s| {
                        s.sampling.number = number;
                        s.picture.size = [256, 1];
                        // A pixel a voxel.
                        s.camera = orthographic(Some(1.0));
                        s.camera.direction = DVec3::Y;
                        s.camera.eye = Some(DVec3::new(127.5, 0.0, 0.0));
                        s.camera.direction_given = true;
                    });
                let seen = shot.render().pixels();
                wrong += seen.iter().enumerate().filter(|(byte, p)| (p[3] == 1.0) != (*byte >= at)).count();
            }
        }
    }
    wrong as f64
}

fn contour_threshold() -> f64 {
    let g = DVec3::new(0.3, 0.4, 0.0);
    let wall = on(Grid::with_spacing([9, 9, 9], [1.0; 3]).unwrap(), |p| g.dot(p));
    worst([0.2f64, 0.6].into_iter().flat_map(|alpha_u| {
        let shot = Stage::styled(wall.clone(), vec![ramp()], &[(-9.0, "ramp", alpha_u)]).with(|s| {
            s.volume.gradient_range = GradientRange::Fixed([0.0, 1.0]);
            s.camera.projection = orthographic(Some(3.0)).projection;
            s.picture.size = [3, 3];
            // One plane, through the middle.
            s.sampling.step = Length::World(32.0);
            s.sampling.reference_length = Length::World(32.0);
            s.camera.eye = Some(DVec3::new(4.0, 4.0 - 16.0, 4.0));
            s.camera.direction_given = true;
        });
        let at = |threshold: f64| {
            shot.with(|s| s.contours = Some(Contours { kappa: Kappa::None { threshold }, ..Contours::default() }))
                .render()
        };
        // The view is y: |N·v| = 4/5, to rounding.
        let n_v = 0.8f64;
        let here = at(n_v);
        assert!(largest_difference(&here, &at(1.0)) > 1e-3 && largest_difference(&here, &at(0.1)) > 1e-3);
        [n_v.next_up(), n_v.next_down(), n_v + 4.0 * f64::EPSILON, n_v - 4.0 * f64::EPSILON]
            .map(|threshold| largest_difference(&here, &at(threshold)))
    }))
}

fn termination() -> f64 {
    let shot = Stage::regular(volume([5, 60, 5], |_| 1.0), &[(0.0, [1.0; 3], 0.5)]);
    let samples =
        |epsilon: f64| on_voxels(&shot).with(|s| s.sampling.stop_below = epsilon).render().one(LayerKind::Counts)[0];
    let off = (1..=40).map(|n| {
        let epsilon = 2f64.powi(-n);
        (samples(epsilon) - f64::from(n)).abs() + (samples(epsilon * (1.0 - 2f64.powi(-10))) - f64::from(n + 1)).abs()
    });
    off.sum()
}
