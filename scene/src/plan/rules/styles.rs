//! Rules of `[styles]`: needs, keys without effect, knobs.

use super::Rules;
use super::clip::cap_styles;
use crate::tables::{Node, TransferKind};
use std::collections::BTreeSet;

/// The rules of `[styles]`.
pub(super) const RULES: Rules = Rules {
    idle: |scene, _, idle| {
        let Some(transfer) = &scene.transfer else { return };
        if transfer.kind == TransferKind::Regular && cap_styles(scene).next().is_none() {
            idle.key("styles", "a regular function names no style");
        } else if !transfer.is_automatic() {
            let named: BTreeSet<&str> = if scene.styles.files.is_empty() {
                BTreeSet::new()
            } else {
                transfer.all_nodes().filter_map(Node::style).chain(cap_styles(scene)).collect()
            };
            for (name, _) in scene.styles.files.iter().filter(|(name, _)| !named.contains(name.as_str())) {
                idle.key(&format!("styles.{}", crate::document::out::key(name)), "no node names it");
            }
        }
    },
    ..Rules::new("styles")
};
