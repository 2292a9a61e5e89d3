//! Maps of seeds on the page (Fig. 1; [HATCH-17]).

use super::Seeds;
use crate::interactive_volume_illustration::Sight;
use drypoint_scene::glam::DVec3;
use drypoint_scene::marks::{Dot, Layer, Pen};
use drypoint_scene::parallel;
use drypoint_scene::space::Grid;

/// Number of tones, from the lightest, p = 0, to black, p = 1.
const TONES: usize = 16;

/// Light of a cell in which no stroke ever begins.
const LIGHTEST: f64 = 0.8;

/// Distance in front of its centre at which a cell is tested for visibility, in voxels. It is more than half of the
/// cell's diagonal.
const BEFORE: f64 = 1.0;

/// Returns the cells of a grid that a camera sees, a layer a tone. Each is a dot as large as the cell, the darker the more
/// probable a stroke is.
pub fn seed_layers(seeds: &Seeds, sight: &Sight<'_>, grid: &Grid) -> Vec<Layer> {
    let &Sight { view, page, clip, .. } = sight;
    let pixel = (page.size.x - 2.0 * page.margin) / view.size[0] as f64;
    let dot = |&(cell, p): &([usize; 3], f64)| {
        let world = grid.to_world(DVec3::from_array(cell.map(|i| i as f64 + 0.5)));
        let eye = if view.perspective { (view.eye - world).normalize_or_zero() } else { -view.forward };
        let at = sight.place(world).filter(|_| !clip.cut_in_world(world))?;
        let depth = if view.perspective { -view.to_eye(world).z } else { 1.0 };
        let radius = 0.5 * 3f64.sqrt() * grid.voxel() * pixel / (view.pixel * depth);
        let seen = sight.sees(world + eye * (BEFORE * grid.voxel()));
        seen.then_some(((p * (TONES - 1) as f64).round() as usize, Dot { at, world, radius, opacity: 1.0 }))
    };
    let dots = parallel::gather(seeds.cells.len(), parallel::RUN, &|run, dots| {
        dots.extend(seeds.cells[run].iter().filter_map(dot));
    });
    let layer = |tone: usize| {
        let share = tone as f64 / (TONES - 1) as f64;
        let light = LIGHTEST * (1.0 - share);
        let pen =
            Pen { number: tone + 1, name: format!("p {share:.2}"), width: 0.1, color: [light, light, light, 1.0] };
        let of_tone = dots.iter().filter(|dot| dot.0 == tone).map(|dot| dot.1);
        Layer { dots: of_tone.collect(), ..Layer::new(pen) }
    };
    (0..TONES).map(layer).filter(|layer| !layer.dots.is_empty()).collect()
}
