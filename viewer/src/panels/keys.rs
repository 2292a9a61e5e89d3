//! All keys of the document as a tree, made from the schema of scene files. Each key has its documentation as a tooltip,
//! and what the document does not give is shown as its default.

use super::Panel;
use crate::document::Edit;
use crate::key::KeyPath;
use crate::schema::{Kind, Node};
use crate::session::Session;
use crate::widgets::{Value, editor};
use eframe::egui::{self, CollapsingHeader, RichText, ScrollArea, Ui};
use toml_edit::{InlineTable, Item};

/// The panel of all keys.
pub struct KeysPanel {
    root: Node,
    search: String,
    only_given: bool,
}

impl Default for KeysPanel {
    fn default() -> Self {
        Self { root: Node::scene(), search: String::new(), only_given: false }
    }
}

impl Panel for KeysPanel {
    fn title(&self) -> &'static str {
        "All keys"
    }

    fn ui(&mut self, ui: &mut Ui, session: &mut Session) {
        ui.horizontal(|ui| {
            let label = ui.label("Search");
            let width = (ui.available_width() - 110.0).max(60.0);
            ui.add(egui::TextEdit::singleline(&mut self.search).desired_width(width)).labelled_by(label.id);
            ui.checkbox(&mut self.only_given, "given only").on_hover_text("Shows only keys that the scene gives");
        });
        ui.separator();
        let Self { root, search, only_given } = self;
        let filter = Filter { search: search.trim().to_lowercase(), only_given: *only_given };
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            // The version of the format is no choice.
            for child in root.children().iter().filter(|child| child.name != "drypoint") {
                tree(ui, session, child, &KeyPath::default().name(&child.name), &filter);
            }
        });
    }
}

/// The keys that are shown.
#[derive(Default)]
pub(super) struct Filter {
    search: String,
    only_given: bool,
}

impl Filter {
    /// Whether a key or one below it is shown.
    fn shows(&self, node: &Node, path: &KeyPath, session: &Session) -> bool {
        (!self.only_given || session.document.get(path).is_some()) && (self.search.is_empty() || self.finds(node, path))
    }

    fn finds(&self, node: &Node, path: &KeyPath) -> bool {
        let text = format!("{path} {}", node.doc).to_lowercase();
        text.contains(&self.search) || node.children().iter().any(|child| self.finds(child, &path.name(&child.name)))
    }
}

/// Shows a key: a line with an editor, a table with its keys, or a list with its items.
pub(super) fn tree(ui: &mut Ui, session: &mut Session, node: &Node, path: &KeyPath, filter: &Filter) {
    if !filter.shows(node, path, session) {
        return;
    }
    let is_given = session.document.get(path).is_some();
    let title = if is_given { RichText::new(&node.name).strong() } else { RichText::new(&node.name).weak() };
    let open = (!filter.search.is_empty()).then_some(true);
    match &node.kind {
        Kind::Table(children) => {
            let header = CollapsingHeader::new(title).id_salt(path.to_string()).open(open);
            let shown = header.show(ui, |ui| {
                children.iter().for_each(|child| tree(ui, session, child, &path.name(&child.name), filter));
            });
            shown.header_response.on_hover_text(&node.doc).context_menu(|ui| menu(ui, session, path, is_given));
        }
        Kind::List(children) => {
            let count = session.document.get(path).map_or(0, length);
            let header = CollapsingHeader::new(title).id_salt(path.to_string()).open(open);
            let shown = header.show(ui, |ui| {
                for i in 0..count {
                    let item = path.item(i);
                    CollapsingHeader::new(format!("{} {i}", node.name)).id_salt(item.to_string()).show(ui, |ui| {
                        if ui.small_button("Remove").clicked() {
                            session.edit(&format!("remove {item}"), vec![Edit::Remove(item.clone())]);
                            return;
                        }
                        children.iter().for_each(|child| tree(ui, session, child, &item.name(&child.name), filter));
                    });
                }
                if ui.button(format!("Add to {}", node.name)).clicked() {
                    let required = children.iter().filter(|child| child.is_required);
                    let table = required.map(|child| (child.name.as_str(), child.example())).collect::<InlineTable>();
                    session.edit(&format!("add to {path}"), vec![Edit::Insert(path.clone(), count, table)]);
                }
            });
            shown.header_response.on_hover_text(&node.doc).context_menu(|ui| menu(ui, session, path, is_given));
        }
        Kind::Value(kind) => {
            ui.horizontal(|ui| {
                ui.add_space(18.0);
                let left = egui::Layout::left_to_right(egui::Align::Center);
                let named = ui.allocate_ui_with_layout(egui::vec2(124.0, 18.0), left, |ui| {
                    ui.set_min_width(124.0);
                    ui.add(egui::Label::new(title).truncate())
                });
                let label = named.inner.on_hover_text(&node.doc);
                let value = Value { kind, given: session.document.get(path).cloned(), default: node.default.as_ref() };
                if let Some(set) = editor(ui, &path.to_string(), label.id, value) {
                    session.set(path, set);
                }
                if is_given && ui.small_button("×").on_hover_text("Take the key out of the scene").clicked() {
                    session.edit(&format!("remove {path}"), vec![Edit::Remove(path.clone())]);
                }
            });
        }
    }
}

fn menu(ui: &mut Ui, session: &mut Session, path: &KeyPath, is_given: bool) {
    if ui.add_enabled(is_given, egui::Button::new(format!("Take {path} out of the scene"))).clicked() {
        session.edit(&format!("remove {path}"), vec![Edit::Remove(path.clone())]);
        ui.close();
    }
}

/// The number of items of a list.
fn length(item: &Item) -> usize {
    item.as_array()
        .map(toml_edit::Array::len)
        .or_else(|| item.as_array_of_tables().map(toml_edit::ArrayOfTables::len))
        .unwrap_or(0)
}
