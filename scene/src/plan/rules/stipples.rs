//! Rules of `[stipples]`: needs, keys without effect, knobs.

use super::{Asks, Idle, Ladder, Pass, Rules, Settings};
use crate::plan::Plan;
use crate::tables::{CurvesTest, DotColor, Even, Iso, Scene, Stipples};

/// The rules of `[stipples]`.
pub(super) const RULES: Rules = Rules {
    asks,
    idle: |scene, _, idle| idle_keys(scene, idle),
    knobs: &[
        ("gradient", Ladder::to_finest(|_, plan, _| of_points(plan, &["central", "regression"]))),
        ("order", Ladder::to_finest(|_, plan, _| of_points(plan, &["voxel", "neighbours"]))),
        ("snap", Ladder::to_finest(|_, plan, _| of_points(plan, &["none", "edge"]))),
        (
            "thin",
            Ladder::to_finest(|scene, plan, _| match &scene.stipples {
                Some(Stipples { iso: Some(_), .. }) => &[],
                _ => of_points(plan, &["false", "true"]),
            }),
        ),
        ("even", Ladder::to_finest(|_, plan, _| of_points(plan, &["none", "page"]))),
    ],
    ..Rules::new("stipples")
};

/// Settings of a key by which points are made.
fn of_points(plan: &Plan, settings: Settings) -> Settings {
    if plan.has_pass(Pass::StipplePoints) { settings } else { &[] }
}

/// Asks for passes that run once, and for those of a frame.
fn asks(scene: &Scene, asks: &mut Asks) {
    let Some(stipples) = scene.stipples.as_ref().filter(|_| asks.draws_points()) else { return };
    asks.pass(Pass::StippleGradients, "stipples", "stipples.gradient");
    asks.pass(Pass::StipplePoints, "stipples", "stipples.k_max");
    asks.pass(Pass::Dots, "stipples", "stipples");
    if stipples.hide_behind.is_some() {
        asks.pass(Pass::HiddenPoints, "hidden points", "stipples.hide_behind");
    }
    if stipples.even == Even::Page {
        asks.pass(Pass::DotsOnPage, "even on the page", "stipples.even");
    }
    if stipples.iso == Some(Iso::Auto) {
        asks.pass(Pass::AutomaticIso, "stipples", "stipples.iso");
    }
    if stipples.hide_behind == Some(Iso::Auto) {
        asks.pass(Pass::AutomaticIso, "hidden points", "stipples.hide_behind");
    }
    if stipples.curves.is_some() {
        asks.pass(Pass::CurveVoxels, "silhouette curves", "stipples.curves");
        asks.pass(Pass::Curves, "silhouette curves", "stipples.curves");
    }
    if stipples.pen.is_none() && !matches!(stipples.color, DotColor::Fixed(_)) {
        asks.pass(Pass::DotColors, "colours of dots", "stipples.color");
        if scene.transfer.as_ref().is_some_and(|transfer| transfer.over.is_over_labels()) {
            asks.pass(Pass::DotLabels, "colours of dots", "stipples.color");
        }
        if !asks.casts_rays() && scene.transfer.as_ref().is_some_and(|transfer| transfer.is_automatic()) {
            asks.pass(Pass::AutomaticTransfer, "colours of dots", "transfer.nodes");
        }
    }
    // An exponent of 0 turns its factor off.
    for (has, pass, key) in [
        (stipples.boundary.is_some(), Pass::StillFactor, "stipples.boundary"),
        (stipples.interior.is_some_and(|t| t.te != 0.0), Pass::StillFactor, "stipples.interior"),
        (stipples.silhouette.is_some(), Pass::Factor, "stipples.silhouette"),
        (stipples.resolution.is_some_and(|t| t.re != 0.0), Pass::Factor, "stipples.resolution"),
        (stipples.distance.is_some_and(|t| t.de != 0.0), Pass::Factor, "stipples.distance"),
        (stipples.lighting.is_some_and(|t| t.le != 0.0), Pass::Factor, "stipples.lighting"),
    ] {
        if has {
            asks.pass(pass, key.rsplit('.').next().unwrap_or(key), key);
        }
    }
}

/// Lists the keys that other keys of the table make idle.
fn idle_keys(scene: &Scene, idle: &mut Idle) {
    let Some(stipples) = &scene.stipples else { return };
    if stipples.iso.is_some() {
        idle.key("stipples.threshold", "points lie on the surface of stipples.iso");
        idle.key("stipples.thin", "the surface of stipples.iso has one layer");
    }
    if stipples.pen.is_some() {
        idle.key("stipples.color", "stipples.pen says the colour");
    }
    if scene.page.as_ref().is_some_and(|page| page.plotter) {
        idle.key("stipples.ink", "a plotter's nib cannot fade: its ink is opaque");
    } else if stipples.even == Even::Page {
        idle.key("stipples.ink", "dots that are chosen on the page are whole");
    }
    let sums = [stipples.boundary.map(|t| t.gc + t.gs), stipples.silhouette.map(|t| t.sc + t.ss)];
    if sums.into_iter().flatten().all(|sum| sum <= 1.0) {
        idle.key("stipples.factors", "no factor can be above 1");
    }
    const OFF: &str = "an exponent of 0 turns the factor off";
    if stipples.lighting.is_some_and(|t| t.le == 0.0) {
        idle.key("stipples.lighting.light", OFF);
    }
    if stipples.resolution.is_some_and(|t| t.re == 0.0) {
        idle.key("stipples.resolution.reference", OFF);
    }
    match stipples.curves.map(|curves| curves.test) {
        Some(CurvesTest::TwoSided) => idle.key("stipples.curves.eye", "it is for test = \"literal\""),
        Some(CurvesTest::Literal) => idle.key("stipples.curves.c", "it is for test = \"two-sided\""),
        None => {}
    }
}

#[cfg(test)]
mod tests {
    use crate::file::{Overrides, parse};
    use std::path::Path;

    #[test]
    fn a_factor_that_is_off_is_not_asked_for_and_what_it_would_read_is_idle() {
        use crate::plan::{Pass, Plan};
        let plan = |rest: &str| {
            let text =
                format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n[stipples]\nfactors = \"normalize\"\n{rest}");
            Plan::new(&parse(&text, Path::new("scene.toml"), &Overrides::default()).unwrap_or_else(|e| panic!("{e}")))
        };
        let idle = |plan: &Plan| plan.idle_keys.iter().map(|idle| idle.key.clone()).collect::<Vec<_>>().join(" ");
        for (table, key) in [
            ("lighting", "le = 0\nlight = [1, 0, 0]"),
            ("resolution", "re = 0\nreference = 3"),
            ("distance", "de = 0"),
            ("interior", "te = 0"),
        ] {
            let [off, on] =
                ["= 0", "= 1"].map(|value| plan(&format!("[stipples.{table}]\n{}\n", key.replacen("= 0", value, 1))));
            let asked = |plan: &Plan| plan.has_pass(Pass::Factor) || plan.has_pass(Pass::StillFactor);
            assert_eq!((asked(&off), asked(&on)), (false, true), "{table}");
            let read = match table {
                "lighting" => " stipples.lighting.light",
                "resolution" => " stipples.resolution.reference",
                _ => "",
            };
            assert_eq!((idle(&off), idle(&on)), (format!("stipples.factors{read}"), "stipples.factors".into()));
        }
        // Points of one surface have no threshold, and one layer.
        assert_eq!(
            idle(&plan("iso = 3\nthreshold = 0.2\nthin = true\n")),
            "stipples.factors stipples.threshold stipples.thin"
        );
        // One that can leave [0, 1] is what `factors` is for.
        for (gs, said) in [("0.6", "stipples.factors"), ("0.7", "")] {
            assert_eq!(idle(&plan(&format!("[stipples.boundary]\ngc = 0.4\ngs = {gs}\nge = 1\n"))), said, "{gs}");
        }
    }
}
