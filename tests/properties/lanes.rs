//! Rays side by side are rays alone: no bit of the picture and no count tells them apart.

use super::generator::{resized, scene};
use crate::common::Shown;
use drypoint::scene::tables::{
    BlendSpace, GradientEstimator, HessianEstimator, Kernel, Number, StepAlong, Table, TransferKind,
};

/// Random scenes made into such as lanes serve, with all else as it came: cameras, steps, spacings, stored types, slopes,
/// functions with steps and empty stretches, materials, sides of normals, ends of rays. The picture is no multiple of a block.
#[test]
fn lanes_show_nowhere() {
    let (mut in_lanes, mut shaded, mut ended, mut along_rays) = (0, 0, 0, 0);
    for seed in 5000..6500 {
        let mut shot = scene(seed);
        if shot.scene.transfer.as_ref().is_none_or(|t| t.kind != TransferKind::Regular) {
            continue;
        }
        shot = shot.with(|s| {
            s.sampling.kernel = Kernel::Trilinear;
            s.sampling.gradient = GradientEstimator::Central;
            s.sampling.hessian = HessianEstimator::Auto;
            s.sampling.number = Number::F64;
            s.picture.layers = Vec::new();
            s.picture.blend_space = BlendSpace::Linear;
            (s.contours, s.surface) = (None, None);
            if let Some(transfer) = &mut s.transfer {
                transfer.table = Table::Exact;
            }
        });
        let shot = resized(&shot, [37, 19]);
        let (alone, lanes) = shot.render_ray_by_ray();
        if !lanes {
            continue;
        }
        let together = shot.render();
        assert_eq!(together.bits(), alone.bits(), "seed {seed}: {:?}", shot.scene);
        let counts = |s: &Shown| {
            let c = &s.counts;
            (c.samples, c.gradients, c.without_normal, c.rays, c.rays_skipped, c.masked)
        };
        assert_eq!(counts(&together), counts(&alone), "seed {seed}: {:?}", shot.scene);
        in_lanes += 1;
        shaded += usize::from(together.counts.gradients > 0);
        ended += usize::from(together.pixels().iter().any(|p| p[3] >= 1.0) && shot.scene.picture.samples == 1);
        along_rays += usize::from(shot.scene.sampling.step_along == StepAlong::Ray && together.counts.samples > 0);
    }
    println!("{in_lanes} scenes in lanes, {shaded} shaded, {ended} with rays that end, {along_rays} along rays");
    // Nothing is compared where the processor has no wide registers.
    let wide = cfg!(target_arch = "x86_64") && std::arch::is_x86_feature_detected!("avx2");
    assert!(!wide || (in_lanes > 50 && shaded > 15 && ended > 20 && along_rays > 15));
}
