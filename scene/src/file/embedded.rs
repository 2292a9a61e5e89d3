//! Scenes that are part of the program.

/// The scene that is rendered where none is given: a phantom, so that no volume need be at hand.
pub const DEFAULT_SCENE: &str = include_str!("../../../data/scenes/default.toml");
