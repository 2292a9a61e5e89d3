//! `[[pen]]`: the pens that layers of points and lines are drawn with ([IO-7]).

use crate::document::describe::{Key, Slot, Table};
use crate::document::kind::{Bounds, Colors, Lengths, On, PathTo, Text};
use crate::tables::Length;
use std::path::PathBuf;

/// One table `[[pen]]`.
#[derive(Clone, Debug, PartialEq)]
pub struct PenSettings {
    /// What other tables call it by.
    pub name: String,
    /// Across the nib, in mm or px.
    pub width: Length,
    /// Linear, straight.
    pub color: [f64; 4],
    /// A measured step wedge ([STIP-17]); none: its dots are discs.
    pub tone: Option<PathBuf>,
}

impl Default for PenSettings {
    fn default() -> Self {
        Self { name: String::new(), width: Length::Millimetres(0.3), color: [0.0, 0.0, 0.0, 1.0], tone: None }
    }
}

/// The description of a pen.
pub(crate) static TABLE: Table<PenSettings> = Table::new(
        "a pen",
        "What draws a layer of points and lines.",
        PenSettings::default,
        &[
            Key::new(
                "name",
                "IO-7",
                "What other tables call it by; it is in the layer's name.",
                &Slot {
                    kind: Text { what: "the name of a pen" },
                    get: |p: &PenSettings| Some(p.name.clone()),
                    set: |p, v| p.name = v,
                },
            )
            .required(),
            Key::new(
                "width",
                "IO-7",
                "Across the nib.",
                &Slot {
                    kind: Lengths { on: On::Page, bounds: Bounds::POSITIVE },
                    get: |p: &PenSettings| Some(p.width),
                    set: |p, v| p.width = v,
                },
            ),
            Key::new(
                "color",
                "IO-7",
                "Of its ink.",
                &Slot { kind: Colors, get: |p: &PenSettings| Some(p.color), set: |p, v| p.color = v },
            ),
            Key::new(
                "tone",
                "STIP-17",
                "What it prints: a step wedge as CSV with the columns `wanted` and `measured`, which the command `wedge` draws.",
                &Slot {
                    kind: PathTo { what: "a step wedge" },
                    get: |p: &PenSettings| p.tone.clone(),
                    set: |p, v| p.tone = Some(v),
                },
            )
            .absent("discs of the nib"),
        ],
    );

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
