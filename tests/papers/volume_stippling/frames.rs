//! What a frame draws of the points ([STIP-5] … [STIP-12], hard cases).

use super::{drawn_from, orthographic, params, table};
use crate::common;
use drypoint::reference::volume_stippling::{FrameDots, FrameInputs, Frames, Preprocess, viewing_distance};
use drypoint::scene::blue_noise;
use drypoint::scene::counts::Counts;
use drypoint::scene::glam::{DVec2, DVec3};
use drypoint::scene::marks::{Dot, Page};
use drypoint::scene::points::{PointVoxel, Points};
use drypoint::scene::tables::{
    Boundary, Camera, Distance, Ink, Interior, LightDirection, Lighting, Orbit, Resolution, Silhouette, Stipples,
};
use drypoint::scene::view::View;
use drypoint::scene::volume::Volume;
use std::collections::{BTreeMap, BTreeSet};

const SIZE: f64 = 0.5;

/// A ball, its points, and what frames are drawn of.
struct Shown {
    volume: Volume,
    points: Points,
    reference: View,
}

impl Shown {
    fn new() -> Self {
        let volume = common::ball(21, 7.0);
        let camera = Camera { direction: DVec3::new(0.2, 1.0, -0.3), ..Camera::default() };
        let reference = View::new(&camera, volume.grid(), [200, 200]).unwrap();
        let (stipples, table) = (Stipples::default(), table());
        let points = Preprocess::new(params(&stipples, &table, volume.grid(), &reference), &volume, None)
            .unwrap()
            .points(&mut Counts::default(), &|_| {})
            .unwrap();
        Self { volume, points, reference }
    }

    fn draw(&self, stipples: &Stipples, view: &View, nib: Option<f64>) -> Vec<Dot> {
        let inputs = drawn_from(stipples, &self.points, self.volume.grid(), &self.reference, SIZE);
        let frames = Frames::new(FrameInputs { nib, ..inputs });
        let mut drawn = FrameDots::default();
        frames.draw(view, &page(view), &mut drawn);
        drawn.to_vec()
    }

    /// E at a voxel's centre.
    fn eye(&self, view: &View, voxel: &PointVoxel) -> DVec3 {
        (view.eye - self.points.grid.to_world(voxel.centre())).normalize()
    }

    /// Compares the ink of a frame, voxel by voxel, with N_max·T and S_max·‖∇V‖·(the factors that sizes have).
    fn check(&self, stipples: &Stipples, view: &View, wanted: impl Fn(&PointVoxel) -> [f64; 2]) {
        let dots = self.draw(stipples, view, None);
        let mut rest = &dots[..];
        for voxel in &self.points.voxels {
            let [t, size] = wanted(voxel);
            let n = self.points.each as f64 * t;
            let here;
            (here, rest) = rest.split_at(n.ceil() as usize);
            let ink: f64 = here.iter().map(|dot| dot.opacity).sum();
            assert!((ink - n).abs() < 1e-9, "{voxel:?}: {ink}, not {n}");
            let diameter = SIZE * voxel.magnitude * size;
            assert!(here.iter().all(|dot| (2.0 * dot.radius - diameter).abs() < 1e-12), "{voxel:?}");
        }
        assert!(rest.is_empty());
    }
}

fn page(view: &View) -> Page {
    Page::in_pixels(view.size, 3.0, 254.0)
}

fn from_afar(shown: &Shown, times: f64) -> View {
    let centre = shown.volume.grid().centre();
    let reference = &shown.reference;
    View { eye: centre + (reference.eye - centre) * times, ..reference.clone() }
}

#[test]
fn without_factors_every_point_is_drawn() {
    let shown = Shown::new();
    shown.check(&Stipples::default(), &shown.reference, |_| [1.0, 1.0]);
}

#[test]
fn each_factor_alone() {
    let shown = Shown::new();
    let view = &shown.reference;
    let none = Stipples::default;
    let b = Boundary { gc: 0.2, gs: 0.5, ge: 1.5 };
    shown.check(&Stipples { boundary: Some(b), ..none() }, view, |v| {
        [v.value * (0.2 + 0.5 * v.magnitude.powf(1.5)), 1.0]
    });
    let s = Silhouette { sc: 0.1, ss: 0.8, se: 1.11, literal: false };
    shown.check(&Stipples { silhouette: Some(s), ..none() }, view, |v| {
        let facing = v.normal.dot(shown.eye(view, v)).abs();
        [v.value * (0.1 + 0.8 * (1.0 - facing).max(0.0).powf(1.11)), 1.0]
    });
    let d = Distance { de: 1.5 };
    let centre = shown.volume.grid().centre();
    shown.check(&Stipples { distance: Some(d), ..none() }, view, |v| {
        let z = -view.forward.dot(shown.points.grid.to_world(v.centre()) - centre) / shown.volume.grid().radius();
        let t = 0.5 * (1.0 + z.signum() * z.abs().powf(1.5));
        [t, t]
    });
    let i = Interior { te: 0.5 };
    shown.check(&Stipples { interior: Some(i), ..none() }, view, |v| [v.magnitude.sqrt(), v.magnitude.sqrt()]);
    let l = Lighting { le: 2.7, light: Some(LightDirection::World(DVec3::new(0.0, 0.0, 3.0))) };
    shown.check(&Stipples { lighting: Some(l), ..none() }, view, |v| {
        let faces = v.normal.dot(shown.eye(view, v)) >= 0.0;
        [if faces { 1.0 - v.normal.z.max(0.0).powf(2.7) } else { 0.0 }, 1.0]
    });
    let r = Resolution { re: 1.1, reference: None };
    let twice = from_afar(&shown, 2.0);
    shown.check(&Stipples { resolution: Some(r), ..none() }, &twice, |_| [0.5f64.powf(1.1), 0.5f64.powf(1.1)]);
}

/// With k_re = 2 dots per screen area stay equal as the volume goes away, and ink goes with their size.
#[test]
fn resolution_keeps_the_density_on_the_page() {
    let shown = Shown::new();
    let stipples = Stipples { resolution: Some(Resolution { re: 2.0, reference: None }), ..Stipples::default() };
    let count = |times| shown.draw(&stipples, &from_afar(&shown, times), None).iter().map(|d| d.opacity).sum::<f64>();
    let distance = |times| viewing_distance(&from_afar(&shown, times), shown.volume.grid().centre(), 0.5);
    let ratio = (distance(1.0) / distance(3.0)).powi(2);
    assert!((count(3.0) / count(1.0) - ratio).abs() < 1e-9);
    assert_eq!(count(0.9), count(1.0));
}

/// T_r = (D₀/D)^k scales the dots of a voxel by T_r and their areas by T_r². The page of a volume shrinks by (D₀/D)².
/// So dots per screen area go as D^(2 − k), and ink per screen area as D^(2 − 3k) ([STIP-9]).
#[test]
fn exponents_of_density_and_ink_over_distance() {
    let shown = Shown::new();
    let distance = |times: f64| viewing_distance(&from_afar(&shown, times), shown.volume.grid().centre(), 0.5);
    for k in [1.1, 2.0, 2.0 / 3.0] {
        let stipples = Stipples { resolution: Some(Resolution { re: k, reference: None }), ..Stipples::default() };
        // Logarithms of the distance, of dots and of ink per screen area.
        let rows = [1.0, 2.0, 4.0].map(|times| {
            let view = from_afar(&shown, times);
            let dots = shown.draw(&stipples, &view, None);
            let middle = dots.iter().map(|dot| dot.at).sum::<DVec2>() / dots.len() as f64;
            // The mean square distance from the middle is a measure of the area that needs no outline.
            let number: f64 = dots.iter().map(|dot| dot.opacity).sum();
            let area: f64 = dots.iter().map(|dot| dot.opacity * (dot.at - middle).length_squared()).sum();
            let ink: f64 = dots.iter().map(|dot| dot.opacity * dot.radius * dot.radius).sum();
            let area = area / number;
            [distance(times).ln(), (number / area).ln(), (ink / area).ln()]
        });
        let slope = |i: usize| (rows[2][i] - rows[0][i]) / (rows[2][0] - rows[0][0]);
        println!("k_re {k:.2}: dots {:.3}, ink {:.3}", slope(1), slope(2));
        // The near camera sees the front of the ball larger than its back.
        assert!((slope(1) - (2.0 - k)).abs() < 0.1, "k_re {k}: dots {}", slope(1));
        assert!((slope(2) - (2.0 - 3.0 * k)).abs() < 0.1, "k_re {k}: ink {}", slope(2));
    }
}

#[test]
fn dots_lie_where_the_camera_sees_their_points() {
    let shown = Shown::new();
    for view in [shown.reference.clone(), orthographic(&shown.volume, 2.0)] {
        let dots = shown.draw(&Stipples::default(), &view, None);
        assert_eq!(dots.len(), shown.points.len());
        for dot in dots {
            let eye = view.to_eye(dot.world);
            let depth = if view.perspective { -eye.z } else { 1.0 };
            let size = DVec2::from(view.size.map(|n| n as f64));
            let pixel = size / 2.0 + DVec2::new(eye.x, -eye.y) / (depth * view.pixel);
            assert!((dot.at - page(&view).place(pixel, view.size)).length() < 1e-9);
        }
    }
}

/// N_i of a voxel under that silhouette factor, by hand.
fn wanted(shown: &Shown, view: &View, voxel: &PointVoxel, silhouette: Silhouette) -> f64 {
    let facing = voxel.normal.dot(shown.eye(view, voxel)).abs();
    let factor = voxel.value * (silhouette.sc + silhouette.ss * (1.0 - facing).max(0.0).powf(silhouette.se));
    shown.points.each as f64 * factor.min(1.0)
}

/// From frame to frame the drawn set of a voxel is a prefix of its list: the symmetric difference of two frames has
/// Σ|⌊N_i + u⌋ − ⌊N′_i + u⌋| points in opaque ink, whose counts are worked out by hand, and no point moves.
#[test]
fn turning_the_camera_adds_and_takes_points_and_moves_none() {
    let shown = Shown::new();
    let silhouette = Silhouette { sc: 0.1, ss: 0.9, se: 1.0, literal: false };
    let bits = |p: DVec3| p.to_array().map(f64::to_bits);
    let camera = Camera { direction: DVec3::new(0.2, 1.0, -0.3), ..Camera::default() };
    let orbit = Orbit { frames: 36, degrees: 360.0, ..Orbit::default() };
    let views = [0, 1, 2].map(|frame| orbit.view(&shown.reference, &camera, shown.volume.grid(), frame));
    for ink in [Ink::Opaque, Ink::Fade] {
        let stipples = Stipples { ink, silhouette: Some(silhouette), ..Stipples::default() };
        let frames = views.each_ref().map(|view| {
            let dots = shown.draw(&stipples, view, None);
            let drawn: BTreeMap<[u64; 3], f64> = dots.iter().map(|dot| (bits(dot.world), dot.opacity)).collect();
            assert_eq!(drawn.len(), dots.len(), "two points at one place");
            drawn
        });
        let (mut differences, mut changes) = ([0; 2], [0.0; 2]);
        for (i, voxel) in shown.points.voxels.iter().enumerate() {
            let list: Vec<[u64; 3]> = shown
                .points
                .of(i)
                .iter()
                .map(|o| bits(shown.points.grid.to_world(voxel.centre() + super::wide(*o))))
                .collect();
            let n = views.each_ref().map(|view| wanted(&shown, view, voxel, silhouette));
            // What is drawn whole, and the opacity of the one that fades.
            let count = n.map(|n| match ink {
                Ink::Opaque => ((n + blue_noise::at(voxel.cell)).floor().min(list.len() as f64), 0.0),
                Ink::Fade => (n.floor(), n - n.floor()),
            });
            for (drawn, (whole, fading)) in frames.iter().zip(count) {
                for (k, point) in list.iter().enumerate() {
                    let expected = if (k as f64) < whole {
                        1.0
                    } else if k as f64 == whole {
                        fading
                    } else {
                        0.0
                    };
                    let found = drawn.get(point).copied().unwrap_or(0.0);
                    // Two sums of N_i by different ways: some ulps of numbers below 100.
                    assert!((found - expected).abs() < 1e-12, "{voxel:?}, point {k}: {found}, not {expected}");
                }
            }
            for step in 0..2 {
                differences[step] += (count[step].0 - count[step + 1].0).abs() as usize;
                changes[step] += (n[step] - n[step + 1]).abs();
            }
        }
        for step in 0..2 {
            let (one, other) = (&frames[step], &frames[step + 1]);
            let in_either: BTreeSet<_> = one.keys().chain(other.keys()).collect();
            let opacity = |drawn: &BTreeMap<[u64; 3], f64>, at: &[u64; 3]| drawn.get(at).copied().unwrap_or(0.0);
            match ink {
                Ink::Opaque => {
                    let apart =
                        in_either.iter().filter(|at| one.contains_key(**at) != other.contains_key(**at)).count();
                    assert!(apart > 0);
                    assert_eq!(apart, differences[step]);
                }
                // Ink comes and goes by Σ|N_i − N′_i|, no dot by more than the change of its voxel.
                Ink::Fade => {
                    let change: f64 = in_either.iter().map(|at| (opacity(one, at) - opacity(other, at)).abs()).sum();
                    assert!(change > 0.0 && (change - changes[step]).abs() < 1e-8, "{change}, not {}", changes[step]);
                }
            }
        }
    }
}

/// A pen has one size; the ink stays.
#[test]
fn a_nib_keeps_the_ink() {
    let shown = Shown::new();
    let stipples = Stipples { boundary: Some(Boundary { gc: 0.1, gs: 0.2, ge: 1.0 }), ..Stipples::default() };
    let ink = |dots: &[Dot]| dots.iter().map(|d| d.opacity * d.radius * d.radius).sum::<f64>();
    let free = shown.draw(&stipples, &shown.reference, None);
    for nib in [0.6, 0.3, 0.1] {
        let drawn = shown.draw(&stipples, &shown.reference, Some(nib));
        assert!((ink(&drawn) / ink(&free) - 1.0).abs() < 1e-9, "{nib}");
        assert!(drawn.iter().all(|d| d.radius >= 0.5 * nib - 1e-12));
    }
}

#[test]
fn an_eye_in_the_volume_sees_what_lies_before_it() {
    let shown = Shown::new();
    let eye = shown.volume.grid().centre() + DVec3::new(6.0, 0.0, 0.0);
    let camera = Camera { eye: Some(eye), direction: DVec3::NEG_X, direction_given: true, ..Camera::default() };
    let view = View::new(&camera, shown.volume.grid(), [200, 100]).unwrap();
    let stipples = Stipples {
        boundary: Some(Boundary::default()),
        silhouette: Some(Silhouette::default()),
        resolution: Some(Resolution::default()),
        distance: Some(Distance { de: -1.0 }),
        interior: Some(Interior { te: 0.0 }),
        lighting: Some(Lighting { le: 1.0, light: None }),
        ..Stipples::default()
    };
    let dots = shown.draw(&stipples, &view, None);
    assert!(!dots.is_empty());
    for dot in dots {
        assert!(dot.at.is_finite() && dot.radius > 0.0 && dot.opacity > 0.0 && dot.opacity <= 1.0);
        assert!(-view.to_eye(dot.world).z >= 0.5);
    }
}
