//! Tone: what dots cover, `k_max = "auto"`, and the inverse of a step wedge ([STIP-17]).

use super::{drawn_from, params, table};
use crate::common;
use drypoint::output::paint::{PageWindow, blank, paint};
use drypoint::reference::volume_stippling::{FrameDots, FrameInputs, Frames, PenTone, Preprocess};
use drypoint::scene::counts::Counts;
use drypoint::scene::glam::{DVec2, DVec3};
use drypoint::scene::marks::{Dot, Layer, Marks, Page, Pen};
use drypoint::scene::philox;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::shot::StippleParams;
use drypoint::scene::tables::{BlendSpace, Camera, Ink, Length, PointsPerPixel, Projection, Stipples, Threshold};
use drypoint::scene::tone::Tone;
use drypoint::scene::view::View;
use drypoint::wedge::{StepWedge, WedgePatch, wedge};
use std::f64::consts::{PI, TAU};

fn pen(width: f64) -> Pen {
    Pen { number: 1, name: "black".into(), width, color: [0.0, 0.0, 0.0, 1.0] }
}

/// The share of a square of the page that marks cover, by their pixels.
fn coverage(marks: &Marks, corner: DVec2, side: f64) -> f64 {
    let mut picture = blank(&marks.page, None).unwrap();
    paint(marks, &PageWindow::page(&marks.page), BlendSpace::Linear, &mut picture).unwrap();
    let alpha = &picture.layer(LayerKind::Beauty).unwrap().channels[3];
    let scale = marks.page.pixels_per_mm();
    let [x0, y0] = (corner * scale).to_array().map(|x| x.ceil() as usize);
    let [x1, y1] = ((corner + side) * scale).to_array().map(|x| x.floor() as usize);
    let rows = (y0..y1).map(|y| alpha[y * picture.width + x0..y * picture.width + x1].iter().sum::<f64>());
    rows.sum::<f64>() / ((x1 - x0) * (y1 - y0)) as f64
}

/// What the inner part of each patch covers when the pen draws dots so many times as wide: an outline is drawn apart.
fn measured(wedge: &StepWedge, gain: f64) -> Vec<(WedgePatch, f64)> {
    let mut marks = wedge.marks.clone();
    let layer = &mut marks.layers[0];
    layer.lines.clear();
    layer.dots.iter_mut().for_each(|dot| dot.radius *= gain);
    wedge
        .patches
        .iter()
        .map(|patch| {
            // A window that moves with the patch is a smaller picture.
            let inner = patch.side - 2.0;
            let page = Page::in_millimetres(DVec2::splat(inner), 0.0, 1200.0);
            let shift = patch.corner + 1.0;
            let near = |dot: &&Dot| {
                let o = dot.at - shift;
                o.min_element() > -1.0 && o.max_element() < inner + 1.0
            };
            let moved = layer.dots.iter().filter(near).map(|dot| Dot { at: dot.at - shift, ..*dot }).collect();
            let marks = Marks { page, layers: vec![Layer { dots: moved, ..Layer::new(layer.pen.clone()) }] };
            (*patch, coverage(&marks, DVec2::ZERO, inner))
        })
        .collect()
}

/// What is wanted is what discs cover: to 0.02; and every patch lies between random dots and dots that do not overlap.
#[test]
fn discs_print_the_tone_that_is_wanted() {
    let page = Page::in_millimetres(DVec2::ONE, 0.0, 300.0);
    let wedge = wedge(&pen(0.3), &Tone::ideal(), &page, 1).unwrap();
    for (patch, covered) in measured(&wedge, 1.0) {
        let ink = Tone::ideal().ink(patch.wanted);
        println!("wanted {:.2}: {covered:.3}, λa = {ink:.3}", patch.wanted);
        assert!((covered - patch.wanted).abs() <= 0.02, "{}: {covered}", patch.wanted);
        // A patch has its dots to one in its border's square root: a hundredth of λa.
        assert!(
            covered >= 1.0 - (-0.99 * ink).exp() && covered <= (1.01 * ink).min(1.0),
            "{}: {covered}",
            patch.wanted
        );
    }
}

/// A pen whose dots spread to 1.2 times its nib, measured on a wedge, prints the wanted tones with the inverse.
#[test]
fn the_inverse_of_a_measured_wedge_prints_what_is_wanted() {
    let page = Page::in_millimetres(DVec2::ONE, 0.0, 300.0);
    let first = wedge(&pen(0.3), &Tone::ideal(), &page, 1).unwrap();
    let found = measured(&first, 1.2);
    let off = found.iter().map(|(patch, covered)| (covered - patch.wanted).abs()).fold(0.0, f64::max);
    assert!(off > 0.1, "there is something to correct: {off}");
    let rows: Vec<[f64; 2]> = found.iter().map(|(patch, covered)| [patch.wanted, *covered]).collect();
    let tone = Tone::from_rows(&rows).unwrap();
    for (patch, covered) in measured(&wedge(&pen(0.3), &tone, &page, 2).unwrap(), 1.2) {
        println!("wanted {:.2}: {covered:.3}", patch.wanted);
        assert!((covered - patch.wanted).abs() <= 0.02, "{}: {covered}", patch.wanted);
    }
}

/// What draws.
#[derive(Clone, Copy, PartialEq)]
enum With {
    /// Dots of any size.
    Discs,
    /// A pen with a nib of their size.
    Pen,
    /// The same with a table that says what discs print.
    Table,
}

/// What an edge `width` voxels wide prints where n faces the eye, all factors 1.
fn face(n: DVec3, width: f64, thin: bool, with: With) -> f64 {
    let volume = common::volume([40; 3], |p| {
        let t = ((DVec3::splat(19.63) - p).dot(n) / (0.5 * width)).clamp(-1.0, 1.0);
        t * (3.0 - t * t)
    });
    // 20 pixels a voxel, of which 10 are seen across.
    let projection = Projection::Orthographic { height: Some(Length::World(10.0)) };
    let camera = Camera { projection, direction: -n, direction_given: true, ..Camera::default() };
    let view = View::new(&camera, volume.grid(), [200, 200]).unwrap();
    let page = Page::in_pixels(view.size, 0.0, 254.0);
    let (tone, size) = (Tone::ideal(), 0.5);
    let dot = 0.25 * PI * (size * page.pixels_per_mm()).powi(2);
    let stipples = Stipples {
        k_max: PointsPerPixel::Auto,
        threshold: Threshold::Magnitude(0.3),
        thin,
        ink: Ink::Opaque,
        ..Stipples::default()
    };
    let table = table();
    let params = StippleParams { dot_area: dot, ..params(&stipples, &table, volume.grid(), &view) };
    let preprocess = Preprocess::new(params, &volume, Some(&tone)).unwrap();
    let mut points = preprocess.points(&mut Counts::default(), &|_| {}).unwrap();
    if with != With::Discs {
        // A pen's dots are as many as the ink of the sizes that they should have.
        points.voxels.iter_mut().for_each(|voxel| voxel.magnitude = 1.0);
    }
    let frames = Frames::new(FrameInputs {
        nib: (with != With::Discs).then_some(size),
        tone: (with == With::Table).then_some(PenTone { tone: &tone, ink: preprocess.ink, layers: preprocess.layers }),
        ..drawn_from(&stipples, &points, volume.grid(), &view, size)
    });
    let mut drawn = FrameDots::default();
    frames.draw(&view, &page, &mut drawn);
    // The ink of dots of ‖∇V‖ below 1 is less: all are as large as the largest here, so that their number is what is seen.
    let dots = drawn.dots().map(|d| Dot { radius: 0.5 * size, ..*d }).collect();
    let marks = Marks { page, layers: vec![Layer { dots, ..Layer::new(pen(size)) }] };
    coverage(&marks, DVec2::splat(2.0), 16.0)
}

/// With all factors 1 a pen prints what discs of its nib do, and a table that says nothing new changes nothing.
#[test]
fn a_table_of_what_discs_print_changes_nothing_at_full_tone() {
    for n in [DVec3::Z, DVec3::new(1.0, 2.0, 3.0).normalize()] {
        let [discs, pen, table] = [With::Discs, With::Pen, With::Table].map(|with| face(n, 2.0, true, with));
        assert!((pen - discs).abs() < 1e-3 && (table - pen).abs() < 1e-3, "{discs} {pen} {table}");
    }
}

#[test]
fn a_face_is_as_dark_at_every_orientation() {
    for (width, thin) in [(1.0, true), (4.0, true), (1.0, false), (2.0, false), (4.0, false)] {
        let mut found = Vec::new();
        for i in 0..20 {
            let [u, v, ..] = philox::uniforms(11, [i, 0, 0], 0);
            let (z, turn) = (2.0 * u - 1.0, TAU * v);
            let r = (1.0 - z * z).sqrt();
            let n = if i == 0 { DVec3::Z } else { DVec3::new(r * turn.cos(), r * turn.sin(), z).normalize() };
            found.push(face(n, width, thin, With::Discs));
        }
        let (least, most) = found.iter().fold((1.0f64, 0.0f64), |(a, b), &x| (a.min(x), b.max(x)));
        let mean = found.iter().sum::<f64>() / 20.0;
        println!("{width} voxels, thin {thin}: {mean:.3}, {least:.3} to {most:.3}");
        assert!((most - least) / mean <= 0.1, "{width} voxels, thin {thin}: {least} to {most}");
        // Half of what the spread may be.
        assert!((mean - 0.9).abs() < 0.05, "{width} voxels, thin {thin}: {mean}");
    }
}
