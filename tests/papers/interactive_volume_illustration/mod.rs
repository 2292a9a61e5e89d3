//! Nagy, Schneider and Westermann 2002, in pictures of phantoms whose truth is known.

mod toon;
