//! Rules of `[[pen]]`: needs, keys without effect, knobs.

use super::Rules;

/// The rules of `[[pen]]`.
pub(super) const RULES: Rules = Rules {
    items: Some(|scene| scene.pens.len()),
    idle: |scene, _, idle| {
        let Some(pen) = idle.at.item.and_then(|i| scene.pens.get(i)) else { return };
        if scene.stipples.as_ref().is_none_or(|stipples| stipples.pen.as_ref() != Some(&pen.name)) {
            idle.key(&idle.at.inner("tone"), "only the pen that stipples.pen names prints by its table");
        }
    },
    ..Rules::new("pen")
};
