//! `[outlines]`: lines where an iso-surface turns away from the eye ([HATCH-18]).

use super::surface::IsoKind;
use crate::color::Rgba;
use crate::document::declare::table;
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Colors, Lengths, On, Text};
use crate::tables::{Iso, Length};

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
    }
}

/// The description of `[outlines]`.
pub(crate) static TABLE: Table<Outlines> = Outlines::description(
    "[outlines]",
    "Lines where an iso-surface turns away from the eye and where it meets the volume's box, without what the surface \
         of [surface], or else their own, hides.",
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
