//! Contour rings on spheres: how wide they are drawn, and what they look like ([STF-7]).

mod measure;
mod picture;

use crate::files;
use drypoint::scene::tables::Kappa;
pub(crate) use measure::THICKNESS;
use measure::{Ball, Stored};
use rayon::prelude::*;

/// Radii in voxels.
const RADII: [f64; 6] = [2.0, 4.0, 10.0, 20.0, 30.0, 40.0];

/// Pixels a voxel of the spheres that are measured.
pub(crate) const PIXELS: f64 = 4.0;

/// Columns: which κ, how the sphere is stored, and Δ in voxels.
const COLUMNS: [(Kappa, Stored, f64); 4] = [
    (Kappa::Exact, Stored::Distance, 0.125),
    (Kappa::Exact, Stored::EightBits, 0.5),
    (Kappa::Ray, Stored::Distance, 0.125),
    (Kappa::Ray, Stored::EightBits, 0.5),
];

/// Writes the picture of rings.
///
/// # Errors
/// What the renderer or the system says.
pub(crate) fn write() -> Result<(), String> {
    let picture = picture::Grey::spheres()?;
    files::write("pictures/rings.png", &picture.png().map_err(|e| e.to_string())?)
}

/// Widths of rings in voxels against their formulas, as Markdown.
///
/// # Errors
/// What the renderer says.
pub(crate) fn table() -> Result<String, String> {
    let rows = RADII.par_iter().map(|&radius| {
        let mut row = format!("| {radius} |");
        for (kappa, stored, step) in COLUMNS {
            let formula = match kappa {
                Kappa::Ray => THICKNESS * radius / (radius + THICKNESS),
                Kappa::Exact | Kappa::None { .. } => THICKNESS,
            };
            // What one step adds at the most: a visible sample lies up to Δ under the surface.
            let x = ((THICKNESS + step) / radius).min(1.0);
            let most = formula + step * (x * (2.0 - x)).sqrt();
            let ring = Ball { radius, kappa, stored, step, pixels: PIXELS }.draw()?.ring();
            row += &format!(" {formula:.2} … {most:.2} | {ring:.2} |");
        }
        Ok(row + "\n")
    });
    let rows: Vec<String> = rows.collect::<Result<_, String>>()?;
    let head = "| R | exact κ, distance: formula | drawn | exact κ, u8: formula | drawn | ray κ, distance: formula \
                | drawn | ray κ, u8: formula | drawn |\n|";
    Ok(format!("{head}{}\n{}", "--:|".repeat(9), rows.concat()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [STF-7]'s interval, and a pixel of a quarter voxel on either side.
    #[test]
    fn rings_are_as_wide_as_their_formulas() {
        for (kappa, formula) in [(Kappa::Exact, 2.0), (Kappa::Ray, 2.0 * 10.0 / 12.0)] {
            let ball = Ball { radius: 10.0, kappa, stored: Stored::Distance, step: 0.25, pixels: 4.0 };
            let (ring, x) = (ball.draw().unwrap().ring(), 0.225f64);
            let most = formula + 0.25 * (x * (2.0 - x)).sqrt();
            assert!((formula - 0.25..=most + 0.25).contains(&ring), "{kappa:?}: {ring}, not {formula} to {most}");
        }
    }
}
