//! `[stipples.curves]`: silhouette curves ([STIP-13]).

use super::kinds::{SHARE, SIGNED};
use crate::document::describe::{Key, Slot, Table};
use crate::document::kind::{Bounds, Choice, ChoiceOption, Number};

/// The table `[stipples.curves]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curves {
    /// Which voxels get a segment.
    pub test: CurvesTest,
    /// Width of the lines of `two-sided`, in voxels to either side.
    pub c: f64,
    /// Th_eye of `literal`.
    pub eye: f64,
    /// Th_grad.
    pub grad: f64,
    /// Th_LOG.
    pub log: f64,
}

/// The second of the three conditions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurvesTest {
    /// |n·E| < c·‖∇(n·E)‖·voxel: one voxel wide at any curvature.
    TwoSided,
    /// n·E < Th_eye: the paper's.
    Literal,
}

impl Default for Curves {
    fn default() -> Self {
        Self { test: CurvesTest::TwoSided, c: 0.75, eye: 0.0, grad: 0.2, log: 0.12 }
    }
}

/// The description of `[stipples.curves]`.
pub(super) static CURVES: Table<Curves> = Table::new(
    "[stipples.curves]",
    "Lines where surfaces turn away: a segment through every voxel with V·LoG(V) < log, ‖∇V‖ > grad and a normal \
     across the view.",
    Curves::default,
    &[
        Key::new(
            "test",
            "STIP-13",
            "What a normal across the view is.",
            &Slot {
                kind: Choice {
                    options: &[
                        ChoiceOption::new(
                            "two-sided",
                            CurvesTest::TwoSided,
                            "|n·E| < c·‖∇(n·E)‖·voxel: lines one voxel wide at any curvature.",
                        ),
                        ChoiceOption::new("literal", CurvesTest::Literal, "n·E < eye: the paper's."),
                    ],
                    later: &[],
                },
                get: |t: &Curves| Some(t.test),
                set: |t, v| t.test = v,
            },
        ),
        Key::new(
            "c",
            "STIP-13",
            "How far to either side a line of test = \"two-sided\" reaches, in voxels.",
            &Slot {
                kind: Number { bounds: Bounds::POSITIVE, unit: "" },
                get: |t: &Curves| Some(t.c),
                set: |t, v| t.c = v,
            },
        ),
        Key::new(
            "eye",
            "STIP-13",
            "Th_eye of test = \"literal\"; 0 keeps the half that faces away.",
            &Slot { kind: SIGNED, get: |t: &Curves| Some(t.eye), set: |t, v| t.eye = v },
        ),
        Key::new(
            "grad",
            "STIP-13",
            "Th_grad, of ‖∇V‖.",
            &Slot { kind: SHARE, get: |t: &Curves| Some(t.grad), set: |t, v| t.grad = v },
        ),
        Key::new(
            "log",
            "STIP-13",
            "Th_LOG, of V times the Laplacian of Gaussian over its largest magnitude.",
            &Slot { kind: SIGNED, get: |t: &Curves| Some(t.log), set: |t, v| t.log = v },
        ),
    ],
);
