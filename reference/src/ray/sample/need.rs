//! The needs of samples beyond their value.
//!
//! The loop over samples is compiled twice, for values alone and for everything else. Quantities that few scenes need
//! would otherwise cost unshaded pictures registers.

use super::PreparedObject;
use crate::number::Real;
use drypoint_scene::shot::SampleQuery;

/// The need of a shot, by which the compiled loop is chosen.
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
    /// The least need that is sufficient. `more` is [`Need::MORE`].
    pub(crate) fn new(query: SampleQuery, more: bool) -> Self {
        match (query, more) {
            (SampleQuery::VALUE, false) => Self::Value,
            (SampleQuery::NORMAL, false) => Self::Normal,
            _ => Self::Anything,
        }
    }
}

/// A need for which the loop is compiled.
pub(crate) trait Need {
    /// Whether more may be needed than a colour for each value: a function over two quantities or from a table, |g|,
    /// styles, layers, or encoded compositing.
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
