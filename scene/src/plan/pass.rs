//! The passes of a plan.

/// A pass over the volume or the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Pass {
    /// The connected parts of the volume, of which some are kept ([VOL-2]).
    Parts,
    /// Coefficients of a prefiltered B-spline ([REC-1]).
    Coefficients,
    /// Coefficients of the B-spline of the smoothed grid ([REC-3]).
    SmoothedCoefficients,
    /// A kernel that smooths: it does not interpolate the voxels ([REC-1]).
    SmoothingKernel,
    /// The quantile of ‖g‖ over the voxels, if `gradient_range` gives no numbers ([VAL-2]).
    GradientRange,
    /// The automatic transfer function, from values and their differences between neighbours.
    AutomaticTransfer,
    /// The automatic iso-value, from values and their differences between neighbours.
    AutomaticIso,
    /// The distance of every voxel to a label ([STF-4]).
    LabelDistances,
    /// The ranges of bricks, by which empty space is skipped ([RAY-2]).
    Bricks,
    /// The mip chains of the styles ([STF-10]).
    StyleMipmaps,
    /// ‖∇V‖ and V of stippling ([STIP-1]).
    StippleGradients,
    /// The points of stippling, relaxed and in order ([STIP-4]).
    StipplePoints,
    /// The voxels in which silhouette curves can be ([STIP-13]).
    CurveVoxels,
    /// The label of each voxel's dots.
    DotLabels,
    /// The colour of each voxel's dots ([STIP-16]).
    DotColors,
    /// A factor of stippling that no camera changes ([STIP-7], [STIP-11]).
    StillFactor,
    /// The rays themselves.
    Rays,
    /// The ends of rays, points and lines at clip planes ([RAY-8]).
    Clip,
    /// Further rays at edges ([RAY-7]).
    Refinement,
    /// The memberships of selections ([VS-2]).
    Selections,
    /// The look-ups of selections where they are moved ([VS-2]).
    MovedSelections,
    /// The depths up to which rays cut the background ([VS-7]).
    Cutaways,
    /// The maps of smooth cutaways ([VS-7]).
    Funnels,
    /// The colours of places where objects meet ([VS-4]).
    Intersections,
    /// The seeds of halos on the planes of samples ([HALO-2], [HALO-3]).
    HaloSeeds,
    /// From seeds to the intensities of halos, group of planes by group ([HALO-4], [HALO-5]).
    HaloSpreading,
    /// A factor of stippling that the camera changes ([STIP-8] … [STIP-12]).
    Factor,
    /// The dots of a frame ([STIP-5], [STIP-6]).
    Dots,
    /// The points that an iso-surface hides ([STIP-15]).
    HiddenPoints,
    /// The choice of dots on the page ([STIP-19]).
    DotsOnPage,
    /// The silhouette curves of a frame.
    Curves,
    /// The creases of an iso-surface ([HATCH-22]).
    Creases,
    /// The outlines of a frame ([HATCH-18]).
    Outlines,
    /// The ranges that lead to the cells of an iso-surface ([HATCH-5]).
    Pyramid,
    /// The cells in which the transfer function shows something ([HATCH-16]).
    SeenCells,
    /// Gradient and curvature about these cells, by which seeds are drawn ([HATCH-6]).
    SeedMeasures,
    /// Principal directions at voxels, where strokes ask for them ([HATCH-4], [HATCH-5]).
    StoredDirections,
    /// Principal directions at all voxels.
    AllDirections,
    /// The strokes of hatching ([HATCH-8]).
    Strokes,
    /// Strokes that cross the first ones ([HATCH-11]).
    CrossStrokes,
    /// The choice of strokes that keeps a distance on the page ([HATCH-19]).
    Spacing,
    /// The colours of strokes in the light ([HATCH-12]).
    LitStrokes,
    /// The parts of strokes that an iso-surface hides ([HATCH-14]).
    HiddenStrokes,
    /// Strokes inside the picture of the volume ([HATCH-14]).
    MergedStrokes,
    /// Gaps in strokes where nearer lines cross them ([HATCH-20]).
    Gaps,
    /// Boxes, arrows, fans, labels, scale bar, orientation and legend ([VS-8], [VS-10]).
    Annotations,
}

impl Pass {
    /// Passes that depend on the distance between rays, so that all pixels need equally many rays.
    pub(crate) const OF_EQUAL_RAYS: [Self; 3] = [Self::HaloSeeds, Self::StyleMipmaps, Self::MergedStrokes];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Parts => "connected parts",
            Self::Coefficients => "B-spline coefficients",
            Self::SmoothedCoefficients => "smoothed coefficients",
            Self::SmoothingKernel => "smoothing kernel",
            Self::GradientRange => "range of |g|",
            Self::AutomaticTransfer => "automatic function",
            Self::AutomaticIso => "automatic iso-value",
            Self::LabelDistances => "distances to a label",
            Self::Bricks => "brick ranges",
            Self::StyleMipmaps => "style mip-maps",
            Self::StippleGradients => "stipple gradients",
            Self::StipplePoints => "stipple points",
            Self::CurveVoxels => "voxels of curves",
            Self::DotLabels => "labels of dots",
            Self::DotColors => "colours of dots",
            Self::StillFactor => "factor, once",
            Self::Rays => "rays",
            Self::Clip => "clip planes",
            Self::Refinement => "rays at edges",
            Self::Selections => "selections",
            Self::MovedSelections => "moved selections",
            Self::Cutaways => "cut depths",
            Self::Funnels => "funnels",
            Self::Intersections => "intersections",
            Self::HaloSeeds => "halo seeds",
            Self::HaloSpreading => "halo spreading",
            Self::Factor => "factor, a frame",
            Self::Dots => "dots",
            Self::HiddenPoints => "hidden points",
            Self::DotsOnPage => "choice on the page",
            Self::Curves => "curves",
            Self::Creases => "creases",
            Self::Outlines => "outlines",
            Self::Pyramid => "pyramid",
            Self::SeenCells => "cells that are seen",
            Self::SeedMeasures => "measures of seeds",
            Self::StoredDirections => "stored directions",
            Self::AllDirections => "directions at all voxels",
            Self::Strokes => "strokes",
            Self::CrossStrokes => "crossing strokes",
            Self::Spacing => "spacing of strokes",
            Self::LitStrokes => "lit strokes",
            Self::HiddenStrokes => "hidden strokes",
            Self::MergedStrokes => "merged strokes",
            Self::Gaps => "gaps of strokes",
            Self::Annotations => "annotations",
        }
    }

    /// The work that the pass adds to a picture.
    pub fn adds(self) -> &'static str {
        match self {
            Self::Parts => "two looks at each voxel, three numbers a run of voxels along x",
            Self::Coefficients => "one filter along each axis, one number a voxel",
            Self::SmoothedCoefficients => "two filters along each axis, one number a voxel",
            Self::SmoothingKernel => "64 voxels a sample; teeth and terraces between voxels are rounded",
            Self::GradientRange => "one gradient a voxel",
            Self::AutomaticTransfer | Self::AutomaticIso => "one look at each voxel and its neighbours",
            Self::LabelDistances => "one search a voxel of the labels, one number each",
            Self::Bricks => "one look at each voxel",
            Self::StyleMipmaps => "one look at each texel of a style, a third of it more to keep",
            Self::StippleGradients => "one gradient a voxel",
            Self::StipplePoints => "one order a voxel with points",
            Self::CurveVoxels => "one gradient and one Hessian a voxel",
            Self::DotLabels => "one look at the labels a voxel with points",
            Self::DotColors => "one colour a voxel with points",
            Self::StillFactor => "one number a voxel with points",
            Self::Rays => "samples² rays a pixel; \"auto\": one, or four everywhere",
            Self::Clip => "one look at the planes a ray, a point and a vertex of a line",
            Self::Refinement => "four rays a pixel that differs from a neighbour, four more if 5 differ",
            Self::Selections => "one membership a sample in the selection's box",
            Self::MovedSelections => "a second look-up a sample in the moved selection's box",
            Self::Cutaways => "one box a ray; with cut = \"object\" the samples of the object, once more",
            Self::Funnels => "a depth a pixel and in a band about the picture, one filter along each axis",
            Self::Intersections => "two colours and one light a sample where both are",
            Self::HaloSeeds => "one look at each sample whose value may seed, seen or not; a number a ray",
            Self::HaloSpreading => "a filter of all rays a pass, once a group of planes; two numbers a ray",
            Self::Factor => "one number a voxel with points",
            Self::Dots => "a count and a size a voxel with points, a place a dot",
            Self::HiddenPoints => "one look at each voxel, once; a search and a line towards the eye a point",
            Self::DotsOnPage => "four candidates a dot, each with its neighbours",
            Self::Curves => "one test a voxel of curves",
            Self::Creases => "smoothed grids and a curvature a voxel of the surface, two searches a place of a crease",
            Self::Outlines => "a value and a gradient a voxel of the surface, a search a place of an outline",
            Self::Pyramid => "one look at each voxel, two bytes every eight",
            Self::SeenCells => "one look at the function a cell of the blocks that may be seen",
            Self::SeedMeasures => "one gradient and one direction a voxel of the surface",
            Self::StoredDirections => "one direction a voxel of the cells that strokes enter",
            Self::AllDirections => "one direction a voxel",
            Self::Strokes => "some ten to a hundred directions a stroke, smoothed grids where they are asked for",
            Self::CrossStrokes => "as many for each second stroke",
            Self::Spacing => "one look every half pen's width of a stroke",
            Self::LitStrokes => "two powers a vertex of a stroke, and vertices between them where colours change",
            Self::HiddenStrokes => "one look at each voxel, once; a line towards the eye every half pixel of a stroke",
            Self::MergedStrokes => "40 bytes a ray that a stroke is on, and one more sample where it is in the volume",
            Self::Gaps => "one look at its neighbours on the page a segment of a line",
            Self::Annotations => {
                "a ray a pixel of a line that the volume may hide, and 128² rays if labels ask what is seen"
            }
        }
    }

    /// Most bytes of memory that the pass takes, while it runs, for each voxel of the volume. Small needs count as 0.
    pub fn bytes_a_voxel(self) -> u64 {
        match self {
            // One number of 64 bits.
            Self::Coefficients | Self::LabelDistances => 8,
            // A filter reads one copy and writes another.
            Self::SmoothedCoefficients => 16,
            // Runs are counted before they are kept.
            Self::Parts => 0,
            // Norms are counted row by row.
            Self::GradientRange => 0,
            Self::AutomaticTransfer | Self::AutomaticIso | Self::Bricks | Self::StyleMipmaps => 0,
            Self::SmoothingKernel | Self::Rays | Self::Refinement => 0,
            // A norm each, and what a fit smooths.
            Self::StippleGradients => 16,
            // Made of few voxels, or known once those are ([`PointsPlan`](super::PointsPlan)).
            Self::StipplePoints | Self::DotLabels | Self::DotColors => 0,
            Self::StillFactor | Self::Factor | Self::Dots | Self::Curves => 0,
            Self::Clip | Self::HaloSeeds | Self::HaloSpreading => 0,
            Self::Cutaways | Self::Funnels | Self::Intersections | Self::MovedSelections => 0,
            // One number of 64 bits, where bricks differ.
            Self::Selections => 8,
            Self::HiddenPoints
            | Self::DotsOnPage
            | Self::Creases
            | Self::Outlines
            | Self::HiddenStrokes
            | Self::Gaps
            | Self::Annotations => 0,
            // At most a cell a voxel: where it is, its p, and once more if a stroke begins there.
            Self::SeenCells => 56,
            // Of the cells of a surface alone.
            Self::SeedMeasures | Self::CrossStrokes | Self::Spacing | Self::LitStrokes | Self::MergedStrokes => 0,
            Self::Pyramid => 1,
            // Two directions and two curvatures, in blocks where there are any.
            Self::StoredDirections | Self::AllDirections => 64,
            // Three scales of smoothed numbers and as many to compare with, where strokes are.
            Self::Strokes => 48,
            Self::CurveVoxels => 16,
        }
    }
}
