//! Annotations of a picture: labels beside it, each joined by a leader line to its anchor in it (Bruckner and Gröller
//! 2005, 6.4; [VS-10]).
//!
//! Coordinates are those of one page, in any unit of length and with either direction of y.

use glam::DVec2;

/// A label to be placed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Annotation {
    /// The point that the label names.
    pub anchor: DVec2,
    /// Eye depth of the anchor. Labels of nearer anchors have priority.
    pub depth: f64,
    /// Width and height of the label's box, including the margin that separates it from other boxes and the hull.
    /// Both are positive.
    pub size: DVec2,
}

/// A page with labels to be placed.
#[derive(Clone, Debug, PartialEq)]
pub struct AnnotatedPage {
    /// The labels.
    pub annotations: Vec<Annotation>,
    /// Points of which labels surround the convex hull: the projected corners of bounding volumes.
    pub outline: Vec<DVec2>,
    /// Lower and upper corner of the rectangle that labels do not leave.
    pub frame: [DVec2; 2],
    /// Rectangles that labels do not cover, each by its lower and upper corner.
    pub obstacles: Vec<[DVec2; 2]>,
    /// The largest number of rounds in which conflicts are resolved. At most 1024 are made.
    pub rounds: usize,
    /// o_min: opacity of the leader line of the farthest anchor.
    pub least_opacity: f64,
}

/// The reason why a label is hidden. Labels are named by their places in the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hidden {
    /// Its box overlaps the box of this label.
    Overlap(usize),
    /// Its leader line crosses this label's leader line, or one of both lines runs through the box of the other label.
    Crossing(usize),
    /// Its anchor, its box or its leader line leaves the frame, or its box covers an obstacle.
    OutsideFrame,
    /// Columns only: no column has room beside the hull and the obstacles, or the boxes of nearer labels fill it.
    NoRoom,
    /// The numbers of the page are too large or too small to compute with.
    OutOfRange,
    /// One of its numbers is not finite, or its size is not positive.
    Invalid,
}

/// A label's place. A label without [`home`](Self::home) has all points at its anchor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedAnnotation {
    /// t ∈ [0, 1): direction of the first point of [`leader`](Self::leader), in turns from x towards y. It is seen from
    /// the hull's centroid, in columns from the middle of the hull's bounding box.
    pub t: f64,
    /// t of the label's place if no conflict moves the label: the hull point near the anchor, in columns the bend level
    /// with the anchor. The next layout starts from it. In columns t of the left one is from ¼ to ¾. None if the label is
    /// [`Hidden::Invalid`] or [`Hidden::OutOfRange`], if its anchor is outside the frame, or if its box is too large for
    /// each column.
    pub home: Option<f64>,
    /// Lower and upper corner of the box.
    pub corners: [DVec2; 2],
    /// The ends of the leader line's second segment: its bend and its end at the box. The first segment joins the anchor
    /// to the bend, which is a point of the hull, or in columns a point before the column.
    pub leader: [DVec2; 2],
    /// Opacity of the leader line: 1 at the nearest anchor, o_min at the farthest.
    pub opacity: f64,
    /// Why the label is hidden; none if it is shown.
    pub hidden: Option<Hidden>,
}

/// A change of a label's t that does not follow from the motion of its anchor and the hull. Labels are named by their
/// places in the list. Labels that are hidden are not named.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relocation {
    /// Two labels exchanged their hull points, because their lines crossed or both anchors are nearer now. In columns,
    /// they exchanged their order in one column.
    Exchange(usize, usize),
    /// A label moved along the hull out of a conflict.
    Nudge(usize),
    /// A label moved back towards its home, because a conflict ended.
    Return(usize),
    /// A label moved to a hull point that is nearer by more than the margin that keeps it on its side, or its home moved
    /// by more than this margin in one step. In columns, it moved to the other column.
    ChangeOfSide(usize),
}

/// The places of a page's labels, in the order of the list.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AnnotationLayout {
    /// The places.
    pub annotations: Vec<PlacedAnnotation>,
    /// The relocations since the previous layout, each once. Without a previous layout, the relocations from the nearest
    /// hull points, or from columns in the order of the anchors.
    pub relocations: Vec<Relocation>,
}
