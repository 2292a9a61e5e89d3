//! Numbers that the sample code is generic over: f64, the truth, and f32, for the price list ([PREC-1]).

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
