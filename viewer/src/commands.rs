//! The commands of the window: one list, which the menus, the keyboard and the palette share.

use crate::camera::Side;
use eframe::egui::{Key, KeyboardShortcut, Modifiers};

/// The work of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Opens a scene or a volume.
    Open,
    /// Opens the example scene.
    Example,
    /// Writes the scene to its file.
    Save,
    /// Writes the scene to another file.
    SaveAs,
    /// Renders the picture with the reference into a file.
    Export,
    /// Focuses the halos on the cross-hair.
    FocusHalos,
    /// Turns the brush on and off.
    Paint,
    /// Removes the cross-hair.
    RemoveCross,
    /// Copies the picture that is shown.
    Copy,
    /// Closes the window.
    Quit,
    /// Undoes the last change.
    Undo,
    /// Repeats the last change that was undone.
    Redo,
    /// Shows the volume from a side.
    Look(Side),
    /// Shows the whole volume.
    Whole,
    /// Turns the camera by steps to the right and up.
    Turn(i8, i8),
    /// Moves the camera towards the focus, or away from it.
    Dolly(i8),
    /// Changes between perspective and parallel rays.
    Projection,
    /// Changes between dark and light.
    Theme,
    /// Makes text and controls larger or smaller.
    Scale(i8),
    /// Shows all commands.
    Palette,
    /// Puts all panels back to their places.
    Panels,
}

/// A command.
#[derive(Clone, Copy, Debug)]
pub struct Command {
    /// The menu that has it.
    pub menu: &'static str,
    /// Its name.
    pub name: &'static str,
    /// Its keys, if it has some.
    pub keys: Option<KeyboardShortcut>,
    /// Its work.
    pub action: Action,
}

/// The menus, in their order.
pub const MENUS: [&str; 3] = ["File", "Edit", "View"];

const fn command(menu: &'static str, name: &'static str, keys: Option<(Modifiers, Key)>, action: Action) -> Command {
    let keys = match keys {
        Some((modifiers, key)) => Some(KeyboardShortcut::new(modifiers, key)),
        None => None,
    };
    Command { menu, name, keys, action }
}

const CTRL: Modifiers = Modifiers::COMMAND;
const SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);
const NONE: Modifiers = Modifiers::NONE;

/// All commands. Where keys of one are those of another with a modifier more, it stands before the other.
pub const COMMANDS: &[Command] = &[
    command("File", "Open…", Some((CTRL, Key::O)), Action::Open),
    command("File", "Open the example", None, Action::Example),
    command("File", "Save as…", Some((SHIFT, Key::S)), Action::SaveAs),
    command("File", "Save", Some((CTRL, Key::S)), Action::Save),
    command("File", "Export the picture…", Some((CTRL, Key::E)), Action::Export),
    command("File", "Quit", Some((CTRL, Key::Q)), Action::Quit),
    command("Edit", "Redo", Some((SHIFT, Key::Z)), Action::Redo),
    command("Edit", "Undo", Some((CTRL, Key::Z)), Action::Undo),
    command("Edit", "Copy the picture", Some((SHIFT, Key::C)), Action::Copy),
    command("Edit", "Focus halos at the cross-hair", Some((CTRL, Key::H)), Action::FocusHalos),
    command("Edit", "Paint on or off", Some((NONE, Key::B)), Action::Paint),
    command("View", "All commands…", Some((CTRL, Key::P)), Action::Palette),
    command("View", "From the front", Some((NONE, Key::Num1)), Action::Look(Side::Front)),
    command("View", "From the back", Some((NONE, Key::Num2)), Action::Look(Side::Back)),
    command("View", "From the left", Some((NONE, Key::Num3)), Action::Look(Side::Left)),
    command("View", "From the right", Some((NONE, Key::Num4)), Action::Look(Side::Right)),
    command("View", "From above", Some((NONE, Key::Num5)), Action::Look(Side::Top)),
    command("View", "From below", Some((NONE, Key::Num6)), Action::Look(Side::Bottom)),
    command("View", "Whole volume", Some((NONE, Key::Home)), Action::Whole),
    command("View", "Perspective or parallel", Some((NONE, Key::Num7)), Action::Projection),
    command("View", "Turn left", Some((NONE, Key::ArrowLeft)), Action::Turn(-1, 0)),
    command("View", "Turn right", Some((NONE, Key::ArrowRight)), Action::Turn(1, 0)),
    command("View", "Turn up", Some((NONE, Key::ArrowUp)), Action::Turn(0, 1)),
    command("View", "Turn down", Some((NONE, Key::ArrowDown)), Action::Turn(0, -1)),
    command("View", "Nearer", Some((NONE, Key::PageUp)), Action::Dolly(-1)),
    command("View", "Further", Some((NONE, Key::PageDown)), Action::Dolly(1)),
    command("View", "Remove the cross-hair", Some((NONE, Key::Delete)), Action::RemoveCross),
    command("View", "Dark or light", Some((CTRL, Key::T)), Action::Theme),
    command("View", "Larger text", Some((CTRL, Key::Plus)), Action::Scale(1)),
    command("View", "Smaller text", Some((CTRL, Key::Minus)), Action::Scale(-1)),
    command("View", "Panels as at first", None, Action::Panels),
];

/// Returns the commands that a text asks for: each of its words is in the name. Of equals the order stays.
pub fn matching(text: &str) -> impl Iterator<Item = &'static Command> {
    let words: Vec<String> = text.split_whitespace().map(str::to_lowercase).collect();
    COMMANDS.iter().filter(move |command| {
        let name = format!("{} {}", command.menu, command.name).to_lowercase();
        words.iter().all(|word| name.contains(word))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_unique_and_the_longer_ones_come_first() {
        for (i, command) in COMMANDS.iter().enumerate() {
            assert!(MENUS.contains(&command.menu));
            let Some(keys) = command.keys else { continue };
            for before in COMMANDS[..i].iter().filter_map(|before| before.keys) {
                let hides = before.logical_key == keys.logical_key && keys.modifiers.contains(before.modifiers);
                assert!(!hides, "{} can never be called", command.name);
            }
        }
    }

    #[test]
    fn words_find_commands() {
        let names = |text: &str| matching(text).map(|command| command.name).collect::<Vec<_>>();
        assert_eq!(names("save"), ["Save as…", "Save"]);
        assert_eq!(names("FRONT view"), ["From the front"]);
        assert_eq!(names("").len(), COMMANDS.len());
    }
}
