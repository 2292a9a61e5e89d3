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
        let Some(halo) = item.and_then(|item| halo_in_effect(scene, item)) else { return };
        let effect = format!("halo {}", item.unwrap_or_default());
        // The needs of data of an object's own are its parts'.
        if halo.object.as_ref().is_none_or(|part| scene.own_data_of(part).is_none()) {
            needs(halo, scene, &effect, asks);
        }
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
        } else if halo_in_effect(scene, item).is_none() {
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
            if scene.objects.is_empty() {
                let key = idle.at.inner("object");
                idle.key(&key, "there are no objects: the background is all of the picture");
            }
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
    (0..scene.halos.len()).filter_map(|i| Some((i, halo_in_effect(scene, i)?)))
}

/// The halo at a place in the list, if it changes the picture or is shown by a layer.
fn halo_in_effect(scene: &Scene, item: usize) -> Option<&Halo> {
    let halo = scene.halos.get(item)?;
    let is_seen = halo.opacity > 0.0 && halo.profile.iter().any(|node| node.opacity > 0.0);
    (is_seen || scene.picture.layers.contains(&LayerKind::Halo(item))).then_some(halo)
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

/// Lists the keys of a halo that other keys of the halo make idle.
fn idle_keys(halo: &Halo, idle: &mut Idle) {
    let at = idle.at.clone();
    let mut key = |key: &str, why: &str| idle.key(&at.inner(key), why);
    if halo.seed.by == SeedBy::Power {
        key("seed.thickness", "seed.by is \"power\": exponents count");
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
    let halo = item.filter(|_| plan.has_pass(Pass::Rays)).and_then(|item| halo_in_effect(scene, item));
    halo.map_or(&[], settings)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::{Overrides, parse};
    use crate::knobs::knobs;
    use crate::quantity::Quantity::{
        Distance, FurtherVolume, Gradient, GradientMagnitudeRange, Hessian, Label, PreviousNormal, Value,
    };
    use std::path::Path;

    const REGULAR: &str = "[transfer]\nkind = \"regular\"\nnodes = [{ at = 1, color = \"red\" }]\n";

    /// The plan of an unshaded scene with these lines in its `[[halo]]`.
    fn plan(halo: &str) -> Plan {
        Plan::new(&scene(&format!("{REGULAR}[[halo]]\n{halo}")))
    }

    fn scene(rest: &str) -> Scene {
        let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\nlabels = \"l.nrrd\"\n{rest}");
        parse(&text, Path::new("scene.toml"), &Overrides::default()).unwrap_or_else(|faults| panic!("{faults}"))
    }

    fn at_seeds(plan: &Plan) -> Vec<Quantity> {
        let at_seeds = plan.needs.iter().filter(|need| need.samples == Samples::Seeds);
        at_seeds.map(|need| need.quantity).collect()
    }

    #[test]
    fn seeds_need_what_they_are_made_of_and_visible_samples_nothing() {
        let exact = "[contours]\nkappa = \"exact\"\n";
        for (halo, expected) in [
            ("", &[Gradient, GradientMagnitudeRange][..]),
            ("exponents = [0, 4]\n", &[Gradient]),
            ("exponents = [0, 4]\nseed.labels = [1]\n", &[Gradient, Label]),
            ("exponents = [0, 4]\nseed.direction = {}\n", &[Gradient]),
            ("seed.by = \"curvature\"\n", &[Gradient, PreviousNormal, GradientMagnitudeRange]),
            (&format!("seed.by = \"curvature\"\n{exact}"), &[Gradient, Hessian, GradientMagnitudeRange]),
            (
                "seed.by = \"curvature\"\n[contours]\nkappa = \"none\"\n",
                &[Gradient, PreviousNormal, GradientMagnitudeRange],
            ),
            (exact, &[Gradient, GradientMagnitudeRange]),
            ("opacity = 0\n", &[]),
            ("opacity = 0\n[picture]\nlayers = [\"halo0\"]\n", &[Gradient, GradientMagnitudeRange]),
        ] {
            let plan = plan(halo);
            assert_eq!(at_seeds(&plan), expected, "{halo}");
            let visible = plan.needs.iter().filter(|need| need.samples != Samples::Seeds);
            assert_eq!(visible.map(|need| need.quantity).collect::<Vec<_>>(), [Value], "{halo}");
            let has = [Pass::HaloSeeds, Pass::HaloSpreading].map(|pass| plan.has_pass(pass));
            assert_eq!(has, [!expected.is_empty(); 2], "{halo}");
            // What only halos read is measured too.
            let reads = [plan.has_pass(Pass::GradientRange), plan.reads_gradients(), plan.reads_labels()];
            let expects = [GradientMagnitudeRange, Gradient, Label].map(|quantity| expected.contains(&quantity));
            assert_eq!(reads, expects, "{halo}");
            assert_eq!(plan.has_pass(Pass::SmoothedCoefficients), expected.contains(&Hessian), "{halo}");
        }
    }

    /// The opacity of a function over two quantities needs them at seeds too.
    #[test]
    fn seeds_by_opacity_need_the_quantities_of_the_function() {
        let over = |axis: &str, seed: &str| {
            let rows = "rows = [{ at = 1, nodes = [{ at = 1, color = \"red\" }] }]\n";
            let transfer = format!("[transfer]\nkind = \"regular\"\nover = [\"value\", {axis}]\n{rows}");
            at_seeds(&Plan::new(&scene(&format!("{transfer}[[halo]]\nexponents = [0, 1]\n{seed}"))))
        };
        assert_eq!(over("\"label\"", ""), [Gradient, Label]);
        assert_eq!(over("\"label\"", "seed.value = [[1, 1]]\n"), [Gradient]);
        assert_eq!(over("\"k1\"", ""), [Gradient, Hessian]);
        assert_eq!(over("\"kv\"", ""), [Gradient, PreviousNormal]);
        assert_eq!(over("{ distance = [1, 2, 3] }", ""), [Gradient, Distance]);
        assert_eq!(over("{ volume = \"b.nrrd\" }", ""), [Gradient, FurtherVolume]);
    }

    #[test]
    fn a_person_reads_what_a_halo_costs_and_which_line_asked() {
        let told: Vec<String> = plan("seed.labels = [1]\n[[halo]]\nopacity = 0\n")
            .to_string()
            .lines()
            .filter(|line| line.starts_with("halo"))
            .map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "))
            .collect();
        assert_eq!(
            told,
            [
                "halo 0 gradient one gradient a seed sample halo[0] (line 8)",
                "halo 0 |g| a norm and a division a seed sample halo[0].exponents (line 8)",
                "halo 0 label one look at the labels a seed sample halo[0].seed.labels (line 9)",
                "halo 0 range of |g| one gradient a voxel volume.gradient_range (line 2)",
                "halo 0 halo seeds one look at each sample whose value may seed, seen or not; a number a ray halo[0].seed \
                 (line 9)",
                "halo 0 halo spreading a filter of all rays a pass, once a group of planes; two numbers a ray \
                 halo[0].spread (line 8)",
            ]
        );
    }

    #[test]
    fn keys_without_effect_are_told() {
        let others = |plan: Plan| plan.idle_keys.into_iter().filter(|idle| idle.key != "volume.labels");
        let idle = |halo: &str| others(plan(halo)).map(|idle| idle.key).collect::<Vec<_>>().join(" ");
        assert_eq!(idle("seed.thickness = 1\n"), "halo[0].seed.thickness");
        // Of the exponents a counts.
        assert_eq!(idle("seed.by = \"curvature\"\nseed.thickness = 1\nexponents = [1, 2]\n"), "");
        assert_eq!(idle("seed.direction = { width = 360, softness = 3 }\n"), "halo[0].seed.direction.softness");
        assert_eq!(
            idle("spread = { passes = 0, delta = 1, reach = \"9 px\" }\n"),
            "halo[0].spread.delta halo[0].spread.reach"
        );
        assert_eq!(idle("spread = { passes = 0, median = true }\n"), "");
        assert_eq!(idle("accumulate = \"mean\"\n"), "halo[0].accumulate");
        assert_eq!(idle("accumulate = \"mean\"\nevery = 2\n"), "");
        assert_eq!(idle("opacity = 0\n"), "halo[0].opacity");
        assert_eq!(idle("profile = [{ at = 0, color = \"red\", opacity = 0 }]\n"), "halo[0].profile");
        let glow = "[[halo]]\nname = \"glow\"\nkind = \"emissive\"\n";
        assert_eq!(idle(&format!("kind = \"emissive\"\ntints = [\"glow\"]\n{glow}")), "halo[0].tints");
        assert_eq!(idle(&format!("tints = [\"glow\"]\n{glow}")), "");
        // What other tables say for halos.
        assert_eq!(idle("[picture]\ndpi = 72\n"), "picture.dpi");
        assert_eq!(idle("spread.reach = \"3 mm\"\n[picture]\ndpi = 72\n"), "");
        assert_eq!(idle("[sampling]\ngradient = \"sobel\"\nnormal = \"facing\"\n"), "sampling.normal");
        assert_eq!(idle("seed.by = \"curvature\"\n[sampling]\nnormal = \"facing\"\n"), "");
        let contours = others(plan("seed.by = \"curvature\"\n[contours]\nkappa = \"exact\"\n"));
        let why = "contours act on styles, and the function is regular; only halos read its kappa";
        assert_eq!(contours.map(|idle| idle.why).collect::<Vec<_>>(), [why]);
        let no_rays = others(Plan::new(&scene("[stipples]\n[[halo]]\n")));
        assert_eq!(no_rays.map(|idle| idle.key).collect::<Vec<_>>(), ["halo[0]"]);
    }

    /// The outward side of normals matters to a direction, to the inside of a surface, and to a signed curvature.
    #[test]
    fn the_outside_is_read_where_it_matters() {
        let is_idle = |rest: &str| {
            let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\noutside = \"high\"\n{rest}");
            let scene = parse(&text, Path::new("s"), &Overrides::default()).unwrap();
            Plan::new(&scene).idle_keys.iter().any(|idle| idle.key == "volume.outside")
        };
        assert!(is_idle(REGULAR) && is_idle(&format!("{REGULAR}[[halo]]\n")));
        assert!(!is_idle(&format!("{REGULAR}[[halo]]\nseed.direction = {{}}\n")));
        assert!(is_idle("[surface]\niso = 1\n") && !is_idle("[surface]\niso = 1\n[[halo]]\n"));
        let exact = "[[halo]]\nseed.by = \"curvature\"\n[contours]\nkappa = \"exact\"\n";
        assert!(!is_idle(&format!("{REGULAR}{exact}")));
    }

    #[test]
    fn knobs_are_those_of_halos_in_effect() {
        let keys = |halo: &str| {
            let scene = scene(&format!("{REGULAR}{halo}"));
            let knobs = knobs(&scene, &Plan::new(&scene)).into_iter();
            knobs.filter(|knob| knob.key.starts_with("halo")).map(|knob| knob.key).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(keys("[[halo]]\n[[halo]]\nopacity = 0\n[[halo]]\n"), "halo[0].every halo[2].every");
        assert_eq!(keys("[[halo]]\nevery = 4\n"), "halo[0].every halo[0].accumulate");
        assert_eq!(keys("[[halo]]\nspread.reach = \"3 %\"\n"), "halo[0].every halo[0].spread.passes");
        let scene = scene(&format!("{REGULAR}[[halo]]\nevery = 4\nspread.reach = \"3 %\"\n[[halo]]\nname = \"b\"\n"));
        for knob in knobs(&scene, &Plan::new(&scene)).into_iter().filter(|knob| knob.key.starts_with("halo")) {
            for setting in knob.settings {
                let other = knob.set(&scene, setting).unwrap_or_else(|faults| panic!("{faults}"));
                assert_eq!(knob.of(&other).as_deref(), Some(*setting), "{}", knob.key);
                assert_eq!(knob.set(&other, &knob.of(&scene).unwrap()).unwrap(), scene, "{}", knob.key);
            }
        }
    }
}
