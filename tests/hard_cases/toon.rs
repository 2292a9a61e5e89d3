//! Tones, silhouettes and view-dependent opacity at their edges ([HATCH-15]).

use crate::common::{Stage, ball, orthographic, volume};
use crate::stability::{Case, Theme, differing, worst};
use drypoint::scene::glam::DVec3;
use drypoint::scene::math::scale_by_power_of_two;
use drypoint::scene::tables::{
    Iso, Length, LightDirection, Number, Shading, ShadingModel, SilhouetteShading, Surface, SurfaceLook, Tone,
    ToonShading,
};

pub(crate) static THEME: Theme = Theme::new(
    "Tones and silhouettes",
    &[
        Case {
            name: "values times 2^±100, tones with hard steps, silhouettes, view-dependent opacity",
            breaks: "a step that rounding puts elsewhere",
            done: "normals of gradients that are scaled by a power of two [SPACE-4]",
            of: "numbers with another bit; function and surface, f64",
            bound: 0.0,
            why: "a power of two changes no mantissa",
            measure: values_by_two,
        },
        Case {
            name: "view-dependent opacity on a plane seen at |N·V| = 1, ½ and 0; s = ¼, 1, 5",
            breaks: "1/|N·V| at an edge that is seen from its side",
            done: "|N·V| counts as at least 2⁻⁶: an exponent of 1 + 63 s",
            of: "|ln T′/(x ln T) − 1|, x the closed exponent",
            bound: 1e-12,
            why: "60 samples round by some ε each, and T ≥ 10⁻³",
            measure: seen_at_a_slant,
        },
        Case {
            name: "the same with s = 1, at |N·V| = ½, Δ halved four times",
            breaks: "an opacity that is corrected for the step before the rule, and does not converge",
            done: "the correction is the last step [VAL-4]",
            of: "|ln T′ − closed form for the length of the ray| in units of one step's",
            bound: 1.0,
            why: "the lattice belongs to the camera: a step at the two ends [RAY-1]",
            measure: steps_halved,
        },
        Case {
            name: "s = 0, and s > 0 where α is 0 or 1 everywhere",
            breaks: "powers that are not exact at their ends",
            done: "nothing is computed for s = 0; α = 0 and α = 1 stay as they are",
            of: "numbers with another bit",
            bound: 0.0,
            why: "1 − (1 − α)^x is α at 0 and 1 for every x",
            measure: nothing_to_change,
        },
        Case {
            name: "a constant volume, which has no normal, in tones with silhouettes",
            breaks: "tones of rounding noise; black interiors",
            done: "N = v there: the tone of what faces the eye, no silhouette [PREC-3]",
            of: "numbers that differ from that tone",
            bound: 0.0,
            why: "one test decides for every sample",
            measure: without_normal,
        },
    ],
);

#[test]
fn tones_and_silhouettes() {
    THEME.hold();
}

const COLOR: [f64; 3] = [0.5, 0.25, 0.75];

/// Three tones and all else.
fn everything(view_opacity: f64) -> Shading {
    let tone = |at, c| Tone { at, color: [c, c, 1.0, 1.0] };
    Shading {
        model: ShadingModel::Toon,
        toon: Some(ToonShading { offset: 0.1, tones: vec![tone(-1.0, 0.125), tone(0.25, 0.5), tone(0.75, 1.0)] }),
        silhouette: Some(SilhouetteShading { offset: 0.3 }),
        light: Some(LightDirection::Eye(DVec3::new(-1.0, 2.0, 1.5))),
        view_opacity,
        ..Shading::default()
    }
}

fn values_by_two() -> f64 {
    let scenes = |scale: f64| {
        let soft = ball(16, 6.0);
        let of = volume([16; 3], |p| scale * soft.value([p.x as usize, p.y as usize, p.z as usize]));
        let function = Stage::regular(of, &[(-2.0 * scale, COLOR, 0.0), (2.0 * scale, COLOR, 0.4)]).with(|s| {
            s.camera = orthographic(Some(15.0));
            s.camera.direction = DVec3::new(0.4, 0.8, -0.5);
            s.shading = Some(everything(2.0));
        });
        let surface = function.with(|s| {
            s.surface = Some(Surface {
                iso: Iso::Value(0.5 * scale),
                look: SurfaceLook::Toon,
                toon: everything(0.0).toon,
                silhouette: everything(0.0).silhouette,
                ..Surface::default()
            })
        });
        [function, surface].map(|shot| {
            let shown = shot.render();
            assert!(shown.covered() > 80);
            shown.bits()
        })
    };
    let one = scenes(1.0);
    let scales = [-100, -1, 37, 100].map(|k| scenes(scale_by_power_of_two(1.0, k)));
    scales.iter().map(|other| differing(&one[0], &other[0]) + differing(&one[1], &other[1])).sum()
}

/// A field that rises along z, of one colour, seen so that |N·V| is a cosine; the box is wider than the picture.
fn slope(cosine: f64) -> Stage {
    Stage::regular(volume([20; 3], |p| p.z), &[(0.0, COLOR, 0.06)]).step(0.25).with(|s| {
        s.camera = orthographic(Some(4.0));
        s.camera.direction = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
        s.camera.up = DVec3::Y;
        s.picture.size = [5, 5];
        s.shading = Some(Shading::default());
    })
}

/// ln T of each pixel.
fn depths(shot: &Stage) -> Vec<f64> {
    shot.render().pixels().iter().map(|p| (1.0 - p[3]).ln()).collect()
}

fn with_strength(shot: &Stage, s: f64) -> Stage {
    shot.with(|scene| scene.shading = Some(Shading { view_opacity: s, ..Shading::default() }))
}

fn seen_at_a_slant() -> f64 {
    let mut errors = Vec::new();
    for (cosine, inverse) in [(1.0, 1.0), (0.5, 2.0), (0.0, 64.0)] {
        for s in [0.25, 1.0, 5.0] {
            let exponent = 1.0 + s * (inverse - 1.0);
            // So faint that T does not vanish.
            let faint = slope(cosine).with_transfer(|t| {
                for node in t.nodes.iter_mut().flatten() {
                    node.opacity = 0.06 / exponent;
                }
            });
            let pairs = depths(&faint).into_iter().zip(depths(&with_strength(&faint, s)));
            errors.extend(pairs.map(|(plain, dense)| (dense / (exponent * plain) - 1.0).abs()));
        }
    }
    worst(errors)
}

fn steps_halved() -> f64 {
    let mut errors = Vec::new();
    for halved in 0..5 {
        let step = 0.5 / f64::from(1 << halved);
        let shot = with_strength(&slope(0.5), 1.0).with(|s| {
            s.sampling.step = Length::World(step);
            s.sampling.reference_length = Length::World(1.0);
        });
        // The ray crosses the 19 of x at 60°: 19/sin 60° long. Its exponent is 2.
        let along = 2.0 * 0.94f64.ln();
        let length = 19.0 / 0.75f64.sqrt();
        errors.extend(depths(&shot).iter().map(|depth| ((depth - along * length) / (along * step)).abs()));
    }
    worst(errors)
}

fn nothing_to_change() -> f64 {
    let soft = Stage::regular(ball(16, 6.0), &[(-2.0, COLOR, 0.0), (2.0, COLOR, 0.4)]);
    let hard = Stage::regular(ball(16, 6.0), &[(0.0, COLOR, 0.0), (0.0, COLOR, 1.0)]);
    let clear = Stage::regular(ball(16, 6.0), &[(0.0, COLOR, 0.0)]);
    let bits = |shot: &Stage, shading: Shading| shot.with(|s| s.shading = Some(shading)).render().bits();
    let phong = |view_opacity| Shading { view_opacity, ..Shading::default() };
    assert_ne!(bits(&soft, phong(0.0)), bits(&soft, phong(0.5)));
    let plain = soft.with(|s| s.shading = Some(Shading::default())).render();
    let strengths = [0.5, 9.0].map(|s| {
        [&hard, &clear].map(|shot| {
            differing(&bits(shot, phong(0.0)), &bits(shot, phong(s)))
                + differing(&bits(shot, everything(0.0)), &bits(shot, everything(s)))
        })
    });
    differing(&plain.bits(), &bits(&soft, phong(0.0))) + strengths.iter().flatten().sum::<f64>()
}

fn without_normal() -> f64 {
    let mut differ = 0.0;
    // L·v is 1, 0 and −1: with the offset of 0.1 the third, first and first tone.
    for (light, tone) in [(DVec3::Z, 1.0), (DVec3::X, 0.125), (-DVec3::Z, 0.125)] {
        for number in [Number::F64, Number::F32] {
            let flat = Stage::regular(volume([6; 3], |_| 1000.3), &[(0.0, COLOR, 1.0)]).with(|s| {
                s.shading = Some(Shading { light: Some(LightDirection::Eye(light)), ..everything(3.0) });
                s.sampling.number = number;
            });
            let shown = flat.render();
            assert!(shown.covered() > 20 && shown.counts.without_normal == shown.covered() as u64);
            let wanted = [COLOR[0] * tone, COLOR[1] * tone, COLOR[2], 1.0];
            let seen = shown.pixels();
            differ += seen.iter().filter(|p| p[3] > 0.0 && **p != wanted).count() as f64;
        }
    }
    differ
}

/// A light in eye space turns with the camera: a renderer that is turned draws what a new one does.
#[test]
fn a_turned_camera_takes_its_light_along() {
    let function = Stage::regular(ball(16, 6.0), &[(-2.0, COLOR, 0.0), (2.0, COLOR, 0.4)])
        .with(|s| s.shading = Some(everything(1.0)));
    let surface = function.with(|s| {
        s.transfer = None;
        let Shading { toon, silhouette, .. } = everything(0.0);
        s.surface =
            Some(Surface { iso: Iso::Value(0.5), look: SurfaceLook::Toon, toon, silhouette, ..Surface::default() });
    });
    for shot in [function, surface] {
        let turned = shot.seen_along([-0.5, 0.6, 0.3]);
        let shown = shot.render_turned(&[&shot, &turned].map(|seen| shot.resolved(seen.view())));
        assert_eq!(shown[0].bits(), shot.render().bits());
        assert_eq!(shown[1].bits(), turned.render().bits());
    }
}

/// Under the mirrored light a ball looks mirrored, and is dark on the other side.
#[test]
fn a_mirrored_light_makes_a_mirrored_picture() {
    let lit = |x: f64| {
        let shot = Stage::regular(ball(17, 6.3), &[(0.0, COLOR, 0.0), (0.0, COLOR, 1.0)]).with(|s| {
            s.picture.size = [31, 31];
            s.camera = orthographic(Some(15.0));
            s.camera.direction = DVec3::Y;
            s.shading = Some(Shading {
                light: Some(LightDirection::Eye(DVec3::new(x, 0.4, 0.9))),
                silhouette: None,
                ..everything(0.0)
            });
        });
        shot.render().pixels()
    };
    let (left, right) = (lit(-1.1), lit(1.1));
    let mirrored = |t: usize| t / 31 * 31 + 30 - t % 31;
    // The ball is its own mirror image, but for the order of sums: a pixel on a step in a thousand.
    let differ = (0..left.len()).filter(|&t| left[t] != right[mirrored(t)]).count();
    assert!(differ <= 1, "{differ}");
    let dark = |p: &[[f64; 4]]| {
        (0..31).map(|row| p[row * 31..][..15].iter().filter(|p| p[0] < 0.3 && p[3] > 0.0).count()).sum::<usize>()
    };
    assert!(dark(&right) > dark(&left) + 40, "{} {}", dark(&right), dark(&left));
}
