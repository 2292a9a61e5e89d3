//! Slices of a volume along its index axes, as they lie on the screen.

use crate::camera::Side;
use drypoint::job::Job;
use drypoint::scene::color::{Rgb, linear_to_srgb};
use drypoint::scene::glam::DVec3;
use drypoint::scene::space::Grid;
use drypoint::scene::volume::{Anatomy, Volume};
use eframe::egui::{Color32, ColorImage};

/// A family of parallel slices. A slice is one layer of voxels, with a voxel a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlicePlane {
    /// The name.
    pub name: &'static str,
    /// The index axes to the right, down, and from slice to slice.
    pub axes: [usize; 3],
    /// Whether the index falls to the right, and down.
    flips: [bool; 2],
    dims: [usize; 3],
    /// The initials of the sides of the patient at the left, the right, the top and the bottom. None if the volume names no
    /// anatomical space.
    pub sides: Option<[&'static str; 4]>,
}

impl SlicePlane {
    /// Returns the axial, the coronal and the sagittal plane of a grid, as a viewer sees them from below, from the front
    /// and from the left: the patient's right is at the left, the front at the top or at the left. A world without a name
    /// is taken as right-anterior-superior. Of an oblique grid the axes closest to those of the world count.
    pub fn all(grid: &Grid, anatomy: Option<Anatomy>) -> [Self; 3] {
        // The index axis of each world axis: the assignment with the largest sum of cosines.
        let cosine = |index: usize, world: usize| grid.axes().col(index).normalize_or_zero()[world];
        let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
        let sum = |order: &[usize; 3]| (0..3).map(|world| cosine(order[world], world).abs()).sum::<f64>();
        let order = orders.into_iter().max_by(|a, b| sum(a).total_cmp(&sum(b))).unwrap_or(orders[0]);
        let sides = |pairs: [&'static str; 4]| anatomy.map(|_| pairs);
        let planes = [
            ("Axial", Side::Bottom, sides(["R", "L", "A", "P"])),
            ("Coronal", Side::Front, sides(["R", "L", "S", "I"])),
            ("Sagittal", Side::Left, sides(["A", "P", "S", "I"])),
        ];
        planes.map(|(name, side, sides)| {
            let [forward, up] = side.directions(anatomy);
            let ways = [forward.cross(up), -up, forward].map(|way| {
                let world = way.abs().max_position();
                (order[world], cosine(order[world], world) * way[world] < 0.0)
            });
            let [(right, flips_right), (down, flips_down), (through, _)] = ways;
            Self { name, axes: [right, down, through], flips: [flips_right, flips_down], dims: grid.dims(), sides }
        })
    }

    /// Returns width and height of a slice in voxels, and the number of slices.
    pub fn size(&self) -> [usize; 3] {
        self.axes.map(|axis| self.dims[axis])
    }

    /// Returns the voxel of a pixel of slice `k`.
    pub fn voxel(&self, pixel: [usize; 2], k: usize) -> [usize; 3] {
        let mut voxel = [k; 3];
        for ((axis, flips), n) in self.axes.into_iter().zip(self.flips).zip(pixel) {
            voxel[axis] = if flips { self.dims[axis] - 1 - n } else { n };
        }
        voxel
    }

    /// Returns the point of a slice, in pixels from its corner, of a position in index space.
    pub fn point_of(&self, index: DVec3) -> [f64; 2] {
        std::array::from_fn(|side| {
            let axis = self.axes[side];
            let along = if self.flips[side] { (self.dims[axis] - 1) as f64 - index[axis] } else { index[axis] };
            along + 0.5
        })
    }

    /// Returns slice `k` in some colours. A pixel of the picture is every `step`-th voxel.
    pub fn picture(&self, volume: &Volume, k: usize, colors: &ValueColors, step: usize) -> ColorImage {
        let [width, height, _] = self.size();
        let voxels = (0..height).step_by(step).flat_map(|y| (0..width).step_by(step).map(move |x| [x, y]));
        let pixels = voxels.map(|pixel| colors.of_value(volume.value(self.voxel(pixel, k))));
        ColorImage::new([width.div_ceil(step), height.div_ceil(step)], pixels.collect())
    }
}

/// The colours of values in slices.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueColors {
    /// The values that are black and white in grey.
    range: [f64; 2],
    /// Colours at evenly spaced values of the range; none where values are grey.
    colors: Vec<Option<Color32>>,
}

impl ValueColors {
    /// Grey: the range's ends are black and white, and codes are linear in the value.
    pub fn grey(range: [f64; 2]) -> Self {
        Self { range, colors: Vec::new() }
    }

    /// The colours of a job's function where it shows something, and grey elsewhere.
    pub fn of(job: &Job, range: [f64; 2]) -> Self {
        /// Colours where values are not so many integers.
        const ENTRIES: usize = 1024;
        let [lo, hi] = range;
        let is_whole = job.volume.is_integer() && job.volume.slope() == 1.0 && hi - lo < 65536.0;
        let last = if is_whole { (hi - lo).max(1.0) } else { (ENTRIES - 1) as f64 };
        let values: Vec<f64> = (0..=last as usize).map(|i| lo + (hi - lo) * (i as f64 / last)).collect();
        let code = |c: f64| (linear_to_srgb(c.clamp(0.0, 1.0)) * 255.0).round() as u8;
        let color = |rgb: Rgb| Color32::from_rgb(code(rgb[0]), code(rgb[1]), code(rgb[2]));
        let colors = job.value_colors(&values).into_iter().map(|shown| shown.map(color)).collect();
        Self { range, colors }
    }

    /// Returns the colour of a value: that of the nearest entry, or grey. Without a value a voxel is black.
    fn of_value(&self, value: f64) -> Color32 {
        let [lo, hi] = self.range;
        let share = (value - lo) / (hi - lo).max(f64::MIN_POSITIVE);
        let entry = (share * self.colors.len().saturating_sub(1) as f64).round() as usize;
        let shown = self.colors.get(entry).copied().flatten();
        shown.unwrap_or_else(|| Color32::from_gray((share * 255.0).round() as u8))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint::scene::glam::DMat3;
    use drypoint::scene::volume::{VoxelType, Voxels};

    /// In grids of all orders and signs of axes a pixel to the right or down is a step in the plane's direction of the world,
    /// and a pixel's middle is the point of its voxel.
    #[test]
    fn planes_look_from_their_sides() {
        let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
        let units = [DVec3::X, DVec3::Y, DVec3::Z];
        for (order, signs) in orders.iter().flat_map(|order| (0..8).map(move |signs| (order, signs))) {
            let column = |i: usize| {
                let sign = if signs >> i & 1 == 1 { -1.0 } else { 1.0 };
                // A little oblique.
                units[order[i]] * sign * (1.0 + i as f64) + DVec3::new(0.1, -0.05, 0.07)
            };
            let grid = Grid::new([5, 4, 3], DMat3::from_cols(column(0), column(1), column(2)), DVec3::ZERO).unwrap();
            for anatomy in [None].into_iter().chain(Anatomy::ALL.map(Some)) {
                let planes = SlicePlane::all(&grid, anatomy);
                for (plane, side) in planes.iter().zip([Side::Bottom, Side::Front, Side::Left]) {
                    let [forward, up] = side.directions(anatomy);
                    let [width, height, slices] = plane.size();
                    let place = |pixel, k| {
                        let voxel = plane.voxel(pixel, k);
                        let index = DVec3::from_array(voxel.map(|n| n as f64));
                        assert_eq!(plane.point_of(index), pixel.map(|n: usize| n as f64 + 0.5));
                        grid.to_world(index)
                    };
                    let from = place([0, 0], 0);
                    let right = place([width - 1, 0], slices - 1) - place([0, 0], slices - 1);
                    assert!(right.normalize().dot(forward.cross(up)) > 0.9, "{order:?} {signs} {anatomy:?} {plane:?}");
                    assert!((place([0, height - 1], 0) - from).normalize().dot(-up) > 0.9, "{plane:?}");
                }
                let mut through = planes.map(|plane| plane.axes[2]);
                through.sort_unstable();
                assert_eq!(through, [0, 1, 2]);
            }
        }
    }

    /// Codes of f = x + 16 y + 64 z are f itself where the range is [0, 255].
    #[test]
    fn a_slice_of_a_linear_field_is_a_ramp() {
        let dims = [16, 4, 4];
        let f = |[x, y, z]: [usize; 3]| (x + 16 * y + 64 * z) as f64;
        let voxels = (0..256).map(|i| f([i % 16, i / 16 % 4, i / 64])).collect::<Vec<_>>();
        let grid = Grid::with_spacing(dims, [1.0, 2.0, 3.0]).unwrap();
        let volume = Volume::new(grid, Voxels::from_f64(&voxels, VoxelType::I16), 1.0, 0.0).unwrap();
        let grey = ValueColors::grey([0.0, 255.0]);
        for plane in SlicePlane::all(volume.grid(), None) {
            let [width, height, slices] = plane.size();
            for k in 0..slices {
                let image = plane.picture(&volume, k, &grey, 1);
                assert_eq!(image.size, [width, height]);
                for (i, pixel) in image.pixels.iter().enumerate() {
                    let value = f(plane.voxel([i % width, i / width], k));
                    assert_eq!(*pixel, Color32::from_gray(value as u8), "{plane:?}");
                }
                // A ramp: equal differences along each row and column.
                let code = |x: usize, y: usize| i32::from(image.pixels[x + y * width].r());
                let [dx, dy] = [code(1, 0) - code(0, 0), code(0, 1) - code(0, 0)];
                let is_ramp = |(x, y): (usize, usize)| code(x, y) == code(0, 0) + x as i32 * dx + y as i32 * dy;
                assert!((0..width).flat_map(|x| (0..height).map(move |y| (x, y))).all(is_ramp), "{plane:?}");
                let coarse = plane.picture(&volume, k, &grey, 3);
                assert_eq!(coarse.size, [width.div_ceil(3), height.div_ceil(3)]);
                assert_eq!(coarse.pixels[1], image.pixels[3]);
            }
        }
    }
}
