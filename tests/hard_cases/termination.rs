//! Early termination ([RAY-2]): it costs at most ε·c_max a channel, and ends where the opacity is reached.

use crate::common::{Stage, ball, largest_difference};
use crate::stability::{Case, Theme, U, worse};
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{Background, BlendSpace, Number, Shading};

pub(crate) static THEME: Theme = Theme::new(
    "Early termination",
    &[
        Case {
            name: "rays that end at A ≥ 1 − ε, ε from 10⁻⁶ to 0.99",
            breaks: "a bright thing behind a dark one is lost, above all in sRGB sums, whose curve is steep in the dark",
            done: "the opacity that ends a ray follows from ε and the blend space [RAY-2]",
            of: "largest difference of a channel in units of ε c_max; Phong up to 2.3, bright backgrounds, both blend spaces",
            bound: 1.0,
            why: "what is left out weighs at most ε, in colours of at most c_max",
            measure: || cut_off(Number::F64),
        },
        Case {
            name: "black up to A = 1 − ε, then white, summed in sRGB",
            breaks: "decoding multiplies the error by the slope of the curve",
            done: "as above",
            of: "largest difference of a channel in units of ε; opacities around the limit",
            bound: 1.0,
            why: "as above, with c_max = 1",
            measure: steepest,
        },
        Case {
            name: "rays that end at A ≥ 1 − ε in f32, ε from 10⁻³ to 0.99",
            breaks: "as above; 1 − ε that rounds up",
            done: "as above",
            of: "largest difference of a channel in units of 1.001 ε c_max, after 4 u a sample",
            bound: 1.0,
            why: "as above; 1 − ε rounds by u, and what is left out by 4 u a sample",
            measure: || cut_off(Number::F32),
        },
    ],
);

#[test]
fn early_termination() {
    THEME.hold();
}

/// A soft ball with a bright core behind a dark shell: what is cut off is the brightest there is.
fn soft() -> Stage {
    let nodes = [(-2.0, [0.1, 0.05, 0.0], 0.0), (1.0, [0.2, 0.1, 0.0], 0.3), (4.0, [0.5, 1.0, 0.2], 0.5)];
    Stage::regular(ball(20, 8.0), &nodes)
        .seen_along([0.3, 0.8, 0.2])
        .with(|s| s.picture.background = Background::Color([1.0, 0.9, 0.8, 1.0]))
}

/// Where A ≥ 1 − ε what is left out has a weight of at most ε in all, of colours up to c_max; the background, which is
/// drawn with 1 − A, among them. In linear light also where the sums are encoded.
fn cut_off(number: Number) -> f64 {
    let mut largest = 0.0;
    let (rounding, share, epsilons) = match number {
        Number::F64 => (1e-15, 1.0, &[1e-6, 1e-3, 0.1, 0.5, 0.99][..]),
        // A ray of the diagonal of 20³ voxels has 66 samples.
        Number::F32 => (66.0 * 4.0 * U, 1.001, &[1e-3, 0.1, 0.5, 0.99][..]),
    };
    let bright = Shading { ambient: 0.5, diffuse: 1.0, specular: 0.8, ..Shading::default() };
    for (shading, brightest) in [(None, 1.0), (Some(bright), 2.3)] {
        for (space, background) in [
            (BlendSpace::Linear, Background::Color([1.0, 0.9, 0.8, 1.0])),
            (BlendSpace::Srgb, Background::Color([1.0, 0.9, 0.8, 1.0])),
            (BlendSpace::Srgb, Background::Color([0.0, 0.0, 0.0, 1.0])),
        ] {
            let shot = soft().with(|s| {
                s.shading = shading.clone();
                s.picture.blend_space = space;
                s.picture.background = background;
                s.sampling.number = number;
            });
            let whole = shot.render();
            for &epsilon in epsilons {
                let cut = shot.with(|s| s.sampling.stop_below = epsilon).render();
                let difference = largest_difference(&whole, &cut);
                largest = worse(largest, (difference - rounding).max(0.0) / (share * epsilon * brightest));
                assert!(cut.counts.samples <= whole.counts.samples);
                if epsilon >= 0.1 {
                    assert!(difference > 0.0 && cut.counts.samples < whole.counts.samples, "{epsilon}");
                }
            }
        }
    }
    largest
}

/// The worst that can be cut off: black up to A = 1 − ε, then nothing but white, composited encoded.
fn steepest() -> f64 {
    let mut largest = 0.0;
    for epsilon in [0.02, 0.2, 0.6] {
        for share in [0.999_9, 1.0, 1.000_1, 2.0] {
            // One black sample leaves `share` of what the bound lets through, all others are white and opaque.
            let through = (epsilon * share / 2.4f64).min(0.99);
            let slab = crate::common::volume([4, 3, 4], |p| p.y);
            let nodes = [(0.0, [0.0; 3], 1.0 - through), (0.5, [1.0; 3], 1.0), (2.0, [1.0; 3], 1.0)];
            let shot = Stage::regular(slab, &nodes).step(1.0).with(|s| {
                s.picture.blend_space = BlendSpace::Srgb;
                s.picture.size = [1, 1];
                // Planes at half depths: one in each voxel's plane.
                s.camera.eye = Some(drypoint::scene::glam::DVec3::new(1.5, -0.5, 1.5));
                s.camera.direction_given = true;
            });
            let cut = shot.with(|s| s.sampling.stop_below = epsilon);
            let difference = largest_difference(&shot.render(), &cut.render());
            largest = worse(largest, difference / epsilon);
            assert_eq!(difference > 0.0, share < 1.000_01, "{epsilon} {share}: {difference}");
        }
    }
    largest
}

/// A ray ends at the first sample with A ≥ 1 − ε: opacities ½ a sample reach ¾ at the second and 1 − 2⁻ⁿ at the n-th.
#[test]
fn rays_end_at_the_sample_that_reaches_the_bound() {
    let shot = Stage::regular(crate::common::volume([4, 51, 4], |_| 1.0), &[(0.0, [1.0; 3], 0.5)])
        .layers(&[LayerKind::Counts])
        .step(1.0)
        .with(|s| {
            s.camera.projection = crate::common::orthographic(Some(2.0)).projection;
            s.picture.size = [2, 2];
        });
    let ends = |epsilon: f64| {
        let counts = shot.with(|s| s.sampling.stop_below = epsilon).render().one(LayerKind::Counts);
        assert!(counts.iter().all(|c| *c == counts[0]));
        counts[0]
    };
    // Planes at half depths about the middle of 50: 50 of them. 0 is never, also behind what is all but opaque.
    assert_eq!([0.0, 1e-14, 1e-9, 0.25, 0.26, 0.125, 0.5, 0.6].map(ends), [50.0, 47.0, 30.0, 2.0, 2.0, 3.0, 1.0, 1.0]);
}
