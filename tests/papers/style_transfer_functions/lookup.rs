//! Which styles a value shows ([STF-3]) and where they are looked up ([STF-1], [NORM-1]).

use super::{one_sample, planes, smooth};
use crate::common::strip::ramp;
use crate::common::{Stage, ball, orthographic, perspective, plain, style, volume};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{Length, Mix, NormalSide, Outside, SphereFrame, Table, Transparency};

/// A pixel of a constant volume: one sample, of a flat field.
fn pixel(value: f64, nodes: &[(f64, &str, f64)], mix: Mix) -> [f64; 4] {
    evaluated(value, nodes, mix, Table::Exact)
}

/// The same with values from 0 to 8 and a function that is evaluated in another way.
fn evaluated(value: f64, nodes: &[(f64, &str, f64)], mix: Mix, table: Table) -> [f64; 4] {
    let styles = vec![
        plain("red", [1.0, 0.0, 0.0, 1.0]),
        plain("half", [0.0, 1.0, 0.0, 0.5]),
        plain("blue", [0.0, 0.0, 1.0, 1.0]),
        plain("clear", [1.0, 1.0, 0.0, 0.0]),
    ];
    let shot = Stage::styled(volume([5; 3], |_| value), styles, nodes).with_transfer(|t| {
        t.mix = mix;
        t.transparency = Transparency::Plain;
        t.table = table;
    });
    let shot = one_sample(&shot, [0.0, 1.0, 0.0], 2.0).with(|s| {
        s.picture.size = [1, 1];
        s.volume.range = Some([0.0, 8.0]);
    });
    shot.render().pixels()[0]
}

/// The same numbers but for what α loses on its way through logarithm and exponential, which are no identity for
/// Δ = Δ₀.
fn is(found: [f64; 4], expected: [f64; 4]) {
    let near = |c: usize| (found[c] - expected[c]).abs() <= 2.0 * f64::EPSILON;
    assert!((0..4).all(near), "{found:?} {expected:?}");
}

#[test]
fn values_between_beyond_and_at_the_nodes() {
    let nodes = [(10.0, "red", 0.25), (20.0, "blue", 0.75)];
    for mix in [Mix::Premultiplied, Mix::Printed] {
        let at = |value| pixel(value, &nodes, mix);
        // Half way: α_u = ½, colour half red, half blue.
        is(at(15.0), [0.25, 0.0, 0.25, 0.5]);
        is(at(10.0), [0.25, 0.0, 0.0, 0.25]);
        is(at(20.0), [0.0, 0.0, 0.75, 0.75]);
        // Beyond the ends the end nodes hold.
        assert_eq!(at(-1e6), at(10.0));
        assert_eq!(at(1e6), at(20.0));
        assert_eq!(at(9.999), at(10.0));
    }
}

#[test]
fn one_node_and_two_at_one_value() {
    for mix in [Mix::Premultiplied, Mix::Printed] {
        for value in [-5.0, 7.0, 9.0] {
            is(pixel(value, &[(7.0, "blue", 0.5)], mix), [0.0, 0.0, 0.5, 0.5]);
        }
        // A step: the later node at the value itself.
        let step = [(0.0, "red", 1.0), (7.0, "red", 1.0), (7.0, "blue", 0.5), (9.0, "blue", 0.5)];
        is(pixel(7.0, &step, mix), [0.0, 0.0, 0.5, 0.5]);
        is(pixel(7f64.next_down(), &step, mix), [1.0, 0.0, 0.0, 1.0]);
        is(pixel(8.0, &step, mix), [0.0, 0.0, 0.5, 0.5]);
        // Only one value at all.
        is(pixel(7.0, &[(7.0, "red", 1.0), (7.0, "blue", 0.5)], mix), [0.0, 0.0, 0.5, 0.5]);
        is(pixel(6.0, &[(7.0, "red", 1.0), (7.0, "blue", 0.5)], mix), [1.0, 0.0, 0.0, 1.0]);
    }
}

/// Four entries over the values 0 to 8 stand at 1, 3, 5, 7. From red to blue at 4, as a step, i goes from ¾ at 3 to 2¼ at
/// 5: at 4 it is 1½, half red and half blue, and α_u is half way too.
#[test]
fn a_table_makes_a_ramp_of_a_step() {
    let step = [(0.0, "red", 1.0), (4.0, "red", 1.0), (4.0, "blue", 0.5), (8.0, "blue", 0.5)];
    for mix in [Mix::Premultiplied, Mix::Printed] {
        let at = |value| evaluated(value, &step, mix, Table::Entries(4));
        is(at(4.0), [0.375, 0.0, 0.375, 0.75]);
        is(at(3.0), [1.0, 0.0, 0.0, 1.0]);
        is(at(5.0), [0.0, 0.0, 0.5, 0.5]);
        // Below the first centre and above the last the entry holds.
        assert_eq!([at(0.0), at(9.0)], [at(1.0), at(7.0)]);
        // Where nodes are entries, there is no difference.
        let own = [(1.0, "red", 0.25), (5.0, "blue", 0.75), (7.0, "blue", 0.25)];
        for value in [0.0, 1.0, 2.0, 3.5, 5.0, 6.0, 7.5] {
            is(evaluated(value, &own, mix, Table::Entries(4)), pixel(value, &own, mix));
        }
    }
}

/// Of α_d = ½ and 1 in halves α_d is ¾; premultiplied the half-transparent green has half the share, printed the colours
/// mix first. Then α = α_d α_u.
#[test]
fn the_two_mixes_by_hand() {
    let nodes = [(0.0, "half", 0.5), (1.0, "blue", 0.5)];
    is(pixel(0.5, &nodes, Mix::Premultiplied), [0.0, 0.125, 0.25, 0.375]);
    is(pixel(0.5, &nodes, Mix::Printed), [0.0, 0.1875, 0.1875, 0.375]);
}

/// A style that is transparent shows nothing at α_u = 1, whatever colour it hides; alone it evaluates samples and no
/// more.
#[test]
fn a_style_of_opacity_zero_shows_nothing() {
    for mix in [Mix::Premultiplied, Mix::Printed] {
        assert_eq!(pixel(3.0, &[(0.0, "clear", 1.0)], mix), [0.0; 4]);
        assert_eq!(pixel(0.5, &[(0.0, "clear", 1.0), (1.0, "clear", 1.0)], mix), [0.0; 4]);
    }
    let shot = Stage::styled(ball(12, 4.0), vec![plain("clear", [1.0, 0.0, 0.0, 0.0])], &[(0.0, "clear", 1.0)])
        .layers(&[LayerKind::Z, LayerKind::First, LayerKind::Normal]);
    let shown = shot.render();
    assert_eq!(shown.covered(), 0);
    // α = 0 is no hit.
    assert!(shown.one(LayerKind::Z).iter().all(|z| *z == f64::INFINITY));
    assert!(shown.one(LayerKind::First).iter().all(|v| *v == 0.0));
    assert!(shown.layer::<3>(LayerKind::Normal).iter().all(|n| *n == [0.0; 3]));
}

/// The picture of a ball in a style is the style: each pixel holds its lit sphere at the outward eye-space normal, to
/// what the filter loses of a ramp, nothing but at the clamped rim. Inwards it holds the antipodal point.
#[test]
fn a_ball_shows_its_style() {
    for direction in [[0.0, 1.0, 0.0], [0.5, -0.3, 0.8]] {
        let shot = Stage::styled(ball(24, 8.0), vec![ramp()], &[(0.0, "ramp", 0.0), (0.0, "ramp", 1.0)])
            .seen_along(direction)
            .with(|s| s.camera.projection = orthographic(Some(18.0)).projection);
        let shot = planes(&smooth(&shot), 0.05);
        for (normal, sign) in [(NormalSide::Outward, 1.0), (NormalSide::Facing, 1.0), (NormalSide::Gradient, -1.0)] {
            let pixels = shot.with(|s| s.sampling.normal = normal).render().pixels();
            let mut seen = 0;
            for (i, p) in pixels.iter().enumerate().filter(|(_, p)| p[3] > 0.0) {
                // The pixel's place over the radius is the normal, to a step under the surface; y is up, row 0 the top.
                let at = |i: usize| (i as f64 + 0.5 - 8.0) * 18.0 / 16.0 / 8.0;
                let (x, y) = (at(i % 16), -at(i / 16));
                if x.hypot(y) < 0.95 {
                    // A sample up to Δ under the surface has its normal at ρ/r: less than 0.05/8 off.
                    assert!((2.0 * p[0] - 1.0 - sign * x).abs() < 0.01, "{normal:?} {i}: {p:?} {x}");
                    assert!((2.0 * p[1] - 1.0 - sign * y).abs() < 0.01, "{normal:?} {i}: {p:?} {y}");
                    seen += 1;
                }
            }
            assert!(seen > 90);
        }
    }
}

/// A ball 50° off the axis of a perspective picture. In the view frame the lookup's distance from the middle is
/// √(1 − (N·v)²), so its silhouette lies on the rim; in the eye frame it is that of N itself, which is elsewhere.
#[test]
fn a_ball_far_off_the_axis_has_its_silhouette_on_the_rim() {
    let n = 24;
    let centre = DVec3::splat((n - 1) as f64 / 2.0);
    let sin_cos = 50f64.to_radians().sin_cos();
    let eye = centre - DVec3::new(sin_cos.0, sin_cos.1, 0.0) * 40.0;
    let shot = Stage::styled(ball(n, 8.0), vec![ramp()], &[(0.0, "ramp", 0.0), (0.0, "ramp", 1.0)])
        .layers(&[LayerKind::Normal])
        .with(|s| {
            s.camera = perspective(130.0);
            s.camera.eye = Some(eye);
            s.camera.direction = DVec3::Y;
            s.camera.direction_given = true;
            s.picture.size = [128, 128];
            s.sampling.step = Length::World(0.25);
        });
    let shot = smooth(&shot);
    let view = shot.view();
    let frame = |frame| shot.with_transfer(|t| t.sphere_frame = frame).render();
    let (by_view, by_eye) = (frame(SphereFrame::View), frame(SphereFrame::Eye));
    let (mut rim, mut off_rim, mut seen) = (0, 0, 0);
    for (i, (((p, q), n), bare)) in by_view
        .pixels()
        .into_iter()
        .zip(by_eye.pixels())
        .zip(by_view.layer::<3>(LayerKind::Normal))
        .zip(by_eye.layer::<3>(LayerKind::Normal))
        .enumerate()
    {
        if p[3] == 0.0 {
            continue;
        }
        assert_eq!(n, bare, "the layer holds N itself");
        let v = view.ray((i % 128) as f64 + 0.5, (i / 128) as f64 + 0.5).v;
        let n = DVec3::from_array(n);
        let lookup = |p: [f64; 4]| (2.0 * p[0] - 1.0).hypot(2.0 * p[1] - 1.0);
        let distance = (1.0 - n.dot(v).powi(2)).max(0.0).sqrt();
        // The filter reproduces the ramp but for the outermost texels, two of 256.
        assert!((lookup(p) - distance).abs() < 4.0 / 256.0, "{i}: {} {distance}", lookup(p));
        assert!((lookup(q) - n.x.hypot(n.y)).abs() < 4.0 / 256.0);
        seen += 1;
        rim += usize::from(distance > 0.97);
        off_rim += usize::from(distance > 0.97 && lookup(q) < 0.9);
    }
    assert!(seen > 400 && rim > 20 && off_rim > 10, "{seen} {rim} {off_rim}");
}

/// Both frames are one in an orthographic picture, bit for bit.
#[test]
fn both_frames_are_one_in_orthographic_pictures() {
    let shot = Stage::styled(ball(16, 6.0), vec![ramp()], &[(-2.0, "ramp", 0.0), (2.0, "ramp", 0.7)])
        .seen_along([0.3, 0.5, -0.9]);
    assert_eq!(shot.render().bits(), shot.with_transfer(|t| t.sphere_frame = SphereFrame::View).render().bits());
}

/// A dark ball in a bright surround, `outside = "high"`: the same picture as the bright one in a dark surround.
#[test]
fn dark_objects_look_like_bright_ones() {
    let bright = Stage::styled(ball(16, 6.0), vec![ramp()], &[(0.1, "ramp", 0.0), (0.1, "ramp", 1.0)]);
    let centre = DVec3::splat(7.5);
    let dark = volume([16; 3], |p| -(6.0 - (p - centre).length()));
    let dark = Stage::styled(dark, vec![ramp()], &[(-0.1, "ramp", 1.0), (-0.1, "ramp", 0.0)]);
    let dark = dark.with(|s| s.volume.outside = Outside::High);
    assert_eq!(bright.render().bits(), dark.render().bits());
}

/// Texels outside the disk never show: a style that is a warning colour there looks like one that is not.
#[test]
fn texels_outside_the_disk_never_show() {
    let with = |outside: f64| {
        let inside = |x: f64, y: f64| [x * 0.5 + 0.5, y * 0.5 + 0.5, 0.0, 1.0];
        // A texel is inside where its centre is.
        style("s", 8, move |x, y| if x * x + y * y <= 1.0 { inside(x, y) } else { [outside; 4] })
    };
    let picture = |style| {
        Stage::styled(ball(16, 6.0), vec![style], &[(0.0, "s", 0.0), (0.0, "s", 1.0)])
            .with(|s| s.contours = Some(Default::default()))
            .render()
            .bits()
    };
    assert_eq!(picture(with(0.0)), picture(with(f64::NAN)));
}
