//! A transfer function over two quantities ([STF-4]; 4.2): rows of nodes, with bilinear interpolation between them.

use super::piecewise::{self, NodePlace, NodesError};
use super::stops::{AxisStops, Coordinate};
use crate::number::Real;
use drypoint_scene::transfer::Rows;

/// Rows of nodes along a first quantity, stacked along a second one.
///
/// A full grid is the paper's function. A row may have nodes of its own: it is a function over the first quantity,
/// and opacities and styles are interpolated between two rows.
#[derive(Clone, Debug)]
pub struct TransferPlane<R> {
    rows: AxisStops<R>,
    lines: Vec<PlaneRow<R>>,
}

/// The nodes of one row.
#[derive(Clone, Debug)]
struct PlaneRow<R> {
    stops: AxisStops<R>,
    opacity: Vec<R>,
    /// Index of the row's first node among the nodes of all rows.
    first: usize,
}

/// The place of two coordinates between the nodes, which are counted through all rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodePatch<R> {
    /// (i_x, i_y₀) and (i_x, i_y₁): the places in the two rows, with the α_u of each, which may be 0. If one row
    /// holds alone, both places are the same.
    pub rows: [NodePlace<R>; 2],
    /// w_y, the share of the second row, in [0, 1).
    pub w: R,
    /// α_u, above 0.
    pub alpha_u: R,
}

impl<R: Real> TransferPlane<R> {
    /// A function of nodes and rows.
    ///
    /// # Errors
    /// The nodes of a row do not make a function, or rows are out of order.
    pub fn new(at: &[f64], opacity: &[f64], rows: &Rows) -> Result<Self, NodesError> {
        let [first, second] = &rows.over;
        piecewise::check::<R>(&rows.at, &vec![0.0; rows.at.len()])?;
        let line = |span: std::ops::Range<usize>| {
            let (at, opacity) = (&at[span.clone()], &opacity[span.clone()]);
            piecewise::check::<R>(at, opacity)?;
            let opacity = opacity.iter().map(|&a| R::from_f64(a)).collect();
            Ok(PlaneRow { stops: AxisStops::new(at, first.is_id()), opacity, first: span.start })
        };
        let lines = rows.spans(at.len()).map(line).collect::<Result<_, _>>()?;
        Ok(Self { rows: AxisStops::new(&rows.at, second.is_id()), lines })
    }

    /// The place of two coordinates. Returns none if α_u is 0, or if a label has no row or node there. A row without
    /// a node at a label has opacity 0 and does not affect the colour.
    #[inline]
    pub fn locate(&self, x: Coordinate<R>, y: Coordinate<R>) -> Option<NodePatch<R>> {
        let (row, w) = self.rows.find(y)?;
        let below = self.lines[row].place(x);
        let above = if w == R::ZERO { None } else { self.lines[row + 1].place(x) };
        let alone =
            |place: NodePlace<R>, share: R| NodePatch { rows: [place; 2], w: R::ZERO, alpha_u: share * place.alpha_u };
        let patch = match (below, above) {
            (Some(a), Some(b)) => NodePatch { rows: [a, b], w, alpha_u: R::lerp(a.alpha_u, b.alpha_u, w) },
            (Some(a), None) => alone(a, R::ONE - w),
            (None, Some(b)) => alone(b, w),
            (None, None) => return None,
        };
        (patch.alpha_u > R::ZERO).then_some(patch)
    }
}

impl<R: Real> PlaneRow<R> {
    #[inline]
    fn place(&self, x: Coordinate<R>) -> Option<NodePlace<R>> {
        let (k, w) = self.stops.find(x)?;
        let o = self.opacity[k];
        let alpha_u = if w == R::ZERO { o } else { R::lerp(o, self.opacity[k + 1], w) };
        Some(NodePlace { node: self.first + k, w, alpha_u })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Coordinate::{Id, Number};
    use drypoint_scene::tables::Axis;
    use proptest::prelude::*;

    fn rows(over: [Axis<u32>; 2], at: &[f64], first: &[usize]) -> Rows {
        Rows { over, at: at.to_vec(), first: first.to_vec(), normalized: false }
    }

    #[test]
    fn a_full_grid_by_hand() {
        // α_u = 0, 0.2 along the row at 0 and 0.4, 0.8 along the row at 10; a quarter across and half way down.
        let rows = rows([Axis::Value, Axis::GradientMagnitude], &[0.0, 10.0], &[0, 2]);
        let plane = TransferPlane::<f64>::new(&[0.0, 4.0, 0.0, 4.0], &[0.0, 0.2, 0.4, 0.8], &rows).unwrap();
        let patch = plane.locate(Number(1.0), Number(5.0)).unwrap();
        let place = |node, alpha_u| NodePlace { node, w: 0.25, alpha_u };
        assert_eq!((patch.rows, patch.w), ([place(0, 0.05), place(2, 0.5)], 0.5));
        assert!((patch.alpha_u - 0.275).abs() < f64::EPSILON);
        // A place on a row depends on this row alone. The last row holds beyond itself.
        for y in [10.0, 1e9] {
            assert_eq!(plane.locate(Number(1.0), Number(y)).unwrap().rows, [place(2, 0.5); 2]);
        }
        assert_eq!(plane.locate(Number(0.0), Number(-1.0)), None, "α_u = 0 at the node");
    }

    #[test]
    fn a_step_from_row_to_row_shows_the_later_row_at_its_place() {
        let rows = rows([Axis::Value, Axis::Distance(Default::default())], &[0.0, 5.0, 5.0], &[0, 1, 2]);
        let plane = TransferPlane::<f64>::new(&[0.0; 3], &[0.25, 0.25, 0.5], &rows).unwrap();
        let alpha = |y| plane.locate(Number(0.0), Number(y)).map(|p| (p.rows[0].node, p.alpha_u));
        assert_eq!([alpha(5f64.next_down()), alpha(5.0)], [Some((0, 0.25)), Some((2, 0.5))]);
    }

    #[test]
    fn labels_are_chosen_never_interpolated() {
        let rows = rows([Axis::Value, Axis::Label], &[3.0, 7.0], &[0, 2]);
        let plane = TransferPlane::<f64>::new(&[0.0, 10.0, 5.0], &[0.0, 1.0, 0.5], &rows).unwrap();
        let at = |x, id| plane.locate(Number(x), Id(id)).map(|p| (p.rows[0].node, p.rows[0].w, p.w, p.alpha_u));
        assert_eq!(at(5.0, 3), Some((0, 0.5, 0.0, 0.5)));
        assert_eq!(at(5.0, 7), Some((2, 0.0, 0.0, 0.5)));
        assert_eq!([at(5.0, 4), at(5.0, 0), at(5.0, 8)], [None; 3]);
    }

    #[test]
    fn labels_along_a_row() {
        // Rows at the values 0 and 10; the label 2 is in the second alone.
        let rows = rows([Axis::Label, Axis::Value], &[0.0, 10.0], &[0, 1]);
        let plane = TransferPlane::<f64>::new(&[1.0, 1.0, 2.0], &[0.5, 1.0, 1.0], &rows).unwrap();
        let at = |id, y| plane.locate(Id(id), Number(y)).map(|p| (p.rows.map(|r| r.node), p.w, p.alpha_u));
        assert_eq!(at(1, 5.0), Some(([0, 1], 0.5, 0.75)));
        assert_eq!(at(2, 2.5), Some(([2, 2], 0.0, 0.25)));
        assert_eq!([at(2, 0.0), at(3, 5.0)], [None; 2]);
    }

    #[test]
    fn what_is_no_function_is_refused() {
        let over = || [Axis::Value, Axis::GradientMagnitude];
        let new = |at: &[f64], rows: Rows| TransferPlane::<f32>::new(at, &vec![1.0; at.len()], &rows).map(|_| ());
        assert!(matches!(new(&[2.0, 1.0], rows(over(), &[0.0], &[0])), Err(NodesError::Order { .. })));
        assert!(matches!(new(&[1.0, 1.0], rows(over(), &[1.0, 0.0], &[0, 1])), Err(NodesError::Order { .. })));
        assert_eq!(new(&[], rows(over(), &[], &[])), Err(NodesError::Empty));
        assert!(matches!(new(&[1e39], rows(over(), &[0.0], &[0])), Err(NodesError::Range { .. })));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        /// The α_u of a full grid is the bilinear form of 4.2, of the four nodes about the place.
        #[test]
        fn the_bilinear_form(
            mut xs in prop::collection::vec(0..30i32, 1..5),
            mut ys in prop::collection::vec(0..30i32, 1..5),
            opacity in prop::collection::vec(0.0..=1.0f64, 16),
            x in -5.0..35.0f64, y in -5.0..35.0f64,
        ) {
            for axis in [&mut xs, &mut ys] {
                axis.sort_unstable();
                axis.dedup();
            }
            let at: Vec<f64> = ys.iter().flat_map(|_| &xs).map(|&x| f64::from(x)).collect();
            let starts: Vec<usize> = (0..ys.len()).map(|j| j * xs.len()).collect();
            let stands: Vec<f64> = ys.iter().map(|&y| f64::from(y)).collect();
            let rows = rows([Axis::Value, Axis::GradientMagnitude], &stands, &starts);
            let plane = TransferPlane::new(&at, &opacity[..at.len()], &rows).unwrap();
            // i and w of 4.1, clamped to the nodes.
            let index = |stops: &[i32], x: f64| {
                let k = stops.iter().rposition(|&a| f64::from(a) <= x).unwrap_or(0);
                let [a, b] = [k, (k + 1).min(stops.len() - 1)].map(|k| f64::from(stops[k]));
                (k, (k + 1).min(stops.len() - 1), if b > a { ((x - a) / (b - a)).max(0.0) } else { 0.0 })
            };
            let ((x0, x1, wx), (y0, y1, wy)) = (index(&xs, x), index(&ys, y));
            let o = |i: usize, j: usize| opacity[j * xs.len() + i];
            let want = (o(x0, y0) * (1.0 - wx) + o(x1, y0) * wx) * (1.0 - wy)
                + (o(x0, y1) * (1.0 - wx) + o(x1, y1) * wx) * wy;
            let got = plane.locate(Number(x), Number(y)).map_or(0.0, |patch| patch.alpha_u);
            prop_assert!((got - want).abs() < 4.0 * f64::EPSILON, "{got} {want}");
        }
    }
}
