//! The transfer function over the histogram: nodes are dragged, and each has a line with its style or colour.

use super::Panel;
use crate::camera::{number, rounded};
use crate::document::Edit;
use crate::gallery::Gallery;
use crate::key::KeyPath;
use crate::session::Session;
use crate::widgets::{color_button, hex, named, numbers};
use drypoint::scene::color::linear_to_srgb;
use drypoint::scene::tables::{Node, NodeColor, Transfer, TransferKind, Unit};
use eframe::egui::{self, Color32, DragValue, RichText, ScrollArea, Ui, Vec2b};
use egui_plot::{FilledArea, Line, Plot, PlotPoint, PlotPoints, Points};
use toml_edit::{Array, InlineTable, Item, Value};

/// Points of the window within which the pointer takes a node.
const REACH: f32 = 12.0;

/// The panel of the transfer function.
#[derive(Default)]
pub(super) struct FunctionsPanel {
    gallery: Gallery,
    /// The node that is dragged, or was last.
    selected: Option<usize>,
    is_dragged: bool,
}

impl Panel for FunctionsPanel {
    fn title(&self) -> &'static str {
        "Function"
    }

    fn ui(&mut self, ui: &mut Ui, session: &mut Session) {
        let Some(scene) = session.prepared.clone() else {
            ui.weak("The volume is being read.");
            return;
        };
        let Some(transfer) = &scene.transfer else {
            ui.label("The scene has no transfer function.");
            if ui.button("Add one").clicked() {
                session.edit("add a function", vec![Edit::set("transfer.kind", "style")]);
            }
            return;
        };
        let list = KeyPath::from("transfer.nodes");
        let Some(nodes) = transfer.nodes.as_ref().filter(|_| transfer.rows.is_none()) else {
            ui.label("This function is over two quantities. Its rows are edited among all keys.");
            return;
        };
        self.gallery.open(&scene.styles.theme);
        let given = session.document.get(&list).and_then(Item::as_array).map(Array::len);
        if given != Some(nodes.len()) {
            ui.label("The nodes were found in the data. Once they are written into the scene they can be moved.");
            if ui.button("Write the nodes into the scene").clicked() {
                let nodes: Array = nodes.iter().map(|node| written(node, transfer.kind)).collect();
                session.edit("write the nodes", vec![Edit::Set(list, Value::Array(nodes))]);
            }
        }
        self.plot(ui, session, transfer, nodes, given.is_some());
        if given == Some(nodes.len()) {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| self.lines(ui, session, transfer, nodes));
        }
    }
}

impl FunctionsPanel {
    /// Shows the function over the log histogram, and moves the node that is dragged.
    fn plot(&mut self, ui: &mut Ui, session: &mut Session, transfer: &Transfer, nodes: &[Node], moves: bool) {
        let (xs, heights) = histogram(session, transfer.unit);
        let ends = [xs.first(), xs.last()].map(|x| x.copied().unwrap_or_default());
        let of_nodes = || nodes.iter().map(|node| node.at);
        let left = of_nodes().fold(ends[0], f64::min);
        let right = of_nodes().fold(ends[1], f64::max);
        let pad = 0.03 * (right - left).max(1e-9);
        let colors: Vec<Color32> = nodes.iter().map(|node| self.color(ui.ctx(), node)).collect();
        let ink = ui.visuals().text_color();
        let plot = Plot::new("function")
            .height((ui.available_height() * 0.45).clamp(120.0, 260.0))
            .allow_drag(false)
            .allow_zoom(false)
            .allow_scroll(false)
            .allow_boxed_zoom(false)
            .allow_double_click_reset(false)
            .show_axes(Vec2b::new(true, false))
            .show_grid(false)
            .show_x(false)
            .show_y(false)
            .default_x_bounds(left - pad, right + pad)
            .default_y_bounds(-0.05, 1.08);
        let selected = self.selected;
        let shown = plot.show(ui, |plot| {
            plot.set_plot_bounds_x((left - pad)..=(right + pad));
            plot.set_plot_bounds_y(-0.05..=1.08);
            if !xs.is_empty() {
                let floor = vec![0.0; xs.len()];
                let area = FilledArea::new("histogram", &xs, &floor, &heights);
                plot.add(area.fill_color(ink.gamma_multiply(0.18)).allow_hover(false));
            }
            let points: PlotPoints<'_> = nodes.iter().map(|node| [node.at, node.opacity]).collect();
            plot.line(Line::new("opacity", points).color(ink.gamma_multiply(0.8)).width(1.5).allow_hover(false));
            for (i, (node, color)) in nodes.iter().zip(&colors).enumerate() {
                let radius = if selected == Some(i) { 7.0 } else { 5.0 };
                let at = [node.at, node.opacity];
                let ring = Points::new("node", vec![at]).color(ink).radius(radius + 1.5).allow_hover(false);
                plot.points(ring);
                plot.points(Points::new("node", vec![at]).color(*color).radius(radius).allow_hover(false));
            }
        });
        let response = shown.response.on_hover_text("Drag a node. Double-click to add one.");
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, "Transfer function"));
        let (transform, pointer) = (shown.transform, response.interact_pointer_pos());
        let Some(pointer) = pointer.filter(|_| moves) else {
            self.is_dragged &= response.dragged();
            return;
        };
        let place = |node: &Node| transform.position_from_point(&PlotPoint::new(node.at, node.opacity));
        let nearest = |at: egui::Pos2| {
            let reach = |(_, node): &(usize, &Node)| place(node).distance(at);
            let near = nodes.iter().enumerate().min_by(|a, b| reach(a).total_cmp(&reach(b)));
            near.filter(|found| reach(found) <= REACH).map(|(i, _)| i)
        };
        if response.double_clicked() && nearest(pointer).is_none() {
            self.add(session, transfer, nodes, transform.value_from_position(pointer));
        } else if response.drag_started() || response.clicked() {
            // A drag starts where the button was pressed.
            let from = ui.input(|input| input.pointer.press_origin()).unwrap_or(pointer);
            let found = nearest(from);
            self.selected = found.or(self.selected);
            self.is_dragged = found.is_some() && response.drag_started();
        }
        if let (true, true, Some(i)) = (self.is_dragged, response.dragged(), self.selected)
            && let Some(node) = nodes.get(i)
        {
            let to = transform.value_from_position(pointer);
            let before = i.checked_sub(1).map_or(f64::NEG_INFINITY, |before| nodes[before].at);
            let after = nodes.get(i + 1).map_or(f64::INFINITY, |after| after.at);
            let at = round_at(to.x.clamp(before, after.max(before)), right - left);
            let opacity = rounded(to.y.clamp(0.0, 1.0), 3);
            let key = KeyPath::from("transfer.nodes").item(i);
            if [at, opacity] != [node.at, node.opacity] {
                let edits = vec![
                    Edit::Set(key.name("at"), number(at.clamp(before, after.max(before)))),
                    Edit::Set(key.name("opacity"), number(opacity)),
                ];
                session.edit(&format!("move node {i}"), edits);
            }
        }
    }

    /// Adds a node at a point of the plot, with the look of the node before it.
    fn add(&mut self, session: &mut Session, transfer: &Transfer, nodes: &[Node], to: PlotPoint) {
        let index = nodes.iter().take_while(|node| node.at <= to.x).count();
        let like = nodes.get(index.saturating_sub(1));
        let Some(like) = like else { return };
        let span = nodes.iter().map(|node| node.at).fold(0.0, |most: f64, at| most.max((at - to.x).abs()));
        let node = Node { at: round_at(to.x, span), opacity: rounded(to.y.clamp(0.0, 1.0), 3), ..like.clone() };
        let list = KeyPath::from("transfer.nodes");
        session.edit("add a node", vec![Edit::Insert(list, index, table(&node, transfer.kind))]);
        self.selected = Some(index);
    }

    /// Shows a line for each node.
    fn lines(&mut self, ui: &mut Ui, session: &mut Session, transfer: &Transfer, nodes: &[Node]) {
        let list = KeyPath::from("transfer.nodes");
        let span = nodes.last().map_or(1.0, |last| last.at) - nodes.first().map_or(0.0, |first| first.at);
        egui::Grid::new("nodes").num_columns(5).striped(true).show(ui, |ui| {
            for title in ["", "value", "opacity", "look", ""] {
                ui.weak(title);
            }
            ui.end_row();
            for (i, node) in nodes.iter().enumerate() {
                let key = list.item(i);
                let is_selected = self.selected == Some(i);
                let title = RichText::new(format!("node {i}"));
                if ui.selectable_label(is_selected, title).clicked() {
                    self.selected = Some(i);
                }
                for (name, speed, range) in [("at", span / 500.0, f64::MIN..=f64::MAX), ("opacity", 0.005, 0.0..=1.0)] {
                    let key = key.name(name);
                    let Some(mut x) = numbers(session.document.get(&key)).and_then(|x| x.first().copied()) else {
                        ui.weak("1");
                        continue;
                    };
                    let drag = ui.add(DragValue::new(&mut x).speed(speed).range(range).max_decimals(4));
                    named(&drag, &format!("{name} of node {i}"));
                    if drag.changed() {
                        session.set(&key, number(rounded(x, 4)));
                    }
                }
                match &node.color {
                    NodeColor::Style(style) => {
                        ui.push_id(i, |ui| {
                            if let Some(picked) = self.gallery.button(ui, style) {
                                session.set(&key.name("style"), picked);
                            }
                        });
                    }
                    NodeColor::Color(_) => {
                        let text = session.document.get(&key.name("color")).and_then(Item::as_str).unwrap_or_default();
                        let text = text.to_owned();
                        match color_button(ui, &text) {
                            Some(color) => session.set(&key.name("color"), color),
                            None => drop(ui.weak(text)),
                        }
                    }
                }
                if ui
                    .add_enabled(nodes.len() > 1, egui::Button::new("×").small())
                    .on_hover_text("Remove the node")
                    .clicked()
                {
                    session.edit(&format!("remove {key}"), vec![Edit::Remove(key)]);
                }
                ui.end_row();
            }
        });
        ui.add_space(4.0);
        let end = nodes.last().map(|node| PlotPoint::new(node.at, node.opacity));
        if let (Some(end), true) = (end, ui.button("Add a node").clicked()) {
            self.add(session, transfer, nodes, end);
        }
    }

    /// The colour of a node in the plot: its own, or that of the middle of its style's sphere.
    fn color(&mut self, ctx: &egui::Context, node: &Node) -> Color32 {
        match &node.color {
            NodeColor::Style(name) => self.gallery.sphere(ctx, name).map_or(Color32::GRAY, |(_, color)| color),
            NodeColor::Color(linear) => {
                let [r, g, b] = linear.map(|c| (linear_to_srgb(c).clamp(0.0, 1.0) * 255.0).round() as u8);
                Color32::from_rgb(r, g, b)
            }
        }
    }
}

/// Places and heights of the log histogram in the unit of nodes. Heights are ln(1 + count), of which the largest is 1. A
/// histogram over percentiles is flat, and is not shown.
fn histogram(session: &Session, unit: Unit) -> (Vec<f64>, Vec<f64>) {
    let Some(data) = session.data().filter(|_| unit != Unit::Percentile) else { return Default::default() };
    let histogram = &data.histogram;
    let log = |count: u64| (1.0 + count as f64).ln();
    let most = histogram.bins.iter().map(|&count| log(count)).fold(1e-9, f64::max);
    let x = |value: f64| match unit {
        Unit::Normalized => (value - histogram.lo) / (histogram.hi - histogram.lo).max(f64::MIN_POSITIVE),
        _ => value,
    };
    let steps = histogram.bins.iter().enumerate().flat_map(|(i, &count)| {
        let height = log(count) / most;
        histogram.edges(i).map(|edge| (x(edge), height))
    });
    steps.unzip()
}

/// A value rounded to a thousandth of a span, or finer.
fn round_at(at: f64, span: f64) -> f64 {
    rounded(at, 3 - span.abs().max(1e-12).log10().floor() as i32)
}

/// A node as the scene writes it.
pub(super) fn table(node: &Node, kind: TransferKind) -> InlineTable {
    let look = match (&node.color, kind) {
        (NodeColor::Style(name), _) => ("style", Value::from(name.as_str())),
        (NodeColor::Color(linear), _) => {
            let [r, g, b] = linear.map(|c| (linear_to_srgb(c).clamp(0.0, 1.0) * 255.0).round() as u8);
            ("color", Value::from(hex(Color32::from_rgb(r, g, b))))
        }
    };
    InlineTable::from_iter([("at", number(node.at)), look, ("opacity", number(node.opacity))])
}

fn written(node: &Node, kind: TransferKind) -> Value {
    let mut value = Value::InlineTable(table(node, kind));
    value.decor_mut().set_prefix("\n  ");
    value
}
