//! The numbers over which the sample code is generic: f64, the truth, and f32, which shows what less precision costs
//! ([PREC-1]).

mod arithmetic;
mod bounded;
mod decision;
pub(crate) mod lanes;
mod mat3;
mod real;
mod sym3;
mod vec3;
pub mod ways;

pub(crate) use arithmetic::Double;
pub use arithmetic::{Arithmetic, Elementary, Mask};
pub use bounded::Bounded;
pub use decision::Decision;
pub use mat3::Mat3;
pub use real::{Real, RowOfFour};
pub use sym3::Sym3;
pub use vec3::Vec3;
