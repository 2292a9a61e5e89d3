//! The panes of the window, which the user arranges.

use crate::panels::Panel;
use crate::picture::picture;
use crate::session::Session;
use eframe::egui::{self, Ui};
use egui_tiles::{Tile, TileId, Tiles, Tree};

/// A pane of the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pane {
    Picture,
    /// The panel of an index.
    Panel(usize),
}

/// The first arrangement: the picture, and the panels as tabs beside it.
pub(super) fn tree(panels: usize) -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let picture = tiles.insert_pane(Pane::Picture);
    let tabs = (0..panels).map(|i| tiles.insert_pane(Pane::Panel(i))).collect();
    let tabs = tiles.insert_tab_tile(tabs);
    let root = tiles.insert_horizontal_tile(vec![picture, tabs]);
    if let Some(Tile::Container(egui_tiles::Container::Linear(linear))) = tiles.get_mut(root) {
        linear.shares.set_share(picture, 0.68);
        linear.shares.set_share(tabs, 0.32);
    }
    Tree::new(egui::Id::unique("panes"), root, tiles)
}

/// The panes as the tree asks for them.
pub(super) struct Layout<'v> {
    pub(super) session: &'v mut Session,
    pub(super) panels: &'v mut Vec<Box<dyn Panel>>,
}

impl egui_tiles::Behavior<Pane> for Layout<'_> {
    fn pane_ui(&mut self, ui: &mut Ui, _: TileId, pane: &mut Pane) -> egui_tiles::UiResponse {
        match *pane {
            Pane::Picture => picture(ui, self.session, self.panels),
            Pane::Panel(i) => {
                if let Some(panel) = self.panels.get_mut(i) {
                    ui.painter().rect_filled(ui.max_rect(), 0.0, ui.visuals().panel_fill);
                    egui::Frame::new().inner_margin(8).show(ui, |ui| panel.ui(ui, self.session));
                }
            }
        }
        egui_tiles::UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> egui::WidgetText {
        match *pane {
            Pane::Picture => "Picture".into(),
            Pane::Panel(i) => self.panels.get(i).map_or("", |panel| panel.title()).into(),
        }
    }

    /// So all tabs fit beside the picture in a window of 1200 points.
    fn tab_title_spacing(&self, _: &egui::Visuals) -> f32 {
        5.0
    }

    fn simplification_options(&self) -> egui_tiles::SimplificationOptions {
        egui_tiles::SimplificationOptions { all_panes_must_have_tabs: false, ..Default::default() }
    }
}
