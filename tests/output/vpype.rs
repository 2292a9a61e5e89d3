//! A plotter's sheet as vpype reads it, where somebody has it.

use crate::outside::run;
use crate::sample;
use drypoint::output::plotter::{Speed, plan};
use drypoint::output::vector::svg::write_svg;
use drypoint::scene::picture::Provenance;

#[test]
fn vpype_finds_the_layers_their_pens_and_every_stroke() {
    let folder = tempfile::tempdir().unwrap();
    let provenance = Provenance::default();
    let plan = plan(&sample::marks(true), &Speed::default());
    let sheet = drypoint::output::vector::VectorPage { plotter: true, ..sample::sheet(&plan.marks, &provenance) };
    write_svg(&sheet, &folder.path().join("a.svg")).unwrap();
    let Some(said) = run("vpype", None, &["read", "a.svg", "stat"], folder.path()) else { return };
    let after = |text: &str, key: &str| -> Vec<String> {
        text.split(key).skip(1).map(|rest| rest.lines().next().unwrap().trim().to_owned()).collect()
    };
    assert_eq!(after(&said, "vp_name:"), ["'1-black 0.3'", "'2-red 0.5'"], "{said}");
    let counts: Vec<String> = plan.marks.layers.iter().map(|l| (l.dots.len() + l.lines.len()).to_string()).collect();
    assert_eq!(after(&said, "Path count:")[..2], counts[..], "{said}");
    // In px of 1/96 inch.
    for (found, width) in after(&said, "vp_pen_width:").iter().zip([0.3, 0.5]) {
        assert!((found.parse::<f64>().unwrap() * 25.4 / 96.0 - width).abs() < 1e-4, "{said}");
    }
}
