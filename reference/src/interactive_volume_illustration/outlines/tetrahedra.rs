//! Common zeros of two functions in the six tetrahedra of a cell ([HATCH-18]).
//!
//! Both functions are linear in a tetrahedron, so their common zeros are a straight segment that crosses two faces. A
//! face has a zero if its corners' pairs of values, as points of a plane, enclose the origin. The signs of three
//! determinants decide this exactly.
//!
//! If a determinant is 0, the decision is made as if every value were shifted by an infinitesimal amount. Each amount
//! is smaller than all numbers and all earlier amounts (Edelsbrunner and Mücke, *Simulation of Simplicity*, ACM
//! Transactions on Graphics 9, 1990). So each tetrahedron has two crossed faces or none, and both of its tetrahedra
//! agree on a face. Segments join to curves without branches, even on plateaus and noise.

use drypoint_scene::math::compare_products;
use std::cmp::Ordering;

/// The values of the two functions at a voxel.
pub(super) type ValuePair = [f64; 2];

/// The six tetrahedra, as steps from the cell's first voxel to their other corners: bit a is a step along axis a. All
/// share the diagonal from 0 to 7. Each corner has one more step than the corner before.
pub(super) const TETRAHEDRA: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 1, 5, 7], [0, 2, 3, 7], [0, 2, 6, 7], [0, 4, 5, 7], [0, 4, 6, 7]];

/// The corners of the four faces of a tetrahedron.
pub(super) const FACES: [[usize; 3]; 4] = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]];

/// Pairs of corners of a tetrahedron.
const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// Whether a value counts as above 0. The value 0 itself is shifted upwards.
pub(super) fn is_above(value: f64) -> bool {
    value >= 0.0
}

/// Whether values at the corners of a cell lie on both sides of 0.
pub(super) fn any_sign_change(corners: &[f64; 8]) -> bool {
    let above = is_above(corners[0]);
    corners.iter().any(|&corner| is_above(corner) != above)
}

/// Whether the determinant of two pairs is above 0. The first pair belongs to the voxel that comes first in the
/// volume.
fn turns_left(a: ValuePair, b: ValuePair) -> bool {
    let shifted = |x: f64| (x != 0.0).then_some(x > 0.0);
    match compare_products([a[0], b[1]], [a[1], b[0]]) {
        Ordering::Greater => true,
        Ordering::Less => false,
        // With shifts ε₁ ≫ ε₂ ≫ ε₃ of a₀, a₁ and b₀: ε₁b₁ − ε₂b₀ − ε₃a₁ − ε₂ε₃.
        Ordering::Equal => shifted(b[1]).or(shifted(-b[0])).or(shifted(-a[1])).unwrap_or(false),
    }
}

/// Returns the two faces of a tetrahedron that contain a common zero. The pairs are those of its corners, in the
/// order of the voxels.
pub(super) fn crossed(corners: [ValuePair; 4]) -> Option<[usize; 2]> {
    let mut left = [[false; 4]; 4];
    for [i, j] in EDGES {
        left[i][j] = turns_left(corners[i], corners[j]);
    }
    let goes_round = |face: &usize| {
        let [a, b, c] = FACES[*face];
        left[a][b] == left[b][c] && left[a][b] != left[a][c]
    };
    let mut faces = (0..4).filter(goes_round);
    Some([faces.next()?, faces.next()?])
}

/// Barycentric coordinates of a face's common zero.
pub(super) fn weights([a, b, c]: [ValuePair; 3]) -> [f64; 3] {
    let cross = |p: ValuePair, q: ValuePair| (p[0] * q[1] - p[1] * q[0]).abs();
    let each = [cross(b, c), cross(c, a), cross(a, b)];
    let sum: f64 = each.iter().sum();
    if sum > 0.0 && sum.is_finite() { each.map(|w| w / sum) } else { [1.0 / 3.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Whether a triangle encloses the origin, in integers and without shifts. Returns none if the origin is on its
    /// rim.
    fn holds_origin(p: [[i64; 2]; 3]) -> Option<bool> {
        let det = |a: [i64; 2], b: [i64; 2]| a[0] * b[1] - a[1] * b[0];
        let d = [det(p[0], p[1]), det(p[1], p[2]), det(p[2], p[0])];
        (!d.contains(&0)).then(|| d.iter().all(|&x| x > 0) || d.iter().all(|&x| x < 0))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        /// Values on few levels, with many zeros and multiples: there are two crossed faces or none. Plain arithmetic
        /// agrees where it decides, and both tetrahedra agree on a face.
        #[test]
        fn two_faces_or_none(values in prop::array::uniform5(prop::array::uniform2(-2i64..3))) {
            let pair = |i: usize| values[i].map(|x| x as f64);
            let faces = |corners: [usize; 4]| -> Vec<usize> {
                let found = crossed(corners.map(pair));
                (0..4).filter(|face| found.is_some_and(|f| f.contains(face))).collect()
            };
            let first = faces([0, 1, 2, 3]);
            let mut left = [[false; 4]; 4];
            for [i, j] in EDGES {
                left[i][j] = turns_left(pair(i), pair(j));
            }
            let all = FACES.iter().filter(|[a, b, c]| left[*a][*b] == left[*b][*c] && left[*a][*b] != left[*a][*c]);
            prop_assert!(matches!(all.count(), 0 | 2));
            for (i, face) in FACES.iter().enumerate() {
                if let Some(inside) = holds_origin(face.map(|k| values[k])) {
                    prop_assert_eq!(first.contains(&i), inside);
                }
            }
            // The face of 1, 2, 3 in the tetrahedron behind it, whose fourth corner comes last.
            let behind = faces([1, 2, 3, 4]);
            prop_assert_eq!(first.contains(&3), behind.contains(&0));
        }
    }

    #[test]
    fn a_zero_by_hand() {
        // f = x − ¼, q = y − ½ on the tetrahedron 0, x, xy, xyz: the line x = ¼, y = ½ lies outside, where y ≤ x.
        let at = |steps: usize| [(steps & 1) as f64 - 0.25, (steps >> 1 & 1) as f64 - 0.5];
        assert_eq!(crossed(TETRAHEDRA[0].map(at)), None);
        // 0, y, xy, xyz holds it for 0 ≤ z ≤ ¼: it enters through z = 0 and leaves through z = x.
        let corners = TETRAHEDRA[2].map(at);
        assert_eq!(crossed(corners), Some([0, 1]));
        let [w0, w1, w2] = weights([corners[0], corners[1], corners[2]]);
        assert_eq!([w0, w1, w2], [0.5, 0.25, 0.25]);
        assert_eq!(weights([[0.0; 2]; 3]), [1.0 / 3.0; 3]);
    }
}
