//! Errors of regions and of the styles extracted from them.

use super::LARGEST;

/// Errors of extraction.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExtractError {
    /// The side is 0, or larger than a style may be.
    #[error("a side of {side} texels is not between 1 and {limit}")]
    Side {
        /// The side asked for.
        side: usize,
        /// The largest side.
        limit: usize,
    },
    /// A coordinate or a length is not a number, or lies beyond all pictures.
    #[error("{name} is {value}: it must be a number between -{LARGEST:e} and {LARGEST:e}")]
    Number {
        /// The name of the number.
        name: String,
        /// The value given.
        value: f64,
    },
    /// A radius or a half axis is not positive.
    #[error("{name} is {value}: it must be above 0")]
    NotPositive {
        /// The name of the length.
        name: &'static str,
        /// The value given.
        value: f64,
    },
    /// An outline has fewer than three different points.
    #[error("an outline of {found} different points encloses nothing")]
    TooFewPoints {
        /// Number of different points in a row.
        found: usize,
    },
    /// An outline has too many points.
    #[error("an outline of {found} points: at most {limit} are read")]
    TooManyPoints {
        /// Number of points.
        found: usize,
        /// The largest number of points.
        limit: usize,
    },
    /// An outline crosses or touches itself, so that it has no inside.
    #[error("the outline crosses itself: the line from point {} meets the one from point {}", edges[0] + 1, edges[1] + 1)]
    Crossing {
        /// The points, counted from 0, at which the two lines begin.
        edges: [usize; 2],
    },
    /// The region does not overlap the picture.
    #[error("the region lies outside the picture of {width} × {height} pixels")]
    Outside {
        /// Pixels from left to right.
        width: usize,
        /// Pixels from top to bottom.
        height: usize,
    },
    /// No pixel of the picture has its centre in the region.
    #[error("the region holds no pixel of the picture")]
    Empty,
}

impl ExtractError {
    /// One line of advice.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Side { .. } => "256 is enough for most pictures",
            Self::Number { .. } => "give pixels of the picture, counted from its upper left corner",
            Self::NotPositive { .. } => "give it in pixels of the picture",
            Self::TooFewPoints { .. } => "give the points of the outline in their order; 30 make a smooth one",
            Self::TooManyPoints { .. } => "leave most of them out: 100 make a smooth outline",
            Self::Crossing { .. } => "give the points in their order round the shape",
            Self::Outside { .. } => "x is counted from the left, y from the top, both in pixels",
            Self::Empty => "give a larger region, or scale the picture up",
        }
    }
}
