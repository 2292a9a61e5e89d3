//! VolumeShop (Bruckner and Gröller 2005).

mod painting;
