//! The scenes that effects are added to.

/// A phantom of bytes, seen from aside by one ray a pixel, with more tables.
macro_rules! specimen {
    ($tables:literal) => {
        concat!(
            r#"
drypoint = 1
[volume]
phantom = { name = "specimen", size = 96 }
[camera]
direction = [0.3, 1, -0.6]
[picture]
size = [256, 256]
samples = 1
"#,
            $tables
        )
    };
}

/// A regular function, unshaded, over a phantom of bytes. Nothing is opaque, so no ray ends early, and no effect changes
/// the number of samples by how it looks.
pub(super) const REGULAR: &str = specimen!(
    r#"[sampling]
stop_below = 0
[transfer]
kind = "regular"
nodes = [
  { at = 94, color = "firebrick", opacity = 0 }, { at = 110, color = "firebrick", opacity = 0.1 },
  { at = 150, color = "wheat", opacity = 0 }, { at = 200, color = "wheat", opacity = 0.3 },
]
"#
);

/// The same opacities with styles, plain transparency and no contours: the least that a style needs.
pub(super) const STYLE: &str = specimen!(
    r#"[sampling]
stop_below = 0
[transfer]
transparency = "plain"
nodes = [
  { at = 94, style = "vessel", opacity = 0 }, { at = 110, style = "vessel", opacity = 0.1 },
  { at = 150, style = "bone", opacity = 0 }, { at = 200, style = "bone", opacity = 0.3 },
]
"#
);

/// Dots alone, all factors 1.
pub(super) const STIPPLES: &str = specimen!(
    r#"[stipples]
size = "1.5 px"
threshold = 0.3
"#
);

/// Strokes alone, one in every cell of the surface.
pub(super) const STROKES: &str = specimen!(
    r#"[hatching]
iso = 120
seeds = "dense"
"#
);

/// Outlines alone.
pub(super) const OUTLINES: &str = specimen!(
    r#"[outlines]
iso = 120
min_length = "2 px"
"#
);

/// Rows of [`REGULAR`]'s nodes, all alike: what the second quantity measures changes the work and not the picture.
pub(super) const ROWS: &str = r#"[
  { at = -1e9, nodes = [
    { at = 94, color = "firebrick", opacity = 0 }, { at = 110, color = "firebrick", opacity = 0.1 },
    { at = 150, color = "wheat", opacity = 0 }, { at = 200, color = "wheat", opacity = 0.3 },
  ] },
  { at = 1e9, nodes = [
    { at = 94, color = "firebrick", opacity = 0 }, { at = 110, color = "firebrick", opacity = 0.1 },
    { at = 150, color = "wheat", opacity = 0 }, { at = 200, color = "wheat", opacity = 0.3 },
  ] },
]"#;

/// The same rows, for the labels 0 and 1.
pub(super) const LABEL_ROWS: &str = r#"[
  { at = 0, nodes = [
    { at = 94, color = "firebrick", opacity = 0 }, { at = 110, color = "firebrick", opacity = 0.1 },
    { at = 150, color = "wheat", opacity = 0 }, { at = 200, color = "wheat", opacity = 0.3 },
  ] },
  { at = 1, nodes = [
    { at = 94, color = "firebrick", opacity = 0 }, { at = 110, color = "firebrick", opacity = 0.1 },
    { at = 150, color = "wheat", opacity = 0 }, { at = 200, color = "wheat", opacity = 0.3 },
  ] },
]"#;
