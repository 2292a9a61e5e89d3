//! Scenes that are part of the program.

/// The scene that is rendered if none is given. It shows a phantom, so that no volume file is needed.
pub const DEFAULT_SCENE: &str = include_str!("../../../data/scenes/default.toml");
