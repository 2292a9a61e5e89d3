//! Numbers that a person gives.

use super::{ExtractError, LARGEST};

/// A coordinate.
///
/// # Errors
/// Values that are not finite or lie beyond all pictures.
pub(super) fn number(name: impl Into<String>, value: f64) -> Result<f64, ExtractError> {
    if value.abs() <= LARGEST { Ok(value) } else { Err(ExtractError::Number { name: name.into(), value }) }
}

/// A length.
///
/// # Errors
/// The errors of [`number`], and values that are not positive.
pub(super) fn positive(name: &'static str, value: f64) -> Result<f64, ExtractError> {
    if number(name, value)? > 0.0 { Ok(value) } else { Err(ExtractError::NotPositive { name, value }) }
}
