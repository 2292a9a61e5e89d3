//! Rules of `[styles]`: needs, keys without effect, knobs.

use super::Rules;
use crate::tables::{Node, NodeColor, TransferKind};

/// The rules of `[styles]`.
pub(super) const RULES: Rules = Rules {
    idle: |scene, _, idle| {
        let Some(transfer) = &scene.transfer else { return };
        if transfer.kind == TransferKind::Regular {
            idle.key("styles", "a regular function names no style");
        } else if !transfer.is_automatic() {
            let is = |node: &Node, style: &str| matches!(&node.color, NodeColor::Style(s) if s == style);
            let named = |style: &str| transfer.all_nodes().any(|node| is(node, style));
            for (name, _) in scene.styles.files.iter().filter(|(name, _)| !named(name)) {
                idle.key(&format!("styles.{}", crate::document::out::key(name)), "no node names it");
            }
        }
    },
    ..Rules::new("styles")
};
