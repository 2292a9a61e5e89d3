//! `[[halo]]`: volumetric halos ([HALO-1] … [HALO-8], Bruckner and Gröller 2007).

mod focus;
mod profile;
mod seed;
mod spread;
mod table;
#[cfg(test)]
mod tests;

pub use focus::{FocusPoints, HaloFocus};
pub use profile::ProfileNode;
pub use seed::{SeedBy, SeedDirection, SeedValue, Seeding};
pub use spread::{HaloSource, Spreading};
pub(crate) use table::TABLE;
pub use table::{Exponents, Halo, HaloAccumulation, HaloKind};
