//! Bruckner and Gröller, Style Transfer Functions for Illustrative Volume Rendering, Computer Graphics Forum 26(3),
//! 2007.
