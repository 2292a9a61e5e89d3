//! The distance to a label: Euclidean, in the world, to the nearest voxel centre with this label ([STF-4]).

use super::{AxisMeasure, SampleQuantities};
use crate::field::CellPosition;
use crate::labels::Labels;
use crate::number::{Real, Vec3};
use crate::transfer::Coordinate;
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::parallel;
use drypoint_scene::shot::LabelLookup;
use drypoint_scene::space::Grid;
use drypoint_scene::volume::Volume;
use drypoint_scene::volume::labels::LabelVolume;
use rstar::RTree;

/// The distance of every voxel of the data to the nearest voxel centre with a label, trilinear between voxels. It is
/// 0 at voxels that lie in a voxel with the label.
///
/// A search for each voxel is exact on every grid. A transform axis by axis would be exact only on orthogonal grids.
pub struct LabelDistance<R> {
    dims: [usize; 3],
    distances: Vec<R>,
}

impl<R: Real> LabelDistance<R> {
    /// Computes the distances on the grid of a data volume, to the voxels of a label volume that have an id. Returns
    /// none if no voxel has the id.
    pub fn new(data: &Volume, volume: &LabelVolume, id: u32) -> Option<Self> {
        let (data, world) = (data.grid(), data.anatomy());
        let labels = Labels::new(volume, data, world, LabelLookup::Nearest);
        let lies = volume.grid_in(world);
        let centres = centres(&lies, &|i| volume.id(i) == id, labels.on_same_grid() && is_reduced(lies.axes()));
        if centres.is_empty() {
            return None;
        }
        let (centres, from) = (RTree::bulk_load(centres), data.origin() - lies.origin());
        let [nx, ny, _] = data.dims();
        let mut distances = vec![R::ZERO; data.len()];
        parallel::chunks_mut(&mut distances, nx, &|row, distances| {
            for (x, distance) in distances.iter_mut().enumerate() {
                let index = DVec3::new(x as f64, (row % ny) as f64, (row / ny) as f64);
                if labels.id_at(Vec3::<f64>::from_glam(index)) != id {
                    let p = data.axes() * index + from;
                    // There is at least one centre.
                    let nearest = centres.nearest_neighbor(p.to_array()).map_or(p, |&c| DVec3::from_array(c));
                    *distance = R::from_f64((p - nearest).length());
                }
            }
        });
        Some(Self { dims: data.dims(), distances })
    }

    /// The distances at voxels, x fastest.
    pub(crate) fn at_voxels(&self) -> Vec<f64> {
        self.distances.iter().map(|distance| distance.to_f64()).collect()
    }

    /// The distance at a place of the data's grid: three nested interpolations, x then y then z.
    fn value(&self, at: CellPosition<R>) -> R {
        let [nx, ny, nz] = self.dims;
        let [x, y, z] = at.cell;
        // On an axis of length 1 the second neighbour is the first.
        let next = |i: usize, n: usize| (i + 1).min(n - 1);
        let along = |y: usize, z: usize| {
            let row = (z * ny + y) * nx;
            R::lerp(self.distances[row + x], self.distances[row + next(x, nx)], at.w[0])
        };
        let sheet = |z: usize| R::lerp(along(y, z), along(next(y, ny), z), at.w[1]);
        R::lerp(sheet(z), sheet(next(z, nz)), at.w[2])
    }
}

impl<R: Real> AxisMeasure<R> for LabelDistance<R> {
    fn at(&self, here: &SampleQuantities<R>) -> Coordinate<R> {
        Coordinate::Number(self.value(here.place))
    }

    fn bytes(&self) -> Option<(&'static str, u64)> {
        Some(("label distance", size_of_val(self.distances.as_slice()) as u64))
    }

    fn preprocess(&self) -> Option<(&'static str, u64)> {
        Some(("label distances", self.distances.len() as u64))
    }
}

/// D·index of the voxels with the label. With `surface`, only voxels with a neighbour that lacks the label or is
/// missing.
fn centres(grid: &Grid, has: &(impl Fn(usize) -> bool + Sync), surface: bool) -> Vec<[f64; 3]> {
    let [nx, ny, nz] = grid.dims();
    let around = |i: usize, n: usize| (i > 0 && i + 1 < n).then(|| i - 1..=i + 1);
    let is_interior = |[x, y, z]: [usize; 3]| {
        let (Some(xs), Some(ys), Some(zs)) = (around(x, nx), around(y, ny), around(z, nz)) else { return false };
        zs.into_iter().all(|z| ys.clone().all(|y| xs.clone().all(|x| has((z * ny + y) * nx + x))))
    };
    parallel::gather(grid.len(), nx, &|row, centres| {
        let voxels = row.filter(|&i| has(i)).map(|i| [i % nx, i / nx % ny, i / nx / ny]);
        let kept = voxels.filter(|&voxel| !(surface && is_interior(voxel)));
        centres.extend(kept.map(|voxel| (grid.axes() * DVec3::from_array(voxel.map(|i| i as f64))).to_array()));
    })
}

/// Whether the columns of D are a Minkowski-reduced basis. Then the Voronoi neighbours of a voxel are among its 26
/// neighbours (Nguyen and Stehlé, *Low-dimensional lattice basis reduction revisited*, ACM TALG 5(4), 2009).
///
/// The straight way from the nearest voxel of a label to another place leaves the voxel's Voronoi cell through a
/// neighbour that is as near or nearer. So a voxel is never the only nearest one if all of its Voronoi neighbours
/// have the label.
fn is_reduced(axes: DMat3) -> bool {
    let mut b = [axes.x_axis, axes.y_axis, axes.z_axis];
    b.sort_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    let signs = [-1.0, 0.0, 1.0];
    let longer = |v: DVec3, w: DVec3| v.length_squared() >= w.length_squared();
    signs.iter().all(|s| longer(b[1] + b[0] * *s, b[1]))
        && signs.iter().all(|s| signs.iter().all(|t| longer(b[2] + b[0] * *s + b[1] * *t, b[2])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::volume::Voxels;
    use proptest::prelude::*;

    /// The distances from every voxel of a grid to the voxels of another grid with the label 1.
    fn distance(data: &Grid, labels: &Grid, has: impl Fn(usize) -> bool) -> Option<LabelDistance<f64>> {
        let on = |grid: &Grid, voxels| Volume::new(grid.clone(), Voxels::U8(voxels), 1.0, 0.0).unwrap();
        let ids = on(labels, (0..labels.len()).map(|i| u8::from(has(i))).collect());
        LabelDistance::new(&on(data, vec![0; data.len()]), &LabelVolume::new(&ids).unwrap(), 1)
    }

    fn index(i: usize, [nx, ny, _]: [usize; 3]) -> DVec3 {
        DVec3::new((i % nx) as f64, (i / nx % ny) as f64, (i / nx / ny) as f64)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]
        /// Compares with a search through all voxels, on grids of every shear and spacing.
        #[test]
        fn the_nearest_of_all_voxels(
            dims in prop::array::uniform3(1..7usize),
            spacing in prop::array::uniform3(0.2..4.0f64),
            shear in prop::array::uniform3(prop_oneof![Just(0.0), -0.4..0.4f64, -3.0..3.0f64]),
            seed in any::<u64>(),
            share in 1..9u64,
        ) {
            let axes = DMat3::from_diagonal(spacing.into())
                * DMat3::from_cols(DVec3::X, DVec3::new(shear[0], 1.0, 0.0), DVec3::new(shear[1], shear[2], 1.0));
            let grid = Grid::new(dims, axes, DVec3::new(-7.0, 100.0, 3.0)).unwrap();
            // Whole blocks of the label, for interiors, or single voxels.
            let has = |i: usize| (seed.rotate_left((i / (1 + seed as usize % 40)) as u32 * 7) >> 3) % 10 < share;
            let has = |i: usize| has(i) || i == 0;
            let got = distance(&grid, &grid, has).unwrap();
            for i in 0..grid.len() {
                let to = |j: usize| (grid.axes() * (index(i, dims) - index(j, dims))).length();
                let want = (0..grid.len()).filter(|&j| has(j)).map(to).fold(f64::INFINITY, f64::min);
                // Positions up to 150 are subtracted.
                prop_assert!((got.distances[i] - want).abs() < 1e-13, "{i}: {} {want}", got.distances[i]);
                prop_assert!(!has(i) || got.distances[i] == 0.0);
            }
        }
    }

    #[test]
    fn another_grid_by_hand() {
        // Labels on voxels of 4 units, the data on voxels of 1; the label is the voxel at (4, 0, 0).
        let labels = Grid::with_spacing([3, 1, 1], [4.0, 1.0, 1.0]).unwrap();
        let data = Grid::new([12, 1, 1], DMat3::IDENTITY, DVec3::new(-1.0, 0.0, 0.0)).unwrap();
        let got = distance(&data, &labels, |i| i == 1).unwrap();
        // World −1 … 10: the label's voxel reaches from 2, half way, which belongs to the lower voxel, to 6, which is
        // its own.
        assert_eq!(got.distances, [5.0, 4.0, 3.0, 2.0, 0.0, 0.0, 0.0, 0.0, 3.0, 4.0, 5.0, 6.0]);
        assert!(distance(&data, &labels, |_| false).is_none());
    }

    #[test]
    fn trilinear_between_voxels() {
        let grid = Grid::with_spacing([3, 2, 1], [1.0, 2.0, 1.0]).unwrap();
        let got = distance(&grid, &grid, |i| i == 0).unwrap();
        let far = 5f64.sqrt();
        assert_eq!(got.distances, [0.0, 1.0, 2.0, 2.0, far, 8f64.sqrt()]);
        let at = |cell, w| got.value(CellPosition { cell, w });
        assert_eq!(at([0, 0, 0], [0.5, 0.0, 0.0]), 0.5);
        assert_eq!(at([0, 0, 0], [0.0, 0.25, 0.5]), 0.5);
        assert_eq!(at([0, 0, 0], [1.0, 1.0, 0.0]), far);
    }

    #[test]
    fn which_grids_are_reduced() {
        assert!(is_reduced(DMat3::IDENTITY) && is_reduced(DMat3::from_diagonal(DVec3::new(4.0, 1.0, 0.3))));
        let sheared = |s: f64| DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(s, 0.0, 1.0));
        assert!(is_reduced(sheared(0.3)) && is_reduced(sheared(0.5)) && !is_reduced(sheared(0.6)));
    }
}
