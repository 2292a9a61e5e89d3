//! The size of a figure's page and of its columns.

use crate::Failure;
use drypoint_output::paint::MOST_PIXELS;
use drypoint_reference::figure::PanelGrid;
use drypoint_scene::marks::Page;
use drypoint_scene::tables::{Figure, FigureSettings, Length, PageSettings};

/// The least width of a column, in pixels.
const LEAST_COLUMN: usize = 16;

/// Checks that a page with so many pixels can be drawn.
///
/// # Errors
/// More pixels than a picture may have.
pub(super) fn check_pixels(figure: &Figure, pixels: f64) -> Result<(), Failure> {
    if pixels <= MOST_PIXELS as f64 {
        return Ok(());
    }
    let key = key_of_large(figure);
    let what = format!("the page has {:.1e} pixels, and a picture has at most {MOST_PIXELS}", pixels.min(f64::MAX));
    Err(Failure::new(what, figure.given.position(key), format!("make {key} smaller")))
}

/// Checks that columns are wide enough.
///
/// # Errors
/// Columns of fewer than 16 pixels.
pub(super) fn check_columns(figure: &Figure, grid: &PanelGrid) -> Result<(), Failure> {
    if grid.has_columns_of(LEAST_COLUMN) {
        return Ok(());
    }
    let is_given = |key| figure.given.place(key).is_some();
    let would_fit = PanelGrid { gap: 0, ..*grid }.has_columns_of(LEAST_COLUMN);
    let (key, remedy) = if would_fit && is_given("figure.gap") {
        ("figure.gap", "make the gap smaller")
    } else if grid.width >= LEAST_COLUMN && (would_fit || is_given("figure.columns")) {
        ("figure.columns", "take fewer columns, or a wider figure")
    } else {
        let [width, dpi, ..] = sizes(figure).map(|(key, times)| (key, 1.0 / times));
        (largest(figure, [width, dpi]), "make the figure wider")
    };
    let what = format!("a column has fewer than {LEAST_COLUMN} pixels");
    Err(Failure::new(what, figure.given.position(key), remedy))
}

/// The key that makes a page large: of those that are given the one that is most times its default.
pub(super) fn key_of_large(figure: &Figure) -> &'static str {
    largest(figure, sizes(figure))
}

/// The keys that a page's size follows from, with their values in defaults.
fn sizes(figure: &Figure) -> [(&'static str, f64); 5] {
    let (settings, default) = (&figure.figure, FigureSettings::default());
    let mm = |length: Length| Page::in_pixels([1, 1], 0.0, settings.dpi).length(length).unwrap_or_default();
    let margin = figure.page.as_ref().map_or(0.0, |page| mm(page.margin));
    [
        ("figure.width", mm(settings.width) / mm(default.width)),
        ("figure.dpi", settings.dpi / default.dpi),
        ("figure.size", mm(settings.size) / mm(default.size)),
        ("figure.gap", mm(settings.gap) / mm(default.gap)),
        ("page.margin", margin / mm(PageSettings::default().margin)),
    ]
}

/// The given key of the largest number; without a given key that of the width.
fn largest<const N: usize>(figure: &Figure, keys: [(&'static str, f64); N]) -> &'static str {
    let given = keys.into_iter().filter(|(key, _)| figure.given.place(key).is_some());
    given.max_by(|a, b| a.1.total_cmp(&b.1)).map_or("figure.width", |(key, _)| key)
}
