//! The knobs of a scene: keys that trade accuracy for time ([COST-1]).
//!
//! A knob is declared in one line of its table's rules (`plan::rules`): the settings from coarse to fine in a scene,
//! and their limit. [`knobs`] collects all knobs.
//!
//! ```
//! use drypoint_scene::file::{Overrides, parse};
//! use drypoint_scene::{knobs::knobs, plan::Plan};
//! let text = "drypoint = 1\n[volume]\nphantom = { name = \"torus\" }\n";
//! let scene = parse(text, "torus.toml".as_ref(), &Overrides::default())?;
//! let knobs = knobs(&scene, &Plan::new(&scene));
//! let step = knobs.iter().find(|knob| knob.key == "sampling.step").unwrap();
//! assert_eq!((step.of(&scene).as_deref(), step.finest()), (Some("0.5 voxels"), "0.0625 voxels"));
//! let coarse = step.set(&scene, "2 voxels")?;
//! assert_eq!(step.of(&coarse).as_deref(), Some("2 voxels"));
//! # Ok::<(), drypoint_scene::file::Faults>(())
//! ```

use crate::document::out::Out;
use crate::document::set::steps;
use crate::file::{Faults, Overrides, parse, write_full};
pub use crate::plan::Limit;
use crate::plan::Plan;
use crate::plan::rules::rules;
use crate::tables::Scene;
use crate::tables::root::ROOT;
use std::path::Path;

/// A knob that a scene uses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Knob {
    /// The knob's key, such as `sampling.step`, or `pen[0].width` in an item of a list.
    pub key: String,
    /// The settings from coarse to fine, as `--set` takes them; at least two.
    pub settings: &'static [&'static str],
    /// The picture that the settings converge to.
    pub limit: Limit,
}

impl Knob {
    /// The last setting.
    pub fn finest(&self) -> &'static str {
        self.settings.last().copied().unwrap_or_default()
    }

    /// Returns the setting of a scene, as `--set` takes it; none if the scene does not have the knob's table.
    pub fn of(&self, scene: &Scene) -> Option<String> {
        let steps = steps(&self.key).ok()?;
        let (table, inner) = steps.split_first()?;
        let mut value = ROOT.keys.iter().find(|key| key.name == table)?.field.write(scene)?;
        for step in inner {
            value = match value {
                Out::Table(entries) => entries.into_iter().find(|(key, _)| key == step)?.1,
                Out::List(items) => items.into_iter().nth(step.parse().ok()?)?,
                _ => return None,
            };
        }
        Some(match value {
            Out::Text(text) => text,
            other => other.toml(),
        })
    }

    /// Returns the scene with another setting, and no other difference.
    ///
    /// # Errors
    /// A setting that the key does not allow, or that contradicts the rest of the scene.
    pub fn set(&self, scene: &Scene, setting: &str) -> Result<Scene, Faults> {
        let over = [(&*self.key, setting)].into_iter().collect::<Overrides>();
        let set = parse(&write_full(scene), Path::new(""), &over)?;
        // A path that is no Unicode would not come through a text; and errors tell the places of the scene's own file.
        Ok(Scene { volume: scene.volume.clone(), given: scene.given.clone(), ..set })
    }
}

/// The knobs that a scene uses, in the order of the tables.
pub fn knobs(scene: &Scene, plan: &Plan) -> Vec<Knob> {
    let mut knobs = Vec::new();
    for (at, rules) in rules(scene) {
        for (key, ladder) in rules.knobs {
            let settings = (ladder.settings)(scene, plan, at.item);
            if settings.len() > 1 {
                knobs.push(Knob { key: at.inner(key), settings, limit: ladder.limit });
            }
        }
    }
    knobs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(more: &str) -> Scene {
        let text = format!("drypoint = 1\n[volume]\nphantom = {{ name = \"torus\" }}\n{more}");
        parse(&text, Path::new("scene.toml"), &Overrides::default()).unwrap_or_else(|faults| panic!("{faults}"))
    }

    fn keys(scene: &Scene) -> Vec<String> {
        knobs(scene, &Plan::new(scene)).into_iter().map(|knob| knob.key).collect()
    }

    /// Knobs of every scene that draws its volume.
    const ALWAYS: [&str; 7] = [
        "picture.samples",
        "picture.contrast",
        "sampling.step",
        "sampling.kernel",
        "sampling.number",
        "sampling.stop_below",
        "transfer.table",
    ];
    const REGULAR: &str = "[transfer]\nkind = \"regular\"\nnodes = [{ at = 1, color = \"red\" }]\n";

    #[test]
    fn an_unshaded_scene_has_no_gradient_knob() {
        assert_eq!(keys(&scene(REGULAR)), ALWAYS);
    }

    #[test]
    fn a_knob_is_there_where_the_plan_needs_what_it_is_about() {
        let beyond = |more: &str| {
            let mut keys = keys(&scene(more));
            keys.retain(|key| !ALWAYS.contains(&&**key));
            keys.join(" ")
        };
        assert_eq!(beyond(&format!("{REGULAR}[shading]\n")), "sampling.gradient");
        // Contours of a regular function do not exist.
        assert_eq!(beyond(&format!("{REGULAR}[contours]\nkappa = \"exact\"\n")), "");
        assert_eq!(beyond("[contours]\n"), "sampling.gradient contours.kappa");
        assert_eq!(beyond("[contours]\nkappa = \"none\"\n"), "sampling.gradient");
        let exact = "[contours]\nkappa = \"exact\"\n";
        let second = "sampling.gradient sampling.hessian sampling.scale contours.kappa";
        assert_eq!(beyond(exact), second);
        // Only what smooths has a width.
        let central = "[sampling]\nhessian = \"central\"\n";
        assert_eq!(beyond(&format!("{exact}{central}")), second.replace("sampling.scale ", ""));
        let biases = "style_mipmaps.curvature_bias style_mipmaps.gradient_bias";
        assert_eq!(beyond("[style_mipmaps]\n"), format!("sampling.gradient {biases}"));
        let none = "[style_mipmaps]\n[contours]\nkappa = \"none\"\n";
        assert_eq!(beyond(none), "sampling.gradient style_mipmaps.gradient_bias");
    }

    #[test]
    fn points_and_strokes_have_their_own_knobs_and_none_of_rays() {
        let points = "stipples.gradient stipples.order stipples.snap stipples.thin stipples.even";
        assert_eq!(keys(&scene("[stipples]\n")).join(" "), points);
        // A surface that hides them is between the voxels.
        let hidden = scene("[stipples]\nhide_behind = 1\n");
        assert_eq!(keys(&hidden).join(" "), format!("sampling.kernel {points}"));
        let strokes = "hatching.tolerance hatching.chord hatching.directions.rule hatching.directions.from";
        assert_eq!(keys(&scene("[hatching]\n")).join(" "), format!("sampling.kernel {strokes}"));
        let raw = keys(&scene("[hatching]\ndirections = { rule = \"raw\" }\n")).join(" ");
        assert_eq!(raw, format!("sampling.kernel sampling.hessian sampling.scale {strokes}"));
        assert_eq!(keys(&scene("[outlines]\n")), ["sampling.kernel"]);
        let all = keys(&scene(&format!("{REGULAR}[stipples]\n[hatching]\n"))).join(" ");
        assert_eq!(all, format!("{} {points} {strokes}", ALWAYS.join(" ")));
    }

    /// Rules name keys that stand elsewhere, so that a slip would go unseen.
    #[test]
    fn every_knob_is_a_key_of_its_table() {
        let scene = scene("[[pen]]\nname = \"a\"\n[[halo]]\n");
        for (at, rules) in rules(&scene) {
            for (key, _) in rules.knobs {
                let steps = steps(&at.inner(key)).unwrap();
                let mut section = Some(ROOT.section());
                for step in steps.iter().filter(|step| step.parse::<usize>().is_err()) {
                    let keys = section.unwrap().keys;
                    let key = keys.into_iter().find(|key| key.name == step).unwrap_or_else(|| panic!("{steps:?}"));
                    section = key.shape.section().or_else(|| key.shape.item_section());
                }
            }
        }
    }

    #[test]
    fn a_knob_of_an_item_of_a_list_changes_that_item_alone() {
        let scene = scene("[[pen]]\nname = \"a\"\n[[pen]]\nname = \"b\"\nwidth = \"1 mm\"\n");
        let knob = Knob { key: "pen[1].width".into(), settings: &["2 mm", "0.5 mm"], limit: Limit::Finest };
        assert_eq!(knob.of(&scene).as_deref(), Some("1 mm"));
        let fine = knob.set(&scene, knob.finest()).unwrap();
        assert_eq!(knob.of(&fine).as_deref(), Some("0.5 mm"));
        assert_eq!((&fine.pens[0], &fine.pens[1].name), (&scene.pens[0], &scene.pens[1].name));
        for none in ["pen[2].width", "pen.width", "pen[1].size"] {
            assert_eq!(Knob { key: none.into(), ..knob.clone() }.of(&scene), None, "{none}");
        }
    }

    #[test]
    fn every_setting_can_be_set_and_is_read_back() {
        let mut set = 0;
        for more in ["", "kernel = \"bspline\"\n", "kernel = \"bspline5\"\nhessian = \"analytic\"\n"] {
            let marks = "[stipples]\n[hatching]\n[transfer]\n";
            let scene = scene(&format!("{marks}[contours]\nkappa = \"exact\"\n[style_mipmaps]\n[sampling]\n{more}"));
            for knob in knobs(&scene, &Plan::new(&scene)) {
                for setting in knob.settings {
                    let other = knob.set(&scene, setting).unwrap_or_else(|faults| panic!("{faults}"));
                    assert_eq!(knob.of(&other).as_deref(), Some(*setting), "{}", knob.key);
                    let back = knob.set(&other, &knob.of(&scene).unwrap()).unwrap();
                    assert_eq!(back, scene, "{} changes nothing else", knob.key);
                    set += 1;
                }
            }
        }
        assert!(set > 90, "{set}");
    }
}
