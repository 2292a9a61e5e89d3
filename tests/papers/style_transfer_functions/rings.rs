//! Contours in pictures: their width ([STF-7]) and what they show ([STF-8]).
//!
//! The first sample in an opaque ball lies between the surface and Δ under it. With exact κ = 1/r at radius r, contour is
//! |N·v| ≤ √(x(2 − x)), x = T/r: all of ρ ≥ r − T. So the ring reaches T inwards from where r = R, and farther by what a
//! view through Δ of depth adds, Δ√(x(2 − x)) with x = min(1, (T + Δ)/R); rays between two planes miss up to Δ²/8R of
//! the outermost. With κ along the ray, dN/ds = sinθ/r, the rim 1 − Tκ sinθ = sinθ lies at R²/(R + T): TR/(R + T) wide.
//! There a sample under the surface has a smaller turn too, so the term Δ√(x(2 − x)) can be missing as well as be added.
//! A row of pixels counts a width to one pixel.

use super::{planes, smooth};
use crate::common::strip::{ramp, strip};
use crate::common::{Stage, ball, orthographic, plain, style, volume};
use drypoint::scene::glam::DVec3;
use drypoint::scene::phantom;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Contours, HessianEstimator, Kappa, Kernel, Length, Number};
use drypoint::scene::volume::{Volume, VoxelType};

/// Opaque from the surface at a value inwards, in the style that shows where it is looked up.
fn opaque(volume: Volume, surface: f64) -> Stage {
    Stage::styled(volume, vec![ramp()], &[(surface, "ramp", 0.0), (surface, "ramp", 1.0)]).seen_along([0.3, 0.8, -0.5])
}

fn contours(thickness: f64, kappa: Kappa) -> Contours {
    Contours { thickness: Length::World(thickness), kappa, ..Contours::default() }
}

/// Δ√(x(2 − x)), x = min(1, (T + Δ)/R).
fn one_step(t: f64, radius: f64, delta: f64) -> f64 {
    let x = ((t + delta) / radius).min(1.0);
    delta * (x * (2.0 - x)).sqrt()
}

/// The least and the most that the ring of a ball is wide.
fn interval(kappa: Kappa, t: f64, radius: f64, delta: f64) -> [f64; 2] {
    let (missed, step) = (delta * delta / (8.0 * radius), one_step(t, radius, delta));
    match kappa {
        Kappa::Exact => [t - missed, t + step],
        _ => {
            let width = t * radius / (radius + t);
            [width - missed - step, width + step]
        }
    }
}

/// Both rings of the row through the middle of a ball have a width in the interval, `slack` world units off.
fn check(shot: &Stage, kappa: Kappa, [t, radius, delta]: [f64; 3], slack: f64) {
    let pixel = if radius < 15.0 { 0.05 } else { 0.1 };
    let width = 2 * ((radius + 1.0) / pixel) as usize;
    let [least, most] = interval(kappa, t, radius, delta);
    for ring in strip(&planes(shot, delta), &contours(t, kappa), pixel, width, [0, width]) {
        let found = ring.pixels as f64 * pixel;
        let place = format!("{kappa:?} R {radius} Δ {delta}: {found} of [{least}, {most}]");
        assert!(least - pixel - slack <= found && found <= most + pixel + slack, "{place}");
        assert_eq!(ring.holes, 0, "{place}");
    }
}

/// T = 4 voxels, on balls from R = T to 40 voxels.
#[test]
fn rings_of_smooth_balls_are_as_wide_as_the_thickness() {
    const T: f64 = 4.0;
    for radius in [4.0, 5.0, 10.0, 40.0] {
        let shot = smooth(&opaque(ball(2 * radius as usize + 10, radius), 0.0));
        for kappa in [Kappa::Exact, Kappa::Ray] {
            for delta in [1.0, 0.25] {
                check(&shot, kappa, [T, radius, delta], 0.0);
            }
        }
    }
}

/// Central differences of trilinear data: κ is off by up to 1.2 h²/r² of itself, the width by as much of T; the surface
/// of the interpolated distance lies up to h²/4R inside the true one.
#[test]
fn rings_of_trilinear_balls_in_both_number_types() {
    const T: f64 = 4.0;
    for radius in [10.0, 24.0] {
        let shot = opaque(ball(2 * radius as usize + 10, radius), 0.0)
            .with(|s| s.sampling.hessian = HessianEstimator::Central);
        let slack = T * 1.2 / (radius * radius) + 0.25 / radius;
        for number in [Number::F64, Number::F32] {
            let shot = shot.with(|s| s.sampling.number = number);
            check(&shot, Kappa::Exact, [T, radius, 0.5], slack);
            check(&shot, Kappa::Ray, [T, radius, 0.5], slack);
        }
    }
}

/// One picture holds a ball of R = 4 and one of R = 100: rings of one width, where a threshold on |N·v| alone would make
/// widths of 1 : 25. Of both only the slab about the row is kept.
#[test]
fn small_and_large_balls_in_one_picture_have_rings_of_one_width() {
    const T: f64 = 3.0;
    let balls = [(DVec3::new(104.0, 6.0, 32.0), 100.0), (DVec3::new(226.0, 6.0, 32.0), 4.0)];
    let at = |p: DVec3| balls.iter().map(|(c, r)| r - (p - c).length()).fold(f64::NEG_INFINITY, f64::max);
    // Looking along −z with y up, the row runs along x; it begins half a voxel before the first one.
    let row =
        smooth(&opaque(volume([237, 13, 65], at), 0.0)).seen_along([0.0, 0.0, -1.0]).with(|s| s.camera.up = DVec3::Y);
    let (pixel, width) = (0.0625, 237 * 16);
    let parts = [[0, 214 * 16], [214 * 16, width]];
    for delta in [0.5, 0.25] {
        let mut found = Vec::new();
        for kappa in [Kappa::Exact, Kappa::Ray] {
            for ((_, radius), part) in balls.iter().zip(parts) {
                let [least, most] = interval(kappa, T, *radius, delta);
                for ring in strip(&planes(&row, delta), &contours(T, kappa), pixel, width, part) {
                    let w = ring.pixels as f64 * pixel;
                    let place = format!("{kappa:?} R {radius} Δ {delta}: {w} of [{least}, {most}]");
                    assert!(least - pixel <= w && w <= most + pixel && ring.holes == 0, "{place}");
                    found.push(w);
                }
            }
        }
        // Exact κ: the four rings differ by the step's term alone.
        assert!(found[..4].iter().all(|w| (w - T).abs() <= one_step(T, 4.0, delta) + pixel), "{found:?}");
    }
}

/// Balls as a scanner would store them: u8, an edge one voxel wide; trilinear, the automatic Gaussian Hessian, one voxel
/// a pixel. The width, taken along 360 radii of the picture, is T to half a pixel in the median.
#[test]
fn rings_of_u8_balls_at_one_voxel_a_pixel() {
    for radius in [10.0, 15.0, 25.0, 40.0] {
        for t in [2.0, 3.0] {
            let n = 2 * radius as usize + 12;
            let grid = Grid::with_spacing([n; 3], [1.0; 3]).unwrap();
            let sphere = phantom::for_type("sphere", &grid, VoxelType::U8, &[("R".into(), radius)]).unwrap();
            let volume = phantom::sample(sphere.as_ref(), grid, VoxelType::U8).unwrap();
            let shot = opaque(volume, 127.5).with(|s| {
                s.picture.size = [n, n];
                s.camera.projection = orthographic(Some(n as f64)).projection;
            });
            let without = shot.render().pixels();
            let with = shot.with(|s| s.contours = Some(contours(t, Kappa::Exact))).render().pixels();
            let mut widths: Vec<f64> = (0..360)
                .map(|angle| {
                    let (sin, cos) = f64::from(angle).to_radians().sin_cos();
                    let pixel = |rho: f64| {
                        let [i, j] = [cos, sin].map(|c| (n as f64 / 2.0 + rho * c) as usize);
                        j * n + i
                    };
                    let radii = || (0..).map(|k| f64::from(k) * 0.02).take_while(|rho| *rho < radius + 4.0);
                    let edge = radii().filter(|&rho| without[pixel(rho)][3] > 0.0).fold(0.0, f64::max);
                    let inner = radii().find(|&rho| without[pixel(rho)] != with[pixel(rho)]).unwrap_or(edge);
                    edge - inner
                })
                .collect();
            widths.sort_by(f64::total_cmp);
            let median = widths[180];
            assert!((median - t).abs() <= 0.5, "R {radius} T {t}: {median}");
        }
    }
}

/// A style that is black beyond r = 0.9 and white within: a pixel is black where the pushed normal lies beyond,
/// r/δ ≥ 0.9 with δ = |N·v|/τ, and nowhere else. N and κ are closed forms of the pixel's own sample.
#[test]
fn a_black_rim_makes_a_black_ring() {
    const EDGE: f64 = 0.9;
    let (radius, t, delta) = (14.0, 2.5, 0.5);
    let black_rim = style("rim", 256, |x, y| if x.hypot(y) > EDGE { [0.0, 0.0, 0.0, 1.0] } else { [1.0; 4] });
    let shot = Stage::styled(ball(40, radius), vec![black_rim], &[(0.0, "rim", 0.0), (0.0, "rim", 1.0)]);
    let shot = planes(&smooth(&shot), delta).layers(&[LayerKind::Normal, LayerKind::First]).with(|s| {
        s.picture.size = [48, 48];
        s.camera.projection = orthographic(Some(32.0)).projection;
    });
    let without = shot.render();
    let with = shot.with(|s| s.contours = Some(contours(t, Kappa::Exact))).render();
    let (mut rings, mut plain_rings) = (0, 0);
    let layers = with.layer::<3>(LayerKind::Normal).into_iter().zip(with.one(LayerKind::First));
    for (i, ((n, value), [pixel, bare])) in
        layers.zip(with.pixels().into_iter().zip(without.pixels()).map(|(a, b)| [a, b])).enumerate()
    {
        if pixel[3] == 0.0 {
            continue;
        }
        let (r, d) = (n[0].hypot(n[1]), n[2].abs());
        let x = t / (radius - value);
        let tau = (x * (2.0 - x)).sqrt();
        let pushed = if d <= tau { (r * tau / d).min(1.0) } else { r };
        // Texels are 1/128 apart, and a filter reads the next ones.
        let off_edge = |r: f64| (r - EDGE).abs() > 2.0 / 128.0;
        let expected = |r: f64| if r > EDGE { 0.0 } else { 1.0 };
        if off_edge(pushed) {
            assert_eq!(pixel[0], expected(pushed), "pixel {i}: r {r} pushed to {pushed}");
        }
        if off_edge(r) {
            assert_eq!(bare[0], expected(r), "pixel {i}: r {r}");
        }
        rings += usize::from(pixel[0] == 0.0);
        plain_rings += usize::from(bare[0] == 0.0);
    }
    // Without contours black is beyond 0.9 R: 0.19 of the disk. With them beyond r/δ = 0.9, farther in.
    assert!(rings > plain_rings && plain_rings > 200, "{rings} {plain_rings}");
}

/// With `kappa = "none"` a constant threshold: the ring is all of |N·v| ≤ τ, R(1 − √(1 − τ²)) wide, in proportion to R.
#[test]
fn a_constant_threshold_widens_with_the_ball() {
    let threshold = 0.4;
    for radius in [6.0, 18.0] {
        let delta = 0.125;
        let shot = planes(&smooth(&opaque(ball(2 * radius as usize + 10, radius), 0.0)), delta);
        let kappa = Kappa::None { threshold };
        let pixel = 0.02;
        let width = 2 * ((radius + 1.0) / pixel) as usize;
        let ideal = radius * (1.0 - (1.0 - threshold * threshold).sqrt());
        for ring in strip(&shot, &contours(1.0, kappa), pixel, width, [0, width]) {
            // A sample at radius r ≥ R − Δτ on a grazing view has its ring's inner edge at r√(1 − τ²).
            let found = ring.pixels as f64 * pixel;
            let reach = delta * threshold + delta * delta / (8.0 * radius) + pixel;
            assert!((found - ideal).abs() <= reach, "R {radius}: {found}, {ideal}");
        }
    }
}

/// The fade takes contours where the gradient is weak: on a ball whose |g| is below lo there is none, above hi all.
#[test]
fn faded_contours_are_gone_where_the_gradient_is_weak() {
    let shot = opaque(ball(26, 8.0), 0.0);
    let faded = |fade| {
        let table = Contours { fade: Some(fade), ..contours(3.0, Kappa::Exact) };
        let row = |c: &Contours| {
            shot.with(|s| {
                s.contours = Some(c.clone());
                s.volume.gradient_range = drypoint::scene::tables::GradientRange::Fixed([0.0, 2.0]);
            })
            .render()
            .bits()
        };
        (row(&table), row(&contours(3.0, Kappa::Exact)))
    };
    // ‖g‖ = 1 everywhere up to the error of central differences, so |g| is near ½.
    let (with, unfaded) = faded([0.1, 0.4]);
    assert_eq!(with, unfaded);
    let (with, unfaded) = faded([0.6, 0.9]);
    assert_ne!(with, unfaded);
    assert_eq!(with, shot.render().bits());
}

/// A contour shows no more where a style has one colour: the push is all that contours do to opaque things.
#[test]
fn contours_leave_a_constant_style_alone() {
    let grey = plain("grey", [0.3, 0.4, 0.5, 1.0]);
    let shot = Stage::styled(ball(20, 6.0), vec![grey], &[(0.0, "grey", 0.0), (0.0, "grey", 1.0)]);
    for kappa in [Kappa::Exact, Kappa::Ray, Kappa::None { threshold: 0.5 }] {
        let with = shot.with(|s| s.contours = Some(contours(2.0, kappa)));
        assert_eq!(with.render().bits(), shot.render().bits());
    }
}

/// Catmull–Rom and the smoothing kernel have contours too, though at other places.
#[test]
fn every_kernel_draws_rings() {
    for kernel in [Kernel::Trilinear, Kernel::Bspline, Kernel::BsplineSmooth, Kernel::Bspline5, Kernel::CatmullRom] {
        let shot = opaque(ball(30, 10.0), 0.0).with(|s| s.sampling.kernel = kernel);
        for ring in strip(&shot, &contours(3.0, Kappa::Exact), 0.1, 220, [0, 220]) {
            // The smoothing kernel moves a distance by f''/6 summed over the axes, 2/6R; the rest is as above.
            let found = (ring.pixels as f64 * 0.1 - 3.0).abs();
            assert!(found <= one_step(3.0, 10.0, 0.5) + 0.1 + 3.0 * 1.2 / 100.0 + 0.25 / 10.0, "{kernel:?} {ring:?}");
        }
    }
}
