//! The card against the reference: verdict, largest difference, bound, stages, and a picture of the difference.

use super::Panel;
use crate::compare::{Comparing, Comparison, reduced};
use crate::session::Session;
use drypoint::Failures;
use drypoint::validate::{Validation, Verdict};
use eframe::egui::{self, DragValue, Image, RichText, ScrollArea, TextureHandle, TextureOptions, Ui, Vec2};

/// Most pixels of the longer side at first.
const LONGEST: usize = 64;

/// The panel of comparisons.
pub(super) struct ComparePanel {
    longest: usize,
    /// The comparison that runs, and the serial number of its scene.
    running: Option<(u64, Comparing)>,
    /// The last outcome, with the serial number of its scene.
    last: Option<(u64, Result<ShownComparison, Failures>)>,
}

struct ShownComparison {
    found: Validation,
    difference: TextureHandle,
    largest_flip: f64,
}

impl Default for ComparePanel {
    fn default() -> Self {
        Self { longest: LONGEST, running: None, last: None }
    }
}

impl Panel for ComparePanel {
    fn title(&self) -> &'static str {
        "Compare"
    }

    fn ui(&mut self, ui: &mut Ui, session: &mut Session) {
        self.follow(ui);
        ui.label(
            "The card against the reference, stage by stage and within derived bounds, as drypoint validate does.",
        );
        let Some(card) = session.card.clone() else {
            ui.weak("There is no card that draws scenes.");
            return;
        };
        if card.is_software() {
            ui.weak("Software stands for the card, so it takes minutes for large volumes.");
        }
        ui.horizontal(|ui| {
            let label = ui.label("longer side in pixels").id;
            ui.add(DragValue::new(&mut self.longest).range(16..=1024)).labelled_by(label);
            let can_start = self.running.is_none() && session.scene.is_some();
            if ui.add_enabled(can_start, egui::Button::new("Compare now")).clicked()
                && let (Some(scene), Some(data)) = (&session.scene, session.data())
            {
                let scene = reduced(scene, self.longest);
                let ctx = ui.ctx().clone();
                let wake = Box::new(move || ctx.request_repaint());
                self.running = Some((session.serial(), Comparing::start(scene, data.volume.clone(), card, wake)));
            }
            if self.running.is_some() {
                ui.spinner();
                if ui.button("Cancel").clicked() {
                    self.running = None;
                }
            }
        });
        match &self.last {
            None => {}
            Some((_, Err(failures))) => {
                for failure in failures.iter().take(3) {
                    ui.label(RichText::new(&failure.what).color(ui.visuals().error_fg_color));
                    ui.label(&failure.remedy);
                }
            }
            Some((serial, Ok(shown))) => {
                if *serial != session.serial() {
                    ui.weak("The scene has changed since.");
                }
                ScrollArea::vertical().auto_shrink(false).show(ui, |ui| figures(ui, shown));
            }
        }
    }
}

impl ComparePanel {
    /// Takes the end of a comparison.
    fn follow(&mut self, ui: &Ui) {
        let end = self.running.as_ref().and_then(|(serial, running)| Some((*serial, running.end()?)));
        if let Some((serial, end)) = end {
            self.running = None;
            let shown = end.map(|Comparison { found, difference, largest_flip }| ShownComparison {
                found,
                largest_flip,
                difference: ui.ctx().load_texture("difference", difference, TextureOptions::NEAREST),
            });
            self.last = Some((serial, shown));
        }
    }
}

/// Shows the figures of a comparison.
fn figures(ui: &mut Ui, ShownComparison { found, difference, largest_flip }: &ShownComparison) {
    let verdict = found.verdict();
    let color = match verdict {
        Verdict::Kept => ui.visuals().text_color(),
        Verdict::Failed => ui.visuals().error_fg_color,
        Verdict::NotProven => ui.visuals().warn_fg_color,
    };
    ui.label(RichText::new(format!("Bounds: {verdict}")).color(color).strong());
    match found.parts_at {
        Some(stage) => drop(ui.label(format!("The {stage} is the first stage that parts in f64."))),
        None if found.has_double() => drop(ui.label("No stage parts in f64.")),
        None => drop(ui.label("The card has no f64.")),
    }
    ui.weak(&found.adapter);
    found.unbounded.iter().for_each(|why| drop(ui.label(why)));
    egui::Grid::new("figures").num_columns(2).striped(true).show(ui, |ui| {
        let mut row = |name: &str, number: String| {
            ui.label(name);
            ui.label(number);
            ui.end_row();
        };
        if let Some(bounded) = &found.bounded {
            row("largest difference", format!("{:.1e}", bounded.measured));
            row("largest bound", format!("{:.1e}", bounded.bound));
            row("largest share of a pixel's bound", format!("{:.3}", bounded.share));
            row("pixels over their bound", bounded.exceeded.to_string());
            row("pixels at a decision", format!("{:.2} %", bounded.undecided * 100.0));
        }
        row("mean of FLIP", format!("{:.1e}", found.flip));
    });
    ui.add_space(6.0);
    egui::Grid::new("stages").num_columns(4).striped(true).show(ui, |ui| {
        for title in ["stage", "f64 differs", "f32 differs", "of bound"] {
            ui.weak(title);
        }
        ui.end_row();
        for stage in &found.stages {
            let or_none = |number: Option<String>| number.unwrap_or_else(|| "—".into());
            ui.label(stage.name).on_hover_text(&stage.layer);
            ui.label(or_none(stage.double.map(|double| format!("{double:.1e}"))));
            ui.label(format!("{:.1e}", stage.single));
            ui.label(or_none(stage.share.map(|share| format!("{share:.3}"))));
            ui.end_row();
        }
    });
    ui.add_space(6.0);
    ui.label(format!("The difference (FLIP): black for none, pale for {largest_flip:.1e}"));
    let [width, height] = difference.size().map(|n| n as f32);
    let scale = (ui.available_width() / width).min(8.0);
    let picture = Image::new((difference.id(), Vec2::new(width, height) * scale));
    ui.add(picture.alt_text("Picture of the difference"));
}
