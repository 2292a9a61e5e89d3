//! The insets of a panel.

use super::PanelPlace;
use crate::Failure;
use drypoint_scene::tables::{Corner, Figure};

/// A panel at the origin, then its insets, `inset` pixels from its edges. `sizes` gives the proportions of the pictures.
///
/// # Errors
/// An inset of no pixel, or one that does not fit into the panel.
pub(super) fn with_insets(
    figure: &Figure,
    panel: usize,
    width: usize,
    inset: usize,
    sizes: &mut dyn Iterator<Item = [usize; 2]>,
) -> Result<Vec<PanelPlace>, Failure> {
    let mut proportions = || sizes.next().unwrap_or([1, 1]).map(|n| n.max(1) as f64);
    let scaled = |width: usize, [w, h]: [f64; 2]| [width, (width as f64 * h / w).round().max(1.0) as usize];
    let own = scaled(width, proportions());
    let mut places = vec![PanelPlace { corner: [0, 0], size: own, is_inset: false }];
    for (i, table) in figure.panels[panel].insets.iter().enumerate() {
        let proportions = proportions();
        let of_share = |share: f64| scaled((width as f64 * share).round() as usize, proportions);
        let fits = |size: [usize; 2]| (0..2).all(|axis| size[axis].saturating_add(inset) <= own[axis]);
        let size = of_share(table.share);
        if size[0] == 0 || !fits(size) {
            let place = figure.given.position(&format!("panel[{panel}].inset[{i}].share"));
            let shares = (1..=100).rev().map(|percent| f64::from(percent) / 100.0);
            let mut fitting = shares.filter(|share| fits(of_share(*share)));
            let (what, remedy) = match fitting.next() {
                _ if size[0] == 0 => ("the inset has less than a pixel", "take a larger share".into()),
                Some(share) => ("the inset is larger than its panel", format!("take a share of at most {share}")),
                None => ("the inset is larger than its panel", "take a smaller figure.gap, or a wider figure".into()),
            };
            return Err(Failure::new(what, place, remedy));
        }
        let [right, bottom] = [0, 1].map(|axis| own[axis] - size[axis] - inset);
        let corner = match table.corner {
            Corner::TopLeft => [inset, inset],
            Corner::TopRight => [right, inset],
            Corner::BottomLeft => [inset, bottom],
            Corner::BottomRight => [right, bottom],
        };
        places.push(PanelPlace { corner, size, is_inset: true });
    }
    Ok(places)
}
