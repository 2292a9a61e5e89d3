//! The box of a selection by value ([VS-2]).

use super::Volume;
use super::selection::grown;
use crate::parallel;

/// Returns the first and the last voxel with a membership above 0, grown by one voxel and clipped to the volume; none if
/// no voxel has one. `pairs` holds values and their memberships, in ascending order.
pub fn selected_by_value(data: &Volume, pairs: &[[f64; 2]]) -> Option<[[usize; 3]; 2]> {
    let [nx, ny, nz] = data.dims();
    let of_slice = |z: usize| {
        let voxels = (0..ny).flat_map(|y| (0..nx).map(move |x| [x, y, z]));
        let shown = voxels.filter(|&voxel| !data.mask().is_some_and(|mask| mask.voxel(voxel)));
        let selected = shown.filter(|&voxel| is_selected(pairs, data.value(voxel)));
        selected.map(|voxel| [voxel; 2]).reduce(around)
    };
    let slices = parallel::map(nz, &of_slice);
    slices.into_iter().flatten().reduce(around).map(|ends| grown(ends, data.dims()))
}

/// Whether the membership of a value is above 0. Between two pairs, it is unless both ends are 0.
fn is_selected(pairs: &[[f64; 2]], value: f64) -> bool {
    let after = pairs.partition_point(|pair| pair[0] <= value);
    let ends = [after.checked_sub(1).map_or(pairs.first(), |before| pairs.get(before)), pairs.get(after)];
    match ends {
        [Some(before), Some(next)] if before[0] <= value => before[1] > 0.0 || next[1] > 0.0 && value > before[0],
        [Some(end), _] => end[1] > 0.0,
        _ => false,
    }
}

/// The smallest box around two.
fn around(a: [[usize; 3]; 2], b: [[usize; 3]; 2]) -> [[usize; 3]; 2] {
    [std::array::from_fn(|i| a[0][i].min(b[0][i])), std::array::from_fn(|i| a[1][i].max(b[1][i]))]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Grid;
    use crate::volume::Voxels;

    fn box_of(values: Vec<f32>, pairs: &[[f64; 2]]) -> Option<[usize; 2]> {
        let grid = Grid::with_spacing([1, values.len(), 1], [1.0; 3]).unwrap();
        let volume = Volume::new(grid, Voxels::F32(values), 1.0, 0.0).unwrap();
        selected_by_value(&volume, pairs).map(|ends| ends.map(|voxel| voxel[1]))
    }

    #[test]
    fn the_box_is_grown_by_a_voxel_and_clipped() {
        let ramp = [[10.0, 0.0], [20.0, 1.0]];
        assert_eq!(box_of(vec![0.0, 5.0, 9.0, 11.0, 0.0, 30.0, 0.0, 0.0], &ramp), Some([2, 6]));
        assert_eq!(box_of(vec![12.0, 0.0, 0.0], &ramp), Some([0, 1]));
        assert_eq!(box_of(vec![0.0, 5.0, 10.0], &ramp), None);
    }

    #[test]
    fn a_value_is_selected_where_the_line_through_the_pairs_is_above_0() {
        let hat = [[1.0, 0.0], [2.0, 1.0], [3.0, 0.0], [4.0, 0.0], [5.0, 0.5]];
        let selected = [0.0, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 9.0].map(|value| is_selected(&hat, value));
        assert_eq!(selected, [false, false, true, true, true, false, false, false, true, true, true]);
        assert!(is_selected(&[[1.0, 0.5], [2.0, 0.0]], 0.0) && !is_selected(&[], 1.0));
    }

    #[test]
    fn a_voxel_that_is_not_finite_is_not_selected() {
        assert_eq!(
            box_of(vec![0.0, 0.0, 0.0, 0.0, f32::NAN, f32::NAN, 1.0, 0.0], &[[0.5, 0.0], [1.0, 1.0]]),
            Some([5, 7])
        );
    }
}
