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

impl Effect {
    /// Returns the beginning of its row on the page.
    pub(super) fn first_cell(&self) -> String {
        format!("| {}<br>{} |", self.name, self.asked_by)
    }
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

/// An effect that adds nothing which is counted.
const NOTHING: Effect = Effect {
    name: "",
    asked_by: "",
    base: "",
    without: &[],
    with: &[],
    only: &[],
    perhaps: &[],
    more: &[],
    fewer: &[],
    others: &[],
};

/// The effects, a few lines each: the name, what asks for it, the scene of both, and the fields that are not empty.
macro_rules! effects {
    ($($name:literal by $asked_by:literal on $base:ident: $($field:ident $value:tt),*;)*) => {
        &[$(Effect { name: $name, asked_by: $asked_by, base: $base, $($field: &$value,)* ..NOTHING }),*]
    };
}

/// Every effect that exists.
pub(super) const EFFECTS: &[Effect] = effects! {
    "Blinn–Phong shading" by "`[shading]`" on REGULAR: with [("shading.model", "phong")], only ["gradients"];
    "shading in tones" by "`shading.model = \"toon\"`" on REGULAR: with [("shading.model", "toon")], only ["gradients"];
    "shading by a lighting function" by "`shading.model = \"lighting-function\"`" on REGULAR:
        with [("shading.model", "lighting-function")], only ["gradients"];
    "a lighting function that enhances opacities" by "`shading.preset`, with contours or `\"gradient\"`" on REGULAR:
        without [("shading.model", "lighting-function")],
        with [("shading.model", "lighting-function"), ("shading.preset", "gradient")], only ["preprocess.gradients"],
        // What is more opaque ends rays earlier.
        others ["gradients", "samples", "without_normal"];
    "silhouettes on shading" by "`[shading.silhouette]`" on REGULAR:
        without [("shading.model", "toon")], with [("shading.model", "toon"), ("shading.silhouette.offset", "0.45")];
    "silhouettes and tones of no light" by "`[shading.silhouette]`" on REGULAR:
        without [("shading.model", "toon"), ("shading.toon.tones", "[[0, \"white\"]]")],
        with [("shading.model", "toon"), ("shading.toon.tones", "[[0, \"white\"]]"),
            ("shading.silhouette.offset", "0.45")], only ["gradients"];
    "view-dependent opacity" by "`shading.view_opacity`" on REGULAR:
        without [("shading.model", "toon"), ("shading.toon.tones", "[[0, \"white\"]]")],
        with [("shading.model", "toon"), ("shading.toon.tones", "[[0, \"white\"]]"), ("shading.view_opacity", "0.1")],
        only ["gradients"];
    "contours of a constant threshold" by "`contours.kappa = \"none\"`" on STYLE: with [("contours.kappa", "none")];
    "contours with κ along the ray" by "`contours.kappa = \"ray\"`" on STYLE:
        with [("contours.kappa", "ray")], more ["gradients"];
    "contours with the exact κ" by "`contours.kappa = \"exact\"`" on STYLE:
        with [("contours.kappa", "exact")], only ["hessians", "bytes.smoothed"];
    "contours that fade" by "`contours.fade`" on STYLE:
        without [("contours.kappa", "none")], with [("contours.kappa", "none"), ("contours.fade", "[0.1, 0.2]")],
        only ["preprocess.gradients"];
    "illustrative transparency" by "`transfer.transparency = \"illustrative\"`" on STYLE:
        with [("transfer.transparency", "illustrative")], only ["preprocess.gradients"];
    "mip-maps of styles, by the gradient" by "`[style_mipmaps]`" on STYLE:
        with [("style_mipmaps.curvature_bias", "0")], only ["bytes.style_mipmaps", "preprocess.gradients"];
    "mip-maps of styles, by curvature too" by "`style_mipmaps.curvature_bias`" on STYLE:
        without [("style_mipmaps.curvature_bias", "0")], with [("style_mipmaps.curvature_bias", "1")],
        more ["gradients"];
    "a function over the gradient's magnitude" by "`transfer.over`" on REGULAR:
        with [("transfer.nodes", "off"), ("transfer.over", "[\"value\", \"gradient-magnitude\"]"),
            ("transfer.rows", ROWS)], only ["gradients"];
    "a function over a distance" by "`transfer.over`" on REGULAR:
        with [("transfer.nodes", "off"), ("transfer.over", "[\"value\", { distance = [48, 48, 48] }]"),
            ("transfer.rows", ROWS)];
    "a function over a curvature" by "`transfer.over`" on REGULAR:
        with [("transfer.nodes", "off"), ("transfer.over", "[\"value\", \"k1\"]"), ("transfer.rows", ROWS)],
        only ["gradients", "hessians", "bytes.smoothed"];
    "a function over labels" by "`volume.labels`" on REGULAR:
        with [("volume.labels", "{folder}/labels.nrrd"), ("transfer.nodes", "off"),
            ("transfer.over", "[\"value\", \"label\"]"), ("transfer.rows", LABEL_ROWS)], only ["bytes.labels"];
    "a function over the distance to a label" by "`transfer.over`" on REGULAR:
        with [("volume.labels", "{folder}/labels.nrrd"), ("transfer.nodes", "off"),
            ("transfer.over", "[\"value\", { distance_to_label = 1 }]"), ("transfer.rows", ROWS)],
        only ["bytes.labels", "bytes.label distance", "preprocess.label distances"];
    "a function over a further volume" by "`transfer.over`" on REGULAR:
        with [("transfer.nodes", "off"), ("transfer.over", "[\"value\", { volume = \"{folder}/labels.nrrd\" }]"),
            ("transfer.rows", ROWS)], only ["bytes.further volume"];
    "the layer `normal`" by "`picture.layers`" on REGULAR:
        with [("picture.layers", "[\"beauty\", \"normal\"]")], only ["gradients"], more ["bytes.picture"];
    "the layer `curvature`" by "`picture.layers`" on REGULAR:
        with [("picture.layers", "[\"beauty\", \"curvature\"]")], only ["gradients", "hessians", "bytes.smoothed"],
        more ["bytes.picture"];
    "the layer `first.normal`" by "`picture.layers`" on REGULAR:
        with [("picture.layers", "[\"beauty\", \"first.normal\"]")], only ["gradients"], more ["bytes.picture"];
    "gradients by regression" by "`sampling.gradient = \"regression\"`" on STYLE:
        with [("sampling.gradient", "regression")], only ["bytes.regression"];
    "prefiltered B-splines" by "`sampling.kernel = \"bspline\"`" on REGULAR:
        // Without bricks both kernels have the same samples.
        without [("sampling.skip_empty", "false")],
        with [("sampling.skip_empty", "false"), ("sampling.kernel", "bspline")], only ["bytes.coefficients"];
    "empty space left out" by "`sampling.skip_empty`, the default" on REGULAR:
        without [("sampling.skip_empty", "false")], only ["bytes.bricks", "bytes.skip"], more ["rays_skipped"],
        fewer ["samples"];
    "rays that end where little is left to see" by "`sampling.stop_below = 0.5`" on REGULAR:
        with [("sampling.stop_below", "0.5")], fewer ["samples"];
    "four rays a pixel" by "`picture.samples = 2`" on REGULAR:
        with [("picture.samples", "2")], more ["rays", "rays_skipped", "samples"];
    "five or nine rays in a pixel at an edge" by "`picture.samples = \"auto\"`, the default" on REGULAR:
        with [("picture.samples", "auto")], only ["refined_pixels", "bytes.refinement"], more ["rays", "samples"];
    "an opaque iso-surface" by "`[surface]`" on REGULAR:
        with [("surface.iso", "120")], only ["bytes.surface"], fewer ["samples"];
    "an iso-surface that is lit" by "`surface.look = \"phong\"`" on REGULAR:
        without [("surface.iso", "120")], with [("surface.iso", "120"), ("surface.look", "phong")], only ["gradients"];
    "an iso-surface in tones" by "`surface.look = \"toon\"`" on REGULAR:
        without [("surface.iso", "120")], with [("surface.iso", "120"), ("surface.look", "toon")], only ["gradients"];
    "silhouettes of an iso-surface" by "`[surface.silhouette]`" on REGULAR:
        without [("surface.iso", "120")], with [("surface.iso", "120"), ("surface.silhouette.offset", "0.45")],
        only ["gradients"];
    "dots over the volume" by "`[stipples]`" on REGULAR:
        with [("stipples.threshold", "0.3")],
        only ["points", "bytes.points", "preprocess.stipple gradients", "preprocess.stipple points"];
    "fewer dots inside" by "`[stipples.interior]`" on STIPPLES:
        with [("stipples.interior.te", "0.5")], fewer ["points"];
    "dots in the shade" by "`[stipples.lighting]`" on STIPPLES: with [("stipples.lighting.le", "1")], fewer ["points"];
    "one layer of dots a face" by "`stipples.thin`" on STIPPLES:
        with [("stipples.thin", "true")], fewer ["points", "bytes.points", "preprocess.stipple points"];
    "silhouette curves" by "`[stipples.curves]`" on STIPPLES:
        with [("stipples.curves.grad", "0.3")], only ["preprocess.curve Hessians", "strokes"],
        more ["preprocess.stipple gradients"];
    "hidden dots" by "`stipples.hide_behind`" on STIPPLES:
        with [("stipples.hide_behind", "120")], only ["bytes.surface", "preprocess.hidden points"], fewer ["points"];
    "outlines over the volume" by "`[outlines]`" on REGULAR:
        with [("outlines.iso", "120"), ("outlines.min_length", "2 px")],
        only ["strokes", "bytes.surface", "preprocess.looks for what hides", "preprocess.outline places"],
        perhaps ["preprocess.outline places without a root", "preprocess.short strokes"];
    "creases" by "`outlines.crease`" on OUTLINES:
        with [("outlines.crease", "20 deg")], only ["bytes.smoothed bricks of creases", "preprocess.crease places"],
        perhaps ["preprocess.crease places without a crest"], more ["preprocess.looks for what hides"],
        // Creases join outlines to longer ones, and many creases are short.
        others ["strokes", "preprocess.short strokes"];
    "strokes over the volume" by "`[hatching]`" on REGULAR:
        with [("hatching.iso", "120"), ("hatching.seeds", "dense")],
        only ["strokes", "directions", "bytes.pyramid", "bytes.smoothed bricks", "bytes.surface",
            "preprocess.looks for what hides", "preprocess.pyramid", "preprocess.seeds"],
        perhaps ["preprocess.directions at σ = 1", "preprocess.directions at σ = 2", "preprocess.directions at σ = 4",
            "preprocess.estimates near the border", "preprocess.estimates of umbilics",
            "preprocess.estimates that disagree", "preprocess.estimates within the noise",
            "preprocess.seeds beside the surface", "preprocess.seeds of strokes without length",
            "preprocess.seeds without a direction", "preprocess.seeds without a stroke", "preprocess.steps put back",
            "preprocess.strokes cut where they dip", "stops.angle", "stops.direction", "stops.turns"];
    "directions stored at voxels" by "`hatching.directions.from = \"stored\"`" on STROKES:
        with [("hatching.directions.from", "stored")],
        only ["bytes.stored directions", "preprocess.directions between stored ones",
            "preprocess.places without stored directions", "preprocess.stored directions"],
        // A voxel's is computed once, and not counted among those of places.
        fewer ["preprocess.directions at σ = 1", "preprocess.directions at σ = 2", "preprocess.directions at σ = 4"],
        // Strokes along other directions are other strokes.
        others ["strokes", "directions", "bytes.smoothed bricks", "preprocess.estimates near the border",
            "preprocess.estimates of umbilics", "preprocess.estimates that disagree",
            "preprocess.estimates within the noise", "preprocess.looks for what hides",
            "preprocess.seeds of strokes without length", "preprocess.seeds without a direction",
            "preprocess.seeds without a stroke", "preprocess.steps put back", "preprocess.strokes cut where they dip",
            "stops.angle", "stops.direction", "stops.turns"];
    "strokes that nothing hides" by "`hatching.hidden = \"drawn\"`" on STROKES:
        with [("hatching.hidden", "drawn")], more ["strokes"],
        fewer ["bytes.surface", "preprocess.looks for what hides"];
    "gaps where strokes cross" by "`hatching.gap`" on STROKES:
        with [("hatching.gap", "2 px")], only ["preprocess.segments with gaps"], fewer ["strokes"];
    "strokes inside a translucent volume" by "`hatching.hidden = \"merged\"`" on REGULAR:
        without [("hatching.iso", "120"), ("hatching.seeds", "dense"), ("hatching.hidden", "drawn")],
        with [("hatching.iso", "120"), ("hatching.seeds", "dense"), ("hatching.hidden", "merged")],
        only ["bytes.lines on rays", "preprocess.places of lines on rays"],
        // A ray ends at an opaque stroke.
        fewer ["samples"];
    "a moved object" by "`[[object]]` with `move`" on REGULAR:
        with [("object", "[{ value = [[110, 0], [130, 1]], move = [8, 0, 0] }]")],
        // Its own samples, and rays that its ghost ends elsewhere.
        more ["samples"], others ["rays_skipped"];
    "a halo, seeded by the opacity" by "`[[halo]]`" on REGULAR: with HALO, only OF_HALOS;
    "four halos in place of one" by "`[[halo]]`" on REGULAR:
        without HALO, with [("halo", "[{ kind = \"occlusive\" }, {}, {}, {}]")], more ["halo_passes", "bytes.halos"];
    "a halo over groups of four planes" by "`halo.every`" on REGULAR:
        without HALO, with [("halo", "[{ kind = \"occlusive\", every = 4 }]")], fewer ["halo_passes"];
    "a halo, seeded by curvature" by "`halo.seed.by`" on REGULAR:
        without HALO, with [("halo", "[{ kind = \"occlusive\", seed = { by = \"curvature\" } }]")],
        // A second normal on each ray, and seeds on other planes.
        more ["gradients"], others ["halo_passes"];
    "a halo of one label" by "`halo.seed.labels`" on REGULAR:
        without HALO,
        with [("volume.labels", "{folder}/labels.nrrd"),
            ("halo", "[{ kind = \"occlusive\", seed = { value = \"opacity\", labels = [1] } }]")],
        only ["bytes.labels"],
        // Seeds outside of the label are looked for no further.
        fewer ["gradients"], others ["halo_samples", "halo_passes", "bytes.seed_rays", "bytes.skip_seeds"];
};
