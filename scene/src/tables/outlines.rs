//! `[outlines]`: lines where an iso-surface turns away from the eye ([HATCH-18]), and along its edges ([HATCH-22]).

use super::surface::IsoKind;
use crate::color::Rgba;
use crate::document::check::Check;
use crate::document::declare::table;
use crate::document::describe::{Kind, Shape, Table};
use crate::document::item::Item;
use crate::document::kind::{Bounds, Colors, Lengths, On, Text};
use crate::document::out::Out;
use crate::tables::{Iso, Length};
use serde_json::{Value as Json, json};

table! {
    /// The table `[outlines]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Outlines {
        /// The value of the surface; by itself that which an automatic transfer function makes opaque.
        iso: Iso = Iso::Auto, key("HATCH-18", IsoKind);
        /// Width of the lines.
        ///
        /// In mm or px.
        width: Length = Length::Millimetres(0.35), key("HATCH-18", Lengths { on: On::Page, bounds: Bounds::POSITIVE });
        /// Colour of the lines.
        ///
        /// Linear, straight.
        color: Rgba = [0.0, 0.0, 0.0, 1.0], key("HATCH-18", Colors);
        /// The pen of `[[pen]]` that draws the lines: its nib is their width.
        pen: Option<String> = None, key("HATCH-18", Text { what: "the name of a pen" }).absent("`color` and `width`");
        /// The length on the page below which what is seen of a line is left out: noise has many small ones.
        ///
        /// In mm or px.
        min_length: Length = Length::Millimetres(2.0),
            key("HATCH-18", Lengths { on: On::Page, bounds: Bounds::NOT_NEGATIVE });
        /// The angle by which the normal turns over two voxels at edges and valleys that are drawn, too: "30 deg".
        ///
        /// In degrees.
        crease: Crease = Crease::Off, key("HATCH-22", CreaseKind);
    }
}

/// `crease` ([HATCH-22]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Crease {
    /// No creases.
    Off,
    /// Creases at which the normal turns by at least this angle over two voxels, in degrees.
    Degrees(f64),
}

impl Crease {
    /// The angle of a first picture: a right angle between two faces turns by 51° over two voxels, a ball of eight
    /// voxels by 14°.
    pub(crate) const PRINT: Self = Self::Degrees(30.0);
}

impl Outlines {
    /// The table of presets for print: with creases.
    pub(crate) fn for_print() -> Self {
        Self { crease: Crease::PRINT, ..Self::default() }
    }
}

/// An angle with its unit, or `"off"`.
struct CreaseKind;

const ANGLE: Bounds = Bounds::between(0.0, 180.0);
const UNIT: &str = "deg";
const OFF: &str = "off";

impl Shape for CreaseKind {
    fn expected(&self) -> String {
        format!("\"{OFF}\", or an angle{} with its unit, such as \"30 {UNIT}\"", ANGLE.words())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [{ "const": OFF }, { "type": "string", "pattern": format!("^[0-9.]+ {UNIT}$") }] })
    }
}

impl Kind for CreaseKind {
    type Of = Crease;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Crease> {
        let degrees = |text: &str| text.strip_suffix(UNIT)?.trim_end().parse().ok().filter(|x| ANGLE.contain(*x));
        match (item.text(), item.text().and_then(degrees)) {
            (Some(OFF), _) => Some(Crease::Off),
            (_, Some(degrees)) => Some(Crease::Degrees(degrees)),
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &Crease) -> Out {
        match value {
            Crease::Off => Out::Text(OFF.into()),
            Crease::Degrees(degrees) => Out::Text(format!("{degrees} {UNIT}")),
        }
    }
}

/// The description of `[outlines]`.
pub(crate) static TABLE: Table<Outlines> = Outlines::description(
    "[outlines]",
    "Lines where an iso-surface turns away from the eye, where it meets the volume's box, and along its edges, without \
         what the surface of [surface], or else their own, hides.",
);

#[cfg(test)]
mod tests {
    use super::Crease;
    use crate::file::{Overrides, parse};
    use crate::plan::{Pass, Plan};
    use crate::tables::Scene;
    use std::path::Path;

    fn scene(rest: &str) -> Scene {
        let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n{rest}");
        parse(&text, Path::new("scene.toml"), &Overrides::default()).unwrap()
    }

    fn passes(plan: &Plan) -> Vec<Pass> {
        plan.passes.iter().map(|need| need.pass).collect()
    }

    #[test]
    fn outlines_alone_draw_no_volume_and_ask_for_what_they_need() {
        let own = scene("[outlines]\n");
        assert!(own.transfer.is_none() && own.surface.is_none());
        assert_eq!(passes(&Plan::new(&own)), [Pass::AutomaticIso, Pass::Outlines, Pass::HiddenStrokes]);
        assert_eq!(Plan::new(&own).needs, []);
        let said = scene("[outlines]\niso = 3\n[sampling]\nkernel = \"bspline\"\n");
        assert_eq!(passes(&Plan::new(&said)), [Pass::Coefficients, Pass::Outlines, Pass::HiddenStrokes]);
        // What hides has a value of its own to be found.
        let hidden = scene("[outlines]\niso = 3\n[surface]\nlook = \"none\"\n");
        assert_eq!(passes(&Plan::new(&hidden)), [Pass::AutomaticIso, Pass::Outlines, Pass::HiddenStrokes]);
        assert_eq!(Plan::new(&hidden).idle_keys, []);
    }

    #[test]
    fn creases_are_asked_for() {
        let text = |rest: &str| format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n[outlines]\niso = 3\n{rest}");
        let read = |rest: &str| parse(&text(rest), Path::new("scene.toml"), &Overrides::default());
        let crease = |rest: &str| read(rest).unwrap().outlines.unwrap().crease;
        assert_eq!([crease(""), crease("crease = \"off\"\n")], [Crease::Off; 2]);
        assert_eq!(crease("crease = \"22.5 deg\"\n"), Crease::Degrees(22.5));
        for wrong in ["30", "\"30\"", "\"0 deg\"", "\"180 deg\"", "\"nan deg\"", "true"] {
            let error = read(&format!("crease = {wrong}\n")).unwrap_err().to_string();
            assert!(error.contains("write \"off\", or an angle above 0 and below 180 with its unit"), "{error}");
        }
        let own = scene("[outlines]\niso = 3\ncrease = \"30 deg\"\n");
        assert_eq!(passes(&Plan::new(&own)), [Pass::Creases, Pass::Outlines, Pass::HiddenStrokes]);
        for preset in ["hatch", "outline"] {
            let bare = format!("drypoint = 1\npreset = \"{preset}\"\n[volume]\nfile = \"a.nrrd\"\n");
            let with = |settings: &[(&str, &str)]| {
                let scene = parse(&bare, Path::new("s"), &settings.iter().copied().collect()).unwrap();
                scene.outlines.unwrap().crease
            };
            assert_eq!(with(&[]), Crease::PRINT);
            assert_eq!(with(&[("outlines.crease", "\"off\"")]), Crease::Off);
        }
    }

    #[test]
    fn outlines_go_with_points_and_with_strokes() {
        let both = scene("[outlines]\niso = 3\n[stipples]\n[hatching]\niso = 3\n");
        let points = passes(&Plan::of_points(&both));
        assert!([Pass::Dots, Pass::Outlines, Pass::HiddenStrokes].iter().all(|pass| points.contains(pass)));
        let strokes = passes(&Plan::of_strokes(&both));
        assert!([Pass::Strokes, Pass::Outlines, Pass::HiddenStrokes].iter().all(|pass| strokes.contains(pass)));
        assert!(!points.contains(&Pass::Strokes) && !strokes.contains(&Pass::Dots));
        assert_eq!(passes(&Plan::of_marks(&both)), passes(&Plan::new(&both)));
    }

    #[test]
    fn keys_without_effect_are_told() {
        let idle = |rest: &str| -> Vec<String> {
            Plan::new(&scene(rest)).idle_keys.into_iter().map(|idle| idle.key).collect()
        };
        let pen = "[[pen]]\nname = \"fine\"\n[outlines]\npen = \"fine\"\niso = 3\n";
        assert_eq!(idle(&format!("{pen}width = \"1 mm\"\ncolor = \"red\"\n")), ["outlines.width", "outlines.color"]);
        let used = "[sampling]\nkernel = \"bspline\"\ngradient = \"sobel\"\n[picture]\ndpi = 100\n";
        assert_eq!(idle(&format!("{pen}min_length = \"0 mm\"\n{used}")), [""; 0]);
    }
}
