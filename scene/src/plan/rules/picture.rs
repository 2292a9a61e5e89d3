//! Rules of `[picture]`: needs, keys without effect, knobs.

use super::halo::{halos_in_effect, is_in_millimetres};
use super::{Ladder, Pass, Rules, Settings};
use crate::picture::LayerKind;
use crate::plan::{Plan, Samples};
use crate::quantity::Quantity;
use crate::tables::contours::{Measured, measured_curvature};
use crate::tables::{RaysPerPixel, Scene};

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
                // The rules of halos and of objects ask for what they need.
                LayerKind::Halo(_) | LayerKind::Part(_) => continue,
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
    serves: |scene, asks| {
        let has_equal_rays = Pass::OF_EQUAL_RAYS.into_iter().any(|pass| asks.has_pass(pass));
        if asks.casts_rays() && scene.picture.samples == RaysPerPixel::Auto && shows_edges(scene) && !has_equal_rays {
            asks.pass(Pass::Refinement, "antialiasing", "picture.samples");
        }
    },
    idle: |scene, plan, idle| {
        if !plan.has_pass(Pass::Rays) {
            for key in ["picture.samples", "picture.contrast", "picture.layers"] {
                idle.key(key, "the volume itself is not drawn");
            }
        } else if !plan.has_pass(Pass::Refinement) {
            let why = match scene.picture.samples {
                RaysPerPixel::Across(_) => "only samples = \"auto\" looks for edges",
                RaysPerPixel::Auto if plan.has_equal_rays() => {
                    "with halos, style mip-maps or strokes inside the volume every pixel has 2×2 rays"
                }
                RaysPerPixel::Auto => "no layer is a mean over the rays of a pixel",
            };
            idle.key("picture.contrast", why);
        }
        let halos_in_millimetres = halos_in_effect(scene).any(|(_, halo)| is_in_millimetres(halo));
        if !idle.says("picture.width") && !scene.draws_on_page() && !halos_in_millimetres {
            idle.key("picture.dpi", "nothing is in mm: size is in pixels");
        }
    },
    knobs: &[
        ("samples", Ladder::to_finest(|_, plan, _| samples(plan))),
        ("contrast", Ladder::to_finest(|_, plan, _| if plan.has_pass(Pass::Refinement) { CONTRASTS } else { &[] })),
    ],
    ..Rules::new("picture")
};

/// Settings of `contrast`.
const CONTRASTS: Settings = &["0.25", "0.125", "0.0625", "0.03125", "0"];

/// Settings of `samples`.
fn samples(plan: &Plan) -> Settings {
    match plan.has_pass(Pass::Rays) {
        false => &[],
        // "auto" is 2 there.
        true if plan.has_equal_rays() => &["1", "2", "3", "4"],
        true => &["1", "2", "auto", "3", "4"],
    }
}

/// Whether some layer shows further rays at edges.
fn shows_edges(scene: &Scene) -> bool {
    let layers = &scene.picture.layers;
    layers.is_empty() || layers.iter().any(|layer| *layer == LayerKind::Beauty || layer.is_mean())
}
