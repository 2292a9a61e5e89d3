//! Nagy, Schneider and Westermann 2002: what the paper and the specification say, in pictures and strokes of phantoms whose
//! truth is known.

mod outlines;
mod toon;
