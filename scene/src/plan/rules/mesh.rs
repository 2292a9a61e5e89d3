//! Rules of `[[mesh]]`: needs, keys without effect, knobs.

use super::Rules;
use crate::quantity::Quantity;

/// The rules of `[[mesh]]`.
pub(super) const RULES: Rules = Rules {
    items: Some(|scene| scene.meshes.len()),
    asks: |_, asks| {
        if asks.casts_rays() {
            let effect = format!("mesh {}", asks.at.item.unwrap_or_default());
            let key = asks.at.key.clone();
            asks.need(Quantity::Mesh, &effect, &key);
        }
    },
    ..Rules::new("mesh")
};
