//! Styles where their formulas have an edge ([STF-1] … [STF-9]).

use crate::common::strip::ramp;
use crate::common::{Stage, corrected, in_a_texture, on, orthographic, perspective, plain, style, volume};
use crate::stability::{Case, Theme, U, rounding, worse};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    Contours, GradientRange, Kappa, Length, Mix, NormalSide, Number, SphereFrame, Transparency, Unit,
};
use drypoint::scene::volume::{Volume, Voxels};

pub(crate) static THEME: Theme = Theme::new(
    "Styles and illustrative transparency",
    &[
        Case {
            name: "a slab of α_u^x at Δ, Δ/2, Δ/4, Δ/8; x = ½, 1, 3/2",
            breaks: "corrected before the power, the slab turns opaque or vanishes as Δ → 0",
            done: "the correction is the last step [VAL-4]",
            of: "|α − (1 − (1 − α_u^x)^(L/Δ₀))| in units of one step's opacity",
            bound: 1.0,
            why: "the length of the ray, to one step [RAY-1]",
            measure: || slabs_of_powers(Number::F64),
        },
        Case {
            name: "a sheet thinner than the step, opposite normals at successive samples",
            breaks: "κ = π/Δ: Tκ past 1, where √(Tκ(2 − Tκ)) falls again and is not real",
            done: "Tκ is clamped to [0, 1]: thin things are contour throughout [STF-7]",
            of: "|α − closed form| of two samples; outward, literal, facing",
            bound: 1e-14,
            why: "two powers and one sum",
            measure: thin_sheet,
        },
        Case {
            name: "n exactly along v: a wall seen straight on",
            breaks: "0/0 in the push outwards and in κ_v; |N·v| above 1",
            done: "r = 0 stays 0 [STF-8]; the mean curvature where the direction is lost [CUR-2]",
            of: "largest error of a channel against the closed form; every κ, τ from 0 to 1, both ways",
            bound: 1e-14,
            why: "one power, one lookup in the middle of the style",
            measure: || wall(Number::F64),
        },
        Case {
            name: "values at the exact ends of the range",
            breaks: "a style beyond the last; a first value that is not seen",
            done: "i₁ at the last node clamps [STF-3]",
            of: "largest error of a channel; values, normalized, per cents; 3 slopes",
            bound: 2.0 * f64::EPSILON,
            why: "lo + n(hi − lo) and the fraction round once",
            measure: || exact_ends(Number::F64),
        },
        Case {
            name: "an eye inside at 120°",
            breaks: "corrected for Δ, corners are off by 2.65 in the exponent",
            done: "Δ_ray = Δ/cosφ [VAL-4]; the lookup in the frame that the scene says [STF-1]",
            of: "largest error of opacity and looked-up normal against the closed form; both frames",
            bound: 1e-12,
            why: "some hundred samples a ray, a few ε each; a ramp is exact for bilinear filters",
            measure: || wide_picture(Number::F64),
        },
        Case {
            name: "the same in f32: slabs of powers",
            breaks: "as for f64",
            done: "powers and corrections are computed in f64 and rounded once",
            of: "|α − (1 − (1 − α_u^x)^(L/Δ₀))| in units of one step's opacity, after 4 u a sample",
            bound: 1.0,
            why: "the length of the ray, to one step [RAY-1]; four roundings a sample",
            measure: || slabs_of_powers(Number::F32),
        },
        Case {
            name: "in f32: walls",
            breaks: "as for f64",
            done: "as for f64",
            of: "largest error of a channel against the closed form; every κ, τ from 0 to 1, both ways",
            bound: 4.0 * U,
            why: "α_u, ‖g‖, the exponent, the power and its product with the colour round once each, of numbers below ½",
            measure: || wall(Number::F32),
        },
        Case {
            name: "in f32: ends of the range",
            breaks: "as for f64",
            done: "as for f64",
            of: "largest error of a channel; values, normalized, per cents; 3 slopes",
            bound: 4.0 * U,
            why: "lo + n(hi − lo) and the fraction round once",
            measure: || exact_ends(Number::F32),
        },
        Case {
            name: "in f32: an eye inside at 120°",
            breaks: "as for f64",
            done: "as for f64",
            of: "largest error of opacity and looked-up normal against the closed form; both frames",
            bound: 500.0 * U,
            why: "some hundred samples a ray, a few u each",
            measure: || wide_picture(Number::F32),
        },
    ],
);

#[test]
fn styles_and_illustrative_transparency() {
    THEME.hold();
}

/// A homogeneous slab of α_u^x, 16 voxels thick, at Δ, Δ/2, Δ/4, Δ/8: its opacity is 1 − (1 − α_u^x)^(L/Δ₀) to one step's, as
/// the opacity of a length is one number however the length is cut. That holds for every exponent of eq. 2 only if the
/// correction is the last step: corrected first, x < 1 turns the slab opaque and x > 1 makes it vanish. A flat field has
/// |N·v| = 1, so a constant threshold τ makes x = 3/2 − τ: 3/2, 1 and 1/2.
fn slabs_of_powers(number: Number) -> f64 {
    let mut largest = 0.0;
    let (alpha_u, length, reference) = (0.1f64, 16.0, 4.0);
    for tau in [0.0, 0.5, 1.0] {
        let x = 1.5 - tau;
        let alpha = alpha_u.powf(x);
        let whole = corrected(alpha, length / reference);
        let glass = plain("glass", [0.6, 0.7, 0.8, 1.0]);
        let slab = Stage::styled(volume([5, 17, 5], |_| 3.0), vec![glass], &[(0.0, "glass", alpha_u)]).with(|s| {
            s.contours = Some(Contours { kappa: Kappa::None { threshold: tau }, ..Contours::default() });
            s.sampling.reference_length = Length::World(reference);
            s.camera.projection = orthographic(Some(3.0)).projection;
            s.picture.size = [2, 2];
            s.sampling.number = number;
        });
        for halvings in 0..4 {
            let step = 1.0 / f64::from(1 << halvings);
            let bound = corrected(alpha, step / reference);
            let rounding = match number {
                Number::F64 => 1e-13,
                Number::F32 => 4.0 * rounding(number) * (length / step + 1.0),
            };
            for pixel in slab.with(|s| s.sampling.step = Length::World(step)).render().pixels() {
                largest = worse(largest, ((pixel[3] - whole).abs() - rounding).max(0.0) / bound);
            }
            // What the other order makes of it is seen at the smallest step, but where x = 1 and both are one.
            let first = corrected(alpha_u, step / reference).powf(x);
            let other = corrected(first, length / step);
            assert!(x == 1.0 || halvings < 3 || (other - whole).abs() > bound, "x {x}: {other} {whole} {bound}");
        }
    }
    largest
}

/// A sheet thinner than the step has opposite normals at successive samples: the value rises by 1 a voxel to two equal
/// voxels and falls again. Their angle is π and κ = π/Δ, so Tκ > 1 and the second sample is contour, τ = 1: its exponent in
/// eq. 2 is ½, not ½ + |N·v| = 3/2. With facing normals nothing turns, κ = 0, and the picture is the one without contours.
fn thin_sheet() -> f64 {
    let alpha_u = 0.25f64;
    let grey = plain("grey", [0.5, 0.5, 0.5, 1.0]);
    let sheet = volume([7, 8, 7], |p| 1.0 - (p.y - 3.5).abs());
    let shot = Stage::styled(sheet, vec![grey], &[(0.4, "grey", 0.0), (0.4, "grey", alpha_u)]).step(1.0).with(|s| {
        // ‖g‖ = ½ at both: |g| = 0.
        s.volume.gradient_range = GradientRange::Fixed([0.5, 1.0]);
        s.contours = Some(Contours { thickness: Length::World(0.5), ..Contours::default() });
        s.picture.size = [3, 3];
        s.camera.projection = orthographic(Some(3.0)).projection;
    });
    let opacity = |normal| {
        let pixels = shot.with(|s| s.sampling.normal = normal).render().pixels();
        assert!(pixels.iter().all(|p| *p == pixels[0]));
        pixels[0][3]
    };
    let over = |a: f64, b: f64| a + (1.0 - a) * b;
    let [plain, contour] = [alpha_u.powf(1.5), alpha_u.sqrt()];
    let turning = [NormalSide::Outward, NormalSide::Gradient].map(|side| (opacity(side) - over(plain, contour)).abs());
    turning.into_iter().fold((opacity(NormalSide::Facing) - over(plain, plain)).abs(), worse)
}

/// n exactly along v: the lookup is the middle of the style, which has no direction to be pushed along (r = 0 stays 0),
/// the direction of κ_v is lost and the mean curvature stands in, and |N·v| = 1 exactly. A wall seen straight on, in a
/// style that tells its middle from everything else, under every κ and under a threshold that makes all of it contour.
fn wall(number: Number) -> f64 {
    let mut largest = 0.0;
    let (alpha_u, g) = (0.3f64, 0.5);
    let field = || volume([9; 3], |p| g * (p.y - 4.0));
    let directions = [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]];
    let kappas = [
        (None, 0.0),
        (Some(Kappa::Ray), 0.0),
        (Some(Kappa::Exact), 0.0),
        (Some(Kappa::None { threshold: 0.25 }), 0.25),
        (Some(Kappa::None { threshold: 1.0 }), 1.0),
    ];
    for direction in directions {
        for (kappa, tau) in kappas {
            let bare = Stage::styled(field(), vec![ramp()], &[(-1.0, "ramp", alpha_u)])
                .layers(&[LayerKind::Normal, LayerKind::CurvatureAlongView])
                .seen_along(direction);
            let shot = one_plane(&bare).in_number(number).with(|s| {
                s.contours = kappa.map(|kappa| Contours { kappa, ..Contours::default() });
            });
            let shown = shot.render();
            for ((pixel, n), k) in shown
                .pixels()
                .into_iter()
                .zip(shown.layer::<3>(LayerKind::Normal))
                .zip(shown.one(LayerKind::CurvatureAlongView))
            {
                assert_eq!([n[0], n[1], n[2].abs()], [0.0, 0.0, 1.0]);
                // Second differences of whole and half numbers are exact.
                assert_eq!(k, 0.0, "{kappa:?}");
                let alpha = alpha_u.powf(0.5 + (1.0 - tau) * (1.0 - g));
                // Around the middle of the ramp's texels, N = 0.
                for (c, straight) in [0.5, 0.5, 0.5, 1.0].into_iter().enumerate() {
                    largest = worse(largest, (pixel[c] - straight * alpha).abs());
                }
            }
        }
    }
    largest
}

/// Values at the exact ends: i = 0 and i = N − 1, where i₀ + 1 is no node, w = 0, and no style beyond the last is read. Bytes
/// from 0 to 255 under nodes over values, normalized values and per cents; 0.1 and 0.7 have no exact halves or thirds.
fn exact_ends(number: Number) -> f64 {
    let mut largest = 0.0;
    let styles = || vec![plain("red", [1.0, 0.0, 0.0, 1.0]), plain("blue", [0.0, 0.0, 1.0, 1.0])];
    // Half of the voxels have the least value, half the largest.
    let volume = |slope, intercept| {
        let grid = Grid::with_spacing([8, 5, 5], [1.0; 3]).unwrap();
        let bytes = crate::common::positions(&grid).map(|p| if p.x < 4.0 { 0 } else { 255 }).collect();
        Volume::new(grid, Voxels::U8(bytes), slope, intercept).unwrap()
    };
    for (slope, intercept) in [(1.0, 0.0), (0.1, 0.7), (-0.1, 1000.3)] {
        let volume = volume(slope, intercept);
        let [lo, hi] = volume.range();
        // Where the slope falls the byte 0 is the highest value.
        let (left, right) = if slope > 0.0 { (0, 1) } else { (1, 0) };
        for (unit, ends) in [(Unit::Value, [lo, hi]), (Unit::Normalized, [0.0, 1.0]), (Unit::Percentile, [0.0, 100.0])]
        {
            for mix in [Mix::Premultiplied, Mix::Printed] {
                let nodes = [(ends[0], "red", 0.25), (ends[1], "blue", 0.75)];
                let shot = Stage::styled(volume.clone(), styles(), &nodes).with_transfer(|t| {
                    (t.unit, t.mix, t.transparency) = (unit, mix, Transparency::Plain);
                });
                // Pixels of 1½ voxels, none of which looks between the halves.
                let row = one_plane(&shot).in_number(number).with(|s| {
                    s.picture.size = [4, 1];
                    s.camera.projection = orthographic(Some(1.5)).projection;
                });
                let expected = [[0.25, 0.0, 0.0, 0.25], [0.0, 0.0, 0.75, 0.75]];
                for (t, pixel) in row.render().pixels().into_iter().enumerate() {
                    let end = expected[if t < 2 { left } else { right }];
                    largest = (0..4).map(|c| (pixel[c] - end[c]).abs()).fold(largest, worse);
                }
            }
        }
    }
    largest
}

/// An eye inside the volume at 120°: in the corners samples are √7 = 2.65 Δ apart. A linear field has one N, one |g| and, per
/// ray, one |N·v|, so A = 1 − (1 − α_u^(½ + |N·v|(1 − |g|)))^(nΔ/(Δ₀ cosφ)) of n samples, and the colour is that of the
/// lookup: N in the eye's frame, N turned by v onto z in the view's. A correction for Δ in place of Δ_ray would be off by the
/// factor 2.65 in the exponent.
fn wide_picture(number: Number) -> f64 {
    let mut largest = 0.0;
    let (alpha_u, step) = (0.02f64, 0.25);
    let gradient = DVec3::new(0.2, 0.5, -0.1);
    let grid = Grid::with_spacing([12, 9, 10], [1.0, 1.25, 0.8]).unwrap();
    let centre = grid.centre();
    let shot = Stage::styled(on(grid, |p| gradient.dot(p)), vec![ramp()], &[(0.0, "ramp", alpha_u)])
        .layers(&[LayerKind::Counts])
        .with(|s| {
            s.camera = perspective(120.0);
            s.camera.eye = Some(centre);
            s.camera.direction = DVec3::new(0.6, 0.7, 0.2);
            s.camera.direction_given = true;
            s.sampling.step = Length::World(step);
            s.sampling.reference_length = Length::World(1.0);
            s.picture.size = [17, 17];
            s.sampling.number = number;
        });
    let view = shot.view();
    let n = view.direction_to_eye(-gradient.normalize());
    for frame in [SphereFrame::Eye, SphereFrame::View] {
        let shown = shot.with_transfer(|t| t.sphere_frame = frame).render();
        let mut widest = 0.0f64;
        for (t, (pixel, samples)) in shown.pixels().into_iter().zip(shown.one(LayerKind::Counts)).enumerate() {
            let ray = view.ray((t % 17) as f64 + 0.5, (t / 17) as f64 + 0.5);
            let n_v = n.dot(ray.v).abs();
            let alpha = alpha_u.powf(0.5 + n_v * (1.0 - gradient.length()));
            let expected = corrected(alpha, samples * step / ray.cos_phi);
            assert!(samples > 5.0, "{frame:?} {t}");
            largest = worse(largest, (pixel[3] - expected).abs());
            widest = widest.max(1.0 / ray.cos_phi);
            let [x, y] = match frame {
                SphereFrame::Eye => [n.x, n.y],
                SphereFrame::View => {
                    let turned = drypoint::scene::glam::DQuat::from_rotation_arc(ray.v, DVec3::Z) * n;
                    [turned.x, turned.y]
                }
            };
            // A ramp is what the filter has exactly, but beyond the centres of the outermost texels.
            if x.hypot(y) < 1.0 - 1.0 / 128.0 {
                for (c, found) in [x, y].into_iter().zip(pixel) {
                    largest = worse(largest, (found / pixel[3] - (1.0 + c) / 2.0).abs());
                }
            }
        }
        assert!(widest > 2.5, "{widest}");
    }
    largest
}

/// A picture of one pixel is the middle of one of nine, with contours, eq. 2 and κ along the ray: X = ((i + ½) − W/2)p = 0 in
/// both. And a style of one texel is one colour, which no contour can push off its place.
#[test]
fn a_picture_of_one_pixel_and_a_style_of_one_texel() {
    let ball = crate::common::ball(14, 5.0);
    let nodes = [(-1.0, "s", 0.0), (2.0, "s", 0.6)];
    let edge = style("s", 64, |x, y| [0.5 + 0.5 * x, 0.5 + 0.5 * y, 0.2, (x * x + y * y).min(1.0)]);
    let shot = Stage::styled(ball.clone(), vec![edge], &nodes).seen_along([0.3, 0.8, -0.4]).with(|s| {
        s.contours = Some(Contours::default());
        s.picture.size = [3, 3];
        s.camera.projection = orthographic(Some(9.0)).projection;
    });
    let one = shot.with(|s| {
        s.picture.size = [1, 1];
        s.camera.projection = orthographic(Some(3.0)).projection;
    });
    assert!(shot.render().pixels()[4][3] > 0.0);
    assert_eq!(one.render().pixels(), [shot.render().pixels()[4]]);
    let texel = Stage::styled(ball, vec![plain("s", [0.3, 0.6, 0.9, 1.0])], &[(0.0, "s", 0.0), (0.0, "s", 1.0)]);
    let pushed = texel.with(|s| s.contours = Some(Contours { thickness: Length::World(9.0), ..Contours::default() }));
    assert_eq!(pushed.render().bits(), texel.render().bits());
    assert!(texel.render().pixels().iter().all(|p| p[3] == 0.0 || *p == in_a_texture([0.3, 0.6, 0.9, 1.0])));
}

/// One sample a ray, on the plane through the middle of the volume, and nothing to correct.
fn one_plane(shot: &Stage) -> Stage {
    let centre = shot.volume.grid().centre();
    shot.step(64.0).with(|s| {
        s.camera.projection = orthographic(Some(3.0)).projection;
        s.camera.eye = Some(centre - s.camera.direction * 32.0);
        s.camera.direction_given = true;
    })
}
