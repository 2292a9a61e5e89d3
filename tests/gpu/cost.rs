//! The backend as a knob of accuracy against time ([COST-1]).

use crate::gpu;
use drypoint::cost::{BACKEND, SweepOptions, Truth, sweep};
use drypoint::gpu::Interpolation;
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};

/// Cards stand beside the reference, with errors of f32, and the sweep turns no other knob by them.
#[test]
fn backends_are_a_knob() {
    let Some(gpu) = gpu() else { return };
    let text =
        "drypoint = 1\n[volume]\nphantom = { name = \"torus\", size = 25 }\n[picture]\nsize = [64, 48]\nsamples = 1\n";
    let scene = parse(text, "scene.toml".as_ref(), &Overrides::default()).unwrap_or_else(|faults| panic!("{faults}"));
    let job = Job::load(scene).unwrap_or_else(|failures| panic!("{failures}"));
    let options = SweepOptions { runs: 1, only: vec![BACKEND.into(), "sampling.number".into()] };
    let mut cards = vec![("gpu", gpu.clone())];
    if let Ok(fast) = gpu.interpolating(Interpolation::Fast) {
        cards.insert(0, ("gpu-fast", fast));
    }
    let found = sweep(&job, &options, &cards, &|_| ()).unwrap_or_else(|failures| panic!("{failures}"));
    assert!(found.left_out.is_empty(), "{:?}", found.left_out);
    let of = |knob: &str| found.rows.iter().filter(|row| row.knob == knob).cloned().collect::<Vec<_>>();
    let numbers: Vec<String> = of("sampling.number").into_iter().map(|row| row.setting).collect();
    assert_eq!(numbers, ["f32", "f64"]);
    let backends = of(BACKEND);
    let settings: Vec<&str> = backends.iter().map(|row| &*row.setting).collect();
    let names: Vec<&str> = cards.iter().map(|(name, _)| *name).chain(["reference"]).collect();
    assert_eq!(settings, names);
    for row in backends {
        println!("{}: RMS {:.1e}, largest {:.1e}", row.setting, row.rms, row.max);
        assert_eq!(row.truth, Truth::Finest("reference".into()));
        assert_eq!(row.own, row.setting == "reference");
        // Numbers of f32 leave a little; weights of 8 bits leave about a thousandth.
        let (least, most) = match &*row.setting {
            "reference" => (0.0, 0.0),
            "gpu" => (1e-9, 1e-4),
            _ => (1e-9, 1e-2),
        };
        assert!((least..=most).contains(&row.max), "{}: {}", row.setting, row.max);
        assert!(row.seconds > 0.0 && row.bytes > 0);
    }
}
