//! Rules of `[[halo]]`: needs, keys without effect, knobs.

use super::transfer::{along_view, quantity};
use super::{Asks, Idle, Ladder, Pass, Rules, Settings};
use crate::picture::LayerKind;
use crate::plan::{Plan, Samples};
use crate::quantity::Quantity;
use crate::tables::{Halo, HaloKind, HaloSource, Length, Over, Scene, SeedBy};

/// The rules of `[[halo]]`.
pub(super) const RULES: Rules = Rules {
    items: Some(|scene| scene.halos.len()),
    asks: |scene, asks| {
        let item = asks.at.item.filter(|_| asks.casts_rays());
        let Some((_, halo)) = item.and_then(|item| halos_in_effect(scene).find(|(i, _)| *i == item)) else { return };
        let effect = format!("halo {}", item.unwrap_or_default());
        needs(halo, scene, &effect, asks);
        asks.pass(Pass::HaloSeeds, &effect, &asks.at.inner("seed"));
        if halo.spread.passes > 0 || halo.spread.from == HaloSource::Gradient || halo.spread.median {
            asks.pass(Pass::HaloSpreading, &effect, &asks.at.inner("spread"));
        }
    },
    idle: |scene, plan, idle| {
        let Some((item, halo)) = idle.at.item.and_then(|i| Some((i, scene.halos.get(i)?))) else { return };
        if !plan.has_pass(Pass::Rays) {
            let key = idle.at.key.clone();
            idle.key(&key, "the volume itself is not drawn");
        } else if halos_in_effect(scene).all(|(i, _)| i != item) {
            let key = if halo.opacity == 0.0 { idle.at.inner("opacity") } else { idle.at.inner("profile") };
            let why = "nothing of the halo is seen at this opacity";
            if idle.says(&key) {
                idle.key(&key, why);
            } else {
                let key = idle.at.key.clone();
                idle.key(&key, why);
            }
        } else {
            idle_keys(halo, idle);
        }
    },
    knobs: &[
        ("every", Ladder::to_finest(|scene, plan, item| used(scene, plan, item, |_| &["8", "4", "2", "1"]))),
        ("accumulate", Ladder::to_finest(|scene, plan, item| used(scene, plan, item, accumulations))),
        ("spread.passes", Ladder::to_finest(|scene, plan, item| used(scene, plan, item, passes))),
    ],
    ..Rules::new("halo")
};

/// The halos that change the picture or are shown by a layer, with their places in the list.
pub fn halos_in_effect(scene: &Scene) -> impl Iterator<Item = (usize, &Halo)> {
    let is_seen = |halo: &Halo| halo.opacity > 0.0 && halo.profile.iter().any(|node| node.opacity > 0.0);
    let layers = &scene.picture.layers;
    scene.halos.iter().enumerate().filter(move |(i, halo)| is_seen(halo) || layers.contains(&LayerKind::Halo(*i)))
}

/// Asks for what seeds are made of. A sample without a normal is no seed, whatever the exponents ([PREC-3]).
fn needs(halo: &Halo, scene: &Scene, effect: &str, asks: &mut Asks) {
    let table = asks.at.key.clone();
    let at = asks.at.clone();
    let mut need = |quantity, key: &str| asks.need_at(quantity, Samples::Seeds, effect, key);
    need(Quantity::Gradient, &table);
    if halo.exponents.numbers()[0] > 0.0 {
        need(Quantity::GradientMagnitudeRange, &at.inner("exponents"));
    }
    if halo.seed.by == SeedBy::Curvature {
        need(along_view(scene), &at.inner("seed.by"));
    }
    if halo.seed.labels.is_some() {
        need(Quantity::Label, &at.inner("seed.labels"));
    }
    // The opacity of a function over two quantities.
    let transfer = scene.transfer.as_ref().filter(|transfer| transfer.over != Over::Value);
    if let Some(transfer) = transfer.filter(|_| halo.seed.is_by_opacity()) {
        for quantity in transfer.over.axes().iter().filter_map(|axis| quantity(axis, scene, transfer.unit)) {
            need(quantity, &at.inner("seed.value"));
        }
    }
}

/// Lists the keys of a halo that say nothing beside its others.
fn idle_keys(halo: &Halo, idle: &mut Idle) {
    let at = idle.at.clone();
    let mut key = |key: &str, why: &str| idle.key(&at.inner(key), why);
    match halo.seed.by {
        SeedBy::Power => key("seed.thickness", "seed.by is \"power\": exponents count"),
        SeedBy::Curvature => key("exponents", "seed.by is \"curvature\": of the two exponents only a counts"),
    }
    if halo.seed.direction.is_some_and(|direction| direction.width >= 360.0) {
        key("seed.direction.toward", "seed.direction.width has every direction");
        key("seed.direction.softness", "seed.direction.width has every direction");
    }
    if halo.spread.passes == 0 {
        key("spread.delta", "spread.passes is 0");
        key("spread.reach", "spread.passes is 0");
    }
    if halo.kind == HaloKind::Emissive {
        key("tints", "only an occlusive halo tints another");
    }
    if halo.every == 1 {
        key("accumulate", "every is 1: a group has one plane");
    }
}

/// Settings of a halo in effect.
fn used(scene: &Scene, plan: &Plan, item: Option<usize>, settings: fn(&Halo) -> Settings) -> Settings {
    let halo = halos_in_effect(scene).find(|(i, _)| Some(*i) == item && plan.has_pass(Pass::Rays));
    halo.map_or(&[], |(_, halo)| settings(halo))
}

/// Settings of `accumulate`, where a group has several planes.
fn accumulations(halo: &Halo) -> Settings {
    if halo.every > 1 { &["max", "mean"] } else { &[] }
}

/// Settings of `passes`, where the halo's reach does not depend on them.
fn passes(halo: &Halo) -> Settings {
    if halo.spread.reach.is_some() { &["1", "2", "3", "4", "5", "6"] } else { &[] }
}

/// Whether a length of a halo is in millimetres on the page.
pub(super) fn is_in_millimetres(halo: &Halo) -> bool {
    matches!(halo.spread.reach, Some(Length::Millimetres(_)))
}
