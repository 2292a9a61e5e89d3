//! Opacities of 0, of 1, and as near to them as numbers go ([VAL-4], [STF-9]).

use crate::common::{Stage, orthographic, plain, volume};
use crate::stability::{Case, Theme, worst};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{Contours, Kappa, Length, Number, Transparency};

pub(crate) static THEME: Theme = Theme::new(
    "Opacities of 0 and 1",
    &[
        Case {
            name: "α_u = 1: α = α_d, whatever the exponent and Δ/Δ₀",
            breaks: "1^x or 0^0 by logarithms: 0.999…; ln 0 = −∞",
            done: "0 and 1 are asked before any logarithm [VAL-4, PREC-4]",
            of: "pixels whose opacity is not α_d: 1 at every Δ/Δ₀ from 10⁻³⁰⁰ to 10³⁰⁰, ¼, ½ and 2⁻¹²⁶ at 1",
            bound: 0.0,
            why: "1 to any power is 1, and (1 − 1) to any power is 0",
            measure: ones,
        },
        Case {
            name: "α_u = 0: nothing",
            breaks: "0^½ that is not 0; faint veils",
            done: "as above; a sample with α_u = 0 is not asked for more [STF-9]",
            of: "numbers of the picture that are not 0, gradients and lookups",
            bound: 0.0,
            why: "0 to any power above 0 is 0",
            measure: zeros,
        },
        Case {
            name: "α₀ of 5·10⁻³²⁴, 10⁻³⁰⁰, 10⁻¹⁷ and 1 − 2⁻⁵³",
            breaks: "1 − (1 − α) is 0 below 10⁻¹⁶",
            done: "−expm1(Δ/Δ₀ · log1p(−α)) [VAL-4]",
            of: "|α/α₀ − n| of n samples at Δ = Δ₀, over n; |α − 1| at the upper end",
            bound: 1e-14,
            why: "A sums n opacities, each with one rounding",
            measure: nearly,
        },
        Case {
            name: "an opaque sample before others",
            breaks: "what lies behind shines through by rounding",
            done: "(1 − A) is 0, and the ray ends",
            of: "numbers with another bit when all that lies behind changes its colour",
            bound: 0.0,
            why: "1 − 1 = 0",
            measure: nothing_shines_through,
        },
    ],
);

#[test]
fn opacities_of_0_and_1() {
    THEME.hold();
}

/// A ramp along the view, in one pixel, with a plane on every voxel.
fn on_voxels(shot: &Stage) -> Stage {
    shot.step(1.0).with(|s| {
        s.picture.size = [1, 1];
        s.camera = orthographic(Some(1.0));
        s.camera.direction = DVec3::Y;
        s.camera.eye = Some(DVec3::new(2.0, -0.5, 2.0));
        s.camera.direction_given = true;
    })
}

/// The ratios Δ/Δ₀ that are tried.
const RATIOS: [f64; 7] = [1e-300, 1e-9, 0.3, 0.5, 1.0, 7.7, 1e300];

fn ones() -> f64 {
    let mut wrong = 0;
    let opacity = |alpha_d: f64, shot: &Stage| {
        let styles = vec![plain("s", [0.5, 0.5, 0.5, alpha_d])];
        Stage { styles, ..shot.clone() }.render().pixels()[0][3]
    };
    for threshold in [0.0, 0.3, 1.0] {
        for number in [Number::F64, Number::F32] {
            for transparency in [Transparency::Illustrative, Transparency::Plain] {
                let wall = volume([5, 2, 5], |p| p.y);
                let shot = Stage::styled(
                    wall,
                    vec![plain("s", [0.5; 4])],
                    &[(0.0, "s", 1.0), (0.5, "s", 1.0), (0.5, "s", 0.0)],
                )
                .with_transfer(|t| t.transparency = transparency)
                .with(|s| {
                    s.contours = Some(Contours { kappa: Kappa::None { threshold }, ..Contours::default() });
                    s.sampling.number = number;
                });
                // One sample, at the first voxel.
                let shot = on_voxels(&shot);
                for ratio in RATIOS {
                    let shot = shot.with(|s| s.sampling.reference_length = Length::World(1.0 / ratio));
                    wrong += usize::from(opacity(1.0, &shot) != 1.0);
                }
                // The last is the least that a texel holds with all its digits.
                for alpha_d in [0.25, 0.5, f64::from(f32::MIN_POSITIVE)] {
                    wrong += usize::from(opacity(alpha_d, &shot) != alpha_d);
                }
            }
        }
    }
    wrong as f64
}

fn zeros() -> f64 {
    let mut wrong = 0;
    let ramp = volume([5, 9, 5], |p| p.y);
    for ratio in RATIOS {
        let styled =
            Stage::styled(ramp.clone(), vec![plain("s", [0.5, 0.5, 0.5, 1.0])], &[(0.0, "s", 0.0), (9.0, "s", 0.0)])
                .with(|s| s.contours = Some(Contours::default()));
        let regular = Stage::regular(ramp.clone(), &[(0.0, [1.0; 3], 0.0), (9.0, [1.0; 3], 0.0)]);
        for shot in [styled, regular] {
            for skip in [true, false] {
                let shown = shot
                    .with(|s| {
                        s.sampling.reference_length = Length::World(1.0 / ratio);
                        s.sampling.skip_empty = skip;
                    })
                    .render();
                wrong += shown.pixels().concat().iter().filter(|c| **c != 0.0).count();
                wrong += (shown.counts.gradients + shown.counts.style_lookups) as usize;
            }
        }
    }
    wrong as f64
}

fn nearly() -> f64 {
    worst([5e-324, 1e-300, 1e-17, 1.0 - f64::EPSILON / 2.0].map(|alpha| {
        let shot = Stage::regular(volume([5, 9, 5], |_| 1.0), &[(0.0, [1.0; 3], alpha)]).layers(&[LayerKind::Counts]);
        let shown = on_voxels(&shot).render();
        let (found, n) = (shown.pixels()[0][3], shown.one(LayerKind::Counts)[0]);
        if alpha > 0.5 { (found - 1.0).abs() } else { (found / alpha - n).abs() / n }
    }))
}

fn nothing_shines_through() -> f64 {
    let seen = |behind: [f64; 3], opacity: f64| {
        let nodes = [(0.0, [0.1, 0.2, 0.3], 0.3), (2.0, [0.4, 0.5, 0.6], 1.0), (2.5, behind, opacity)];
        on_voxels(&Stage::regular(volume([5, 9, 5], |p| p.y), &nodes)).render().bits()
    };
    let black = seen([0.0; 3], 1.0);
    let others = [seen([1.0; 3], 1.0), seen([1e300; 3], 0.5), seen([0.5; 3], 0.0)];
    others.iter().map(|other| crate::stability::differing(&black, other)).sum()
}
