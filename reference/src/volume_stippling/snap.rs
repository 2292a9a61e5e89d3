//! Points onto the edge: along n to the largest ‖∇V‖ within one voxel ([STIP-4], `snap`).

use crate::field::Sampler;
use crate::number::Vec3;
use drypoint_scene::glam::DVec3;
use drypoint_scene::points::Points;
use rayon::prelude::*;

/// Places at which ‖∇V‖ is looked at on either side of a point.
const PLACES: i32 = 4;

/// Moves each point. The largest of ‖∇V‖ at nine places a quarter of a voxel apart, the nearest of equals, is refined by
/// the parabola through it and its neighbours; what leaves the volume's box does not count.
pub(super) fn onto_edges<S: Sampler<f64>>(sampler: &S, points: &mut Points) {
    let [lo, hi] = points.grid.index_box();
    let to_index = points.grid.inverse_axes() * points.grid.voxel();
    let (voxels, each) = (&points.voxels, points.each);
    let norm = |p: DVec3| {
        let inside = p.cmpge(lo).all() && p.cmple(hi).all();
        inside.then(|| sampler.gradient(Vec3::from_glam(p)).length())
    };
    points.offsets.par_chunks_mut(each).zip(voxels).for_each(|(offsets, voxel)| {
        let step = to_index * voxel.normal / f64::from(PLACES);
        for offset in offsets {
            let start = voxel.centre() + DVec3::from_array(offset.map(f64::from));
            let norms: [Option<f64>; 2 * PLACES as usize + 1] =
                std::array::from_fn(|i| norm(start + step * (i as i32 - PLACES) as f64));
            let moved = along(&norms);
            let to = DVec3::from_array(offset.map(f64::from)) + step * moved;
            *offset = to.to_array().map(|x| x as f32);
        }
    });
}

/// Where the largest is, in steps from the middle.
fn along(norms: &[Option<f64>; 2 * PLACES as usize + 1]) -> f64 {
    let at = |i: i32| usize::try_from(i + PLACES).ok().and_then(|i| norms.get(i).copied().flatten());
    let mut best: Option<(i32, f64)> = None;
    for i in (0..=PLACES).flat_map(|i| [i, -i]) {
        if let Some(norm) = at(i)
            && best.is_none_or(|(_, largest)| norm > largest)
        {
            best = Some((i, norm));
        }
    }
    let Some((i, largest)) = best else { return 0.0 };
    let refined = match (at(i - 1), at(i + 1)) {
        (Some(a), Some(b)) if a + b < 2.0 * largest => (a - b) / (2.0 * (a + b - 2.0 * largest)),
        _ => 0.0,
    };
    f64::from(i) + refined
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_gives_its_top() {
        for top in [-3.3, -0.2, 0.0, 0.5, 2.9] {
            let norms = std::array::from_fn(|i| Some(10.0 - (i as f64 - 4.0 - top).powi(2)));
            assert!((along(&norms) - top).abs() < 1e-12, "{top}: {}", along(&norms));
        }
        // Equal all along: the point stays; outside the box nothing is looked at.
        assert_eq!(along(&[Some(1.0); 9]), 0.0);
        assert_eq!(along(&[None; 9]), 0.0);
        let mut half = [Some(1.0), Some(2.0), Some(3.0), Some(4.0), Some(5.0), None, None, None, None];
        assert_eq!(along(&half), 0.0);
        half[2] = Some(6.0);
        assert!(along(&half) < 0.0);
    }
}
