//! Paths of keys in a scene file.

use std::fmt;

/// One step of a [`KeyPath`].
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum KeyStep {
    /// A name in a table.
    Name(String),
    /// The index of an item in a list, from 0.
    Item(usize),
}

/// The place of a value in a scene file, such as `transfer.nodes[2].opacity`.
///
/// ```
/// use drypoint_viewer::key::KeyPath;
/// let key = KeyPath::from("transfer.nodes").item(2).name("opacity");
/// assert_eq!(key, "transfer.nodes[2].opacity".into());
/// assert_eq!(key.to_string(), "transfer.nodes[2].opacity");
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct KeyPath(Vec<KeyStep>);

impl KeyPath {
    /// Returns the key of a name in the table at this path.
    pub fn name(&self, name: &str) -> Self {
        self.then(KeyStep::Name(name.into()))
    }

    /// Returns the key of an item of the list at this path.
    pub fn item(&self, index: usize) -> Self {
        self.then(KeyStep::Item(index))
    }

    fn then(&self, step: KeyStep) -> Self {
        Self(self.0.iter().cloned().chain([step]).collect())
    }

    /// Returns the steps from the root of the document.
    pub fn steps(&self) -> &[KeyStep] {
        &self.0
    }

    /// Returns the name of the last step that is one, or nothing for the root.
    pub fn last_name(&self) -> &str {
        let name = |step: &'_ KeyStep| matches!(step, KeyStep::Name(_));
        match self.0.iter().rfind(|step| name(step)) {
            Some(KeyStep::Name(name)) => name,
            _ => "",
        }
    }
}

impl From<&str> for KeyPath {
    /// Reads names with points between them, and indices in brackets. Names with other characters are added by
    /// [`KeyPath::name`].
    fn from(text: &str) -> Self {
        let mut path = Self::default();
        for part in text.split(['.', '[']).map(|part| part.trim_end_matches(']')).filter(|part| !part.is_empty()) {
            path.0.push(part.parse().map_or_else(|_| KeyStep::Name(part.into()), KeyStep::Item));
        }
        path
    }
}

impl fmt::Display for KeyPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, step) in self.0.iter().enumerate() {
            match step {
                KeyStep::Name(name) if i == 0 => write!(f, "{name}")?,
                KeyStep::Name(name) => write!(f, ".{name}")?,
                KeyStep::Item(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}
