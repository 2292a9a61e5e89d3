//! A sheet with everything that a page can have.

use crate::outside::Codes;
use crate::random::Random;
use drypoint::output::paint::{PageWindow, blank, paint};
use drypoint::output::png::write_png;
use drypoint::output::vector::VectorPage;
use drypoint::scene::glam::{DVec2, DVec3};
use drypoint::scene::marks::{Dot, Layer, Marks, Page, Pen, Polyline, Vertex};
use drypoint::scene::picture::Provenance;
use drypoint::scene::tables::BlendSpace;
use std::f64::consts::TAU;
use std::path::Path;

/// Two pens' dots and lines of many widths, opaque or not, some on each other, on 4 × 3 inches at 300 dpi: whole pixels.
pub(crate) fn marks(opaque: bool) -> Marks {
    let r = &mut Random(7);
    let page = Page::in_millimetres(DVec2::new(101.6, 76.2), 0.0, 300.0);
    let layers = [("black", 0.3, [0.0, 0.0, 0.0, 1.0]), ("red", 0.5, [0.6, 0.02, 0.05, 1.0])];
    let layers = layers.iter().enumerate().map(|(i, &(name, width, color))| {
        let mut layer = Layer::new(Pen { number: i + 1, name: name.into(), width, color });
        let place = |r: &mut Random| DVec2::new(r.between(-1.0, page.size.x + 1.0), r.between(-1.0, page.size.y + 1.0));
        let opacity = |r: &mut Random| if opaque || r.once_in(2) { 1.0 } else { r.unit() };
        for _ in 0..1500 {
            let (at, radius, opacity) = (place(r), r.between(0.05, 0.4), opacity(r));
            layer.dots.push(Dot { at, world: DVec3::new(r.unit(), 1.0, 2.0), radius, opacity });
        }
        for i in 0..60 {
            let closed = i % 2 == 1;
            // Of every three lines one is tapered.
            let taper = if i % 3 == 0 { 0.2 } else { 1.0 };
            let (at, radius, opacity) = (place(r), r.between(0.05, 0.25), opacity(r));
            let vertex = |k: usize| Vertex {
                at: at + DVec2::new(2.0 * k as f64, r.between(0.0, 3.0)),
                world: DVec3::ZERO,
                radius: if k == 0 || k == 5 { taper * radius } else { radius },
                opacity,
                t: k as f64 / 5.0,
                color: None,
            };
            layer.lines.push(Polyline { vertices: (0..6).map(vertex).collect(), closed });
        }
        layer
    });
    let mut marks = Marks { page, layers: layers.collect() };
    marks.settle();
    marks
}

/// The sheet of marks on white paper.
pub(crate) fn sheet<'a>(marks: &'a Marks, provenance: &'a Provenance) -> VectorPage<'a> {
    VectorPage { marks, background: None, picture: None, plotter: false, beziers: false, outlined: false, provenance }
}

/// Circles and waves of radii from 1 to 20 mm, of one width or tapered, in chords that are at most so many mm beside them, on the
/// same paper.
pub(crate) fn curves(chord: f64) -> Marks {
    let page = Page::in_millimetres(DVec2::new(101.6, 76.2), 0.0, 300.0);
    let mut layer = Layer::new(Pen { number: 1, name: "black".into(), width: 0.3, color: [0.0, 0.0, 0.0, 1.0] });
    let mut line = |closed: bool, radius: f64, tapered: bool, length: f64, at: &dyn Fn(f64) -> DVec2| {
        let n = (length / (8.0 * chord * radius).sqrt()).ceil();
        let vertex = |i: usize| {
            let t = i as f64 / n;
            let taper = if tapered { 1.0 - t } else { 1.0 };
            Vertex { at: at(t), world: DVec3::ZERO, radius: 0.15 * taper, opacity: 1.0, t, color: None }
        };
        layer.lines.push(Polyline { vertices: (0..n as usize + usize::from(!closed)).map(vertex).collect(), closed });
    };
    let turn = |angle: f64, radius: f64| radius * DVec2::from_angle(angle);
    for radius in [1.0, 2.0, 3.5, 5.0, 8.0, 12.0, 20.0] {
        line(true, radius, false, TAU * radius, &|t| DVec2::new(40.0, 38.0) + turn(TAU * t, radius));
        let around = DVec2::new(70.0 + radius, 30.0);
        line(false, radius, true, 3.0 * radius, &|t| around + turn(2.0 + 3.0 * t, radius));
        // The steepest way of sin is √2 long, and its sharpest bend has the radius.
        let wave = |t: f64| DVec2::new(5.0 + 60.0 * t, 62.0 + radius / 2.0 + radius * (60.0 * t / radius).sin());
        line(false, radius, false, 60.0 * 2f64.sqrt(), &wave);
    }
    let mut marks = Marks { page, layers: vec![layer] };
    marks.settle();
    marks
}

/// Our own picture of it, as it is in a PNG whose encoded values are blended.
pub(crate) fn picture(marks: &Marks, folder: &Path) -> Codes {
    let mut picture = blank(&marks.page, Some([1.0; 4])).unwrap();
    paint(marks, &PageWindow::page(&marks.page), BlendSpace::Srgb, &mut picture).unwrap();
    let path = folder.join("ours.png");
    write_png(&picture, 8, &Provenance::default(), &path).unwrap();
    Codes::of_png(&path)
}
