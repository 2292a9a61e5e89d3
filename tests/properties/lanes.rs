//! Rays side by side are rays alone: no bit of the picture and no count tells them apart.

use super::generator::{resized, scene};
use crate::common::{Shown, Stage};
use drypoint::scene::tables::{
    BlendSpace, GradientEstimator, HessianEstimator, Kappa, Kernel, NormalSide, Number, RaysPerPixel, Sampling,
    ShadingModel, StepAlong, Table, TransferKind,
};
use std::collections::BTreeMap;

/// A random scene made into such as lanes serve with the trilinear kernel.
fn trilinear(seed: u64) -> Stage {
    shot(seed, |sampling| {
        sampling.kernel = Kernel::Trilinear;
        sampling.gradient = if seed.is_multiple_of(3) { GradientEstimator::Sobel } else { GradientEstimator::Central };
        sampling.hessian = HessianEstimator::Auto;
    })
}

/// A random scene made into such as lanes serve, with all else as it came: cameras, steps, spacings, stored types, slopes,
/// functions with steps and empty stretches, materials, sides of normals, ends of rays. The picture is no multiple of a block.
fn shot(seed: u64, sampled: impl Fn(&mut Sampling)) -> Stage {
    let shot = scene(seed).with(|s| {
        sampled(&mut s.sampling);
        s.sampling.number = Number::F64;
        s.picture.layers = Vec::new();
        s.picture.blend_space = BlendSpace::Linear;
        s.style_mipmaps = None;
        s.surface = None;
        // Tones, silhouettes and view-dependent opacity are cast ray by ray.
        if let Some(shading) = &mut s.shading {
            (shading.model, shading.silhouette, shading.view_opacity) = (ShadingModel::Phong, None, 0.0);
        }
        match (&mut s.contours, s.transfer.as_ref().map(|t| t.kind)) {
            (_, Some(TransferKind::Style)) => {}
            (contours, _) => *contours = None,
        }
        if let Some(transfer) = &mut s.transfer {
            transfer.table = Table::Exact;
        }
    });
    resized(&shot, [37, 19])
}

/// The picture, if lanes serve the scene, after it was compared with that of rays alone.
fn compared(seed: u64, shot: &Stage) -> Option<Shown> {
    let (alone, lanes) = shot.render_ray_by_ray();
    if !lanes {
        return None;
    }
    let together = shot.render();
    assert_eq!(together.bits(), alone.bits(), "seed {seed}: {:?}", shot.scene);
    let counts = |s: &Shown| {
        let c = &s.counts;
        (c.samples, c.gradients, c.hessians, c.style_lookups, c.without_normal, c.rays, c.rays_skipped, c.masked)
    };
    assert_eq!(counts(&together), counts(&alone), "seed {seed}: {:?}", shot.scene);
    Some(together)
}

/// Whether nothing is in lanes because the processor has no wide registers.
fn narrow() -> bool {
    !(cfg!(target_arch = "x86_64") && std::arch::is_x86_feature_detected!("avx2"))
}

#[test]
fn lanes_show_nowhere() {
    let (mut in_lanes, mut shaded, mut ended, mut along_rays) = (0, 0, 0, 0);
    for seed in 5000..7200 {
        let shot = trilinear(seed);
        if shot.scene.transfer.as_ref().is_none_or(|t| t.kind != TransferKind::Regular) {
            continue;
        }
        let Some(together) = compared(seed, &shot) else { continue };
        in_lanes += 1;
        shaded += usize::from(together.counts.gradients > 0);
        ended += usize::from(
            together.pixels().iter().any(|p| p[3] >= 1.0) && shot.scene.picture.samples == RaysPerPixel::Across(1),
        );
        along_rays += usize::from(shot.scene.sampling.step_along == StepAlong::Ray && together.counts.samples > 0);
    }
    println!("{in_lanes} scenes in lanes, {shaded} shaded, {ended} with rays that end, {along_rays} along rays");
    assert!(narrow() || (in_lanes > 50 && shaded > 15 && ended > 20 && along_rays > 15));
}

#[test]
fn nor_with_styles() {
    let (mut styled, mut in_lanes, mut shown, mut mixed, mut curved, mut constant) = (0, 0, 0, 0, 0, 0);
    let (mut facing, mut sobel, mut without, mut exact) = (0, 0, 0, 0);
    for seed in 5000..6500 {
        let shot = trilinear(seed);
        if shot.scene.transfer.as_ref().is_none_or(|t| t.kind != TransferKind::Style) {
            continue;
        }
        styled += 1;
        let Some(together) = compared(seed, &shot) else { continue };
        let (scene, counts) = (&shot.scene, &together.counts);
        in_lanes += 1;
        if counts.style_lookups == 0 {
            continue;
        }
        shown += 1;
        // Without κ there is a gradient for each visible sample, and a second lookup where two styles mix.
        let kappa = scene.contours.as_ref().map(|c| c.kappa);
        mixed += usize::from(kappa.is_none() && counts.style_lookups > counts.gradients);
        curved += usize::from(kappa == Some(Kappa::Ray) && counts.gradients > 0);
        constant += usize::from(matches!(kappa, Some(Kappa::None { .. })));
        exact += usize::from(counts.hessians > 0);
        facing += usize::from(scene.sampling.normal == NormalSide::Facing);
        sobel += usize::from(scene.sampling.gradient == GradientEstimator::Sobel);
        without += usize::from(counts.without_normal > 0);
    }
    println!(
        "{in_lanes} of {styled} scenes of styles in lanes; of {shown} that show something {mixed} mix styles, {curved} have \
         contours by curvature, {exact} by Hessians, {constant} by a threshold, {facing} facing normals, {sobel} Sobel's, {without} samples \
         without a normal"
    );
    let enough = [
        in_lanes > 100,
        shown > 60,
        mixed > 10,
        curved > 20,
        constant > 5,
        facing > 10,
        sobel > 20,
        without > 10,
        exact > 5,
    ];
    assert!(narrow() || enough.iter().all(|&e| e), "{enough:?}");
}

/// Values of more than eight voxels are asked for one by one, in cells that can show something alone.
#[test]
fn nor_with_other_kernels() {
    let (mut kernels, mut estimators) = (BTreeMap::new(), BTreeMap::new());
    let (mut skipped, mut ended, mut exact, mut short) = (0, 0, 0, 0);
    for seed in 5000..6500 {
        let shot = shot(seed, |_| ());
        let sampling = &shot.scene.sampling;
        if sampling.kernel == Kernel::Trilinear {
            continue;
        }
        let Some(together) = compared(seed, &shot) else { continue };
        let counts = &together.counts;
        if counts.samples == 0 {
            continue;
        }
        *kernels.entry(format!("{:?}", sampling.kernel)).or_insert(0) += 1;
        if counts.gradients > 0 {
            *estimators.entry(format!("{:?}", sampling.gradient)).or_insert(0) += 1;
        }
        skipped += usize::from(counts.bytes.contains_key("cells"));
        ended += usize::from(
            together.pixels().iter().any(|p| p[3] >= 1.0) && shot.scene.picture.samples == RaysPerPixel::Across(1),
        );
        exact += usize::from(counts.hessians > 0);
        short += usize::from(shot.volume.dims().iter().any(|&n| n < 4));
    }
    println!(
        "{kernels:?}, {estimators:?}, {skipped} skip cells, {ended} have rays that end, {exact} Hessians, \
         {short} short axes"
    );
    let enough = [skipped > 40, ended > 15, exact > 5, short > 3];
    let all =
        kernels.len() == 4 && estimators.len() == 4 && kernels.values().chain(estimators.values()).all(|&n| n > 5);
    assert!(narrow() || (all && enough.iter().all(|&e| e)), "{kernels:?} {estimators:?} {enough:?}");
}
