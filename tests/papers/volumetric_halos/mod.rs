//! Volumetric halos (Bruckner and Gröller 2007).

mod by_hand;
mod counts;
mod invariance;
mod planes;
