//! Tiny and huge steps ([RAY-1], [VAL-4]).

use crate::common::{Stage, corrected, on, orthographic, perspective};
use crate::stability::{Case, Theme, U, rounding, worst};
use drypoint::reference::ray::{RenderError, Renderer};
use drypoint::scene::backdrop::Backdrop;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::glam::DVec3;
use drypoint::scene::inputs::{Inputs, ObjectData};
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Length, Number, StepAlong};
use std::path::Path;

pub(crate) static THEME: Theme = Theme::new(
    "Tiny and huge steps",
    &[
        Case {
            name: "Δ of 10⁻³ to 10⁻⁶ voxels",
            breaks: "opacities of 10⁻⁷ a sample cancel; positions drift",
            done: "expm1 and log1p, positions from k",
            of: "|α − (1 − (1 − α₀)^(L/Δ₀))| in units of one step's opacity and 4 ε a sample",
            bound: 1.0,
            why: "one sample more or less, and up to four roundings of each",
            measure: || tiny(Number::F64),
        },
        Case {
            name: "Δ of 10 to 10⁶ box sizes",
            breaks: "a plane that should hit is missed; 1 − α to a power of 10⁶ is undefined",
            done: "inside or outside is decided on the sample's position",
            of: "|α − (1 − (1 − α₀)^(Δ/Δ₀))| of the one plane that meets the box, and wrong counts of samples",
            bound: 1e-15,
            why: "one correction: four roundings",
            measure: || huge(Number::F64),
        },
        Case {
            name: "the same two in f32: small steps",
            breaks: "as above",
            done: "as above",
            of: "|α − (1 − (1 − α₀)^(L/Δ₀))| in units of one step's opacity and 8 u a sample",
            bound: 1.0,
            why: "one sample more or less, and up to four roundings of each",
            measure: || tiny(Number::F32),
        },
        Case {
            name: "the same two in f32: huge steps",
            breaks: "as above",
            done: "as above",
            of: "|α − (1 − (1 − α₀)^(Δ/Δ₀))| of the one plane that meets the box, and wrong counts of samples",
            bound: 2.0 * U,
            why: "the opacity rounds before its correction and after it",
            measure: || huge(Number::F32),
        },
        Case {
            name: "Δ of 10³⁰ and 10³⁰⁰ box sizes",
            breaks: "k or depth overflows; endless loops",
            done: "the planes inside the box are counted before they are visited",
            of: "pixels that show something, or that are NaN",
            bound: 0.0,
            why: "the planes nearest to the eye lie beyond the box",
            measure: beyond_the_box,
        },
        Case {
            name: "Δ of 10⁻²⁰ to 10⁻³⁰⁰ voxels",
            breaks: "k + ½ is no number any more: planes fall together, and a ray never ends",
            done: "an error of its own type, from 2⁵² planes between eye and box on",
            of: "scenes that were taken; orthographic, perspective, shells",
            bound: 0.0,
            why: "halves are lost at 2⁵²",
            measure: too_many_planes,
        },
        Case {
            name: "Δ = 0, below 0, NaN, ∞, or rounded to 0",
            breaks: "division by Δ",
            done: "an error with its place and exit code 2",
            of: "texts that were taken, or refused without the key or with another exit code",
            bound: 0.0,
            why: "there are no planes",
            measure: refused,
        },
    ],
);

#[test]
fn tiny_and_huge_steps() {
    THEME.hold();
}

/// A homogeneous box, seen along y in one pixel.
fn slab(alpha: f64, step: f64) -> Stage {
    let flat = on(Grid::with_spacing([3, 3, 3], [1.0; 3]).unwrap(), |_| 3.0);
    Stage::regular(flat, &[(0.0, [1.0; 3], alpha)]).layers(&[LayerKind::Counts]).with(|s| {
        s.picture.size = [1, 1];
        s.camera = orthographic(Some(1.0));
        s.camera.direction = DVec3::Y;
        s.sampling.step = Length::World(step);
        s.sampling.reference_length = Length::World(1.0);
    })
}

fn tiny(number: Number) -> f64 {
    let steps = [1e-3, 1e-4, 3e-5, 1e-6];
    worst(steps.into_iter().flat_map(|step| {
        [0.7, 1e-9].map(|alpha| {
            let shown = slab(alpha, step).in_number(number).render();
            let samples = shown.one(LayerKind::Counts)[0];
            let bound = corrected_exactly(alpha, step) + 8.0 * rounding(number) * samples * shown.pixels()[0][3];
            assert!(samples > 1.9 / step, "{samples}");
            (shown.pixels()[0][3] - corrected_exactly(alpha, 2.0)).abs() / bound
        })
    }))
}

/// 1 − (1 − α)^x without cancellation.
fn corrected_exactly(alpha: f64, x: f64) -> f64 {
    -f64::exp_m1(x * f64::ln_1p(-alpha))
}

fn huge(number: Number) -> f64 {
    worst([10.0, 1e3, 1e6].into_iter().flat_map(|sizes| {
        [1e-9, 0.3].map(|alpha| {
            let step = sizes * 2.0;
            let shot = slab(alpha, step).in_number(number).with(|s| {
                // The plane at depth Δ/2 goes through the middle.
                s.camera.eye = Some(DVec3::new(1.0, 1.0 - step / 2.0, 1.0));
                s.camera.direction_given = true;
            });
            let shown = shot.render();
            let samples = shown.one(LayerKind::Counts)[0];
            let expected = if alpha < 1e-6 { corrected_exactly(alpha, step) } else { corrected(alpha, step) };
            (shown.pixels()[0][3] - expected).abs() + (samples - 1.0).abs()
        })
    }))
}

fn beyond_the_box() -> f64 {
    let mut wrong = 0;
    for step in [1e30, 1e300] {
        for camera in [orthographic(None), perspective(60.0)] {
            for along in [StepAlong::Plane, StepAlong::Ray] {
                let direction = DVec3::new(0.3, 0.9, -0.2);
                let shot = slab(0.5, step).with(|s| {
                    s.picture.size = [4, 4];
                    s.camera = camera.clone();
                    s.camera.direction = direction;
                    s.sampling.step_along = along;
                });
                wrong += shot.render().pixels().iter().filter(|p| **p != [0.0; 4]).count();
            }
        }
    }
    wrong as f64
}

fn too_many_planes() -> f64 {
    let mut taken = 0;
    for step in [1e-20, 1e-300] {
        for camera in [orthographic(None), perspective(60.0)] {
            for along in [StepAlong::Plane, StepAlong::Ray] {
                let shot = slab(0.5, step).with(|s| {
                    s.camera = camera.clone();
                    s.sampling.step_along = along;
                });
                let inputs = Inputs::of(ObjectData::of(&shot.volume), Backdrop::None);
                let made = Renderer::new(&shot.resolved(shot.view()), inputs);
                taken += usize::from(!matches!(made, Err(RenderError::TooManyPlanes { .. })));
            }
        }
    }
    taken as f64
}

fn refused() -> f64 {
    let head = "drypoint = 1\n[volume]\nphantom = { name = \"torus\", size = 8 }\n";
    let texts =
        ["0", "0.0", "-0.0", "-1", "nan", "inf", "1e-400", "\"0 voxels\"", "\"-2 voxels\"", "\"1e-400 voxels\""];
    let by_library = texts.iter().filter(|text| {
        let scene = format!("{head}[sampling]\nstep = {text}\n");
        let faults = parse(&scene, Path::new("s.toml"), &Overrides::default());
        !faults.is_err_and(|faults| faults.to_string().contains("sampling.step cannot be "))
    });
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), head).unwrap();
    let by_command = ["0", "-1", "nan", "0 voxels", "1e-300"].iter().filter(|text| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_drypoint"));
        let words = ["render", "s.toml", "-o", "p.png", "--set", &format!("sampling.step={text}")];
        let said = command.args(words).current_dir(folder.path()).output().unwrap();
        let named = String::from_utf8(said.stderr).unwrap().contains("key sampling.step");
        said.status.code() != Some(2) || !named || folder.path().join("p.png").exists()
    });
    (by_library.count() + by_command.count()) as f64
}
