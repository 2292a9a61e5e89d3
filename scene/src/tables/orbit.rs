//! `[orbit]`: several frames about the volume ([STIP-4]).

use crate::document::declare::table;
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Number, Whole};

table! {
    /// The table `[orbit]`.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Orbit {
        /// Number of frames.
        frames: usize = 36, key("STIP-4", Whole { lo: 1, hi: MOST_FRAMES });
        /// Angle by which the camera turns over all frames; below 0 to the left.
        ///
        /// In degrees.
        degrees: f64 = 360.0, key("STIP-4", Number { bounds: Bounds::ANY, unit: ", in degrees" });
        /// Frames a second of a GIF, an APNG or an animated SVG.
        fps: usize = 10, key("STIP-4", Whole { lo: 1, hi: MOST_FPS });
    }
}

/// The most frames: as many as six digits can number.
const MOST_FRAMES: u64 = 1_000_000;

/// The most frames a second. Viewers slow down a GIF whose frames take less than two hundredths.
const MOST_FPS: u64 = 50;

/// The description of `[orbit]`.
pub(crate) static TABLE: Table<Orbit> = Orbit::description(
    "[orbit]",
    "Several frames: the camera turns about `camera.up` through `camera.target`, to the right as seen by itself. The \
     frames are numbered from 0, which is the camera of the scene, and end one step before `degrees`, so that a full \
     turn can be shown again and again.",
);
