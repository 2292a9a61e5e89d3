//! `[[halo]]`: volumetric halos (Bruckner and Gröller 2007).

use crate::document::declare::choices;

choices! {
    /// The way a halo enters the picture ([HALO-7]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum HaloKind {
        /// A light or dark fog of its own, before what lies behind.
        Emissive = "emissive",
        /// A tint of what lies behind, seen only there.
        Occlusive = "occlusive",
    }
}

choices! {
    /// The image that is spread ([HALO-4]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum HaloSource {
        /// The gradient magnitude of the seeds: small features keep their halo.
        Gradient = "gradient",
        /// The seeds themselves.
        Seeds = "seeds",
    }
}

choices! {
    /// How seeds of several planes come together ([HALO-8]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum HaloAccumulation {
        /// The largest.
        Max = "max",
        /// Their mean.
        Mean = "mean",
    }
}
