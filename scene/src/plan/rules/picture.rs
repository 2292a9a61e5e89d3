//! Rules of `[picture]`: needs, keys without effect, knobs.

use super::halo::{halos_in_effect, is_in_millimetres};
use super::{Ladder, Pass, Rules};
use crate::picture::LayerKind;
use crate::plan::Samples;
use crate::quantity::Quantity;
use crate::tables::contours::{Measured, measured_curvature};

/// The rules of `[picture]`.
pub(super) const RULES: Rules = Rules {
    asks: |scene, asks| {
        if !asks.casts_rays() {
            return;
        }
        for (i, layer) in scene.picture.layers.iter().enumerate() {
            let effect = format!("layer {layer}");
            let key = format!("picture.layers[{i}]");
            let along_view = match measured_curvature(scene) {
                Measured::Exact => Quantity::Hessian,
                Measured::AlongRay => Quantity::PreviousNormal,
            };
            let (needs, samples): (&[Quantity], Samples) = match layer {
                LayerKind::Beauty | LayerKind::Z | LayerKind::Depth | LayerKind::First | LayerKind::Counts => continue,
                // The rules of halos ask for what it needs.
                LayerKind::Halo(_) => continue,
                LayerKind::Normal | LayerKind::Gradient => (&[Quantity::Gradient], Samples::Visible),
                LayerKind::Curvature => (&[Quantity::Hessian, along_view], Samples::Visible),
                LayerKind::CurvatureAlongView => (&[along_view], Samples::Visible),
                LayerKind::FirstNormal => (&[Quantity::Gradient], Samples::First),
                LayerKind::FirstCurvature => (&[Quantity::Hessian, along_view], Samples::First),
                LayerKind::FirstCurvatureAlongView => (&[along_view], Samples::First),
            };
            needs.iter().for_each(|&quantity| asks.need_at(quantity, samples, &effect, &key));
        }
    },
    idle: |scene, plan, idle| {
        if !plan.has_pass(Pass::Rays) {
            for key in ["picture.samples", "picture.layers"] {
                idle.key(key, "the volume itself is not drawn");
            }
        }
        let halos_in_millimetres = halos_in_effect(scene).any(|(_, halo)| is_in_millimetres(halo));
        if !idle.says("picture.width") && !scene.has_marks() && !halos_in_millimetres {
            idle.key("picture.dpi", "nothing is in mm: size is in pixels");
        }
    },
    knobs: &[(
        "samples",
        Ladder::to_finest(|_, plan, _| if plan.has_pass(Pass::Rays) { &["1", "2", "4"] } else { &[] }),
    )],
    ..Rules::new("picture")
};
