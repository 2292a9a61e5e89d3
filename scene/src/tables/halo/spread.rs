//! `spread` of a halo: from the seeds of a plane to its intensities ([HALO-4], [HALO-5]).

use crate::document::declare::{choices, table};
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Flag, Lengths, Number, On, Whole};
use crate::tables::Length;

table! {
    /// The table `spread`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Spreading {
        /// The image that is spread.
        from: HaloSource = HaloSource::Gradient, key("HALO-4", HaloSource::KIND);
        /// N, the number of passes. Without `reach` a halo is at most 2^N − 1 pixels wide.
        passes: u64 = 4, key("HALO-5", Whole { lo: 0, hi: 12 });
        /// δ: the share of each pass. 0 leaves the image as it is, 1 only smooths it.
        delta: f64 = 0.8, key("HALO-5", Number { bounds: Bounds::UNIT, unit: "" });
        /// Whether a 3×3 median is taken of the seeds before, which removes single ones.
        median: bool = false, key("HALO-4", Flag);
        /// The largest width that a halo can have, on the page: a halo of this reach looks the same at every resolution.
        /// What is seen of it is narrower. Passes whose taps would be closer than a pixel are left out.
        reach: Option<Length> = None,
            key("HALO-5", Lengths { on: On::Picture, bounds: Bounds::POSITIVE }).absent("2^passes − 1 pixels");
    }
}

choices! {
    /// The image that is spread ([HALO-4]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum HaloSource {
        /// The gradient magnitude of the seeds: small features keep their halo.
        Gradient = "gradient",
        /// The seeds themselves.
        Seeds = "seeds",
    }
}

/// The description of `spread`.
pub(super) static TABLE: Table<Spreading> =
    Spreading::description("spread of a halo", "From the seeds of a plane to the intensities of a halo on it.");
