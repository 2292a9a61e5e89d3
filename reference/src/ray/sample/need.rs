//! The needs of samples beyond their value.
//!
//! The loop over samples is compiled for values alone and for anything else: quantities of few scenes would cost unshaded
//! pictures the registers that they compute in.

use super::PreparedObject;
use crate::number::Real;
use drypoint_scene::shot::SampleQuery;

/// The need of a shot, which decides what it is cast by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Needs {
    /// The value alone: an unshaded picture.
    Value,
    /// The normal: a picture under Blinn–Phong.
    Normal,
    /// Everything that a scene can call for.
    Anything,
}

impl Needs {
    /// The least that is enough; `more` is [`Need::MORE`].
    pub(crate) fn new(query: SampleQuery, more: bool) -> Self {
        match (query, more) {
            (SampleQuery::VALUE, false) => Self::Value,
            (SampleQuery::NORMAL, false) => Self::Normal,
            _ => Self::Anything,
        }
    }
}

/// A need that the loop is compiled for.
pub(crate) trait Need {
    /// Whether there can be more than a colour for each value: a function over two quantities or from a table, |g|,
    /// styles, layers, and compositing of encoded colours.
    const MORE: bool;

    /// The query of visible samples.
    fn query<R: Real>(object: &PreparedObject<'_, R>) -> SampleQuery;
}

/// The value alone: an unshaded picture.
pub(crate) enum Value {}

/// Everything that a scene can call for.
pub(crate) enum Anything {}

impl Need for Value {
    const MORE: bool = false;

    #[inline(always)]
    fn query<R: Real>(_: &PreparedObject<'_, R>) -> SampleQuery {
        SampleQuery::VALUE
    }
}

impl Need for Anything {
    const MORE: bool = true;

    #[inline(always)]
    fn query<R: Real>(object: &PreparedObject<'_, R>) -> SampleQuery {
        object.query
    }
}
