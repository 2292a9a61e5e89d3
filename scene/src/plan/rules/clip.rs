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
                idle.key(&key, "the volume itself is not drawn");
            }
        }
    },
    ..Rules::new("clip")
};

/// The styles that the caps of a scene name.
pub(super) fn cap_styles(scene: &Scene) -> impl Iterator<Item = &str> {
    scene.clips.iter().filter_map(|clip| clip.style.as_deref())
}

#[cfg(test)]
mod tests {
    use crate::file::{Overrides, parse};
    use crate::plan::Plan;
    use std::path::Path;

    const CLIP: &str = "[[clip]]\npoint = [1, 2, 3]\nnormal = [0, 0, 1]\ncap = \"red\"\n";

    fn plan(rest: &str, of: fn(&crate::tables::Scene) -> Plan) -> String {
        let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n{rest}{CLIP}");
        let scene = parse(&text, Path::new("scene.toml"), &Overrides::default());
        of(&scene.unwrap_or_else(|faults| panic!("{faults}"))).to_string()
    }

    fn line(plan: &str, of: &str) -> String {
        let line = plan.lines().find(|line| line.trim_start().starts_with(of)).unwrap_or_default();
        line.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn a_person_reads_what_is_cut_and_where_caps_are_not_seen() {
        let rays = plan("[transfer]\nkind = \"regular\"\nnodes = [{ at = 1, color = \"red\" }]\n", Plan::new);
        assert_eq!(
            line(&rays, "clip 0"),
            "clip 0 clip planes one look at the planes a ray, a point and a vertex of a line clip[0] (line 7)"
        );
        assert_eq!(line(&rays, "clip[0].cap"), "");
        let strokes = plan("[outlines]\n", Plan::new);
        assert!(line(&strokes, "clip 0").ends_with("clip[0] (line 5)"), "{strokes}");
        assert_eq!(line(&strokes, "clip[0].cap"), "clip[0].cap (line 8): the volume itself is not drawn");
        // Of points alone nothing is drawn here, so nothing is cut.
        assert_eq!(line(&plan("[outlines]\n", Plan::of_points), "clip"), "");
    }

    /// A style of a cap is used, whatever the function is.
    #[test]
    fn styles_of_caps_are_used() {
        let regular =
            "[transfer]\nkind = \"regular\"\nnodes = [{ at = 1, color = \"red\" }]\n[styles]\nbone = \"bone.png\"\n";
        assert!(!line(&plan(regular, Plan::new), "styles").is_empty());
        let text = format!(
            "drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n{regular}{}",
            CLIP.replace("cap = \"red\"", "style = \"bone\"")
        );
        let scene = parse(&text, Path::new("scene.toml"), &Overrides::default()).unwrap_or_else(|f| panic!("{f}"));
        assert_eq!(line(&Plan::new(&scene).to_string(), "styles"), "");
    }
}
