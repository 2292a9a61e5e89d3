//! The palette of all commands: words are typed, and Enter runs the first command that has them. A path
//! opens its file, or names that of a new scene or picture.

use crate::commands::{Action, matching};
use crate::dialogs::Wish;
use drypoint::Format;
use eframe::egui::{self, Align2, Context, Key, TextEdit};
use std::path::{Path, PathBuf};

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

    /// Shows the palette if it is open. Returns the command that was chosen. `take` gets the path that was, and
    /// what it is for.
    pub(crate) fn ui(&mut self, ctx: &Context, take: &mut dyn FnMut(Wish, PathBuf)) -> Option<Action> {
        let text = self.text.as_mut()?;
        let mut chosen = None;
        let mut is_done = ctx.input(|input| input.key_pressed(Key::Escape));
        let enters = ctx.input(|input| input.key_pressed(Key::Enter));
        let window = egui::Window::new("Commands").title_bar(false).resizable(false);
        window.anchor(Align2::CENTER_TOP, [0.0, 60.0]).default_width(360.0).show(ctx, |ui| {
            let hint = "A command, or the path of a file to open, save or export";
            let field = ui.add(TextEdit::singleline(text).hint_text(hint).desired_width(f32::INFINITY));
            field.request_focus();
            let path = PathBuf::from(text.trim());
            if let Some((verb, wish)) = wish(&path) {
                if ui.button(format!("{verb} {}", path.display())).clicked() || enters {
                    take(wish, path);
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

/// Returns what a path may be for: a scene or a volume is opened, another scene saved, and a picture exported.
fn wish(path: &Path) -> Option<(&'static str, Wish)> {
    let is_scene = path.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("toml"));
    let has_folder = path.parent().is_some_and(|folder| folder.as_os_str().is_empty() || folder.is_dir());
    match Format::of(path) {
        Some(_) if has_folder => Some(("Export to", Wish::Export)),
        _ if path.is_file() => Some(("Open", Wish::Open)),
        _ if is_scene && has_folder => Some(("Save as", Wish::SaveAs)),
        _ => None,
    }
}
