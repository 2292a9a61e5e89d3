//! Rules of `[[object]]`, `[combine]` and `[[intersection]]`: needs and keys without effect.

use super::{Asks, Idle, Pass, Rules, halos_in_effect};
use crate::plan::{Need, Plan, Samples};
use crate::quantity::Quantity;
use crate::tables::{IntersectionTable, ObjectTable, Opposite, PartName, Role, Scene, TransferKind};

/// The rules of `[[object]]`.
pub(super) const RULES: Rules = Rules {
    items: Some(|scene| scene.objects.len()),
    asks: |scene, asks| {
        let item = asks.at.item.filter(|_| asks.casts_rays());
        let Some((item, object)) = item.and_then(|item| Some((item, scene.objects.get(item)?))) else { return };
        asks_of(scene, item, object, asks);
    },
    idle: |scene, plan, idle| {
        let Some(object) = idle.at.item.and_then(|item| scene.objects.get(item)) else { return };
        if !plan.has_pass(Pass::Rays) {
            let key = idle.at.key.clone();
            return idle.key(&key, "the volume itself is not drawn");
        }
        let own = PartName::Selection(object.name.clone());
        let ghost = PartName::Ghost(object.name.clone());
        let mut seeds = halos_in_effect(scene).filter(|(_, halo)| halo.takes(&own) || halo.takes(&ghost));
        idle_keys(scene, object, seeds.any(|(_, halo)| halo.seed.labels.is_some()), idle);
    },
    ..Rules::new("object")
};

/// The rules of `[combine]`.
pub(super) const COMBINE: Rules = Rules {
    idle: |scene, _, idle| {
        if scene.objects.is_empty() {
            idle.key("combine", "there are no objects to combine");
        }
    },
    ..Rules::new("combine")
};

/// The rules of `[[intersection]]`.
pub(super) const INTERSECTION: Rules = Rules {
    items: Some(|scene| scene.intersections.len()),
    asks: |scene, asks| {
        let item = asks.at.item.filter(|_| asks.casts_rays());
        let Some(item) = item.filter(|&item| why_idle(scene, item).is_none()) else { return };
        let (effect, key) = (format!("intersection {item}"), asks.at.key.clone());
        asks.pass(Pass::Intersections, &effect, &key);
        for (shades, need) in meeting(scene, item) {
            let samples = if shades.is_none() { Samples::Meetings } else { Samples::Part };
            asks.need_at(need.quantity, samples, &effect, &key);
        }
    },
    idle: |scene, _, idle| {
        if let Some(why) = idle.at.item.and_then(|item| why_idle(scene, item)) {
            let key = idle.at.key.clone();
            idle.key(&key, why);
        }
    },
    ..Rules::new("intersection")
};

/// A selection or a ghost, by the place of its object; none: the background.
type Side = Option<(usize, Role)>;

/// The needs of the materials of an intersection's sets, each with the set at whose samples the need arises. A style is
/// drawn by the normal, κ and |g| of the set with the larger μ ([VS-4]).
fn meeting(scene: &Scene, item: usize) -> Vec<(Side, Need)> {
    let table = &scene.intersections[item];
    let Some(object) = scene.objects.iter().position(|object| object.name == table.object) else { return Vec::new() };
    let selection = Some((object, Role::Selection));
    let other = match table.with {
        Opposite::Ghost => Some((object, Role::Ghost)),
        Opposite::Background => None,
    };
    let needs = |of: Side| {
        let scene = of.map_or_else(|| scene.of_background(), |(object, role)| scene.of_part(object, role));
        let is_style = scene.transfer.as_ref().is_some_and(|transfer| transfer.kind == TransferKind::Style);
        let needs = if is_style { Plan::new(&scene).needs } else { Vec::new() };
        needs.into_iter().filter(|need| need.samples == Samples::Visible && need.quantity != Quantity::Value)
    };
    let of = |look: Side, shades: Side| needs(look).map(move |need| (shades, need));
    of(selection, other).chain(of(other, selection)).collect()
}

impl Plan {
    /// Adds the needs of the materials that a part meets, at samples where the part shades them.
    pub fn add_meetings(&mut self, scene: &Scene, object: usize, role: Role) {
        let of_object = |table: &IntersectionTable| table.object == scene.objects[object].name;
        let items = (0..scene.intersections.len()).filter(|&item| of_object(&scene.intersections[item]));
        for item in items.filter(|&item| why_idle(scene, item).is_none()) {
            let of_part = meeting(scene, item).into_iter().filter(|(shades, _)| *shades == Some((object, role)));
            self.needs.extend(of_part.map(|(_, need)| Need { samples: Samples::Meetings, ..need }));
        }
    }
}

/// Asks for what an object and its parts are made of.
fn asks_of(scene: &Scene, item: usize, object: &ObjectTable, asks: &mut Asks) {
    let at = asks.at.clone();
    let leaves_ghost = scene.leaves_ghost(item);
    let roles = [Some(Role::Selection), leaves_ghost.then_some(Role::Ghost)];
    for role in roles.into_iter().flatten() {
        let part = match role {
            Role::Selection => PartName::Selection(object.name.clone()),
            Role::Ghost => PartName::Ghost(object.name.clone()),
        };
        // Its look may need other quantities than the picture's, at its own samples.
        for need in Plan::new(&scene.of_part(item, role)).needs {
            let effect = format!("{part}: {}", need.effect);
            let samples = if need.samples == Samples::Seeds { Samples::PartSeeds } else { Samples::Part };
            asks.need_at(need.quantity, samples, &effect, &scene.key_of_part(item, role, &need.key));
        }
    }
    let effect = format!("object {}", object.name);
    asks.pass(Pass::Selections, &effect, &at.key);
    if leaves_ghost {
        let key = if object.motion.is_moved() { "move" } else { "interaction" };
        asks.pass(Pass::MovedSelections, &effect, &at.inner(key));
    }
    let cuts = [(object.ghosting, "ghosting"), (object.ghosting_of_ghost, "ghosting_of_ghost")];
    for (_, key) in cuts.into_iter().filter(|(ghosting, key)| *ghosting > 0.0 && acts(leaves_ghost, key)) {
        asks.pass(Pass::Cutaways, &effect, &at.inner(key));
        if object.funnel.is_some() {
            asks.pass(Pass::Funnels, &effect, &at.inner("funnel"));
        }
    }
}

/// Whether a ghosting factor acts: that of the ghost needs one.
fn acts(leaves_ghost: bool, key: &str) -> bool {
    key == "ghosting" || leaves_ghost
}

/// Lists the keys of an object that its other keys make idle. `seeds_labels`: whether a halo reads the object's labels.
fn idle_keys(scene: &Scene, object: &ObjectTable, seeds_labels: bool, idle: &mut Idle) {
    let at = idle.at.clone();
    let leaves_ghost = at.item.is_some_and(|item| scene.leaves_ghost(item));
    let mut key = |key: &str, why: &str| idle.key(&at.inner(key), why);
    if scene.orbit.is_none() {
        key("interaction", "the camera does not turn: there is no [orbit]");
    }
    if !leaves_ghost {
        key("ghosting_of_ghost", "the object is not moved: it has no ghost");
        key("ghost", "the object is not moved: it has no ghost");
    }
    if object.motion.scale == glam::DVec3::ONE && object.motion.rotation.is_none() {
        key("center", "nothing is scaled or rotated");
    }
    if object.ghosting == 0.0 && (object.ghosting_of_ghost == 0.0 || !leaves_ghost) {
        key("cut", "nothing is cut away: ghosting is 0");
        key("funnel", "nothing is cut away: ghosting is 0");
    }
    if object.label.is_none() && !seeds_labels {
        key("labels", "no label is selected, and the function may read none");
    }
}

/// The reason why an intersection has no effect; none if it has one.
fn why_idle(scene: &Scene, item: usize) -> Option<&'static str> {
    let table = scene.intersections.get(item)?;
    let item = scene.objects.iter().position(|object| object.name == table.object)?;
    let (object, is_moved) = (&scene.objects[item], scene.leaves_ghost(item));
    match table.with {
        Opposite::Ghost if !is_moved => Some("the object is not moved: it has no ghost"),
        Opposite::Background if !is_moved && object.volume.is_none() => {
            Some("the object is not moved: its selection is a piece of the background")
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::file::{Overrides, parse};
    use crate::plan::{Pass, Plan};
    use crate::quantity::Quantity;
    use std::path::Path;

    fn plan(rest: &str) -> Plan {
        let text = format!(
            "drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n[transfer]\nkind = \"regular\"\n\
             nodes = [{{ at = 1, color = \"red\" }}]\n{rest}"
        );
        let scene = parse(&text, Path::new("scene.toml"), &Overrides::default());
        Plan::new(&scene.unwrap_or_else(|faults| panic!("{faults}")))
    }

    /// The needs of an object's look are its own: the background of an unshaded picture stays unshaded.
    #[test]
    fn an_object_needs_what_its_own_look_is_made_of() {
        let plan = plan("[[object]]\nname = \"knee\"\n[object.shading]\n");
        assert!(!plan.needs_anywhere(Quantity::Gradient));
        let text = plan.to_string();
        assert!(text.contains("knee: shading") && text.contains("object[0].shading (line 9)"), "{text}");
        assert!(
            text.contains("selections") && !text.contains("moved selections") && !text.contains("cut depths"),
            "{text}"
        );
    }

    /// Seeds of a selection need their quantities there; of data of its own the background needs nothing.
    #[test]
    fn halos_need_quantities_of_the_parts_that_seed() {
        let knee = |own: &str, halo: &str| plan(&format!("[[object]]\nname = \"knee\"\n{own}[[halo]]\n{halo}"));
        let all = knee("volume = \"b.nrrd\"\n", "");
        assert!(all.needs_at_seeds(Quantity::GradientMagnitudeRange));
        assert!(all.to_string().contains("knee: halo 0") && all.has_pass(Pass::HaloSeeds));
        let own = knee("volume = \"b.nrrd\"\nlabels = \"l.nrrd\"\n", "object = \"knee\"\nseed.labels = [1]\n");
        assert!(!own.needs_anywhere(Quantity::Gradient) && !own.reads_labels() && own.has_pass(Pass::HaloSeeds));
        let text = own.to_string();
        assert!(text.contains("knee: halo 0") && text.contains("halo[0].seed.labels"), "{text}");
        assert!(own.idle_keys.is_empty(), "{text}");
        // The background's halo asks nothing of the knee.
        assert!(!knee("", "object = \"background\"\n").to_string().contains("knee: halo"));
        let alone = plan("[[halo]]\nobject = \"background\"\n");
        assert_eq!(alone.idle_keys.iter().map(|idle| idle.key.as_str()).collect::<Vec<_>>(), ["halo[0].object"]);
    }

    #[test]
    fn only_what_acts_is_asked_for() {
        let moved = plan(
            "[[object]]\nmove = [1, 0, 0]\nghosting = 0.5\nfunnel = \"3 px\"\n[[intersection]]\nobject = \"object 0\"\n",
        );
        let text = moved.to_string();
        for pass in ["moved selections", "cut depths", "funnels", "intersections"] {
            assert!(text.contains(pass), "{pass}\n{text}");
        }
        assert!(moved.idle_keys.is_empty(), "{text}");
        // A selection that keeps its place before the eye leaves its ghost when the camera turns.
        let pinned = "[[object]]\ninteraction = \"pinned\"\nghosting_of_ghost = 1\n[object.ghost]\n\
                      [[intersection]]\nobject = \"object 0\"\n";
        let turning = plan(&format!("{pinned}[orbit]\n"));
        assert!(turning.idle_keys.is_empty() && turning.to_string().contains("moved selections"), "{turning}");
        let keys: Vec<String> = plan(pinned).idle_keys.into_iter().map(|idle| idle.key).collect();
        let ghost = ["ghosting_of_ghost", "ghost"].map(|key| format!("object[0].{key}"));
        assert_eq!(keys, ["object[0].interaction", &ghost[0], &ghost[1], "intersection[0]"]);
        let still = plan(
            "[combine]\n[[object]]\ncenter = [0, 0, 0]\nghosting_of_ghost = 1\ncut = \"object\"\n[object.ghost]\n\
             [[intersection]]\nobject = \"object 0\"\nwith = \"background\"\n",
        );
        let idle: Vec<&str> = still.idle_keys.iter().map(|idle| idle.key.as_str()).collect();
        assert_eq!(
            idle,
            ["object[0].center", "object[0].ghosting_of_ghost", "object[0].cut", "object[0].ghost", "intersection[0]"]
        );
        assert!(plan("[combine]\n").idle_keys.iter().any(|idle| idle.key == "combine"));
    }
}
