//! `[orbit]`: several frames about the volume ([STIP-4]).

use crate::document::describe::{Key, Slot, Table};
use crate::document::kind::{Bounds, Number, Whole};

/// The table `[orbit]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// Number of frames.
    pub frames: usize,
    /// What all of them turn by, in degrees.
    pub degrees: f64,
}

impl Default for Orbit {
    fn default() -> Self {
        Self { frames: 36, degrees: 360.0 }
    }
}

/// The most frames: as many as six digits can number.
const MOST_FRAMES: u64 = 1_000_000;

/// The description of `[orbit]`.
pub(crate) static TABLE: Table<Orbit> = Table::new(
    "[orbit]",
    "Several frames: the camera turns about `camera.up` through `camera.target`, to the right as seen by itself. The \
     frames are numbered from 0, which is the camera of the scene, and end one step before `degrees`, so that a full \
     turn can be shown again and again.",
    Orbit::default,
    &[
        Key::new(
            "frames",
            "STIP-4",
            "Number of frames.",
            &Slot {
                kind: Whole { lo: 1, hi: MOST_FRAMES },
                get: |o: &Orbit| Some(o.frames as u64),
                set: |o, v| o.frames = v as usize,
            },
        ),
        Key::new(
            "degrees",
            "STIP-4",
            "What the camera turns by over all frames; below 0 to the left.",
            &Slot {
                kind: Number { bounds: Bounds::ANY, unit: ", in degrees" },
                get: |o: &Orbit| Some(o.degrees),
                set: |o, v| o.degrees = v,
            },
        ),
    ],
);
