//! Description and struct cannot part: every key that is described is read into the scene and written from it.

use super::*;

/// A key, what must stand beside it to have an effect, and a value that is not its default.
pub(super) type Sample = (&'static str, &'static [(&'static str, &'static str)], &'static str);

const NODES: (&str, &str) = ("transfer.nodes", "[{ at = 1, style = \"wax\" }, { at = 9, style = \"wax\" }]");
const COLORS: (&str, &str) = ("transfer.nodes", "[{ at = 1, color = \"red\" }]");
const OVER: (&str, &str) = ("transfer.over", "[\"value\", \"k1\"]");
const ROWS: (&str, &str) = ("transfer.rows", "[{ at = 1, nodes = [{ at = 1, style = \"wax\" }] }]");
const REGULAR: (&str, &str) = ("transfer.kind", "regular");
const PHANTOM: (&str, &str) = ("volume.phantom.name", "torus");
const RAW: [(&str, &str); 2] = [("volume.raw.size", "[4, 5, 6]"), ("volume.raw.type", "u16")];
const HALO: (&str, &str) = ("halo", "[{ profile = [{ at = 0, color = \"red\" }] }]");
const GLOW: (&str, &str) = ("halo", "[{ kind = \"emissive\" }, { kind = \"emissive\", name = \"glow\" }]");
const FOCUS: (&str, &str) = ("halo", "[{ seed = { focus = { at = [[1, 2, 3]] } } }]");
const CLIP: (&str, &str) = ("clip", "[{ point = [1, 2, 3], normal = [0, 0, 1] }]");
const BOX: (&str, &str) = ("clip", "[{ box = [[0, 9], [0, 9], [0, 9]] }]");
const OBJECT: (&str, &str) = ("object", "[{ cut = \"bounds\" }]");
const PIXEL: (&str, &str) = ("object", "[{ strokes = [{ pixel = [4, 5] }] }]");
const DAB: (&str, &str) = ("object", "[{ strokes = [{ at = [4, 5, 6] }] }]");
const GROWTH: (&str, &str) = ("object", "[{ strokes = [{ grow = [4, 5, 6] }] }]");
const BASIN: (&str, &str) = ("object", "[{ strokes = [{ watershed = [4, 5, 6] }] }]");
const OWN: (&str, &str) = ("object", "[{ volume = \"pet.nrrd\" }]");
const TURNED: (&str, &str) = ("object", "[{ rotate = { angle = 10 } }]");
const TWO: (&str, &str) = ("object", "[{ name = \"a\" }, { name = \"b\" }]");
const MEETING: (&str, &str) = ("intersection", "[{ object = \"a\" }]");
const PAINTED: (&str, &str) =
    ("intersection", "[{ object = \"a\", dabs = [{ at = [1, 2], width = 3, color = \"red\" }] }]");
const MESH: (&str, &str) = ("mesh", "[{ file = \"a.ply\" }]");
const TURNED_MESH: (&str, &str) = ("mesh", "[{ file = \"a.ply\", rotate = { angle = 10 } }]");
const EDGES: (&str, &str) = ("box", "[{ occluded = true }]");
const ARROW: (&str, &str) = ("arrow", "[{ from = [0, 0, 0], to = [1, 1, 1] }]");
const FAN: (&str, &str) = ("fan", "[{ from = \"background\", to = \"a\" }]");
const LABEL: (&str, &str) = ("label", "[{ text = \"a\" }]");
const PLACED_LABEL: (&str, &str) = ("label", "[{ text = \"a\", at = [0, 0, 0] }]");
const MOST_LABELS: (&str, &str) = ("label", "[{ most = 3 }]");
const FROM_LABELS: (&str, &str) = ("label", "[{ from = \"labels\" }]");
const LABEL_VOLUME: (&str, &str) = ("volume.labels", "parts.nrrd");
const LABELS: (&str, &str) = ("labels", "{}");
const SCALE_BAR: (&str, &str) = ("scale_bar", "{}");
const LEGEND: (&str, &str) = ("legend", "{}");
const ORIENTATION: (&str, &str) = ("orientation", "{}");
const PEN: (&str, &str) = ("pen", "[{ name = \"red\" }]");
const STIPPLES: (&str, &str) = ("stipples", "{}");
const HATCHING: (&str, &str) = ("hatching", "{}");
const LIT: (&str, &str) = ("hatching", "{ lighting = {} }");
const OUTLINES: (&str, &str) = ("outlines", "{}");
const SURFACE: (&str, &str) = ("surface.look", "phong");
const TABLE: (&str, &str) = ("shading.model", "lighting-function");
const TOON: (&str, &str) = ("shading.model", "toon");
const ORTHOGRAPHIC: (&str, &str) = ("camera.projection", "orthographic");

pub(super) const SAMPLES: &[Sample] = &[
    ("light", &[], "[1, 2, 3]"),
    ("volume", &[], "{ file = \"b.nrrd\" }"),
    ("volume.file", &[], "b.nrrd"),
    ("volume.phantom", &[], "{ name = \"sphere\" }"),
    ("volume.phantom.name", &[], "sphere"),
    ("volume.phantom.size", &[PHANTOM], "64"),
    ("volume.phantom.spacing", &[PHANTOM], "[1, 1, 2]"),
    ("volume.phantom.type", &[PHANTOM], "i16"),
    ("volume.phantom.param", &[PHANTOM], "{ R = 20 }"),
    ("volume.raw", &[], "{ size = [1, 2, 3], type = \"u8\" }"),
    ("volume.raw.size", &RAW, "[1, 2, 3]"),
    ("volume.raw.type", &RAW, "f64"),
    ("volume.raw.endian", &RAW, "big"),
    ("volume.raw.spacing", &RAW, "[0.5, 0.5, 2]"),
    ("volume.raw.skip", &RAW, "352"),
    ("volume.ids", &[], "mask"),
    ("volume.labels", &[], "parts.nrrd"),
    ("volume.label_names", &[], "parts.csv"),
    ("volume.label_lookup", &[], "smooth"),
    ("volume.range", &[], "[-1000, 3000]"),
    ("volume.gradient_range", &[], "[0, 60]"),
    ("volume.outside", &[], "high"),
    ("clip", &[], "[{ box = [[0, 1], [2, 3], [4, 5]] }]"),
    ("clip[0].point", &[CLIP], "[3, 2, 1]"),
    ("clip[0].normal", &[CLIP], "[1, 0, 0]"),
    ("clip[0].box", &[BOX], "[[0, 1], [2, 3], [4, 5]]"),
    ("clip[0].space", &[CLIP], "index"),
    ("clip[0].applies", &[CLIP], "[\"background\"]"),
    ("clip[0].cap", &[CLIP], "#c0303080"),
    ("clip[0].style", &[CLIP], "wax"),
    ("volume.box", &[], "[[0, 3], [1, 1], [2, 9]]"),
    ("volume.stride", &[], "[2, 2, 1]"),
    ("volume.parts", &[], "{}"),
    ("volume.parts.keep", &[("volume.parts", "{}")], "{ at = [1, 2.5, 3] }"),
    ("volume.parts.at_least", &[], "12.5"),
    ("camera", &[], "{ fov = 45 }"),
    ("camera.projection", &[], "orthographic"),
    ("camera.fov", &[], "45"),
    ("camera.height", &[ORTHOGRAPHIC], "300 voxels"),
    ("camera.direction", &[], "[0, 1, 0]"),
    ("camera.eye", &[], "[1, 2, 3]"),
    ("camera.target", &[], "[1, 2, 3]"),
    ("camera.up", &[], "[0, 1, 0]"),
    ("camera.near", &[], "0.5 voxels"),
    ("orbit", &[], "{}"),
    ("orbit.frames", &[("orbit", "{}")], "12"),
    ("orbit.degrees", &[("orbit", "{}")], "-90"),
    ("orbit.fps", &[("orbit", "{}")], "20"),
    ("picture", &[], "{ samples = 2 }"),
    ("picture.size", &[], "[640, 480]"),
    ("picture.width", &[("picture.height", "120 mm")], "180 mm"),
    ("picture.height", &[("picture.width", "180 mm")], "120 mm"),
    ("picture.dpi", &[], "72"),
    ("picture.samples", &[], "3"),
    ("picture.contrast", &[], "0.1"),
    ("picture.background", &[], "none"),
    ("picture.blend_space", &[], "srgb"),
    ("picture.bits", &[], "16"),
    ("picture.layers", &[], "[\"beauty\", \"Z\"]"),
    ("page", &[], "{}"),
    ("page.margin", &[], "5 px"),
    ("page.plotter", &[], "true"),
    ("page.text", &[], "outlines"),
    ("pen", &[], "[{ name = \"red\" }]"),
    ("pen[0].name", &[PEN], "green"),
    ("pen[0].width", &[PEN], "0.7 mm"),
    ("pen[0].color", &[PEN], "red"),
    ("pen[0].tone", &[PEN], "wedge.csv"),
    ("sampling", &[], "{ step = 1 }"),
    ("sampling.step", &[], "0.25 voxels"),
    ("sampling.step_along", &[], "ray"),
    ("sampling.kernel", &[], "catmull-rom"),
    ("sampling.gradient", &[], "sobel"),
    ("sampling.hessian", &[], "central"),
    ("sampling.scale", &[], "2 voxels"),
    ("sampling.normal", &[], "facing"),
    ("sampling.number", &[], "f32"),
    ("sampling.skip_empty", &[], "false"),
    ("sampling.stop_below", &[], "0.01"),
    ("sampling.reference_length", &[], "2"),
    ("transfer", &[], "{ kind = \"regular\" }"),
    ("transfer.kind", &[], "regular"),
    ("transfer.over", &[OVER, ROWS], "[\"value\", \"k2\"]"),
    ("transfer.over[0].distance", &[("transfer.over", "[{ distance = [0, 0, 0] }, \"value\"]"), ROWS], "[1, 2, 3]"),
    (
        "transfer.over[0].distance_to_label",
        &[("volume.labels", "l.nrrd"), ("transfer.over", "[{ distance_to_label = 3 }, \"value\"]"), ROWS],
        "4",
    ),
    ("transfer.over[0].volume", &[("transfer.over", "[{ volume = \"a.nrrd\" }, \"value\"]"), ROWS], "b.nrrd"),
    ("transfer.unit", &[], "percentile"),
    ("transfer.nodes", &[], "[{ at = 1, style = \"wax\" }]"),
    ("transfer.nodes[0].at", &[NODES], "2"),
    ("transfer.nodes[0].style", &[NODES], "metal"),
    ("transfer.nodes[0].opacity", &[NODES], "0.5"),
    ("transfer.nodes[0].color", &[REGULAR, COLORS], "#00f"),
    ("transfer.rows", &[OVER, ROWS], "[{ at = 1, nodes = [{ at = 2, style = \"wax\" }] }]"),
    ("transfer.rows[0].at", &[OVER, ROWS], "2"),
    ("transfer.rows[0].nodes", &[OVER, ROWS], "[{ at = 1, style = \"metal\" }]"),
    ("transfer.transparency", &[], "plain"),
    ("transfer.mix", &[], "printed"),
    ("transfer.sphere_frame", &[], "view"),
    ("styles", &[], "{ mine = \"b.png\" }"),
    ("styles.theme", &[], "my/theme"),
    ("transfer.table", &[], "256"),
    ("shading", &[], "{}"),
    ("shading.ambient", &[("shading", "{}")], "0.1"),
    ("shading.diffuse", &[("shading", "{}")], "0.1"),
    ("shading.specular", &[("shading", "{}")], "0.1"),
    ("shading.shininess", &[("shading", "{}")], "5"),
    ("shading.light", &[("shading", "{}")], "{ world = [1, 0, 0] }"),
    ("shading.model", &[("shading", "{}")], "toon"),
    ("shading.preset", &[TABLE], "metal-contours"),
    ("shading.table", &[TABLE], "light.png"),
    ("shading.contour", &[TABLE], "printed"),
    ("shading.divisor_floor", &[TABLE], "0.1"),
    ("shading.toon", &[TOON], "{}"),
    ("shading.toon.offset", &[TOON], "0.5"),
    ("shading.toon.tones", &[TOON], "[[0, \"red\"]]"),
    ("shading.silhouette", &[("shading", "{}")], "{}"),
    ("shading.silhouette.offset", &[("shading", "{}")], "0.3"),
    ("shading.view_opacity", &[("shading", "{}")], "1.5"),
    ("contours", &[], "{}"),
    ("contours.thickness", &[("contours", "{}")], "3 voxels"),
    ("contours.kappa", &[("contours", "{}")], "exact"),
    ("contours.threshold", &[("contours.kappa", "none")], "0.5"),
    ("contours.sign_flip", &[("contours", "{}")], "literal"),
    ("contours.fade", &[("contours", "{}")], "[0.02, 0.05]"),
    ("style_mipmaps", &[], "{}"),
    ("style_mipmaps.curvature_bias", &[("style_mipmaps", "{}")], "0"),
    ("style_mipmaps.gradient_bias", &[("style_mipmaps", "{}")], "2.5"),
    ("style_mipmaps.turn", &[("style_mipmaps", "{}")], "0.02"),
    ("halo", &[], "[{}]"),
    ("halo[0].name", &[HALO], "rim"),
    ("halo[0].kind", &[HALO], "emissive"),
    ("halo[0].seed", &[HALO], "{ by = \"curvature\" }"),
    ("halo[0].seed.value", &[HALO], "[[80, 0], [120, 1]]"),
    ("halo[0].seed.direction", &[HALO], "{}"),
    ("halo[0].seed.direction.toward", &[HALO], "-90"),
    ("halo[0].seed.direction.width", &[HALO], "30"),
    ("halo[0].seed.direction.softness", &[HALO], "0"),
    ("halo[0].seed.focus", &[HALO], "{ at = [[1, 2, 3]] }"),
    ("halo[0].seed.focus.at", &[HALO], "[[1, 2, 3], [4, 5, 6]]"),
    ("halo[0].seed.focus.pixels", &[HALO], "[[7.5, 8]]"),
    ("halo[0].seed.focus.inner", &[FOCUS], "2 voxels"),
    ("halo[0].seed.focus.falloff", &[FOCUS], "0"),
    ("halo[0].seed.labels", &[HALO, ("volume.labels", "l.nrrd")], "[3]"),
    ("halo[0].seed.by", &[HALO], "curvature"),
    ("halo[0].seed.thickness", &[HALO], "2 voxels"),
    ("halo[0].exponents", &[HALO], "printed"),
    ("halo[0].spread", &[HALO], "{ median = true }"),
    ("halo[0].spread.from", &[HALO], "seeds"),
    ("halo[0].spread.passes", &[HALO], "0"),
    ("halo[0].spread.delta", &[HALO], "0.9"),
    ("halo[0].spread.median", &[HALO], "true"),
    ("halo[0].spread.reach", &[HALO], "4.5 %"),
    ("halo[0].profile", &[HALO], "[{ at = 0.5, color = \"blue\" }]"),
    ("halo[0].profile[0].at", &[HALO], "0.5"),
    ("halo[0].profile[0].opacity", &[HALO], "0.5"),
    ("halo[0].profile[0].color", &[HALO], "blue"),
    ("halo[0].opacity", &[HALO], "0.5"),
    ("halo[0].floor", &[HALO], "0"),
    ("halo[0].every", &[HALO], "8"),
    ("halo[0].accumulate", &[HALO], "mean"),
    ("halo[0].tints", &[GLOW], "[\"glow\"]"),
    ("combine", &[], "{}"),
    ("combine.fuzzy", &[], "product"),
    ("object", &[], "[{}]"),
    ("object[0].name", &[OBJECT], "tumour"),
    ("object[0].volume", &[OBJECT], "pet.nrrd"),
    ("object[0].labels", &[OWN], "l.nrrd"),
    ("object[0].label_names", &[OWN], "l.csv"),
    ("object[0].range", &[OWN], "[1, 9]"),
    ("object[0].gradient_range", &[OWN], "max"),
    ("object[0].outside", &[OWN], "high"),
    ("object[0].selection", &[OBJECT], "tumour.nrrd"),
    ("object[0].label", &[OBJECT, ("volume.labels", "l.nrrd")], "[1, 2]"),
    ("object[0].value", &[OBJECT], "[[1, 0], [2, 1]]"),
    ("object[0].strokes", &[OBJECT], "[{ pixel = [1, 2] }, { grow = [1, 2, 3] }, { watershed = [1, 2, 3] }]"),
    ("object[0].strokes[0].pixel", &[PIXEL], "[1, 2.5]"),
    ("object[0].strokes[0].at", &[DAB], "[1, 2, 3]"),
    ("object[0].strokes[0].grow", &[GROWTH], "[1, 2, 3]"),
    ("object[0].strokes[0].watershed", &[BASIN], "[1, 2, 3]"),
    ("object[0].strokes[0].mode", &[BASIN], "subtract"),
    ("object[0].strokes[0].radius", &[DAB], "3 voxels"),
    ("object[0].strokes[0].brush", &[PIXEL], "ball"),
    ("object[0].strokes[0].tolerance", &[GROWTH], "10"),
    ("object[0].strokes[0].connect", &[GROWTH], "26"),
    ("object[0].move", &[OBJECT], "[0, 0, 40]"),
    ("object[0].scale", &[OBJECT], "[1, 1, -2]"),
    ("object[0].rotate", &[OBJECT], "{ angle = 30 }"),
    ("object[0].rotate.axis", &[TURNED], "[1, 0, 0]"),
    ("object[0].rotate.angle", &[TURNED], "45"),
    ("object[0].center", &[OBJECT], "[1, 2, 3]"),
    ("object[0].matrix", &[OBJECT], "[[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]"),
    ("object[0].interaction", &[OBJECT], "pinned"),
    ("object[0].ghosting", &[OBJECT], "0.8"),
    ("object[0].ghosting_of_ghost", &[OBJECT], "0.8"),
    ("object[0].cut", &[OBJECT], "object"),
    ("object[0].funnel", &[OBJECT], "12 px"),
    ("object[0].arrow", &[TURNED], "true"),
    ("object[0].fan", &[TURNED], "true"),
    ("object[0].active", &[OBJECT], "true"),
    ("object[0].highlight", &[OBJECT], "true"),
    ("object[0].transfer", &[OBJECT], "{}"),
    ("object[0].styles", &[OBJECT], "{ theme = \"studio\" }"),
    ("object[0].shading", &[OBJECT], "{}"),
    ("object[0].ghost", &[OBJECT], "{}"),
    ("object[0].ghost.transfer", &[OBJECT], "{}"),
    ("object[0].ghost.styles", &[OBJECT], "{ theme = \"studio\" }"),
    ("object[0].ghost.shading", &[OBJECT], "{}"),
    ("intersection", &[OBJECT], "[{ object = \"object 0\" }]"),
    ("intersection[0].object", &[TWO, MEETING], "b"),
    ("intersection[0].with", &[TWO, MEETING], "background"),
    ("intersection[0].color", &[TWO, MEETING], "#ff000080"),
    ("intersection[0].opacity", &[TWO, MEETING], "xor"),
    ("intersection[0].swap", &[TWO, MEETING], "true"),
    ("intersection[0].dabs", &[TWO, MEETING], "[{ at = [1, 2], width = [3, 4], color = \"#ff000080\" }]"),
    ("intersection[0].dabs[0].at", &[TWO, PAINTED], "[2, 1]"),
    ("intersection[0].dabs[0].width", &[TWO, PAINTED], "[4, 5]"),
    ("intersection[0].dabs[0].color", &[TWO, PAINTED], "#0000ff80"),
    ("mesh", &[], "[{ file = \"a.ply\" }]"),
    ("mesh[0].file", &[MESH], "b.stl"),
    ("mesh[0].color", &[MESH], "#ff0000"),
    ("mesh[0].move", &[MESH], "[0, 0, 40]"),
    ("mesh[0].scale", &[MESH], "[1, 1, -2]"),
    ("mesh[0].rotate", &[MESH], "{ angle = 30 }"),
    ("mesh[0].rotate.axis", &[TURNED_MESH], "[1, 0, 0]"),
    ("mesh[0].rotate.angle", &[TURNED_MESH], "45"),
    ("mesh[0].center", &[MESH], "[1, 2, 3]"),
    ("mesh[0].matrix", &[MESH], "[[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]"),
    ("halo[0].object", &[HALO], "background"),
    ("stipples", &[], "{}"),
    ("stipples.threshold", &[STIPPLES], "q0.9"),
    ("stipples.k_max", &[STIPPLES], "2.5"),
    ("stipples.size", &[STIPPLES], "3 px"),
    ("stipples.seed", &[STIPPLES], "7"),
    ("stipples.box", &[STIPPLES], "2"),
    ("stipples.color", &[STIPPLES], "#00f"),
    ("stipples.pen", &[STIPPLES], "red"),
    ("stipples.gradient", &[STIPPLES], "central"),
    ("stipples.slab", &[STIPPLES], "0"),
    ("stipples.order", &[STIPPLES], "voxel"),
    ("stipples.snap", &[STIPPLES], "edge"),
    ("stipples.thin", &[STIPPLES], "true"),
    ("stipples.factors", &[STIPPLES], "normalize"),
    ("stipples.ink", &[STIPPLES], "opaque"),
    ("stipples.density", &[STIPPLES], "page"),
    ("stipples.even", &[STIPPLES], "page"),
    ("stipples.boundary", &[STIPPLES], "{}"),
    ("stipples.boundary.gc", &[("stipples.boundary", "{}")], "0.1"),
    ("stipples.boundary.gs", &[("stipples.boundary", "{}")], "0.1"),
    ("stipples.boundary.ge", &[("stipples.boundary", "{}")], "2"),
    ("stipples.silhouette", &[STIPPLES], "{}"),
    ("stipples.silhouette.sc", &[("stipples.silhouette", "{}")], "0.1"),
    ("stipples.silhouette.ss", &[("stipples.silhouette", "{}")], "0.1"),
    ("stipples.silhouette.se", &[("stipples.silhouette", "{}")], "2"),
    ("stipples.silhouette.literal", &[("stipples.silhouette", "{}")], "true"),
    ("stipples.resolution", &[STIPPLES], "{}"),
    ("stipples.resolution.re", &[("stipples.resolution", "{}")], "2"),
    ("stipples.resolution.reference", &[("stipples.resolution", "{}")], "600"),
    ("stipples.distance", &[STIPPLES], "{}"),
    ("stipples.distance.de", &[("stipples.distance", "{}")], "-1"),
    ("stipples.interior", &[STIPPLES], "{}"),
    ("stipples.interior.te", &[("stipples.interior", "{}")], "1"),
    ("stipples.lighting", &[STIPPLES], "{}"),
    ("stipples.lighting.le", &[("stipples.lighting", "{}")], "1"),
    ("stipples.lighting.light", &[("stipples.lighting", "{}")], "{ world = [1, 0, 0] }"),
    ("stipples.curves", &[STIPPLES], "{}"),
    ("stipples.curves.test", &[("stipples.curves", "{}")], "literal"),
    ("stipples.curves.c", &[("stipples.curves", "{}")], "1"),
    ("stipples.curves.eye", &[("stipples.curves", "{}")], "0.9"),
    ("stipples.curves.grad", &[("stipples.curves", "{}")], "0.3"),
    ("stipples.curves.log", &[("stipples.curves", "{}")], "0.22"),
    ("stipples.iso", &[STIPPLES], "120"),
    ("stipples.hide_behind", &[STIPPLES], "120"),
    ("hatching", &[], "{}"),
    ("hatching.iso", &[HATCHING], "12.5"),
    ("hatching.length", &[HATCHING], "7 voxels"),
    ("hatching.tolerance", &[HATCHING], "0.1 voxels"),
    ("hatching.seeds", &[HATCHING], "dense"),
    ("hatching.seed", &[HATCHING], "9"),
    ("hatching.cross", &[HATCHING], "45"),
    ("hatching.cross_length", &[HATCHING], "0.25"),
    ("hatching.cross_pen", &[HATCHING], "red"),
    ("hatching.width", &[HATCHING], "2 px"),
    ("hatching.color", &[HATCHING], "red"),
    ("hatching.pen", &[HATCHING], "red"),
    ("hatching.measure", &[HATCHING], "curvedness"),
    ("hatching.min_curvature", &[HATCHING], "0.1"),
    ("hatching.min_gradient", &[HATCHING], "0.1"),
    ("hatching.family", &[HATCHING], "min"),
    ("hatching.max_angle", &[HATCHING], "45"),
    ("hatching.min_step", &[HATCHING], "0.1 voxels"),
    ("hatching.offset", &[HATCHING], "0.3 voxels"),
    ("hatching.chord", &[HATCHING], "0.2 voxels"),
    ("hatching.beziers", &[HATCHING], "true"),
    ("hatching.spacing", &[HATCHING], "tone"),
    ("hatching.gap", &[HATCHING], "0.5 mm"),
    ("hatching.gap_depth", &[HATCHING], "3 voxels"),
    ("hatching.hidden", &[HATCHING], "drawn"),
    ("hatching.style", &[HATCHING], "pencil"),
    ("hatching.stroke", &[HATCHING], "{ tone = 2 }"),
    ("hatching.stroke.tone", &[HATCHING], "2"),
    ("hatching.stroke.taper", &[HATCHING], "0.3"),
    ("hatching.stroke.min_width", &[HATCHING], "1 px"),
    ("hatching.stroke.ambient", &[HATCHING], "0.2"),
    ("hatching.stroke.dash", &[HATCHING], "[\"3 mm\", \"1 mm\"]"),
    ("hatching.stroke.jitter", &[HATCHING], "0.2"),
    ("hatching.stroke.depth", &[HATCHING], "0.5"),
    ("hatching.stroke.light", &[HATCHING], "{ world = [1, 0, 0] }"),
    ("hatching.directions", &[HATCHING], "{ rule = \"raw\" }"),
    ("hatching.directions.rule", &[HATCHING], "raw"),
    ("hatching.directions.from", &[HATCHING], "stored"),
    ("hatching.directions.interpolate", &[HATCHING], "flipped"),
    ("hatching.directions.grid", &[HATCHING], "all"),
    ("hatching.directions.reference", &[HATCHING], "axial"),
    ("hatching.directions.axis", &[HATCHING], "[1, 0, 0]"),
    ("hatching.directions.center", &[HATCHING], "[1, 2, 3]"),
    ("hatching.directions.gap", &[HATCHING], "0.2"),
    ("hatching.directions.noise", &[HATCHING], "3"),
    ("hatching.directions.deviation", &[HATCHING], "3"),
    ("hatching.directions.agree", &[HATCHING], "30"),
    ("hatching.lighting", &[HATCHING], "{ p = 3 }"),
    ("hatching.lighting.diffuse", &[LIT], "0.5"),
    ("hatching.lighting.p", &[LIT], "3"),
    ("hatching.lighting.specular", &[LIT], "0.5"),
    ("hatching.lighting.s", &[LIT], "5"),
    ("hatching.lighting.front", &[LIT], "red"),
    ("hatching.lighting.back", &[LIT], "red"),
    ("hatching.lighting.self_shadow", &[LIT], "true"),
    ("hatching.lighting.table", &[LIT], "64"),
    ("outlines", &[], "{}"),
    ("outlines.iso", &[OUTLINES], "12.5"),
    ("outlines.width", &[OUTLINES], "2 px"),
    ("outlines.color", &[OUTLINES], "red"),
    ("outlines.pen", &[OUTLINES], "red"),
    ("outlines.min_length", &[OUTLINES], "0 px"),
    ("outlines.crease", &[OUTLINES], "22.5 deg"),
    ("surface", &[], "{}"),
    ("surface.iso", &[SURFACE], "12.5"),
    ("surface.look", &[], "phong"),
    ("surface.color", &[SURFACE], "red"),
    ("surface.toon", &[SURFACE], "{}"),
    ("surface.toon.offset", &[SURFACE], "0.5"),
    ("surface.toon.tones", &[SURFACE], "[[0, \"red\"]]"),
    ("surface.silhouette", &[SURFACE], "{}"),
    ("surface.silhouette.offset", &[SURFACE], "0.3"),
    ("surface.view_opacity", &[SURFACE], "2"),
    ("box", &[], "[{ occluded = true }]"),
    ("box[0].of", &[EDGES, TWO], "a"),
    ("box[0].show", &[EDGES], "draft"),
    ("box[0].occluded", &[EDGES], "false"),
    ("box[0].color", &[EDGES], "red"),
    ("box[0].width", &[EDGES], "2 px"),
    ("box[0].pen", &[EDGES], "red"),
    ("arrow", &[], "[{ from = [0, 0, 0], to = [1, 1, 1] }]"),
    ("arrow[0].from", &[ARROW, TWO], "a"),
    ("arrow[0].to", &[ARROW], "[4, 5, 6]"),
    ("arrow[0].bend", &[ARROW], "0"),
    ("arrow[0].ends", &[ARROW], "box"),
    ("arrow[0].head", &[ARROW], "2 mm"),
    ("arrow[0].occluded", &[ARROW], "false"),
    ("arrow[0].color", &[ARROW], "red"),
    ("arrow[0].width", &[ARROW], "2 px"),
    ("arrow[0].pen", &[ARROW], "red"),
    ("fan", &[TWO], "[{ from = \"background\", to = \"a\" }]"),
    ("fan[0].from", &[FAN, TWO], "b"),
    ("fan[0].to", &[FAN, TWO], "b"),
    ("fan[0].shape", &[FAN, TWO], "circle"),
    ("fan[0].fill", &[FAN, TWO], "red"),
    ("fan[0].color", &[FAN, TWO], "red"),
    ("fan[0].width", &[FAN, TWO], "2 px"),
    ("fan[0].pen", &[FAN, TWO], "red"),
    ("label", &[], "[{ text = \"a\", at = [0, 0, 0] }]"),
    ("label[0].text", &[PLACED_LABEL], "b"),
    ("label[0].at", &[LABEL], "[1, 2, 3]"),
    ("label[0].pixel", &[LABEL], "[1, 2]"),
    ("label[0].object", &[LABEL, TWO], "a"),
    ("label[0].label", &[LABEL, LABEL_VOLUME], "3"),
    ("label[0].anchor", &[PLACED_LABEL], "centroid"),
    ("label[0].from", &[MOST_LABELS, LABEL_VOLUME], "labels"),
    ("label[0].most", &[FROM_LABELS, LABEL_VOLUME], "5"),
    ("labels", &[], "{}"),
    ("labels.layout", &[], "hull"),
    ("labels.size", &[LABELS], "2 mm"),
    ("labels.dot", &[LABELS], "0 mm"),
    ("labels.gap", &[LABELS], "0 mm"),
    ("labels.distance", &[LABELS], "0 mm"),
    ("labels.least_opacity", &[LABELS], "1"),
    ("labels.rounds", &[LABELS], "3"),
    ("labels.color", &[LABELS], "red"),
    ("labels.width", &[LABELS], "2 px"),
    ("labels.pen", &[LABELS], "red"),
    ("scale_bar", &[], "{}"),
    ("scale_bar.length", &[SCALE_BAR], "20"),
    ("scale_bar.unit", &[SCALE_BAR], "µm"),
    ("scale_bar.corner", &[SCALE_BAR], "top-left"),
    ("scale_bar.size", &[SCALE_BAR], "2 mm"),
    ("scale_bar.color", &[SCALE_BAR], "red"),
    ("scale_bar.width", &[SCALE_BAR], "2 px"),
    ("scale_bar.pen", &[SCALE_BAR], "red"),
    ("orientation", &[], "{}"),
    ("orientation.letters", &[ORIENTATION], "false"),
    ("orientation.triad", &[ORIENTATION], "true"),
    ("orientation.corner", &[ORIENTATION], "top-left"),
    ("orientation.size", &[ORIENTATION], "2 mm"),
    ("orientation.color", &[ORIENTATION], "red"),
    ("orientation.width", &[ORIENTATION], "2 px"),
    ("orientation.pen", &[ORIENTATION], "red"),
    ("legend", &[], "{}"),
    ("legend.corner", &[LEGEND], "bottom-right"),
    ("legend.size", &[LEGEND], "2 mm"),
    ("legend.names", &[LEGEND], "[\"skin\", \"\"]"),
    ("legend.title", &[LEGEND], "Tissues"),
    ("legend.color", &[LEGEND], "red"),
    ("legend.width", &[LEGEND], "2 px"),
    ("legend.pen", &[LEGEND], "red"),
];

/// Keys that can have one value only, so far.
const ONE_VALUE: [&str; 2] = ["drypoint", "preset"];

pub(super) fn with(settings: &[(&str, &str)]) -> Result<Scene, Faults> {
    parse(HEAD, Path::new("scene.toml"), &settings.iter().copied().collect())
}

#[test]
fn every_described_key_has_a_sample_and_every_sample_a_key() {
    let described: Vec<String> = every_key().into_iter().map(|(path, _)| path).collect();
    let mut sampled: Vec<&str> = SAMPLES.iter().map(|(key, ..)| *key).chain(ONE_VALUE).collect();
    sampled.sort_unstable();
    let mut expected = described.clone();
    expected.sort_unstable();
    assert_eq!(sampled, expected);
}

#[test]
fn every_key_changes_the_scene_and_is_written_back() {
    for (key, beside, value) in SAMPLES {
        let without = with(beside);
        let all: Vec<_> = beside.iter().copied().chain([(*key, *value)]).collect();
        let changed = with(&all).unwrap_or_else(|faults| panic!("{key}\n{faults}"));
        // Without `width` a `height` is at fault, and the other way round, and a label without what it names: there is no
        // scene to compare with.
        if let Ok(without) = without {
            assert_ne!(changed, without, "{key}");
        } else {
            let names = ["label[0].at", "label[0].pixel", "label[0].object", "label[0].label", "label[0].from"];
            assert!(["picture.width", "picture.height"].contains(key) || names.contains(key), "{key}");
        }
        let full = write_full(&changed);
        let back = parse(&full, Path::new("scene.toml"), &Overrides::default()).unwrap();
        assert_eq!(back, changed, "{key}\n{full}");
    }
}

#[test]
fn every_name_of_every_choice_is_read_and_written_back() {
    let mut names = 0;
    for (path, key) in every_key() {
        for (name, doc) in key.shape.options() {
            let beside = SAMPLES.iter().find(|(key, ..)| *key == path).map_or(&[][..], |(_, beside, _)| *beside);
            // An analytic Hessian is refused with kernels that have none.
            let spline = if name == "analytic" { &[("sampling.kernel", "bspline")][..] } else { &[] };
            let all: Vec<_> = [beside, spline, &[(path.as_str(), name)]].concat();
            let scene = with(&all).unwrap_or_else(|faults| panic!("{faults}"));
            if path != "preset" {
                let line = format!("{} = {name:?}\n", key.name);
                let inline = format!("{} = {name:?}", key.name);
                let full = write_full(&scene);
                assert!(full.contains(&line) || full.contains(&inline), "{path} {name}\n{full}");
            }
            let kebab = name.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-');
            assert!(kebab, "{path}: {name}");
            assert!(doc.ends_with('.'), "{path}: {name}: {doc}");
            names += 1;
        }
    }
    assert!(names > 50, "{names}");
}

#[test]
fn keys_are_snake_case_and_documented() {
    for (path, key) in every_key() {
        assert!(key.name.bytes().all(|b| b.is_ascii_lowercase() || b == b'_'), "{path}");
        assert!(key.doc.ends_with('.'), "{path}: {}", key.doc);
        let says_what_holds = key.required || key.default.is_some() || !key.absent.is_empty();
        assert!(says_what_holds || path.starts_with("transfer.nodes[0]"), "{path} says nothing of its default");
    }
}

#[test]
fn the_reference_page_has_every_key() {
    let page = reference_markdown();
    for (path, key) in every_key() {
        assert!(page.contains(&format!("| `{}` |", key.name)), "{path}");
    }
    // Each row of a table has as many cells as its head.
    for row in page.lines().filter(|line| line.starts_with('|')) {
        assert_eq!(row.replace("\\|", "").matches('|').count(), 7, "{row}");
    }
}
