//! The papers, checked in pictures of phantoms whose truth is known: one file a paper.

#[path = "../common/mod.rs"]
mod common;

mod interactive_volume_illustration;
mod style_transfer_functions;
mod volume_stippling;
mod volumeshop;
mod volumetric_halos;
