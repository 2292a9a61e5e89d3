//! Interactive volume illustration (Nagy, Schneider and Westermann 2002): what the paper and the specification say of strokes.

mod outlines;
