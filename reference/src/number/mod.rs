//! Numbers that the sample code is generic over: f64, the truth, and f32, for the price list ([PREC-1]).

mod arithmetic;
pub(crate) mod lanes;
mod mat3;
mod real;
mod sym3;
mod vec3;

pub(crate) use arithmetic::Double;
pub use arithmetic::{Arithmetic, Elementary, Mask};
pub use mat3::Mat3;
pub use real::Real;
pub use sym3::Sym3;
pub use vec3::Vec3;
