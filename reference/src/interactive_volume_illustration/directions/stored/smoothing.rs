//! Smoothing of stored directions along a surface, until neighbours agree. It is not in the paper, whose surfaces are
//! sure of their directions.
//!
//! The lines of a voxel are the tensor Q = s(e₁e₁ᵀ − e₂e₂ᵀ), s = |κ₁ − κ₂|/(|κ₁| + |κ₂|). Each round takes the mean with
//! the two neighbours along one grid axis after another, weights ¼, ½, ¼, projects it onto the tangent plane and
//! subtracts its trace there. The variance of a round is half the squared spacing, so that rounds add up to ℓ². Where
//! the data are not sure, s is small, and surer neighbours decide.

use super::super::super::strokes::{StrokeField, normal};
use crate::field::curvature::Curvature;
use crate::number::Vec3;
use drypoint_scene::glam::DVec3;
use drypoint_scene::math::hypot;
use drypoint_scene::parallel;

/// Q as xx, yy, zz, yz, xz, xy, then s κ₁, s κ₂ and s.
type Lines = [f64; 9];

/// The voxels around a surface, and their lines.
pub(super) struct SurfaceLines {
    voxels: Vec<[usize; 3]>,
    normals: Vec<DVec3>,
    /// The two neighbours along each axis; the voxel itself where there is none.
    neighbours: Vec<[[u32; 2]; 3]>,
    lines: Vec<Lines>,
}

impl SurfaceLines {
    /// The voxels of cells and those beside them that have a normal, with their curvatures where they have a direction.
    pub(super) fn new(
        ground: &dyn StrokeField,
        cells: &[[usize; 3]],
        curvature: &(dyn Fn([usize; 3]) -> Option<Curvature<f64>> + Sync),
    ) -> Self {
        let [nx, ny, _] = ground.grid().dims();
        let place = |[x, y, z]: [usize; 3]| (z * ny + y) * nx + x;
        let mut voxels: Vec<[usize; 3]> = cells.iter().flat_map(|&cell| around(cell, ground.grid().dims())).collect();
        voxels.sort_unstable_by_key(|&voxel| place(voxel));
        voxels.dedup();
        let made = parallel::map(voxels.len(), &|i| {
            let index = Vec3::from_glam(DVec3::from_array(voxels[i].map(|i| i as f64)));
            let (n, _) = normal(ground, index)?;
            Some((n, curvature(voxels[i]).map_or([0.0; 9], |c| lines_of(&c))))
        });
        let mut has = made.iter().map(Option::is_some);
        voxels.retain(|_| has.next() == Some(true));
        let (normals, lines) = made.into_iter().flatten().unzip();
        let at = |voxel: [usize; 3]| voxels.binary_search_by_key(&place(voxel), |&voxel| place(voxel));
        let neighbours = parallel::map(voxels.len(), &|i| {
            [0, 1, 2].map(|axis| {
                [-1, 1].map(|step| {
                    let mut beside = voxels[i];
                    let moved = beside[axis].checked_add_signed(step).filter(|&to| to < ground.grid().dims()[axis]);
                    beside[axis] = moved.unwrap_or(beside[axis]);
                    at(beside).unwrap_or(i) as u32
                })
            })
        });
        Self { voxels, normals, neighbours, lines }
    }

    /// Smooths over a length ℓ in world units. `spacings` are those of the grid's axes.
    pub(super) fn smooth(&mut self, length: f64, spacings: [f64; 3]) {
        let rounds = spacings.map(|spacing| (2.0 * (length / spacing).powi(2)).ceil() as usize);
        let most = rounds.into_iter().max().unwrap_or(0);
        for round in 0..most {
            // Rounds of coarser axes are spread evenly over those of the finest one.
            for axis in (0..3).filter(|&axis| (round + 1) * rounds[axis] / most > round * rounds[axis] / most) {
                self.lines = parallel::map(self.voxels.len(), &|i| {
                    let [own, a, b] = [i as u32, self.neighbours[i][axis][0], self.neighbours[i][axis][1]]
                        .map(|at| &self.lines[at as usize]);
                    std::array::from_fn(|number| 0.5 * own[number] + 0.25 * (a[number] + b[number]))
                });
            }
            self.lines = parallel::map(self.voxels.len(), &|i| projected(&self.lines[i], self.normals[i]));
        }
    }

    /// The voxels with κ₁ and κ₂, means by s, and both directions.
    pub(super) fn each(&self) -> impl Iterator<Item = ([usize; 3], Option<[f64; 2]>, Option<[DVec3; 2]>)> {
        let mean = |lines: &Lines| (lines[8] > 0.0).then(|| [lines[6] / lines[8], lines[7] / lines[8]]);
        let of = move |i: usize| (self.voxels[i], mean(&self.lines[i]), directions(&self.lines[i], self.normals[i]));
        (0..self.voxels.len()).map(of)
    }
}

/// The corners of a cell and the voxels beside them, in the grid.
fn around(cell: [usize; 3], dims: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    let [x, y, z] = [0, 1, 2].map(|a| cell[a].saturating_sub(1)..(cell[a] + 3).min(dims[a]));
    z.flat_map(move |z| {
        let x = x.clone();
        y.clone().flat_map(move |y| x.clone().map(move |x| [x, y, z]))
    })
}

fn lines_of(c: &Curvature<f64>) -> Lines {
    let sum = c.k1.abs() + c.k2.abs();
    let s = if sum > 0.0 { (c.k1 - c.k2).abs() / sum } else { 0.0 };
    let [a, b] = [c.e1, c.e2].map(Vec3::to_glam);
    let entry = |i: usize, j: usize| s * (a[i] * a[j] - b[i] * b[j]);
    [entry(0, 0), entry(1, 1), entry(2, 2), entry(1, 2), entry(0, 2), entry(0, 1), s * c.k1, s * c.k2, s]
}

/// Q n.
fn times(q: &Lines, n: DVec3) -> DVec3 {
    let [xx, yy, zz, yz, xz, xy, ..] = *q;
    DVec3::new(xx * n.x + xy * n.y + xz * n.z, xy * n.x + yy * n.y + yz * n.z, xz * n.x + yz * n.y + zz * n.z)
}

/// PQP − ½ tr(PQP) P, P = I − nnᵀ.
fn projected(q: &Lines, n: DVec3) -> Lines {
    let v = times(q, n);
    let along = n.dot(v);
    // PQP = Q − nvᵀ − vnᵀ + (n·v) nnᵀ has the trace tr Q − n·v.
    let half = 0.5 * (q[0] + q[1] + q[2] - along);
    let mut of = *q;
    for (number, (i, j)) in [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)].into_iter().enumerate() {
        of[number] += (along + half) * n[i] * n[j] - n[i] * v[j] - v[i] * n[j];
    }
    for diagonal in &mut of[..3] {
        *diagonal -= half;
    }
    of
}

/// The eigenvectors of Q in the tangent plane, that of the larger eigenvalue first; none where Q is 0.
fn directions(q: &Lines, n: DVec3) -> Option<[DVec3; 2]> {
    let h = n.any_orthonormal_vector();
    let f = n.cross(h);
    let of_h = times(q, h);
    // In the frame (h, f) the tensor is r(cos 2θ, sin 2θ; sin 2θ, −cos 2θ).
    let [a, b] = [h.dot(of_h), f.dot(of_h)];
    let r = hypot(a, b);
    let [c, s] = if a >= 0.0 { [r + a, b] } else { [b, r - a] };
    let e = (h * c + f * s).try_normalize()?;
    Some([e, n.cross(e)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox::uniform;

    fn unit(i: u32, a: u32) -> DVec3 {
        DVec3::from_array([0, 1, 2].map(|b| 2.0 * uniform(5, [i, a, b], 0) - 1.0)).normalize()
    }

    fn curvature(i: u32) -> (DVec3, Curvature<f64>) {
        let n = unit(i, 0);
        let e1 = unit(i, 1).cross(n).normalize();
        let [k1, k2] = [0, 1].map(|a| uniform(6, [i, a, 0], 0) - 0.3);
        (n, Curvature { k1: k1.max(k2), k2: k1.min(k2), e1: Vec3::from_glam(e1), e2: Vec3::from_glam(n.cross(e1)) })
    }

    /// The tensor of two lines has them as eigenvectors, and projection onto their own plane does not change it.
    #[test]
    fn lines_are_eigenvectors_of_their_tensor() {
        for i in 0..1000 {
            let (n, c) = curvature(i);
            let q = lines_of(&c);
            let [e1, e2] = directions(&q, n).unwrap();
            assert!(e1.cross(c.e1.to_glam()).length() < 1e-12 / q[8].max(1e-3), "{i}");
            assert!(e2.dot(e1).abs() < 1e-14 && e2.dot(n).abs() < 1e-14, "{i}");
            let again = projected(&q, n);
            assert!(q.iter().zip(&again).all(|(a, b)| (a - b).abs() < 1e-14), "{i}");
        }
        assert_eq!(directions(&[0.0; 9], DVec3::Z), None);
    }

    /// A projected tensor maps the normal to 0 and has no trace, and the projection is that of PQP by hand.
    #[test]
    fn projections_lie_in_the_tangent_plane() {
        for i in 0..1000 {
            let (n, _) = curvature(i);
            let (_, c) = curvature(i + 5000);
            let q = projected(&lines_of(&c), n);
            assert!(times(&q, n).length() < 1e-14 && (q[0] + q[1] + q[2]).abs() < 1e-14, "{i}");
            let [h, f] = [n.any_orthonormal_vector(), n.cross(n.any_orthonormal_vector())];
            let before = lines_of(&c);
            for (a, b) in [(h, f), (h + f, h - f)] {
                assert!((a.dot(times(&q, b)) - a.dot(times(&before, b))).abs() < 1e-14, "{i}");
            }
        }
    }
}
