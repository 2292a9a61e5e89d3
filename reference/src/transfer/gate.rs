//! Values at which a transfer function over two quantities can be visible, for any value of the other quantity
//! ([RAY-2], [STF-4]).

use super::piecewise::{NodesError, Piecewise};
use crate::number::Real;
use drypoint_scene::transfer::{Rows, gate};

/// Returns a function over the value that is above 0 at least wherever the function over two quantities can be. The
/// other quantity is evaluated only there. See [`gate::over_value`].
pub fn over_value<R: Real>(at: &[f64], opacity: &[f64], rows: &Rows) -> Result<Piecewise<R>, NodesError> {
    let [at, opacity] = gate::over_value(at, opacity, rows, |at| R::from_f64(at).to_f64());
    Piecewise::new(&at, &opacity)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transfer::{Coordinate, TransferPlane};
    use drypoint_scene::tables::Axis;
    use proptest::prelude::*;

    fn rows(over: [Axis<u32>; 2], at: &[f64], first: &[usize]) -> Rows {
        Rows { over, at: at.to_vec(), first: first.to_vec(), normalized: false }
    }

    fn open<R: Real>(gate: &Piecewise<R>, values: &[f64]) -> Vec<bool> {
        values.iter().map(|&v| gate.locate(R::from_f64(v)).is_some()).collect()
    }

    #[test]
    fn what_rows_leave_clear_stays_shut() {
        // A step on 100 in one row, a ramp down from 20 to 30 in the other: both ends are told to the last bit.
        let rows = rows([Axis::Value, Axis::GradientMagnitude], &[0.0, 5.0], &[0, 4]);
        let (at, opacity) = ([0.0, 100.0, 100.0, 255.0, 20.0, 30.0], [0.0, 0.0, 0.5, 0.5, 0.5, 0.0]);
        let gate = over_value::<f64>(&at, &opacity, &rows).unwrap();
        let values = [-5.0, 20.0, 30f64.next_down(), 30.0, 99.0, 100f64.next_down(), 100.0, 300.0];
        assert_eq!(open(&gate, &values), [true, true, true, false, false, false, true, true]);
        // A ramp that begins at 10 is invisible at 10.
        let ramp = over_value::<f64>(&[10.0, 20.0], &[0.0, 1.0], &self::rows(rows.over.clone(), &[0.0], &[0])).unwrap();
        assert_eq!(open(&ramp, &[9.0, 10.0, 10f64.next_up(), 20.0]), [false, false, true, true]);
    }

    #[test]
    fn values_from_row_to_row_and_no_values() {
        let at = [1.0, 2.0, 1.0, 2.0, 1.0, 2.0];
        let opacity = [0.0, 0.0, 0.0, 0.3, 0.0, 0.0];
        let down = rows([Axis::K1, Axis::Value], &[10.0, 20.0, 30.0], &[0, 2, 4]);
        let gate = over_value::<f32>(&at, &opacity, &down).unwrap();
        assert_eq!(open(&gate, &[10.0, 10.5, 20.0, 29.5, 30.0]), [false, true, true, true, false]);
        let neither = rows([Axis::K1, Axis::K2], &[10.0, 20.0, 30.0], &[0, 2, 4]);
        assert_eq!(open(&over_value::<f64>(&at, &opacity, &neither).unwrap(), &[-1e9, 0.0, 7.0]), [true; 3]);
        assert_eq!(open(&over_value::<f64>(&at, &[0.0; 6], &neither).unwrap(), &[0.0]), [false]);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(400))]
        /// The gate is open wherever the function is visible for some second quantity. It is shut where no row is
        /// visible, at a value or on either side of it.
        #[test]
        fn open_wherever_something_can_be_seen(
            lines in prop::collection::vec(prop::collection::vec((0..20u8, prop_oneof![Just(0.0), Just(0.0), 0.1..1.0f64]), 1..4), 1..4),
            extra in 0.0..20.0f64,
            swapped in any::<bool>(),
        ) {
            let (mut at, mut opacity, mut first) = (Vec::new(), Vec::new(), Vec::new());
            for mut line in lines.clone() {
                line.sort_by_key(|node| node.0);
                first.push(at.len());
                at.extend(line.iter().map(|n| 0.1 + f64::from(n.0)));
                opacity.extend(line.iter().map(|n| n.1));
            }
            let over = if swapped { [Axis::K1, Axis::Value] } else { [Axis::Value, Axis::K1] };
            let stands: Vec<f64> = (0..lines.len()).map(|i| 0.1 + 3.0 * i as f64).collect();
            let rows = rows(over, &stands, &first);
            let (gate, plane) = (over_value::<f32>(&at, &opacity, &rows).unwrap(), TransferPlane::<f32>::new(&at, &opacity, &rows).unwrap());
            let nodes = at.iter().chain(&stands).flat_map(|&a| [(a as f32).next_down(), a as f32, (a as f32).next_up()]);
            for value in nodes.chain([extra as f32]) {
                let others = (0..200).map(|i| Coordinate::Number(i as f32 * 0.1));
                let seen = others.into_iter().any(|other| {
                    let value = Coordinate::Number(value);
                    let [x, y] = if swapped { [other, value] } else { [value, other] };
                    plane.locate(x, y).is_some()
                });
                let open = gate.locate(value).is_some();
                prop_assert!(open || !seen, "{value}");
                if !swapped && open {
                    // Some row is visible at the value or within rounding of it.
                    let near = [value.next_down(), value, value.next_up()];
                    let rows_seen = |v: f32| (0..lines.len()).any(|i| plane.locate(Coordinate::Number(v), Coordinate::Number(stands[i] as f32)).is_some());
                    prop_assert!(near.into_iter().any(rows_seen), "{value}");
                }
            }
        }
    }
}
