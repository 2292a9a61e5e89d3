//! The transfer function over the histogram: nodes are dragged, and each has a line with its style or colour.
//!
//! A function over the value has its opacity upwards. A function over two quantities has the second one upwards, and each
//! row of nodes is a line across; where nodes are clear, so are their discs.

use super::Panel;
use super::nodes::{self, NodeHandle};
use crate::camera::{number, rounded};
use crate::document::Edit;
use crate::gallery::{DraggedStyle, Gallery};
use crate::key::KeyPath;
use crate::plane::{JointHistogram, PlaneCounter, PlaneQuery, counter};
use crate::session::Session;
use crate::widgets::{color_button, named, numbers};
use drypoint::scene::tables::{Axis, Node, NodeColor, Over, RowAt, Transfer, TransferKind, Unit};
use eframe::egui::{
    self, Color32, DragValue, Pos2, Response, RichText, ScrollArea, TextureHandle, TextureOptions, Ui, Vec2, Vec2b,
};
use egui_plot::{FilledArea, Line, Plot, PlotImage, PlotPoint, PlotPoints, PlotTransform, Points};
use std::sync::Arc;
use toml_edit::Item;

/// Points of the window within which the pointer takes a node.
const REACH: f32 = 12.0;

/// Second quantities that a function can be given here. All others are written among all keys.
const SECOND: [Axis; 5] = [Axis::GradientMagnitude, Axis::K1, Axis::K2, Axis::Mean, Axis::Gaussian];

/// The panel of the transfer function.
#[derive(Default)]
pub(super) struct FunctionsPanel {
    gallery: Gallery,
    /// The node that is dragged, or was last.
    selected: Option<KeyPath>,
    is_dragged: bool,
    plane: PlanePart,
}

/// The kinds of numbers of a function.
#[derive(Clone, Copy)]
enum NumberKind {
    /// A place along an axis with a span.
    Place(f64),
    /// The id of a label.
    Label,
    /// From 0 to 1.
    Share,
}

impl NumberKind {
    /// The kind of the places of an axis, of which some are known.
    fn of(axis: Option<&Axis>, places: impl Iterator<Item = f64>) -> Self {
        let [lo, hi] = places.fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], at| [lo.min(at), hi.max(at)]);
        match axis {
            Some(axis) if axis.is_id() => Self::Label,
            _ => Self::Place(if hi > lo { hi - lo } else { hi.abs().max(1.0) }),
        }
    }
}

/// The counts over two quantities.
#[derive(Default)]
struct PlanePart {
    /// The thread, once it was needed.
    counter: Option<PlaneCounter>,
    /// The last question.
    asked: Option<PlaneQuery>,
    /// Whether its answer is to come.
    is_asking: bool,
    /// Its answer, and the picture of it in a colour.
    counted: Option<(JointHistogram, Color32, TextureHandle)>,
    /// The second quantity that the function of a document is to have, once the counts are known.
    wished: Option<(u64, Axis)>,
}

impl Panel for FunctionsPanel {
    fn title(&self) -> &'static str {
        "Function"
    }

    fn is_busy(&self) -> bool {
        self.plane.is_asking
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
        self.gallery.open(&scene.styles.theme);
        // A wish ends with the document and the function that it was of.
        let can_lift = transfer.unit == Unit::Value && transfer.over == Over::Value;
        let is_open = |(of, _): &(u64, Axis)| can_lift && *of == session.document_number();
        self.plane.wished = self.plane.wished.take().filter(is_open);
        let over = match (&transfer.over, self.plane.wished.clone()) {
            (Over::Two(axes), _) => Some(axes.clone()),
            (Over::Value, Some((_, wished))) => Some([Axis::Value, wished]),
            (Over::Value, None) => None,
        };
        if let Some(over) = over.filter(|_| transfer.unit == Unit::Value) {
            self.plane.follow(ui, session, over);
        }
        self.plane.take_wish(session, transfer);
        let is_written = nodes::is_written(&session.document, transfer);
        if !is_written {
            ui.label("The nodes were found in the data, or form a grid. Write them one by one to move them.");
            if ui.button("Write the nodes into the scene").clicked() {
                session.edit("write the nodes", nodes::written(transfer));
            }
        }
        let handles = nodes::handles(transfer);
        let response = self.plot(ui, session, transfer, &handles, is_written);
        if transfer.kind == TransferKind::Style && is_written {
            self.styles(ui, session, &handles, response);
        }
        if is_written {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| self.lines(ui, session, transfer));
        }
    }
}

impl FunctionsPanel {
    /// Shows the function over the log histogram, and moves the node that is dragged. Returns the plot, and the node nearest
    /// to the pointer on it.
    fn plot(
        &mut self,
        ui: &mut Ui,
        session: &mut Session,
        transfer: &Transfer,
        handles: &[NodeHandle<'_>],
        moves: bool,
    ) -> (Response, Option<KeyPath>) {
        let counts = matches!(transfer.over, Over::Value).then(|| histogram(session, transfer.unit));
        let colors: Vec<Color32> = handles.iter().map(|handle| self.color(ui.ctx(), handle.node)).collect();
        let plane = self.plane.counted.as_ref().filter(|_| counts.is_none() && transfer.unit == Unit::Value);
        let bounds =
            nodes::bounds(handles, counts.as_ref().map(|(xs, _)| &xs[..]), plane.map(|(plane, ..)| plane.ends));
        let (ink, ground) = (ui.visuals().text_color(), ui.visuals().extreme_bg_color);
        let image = plane.map(|(plane, _, texture)| {
            let [x, y] = plane.ends;
            let size = Vec2::new((x[1] - x[0]) as f32, (y[1] - y[0]) as f32);
            (texture.id(), PlotPoint::new((x[0] + x[1]) / 2.0, (y[0] + y[1]) / 2.0), size)
        });
        let plot = Plot::new("function")
            .height((ui.available_height() * 0.45).clamp(120.0, 260.0))
            .allow_drag(false)
            .allow_zoom(false)
            .allow_scroll(false)
            .allow_boxed_zoom(false)
            .allow_double_click_reset(false)
            .show_axes(Vec2b::new(true, counts.is_none()))
            .show_grid(false)
            .show_x(false)
            .show_y(false)
            .default_x_bounds(bounds[0][0], bounds[0][1])
            .default_y_bounds(bounds[1][0], bounds[1][1]);
        let (selected, is_plane) = (self.selected.clone(), counts.is_none());
        let shown = plot.show(ui, |plot| {
            plot.set_plot_bounds_x(bounds[0][0]..=bounds[0][1]);
            plot.set_plot_bounds_y(bounds[1][0]..=bounds[1][1]);
            if let Some((xs, heights)) = counts.as_ref().filter(|(xs, _)| !xs.is_empty()) {
                let area = FilledArea::new("histogram", xs, &vec![0.0; xs.len()], heights);
                plot.add(area.fill_color(ink.gamma_multiply(0.18)).allow_hover(false));
            }
            if let Some((texture, middle, size)) = image {
                plot.image(PlotImage::new("counts", texture, middle, size).allow_hover(false));
            }
            for row in handles.chunk_by(|a, b| a.row == b.row) {
                let points: PlotPoints<'_> = row.iter().map(|handle| handle.at).collect();
                plot.line(Line::new("nodes", points).color(ink.gamma_multiply(0.8)).width(1.5).allow_hover(false));
            }
            for (handle, color) in handles.iter().zip(&colors) {
                let radius = if selected.as_ref() == Some(&handle.key) { 7.0 } else { 5.0 };
                let at = vec![handle.at];
                let ring = Points::new("node", at.clone()).color(ink).radius(radius + 1.5).allow_hover(false);
                plot.points(ring);
                // In a plane the opacity is seen in the disc alone.
                let paper = if is_plane { 1.0 - handle.node.opacity as f32 } else { 0.0 };
                let color = color.lerp_to_gamma(ground, paper);
                plot.points(Points::new("node", at).color(color).radius(radius).allow_hover(false));
            }
        });
        let response = shown.response.on_hover_text("Drag a node. Double-click to add one.");
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, "Transfer function"));
        for handle in handles {
            // A name for screen readers.
            let at = shown.transform.position_from_point(&PlotPoint::new(handle.at[0], handle.at[1]));
            let disc = egui::Rect::from_center_size(at, Vec2::splat(12.0));
            let name = ui.interact(disc, ui.scope_id().with(handle.key.to_string()), egui::Sense::hover());
            name.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, handle.key.to_string()));
        }
        let nearest = |at: Pos2, reach: f32| nearest(&shown.transform, handles, selected.as_ref(), at, reach);
        let over = response.contains_pointer().then(|| ui.ctx().pointer_interact_pos()).flatten();
        let hovered = over.and_then(|at| nearest(at, f32::INFINITY)).map(|i| handles[i].key.clone());
        let Some(pointer) = response.interact_pointer_pos().filter(|_| moves) else {
            self.is_dragged &= response.dragged();
            return (response, hovered);
        };
        let to = shown.transform.value_from_position(pointer);
        if response.double_clicked() && nearest(pointer, REACH).is_none() {
            self.add(session, transfer, [to.x, to.y]);
        } else if response.drag_started() || response.clicked() {
            // A drag starts where the button was pressed.
            let from = ui.input(|input| input.pointer.press_origin()).unwrap_or(pointer);
            let found = nearest(from, REACH).map(|i| handles[i].key.clone());
            self.is_dragged = found.is_some() && response.drag_started();
            self.selected = found.or(self.selected.take());
        }
        let dragged = handles.iter().find(|handle| self.selected.as_ref() == Some(&handle.key));
        if let (true, true, Some(handle)) = (self.is_dragged, response.dragged(), dragged) {
            let edits = handle.moved([to.x, to.y], bounds.map(|[lo, hi]| hi - lo));
            if !edits.is_empty() {
                session.edit(&format!("move {}", handle.key), edits);
            }
        }
        (response, hovered)
    }

    /// Shows the spheres of the styles. A click gives one to the node that is selected; a drag to a node of the plot.
    fn styles(
        &mut self,
        ui: &mut Ui,
        session: &mut Session,
        handles: &[NodeHandle<'_>],
        (plot, hovered): (Response, Option<KeyPath>),
    ) {
        if plot.dnd_hover_payload::<DraggedStyle>().is_some() {
            self.selected = hovered.clone().or(self.selected.take());
        }
        if let Some((style, key)) = plot.dnd_release_payload::<DraggedStyle>().zip(hovered) {
            session.set(&key.name("style"), style.0.clone());
        }
        let selected = handles.iter().find(|handle| self.selected.as_ref() == Some(&handle.key));
        let chosen = selected.and_then(|handle| handle.node.style()).unwrap_or_default();
        let clicked = self.gallery.strip(ui, chosen);
        match (clicked, selected) {
            (Some(style), Some(handle)) => session.set(&handle.key.name("style"), style),
            (Some(_), None) => session.notice = "Drag the style to a node, or select a node first".into(),
            (None, _) => {}
        }
    }

    /// Adds a node at a point of the plot, with the look of the node before it.
    fn add(&mut self, session: &mut Session, transfer: &Transfer, to: [f64; 2]) {
        if let Some((list, index, node)) = nodes::added(transfer, to) {
            self.selected = Some(list.item(index));
            session.edit("add a node", vec![Edit::Insert(list, index, nodes::table(&node, transfer.kind))]);
        }
    }

    /// Shows a line for each node, under its row if there are rows.
    fn lines(&mut self, ui: &mut Ui, session: &mut Session, transfer: &Transfer) {
        let places = transfer.all_nodes().map(|node| node.at);
        let across = NumberKind::of(transfer.over.axes().first(), places);
        match (&transfer.nodes, &transfer.rows, &transfer.over) {
            (_, Some(rows), Over::Two([first, second])) => {
                ui.horizontal(|ui| {
                    ui.weak(format!("{} across, {} upwards", first.name(), second.name()));
                    if *first == Axis::Value && ui.small_button("Over the value alone").clicked() {
                        session.edit("a function over the value", nodes::flattened(transfer));
                    }
                });
                let list = KeyPath::from("transfer.rows");
                let places = rows.iter().filter_map(|row| if let RowAt::Number(at) = row.at { Some(at) } else { None });
                let up = NumberKind::of(Some(second), places);
                for (i, row) in rows.iter().enumerate() {
                    let key = list.item(i);
                    ui.horizontal(|ui| {
                        ui.strong(format!("row {i}"));
                        match row.at {
                            RowAt::Number(_) => {
                                self.number(ui, session, &key.name("at"), &format!("at of row {i}"), up)
                            }
                            _ => drop(ui.weak("of a label")),
                        }
                        let remove = ui.add_enabled(rows.len() > 1, egui::Button::new("×").small());
                        if remove.on_hover_text("Remove the row").clicked() {
                            session.edit(&format!("remove {key}"), vec![Edit::Remove(key.clone())]);
                        }
                    });
                    self.grid(ui, session, &key.name("nodes"), &row.nodes, across);
                }
                if ui.button("Add a row").clicked() {
                    session.edit("add a row", nodes::row_added(transfer));
                }
            }
            (Some(line), ..) => {
                self.grid(ui, session, &"transfer.nodes".into(), line, across);
                ui.add_space(4.0);
                ui.horizontal(|ui| {
                    let end = line.last().map(|node| [node.at, node.opacity]);
                    if let (Some(end), true) = (end, ui.button("Add a node").clicked()) {
                        self.add(session, transfer, end);
                    }
                    ui.add_enabled_ui(transfer.unit == Unit::Value, |ui| {
                        ui.menu_button("Over a second quantity", |ui| {
                            for axis in SECOND {
                                if ui.button(axis.name()).clicked() {
                                    self.plane.wished = Some((session.document_number(), axis));
                                    ui.close();
                                }
                            }
                        });
                    });
                });
            }
            _ => {}
        }
    }

    /// Shows the nodes of a list.
    fn grid(&mut self, ui: &mut Ui, session: &mut Session, list: &KeyPath, line: &[Node], across: NumberKind) {
        egui::Grid::new(list.to_string()).num_columns(5).striped(true).show(ui, |ui| {
            for title in ["", "value", "opacity", "look", ""] {
                ui.weak(title);
            }
            ui.end_row();
            for (i, node) in line.iter().enumerate() {
                let key = list.item(i);
                let is_selected = self.selected.as_ref() == Some(&key);
                if ui.selectable_label(is_selected, RichText::new(format!("node {i}"))).clicked() {
                    self.selected = Some(key.clone());
                }
                self.number(ui, session, &key.name("at"), &format!("at of node {i}"), across);
                self.number(ui, session, &key.name("opacity"), &format!("opacity of node {i}"), NumberKind::Share);
                match &node.color {
                    NodeColor::Style(style) => {
                        let button = match self.gallery.image(ui, style, 18.0) {
                            Some(sphere) => egui::Button::image_and_text(sphere, style),
                            None => egui::Button::new(style),
                        };
                        let response = ui.add(button).on_hover_text("Drag a style here.");
                        if let Some(style) = response.dnd_release_payload::<DraggedStyle>() {
                            session.set(&key.name("style"), style.0.clone());
                        }
                        if response.clicked() {
                            self.selected = Some(key.clone());
                        }
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
                let remove = ui.add_enabled(line.len() > 1, egui::Button::new("×").small());
                if remove.on_hover_text("Remove the node").clicked() {
                    session.edit(&format!("remove {key}"), vec![Edit::Remove(key)]);
                }
                ui.end_row();
            }
        });
    }

    /// Shows the number of a key.
    fn number(&self, ui: &mut Ui, session: &mut Session, key: &KeyPath, name: &str, kind: NumberKind) {
        let Some(mut x) = numbers(session.document.get(key)).and_then(|x| x.first().copied()) else {
            drop(ui.weak("1"));
            return;
        };
        let drag = DragValue::new(&mut x);
        let drag = ui.add(match kind {
            NumberKind::Place(span) => drag.speed(span / 500.0),
            NumberKind::Label => drag.speed(0.1).range(0.0..=f64::from(u32::MAX)).fixed_decimals(0),
            NumberKind::Share => drag.speed(0.005).range(0.0..=1.0).max_decimals(4),
        });
        named(&drag, name);
        if drag.changed() {
            let x = match kind {
                NumberKind::Place(span) => nodes::round_at(x, span),
                NumberKind::Label => x.round(),
                NumberKind::Share => rounded(x, 4),
            };
            session.set(key, number(x));
        }
    }

    /// The colour of a node in the plot: its own, or that of the middle of its style's sphere.
    fn color(&mut self, ctx: &egui::Context, node: &Node) -> Color32 {
        match &node.color {
            NodeColor::Style(name) => self.gallery.sphere(ctx, name).map_or(Color32::GRAY, |(_, color)| color),
            NodeColor::Color(linear) => nodes::displayed(*linear),
        }
    }
}

impl PlanePart {
    /// Asks for the counts over two quantities if they are not those that are known, and takes the answer.
    fn follow(&mut self, ui: &Ui, session: &mut Session, over: [Axis; 2]) {
        let (Some(scene), Some(data)) = (session.scene.clone(), session.data()) else {
            self.counted = None;
            return;
        };
        let query = PlaneQuery { scene, volume: Arc::clone(&data.volume), over };
        let counter = self.counter.get_or_insert_with(|| {
            let ctx = ui.ctx().clone();
            counter(Box::new(move || ctx.request_repaint()))
        });
        if self.asked.as_ref().is_none_or(|asked| !asked.is_same(&query)) {
            (self.counted, self.is_asking) = (None, true);
            counter.ask(query.clone());
            self.asked = Some(query);
        }
        let ink = ui.visuals().text_color();
        let picture = |plane: &JointHistogram| {
            ui.ctx().load_texture("counts over two quantities", plane.picture(ink), TextureOptions::LINEAR)
        };
        let is_last = |query: &PlaneQuery| self.asked.as_ref().is_some_and(|asked| asked.is_same(query));
        if let Some((_, counted)) = counter.answers().filter(|(query, _)| is_last(query)).last() {
            self.is_asking = false;
            self.counted = counted.map(|plane| (plane.clone(), ink, picture(&plane)));
            if self.counted.is_none() && self.wished.take().is_some() {
                session.notice = "There is no memory for this quantity".into();
            }
        }
        // The window was made dark or light.
        if let Some((plane, color, texture)) = self.counted.as_mut().filter(|(_, color, _)| *color != ink) {
            (*color, *texture) = (ink, picture(plane));
        }
    }

    /// Gives a function over the value its second quantity, once the counts are known.
    fn take_wish(&mut self, session: &mut Session, transfer: &Transfer) {
        let is_of = |(_, wished): &mut (u64, Axis)| self.asked.as_ref().is_some_and(|asked| asked.over[1] == *wished);
        if let Some((plane, ..)) = &self.counted
            && let Some((_, wished)) = self.wished.take_if(is_of)
        {
            session.edit("a function over two quantities", nodes::lifted(transfer, &wished, plane.ends[1]));
        }
    }
}

/// Returns the node nearest to a place in the window within a reach. Of nodes at one place it is the selected one.
fn nearest(
    transform: &PlotTransform,
    handles: &[NodeHandle<'_>],
    selected: Option<&KeyPath>,
    at: Pos2,
    reach: f32,
) -> Option<usize> {
    let place = |handle: &NodeHandle<'_>| transform.position_from_point(&PlotPoint::new(handle.at[0], handle.at[1]));
    let far = handles.iter().map(|handle| (place(handle).distance(at), selected != Some(&handle.key))).enumerate();
    let nearest = far.min_by(|(_, a), (_, b)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    nearest.filter(|(_, (far, _))| *far <= reach).map(|(i, _)| i)
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
