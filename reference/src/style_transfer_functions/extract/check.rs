//! Checks of numbers that a user enters.

use super::{ExtractError, LARGEST};

/// Checks a coordinate.
///
/// # Errors
/// The value is not finite or lies beyond all pictures.
pub(super) fn number(name: impl Into<String>, value: f64) -> Result<f64, ExtractError> {
    if value.abs() <= LARGEST { Ok(value) } else { Err(ExtractError::Number { name: name.into(), value }) }
}

/// Checks a length.
///
/// # Errors
/// The errors of [`number`], or the value is not positive.
pub(super) fn positive(name: &'static str, value: f64) -> Result<f64, ExtractError> {
    if number(name, value)? > 0.0 { Ok(value) } else { Err(ExtractError::NotPositive { name, value }) }
}
