//! The same bits on every machine ([PREC-4]): small pictures, held by their hashes. Another target has to arrive at
//! the same; a change of a formula that moves a bit has to change them here, and to say why.

use crate::common::{Stage, perspective, style};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{Contours, GradientRange, Kappa, Kernel, Length, Number, RaysPerPixel, Shading};
use drypoint::scene::{phantom, space::Grid, volume::VoxelType};

/// FNV-1a over the bytes of every number, lowest first.
fn fnv(bits: impl IntoIterator<Item = u64>) -> u64 {
    bits.into_iter()
        .flat_map(u64::to_le_bytes)
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

fn torus() -> drypoint::scene::volume::Volume {
    let grid = Grid::with_spacing([32, 32, 20], [1.0, 1.0, 1.25]).unwrap();
    let params = [("R".to_owned(), 9.0), ("r".to_owned(), 4.0)];
    let torus = phantom::for_type("torus", &grid, VoxelType::U8, &params).unwrap();
    phantom::sample(torus.as_ref(), grid, VoxelType::U8).unwrap()
}

fn framed(shot: Stage) -> Stage {
    shot.with(|s| {
        s.camera = perspective(35.0);
        s.camera.direction = DVec3::new(-0.6, 0.5, -0.7);
        s.picture.size = [48, 40];
    })
}

#[test]
fn a_style_picture_with_contours() {
    let tone = style("tone", 32, |x, y| {
        let light = (0.5 + 0.4 * y - 0.3 * x).clamp(0.0, 1.0);
        [0.2 + 0.7 * light, 0.1 + 0.8 * light, 0.3, 0.6 + 0.4 * (x * x + y * y).min(1.0)]
    });
    let nodes = [(60.0, "tone", 0.0), (110.0, "tone", 0.15), (200.0, "tone", 0.8)];
    let shot = framed(Stage::styled(torus(), vec![tone], &nodes)).layers(&[LayerKind::Curvature, LayerKind::Depth]);
    let shot = shot.with(|s| {
        s.contours = Some(Contours {
            thickness: Length::Voxels(1.5),
            kappa: Kappa::Exact,
            fade: Some([0.02, 0.1]),
            ..Contours::default()
        });
        s.volume.gradient_range = GradientRange::Quantile(0.999);
    });
    let shown = shot.render();
    assert!(shown.covered() > 150);
    assert_eq!(fnv(shown.bits()), 0x5447_60a7_de0c_5b82);
}

/// Parallel rays, whose steps are all half the reference length, in both number types. The hash of f64 is that of opacities
/// corrected with a square root (2026-11-23); those of f32, rounded from f64 once, did not move.
#[test]
fn a_picture_of_half_steps() {
    let nodes = [(60.0, [0.6, 0.3, 0.1], 0.0), (128.0, [0.8, 0.6, 0.3], 0.4), (255.0, [1.0, 0.9, 0.8], 0.9)];
    for (number, hash) in [(Number::F64, 0x88b0_f665_817a_ed6c), (Number::F32, 0x3e82_da39_4785_7ea4)] {
        let shot = Stage::regular(torus(), &nodes).with(|s| {
            s.camera.direction = DVec3::new(-0.6, 0.5, -0.7);
            s.picture.size = [48, 40];
            s.sampling.number = number;
            s.sampling.step = Length::Voxels(0.5);
            s.sampling.reference_length = Length::Voxels(1.0);
        });
        let shown = shot.render();
        assert!(shown.covered() > 150);
        assert_eq!(fnv(shown.bits()), hash, "{number:?}");
    }
}

#[test]
fn a_lit_picture() {
    let nodes = [(60.0, [0.6, 0.3, 0.1], 0.0), (128.0, [0.8, 0.6, 0.3], 0.4), (255.0, [1.0, 0.9, 0.8], 0.9)];
    let shot = framed(Stage::regular(torus(), &nodes)).layers(&[LayerKind::Normal]).with(|s| {
        s.sampling.kernel = Kernel::CatmullRom;
        s.shading = Some(Shading { shininess: 17.5, ..Shading::default() });
        s.picture.samples = RaysPerPixel::Across(2);
    });
    let shown = shot.render();
    assert!(shown.covered() > 150);
    assert_eq!(fnv(shown.bits()), 0x38bf_7b98_5966_732a);
}
