//! Mip-maps of styles in pictures ([STF-10]): the level of each pixel, and what it does to grain.

use super::smooth;
use crate::common::{Stage, ball, largest_difference, on, orthographic, perspective, plain, style, volume};
use drypoint::reference::style_transfer_functions::{MipMap, SphereMap};
use drypoint::scene::glam::DVec3;
use drypoint::scene::philox::uniforms;
use drypoint::scene::picture::LayerKind::{Beauty, CurvatureAlongView, Gradient, Normal, Z};
use drypoint::scene::space::Grid;
use drypoint::scene::style::Style;
use drypoint::scene::tables::{Contours, GradientRange, Kappa, Length, RaysPerPixel, StyleMipmaps, Transparency};

/// Opaque noise: each texel three numbers of its own.
fn grain(side: usize) -> Style {
    let at = |x: f64| ((x + 1.0) / 2.0 * side as f64) as u32;
    style("grain", side, |x, y| {
        let [r, g, b, _] = uniforms(11, [at(x), at(-y), 0], 0);
        [r, g, b, 1.0]
    })
}

/// Both biases off: what the paper starts from.
fn unbiased() -> StyleMipmaps {
    StyleMipmaps { curvature_bias: 0.0, gradient_bias: 0.0, ..StyleMipmaps::default() }
}

/// A ball of R = 4 voxels, one voxel a pixel, in grain of 1024² texels.
///
/// In an orthographic picture a ball moves the lookup by 512/4 = 128 texels a pixel, everywhere on it. A ray for itself
/// reads a texel of its own: noise u. Of 16 × 16 rays a pixel, 8 texels apart, each reads other texels: noise u/16, so no
/// picture can be more than about 16 times as near to that one as the unfiltered one is. At level λ the noise is about
/// u/2^λ.
///
/// - Unbiased, λ = log₂(512·2/256) = 2: u/4, so four times as near.
/// - κ along the ray is sinθ/R = ρ/16: λ = log₂ 32ρ for ρ > ⅛. The mean of 1/(32ρ)² over the disk, with 1/4² in its middle,
///   is 0.022²: the distance is u√(1/16² + 0.022²), 15 times smaller than u.
/// - Exact κ is ¼: λ = 7, as the picture has it.
///
/// Where 16 × 16 rays do not all hit the ball the pictures differ by how much of a pixel they see covered, which is no
/// matter of styles: these pixels are left out.
#[test]
fn a_grainy_ball_is_as_quiet_as_sixteen_times_sixteen_rays_make_it() {
    let shot = Stage::styled(ball(13, 4.0), vec![grain(1024)], &[(0.0, "grain", 0.0), (0.0, "grain", 1.0)]);
    let exact = Contours { thickness: Length::World(0.0), kappa: Kappa::Exact, ..Contours::default() };
    let ways = [
        (None, None),
        (Some(unbiased()), None),
        (Some(StyleMipmaps::default()), None),
        (Some(StyleMipmaps::default()), Some(exact)),
    ];
    let mut distances = [0.0; 4];
    for part in 0..16 {
        let [dx, dz] = [part % 4, part / 4].map(|i| f64::from(i) / 4.0);
        let shot = shot.with(|s| {
            s.camera.eye = Some(DVec3::new(6.0 + dx, 6.0, 6.0 + dz));
            s.camera.direction_given = true;
            s.camera.projection = orthographic(Some(10.0)).projection;
            s.picture.size = [10, 10];
        });
        let whole = shot.with(|s| s.picture.samples = RaysPerPixel::Across(16)).render().pixels();
        for ((mipmaps, contours), distance) in ways.iter().zip(&mut distances) {
            let shown = shot.with(|s| (s.style_mipmaps, s.contours) = (mipmaps.clone(), contours.clone())).render();
            for (a, b) in shown.pixels().into_iter().zip(&whole).filter(|(_, b)| b[3] > 1.0 - 1e-12) {
                *distance += (0..3).map(|c| (a[c] - b[c]).powi(2)).sum::<f64>();
            }
        }
    }
    let nearer = |way: usize| (distances[0] / distances[way]).sqrt();
    assert!((3.0..5.0).contains(&nearer(1)), "unbiased: {}", nearer(1));
    assert!(nearer(2) >= 10.0, "along the ray: {}", nearer(2));
    assert!(nearer(3) >= 10.0, "exact: {}", nearer(3));
}

/// An opaque ball on voxels of another size: every pixel holds the lookup at the level that the formula gives for the
/// sample's κ, |g| and depth, which the layers have.
#[test]
fn every_pixel_has_the_level_of_the_formula() {
    let (side, range) = (96, [0.2, 1.4]);
    let grid = Grid::with_spacing([36, 27, 18], [0.5, 0.75, 1.0]).unwrap();
    let centre = grid.centre();
    let field = |p: DVec3| (36.0 - (p - centre).length_squared()) / 12.0;
    let styles = vec![grain(side)];
    let (picture, chain) = (SphereMap::new(&styles[0]), MipMap::<f64>::new(&styles[0]));
    let shot = Stage::styled(on(grid, field), styles, &[(0.0, "grain", 0.0), (0.0, "grain", 1.0)])
        .layers(&[CurvatureAlongView, Normal, Gradient, Z])
        .with(|s| {
            s.volume.gradient_range = GradientRange::Fixed(range);
            s.sampling.step = Length::World(0.25);
            s.picture.size = [36, 36];
        });
    let shot = smooth(&shot);
    let tables = [
        StyleMipmaps::default(),
        unbiased(),
        StyleMipmaps { curvature_bias: 0.4, gradient_bias: 2.5, turn: 0.03 },
        StyleMipmaps { turn: 0.0, ..StyleMipmaps::default() },
    ];
    let exact = Contours { thickness: Length::World(0.0), kappa: Kappa::Exact, ..Contours::default() };
    for (camera, contours) in [(orthographic(Some(14.0)), None), (perspective(40.0), Some(exact))] {
        let mut levels = [0; 3];
        for table in &tables {
            let shot = shot.with(|s| {
                let direction = DVec3::new(0.3, 0.9, -0.2);
                s.camera = drypoint::scene::tables::Camera { direction, ..camera.clone() };
                (s.style_mipmaps, s.contours) = (Some(table.clone()), contours.clone());
            });
            let (view, shown) = (shot.view(), shot.render());
            let (kappas, depths) = (shown.one(CurvatureAlongView), shown.one(Z));
            let normals = shown.layer::<3>(Normal).into_iter().zip(shown.layer::<3>(Gradient));
            for (i, ((pixel, (n, g)), (kappa, s))) in
                shown.pixels().into_iter().zip(normals).zip(kappas.into_iter().zip(depths)).enumerate()
            {
                if pixel[3] == 0.0 {
                    continue;
                }
                let p = 0.5 / (view.pixel * if view.perspective { s } else { 1.0 });
                let g = ((DVec3::from_array(g).length() - range[0]) / (range[1] - range[0])).clamp(0.0, 1.0);
                let turn = table.turn.max(table.curvature_bias * (kappa * 0.5).min(1.0));
                let last = (side as f64).log2();
                let lambda = (side as f64 / 2.0 * turn / p).log2() + table.gradient_bias * (1.0 - g);
                let expected = chain.sample(&picture, n[0], n[1], lambda.clamp(0.0, last) - last);
                // λ differs by rounding, which a level's noise has a slope of 1 in; N by a few ε of up to 48 texels.
                let close = (0..4).all(|c| (pixel[c] - expected[c]).abs() < 1e-12);
                assert!(close, "pixel {i}, λ {lambda}: {pixel:?} {expected:?}");
                levels[if lambda <= 0.0 { 0 } else { 1 + usize::from(lambda >= last) }] += 1;
            }
        }
        assert!(levels[0] > 0 && levels[1] > 200, "{levels:?}");
    }
}

/// Where nothing has to be filtered the picture is the one without the table, bit for bit: a flat wall in 256² texels at
/// one voxel a pixel and |g| = 1 has λ = log₂ 1 = 0, and so has every sample where the base and both biases are 0.
#[test]
fn level_0_is_the_unfiltered_picture_bit_for_bit() {
    let nodes = [(0.0, "grain", 0.0), (3.0, "grain", 0.6), (5.0, "grain", 0.9)];
    let wall = Stage::styled(volume([12; 3], |p| p.y + 0.5 * p.x - 6.0), vec![grain(256)], &nodes)
        .with(|s| s.camera.projection = orthographic(Some(16.0)).projection);
    let with = |shot: &Stage, table| shot.with(|s| s.style_mipmaps = Some(table)).render();
    assert_eq!(with(&wall, StyleMipmaps::default()).bits(), wall.render().bits());
    // A larger style has more texels than pixels, and another picture.
    let fine = Stage { styles: vec![grain(512)], ..wall.clone() };
    assert!(largest_difference(&with(&fine, StyleMipmaps::default()), &fine.render()) > 0.01);
    let round = Stage::styled(ball(14, 5.0), vec![grain(64)], &nodes);
    assert_eq!(with(&round, StyleMipmaps { turn: 0.0, ..unbiased() }).bits(), round.render().bits());
    assert!(largest_difference(&with(&round, StyleMipmaps::default()), &round.render()) > 0.01);
}

/// So small that a pixel holds more than the ball, a style is the mean of its disk, whatever the size of its side; and each
/// style is its own mean: one that is all white stays so beside one of noise.
#[test]
fn from_afar_a_style_is_the_mean_of_its_disk() {
    for side in [16, 31] {
        let noise = grain(side);
        let mean = MipMap::<f64>::new(&noise).sample(&SphereMap::new(&noise), 0.0, 0.0, 0.0);
        let styles = vec![noise, plain("white", [1.0; 4])];
        for (name, expected) in [("grain", mean), ("white", [1.0; 4])] {
            let nodes =
                [(0.0, name, 0.0), (0.0, name, 1.0), (9.0, name, 1.0), (9.0, "white", 1.0), (9.0, "grain", 1.0)];
            let far = Stage::styled(ball(14, 5.0), styles.clone(), &nodes).with(|s| {
                s.style_mipmaps = Some(StyleMipmaps::default());
                s.camera = perspective(5.0);
                s.camera.direction = DVec3::Y;
                s.camera.eye = Some(DVec3::new(6.5, -1e6, 6.5));
                s.picture.size = [1, 1];
            });
            let [pixel] = far.render().pixels()[..] else { panic!("one pixel") };
            assert!((0..4).all(|c| (pixel[c] - expected[c]).abs() < 1e-12), "{side} {name}: {pixel:?} {expected:?}");
        }
    }
}

/// n² rays a pixel are those of a picture n times as large ([RAY-6]), with their level of detail: rays are what reads a
/// style, not pixels.
#[test]
fn rays_of_a_divided_pixel_have_the_level_of_a_larger_picture() {
    let nodes = [(-1.0, "grain", 0.0), (2.0, "grain", 0.8)];
    let shot = Stage::styled(ball(16, 6.0), vec![grain(300)], &nodes).with(|s| {
        s.style_mipmaps = Some(StyleMipmaps::default());
        s.camera = perspective(45.0);
    });
    let n = 3;
    let small = shot.with(|s| s.picture.samples = RaysPerPixel::Across(n)).render().pixels();
    let large = shot.with(|s| s.picture.size = [16 * n, 16 * n]).render().pixels();
    for (t, pixel) in small.into_iter().enumerate() {
        let (x, y) = (t % 16 * n, t / 16 * n);
        let parts = || (0..n * n).map(|part| large[(y + part / n) * 16 * n + x + part % n]);
        for c in 0..4 {
            let mean = parts().map(|p| p[c] / (n * n) as f64).sum::<f64>();
            // The size of a voxel in rays rounds, and with it λ.
            assert!((pixel[c] - mean).abs() < 1e-13);
        }
    }
}

/// Only what is called for ([PLAN-1]): chains only with the table and only of styles; κ and |g| only with their biases.
#[test]
fn mip_maps_cost_what_they_are_asked_for() {
    let nodes = [(-1.0, "grain", 0.0), (2.0, "grain", 0.8)];
    let shot = Stage::styled(ball(16, 6.0), vec![grain(12)], &nodes)
        .with_transfer(|t| t.transparency = Transparency::Plain)
        .with(|s| s.volume.gradient_range = GradientRange::Quantile(0.999));
    let bare = shot.render().counts;
    assert!(!bare.bytes.contains_key("style_mipmaps") && !bare.preprocess.contains_key("gradients"));
    let with = |table: StyleMipmaps| shot.with(|s| s.style_mipmaps = Some(table));
    let c = with(unbiased()).render().counts;
    // Sides 6, 3, 2, 1 of four f32.
    assert_eq!(c.bytes["style_mipmaps"], (36 + 9 + 4 + 1) * 16);
    let same = |c: &drypoint::scene::counts::Counts| {
        (c.samples, c.gradients, c.hessians, c.style_lookups, c.preprocess.clone())
    };
    assert_eq!(same(&c), same(&bare));
    let c = with(StyleMipmaps { curvature_bias: 0.0, ..StyleMipmaps::default() }).render().counts;
    assert_eq!((c.gradients, c.preprocess.contains_key("gradients")), (bare.gradients, true));
    let c = with(StyleMipmaps { gradient_bias: 0.0, ..StyleMipmaps::default() }).render().counts;
    assert!(c.gradients > bare.gradients && c.hessians == 0 && !c.preprocess.contains_key("gradients"));
    let exact = Contours { kappa: Kappa::Exact, ..Contours::default() };
    let c = with(StyleMipmaps::default()).with(|s| s.contours = Some(exact)).render().counts;
    assert!(c.gradients == bare.gradients && c.hessians > 0);
    let regular = Stage::regular(ball(16, 6.0), &[(-1.0, [0.2, 0.3, 0.4], 0.1), (2.0, [0.9, 0.3, 0.4], 0.8)]);
    let (without, with) =
        (regular.render(), regular.with(|s| s.style_mipmaps = Some(StyleMipmaps::default())).render());
    assert_eq!(without.bits(), with.bits());
    assert_eq!((same(&without.counts), without.counts.bytes), (same(&with.counts), with.counts.bytes));
}

/// With `kappa = "none"` the scene has no curvature: the bias is without effect, also where a layer shows one.
#[test]
fn without_a_kappa_there_is_no_curvature_to_be_biased_by() {
    let nodes = [(-1.0, "grain", 0.1), (2.0, "grain", 0.8)];
    let shot = Stage::styled(ball(16, 6.0), vec![grain(300)], &nodes).with(|s| {
        s.contours = Some(Contours { kappa: Kappa::None { threshold: 0.3 }, ..Contours::default() });
    });
    let with = |curvature_bias| {
        shot.with(|s| s.style_mipmaps = Some(StyleMipmaps { curvature_bias, ..StyleMipmaps::default() }))
    };
    let none = with(0.0).render();
    assert_eq!(with(1.0).render().bits(), none.bits());
    assert_eq!(with(1.0).render().counts.gradients, none.counts.gradients);
    assert_eq!(with(1.0).layers(&[CurvatureAlongView]).render().layer_bits(Beauty), none.layer_bits(Beauty));
}
