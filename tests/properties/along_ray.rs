//! κ along the ray ([STF-5]) against a walk that asks the field at each sample and the one before.

use super::generator::{camera, grid};
use crate::common::lattice::sighted;
use crate::common::random::Random;
use crate::common::{Stage, corrected, plain};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind::CurvatureAlongView;
use drypoint::scene::tables::{
    Contours, GradientEstimator, Kappa, Kernel, Length, NormalSide, Outside, SignFlip, StepAlong, Transparency,
};
use drypoint::scene::volume::{Volume, Voxels};

/// Things in noise, opaque or not: the layer is the mean of κ over the samples with α_u > 0 whose cell is not masked, by
/// their weights. The predecessor of a sample is that of plane k − 1, visible or not, skipped, masked (then of the filled
/// volume) or not; κ is 0 where that lies outside the box or at depth ≤ `near`, or where one of the two has no normal, and
/// never that to an older one.
#[test]
fn the_turn_since_the_plane_before() {
    let (mut turned, mut still, mut after_mask) = (0, 0, 0);
    for seed in 0..120 {
        let r = &mut Random(seed ^ 0xfeed);
        let dims = [0; 3].map(|_| 5 + r.below(16));
        let grid = grid(r, dims);
        let cut = r.between(0.3, 0.95);
        let mut voxels: Vec<f64> = (0..grid.len()).map(|_| if r.once_in(3) { 0.5 } else { r.unit() }).collect();
        for _ in 0..r.below(12) {
            let i = r.below(voxels.len());
            voxels[i] = f64::NAN;
        }
        let volume = Volume::new(grid.clone(), Voxels::F64(voxels), 1.0, 0.0).unwrap();
        let alpha = r.pick(&[1.0, 0.6, 0.2]);
        let nodes = [(cut, "a", 0.0), (cut, "a", alpha)];
        let flip = r.pick(&[SignFlip::TwoSided, SignFlip::Literal]);
        let normal = r.pick(&[NormalSide::Outward, NormalSide::Facing, NormalSide::Gradient]);
        let outside = r.pick(&[Outside::Low, Outside::High]);
        let shot = Stage::styled(volume, vec![plain("a", [0.5, 0.5, 0.5, 1.0])], &nodes)
            .with_transfer(|t| t.transparency = Transparency::Plain)
            .layers(&[CurvatureAlongView])
            .with(|s| {
                s.camera = camera(r, &grid);
                s.sampling.kernel = r.pick(&[Kernel::Trilinear, Kernel::Bspline, Kernel::CatmullRom]);
                s.sampling.gradient = r.pick(&[GradientEstimator::Central, GradientEstimator::Analytic]);
                s.sampling.step = Length::Voxels(r.pick(&[0.2, 0.5, 1.0]));
                s.sampling.step_along = r.pick(&[StepAlong::Plane, StepAlong::Ray]);
                s.sampling.normal = normal;
                s.volume.outside = outside;
                s.contours = Some(Contours { kappa: Kappa::Ray, sign_flip: flip, ..Contours::default() });
            });
        let step = shot.scene.sampling.step.world(&grid).unwrap();
        let shells = shot.scene.sampling.step_along == StepAlong::Ray;
        let (view, kappa) = (shot.view(), shot.render().one(CurvatureAlongView));
        for (t, ray) in sighted::<f64>(&shot).into_iter().enumerate() {
            let pixel = view.ray((t % 16) as f64 + 0.5, (t / 16) as f64 + 0.5);
            let v = view.direction_to_world(pixel.v);
            let facing = |n: DVec3| if normal == NormalSide::Facing && n.dot(v) < 0.0 { -n } else { n };
            let outward = |g: DVec3| if outside == Outside::Low { -g } else { g };
            let n = |i: usize| ray[i].gradient.map(|g| facing(outward(g)));
            let ray_step = if shells { step } else { step / pixel.cos_phi };
            let turn = |a: DVec3, b: DVec3| {
                let lines = normal == NormalSide::Facing && flip == SignFlip::TwoSided;
                a.cross(b).length().atan2(if lines { a.dot(b).abs() } else { a.dot(b) }) / ray_step
            };
            let weight = corrected(alpha, ray_step / grid.voxel());
            let (mut sum, mut weights, mut through) = (0.0, 0.0, 1.0);
            for i in (0..ray.len()).filter(|&i| ray[i].value >= cut && !ray[i].masked) {
                let before = i.checked_sub(1).and_then(n);
                let expected = n(i).zip(before).map_or(0.0, |(a, b)| turn(a, b));
                sum += through * weight * expected;
                weights += through * weight;
                through *= 1.0 - weight;
                turned += usize::from(expected > 0.0);
                still += usize::from(expected == 0.0);
                after_mask += usize::from(expected > 0.0 && ray[i - 1].masked);
                if through == 0.0 {
                    break;
                }
            }
            let mean = if weights > 0.0 { sum / weights } else { 0.0 };
            // Angles lose nothing; there are tens of them in a mean.
            let place = format!("seed {seed}, pixel {t}: {} {mean} {:?}", kappa[t], shot.scene);
            assert!((kappa[t] - mean).abs() <= 1e-12 / step, "{place}");
        }
    }
    assert!(turned > 1000 && still > 100 && after_mask > 20, "{turned} {still} {after_mask}");
}
