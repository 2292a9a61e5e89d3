//! A halo belongs to the picture, not to the frame about it ([HALO-4], [HALO-5]).

use crate::common::{Stage, largest_difference, orthographic, perspective, volume};
use crate::volumeshop::{SHELLS, drawn, layer, scene_of};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{Halo, HaloKind, Length, RaysPerPixel, SeedBy};

/// Crossing tubes.
fn tubes() -> Stage {
    let field = volume([40; 3], |p: DVec3| {
        let a = 4.0 - DVec3::new(p.x - 14.0, p.y - 12.0, 0.0).length();
        let b = 3.0 - DVec3::new(0.0, p.y - 24.0, p.z - 20.0).length();
        a.max(b)
    });
    Stage::regular(field, &[(-0.5, [0.7, 0.5, 0.3], 0.0), (0.5, [0.7, 0.5, 0.3], 0.6)]).with(|s| {
        s.camera = orthographic(Some(32.0));
        s.camera.direction = DVec3::new(0.1, 1.0, 0.2);
        s.picture.size = [64, 64];
        let mut glow = Halo { kind: HaloKind::Emissive, name: "glow".into(), opacity: 0.3, ..Halo::default() };
        glow.profile[0].rgb = [1.0, 0.8, 0.2];
        s.halos = vec![Halo { name: "dark".into(), ..Halo::default() }, glow];
    })
}

/// A crop of a picture is the picture of the crop, to the bit: structures that the frame cuts have their seeds beyond it.
#[test]
fn a_crop_is_the_picture_of_the_crop() {
    for samples in [1, 2] {
        let layers = [LayerKind::Halo(0), LayerKind::Halo(1)];
        let whole = tubes().with(|s| s.picture.samples = RaysPerPixel::Across(samples)).layers(&layers);
        let crop = whole.with(|s| {
            // A quarter of the height at the same pixel pitch, a power of two.
            s.camera = orthographic(Some(8.0));
            s.camera.direction = DVec3::new(0.1, 1.0, 0.2);
            s.picture.size = [32, 16];
        });
        let (whole, crop) = (whole.render(), crop.render());
        for (of_whole, of_crop) in whole.picture.layers.iter().zip(&crop.picture.layers) {
            for (large, small) in of_whole.channels.iter().zip(&of_crop.channels) {
                let cut: Vec<f64> = (24..40).flat_map(|y| large[y * 64 + 16..y * 64 + 48].iter().copied()).collect();
                let same = cut.iter().zip(small).all(|(a, b)| a.to_bits() == b.to_bits());
                assert!(same, "{} with {samples}", of_whole.kind);
                assert!(small.iter().any(|v| *v != small[0]), "{}", of_whole.kind);
            }
        }
    }
}

/// With a reach in the picture's height H is that of a picture of four times the pixels, averaged over its pixels, but where
/// the first and last planes of a tube cut slivers of its seeds that are thinner than a pixel. Several rays a pixel see these.
#[test]
fn a_reach_is_the_same_at_every_resolution() {
    let with = |side: usize, samples: usize| {
        let stage = tubes().with(|s| {
            s.picture.size = [side; 2];
            s.picture.samples = RaysPerPixel::Across(samples);
            s.halos.truncate(1);
            s.halos[0].spread.reach = Some(Length::Percent(6.0));
            s.halos[0].seed.by = SeedBy::Curvature;
        });
        stage.layers(&[LayerKind::Halo(0)]).render().one(LayerKind::Halo(0))
    };
    let fine = with(1024, 1);
    let mean = |x: usize, y: usize| (0..16).map(|i| fine[(4 * y + i / 4) * 1024 + 4 * x + i % 4]).sum::<f64>() / 16.0;
    for (samples, most, most_rms) in [(1, 131, 0.003), (2, 6, 0.0012)] {
        let h = with(256, samples);
        let apart: Vec<f64> = (0..256 * 256).map(|i| (h[i] - mean(i % 256, i / 256)).abs()).collect();
        let rms = (apart.iter().map(|x| x * x).sum::<f64>() / apart.len() as f64).sqrt();
        let over = apart.iter().filter(|apart| **apart > 0.03).count();
        let largest = apart.iter().copied().fold(0.0, f64::max);
        println!("{samples}×{samples} rays: |ΔH| {largest:.4}, RMS {rms:.5}, {over} pixels over 0.03");
        // 0.2 % and 0.01 % of the pixels.
        assert!(over < most && rms < most_rms, "{over} {rms}");
        assert!(h.iter().copied().fold(0.0, f64::max) > 0.3);
    }
}

/// In perspective a dollied camera moves seeds continuously; here only: nothing depends on the side of the tiles, on threads or
/// on the number type beyond rounding.
#[test]
fn perspective_in_two_number_types() {
    let stage = tubes().with(|s| {
        s.camera = perspective(40.0);
        s.camera.direction = DVec3::new(0.3, 1.0, -0.2);
    });
    let (double, single) = (stage.render(), stage.in_number(drypoint::scene::tables::Number::F32).render());
    let apart = largest_difference(&double, &single);
    assert!(apart > 0.0 && apart < 2e-3, "{apart}");
    assert_eq!(stage.render_in_tiles(32).bits(), double.bits());
}

/// Halos seed apart ([HALO-2]): one by values has the same intensities beside one by the opacity of a function over two
/// quantities, which is 0 at those values.
#[test]
fn a_halo_beside_another_is_the_same() {
    const OVER_TWO: &str = "layers = [\"beauty\", \"halo0\"]\n[transfer]\nkind = \"regular\"\nover = [\"value\", \"gradient-magnitude\"]\n\
        rows = [{ at = 0, nodes = [{ at = 150, color = \"#c08040\", opacity = 0 }, { at = 255, color = \"#c08040\", opacity = 0.5 }] },\n\
        { at = 20, nodes = [{ at = 150, color = \"#80ff40\", opacity = 0 }, { at = 255, color = \"#80ff40\", opacity = 0.2 }] }]\n\
        [shading]\n[[halo]]\nseed.value = [[20, 0], [60, 1], [100, 0]]\n";
    let intensities = |more: &str| {
        let (picture, _) = drawn(&scene_of(SHELLS, &format!("{OVER_TWO}{more}")));
        layer(&picture, LayerKind::Halo(0))[0].clone()
    };
    let alone = intensities("");
    assert!(alone.iter().sum::<f64>() > 1.0, "{alone:?}");
    assert!(alone == intensities("[[halo]]\nseed.value = \"opacity\"\n"));
}
