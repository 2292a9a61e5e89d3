//! `[outlines]`: lines where an iso-surface turns away from the eye ([HATCH-18]).

use super::surface::IsoKind;
use crate::color::Rgba;
use crate::document::describe::{Key, Slot, Table};
use crate::document::kind::{Bounds, Colors, Lengths, On, Text};
use crate::tables::{Iso, Length};

/// The table `[outlines]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlines {
    /// Of which surface.
    pub iso: Iso,
    /// Of the lines, in mm or px.
    pub width: Length,
    /// Linear, straight.
    pub color: Rgba,
    /// A pen of `[[pen]]`, which draws in place of `width` and `color`.
    pub pen: Option<String>,
    /// Lines that are seen for less are not drawn; in mm or px.
    pub min_length: Length,
}

impl Default for Outlines {
    fn default() -> Self {
        Self {
            iso: Iso::Auto,
            width: Length::Millimetres(0.35),
            color: [0.0, 0.0, 0.0, 1.0],
            pen: None,
            min_length: Length::Millimetres(2.0),
        }
    }
}

/// The description of `[outlines]`.
pub(crate) static TABLE: Table<Outlines> = Table::new(
    "[outlines]",
    "Lines where an iso-surface turns away from the eye and where it meets the volume's box, without what the surface \
         of [surface], or else their own, hides.",
    Outlines::default,
    &[
        Key::new(
            "iso",
            "HATCH-18",
            "The value of the surface; by itself that which an automatic transfer function makes opaque.",
            &Slot { kind: IsoKind, get: |o: &Outlines| Some(o.iso), set: |o, v| o.iso = v },
        ),
        Key::new(
            "width",
            "HATCH-18",
            "Of the lines.",
            &Slot {
                kind: Lengths { on: On::Page, bounds: Bounds::POSITIVE },
                get: |o: &Outlines| Some(o.width),
                set: |o, v| o.width = v,
            },
        ),
        Key::new(
            "color",
            "HATCH-18",
            "Of the lines.",
            &Slot { kind: Colors, get: |o: &Outlines| Some(o.color), set: |o, v| o.color = v },
        ),
        Key::new(
            "pen",
            "HATCH-18",
            "The pen of `[[pen]]` that draws the lines: its nib is their width.",
            &Slot {
                kind: Text { what: "the name of a pen" },
                get: |o: &Outlines| o.pen.clone(),
                set: |o, v| o.pen = Some(v),
            },
        )
        .absent("`color` and `width`"),
        Key::new(
            "min_length",
            "HATCH-18",
            "The length on the page below which what is seen of a line is left out: noise has many small ones.",
            &Slot {
                kind: Lengths { on: On::Page, bounds: Bounds::NOT_NEGATIVE },
                get: |o: &Outlines| Some(o.min_length),
                set: |o, v| o.min_length = v,
            },
        ),
    ],
);

#[cfg(test)]
mod tests {
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
    fn points_and_strokes_are_wanted_apart() {
        let both = scene("[outlines]\niso = 3\n[stipples]\n");
        assert!(
            passes(&Plan::of_points(&both)).iter().all(|pass| !matches!(pass, Pass::Outlines | Pass::HiddenStrokes))
        );
        assert_eq!(passes(&Plan::of_strokes(&both)), [Pass::Outlines, Pass::HiddenStrokes]);
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
