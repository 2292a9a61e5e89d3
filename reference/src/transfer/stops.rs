//! The place of a coordinate along one axis of a function over two quantities ([STF-4]).

use crate::number::Real;

/// The coordinate of a sample along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coordinate<R> {
    /// A number.
    Number(R),
    /// The id of a label. There is nothing between two ids.
    Id(u32),
}

/// The places along an axis at which nodes or rows stand.
#[derive(Clone, Debug, PartialEq)]
pub enum AxisStops<R> {
    /// Numbers in non-decreasing order, at least one.
    Numbers(Vec<R>),
    /// Ids in ascending order.
    Ids(Vec<u32>),
}

impl<R: Real> AxisStops<R> {
    /// Converts the positions of a scene's function. For ids they must be 32-bit integers.
    pub fn new(at: &[f64], ids: bool) -> Self {
        if ids {
            Self::Ids(at.iter().map(|&id| id as u32).collect())
        } else {
            Self::Numbers(at.iter().map(|&a| R::from_f64(a)).collect())
        }
    }

    /// Returns the stop k and the fraction w on the way to the next one, like the nodes of a function over one
    /// quantity. k is the last stop at or below the coordinate, or 0 before the first. w is 0 beyond the last stop.
    /// If w rounds to 1, the next stop is returned with w = 0. An id has only its own stop, or none.
    #[inline]
    pub fn find(&self, coordinate: Coordinate<R>) -> Option<(usize, R)> {
        match (self, coordinate) {
            (Self::Numbers(at), Coordinate::Number(x)) => {
                let after = at.partition_point(|&a| a <= x);
                if after == 0 || after == at.len() {
                    return Some((after.max(1) - 1, R::ZERO));
                }
                let (a, b) = (at[after - 1], at[after]);
                let w = (x - a) / (b - a);
                Some(if w < R::ONE { (after - 1, w) } else { (after, R::ZERO) })
            }
            (Self::Ids(ids), Coordinate::Id(id)) => Some((ids.binary_search(&id).ok()?, R::ZERO)),
            // Axis and stops have the same kind by construction.
            (Self::Numbers(_), Coordinate::Id(_)) | (Self::Ids(_), Coordinate::Number(_)) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_by_hand() {
        let stops = AxisStops::<f64>::new(&[10.0, 20.0, 20.0, 40.0], false);
        let at = |x| stops.find(Coordinate::Number(x)).unwrap();
        assert_eq!([-5.0, 10.0, 15.0, 20.0].map(at), [(0, 0.0), (0, 0.0), (0, 0.5), (2, 0.0)]);
        assert_eq!([35.0, 40.0, 1e300, f64::NAN].map(at), [(2, 0.75), (3, 0.0), (3, 0.0), (0, 0.0)]);
        // A w that rounds to 1 becomes the next stop.
        assert_eq!(at(20f64.next_down()).0, 0);
        let far = AxisStops::<f32>::new(&[-1.0, f64::from(f32::MIN_POSITIVE)], false);
        assert_eq!(far.find(Coordinate::Number(0.0)), Some((1, 0.0)));
    }

    #[test]
    fn ids_are_their_own_or_nothing() {
        let stops = AxisStops::<f32>::new(&[0.0, 12.0, 4_294_967_295.0], true);
        let at = |id| stops.find(Coordinate::Id(id));
        assert_eq!([0, 12, u32::MAX].map(at), [Some((0, 0.0)), Some((1, 0.0)), Some((2, 0.0))]);
        assert_eq!([1, 11, 13, u32::MAX - 1].map(at), [None; 4]);
    }
}
