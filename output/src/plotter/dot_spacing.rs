//! Selection of dots that are far enough apart for a nib.

use crate::grid::{CellGrid, NONE, micrometres};
use drypoint_scene::marks::Dot;

/// Returns the dots in order, without each dot that is closer than `closest` mm to an earlier kept dot.
pub(super) fn spaced(dots: &[Dot], closest: f64) -> Vec<Dot> {
    let places: Vec<[i64; 2]> = dots.iter().map(|dot| dot.at.to_array().map(micrometres)).collect();
    let reach = closest * 1000.0;
    let Some(grid) = CellGrid::new(&places, reach.ceil() as i64) else { return Vec::new() };
    let mut heads = vec![NONE; grid.cells()];
    let mut nexts = vec![NONE; dots.len()];
    let mut kept = Vec::new();
    for (i, place) in places.iter().enumerate() {
        let mut free = true;
        grid.around(place, |cell| {
            let mut other = heads[cell];
            while free && other != NONE {
                let [dx, dy] = [0, 1].map(|k| (places[other][k] - place[k]) as f64);
                // Half a step of slack in the square: exactly 0.7 nib is far enough, whatever its last bit.
                free = dx * dx + dy * dy + 0.5 > reach * reach;
                other = nexts[other];
            }
        });
        if free {
            let cell = grid.index(grid.cell_of(place));
            nexts[i] = std::mem::replace(&mut heads[cell], i);
            kept.push(dots[i]);
        }
    }
    kept
}
