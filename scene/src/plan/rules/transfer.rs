//! Rules of `[transfer]`: needs, keys without effect, knobs.

use super::{Asks, Ladder, Pass, Rules, Settings};
use crate::plan::Plan;
use crate::quantity::Quantity;
use crate::tables::{Axis, Over, Projection, Scene, TransferKind, Transparency, Unit};

use crate::tables::contours::{Measured, measured_curvature};

/// The rules of `[transfer]`.
pub(super) const RULES: Rules = Rules {
    asks: |scene, asks| {
        let Some(transfer) = scene.transfer.as_ref().filter(|_| asks.casts_rays()) else { return };
        asks.need(Quantity::Value, "transfer function", "transfer");
        if transfer.is_automatic() {
            asks.pass(Pass::AutomaticTransfer, "automatic function", "transfer.nodes");
        }
        if transfer.over != Over::Value {
            transfer.over.axes().iter().for_each(|axis| self::axis(axis, scene, transfer.unit, asks));
        }
        if transfer.kind == TransferKind::Style {
            asks.need(Quantity::Gradient, "styles", "transfer.kind");
            if transfer.transparency == Transparency::Illustrative {
                asks.need(Quantity::GradientMagnitudeRange, "illustrative transparency", "transfer.transparency");
            }
        }
    },
    idle: |scene, _, idle| {
        let Some(transfer) = &scene.transfer else { return };
        if transfer.is_automatic() {
            idle.key("transfer.unit", "an automatic function has no nodes to measure");
        } else if !transfer.over.axes().iter().any(|axis| matches!(axis, Axis::Value | Axis::GradientMagnitude)) {
            idle.key("transfer.unit", "it measures values and gradient magnitudes, and the function is over others");
        }
        if transfer.over != Over::Value {
            idle.key("transfer.table", "a function over two quantities is evaluated exactly");
        }
        if transfer.kind == TransferKind::Regular {
            for key in ["transfer.transparency", "transfer.mix", "transfer.sphere_frame"] {
                idle.key(key, "it acts on styles, and the function is regular");
            }
        } else if matches!(scene.camera.projection, Projection::Orthographic { .. }) {
            idle.key("transfer.sphere_frame", "both frames are the same in an orthographic picture");
        }
    },
    knobs: &[("table", Ladder::to_finest(|scene, plan, _| tables(scene, plan)))],
    ..Rules::new("transfer")
};

/// Sizes that graphics hardware has, where the function is over one quantity.
fn tables(scene: &Scene, plan: &Plan) -> Settings {
    match scene.transfer.as_ref().filter(|_| plan.has_pass(Pass::Rays)) {
        Some(transfer) if transfer.over == Over::Value => &["64", "256", "1024", "4096", "exact"],
        _ => &[],
    }
}

/// Asks for what an axis needs of the samples.
fn axis(axis: &Axis, scene: &Scene, unit: Unit, asks: &mut Asks) {
    let key = "transfer.over";
    let effect = format!("function over {}", axis.name());
    if let Some(quantity) = quantity(axis, scene, unit) {
        asks.need(quantity, &effect, key);
    }
    if let Axis::DistanceToLabel(_) = axis {
        asks.pass(Pass::LabelDistances, &effect, key);
    }
}

/// The quantity of samples that an axis measures; none for the value, which every transfer function needs.
pub(super) fn quantity(axis: &Axis, scene: &Scene, unit: Unit) -> Option<Quantity> {
    Some(match axis {
        Axis::Value => return None,
        Axis::GradientMagnitude if unit == Unit::Normalized => Quantity::GradientMagnitudeRange,
        Axis::GradientMagnitude => Quantity::Gradient,
        Axis::Label => Quantity::Label,
        Axis::K1 | Axis::K2 | Axis::Mean | Axis::Gaussian => Quantity::Hessian,
        Axis::AlongView => along_view(scene),
        Axis::Distance(_) => Quantity::Distance,
        Axis::DistanceToLabel(_) => Quantity::LabelDistance,
        Axis::Volume(_) => Quantity::FurtherVolume,
    })
}

/// The quantity that κ_v is made of.
pub(super) fn along_view(scene: &Scene) -> Quantity {
    match measured_curvature(scene) {
        Measured::AlongRay => Quantity::PreviousNormal,
        Measured::Exact => Quantity::Hessian,
    }
}
