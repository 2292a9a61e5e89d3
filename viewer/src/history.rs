//! Changes of a text that can be undone.

/// Bytes of a text that were replaced by others.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Change {
    /// Position of the first byte that differs.
    at: usize,
    removed: String,
    inserted: String,
}

impl Change {
    /// Returns the smallest change from one text to another.
    fn between(before: &str, after: &str) -> Self {
        let equal =
            |a: &str, b: &str| a.chars().zip(b.chars()).take_while(|(a, b)| a == b).map(|(c, _)| c.len_utf8()).sum();
        let at: usize = equal(before, after);
        let (before, after) = (&before[at..], &after[at..]);
        let ends = before.chars().rev().zip(after.chars().rev()).take_while(|(a, b)| a == b);
        let end: usize = ends.map(|(c, _)| c.len_utf8()).sum();
        Self { at, removed: before[..before.len() - end].into(), inserted: after[..after.len() - end].into() }
    }

    fn undo(&self, text: &mut String) {
        text.replace_range(self.at..self.at + self.inserted.len(), &self.removed);
    }

    fn redo(&self, text: &mut String) {
        text.replace_range(self.at..self.at + self.removed.len(), &self.inserted);
    }
}

/// Changes that are undone together, such as those of a drag.
#[derive(Clone, Debug)]
struct Group {
    label: String,
    changes: Vec<Change>,
}

/// The changes of a text, in groups with a label each.
#[derive(Clone, Debug, Default)]
pub struct History {
    done: Vec<Group>,
    undone: Vec<Group>,
    /// Whether a further change with the label of the last group joins it.
    is_open: bool,
}

impl History {
    /// Takes a change from one text to another. It joins the last group if that has the same label and is not sealed.
    /// Changes that were undone are forgotten.
    pub fn push(&mut self, label: &str, before: &str, after: &str) {
        let change = Change::between(before, after);
        self.undone.clear();
        match self.done.last_mut() {
            Some(last) if self.is_open && last.label == label => last.changes.push(change),
            _ => self.done.push(Group { label: label.into(), changes: vec![change] }),
        }
        self.is_open = true;
    }

    /// Ends the last group: the next change starts another.
    pub fn seal(&mut self) {
        self.is_open = false;
    }

    /// Undoes the last group in a text. Returns whether there was one.
    pub fn undo(&mut self, text: &mut String) -> bool {
        self.seal();
        let Some(group) = self.done.pop() else { return false };
        group.changes.iter().rev().for_each(|change| change.undo(text));
        self.undone.push(group);
        true
    }

    /// Repeats the last group that was undone. Returns whether there was one.
    pub fn redo(&mut self, text: &mut String) -> bool {
        self.seal();
        let Some(group) = self.undone.pop() else { return false };
        group.changes.iter().for_each(|change| change.redo(text));
        self.done.push(group);
        true
    }

    /// Returns the label of the group that [`History::undo`] would undo.
    pub fn next_undo(&self) -> Option<&str> {
        self.done.last().map(|group| group.label.as_str())
    }

    /// Returns the label of the group that [`History::redo`] would repeat.
    pub fn next_redo(&self) -> Option<&str> {
        self.undone.last().map(|group| group.label.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn undo_and_redo_restore_every_byte() {
        let texts = ["", "a = 1\n", "a = 2\n", "ä = 2\nb\n", "ö = 2\nb\n", "b", ""];
        let mut history = History::default();
        for pair in texts.windows(2) {
            history.push(pair[1], pair[0], pair[1]);
        }
        let mut text = String::new();
        for expected in texts.iter().rev().skip(1) {
            assert!(history.undo(&mut text));
            assert_eq!(text, *expected);
        }
        assert!(!history.undo(&mut text));
        for expected in &texts[1..] {
            assert!(history.redo(&mut text));
            assert_eq!(text, *expected);
        }
        assert!(!history.redo(&mut text));
    }

    #[test]
    fn a_drag_is_one_group() {
        let mut history = History::default();
        history.push("x", "1", "2");
        history.push("x", "2", "3");
        history.seal();
        history.push("x", "3", "4");
        history.push("y", "4", "5");
        let mut text = "5".to_string();
        let undone: Vec<String> = std::iter::from_fn(|| history.undo(&mut text).then(|| text.clone())).collect();
        assert_eq!(undone, ["4", "3", "1"]);
    }
}
