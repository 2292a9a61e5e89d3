//! `[stipples.curves]`: silhouette curves ([STIP-13]).

use super::kinds::{SHARE, SIGNED};
use crate::document::declare::{choices, table};
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Number};

table! {
    /// The table `[stipples.curves]`.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Curves {
        /// The test for a normal across the view.
        test: CurvesTest = CurvesTest::TwoSided, key("STIP-13", CurvesTest::KIND);
        /// Reach of a line of test = "two-sided" to either side, in voxels.
        c: f64 = 0.75, key("STIP-13", Number { bounds: Bounds::POSITIVE, unit: "" });
        /// Th_eye of test = "literal"; 0 keeps the half that faces away.
        eye: f64 = 0.0, key("STIP-13", SIGNED);
        /// Th_grad, of ‖∇V‖.
        grad: f64 = 0.2, key("STIP-13", SHARE);
        /// Th_LOG, of V times the Laplacian of Gaussian over its largest magnitude.
        log: f64 = 0.12, key("STIP-13", SIGNED);
    }
}

choices! {
    /// The second of the three conditions.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum CurvesTest {
        /// |n·E| < c·‖∇(n·E)‖·voxel: lines one voxel wide at any curvature.
        TwoSided = "two-sided",
        /// n·E < eye: the paper's.
        Literal = "literal",
    }
}

/// The description of `[stipples.curves]`.
pub(super) static CURVES: Table<Curves> = Curves::description(
    "[stipples.curves]",
    "Lines where surfaces turn away: a segment through every voxel with V·LoG(V) < log, ‖∇V‖ > grad and a normal \
     across the view.",
);
