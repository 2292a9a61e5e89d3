//! What the samples of a scene need beyond their value.
//!
//! The loop over samples is compiled for each of three needs: what few scenes ask for would cost the others the registers
//! that they compute in.

use super::prepared::{Calls, Prepared};
use crate::number::Real;

/// The need that the loop is compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Needs {
    /// [`Value`].
    Value,
    /// [`Normal`].
    Normal,
    /// [`Anything`].
    Anything,
}

impl Needs {
    /// The least that is enough; `more` is [`Need::MORE`].
    pub(super) fn new(calls: Calls, more: bool) -> Self {
        match (calls, more) {
            (Calls::NONE, false) => Self::Value,
            (Calls::NORMAL, false) => Self::Normal,
            _ => Self::Anything,
        }
    }
}

/// One of [`Needs`], as a type.
pub(super) trait Need {
    /// Whether there can be more than a colour for each value: a function over two quantities or from a table, |g|,
    /// styles, layers, and compositing of encoded colours.
    const MORE: bool;

    /// What visible samples have to know.
    fn calls<R: Real>(prepared: &Prepared<'_, R>) -> Calls;
}

/// The value alone: an unshaded picture.
pub(super) enum Value {}

/// The normal: a shaded picture.
pub(super) enum Normal {}

/// Whatever a scene can call for.
pub(super) enum Anything {}

impl Need for Value {
    const MORE: bool = false;

    #[inline(always)]
    fn calls<R: Real>(_: &Prepared<'_, R>) -> Calls {
        Calls::NONE
    }
}

impl Need for Normal {
    const MORE: bool = false;

    #[inline(always)]
    fn calls<R: Real>(_: &Prepared<'_, R>) -> Calls {
        Calls::NORMAL
    }
}

impl Need for Anything {
    const MORE: bool = true;

    #[inline(always)]
    fn calls<R: Real>(prepared: &Prepared<'_, R>) -> Calls {
        prepared.calls
    }
}
