//! Rules of `[picture]`: needs, keys without effect, knobs.

use super::{Ladder, Pass, Rules};
use crate::picture::LayerKind;
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
            let (needs, first_only): (&[Quantity], bool) = match layer {
                LayerKind::Beauty
                | LayerKind::Z
                | LayerKind::Depth
                | LayerKind::First
                | LayerKind::Counts
                | LayerKind::Halo(_) => continue,
                LayerKind::Normal | LayerKind::Gradient => (&[Quantity::Gradient], false),
                LayerKind::Curvature => (&[Quantity::Hessian, along_view], false),
                LayerKind::CurvatureAlongView => (&[along_view], false),
                LayerKind::FirstNormal => (&[Quantity::Gradient], true),
                LayerKind::FirstCurvature => (&[Quantity::Hessian, along_view], true),
                LayerKind::FirstCurvatureAlongView => (&[along_view], true),
            };
            needs.iter().for_each(|&quantity| asks.need_where(quantity, first_only, &effect, &key));
        }
    },
    idle: |scene, plan, idle| {
        if !plan.has_pass(Pass::Rays) {
            for key in ["picture.samples", "picture.layers"] {
                idle.key(key, "the volume itself is not drawn");
            }
        }
        if !idle.says("picture.width") && !scene.has_marks() {
            idle.key("picture.dpi", "nothing is in mm: size is in pixels");
        }
    },
    knobs: &[(
        "samples",
        Ladder::to_finest(|_, plan, _| if plan.has_pass(Pass::Rays) { &["1", "2", "4"] } else { &[] }),
    )],
    ..Rules::new("picture")
};
