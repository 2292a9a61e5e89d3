//! The description of a whole figure file.

use super::panel::PANEL;
use super::{FigureSettings, Panel, PanelSource, settings};
use crate::document::Given;
use crate::document::declare::{keys, unless_empty};
use crate::document::describe::Table;
use crate::document::kind::{FEW, ListOf, TableOf};
use crate::tables::root::Version;
use crate::tables::{PageSettings, page};

/// Several scenes on one page.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// The arrangement of panels, and the text around them.
    pub figure: FigureSettings,
    /// The paper; none: no margin.
    pub page: Option<PageSettings>,
    /// The panels, at least one.
    pub panels: Vec<Panel>,
    /// The places of the keys.
    pub given: Given,
}

impl Figure {
    /// The pictures of panels and insets, with the names of their tables.
    pub fn sources(&self) -> Vec<(String, &PanelSource)> {
        let mut all = Vec::new();
        for (i, panel) in self.panels.iter().enumerate() {
            all.push((format!("panel[{i}]"), &panel.source));
            let insets = panel.insets.iter().enumerate();
            all.extend(insets.map(|(j, inset)| (format!("panel[{i}].inset[{j}]"), &inset.source)));
        }
        all
    }
}

/// The whole file.
pub(crate) static ROOT: Table<Figure> = Table {
    check: |figure, check| {
        for (i, panel) in figure.panels.iter().enumerate().filter(|(_, panel)| panel.columns > figure.figure.columns) {
            let what = format!("a panel takes {} columns, and the figure has {}", panel.columns, figure.figure.columns);
            let remedy = "take fewer, or raise figure.columns".into();
            check.fault_in(&format!("panel[{i}].columns"), crate::document::Problem::Contradiction { what, remedy });
        }
    },
    ..Table::new(
        "a figure",
        "A figure file is TOML. It puts several scenes on one page, with letters and captions. `drypoint figure` draws \
         it. Paths are relative to the figure file.",
        Figure::default,
        keys! { Figure {
            /// Version of the format.
            drypoint: key("", Version, |_| Some(()), |_, ()| {}).required();
            /// The arrangement of panels, and the text around them.
            figure: key("IO-7", TableOf(&settings::TABLE));
            /// The paper.
            page: key("IO-7", TableOf(&page::TABLE)).absent("no margin, no plotter");
            /// The panels, row by row.
            panels: key("IO-7", ListOf { what: "a list of panels", most: FEW, each: TableOf(&PANEL) },
                |f| unless_empty(&f.panels)).named("panel").required();
        } },
    )
};
