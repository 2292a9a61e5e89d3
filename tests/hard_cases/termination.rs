//! Early termination ([RAY-2]): it costs at most ε·c_max a channel, and ends where the opacity is reached.

use crate::common::{Shot, ball, largest_difference};
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{Background, Length, Shading};

/// A soft ball with a bright core behind a dark shell: what is cut off is the brightest there is.
fn soft() -> Shot {
    let nodes = [(-2.0, [0.1, 0.05, 0.0], 0.0), (1.0, [0.2, 0.1, 0.0], 0.3), (4.0, [0.5, 1.0, 0.2], 0.5)];
    Shot::regular(ball(20, 8.0), &nodes)
        .seen_along([0.3, 0.8, 0.2])
        .with(|s| s.picture.background = Background::Color([1.0, 0.9, 0.8, 1.0]))
}

/// Where A ≥ 1 − ε what is left out has a weight of at most ε in all, of colours up to c_max; the background, which is
/// drawn with 1 − A, among them.
#[test]
fn the_error_is_bounded_by_epsilon() {
    for (shading, brightest) in
        [(None, 1.0), (Some(Shading { ambient: 0.5, diffuse: 1.0, specular: 0.8, ..Shading::default() }), 2.3)]
    {
        let shot = soft().with(|s| s.shading = shading);
        let whole = shot.render();
        for epsilon in [1e-6, 1e-3, 0.1, 0.5, 0.99] {
            let cut = shot.with(|s| s.sampling.stop_below = epsilon).render();
            let difference = largest_difference(&whole, &cut);
            assert!(difference <= epsilon * brightest + 1e-15, "{epsilon}: {difference}");
            assert!(cut.counts.samples <= whole.counts.samples);
            if epsilon >= 0.1 {
                assert!(difference > 0.0 && cut.counts.samples < whole.counts.samples, "{epsilon}");
            }
        }
    }
}

/// A ray ends at the first sample with A ≥ 1 − ε: opacities ½ a sample reach ¾ at the second and 1 − 2⁻ⁿ at the n-th.
#[test]
fn rays_end_at_the_sample_that_reaches_the_bound() {
    let shot = Shot::regular(crate::common::volume([4, 21, 4], |_| 1.0), &[(0.0, [1.0; 3], 0.5)])
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
    // Planes at half depths about the middle of 20: 20 of them.
    assert_eq!([0.0, 1e-9, 0.25, 0.26, 0.125, 0.5, 0.6].map(ends), [20.0, 20.0, 2.0, 2.0, 3.0, 1.0, 1.0]);
}

/// Never means never: with ε = 0 samples behind almost opaque ones count.
#[test]
fn zero_is_never() {
    let shot = soft().with(|s| s.sampling.step = Length::World(0.25));
    let (never, late) = (shot.render(), shot.with(|s| s.sampling.stop_below = 1e-14).render());
    assert!(never.counts.samples >= late.counts.samples);
    assert!(largest_difference(&never, &late) <= 1e-13);
}
