//! Eq. 2 in pictures ([STF-9]) and the order of the correction ([VAL-4]).

use super::one_sample;
use crate::common::{Stage, ball, corrected, orthographic, plain, volume};
use drypoint::reference::style_transfer_functions::contour::fade;
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{Contours, GradientRange, Kappa, Length, Transparency};
use drypoint::scene::volume::Volume;

/// The gradient of the linear field.
const G: DVec3 = DVec3::new(0.25, -0.5, 0.125);

/// A linear field about the middle of 17³ voxels.
fn linear() -> Volume {
    volume([17; 3], |p| G.dot(p - DVec3::splat(8.0)))
}

/// Of a linear field everything in eq. 2 is known: N = −G/‖G‖ (so |N·v|), |g| = ‖G‖ in its range, α_u between two nodes,
/// τ a constant threshold times its fade. One sample a ray: the pixel is α_d α_u^(0.5 + max(0, |N·v| − τ)(1 − |g|)).
#[test]
fn eq_2_by_hand_at_every_pixel() {
    // Colours and opacity that a texel holds exactly.
    let (alpha_d, color, direction) = (0.8125, [0.25, 0.625, 0.875], [0.6, 0.7, -0.2]);
    let v = -DVec3::from_array(direction).normalize();
    let n_v = (G.normalize().dot(v)).abs();
    let nodes = [(-2.0, "glass", 0.05), (2.0, "glass", 0.95)];
    for (threshold, fades, range) in [
        (None, None, [0.0, 1.0]),
        (None, None, [0.25, 0.75]),
        (Some(0.4), None, [0.0, 1.0]),
        (Some(0.95), None, [0.0, 1.0]),
        (Some(0.8), Some([0.2, 0.9]), [0.0, 1.0]),
        // |g| = 1: the exponent is ½ everywhere.
        (Some(0.3), None, [0.0, 0.5]),
        // hi = lo: |g| = 0.
        (None, None, [0.5, 0.5]),
    ] {
        let g =
            if range[0] < range[1] { ((G.length() - range[0]) / (range[1] - range[0])).clamp(0.0, 1.0) } else { 0.0 };
        let tau = threshold.unwrap_or(0.0) * fades.map_or(1.0, |[lo, hi]| fade(g, lo, hi));
        let glass = plain("glass", [color[0], color[1], color[2], alpha_d]);
        let shot = Stage::styled(linear(), vec![glass], &nodes).layers(&[LayerKind::First]).with(|s| {
            s.volume.gradient_range = GradientRange::Fixed(range);
            s.contours = threshold.map(|threshold| Contours {
                kappa: Kappa::None { threshold },
                fade: fades,
                ..Contours::default()
            });
        });
        let shown = one_sample(&shot, direction, 6.0).render();
        for (pixel, s) in shown.pixels().into_iter().zip(shown.one(LayerKind::First)) {
            let alpha_u = 0.05 + 0.9 * ((s + 2.0) / 4.0).clamp(0.0, 1.0);
            let alpha = alpha_d * alpha_u.powf(0.5 + (n_v - tau).max(0.0) * (1.0 - g));
            // Some ten roundings.
            assert!((pixel[3] - alpha).abs() < 1e-14, "{pixel:?} {alpha}");
            for (c, p) in color.iter().zip(pixel) {
                assert!((p - c * alpha).abs() < 1e-14);
            }
        }
    }
}

/// A sample without a normal counts as seen along it, |N·v| = 1, and κ as 0 ([PREC-3]): α_u^(3/2) of a flat field, whatever
/// the thickness; under a constant threshold τ the exponent is ½ + 1 − τ.
#[test]
fn a_flat_field_is_seen_along_its_normal() {
    for (kappa, exponent) in [
        (Kappa::Ray, 1.5),
        (Kappa::Exact, 1.5),
        (Kappa::None { threshold: 0.25 }, 1.25),
        (Kappa::None { threshold: 1.0 }, 0.5),
    ] {
        let glass = plain("glass", [0.5, 0.25, 1.0, 0.75]);
        let shot = Stage::styled(volume([9; 3], |_| 100.1), vec![glass], &[(0.0, "glass", 0.4)])
            .with(|s| s.contours = Some(Contours { kappa, thickness: Length::World(50.0), ..Contours::default() }));
        let shown = one_sample(&shot, [0.1, 0.9, 0.4], 4.0).render();
        assert_eq!(shown.counts.without_normal, 256);
        for pixel in shown.pixels() {
            assert!((pixel[3] - 0.75 * 0.4f64.powf(exponent)).abs() < 1e-15, "{kappa:?} {pixel:?}");
        }
    }
}

/// α_u = 1 gives α = α_d and α_u = 0 gives nothing, exactly, on contours and off them; plain transparency too.
#[test]
fn the_ends_of_alpha_u_are_exact() {
    for transparency in [Transparency::Illustrative, Transparency::Plain] {
        for contours in [None, Some(Contours { kappa: Kappa::None { threshold: 0.7 }, ..Contours::default() })] {
            let with = |alpha_u: f64| {
                let glass = plain("glass", [0.5, 0.25, 1.0, 0.375]);
                let shot = Stage::styled(linear(), vec![glass], &[(0.0, "glass", alpha_u)])
                    .with_transfer(|t| t.transparency = transparency)
                    .with(|s| s.contours = contours.clone());
                one_sample(&shot, [0.1, 0.9, 0.4], 6.0).render().pixels()
            };
            assert!(with(1.0).iter().all(|p| *p == [0.5 * 0.375, 0.25 * 0.375, 0.375, 0.375]));
            assert!(with(0.0).iter().all(|p| *p == [0.0; 4]));
        }
    }
}

/// A slab whose every sample has one exponent e = 0.5 + |N·v|(1 − |g|) and one α_u, L thick: its opacity is
/// 1 − (1 − α_u^e)^(L/Δ₀), to one step's opacity, at every Δ. So it converges with order 1: one step's opacity is at most
/// Δ/Δ₀ · −ln(1 − α). Were α_u corrected first and raised to e after, the slab would turn opaque as Δ → 0; the last step
/// shows that this test would see it.
#[test]
fn a_slab_under_eq_2_converges_because_correction_comes_last() {
    let (alpha_u, range) = (0.2f64, [0.0, 1.0]);
    let direction = DVec3::new(0.3, 0.9, -0.1).normalize();
    for threshold in [None, Some(0.5)] {
        let exponent =
            0.5 + (G.normalize().dot(direction).abs() - threshold.unwrap_or(0.0)).max(0.0) * (1.0 - G.length());
        let alpha = alpha_u.powf(exponent);
        let shot = Stage::styled(linear(), vec![plain("glass", [0.5, 0.5, 0.5, 1.0])], &[(0.0, "glass", alpha_u)])
            .seen_along(direction.to_array())
            .with(|s| {
                s.volume.gradient_range = GradientRange::Fixed(range);
                s.contours =
                    threshold.map(|threshold| Contours { kappa: Kappa::None { threshold }, ..Contours::default() });
                s.camera.projection = orthographic(Some(4.0)).projection;
                // Thin enough that the slab does not saturate.
                s.sampling.reference_length = Length::World(8.0);
            });
        // Rays near the middle pass the faces y = 0 and y = 16.
        let length = 16.0 / direction.y.abs();
        let whole = 1.0 - (1.0 - alpha).powf(length / 8.0);
        for halvings in 0..5 {
            let step = 1.1 / f64::from(1 << halvings);
            let bound = corrected(alpha, step / 8.0);
            assert!(bound <= -(1.0 - alpha).ln() * step / 8.0);
            for pixel in shot.with(|s| s.sampling.step = Length::World(step)).render().pixels() {
                assert!((pixel[3] - whole).abs() <= bound + 1e-12, "Δ {step}: {} {whole} ± {bound}", pixel[3]);
            }
            let first = corrected(alpha_u, step / 8.0);
            let wrong = 1.0 - (1.0 - first.powf(exponent)).powf(length / step);
            // A slab at an exponent above 1 vanishes instead.
            assert!(halvings < 4 || (wrong - whole).abs() > 4.0 * bound, "{wrong} {whole} {bound}");
        }
    }
}

/// The same on a picture without closed form, a translucent ball with contours along eq. 2 and smooth opacities: halving
/// Δ four times, the differences between pictures fall by 2 at least each time, on the whole by 8.
#[test]
fn a_translucent_ball_converges() {
    let glass = plain("glass", [0.7, 0.5, 0.2, 0.9]);
    // Opacity 0 at the box's faces, so that no sample enters or leaves the picture with a step.
    let nodes = [(-4.0, "glass", 0.0), (1.0, "glass", 0.3), (9.0, "glass", 0.05)];
    let shot = super::smooth(&Stage::styled(ball(24, 6.0), vec![glass], &nodes)).seen_along([0.2, 0.5, 0.4]);
    for contours in [None, Some(Contours { kappa: Kappa::Exact, ..Contours::default() })] {
        let pictures: Vec<_> = (0..5)
            .map(|halvings| {
                let step = Length::World(1.0 / f64::from(1 << halvings));
                shot.with(|s| {
                    s.contours = contours.clone();
                    s.sampling.step = step;
                })
                .render()
            })
            .collect();
        // The mean over the picture: a single pixel's error may change its sign.
        let difference = |a: usize| {
            let pairs = pictures[a].pixels().into_iter().zip(pictures[a + 1].pixels());
            pairs.map(|(p, q)| (p[3] - q[3]).abs()).sum::<f64>() / 256.0
        };
        let ratio = difference(0) / difference(3);
        assert!(ratio >= 8.0, "{ratio}: order {}", ratio.log2() / 3.0);
    }
}

/// A regular function is always plain: no eq. 2, no contour, no κ ([STF-8], [STF-9]).
#[test]
fn a_regular_function_with_contours_computes_nothing_of_them() {
    let shot = Stage::regular(ball(16, 6.0), &[(-1.0, [0.2, 0.3, 0.4], 0.0), (3.0, [0.9, 0.3, 0.4], 0.6)]);
    let bare = shot.render();
    for kappa in [Kappa::Exact, Kappa::Ray, Kappa::None { threshold: 0.9 }] {
        let table = Contours { kappa, fade: Some([0.1, 0.2]), ..Contours::default() };
        let with = shot.with(|s| {
            s.contours = Some(table);
            s.volume.gradient_range = GradientRange::Quantile(0.999);
        });
        let with = with.render();
        assert_eq!(with.bits(), bare.bits());
        let counts = |c: &drypoint::scene::counts::Counts| {
            (c.samples, c.gradients, c.hessians, c.style_lookups, c.preprocess.clone(), c.bytes.clone())
        };
        assert_eq!(counts(&with.counts), counts(&bare.counts));
        assert_eq!((with.counts.gradients, with.counts.hessians), (0, 0));
    }
}
