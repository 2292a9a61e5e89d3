//! The preset `stipple` as a drawing: its tone is that of the light alone, nothing behind the surface is drawn, and its
//! outer edge is closed ([STIP-20], [STIP-21]).

use crate::common;
use drypoint::job::{Job, RenderTarget};
use drypoint::marking::Marking;
use drypoint::output::paint::{PageWindow, blank, paint};
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::glam::{DVec2, DVec3};
use drypoint::scene::marks::{Layer, Marks};
use drypoint::scene::picture::LayerKind;
use drypoint::scene::source::Disk;
use drypoint::scene::tables::BlendSpace;
use drypoint::scene::tone::{FULL, Tone};
use drypoint::scene::volume::Volume;
use std::f64::consts::TAU;
use std::path::Path;
use std::sync::Arc;

/// Millimetres of the page to a voxel.
const SCALE: f64 = 80.0 / 48.0;

/// The preset's light, towards the upper left.
fn light() -> DVec3 {
    DVec3::new(-1.0, 1.5, 1.2).normalize()
}

/// The page of a volume of 48³ voxels, seen along a direction.
fn page(volume: Volume, direction: &str) -> Marks {
    let text = format!(
        "drypoint = 1\npreset = \"stipple\"\n[volume]\nfile = \"test.nrrd\"\n\
         [camera]\nprojection = \"orthographic\"\nheight = 48\ndirection = {direction}\nup = [0, 0, 1]\n\
         [picture]\nwidth = \"80 mm\"\nheight = \"80 mm\"\ndpi = 300\n"
    );
    // The surface is f = 0 exactly, not nearly as one that is found.
    let iso = ["stipples.iso", "stipples.hide_behind", "outlines.iso"].map(|key| (key, "0"));
    let scene = parse(&text, Path::new("test.toml"), &Overrides::from_iter(iso)).unwrap();
    let job = Job::with_volume_for(scene, volume, RenderTarget::Points, Arc::new(Disk)).unwrap();
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_| ()).unwrap();
    marking.frames(&mut counts).unwrap().draw(&job.view().unwrap(), &mut counts).unwrap()
}

/// The light that dots leave out, for every pixel of the page.
struct Coverage {
    width: usize,
    alpha: Vec<f64>,
    per_mm: f64,
}

impl Coverage {
    fn of(marks: &Marks) -> Self {
        let layers = marks.layers.iter().map(|l| Layer { dots: l.dots.clone(), ..Layer::new(l.pen.clone()) }).collect();
        let dots = Marks { page: marks.page, layers };
        let mut picture = blank(&dots.page, None).unwrap();
        paint(&dots, &PageWindow::page(&dots.page), BlendSpace::Linear, &mut picture).unwrap();
        let alpha = picture.layer(LayerKind::Beauty).unwrap().channels[3].clone();
        Self { width: picture.width, alpha, per_mm: dots.page.pixels_per_mm() }
    }

    /// The mean over the pixels within `r` mm of a place.
    fn around(&self, at: DVec2, r: f64) -> f64 {
        let [lo, hi] = [at - r, at + r].map(|p| (p * self.per_mm).to_array().map(|x| x.max(0.0) as usize));
        let (mut sum, mut count) = (0.0, 0.0f64);
        for y in lo[1]..=hi[1] {
            for x in lo[0]..=hi[0] {
                let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) / self.per_mm;
                if p.distance(at) <= r && x < self.width {
                    sum += self.alpha.get(y * self.width + x).copied().unwrap_or(0.0);
                    count += 1.0;
                }
            }
        }
        sum / count.max(1.0)
    }
}

/// The coverage that the preset asks for where the light falls at an angle: T = ¾(1 − L·n) of the ink of a full tone.
fn wanted(lit: f64) -> f64 {
    let tone = Tone::ideal();
    tone.coverage_of_layers(0.75 * (1.0 - lit.max(0.0)) * tone.ink_of_layers(FULL, 1.0), 1.0)
}

const RADIUS: f64 = 18.0;

/// Radius in mm of the windows in which a ball's tone is measured: a hundred dots or more in the shade.
const WINDOW: f64 = 2.0;

fn ball() -> Volume {
    let centre = DVec3::splat(23.5);
    common::volume([48; 3], |p| (RADIUS - p.distance(centre)).clamp(-3.0, 3.0))
}

#[test]
fn a_ball_is_shaded_by_its_light_alone() {
    let marks = page(ball(), "[0, 1, 0]");
    let covered = Coverage::of(&marks);
    let middle = DVec2::splat(40.0);
    let (mut darkest, mut rows) = (0.0f64, Vec::new());
    for i in -32..=32 {
        for j in -32..=32 {
            let off = DVec2::new(f64::from(i), f64::from(j));
            let share = off / (RADIUS * SCALE);
            if share.length() > 1.0 - WINDOW / (RADIUS * SCALE) {
                continue;
            }
            let n = DVec3::new(share.x, -share.y, (1.0 - share.length_squared()).sqrt());
            let found = covered.around(middle + off, WINDOW);
            darkest = darkest.max(found);
            rows.push((n.dot(light()), found));
        }
    }
    // No place is darker than a full tone, beyond which the last gaps close.
    assert!(darkest < FULL, "{darkest}");
    // The mean tone at each angle of the light: as wanted, and falling.
    let mut last = 1.0;
    for k in 0..10 {
        let (lo, hi) = (0.1 * f64::from(k), 0.1 * f64::from(k + 1));
        let bin: Vec<(f64, f64)> = rows.iter().copied().filter(|(lit, _)| (lo..hi).contains(lit)).collect();
        let mean = bin.iter().map(|(_, found)| found).sum::<f64>() / bin.len() as f64;
        let asked = bin.iter().map(|(lit, _)| wanted(*lit)).sum::<f64>() / bin.len() as f64;
        println!("L·n from {lo:.1}: {mean:.3}, wanted {asked:.3}, {} windows", bin.len());
        assert!(mean < last, "{lo}: {mean} after {last}");
        assert!((mean - asked).abs() < 0.05, "{lo}: {mean}, not {asked}");
        last = mean;
    }
}

#[test]
fn nothing_behind_is_drawn_and_the_outer_edge_is_closed() {
    let marks = page(ball(), "[0, 1, 0]");
    let dots: Vec<_> = marks.layers.iter().flat_map(|layer| &layer.dots).collect();
    assert!(dots.len() > 1000, "{}", dots.len());
    let centre = DVec3::splat(23.5);
    for dot in &dots {
        let n = dot.world - centre;
        // On the surface, and on its front but for the offset of the visibility test.
        assert!((n.length() - RADIUS).abs() < 0.1, "{}", n.length());
        assert!(-n.y / RADIUS > -(2.0f64 * 0.15 / RADIUS).sqrt(), "{n}");
    }
    // Arcs of the circle that the lines' segments pass, in steps of 0.05 mm.
    let middle = DVec2::splat(40.0);
    let steps = (TAU * RADIUS * SCALE / 0.05) as usize;
    let mut is_drawn = vec![false; steps];
    let step = |at: DVec2| ((at - middle).y.atan2((at - middle).x).rem_euclid(TAU) / TAU * steps as f64) as usize;
    for line in marks.layers.iter().flat_map(|layer| &layer.lines) {
        let next = line.vertices.iter().skip(1).chain(line.vertices.first().filter(|_| line.closed));
        for (a, b) in line.vertices.iter().zip(next) {
            assert!((a.at.distance(middle) - RADIUS * SCALE).abs() < 0.3, "{}", a.at - middle);
            let [a, b] = [a.at, b.at].map(step);
            let turn = (b + steps - a) % steps;
            let (from, length) = if turn <= steps / 2 { (a, turn) } else { (b, steps - turn) };
            (from..=from + length).for_each(|i| is_drawn[i % steps] = true);
        }
    }
    let first = is_drawn.iter().position(|drawn| *drawn).unwrap();
    is_drawn.rotate_left(first);
    let longest = is_drawn.split(|drawn| *drawn).map(<[bool]>::len).max().unwrap_or(0);
    assert!(0.05 * longest as f64 <= 1.0, "{longest} steps of {steps}");
}

/// A box over a corner: each face has one tone, that of its angle to the light, however far it turns away.
#[test]
fn faces_of_a_box_have_even_tones() {
    let half = DVec3::new(14.0, 10.0, 12.0);
    let volume = common::volume([48; 3], |p| (half - (p - 23.5).abs()).min_element().clamp(-3.0, 3.0));
    let direction = DVec3::new(0.75, 1.0, -0.6);
    let marks = page(volume, "[0.75, 1, -0.6]");
    let covered = Coverage::of(&marks);
    let forward = direction.normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    let on_page = |p: DVec3| DVec2::splat(40.0) + DVec2::new(p.dot(right), -p.dot(up)) * SCALE;
    for (n, sides) in [
        (DVec3::NEG_X, [DVec3::Y * half.y, DVec3::Z * half.z]),
        (DVec3::NEG_Y, [DVec3::X * half.x, DVec3::Z * half.z]),
        (DVec3::Z, [DVec3::X * half.x, DVec3::Y * half.y]),
    ] {
        let in_eye = DVec3::new(n.dot(right), n.dot(up), -n.dot(forward));
        let asked = wanted(in_eye.dot(light()));
        // Windows on a lattice over the inner part of the face.
        let steps = || (-2..=2).map(|k| 0.3 * f64::from(k));
        let places = steps().flat_map(|a| steps().map(move |b| n * half + sides[0] * a + sides[1] * b));
        let found: Vec<f64> = places.map(|p| covered.around(on_page(p), 1.5)).collect();
        let mean = found.iter().sum::<f64>() / found.len() as f64;
        let off = found.iter().map(|x| (x - mean).abs()).fold(0.0, f64::max);
        println!("{n}: n·E {:.2}, {mean:.3} ± {off:.3}, wanted {asked:.3}", in_eye.z);
        assert!((mean - asked).abs() < 0.05, "{n}: {mean}, not {asked}");
        assert!(off < 0.1, "{n}: {off}");
    }
}
