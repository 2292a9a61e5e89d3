//! Sheets of points and lines as other programs see them: SVG by librsvg, PDF by poppler, and both parsed back.

mod annotations;
mod figures;
mod numbers;
mod outside;
mod poppler;
// The other binaries use the rest.
#[allow(dead_code)]
#[path = "../common/random.rs"]
mod random;
mod rsvg;
mod sample;
mod text;
mod vpype;
