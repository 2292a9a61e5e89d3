//! Rules of `[[clip]]`: needs, keys without effect, knobs.

use super::{Pass, Rules};
use crate::tables::Scene;

/// The rules of `[[clip]]`.
pub(super) const RULES: Rules = Rules {
    items: Some(|scene| scene.clips.len()),
    serves: |scene, asks| {
        let points = asks.draws_points() && scene.stipples.is_some();
        let strokes = asks.draws_strokes() && scene.has_strokes();
        if asks.casts_rays() || points || strokes {
            let effect = format!("clip {}", asks.at.item.unwrap_or_default());
            let key = asks.at.key.clone();
            asks.pass(Pass::Clip, &effect, &key);
        }
    },
    idle: |_, plan, idle| {
        if plan.has_pass(Pass::Clip) && !plan.has_pass(Pass::Rays) {
            for key in ["cap", "style"] {
                let key = idle.at.inner(key);
                idle.key(&key, "the volume itself is not drawn: points and lines have no cuts");
            }
        }
    },
    ..Rules::new("clip")
};

/// The styles that the caps of a scene name.
pub(super) fn cap_styles(scene: &Scene) -> impl Iterator<Item = &str> {
    scene.clips.iter().filter_map(|clip| clip.style.as_deref())
}
