//! What halos cost, by counts ([HALO-9]): few buffers, as many for any number of planes, and nothing without a halo.

use crate::common::{Stage, orthographic, volume};
use drypoint::scene::glam::DVec3;
use drypoint::scene::tables::{GradientRange, Halo, HaloKind, Length, RaysPerPixel, SeedValue};

/// A ball in 20³ voxels and 40 × 30 pixels.
fn stage(halos: &[Halo]) -> Stage {
    let field = volume([20; 3], |p| 6.0 - (p - DVec3::splat(9.5)).length());
    Stage::regular(field, &[(-0.5, [0.6; 3], 0.0), (0.5, [0.6; 3], 0.3)]).with(|s| {
        s.camera = orthographic(Some(20.0));
        s.camera.direction = DVec3::new(0.2, 1.0, -0.3);
        s.picture.size = [40, 30];
        s.sampling.reference_length = Length::World(1.0);
        s.halos = halos.to_vec();
    })
}

/// Two halos of each kind.
fn four() -> Vec<Halo> {
    let halo = |i: usize| {
        let kind = [HaloKind::Emissive, HaloKind::Occlusive][i % 2];
        Halo { name: format!("{i}"), kind, accumulate: kind.accumulation(), ..Halo::default() }
    };
    (0..4).map(halo).collect()
}

/// A halo has at most seven images: two of seeds, four between seeds and intensities, one of occlusion. Their size is that
/// of the rays with a guard band of 17 for N = 4, whatever the number of planes.
#[test]
fn seven_images_a_halo_and_none_a_plane() {
    for samples in [1usize, 2] {
        for count in [1, 2, 4] {
            let bytes = |step: f64| {
                let shown = stage(&four()[..count]).with(|s| {
                    s.sampling.step = Length::World(step);
                    s.picture.samples = RaysPerPixel::Across(samples);
                });
                shown.render().counts.bytes
            };
            let (coarse, fine) = (bytes(1.0), bytes(0.125));
            // The guard band is stretched with the rays of a pixel.
            let rays = [40, 30].map(|pixels| (pixels * samples + 2 * (16 * samples + 1)) as u64);
            // The ends of what is not zero in each row are no image, and neither is a row of zeros.
            let image = 8 * rays[0] * rays[1] + 16 * rays[1] + 8 * rays[0];
            assert!(coarse["halos"] <= count as u64 * 7 * image, "{} of {}", coarse["halos"], 7 * image);
            assert!(coarse["halos"] >= count as u64 * 8 * rays[0] * rays[1]);
            assert_eq!(coarse["halos"], fine["halos"], "{samples} {count}");
            // Rays begin and end at other planes, in a brick more or less.
            for (buffer, bytes) in coarse {
                assert!(bytes.abs_diff(fine[&buffer]) * 20 <= bytes, "{buffer}: {bytes}, {}", fine[&buffer]);
            }
        }
    }
}

/// Of bands of rays one at a time is in memory, and the renderer tells its bytes before.
#[test]
fn bands_of_rays_take_the_memory_of_one() {
    let stage = stage(&four()).with(|s| s.picture.size = [40, 120]);
    let bytes = |band: usize| {
        let mut foretold = 0;
        let shown = stage.render_by(|renderer| {
            let renderer = renderer.with_band(band);
            foretold = renderer.bytes_of_halos();
            renderer
        });
        let found: u64 = ["halos", "rays", "seed_rays"].iter().map(|buffer| shown.counts.bytes[*buffer]).sum();
        assert!(found <= foretold && foretold < 3 * found, "{found} {foretold}");
        found
    };
    let (whole, bands) = (bytes(1 << 20), bytes(1));
    assert!(2 * bands < whole, "{bands} {whole}");
}

#[test]
fn without_a_halo_there_is_nothing_of_it() {
    let unseen = Halo { opacity: 0.0, ..Halo::default() };
    for halos in [vec![], vec![unseen]] {
        let counts = stage(&halos).render().counts;
        assert_eq!((counts.halo_samples, counts.halo_passes, counts.gradients), (0, 0, 0));
        for buffer in ["halos", "seed_rays", "rays", "skip_seeds"] {
            assert!(!counts.bytes.contains_key(buffer), "{buffer}");
        }
        assert!(!counts.preprocess.contains_key("gradients") && counts.samples > 1000);
    }
}

/// A picture without light has gradients at seeds alone: none of visible samples that do not seed, and as many of samples
/// that seed, seen or not.
#[test]
fn visible_samples_have_no_gradients() {
    let seeds = |nodes: &[[f64; 2]]| {
        // A glow is there without a sample that it tints.
        let mut halo = Halo { kind: HaloKind::Emissive, ..Halo::default() };
        halo.seed.value = Some(SeedValue::Nodes(nodes.to_vec()));
        let ranged = stage(&[halo]).with(|s| s.volume.gradient_range = GradientRange::Fixed([0.0, 1.0]));
        let hidden = ranged.with_transfer(|t| t.nodes.iter_mut().flatten().for_each(|node| node.opacity = 0.0));
        [ranged, hidden].map(|stage| stage.render().counts)
    };
    // No value is as high as 50.
    let [none, _] = seeds(&[[50.0, 0.0], [51.0, 1.0]]);
    assert_eq!((none.gradients, none.halo_passes), (0, 0));
    assert!(none.samples > 1000);
    let [shown, hidden] = seeds(&[[-1.0, 0.0], [0.0, 1.0]]);
    assert!(shown.gradients > 1000 && shown.gradients < shown.halo_samples);
    assert_eq!((shown.gradients, shown.without_normal), (hidden.gradients, hidden.without_normal));
    assert!(shown.halo_samples >= hidden.halo_samples && hidden.samples < shown.samples);
}
