//! Editors of single values.

use crate::camera::{number, rounded};
use crate::schema::ValueKind;
use eframe::egui::{self, Color32, ComboBox, DragValue, Id, Response, TextEdit, Ui};
use serde_json::Value as Json;
use toml_edit::{Array, Item};

/// A value that is edited.
pub struct Value<'a> {
    /// The values that the schema allows.
    pub kind: &'a ValueKind,
    /// The value in the document, if it is there.
    pub given: Option<Item>,
    /// The value without one in the document.
    pub default: Option<&'a Json>,
}

/// Shows an editor of a value, named by a label. Returns the value that it was changed to. Texts are changed when the
/// field is left.
pub fn editor(ui: &mut Ui, id: &str, label: Id, value: Value<'_>) -> Option<toml_edit::Value> {
    let Value { kind, given, default } = value;
    let floats = |n| numbers(given.as_ref()).or_else(|| default.and_then(json_numbers)).filter(|all| all.len() == n);
    match kind {
        ValueKind::Switch => {
            let mut on = given.as_ref().and_then(Item::as_bool).or(default.and_then(Json::as_bool)).unwrap_or(false);
            ui.checkbox(&mut on, "").labelled_by(label).changed().then(|| on.into())
        }
        ValueKind::Choice(choices) => {
            let chosen = given.as_ref().and_then(Item::as_str).or(default.and_then(Json::as_str)).unwrap_or_default();
            let mut picked = None;
            let combo = ComboBox::from_id_salt(id)
                .selected_text(if chosen.is_empty() { "—" } else { chosen })
                .width(130.0)
                .show_ui(ui, |ui| {
                    for (name, doc) in choices {
                        let option = ui.selectable_label(name == chosen, name);
                        let option = if doc.is_empty() { option } else { option.on_hover_text(doc) };
                        if option.clicked() {
                            picked = Some(name.as_str().into());
                        }
                    }
                });
            combo.response.labelled_by(label);
            picked
        }
        ValueKind::Number { least, most, is_whole } if given.is_none() || floats(1).is_some() => {
            let mut x = floats(1).map_or(0.0, |all| all[0]);
            let range = least.unwrap_or(f64::NEG_INFINITY)..=most.unwrap_or(f64::INFINITY);
            let by = speed(x, *is_whole);
            let drag = DragValue::new(&mut x).speed(by).range(range).max_decimals(6);
            let drag = if *is_whole { drag.fixed_decimals(0) } else { drag };
            ui.add(drag).labelled_by(label).changed().then(|| number(rounded(x, if *is_whole { 0 } else { 6 })))
        }
        ValueKind::Numbers(n) if given.is_none() || floats(*n).is_some() => {
            let mut all = floats(*n).unwrap_or_else(|| vec![0.0; *n]);
            let mut is_changed = false;
            for x in &mut all {
                let by = speed(*x, false);
                is_changed |= ui.add(DragValue::new(x).speed(by).max_decimals(6)).labelled_by(label).changed();
            }
            is_changed
                .then(|| toml_edit::Value::Array(all.into_iter().map(|x| number(rounded(x, 6))).collect::<Array>()))
        }
        _ => {
            let text = given.as_ref().map(written).or_else(|| default.map(json_text)).unwrap_or_default();
            color_button(ui, &text).or_else(|| text_field(ui, id, label, &text)).map(|text| read(&text))
        }
    }
}

/// Returns how much a number changes with a point of a drag.
fn speed(x: f64, is_whole: bool) -> f64 {
    if is_whole { 0.1 } else { (x.abs() * 0.005).max(0.002) }
}

/// Shows a text field. Returns its text when the field is left after it was changed.
pub fn text_field(ui: &mut Ui, id: &str, label: Id, text: &str) -> Option<String> {
    let id = ui.make_persistent_id(("text", id));
    let mut edited = ui.data_mut(|data| data.get_temp::<String>(id)).unwrap_or_else(|| text.to_owned());
    let field = ui.add(TextEdit::singleline(&mut edited).id(id.with("field")).desired_width(130.0)).labelled_by(label);
    if field.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, edited));
        return None;
    }
    ui.data_mut(|data| data.remove::<String>(id));
    (field.lost_focus() && edited != text).then_some(edited)
}

/// Shows a button with a colour, if a text is one. Returns the colour that was picked.
pub fn color_button(ui: &mut Ui, text: &str) -> Option<String> {
    let mut color = Color32::from_hex(text.trim_matches('"')).ok()?;
    let is_changed =
        egui::color_picker::color_edit_button_srgba(ui, &mut color, egui::color_picker::Alpha::OnlyBlend).changed();
    is_changed.then(|| hex(color))
}

/// Gives a widget a name for screen readers.
pub fn named(response: &Response, name: &str) {
    response.ctx.accesskit_node_builder(response.id, |node| node.set_label(name));
}

/// A colour as a scene file writes it.
pub fn hex(color: Color32) -> String {
    let [r, g, b, a] = color.to_srgba_unmultiplied();
    if a == 255 { format!("#{r:02x}{g:02x}{b:02x}") } else { format!("#{r:02x}{g:02x}{b:02x}{a:02x}") }
}

/// A value as a person types it: a text without quotes, all else as TOML.
fn written(item: &Item) -> String {
    item.as_str().map_or_else(|| item.to_string().trim().to_owned(), str::to_owned)
}

/// Reads what a person typed: TOML, or else a bare text.
fn read(text: &str) -> toml_edit::Value {
    text.trim().parse().unwrap_or_else(|_| text.into())
}

fn json_text(json: &Json) -> String {
    json.as_str().map_or_else(|| json.to_string(), str::to_owned)
}

fn json_numbers(json: &Json) -> Option<Vec<f64>> {
    match json {
        Json::Array(all) => all.iter().map(Json::as_f64).collect(),
        one => Some(vec![one.as_f64()?]),
    }
}

/// The numbers of an item: of a list, or a single one.
pub fn numbers(item: Option<&Item>) -> Option<Vec<f64>> {
    let one = |value: &toml_edit::Value| value.as_float().or(value.as_integer().map(|x| x as f64));
    match item?.as_value()? {
        toml_edit::Value::Array(all) => all.iter().map(one).collect(),
        value => Some(vec![one(value)?]),
    }
}
