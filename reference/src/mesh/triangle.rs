//! The intersection of a line with a triangle, watertight (Woop, Benthin and Wald 2013).

use drypoint_scene::glam::DVec3;

/// A line origin + t·along, in coordinates whose third axis is along.
///
/// The axes are permuted so that the largest component of along comes last, and corners are sheared along it. A corner
/// has the same coordinates in every triangle that shares it.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShearedLine {
    origin: DVec3,
    /// Indices of the axes that become x, y and z.
    axes: [usize; 3],
    /// along.x/along.z, along.y/along.z and 1/along.z.
    pub(super) shear: [f64; 3],
}

/// A place in a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    /// The parameter of the line.
    pub(super) t: f64,
    /// Weights of the three corners, of the sum 1.
    pub(super) weights: [f64; 3],
}

impl ShearedLine {
    /// Prepares a line. Returns none if the line has no direction.
    pub(super) fn new([origin, along]: [DVec3; 2]) -> Option<Self> {
        let size = along.abs();
        let z = (0..3).fold(0, |best, axis| if size[axis] > size[best] { axis } else { best });
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let length = along[z];
        let shear = [along[axes[0]] / length, along[axes[1]] / length, 1.0 / length];
        shear.iter().all(|s| s.is_finite()).then_some(Self { origin, axes, shear })
    }

    /// The first two coordinates of a point in these axes, and its coordinate along the third.
    pub(super) fn of(&self, point: DVec3) -> [f64; 3] {
        let ([x, y, z], p) = (self.axes, point - self.origin);
        [p[x] - self.shear[0] * p[z], p[y] - self.shear[1] * p[z], p[z]]
    }

    /// The place at which the line crosses a triangle from either side, including edges and corners. Returns none if
    /// the triangle has no area as seen along the line.
    pub(super) fn crosses(&self, corners: [DVec3; 3]) -> Option<Crossing> {
        let [a, b, c] = corners.map(|corner| self.of(corner));
        // Twice the areas that the line spans with the edges. Two triangles with a common edge get exactly opposite
        // areas for it, so at least one of them contains the line.
        let area = |p: [f64; 3], q: [f64; 3]| q[0] * p[1] - q[1] * p[0];
        let areas = [area(b, c), area(c, a), area(a, b)];
        if areas.iter().any(|&w| w < 0.0) && areas.iter().any(|&w| w > 0.0) {
            return None;
        }
        let sum = areas[0] + areas[1] + areas[2];
        let weights = areas.map(|area| area / sum);
        let distance = weights[0] * a[2] + weights[1] * b[2] + weights[2] * c[2];
        let t = distance * self.shear[2];
        (sum != 0.0 && t.is_finite()).then_some(Crossing { t, weights })
    }
}
