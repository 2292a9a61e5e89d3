//! The shading normal ([NORM-1]), and the condition under which there is none ([PREC-3]).

use crate::number::{Arithmetic, Real, Vec3};
use drypoint_scene::shot::Outside;

/// A shading normal, or one for each lane.
#[derive(Clone, Copy)]
pub(crate) struct Normal<A: Arithmetic> {
    /// N.
    pub(crate) n: Vec3<A>,
    /// Whether the normal exists.
    pub(crate) has: A::Mask,
    /// ‖g‖.
    pub(crate) length: A,
}

impl<A: Arithmetic> Normal<A> {
    /// See [`outward`], which has the same formula.
    #[inline(always)]
    pub(crate) fn outward(gradient: Vec3<A>, outside: Outside, no_normal_below: A::Number) -> Self {
        let length = gradient.length();
        let has = length.exceeds(no_normal_below);
        Self { n: gradient * outwards(length, outside), has, length }
    }
}

/// ∓1/‖g‖: the factor from a gradient to its outward normal.
#[inline(always)]
pub(super) fn outwards<A: Arithmetic>(length: A, outside: Outside) -> A {
    let inverse = length.one() / length;
    match outside {
        Outside::Low => -inverse,
        Outside::High => inverse,
    }
}

/// The outward unit normal of a gradient. Returns none if ‖g‖ is at most the bound. The bound for a field's gradients
/// is [`Field::no_normal_below`](super::Field::no_normal_below).
#[inline(always)]
pub fn outward<R: Real>(gradient: Vec3<R>, outside: Outside, no_normal_below: R) -> Option<Vec3<R>> {
    let Normal { n, has, .. } = Normal::outward(gradient, outside, no_normal_below);
    has.then_some(n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::lanes::LANES;
    use crate::number::lanes::testing::{column, numbers, same, side_by_side, units};
    use fearless_simd::prelude::*;
    use fearless_simd::{Level, dispatch};

    /// Lanes with and without a normal.
    #[test]
    fn lanes_are_those_of_one() {
        let level = Level::new();
        let [mut a, mut b] = [1, 2].map(numbers);
        for outside in [Outside::Low, Outside::High].into_iter().cycle().take(1000) {
            let (directions, lengths) = (units(&mut a), column(&mut b));
            let g: [_; LANES] = std::array::from_fn(|lane| directions[lane] * lengths[lane]);
            let (has, [x, y, z]): (u64, [[f64; LANES]; 3]) = dispatch!(level, simd => {
                let Normal { n, has, .. } = Normal::outward(side_by_side(simd, g), outside, 0.3);
                (has.to_bitmask(), [n.x.into(), n.y.into(), n.z.into()])
            });
            let one = |lane: usize| outward(g[lane], outside, 0.3);
            for lane in 0..LANES {
                assert_eq!(has >> lane & 1 == 1, one(lane).is_some());
            }
            for (got, axis) in [(x, 0), (y, 1), (z, 2)] {
                same(got, |lane| one(lane).map_or(got[lane], |n| [n.x, n.y, n.z][axis]));
            }
        }
    }
}
