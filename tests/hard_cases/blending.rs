//! Colours composited ([VAL-3], [IO-6]): by hand, on volumes whose rays meet one or two samples.

use crate::common::{Stage, ball, in_a_texture, orthographic, plain, volume};
use drypoint::scene::color::{linear_to_srgb, srgb_to_linear};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{Background, BlendSpace, Length, RaysPerPixel};

/// A slab of two voxels, y from 0 to 1, that planes 1 apart at half depths meet once (at its middle) or twice (at its
/// faces), and its two values.
fn slab(samples: usize) -> Stage {
    let shot = Stage::regular(
        volume([5, 2, 5], |p| p.y),
        &[(0.0, [0.8, 0.1, 0.05], 0.25), (0.5, [0.2, 0.6, 0.4], 0.5), (1.0, [0.1, 0.2, 0.9], 0.75)],
    );
    shot.step(1.0).with(|s| {
        s.picture.size = [2, 2];
        let depth = if samples == 1 { 0.5 } else { 0.0 };
        s.camera = orthographic(Some(2.0));
        s.camera.direction = DVec3::Y;
        s.camera.direction_given = true;
        // The middle of the slab at depth ½, or its faces at depths ±½.
        s.camera.eye = Some(DVec3::new(2.0, 0.5 - depth, 2.0));
    })
}

fn all(shot: &Stage, expected: [f64; 4]) {
    for pixel in shot.render().pixels() {
        for (p, e) in pixel.iter().zip(expected) {
            assert!((p - e).abs() < 1e-15, "{pixel:?} {expected:?}");
        }
    }
}

#[test]
fn one_and_two_samples_over_nothing() {
    all(&slab(1), [0.1, 0.3, 0.2, 0.5]);
    // (0.8, 0.1, 0.05)·¼ + ¾·¾·(0.1, 0.2, 0.9); A = ¼ + ¾·¾.
    all(&slab(2), [0.25625, 0.1375, 0.51875, 0.8125]);
}

#[test]
fn colours_and_pictures_behind() {
    // A straight colour of opacity ½: C + (1 − A)·B, B premultiplied.
    let over = |shot: &Stage| shot.with(|s| s.picture.background = Background::Color([0.4, 0.8, 1.0, 0.5]));
    all(&over(&slab(1)), [0.1 + 0.5 * 0.2, 0.3 + 0.5 * 0.4, 0.2 + 0.5 * 0.5, 0.75]);
    let behind = vec![[0.2, 0.4, 0.5, 0.5], [0.0, 0.0, 0.0, 0.0], [1.0, 1.0, 1.0, 1.0], [0.1, 0.0, 0.0, 0.25]];
    let shot = Stage { behind: Some(behind.clone()), ..slab(1) };
    for (p, b) in shot.render().pixels().into_iter().zip(behind) {
        let c = [0.1, 0.3, 0.2, 0.5];
        for i in 0..4 {
            assert!((p[i] - (c[i] + 0.5 * b[i])).abs() < 1e-15);
        }
    }
}

/// `blend_space = "srgb"`: each sample's straight colour encoded, then premultiplied and composited with the encoded
/// background; at the end un-premultiplied, decoded, premultiplied.
#[test]
fn encoded_compositing_by_hand() {
    let encode = |c: [f64; 3]| c.map(linear_to_srgb);
    let srgb = |shot: Stage, background: Background| {
        shot.with(|s| {
            s.picture.blend_space = BlendSpace::Srgb;
            s.picture.background = background;
        })
    };
    // Over nothing one sample comes out as in linear light: encoded and decoded again.
    let alone = srgb(slab(1), Background::None).render().pixels()[0];
    for (p, e) in alone.iter().zip([0.1, 0.3, 0.2, 0.5]) {
        // The two curves of sRGB meet to 10⁻⁷.
        assert!((p - e).abs() < 1e-7);
    }
    // Over a half-transparent background.
    let (c, b) = (encode([0.2, 0.6, 0.4]), encode([0.4, 0.8, 1.0]));
    let alpha = 0.5 + 0.5 * 0.5;
    let expected = [0, 1, 2].map(|i: usize| srgb_to_linear((c[i] * 0.5 + 0.5 * b[i] * 0.5) / alpha) * alpha);
    all(&srgb(slab(1), Background::Color([0.4, 0.8, 1.0, 0.5])), [expected[0], expected[1], expected[2], alpha]);
    // Two samples over white.
    let (near, far) = (encode([0.8, 0.1, 0.05]), encode([0.1, 0.2, 0.9]));
    let white = 0.1875;
    let expected =
        [0, 1, 2].map(|i: usize| srgb_to_linear(0.25 * near[i] + 0.5625 * far[i] + white * linear_to_srgb(1.0)));
    all(&srgb(slab(2), Background::Color([1.0; 4])), [expected[0], expected[1], expected[2], 1.0]);
}

/// Styles too: the lookup is filtered linear, then its straight colour is encoded.
#[test]
fn an_encoded_style_by_hand() {
    let style = plain("s", [0.3, 0.6, 0.9, 0.5]);
    let mut shot = slab(1);
    let styled = Stage::styled(shot.volume.clone(), vec![style], &[(0.0, "s", 1.0)]);
    shot.scene.transfer = styled.scene.transfer;
    shot.styles = styled.styles;
    let shot = shot.with(|s| {
        s.picture.blend_space = BlendSpace::Srgb;
        s.picture.background = Background::Color([0.0, 0.0, 0.0, 1.0]);
    });
    let [r, g, b, _] = in_a_texture([0.15, 0.3, 0.45, 0.5]);
    let expected = [r, g, b].map(|c| srgb_to_linear(0.5 * linear_to_srgb(c / 0.5)));
    all(&shot, [expected[0], expected[1], expected[2], 1.0]);
}

/// n² rays a pixel are the pixels of a picture n times as large, averaged: X = ((i + ½) − W/2)p has the same value in
/// both. Of what is a mean itself each part counts with its opacity; depths, values and counts are the first part's.
#[test]
fn samples_average_the_parts_of_a_pixel() {
    let shot = Stage::regular(ball(16, 6.0), &[(-1.0, [1.0, 0.2, 0.1], 0.0), (2.0, [0.1, 0.8, 1.0], 0.8)])
        .seen_along([0.3, 0.9, 0.2])
        .layers(&[LayerKind::Normal, LayerKind::Z, LayerKind::First, LayerKind::Counts])
        .with(|s| s.picture.background = Background::Color([0.5, 0.9, 0.1, 1.0]));
    for perspective in [false, true] {
        for n in [2, 4] {
            let shot = shot.with(|s| {
                if perspective {
                    let direction = s.camera.direction;
                    s.camera = crate::common::perspective(45.0);
                    s.camera.direction = direction;
                } else {
                    s.camera.projection = orthographic(Some(20.0)).projection;
                }
            });
            let small = shot.with(|s| s.picture.samples = RaysPerPixel::Across(n)).render();
            let large = shot.with(|s| s.picture.size = [16 * n, 16 * n]);
            let opacity = large.with(|s| s.picture.background = Background::None).render().pixels();
            let large = large.render();
            let parts = |t: usize| {
                let (x, y) = (t % 16 * n, t / 16 * n);
                (0..n * n).map(move |part| (y + part / n) * 16 * n + x + part % n)
            };
            let (pixels, normals) = (large.pixels(), large.layer::<3>(LayerKind::Normal));
            let share = 1.0 / (n * n) as f64;
            for (t, (p, normal)) in small.pixels().into_iter().zip(small.layer::<3>(LayerKind::Normal)).enumerate() {
                for c in 0..4 {
                    let mean: f64 = parts(t).map(|q| pixels[q][c] * share).sum();
                    assert!((p[c] - mean).abs() < 1e-15);
                }
                let total: f64 = parts(t).map(|q| opacity[q][3]).sum();
                for c in 0..3 {
                    let sum: f64 = parts(t).map(|q| normals[q][c] * opacity[q][3]).sum();
                    let mean = if total > 0.0 { sum / total } else { 0.0 };
                    // Each part is divided and multiplied once; then n² parts are added twice and divided.
                    assert!((normal[c] - mean).abs() < (2 * n * n + 4) as f64 * f64::EPSILON, "{} {mean}", normal[c]);
                }
            }
            for kind in [LayerKind::Z, LayerKind::First, LayerKind::Counts] {
                let (few, many) = (small.one(kind), large.one(kind));
                let first = |t: usize| parts(t).next().map(|q| many[q]);
                assert!(few.iter().enumerate().all(|(t, v)| Some(*v) == first(t)), "{kind}");
            }
        }
    }
}

/// Between nodes straight colour and opacity interpolate each by itself: a node of opacity 0 keeps its colour.
#[test]
fn a_node_of_opacity_zero_keeps_its_colour() {
    let shot = Stage::regular(volume([5; 3], |_| 0.5), &[(0.0, [1.0, 0.0, 0.0], 0.0), (1.0, [0.0, 0.0, 1.0], 1.0)]);
    let shot = shot.step(1.0).with(|s| {
        s.picture.size = [1, 1];
        s.sampling.step = Length::World(100.0);
        s.sampling.reference_length = Length::World(100.0);
        s.camera = orthographic(Some(1.0));
        s.camera.direction = DVec3::Y;
        s.camera.direction_given = true;
        s.camera.eye = Some(DVec3::new(2.0, -48.0, 2.0));
    });
    assert_eq!(shot.render().pixels(), [[0.25, 0.0, 0.25, 0.5]]);
}
