//! The effects, each with the counts that it alone makes. A paper adds its own lines.

use super::scenes::{LABEL_ROWS, OUTLINES, REGULAR, ROWS, STIPPLES, STROKES, STYLE};

/// Keys of a scene and their values, as `--set` takes them; `{folder}` is where `labels.nrrd` is.
pub(super) type Settings = &'static [(&'static str, &'static str)];

/// One effect: a scene without it, the same scene with it, and what may differ in their counts.
pub(super) struct Effect {
    /// What a reader calls it.
    pub(super) name: &'static str,
    /// What in a scene asks for it.
    pub(super) asked_by: &'static str,
    /// The scene that both have.
    pub(super) base: &'static str,
    /// Settings of the scene that lacks it.
    pub(super) without: Settings,
    /// Settings of the scene that has it.
    pub(super) with: Settings,
    /// Counts that are 0 without it.
    pub(super) only: &'static [&'static str],
    /// The same of those that the data decide on.
    pub(super) perhaps: &'static [&'static str],
    /// Counts that grow with it.
    pub(super) more: &'static [&'static str],
    /// Counts that it is there to make smaller.
    pub(super) fewer: &'static [&'static str],
    /// Counts of what is another one with it, and may have more or less of everything.
    pub(super) others: &'static [&'static str],
}

/// What every picture with halos has: states of its rays and of those that ask for seeds, images, and the range of |g|.
const OF_HALOS: &[&str] = &[
    "halo_samples",
    "halo_passes",
    "gradients",
    "preprocess.gradients",
    "bytes.halos",
    "bytes.rays",
    "bytes.seed_rays",
    "bytes.skip_seeds",
];

/// A halo by opacity.
const HALO: Settings = &[("halo", "[{ kind = \"occlusive\" }]")];

/// An effect over [`STYLE`] that adds nothing which is counted.
const NOTHING: Effect = Effect {
    name: "",
    asked_by: "",
    base: STYLE,
    without: &[],
    with: &[],
    only: &[],
    perhaps: &[],
    more: &[],
    fewer: &[],
    others: &[],
};

/// Every effect that exists.
pub(super) const EFFECTS: &[Effect] = &[
    Effect {
        name: "Blinn–Phong shading",
        asked_by: "`[shading]`",
        base: REGULAR,
        with: &[("shading.model", "phong")],
        only: &["gradients"],
        ..NOTHING
    },
    Effect {
        name: "shading in tones",
        asked_by: "`shading.model = \"toon\"`",
        base: REGULAR,
        with: &[("shading.model", "toon")],
        only: &["gradients"],
        ..NOTHING
    },
    Effect {
        name: "shading by a lighting function",
        asked_by: "`shading.model = \"lighting-function\"`",
        base: REGULAR,
        with: &[("shading.model", "lighting-function")],
        only: &["gradients"],
        ..NOTHING
    },
    Effect {
        name: "a lighting function that enhances opacities",
        asked_by: "`shading.preset`, with contours or `\"gradient\"`",
        base: REGULAR,
        without: &[("shading.model", "lighting-function")],
        with: &[("shading.model", "lighting-function"), ("shading.preset", "gradient")],
        only: &["preprocess.gradients"],
        // What is more opaque ends rays earlier.
        others: &["gradients", "samples", "without_normal"],
        ..NOTHING
    },
    Effect {
        name: "silhouettes on shading",
        asked_by: "`[shading.silhouette]`",
        base: REGULAR,
        without: &[("shading.model", "toon")],
        with: &[("shading.model", "toon"), ("shading.silhouette.offset", "0.45")],
        ..NOTHING
    },
    Effect {
        name: "silhouettes and tones of no light",
        asked_by: "`[shading.silhouette]`",
        base: REGULAR,
        without: &[("shading.model", "toon"), ("shading.toon.tones", "[[0, \"white\"]]")],
        with: &[
            ("shading.model", "toon"),
            ("shading.toon.tones", "[[0, \"white\"]]"),
            ("shading.silhouette.offset", "0.45"),
        ],
        only: &["gradients"],
        ..NOTHING
    },
    Effect {
        name: "view-dependent opacity",
        asked_by: "`shading.view_opacity`",
        base: REGULAR,
        without: &[("shading.model", "toon"), ("shading.toon.tones", "[[0, \"white\"]]")],
        with: &[("shading.model", "toon"), ("shading.toon.tones", "[[0, \"white\"]]"), ("shading.view_opacity", "0.1")],
        only: &["gradients"],
        ..NOTHING
    },
    Effect {
        name: "contours of a constant threshold",
        asked_by: "`contours.kappa = \"none\"`",
        with: &[("contours.kappa", "none")],
        ..NOTHING
    },
    Effect {
        name: "contours with κ along the ray",
        asked_by: "`contours.kappa = \"ray\"`",
        with: &[("contours.kappa", "ray")],
        more: &["gradients"],
        ..NOTHING
    },
    Effect {
        name: "contours with the exact κ",
        asked_by: "`contours.kappa = \"exact\"`",
        with: &[("contours.kappa", "exact")],
        only: &["hessians", "bytes.smoothed"],
        ..NOTHING
    },
    Effect {
        name: "contours that fade",
        asked_by: "`contours.fade`",
        without: &[("contours.kappa", "none")],
        with: &[("contours.kappa", "none"), ("contours.fade", "[0.1, 0.2]")],
        only: &["preprocess.gradients"],
        ..NOTHING
    },
    Effect {
        name: "illustrative transparency",
        asked_by: "`transfer.transparency = \"illustrative\"`",
        with: &[("transfer.transparency", "illustrative")],
        only: &["preprocess.gradients"],
        ..NOTHING
    },
    Effect {
        name: "mip-maps of styles, by the gradient",
        asked_by: "`[style_mipmaps]`",
        with: &[("style_mipmaps.curvature_bias", "0")],
        only: &["bytes.style_mipmaps", "preprocess.gradients"],
        ..NOTHING
    },
    Effect {
        name: "mip-maps of styles, by curvature too",
        asked_by: "`style_mipmaps.curvature_bias`",
        without: &[("style_mipmaps.curvature_bias", "0")],
        with: &[("style_mipmaps.curvature_bias", "1")],
        more: &["gradients"],
        ..NOTHING
    },
    Effect {
        name: "a function over the gradient's magnitude",
        asked_by: "`transfer.over`",
        base: REGULAR,
        with: &[
            ("transfer.nodes", "off"),
            ("transfer.over", "[\"value\", \"gradient-magnitude\"]"),
            ("transfer.rows", ROWS),
        ],
        only: &["gradients"],
        ..NOTHING
    },
    Effect {
        name: "a function over a distance",
        asked_by: "`transfer.over`",
        base: REGULAR,
        with: &[
            ("transfer.nodes", "off"),
            ("transfer.over", "[\"value\", { distance = [48, 48, 48] }]"),
            ("transfer.rows", ROWS),
        ],
        ..NOTHING
    },
    Effect {
        name: "a function over a curvature",
        asked_by: "`transfer.over`",
        base: REGULAR,
        with: &[("transfer.nodes", "off"), ("transfer.over", "[\"value\", \"k1\"]"), ("transfer.rows", ROWS)],
        only: &["gradients", "hessians", "bytes.smoothed"],
        ..NOTHING
    },
    Effect {
        name: "a function over labels",
        asked_by: "`volume.labels`",
        base: REGULAR,
        with: &[
            ("volume.labels", "{folder}/labels.nrrd"),
            ("transfer.nodes", "off"),
            ("transfer.over", "[\"value\", \"label\"]"),
            ("transfer.rows", LABEL_ROWS),
        ],
        only: &["bytes.labels"],
        ..NOTHING
    },
    Effect {
        name: "a function over the distance to a label",
        asked_by: "`transfer.over`",
        base: REGULAR,
        with: &[
            ("volume.labels", "{folder}/labels.nrrd"),
            ("transfer.nodes", "off"),
            ("transfer.over", "[\"value\", { distance_to_label = 1 }]"),
            ("transfer.rows", ROWS),
        ],
        only: &["bytes.labels", "bytes.label distance", "preprocess.label distances"],
        ..NOTHING
    },
    Effect {
        name: "a function over a further volume",
        asked_by: "`transfer.over`",
        base: REGULAR,
        with: &[
            ("transfer.nodes", "off"),
            ("transfer.over", "[\"value\", { volume = \"{folder}/labels.nrrd\" }]"),
            ("transfer.rows", ROWS),
        ],
        only: &["bytes.further volume"],
        ..NOTHING
    },
    Effect {
        name: "the layer `normal`",
        asked_by: "`picture.layers`",
        base: REGULAR,
        with: &[("picture.layers", "[\"beauty\", \"normal\"]")],
        only: &["gradients"],
        more: &["bytes.picture"],
        ..NOTHING
    },
    Effect {
        name: "the layer `curvature`",
        asked_by: "`picture.layers`",
        base: REGULAR,
        with: &[("picture.layers", "[\"beauty\", \"curvature\"]")],
        only: &["gradients", "hessians", "bytes.smoothed"],
        more: &["bytes.picture"],
        ..NOTHING
    },
    Effect {
        name: "the layer `first.normal`",
        asked_by: "`picture.layers`",
        base: REGULAR,
        with: &[("picture.layers", "[\"beauty\", \"first.normal\"]")],
        only: &["gradients"],
        more: &["bytes.picture"],
        ..NOTHING
    },
    Effect {
        name: "gradients by regression",
        asked_by: "`sampling.gradient = \"regression\"`",
        with: &[("sampling.gradient", "regression")],
        only: &["bytes.regression"],
        ..NOTHING
    },
    Effect {
        name: "prefiltered B-splines",
        asked_by: "`sampling.kernel = \"bspline\"`",
        base: REGULAR,
        // Without bricks both kernels have the same samples.
        without: &[("sampling.skip_empty", "false")],
        with: &[("sampling.skip_empty", "false"), ("sampling.kernel", "bspline")],
        only: &["bytes.coefficients"],
        ..NOTHING
    },
    Effect {
        name: "empty space left out",
        asked_by: "`sampling.skip_empty`, the default",
        base: REGULAR,
        without: &[("sampling.skip_empty", "false")],
        only: &["bytes.bricks", "bytes.skip"],
        more: &["rays_skipped"],
        fewer: &["samples"],
        ..NOTHING
    },
    Effect {
        name: "rays that end where little is left to see",
        asked_by: "`sampling.stop_below = 0.5`",
        base: REGULAR,
        with: &[("sampling.stop_below", "0.5")],
        fewer: &["samples"],
        ..NOTHING
    },
    Effect {
        name: "four rays a pixel",
        asked_by: "`picture.samples = 2`",
        base: REGULAR,
        with: &[("picture.samples", "2")],
        more: &["rays", "rays_skipped", "samples"],
        ..NOTHING
    },
    Effect {
        name: "nine rays in a pixel at an edge",
        asked_by: "`picture.samples = \"auto\"`, the default",
        base: REGULAR,
        with: &[("picture.samples", "auto")],
        only: &["refined_pixels", "bytes.refinement"],
        more: &["rays", "samples"],
        ..NOTHING
    },
    Effect {
        name: "an opaque iso-surface",
        asked_by: "`[surface]`",
        base: REGULAR,
        with: &[("surface.iso", "120")],
        only: &["bytes.surface"],
        fewer: &["samples"],
        ..NOTHING
    },
    Effect {
        name: "an iso-surface that is lit",
        asked_by: "`surface.look = \"phong\"`",
        base: REGULAR,
        without: &[("surface.iso", "120")],
        with: &[("surface.iso", "120"), ("surface.look", "phong")],
        only: &["gradients"],
        ..NOTHING
    },
    Effect {
        name: "an iso-surface in tones",
        asked_by: "`surface.look = \"toon\"`",
        base: REGULAR,
        without: &[("surface.iso", "120")],
        with: &[("surface.iso", "120"), ("surface.look", "toon")],
        only: &["gradients"],
        ..NOTHING
    },
    Effect {
        name: "silhouettes of an iso-surface",
        asked_by: "`[surface.silhouette]`",
        base: REGULAR,
        without: &[("surface.iso", "120")],
        with: &[("surface.iso", "120"), ("surface.silhouette.offset", "0.45")],
        only: &["gradients"],
        ..NOTHING
    },
    Effect {
        name: "dots over the volume",
        asked_by: "`[stipples]`",
        base: REGULAR,
        with: &[("stipples.threshold", "0.3")],
        only: &["points", "bytes.points", "preprocess.stipple gradients", "preprocess.stipple points"],
        ..NOTHING
    },
    Effect {
        name: "fewer dots inside",
        asked_by: "`[stipples.interior]`",
        base: STIPPLES,
        with: &[("stipples.interior.te", "0.5")],
        fewer: &["points"],
        ..NOTHING
    },
    Effect {
        name: "dots in the shade",
        asked_by: "`[stipples.lighting]`",
        base: STIPPLES,
        with: &[("stipples.lighting.le", "1")],
        fewer: &["points"],
        ..NOTHING
    },
    Effect {
        name: "one layer of dots a face",
        asked_by: "`stipples.thin`",
        base: STIPPLES,
        with: &[("stipples.thin", "true")],
        fewer: &["points", "bytes.points", "preprocess.stipple points"],
        ..NOTHING
    },
    Effect {
        name: "silhouette curves",
        asked_by: "`[stipples.curves]`",
        base: STIPPLES,
        with: &[("stipples.curves.grad", "0.3")],
        only: &["preprocess.curve Hessians", "strokes"],
        more: &["preprocess.stipple gradients"],
        ..NOTHING
    },
    Effect {
        name: "hidden dots",
        asked_by: "`stipples.hide_behind`",
        base: STIPPLES,
        with: &[("stipples.hide_behind", "120")],
        only: &["bytes.surface", "preprocess.hidden points"],
        fewer: &["points"],
        ..NOTHING
    },
    Effect {
        name: "outlines over the volume",
        asked_by: "`[outlines]`",
        base: REGULAR,
        with: &[("outlines.iso", "120"), ("outlines.min_length", "2 px")],
        only: &["strokes", "bytes.surface", "preprocess.looks for what hides", "preprocess.outline places"],
        perhaps: &["preprocess.outline places without a root", "preprocess.short strokes"],
        ..NOTHING
    },
    Effect {
        name: "creases",
        asked_by: "`outlines.crease`",
        base: OUTLINES,
        with: &[("outlines.crease", "20 deg")],
        only: &["bytes.smoothed bricks of creases", "preprocess.crease places"],
        perhaps: &["preprocess.crease places without a crest"],
        more: &["preprocess.looks for what hides"],
        // Creases join outlines to longer ones, and many creases are short.
        others: &["strokes", "preprocess.short strokes"],
        ..NOTHING
    },
    Effect {
        name: "strokes over the volume",
        asked_by: "`[hatching]`",
        base: REGULAR,
        with: &[("hatching.iso", "120"), ("hatching.seeds", "dense")],
        only: &[
            "strokes",
            "directions",
            "bytes.pyramid",
            "bytes.smoothed bricks",
            "bytes.surface",
            "preprocess.looks for what hides",
            "preprocess.pyramid",
            "preprocess.seeds",
        ],
        perhaps: &[
            "preprocess.directions at σ = 1",
            "preprocess.directions at σ = 2",
            "preprocess.directions at σ = 4",
            "preprocess.estimates near the border",
            "preprocess.estimates of umbilics",
            "preprocess.estimates that disagree",
            "preprocess.estimates within the noise",
            "preprocess.seeds beside the surface",
            "preprocess.seeds of strokes without length",
            "preprocess.seeds without a direction",
            "preprocess.seeds without a stroke",
            "preprocess.steps put back",
            "preprocess.strokes cut where they dip",
            "stops.angle",
            "stops.direction",
            "stops.turns",
        ],
        ..NOTHING
    },
    Effect {
        name: "directions stored at voxels",
        asked_by: "`hatching.directions.from = \"stored\"`",
        base: STROKES,
        with: &[("hatching.directions.from", "stored")],
        only: &[
            "bytes.stored directions",
            "preprocess.directions between stored ones",
            "preprocess.places without stored directions",
            "preprocess.stored directions",
        ],
        // A voxel's is computed once, and not counted among those of places.
        fewer: &["preprocess.directions at σ = 1", "preprocess.directions at σ = 2", "preprocess.directions at σ = 4"],
        // Strokes along other directions are other strokes.
        others: &[
            "strokes",
            "directions",
            "bytes.smoothed bricks",
            "preprocess.estimates near the border",
            "preprocess.estimates of umbilics",
            "preprocess.estimates that disagree",
            "preprocess.estimates within the noise",
            "preprocess.looks for what hides",
            "preprocess.seeds of strokes without length",
            "preprocess.seeds without a direction",
            "preprocess.seeds without a stroke",
            "preprocess.steps put back",
            "preprocess.strokes cut where they dip",
            "stops.angle",
            "stops.direction",
            "stops.turns",
        ],
        ..NOTHING
    },
    Effect {
        name: "strokes that nothing hides",
        asked_by: "`hatching.hidden = \"drawn\"`",
        base: STROKES,
        with: &[("hatching.hidden", "drawn")],
        more: &["strokes"],
        fewer: &["bytes.surface", "preprocess.looks for what hides"],
        ..NOTHING
    },
    Effect {
        name: "gaps where strokes cross",
        asked_by: "`hatching.gap`",
        base: STROKES,
        with: &[("hatching.gap", "2 px")],
        only: &["preprocess.segments with gaps"],
        fewer: &["strokes"],
        ..NOTHING
    },
    Effect {
        name: "strokes inside a translucent volume",
        asked_by: "`hatching.hidden = \"merged\"`",
        base: REGULAR,
        without: &[("hatching.iso", "120"), ("hatching.seeds", "dense"), ("hatching.hidden", "drawn")],
        with: &[("hatching.iso", "120"), ("hatching.seeds", "dense"), ("hatching.hidden", "merged")],
        only: &["bytes.lines on rays", "preprocess.places of lines on rays"],
        // A ray ends at an opaque stroke.
        fewer: &["samples"],
        ..NOTHING
    },
    Effect {
        name: "a moved object",
        asked_by: "`[[object]]` with `move`",
        base: REGULAR,
        with: &[("object", "[{ value = [[110, 0], [130, 1]], move = [8, 0, 0] }]")],
        // Its own samples, and rays that its ghost ends elsewhere.
        more: &["samples"],
        others: &["rays_skipped"],
        ..NOTHING
    },
    Effect {
        name: "a halo, seeded by the opacity",
        asked_by: "`[[halo]]`",
        base: REGULAR,
        with: HALO,
        only: OF_HALOS,
        ..NOTHING
    },
    Effect {
        name: "four halos in place of one",
        asked_by: "`[[halo]]`",
        base: REGULAR,
        without: HALO,
        with: &[("halo", "[{ kind = \"occlusive\" }, {}, {}, {}]")],
        more: &["halo_passes", "bytes.halos"],
        ..NOTHING
    },
    Effect {
        name: "a halo over groups of four planes",
        asked_by: "`halo.every`",
        base: REGULAR,
        without: HALO,
        with: &[("halo", "[{ kind = \"occlusive\", every = 4 }]")],
        fewer: &["halo_passes"],
        ..NOTHING
    },
    Effect {
        name: "a halo, seeded by curvature",
        asked_by: "`halo.seed.by`",
        base: REGULAR,
        without: HALO,
        with: &[("halo", "[{ kind = \"occlusive\", seed = { by = \"curvature\" } }]")],
        // A second normal on each ray, and seeds on other planes.
        more: &["gradients"],
        others: &["halo_passes"],
        ..NOTHING
    },
    Effect {
        name: "a halo of one label",
        asked_by: "`halo.seed.labels`",
        base: REGULAR,
        without: HALO,
        with: &[
            ("volume.labels", "{folder}/labels.nrrd"),
            ("halo", "[{ kind = \"occlusive\", seed = { value = \"opacity\", labels = [1] } }]"),
        ],
        only: &["bytes.labels"],
        // Seeds outside of the label are looked for no further.
        fewer: &["gradients"],
        others: &["halo_samples", "halo_passes", "bytes.seed_rays", "bytes.skip_seeds"],
        ..NOTHING
    },
];
