//! Rules of `[styles]`: needs, keys without effect, knobs.

use super::Rules;
use super::clip::cap_styles;
use crate::tables::{Node, NodeColor, TransferKind};

/// The rules of `[styles]`.
pub(super) const RULES: Rules = Rules {
    idle: |scene, _, idle| {
        let Some(transfer) = &scene.transfer else { return };
        let on_cap = |style: &str| cap_styles(scene).any(|cap| cap == style);
        if transfer.kind == TransferKind::Regular && cap_styles(scene).next().is_none() {
            idle.key("styles", "a regular function names no style");
        } else if !transfer.is_automatic() {
            let is = |node: &Node, style: &str| matches!(&node.color, NodeColor::Style(s) if s == style);
            let named = |style: &str| on_cap(style) || transfer.all_nodes().any(|node| is(node, style));
            for (name, _) in scene.styles.files.iter().filter(|(name, _)| !named(name)) {
                idle.key(&format!("styles.{}", crate::document::out::key(name)), "no node names it");
            }
        }
    },
    ..Rules::new("styles")
};
