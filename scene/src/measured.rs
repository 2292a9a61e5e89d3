//! Facts measured from the data. They are measured once, and handed to every renderer of the shot.

use crate::mesh::BoxNode;
use crate::volume::Bricks;
use std::sync::Arc;

/// Numbers on a volume's grid, x fastest, continued beyond each border.
#[derive(Clone, Debug, PartialEq)]
pub struct PaddedNumbers {
    /// The numbers.
    pub data: Vec<f64>,
    /// Numbers along x, y and z, border included.
    pub dims: [usize; 3],
    /// Numbers before the first voxel of each line along an axis.
    pub pad: usize,
    /// The largest magnitude. [`Measured::without_numbers`] keeps it.
    pub largest: f64,
}

impl PaddedNumbers {
    /// Numbers with their largest magnitude.
    pub fn new(data: Vec<f64>, dims: [usize; 3], pad: usize) -> Self {
        let largest = data.iter().fold(0.0f64, |largest, c| largest.max(c.abs()));
        Self { data, dims, pad, largest }
    }
}

/// The measured facts of a volume for one shot. Numbers are values minus [`base`](Self::base), so that a constant volume
/// has numbers 0. Objects of one volume share its numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The numbers that the shot's kernel weighs: voxels, or the coefficients of a spline ([REC-1]).
    pub numbers: Arc<PaddedNumbers>,
    /// The voxels, if an estimator reads them and `numbers` are coefficients.
    pub voxels: Option<Arc<PaddedNumbers>>,
    /// Coefficients of the smoothed spline, for `gaussian` Hessians ([REC-3]).
    pub smoothed: Option<Arc<PaddedNumbers>>,
    /// Weights of the `regression` gradient ([STIP-1]); none if no gradient reads them. For each case and each index
    /// axis, these are the weights of the 3³ voxels around a voxel, x fastest. Case nx + 4ny + 16nz has 1 in n for a
    /// neighbour before the voxel on that axis, plus 2 for one after it.
    pub regression: Option<Vec<f64>>,
    /// The value of number 0.
    pub base: f64,
    /// lo and hi − lo of ‖g‖, in values per world unit ([VAL-2]); none where nothing reads |g|.
    pub gradient_range: Option<[f64; 2]>,
    /// The gradient, in values per world unit, of which a small share is rounding ([PREC-3]): 2⁻²⁰ in f32, 2⁻⁴⁶ in f64.
    pub gradient_scale: f64,
    /// Distances of the volume's voxels to a label, in world units, for each of the function's two quantities that is
    /// such a distance ([STF-4]).
    pub label_distances: [Option<Vec<f64>>; 2],
    /// Ranges of values of bricks of cells; none where nothing is skipped ([RAY-2]).
    pub bricks: Option<Bricks>,
    /// The tree of boxes about the triangles of all meshes of the shot, one mesh after the other, in the volume's index space;
    /// empty without a mesh ([VS-12]).
    pub mesh_boxes: Arc<[BoxNode]>,
}

impl Measured {
    /// The facts without the numbers, for a renderer that has uploaded them.
    #[must_use]
    pub fn without_numbers(self) -> Self {
        let empty = |numbers: &PaddedNumbers| Arc::new(PaddedNumbers { data: Vec::new(), ..*numbers });
        Self {
            numbers: empty(&self.numbers),
            voxels: self.voxels.as_deref().map(empty),
            smoothed: self.smoothed.as_deref().map(empty),
            ..self
        }
    }
}
