//! The palette of all commands: words are typed, and Enter runs the first command that has them. A path opens its file.

use crate::commands::{Action, matching};
use eframe::egui::{self, Align2, Context, Key, TextEdit};
use std::path::PathBuf;

/// Commands that are shown at most.
const MOST: usize = 12;

/// The palette, while it is open.
#[derive(Debug, Default)]
pub(crate) struct Palette {
    text: Option<String>,
}

impl Palette {
    /// Opens the palette.
    pub(crate) fn open(&mut self) {
        self.text = Some(String::new());
    }

    /// Shows the palette if it is open. Returns the command that was chosen. `open` takes the path that was.
    pub(crate) fn ui(&mut self, ctx: &Context, open: &mut dyn FnMut(PathBuf)) -> Option<Action> {
        let text = self.text.as_mut()?;
        let mut chosen = None;
        let mut is_done = ctx.input(|input| input.key_pressed(Key::Escape));
        let enters = ctx.input(|input| input.key_pressed(Key::Enter));
        let window = egui::Window::new("Commands").title_bar(false).resizable(false);
        window.anchor(Align2::CENTER_TOP, [0.0, 60.0]).default_width(360.0).show(ctx, |ui| {
            let hint = "A command, or the path of a scene or a volume";
            let field = ui.add(TextEdit::singleline(text).hint_text(hint).desired_width(f32::INFINITY));
            field.request_focus();
            let path = Some(PathBuf::from(text.trim())).filter(|path| path.is_file());
            if let Some(path) = path {
                if ui.button(format!("Open {}", path.display())).clicked() || enters {
                    open(path);
                    is_done = true;
                }
                return;
            }
            for (i, command) in matching(text).take(MOST).enumerate() {
                let keys = command.keys.map(|keys| ctx.format_shortcut(&keys)).unwrap_or_default();
                let button = egui::Button::new(command.name).shortcut_text(keys).selected(i == 0).frame(i == 0);
                if ui.add_sized([ui.available_width(), 20.0], button).clicked() || i == 0 && enters {
                    chosen = Some(command.action);
                }
            }
        });
        if is_done || chosen.is_some() {
            self.text = None;
        }
        chosen
    }
}
