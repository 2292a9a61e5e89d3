//! `[[pen]]`: the pens that layers of points and lines are drawn with ([IO-7]).

use crate::document::declare::table;
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Colors, Lengths, On, PathTo, Text};
use crate::tables::Length;
use std::path::PathBuf;

table! {
    /// One table `[[pen]]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct PenSettings {
        /// Name by which other tables call the pen; the layer's name contains it.
        name: String = String::new(), key("IO-7", Text { what: "the name of a pen" }).required();
        /// Width of the nib.
        ///
        /// In mm or px.
        width: Length = Length::Millimetres(0.3), key("IO-7", Lengths { on: On::Page, bounds: Bounds::POSITIVE });
        /// Colour of its ink.
        ///
        /// Linear, straight.
        color: [f64; 4] = [0.0, 0.0, 0.0, 1.0], key("IO-7", Colors);
        /// Tones that the pen prints: a step wedge as CSV with the columns `wanted` and `measured`, which the command `wedge`
        /// draws.
        tone: Option<PathBuf> = None, key("STIP-17", PathTo { what: "a step wedge" }).absent("discs of the nib");
    }
}

/// The description of a pen.
pub(crate) static TABLE: Table<PenSettings> =
    PenSettings::description("a pen", "What draws a layer of points and lines.");

#[cfg(test)]
mod tests {
    use crate::file::{Overrides, parse};
    use std::path::Path;

    #[test]
    fn pens_are_told_apart_by_their_names() {
        let faults = |pens: &str| {
            let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n{pens}");
            parse(&text, Path::new("scene.toml"), &Overrides::default())
                .map(|scene| scene.pens.len())
                .map_err(|f| f.to_string())
        };
        assert_eq!(faults("[[pen]]\nname = \"fine\"\n[[pen]]\nname = \"broad\"\n"), Ok(2));
        let twice = faults("[[pen]]\nname = \"fine\"\n[[pen]]\nname = \"fine\"\n").unwrap_err();
        assert!(
            twice.contains("pen[0] and pen[1] are both called \"fine\"") && twice.contains("pen[1].name"),
            "{twice}"
        );
        let nameless = faults("[[pen]]\nwidth = \"0.3 mm\"\n").unwrap_err();
        assert!(nameless.contains("name"), "{nameless}");
        let nib = faults("[[pen]]\nname = \"fine\"\nwidth = \"0 mm\"\n").unwrap_err();
        assert!(nib.contains("a length above 0"), "{nib}");
    }
}
