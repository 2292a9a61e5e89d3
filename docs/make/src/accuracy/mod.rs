//! `docs/accuracy.md`: how exact reconstruction and curvature are, measured.

mod eight_bits;
mod orders;
mod places;
mod spheres;
mod statistics;
mod waves;

use crate::{files, rings};

/// Measures everything and writes the page. No time and no date is in it: the same program writes the same bytes.
///
/// # Errors
/// What a reconstruction, the renderer or the system says.
pub(crate) fn write() -> Result<(), String> {
    let (orders, apart) = orders::table()?;
    let page = PAGE
        .replace("{orders}", &orders)
        .replace("{apart}", &format!("{apart:.2}"))
        .replace("{spheres}", &spheres::table()?)
        .replace("{eight bits}", &eight_bits::table()?)
        .replace("{rings}", &rings::table()?)
        .replace("{pixels}", &rings::PIXELS.to_string());
    files::write("accuracy.md", page.as_bytes())
}

/// The page around its tables, which stand where their names are.
const PAGE: &str = include_str!("page.template");
