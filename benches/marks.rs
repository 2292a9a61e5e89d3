//! Half a million dots and a few thousand lines on A4: to SVG, PDF, a list and pixels, and the order of a plotter.
//!
//! `cargo bench --bench marks`

use divan::Bencher;
use drypoint::output::list::{ListFormat, encode_dots};
use drypoint::output::paint::{PageWindow, blank, paint};
use drypoint::output::plotter::{Speed, plan};
use drypoint::output::vector::VectorPage;
use drypoint::output::vector::pdf::encode_pdf;
use drypoint::output::vector::svg::encode_svg;
use drypoint::scene::glam::{DVec2, DVec3};
use drypoint::scene::marks::{Dot, Layer, Marks, Page, Pen};
use drypoint::scene::math;
use drypoint::scene::picture::Provenance;
use drypoint::scene::tables::BlendSpace;
use std::sync::OnceLock;

fn main() {
    divan::main();
}

const DOTS: usize = 500_000;

/// Dots on the page's golden lattice, turned in each voxel-sized cell, so that they are spread but in no row; a nib that
/// leaves all of them.
fn marks() -> &'static Marks {
    static MARKS: OnceLock<Marks> = OnceLock::new();
    MARKS.get_or_init(|| {
        let page = Page::in_millimetres(DVec2::new(277.0, 190.0), 10.0, 300.0);
        let pen = Pen { number: 1, name: "black".into(), width: 0.1, color: [0.0, 0.0, 0.0, 1.0] };
        let dot = |i: usize| {
            // The plastic number's sequence (Roberts 2018) fills a square evenly; the step of 7919 takes it out of order.
            let n = (i * 7919 % DOTS) as f64;
            let [u, v] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2].map(|a| (n * a).fract());
            let at = DVec2::new(10.2 + 276.6 * u, 10.2 + 189.6 * v);
            Dot { at, world: DVec3::new(u, v, math::sin(n)), radius: 0.03 + 0.07 * v, opacity: 1.0 }
        };
        let mut marks = Marks { page, layers: vec![Layer { dots: (0..DOTS).map(dot).collect(), ..Layer::new(pen) }] };
        marks.round();
        marks
    })
}

fn sheet<'a>(marks: &'a Marks, provenance: &'a Provenance) -> VectorPage<'a> {
    VectorPage { marks, background: None, picture: None, plotter: false, beziers: false, outlined: false, provenance }
}

#[divan::bench(sample_count = 10)]
fn svg(bencher: Bencher) {
    let (marks, provenance) = (marks(), Provenance::default());
    if let Ok(bytes) = encode_svg(&sheet(marks, &provenance)) {
        println!("{:.2} MB", bytes.len() as f64 / 1e6);
    }
    bencher.bench(|| encode_svg(&sheet(marks, &provenance)).map(|bytes| bytes.len()));
}

#[divan::bench(sample_count = 5)]
fn pdf(bencher: Bencher) {
    let (marks, provenance) = (marks(), Provenance::default());
    bencher.bench(|| encode_pdf(&sheet(marks, &provenance)).map(|bytes| bytes.len()));
}

#[divan::bench(sample_count = 5)]
fn list(bencher: Bencher) {
    let marks = marks();
    bencher.bench(|| encode_dots(marks, ListFormat::Csv).len());
}

#[divan::bench(args = [BlendSpace::Linear, BlendSpace::Srgb], sample_count = 3)]
fn pixels(bencher: Bencher, blend: BlendSpace) {
    let marks = marks();
    bencher.bench(|| {
        let mut picture = blank(&marks.page, Some([1.0; 4]))?;
        paint(marks, &PageWindow::page(&marks.page), blend, &mut picture).map(|()| picture)
    });
}

#[divan::bench(sample_count = 3)]
fn plotter(bencher: Bencher) {
    let marks = marks();
    bencher.bench(|| plan(marks, &Speed::default()).travel);
}
