//! A scene for each effect that graphics cards draw: the effect alone, then several together.

/// Name of an effect and what a scene of it adds to the torus or to the waves of Marschner and Lobb.
pub(crate) const SCENES: &[(&str, &str)] = &[
    ("colours", COLORS),
    ("Phong", "[shading]\n"),
    ("Phong, orthographic", "[shading]\n[camera]\nprojection = \"orthographic\"\n"),
    ("Phong, on shells", "[shading]\n[sampling]\nstep_along = \"ray\"\n"),
    ("normals turned to the eye", "[shading]\n[sampling]\nnormal = \"facing\"\n"),
    ("toon shading", "[shading]\nmodel = \"toon\"\n"),
    (
        "lighting function, cartoon",
        "[shading]\nmodel = \"lighting-function\"\npreset = \"cartoon-contours\"\nlight = [-0.5, 0.4, 0.7]\n",
    ),
    (
        "lighting function",
        "[shading]\nmodel = \"lighting-function\"\npreset = \"metal-contours\"\nlight = [-0.5, 0.4, 0.7]\n",
    ),
    ("silhouettes", "[shading]\n[shading.silhouette]\n"),
    ("view-dependent opacity", "[shading]\nview_opacity = 0.7\n"),
    ("a clip plane", "[shading]\n[[clip]]\npoint = [15.3, 15.2, 15.1]\nnormal = [0.1, -1, 0.2]\nspace = \"index\"\n"),
    ("styles", STYLES),
    ("contours by κ along the ray", "[contours]\nthickness = \"1 voxel\"\n"),
    ("contours by a constant", "[contours]\nkappa = \"none\"\nthreshold = 0.3\n"),
    ("mip-maps of styles", "[style_mipmaps]\n"),
    ("contours and mip-maps", "[contours]\nthickness = \"1 voxel\"\n[style_mipmaps]\n"),
    ("contours by exact κ", "[contours]\nthickness = \"1 voxel\"\nkappa = \"exact\"\n"),
    ("Phong, cubic B-spline", "[shading]\n[sampling]\nkernel = \"bspline\"\n"),
    ("Phong, Catmull–Rom", "[shading]\n[sampling]\nkernel = \"catmull-rom\"\n"),
    ("Phong, Sobel's gradient", "[shading]\n[sampling]\ngradient = \"sobel\"\n"),
    ("Phong, gradient by regression", "[shading]\n[sampling]\ngradient = \"regression\"\n"),
    ("Phong, and an iso-surface", "[shading]\n[surface]\niso = 136\n"),
    ("Phong, from a table", "table = 256\n[shading]\n"),
    ("contours of styles from a table", "table = 64\n[contours]\nthickness = \"1 voxel\"\n"),
    ("Phong, rays at edges", "[shading]\n"),
    (
        "an iso-surface, cut",
        "[surface]\niso = 136\nlook = \"phong\"\n[[clip]]\npoint = [15.3, 15.2, 15.1]\nnormal = [0.1, -1, 0.2]\n\
         space = \"index\"\n",
    ),
    (
        "an iso-surface of a cubic B-spline",
        "[surface]\niso = 136\nlook = \"phong\"\n[sampling]\nkernel = \"bspline\"\n",
    ),
    ("lines inside the volume", "[hatching]\niso = 128\nhidden = \"merged\"\n"),
    ("over value and gradient magnitude", OVER_GRADIENT),
    ("over value and a distance", OVER_DISTANCE),
    (OF_LABELS, OVER_LABEL),
    ("an opaque mesh", MESH),
    ("a dark halo", "[shading]\n[[halo]]\nevery = 4\n"),
    ("a glowing halo", "[shading]\n[[halo]]\nkind = \"emissive\"\nevery = 4\n"),
    (
        "a halo by curvature, of means",
        "[shading]\n[[halo]]\nevery = 4\naccumulate = \"mean\"\nseed.by = \"curvature\"\n",
    ),
    ("a selection, moved", MOVED),
    ("an intersection with the ghost", MEETING),
    ("two selections by products", TWO_SELECTIONS),
    ("a ghosted background, before a box", CUT_AWAY),
    ("a ghosted background, before an object", CUT_AWAY_BEFORE_OBJECT),
    ("a ghosted background, in a funnel", GHOSTED),
    ("a halo of a selection and its ghost", HALOS_OF_PARTS),
];

/// The scene that reads a label volume, which its user adds.
pub(crate) const OF_LABELS: &str = "over value and label";

/// A plate with screws, in the middle of the torus.
const MESH: &str =
    "[shading]\n[[mesh]]\nfile = \"data/meshes/skull-plate.ply\"\nscale = 0.5\nmove = [-59.2, -33.3, -6.7]\n";
/// Half of the torus moved out of it.
const MOVED: &str = "[shading]\n[[object]]\nname = \"half\"\nvalue = [[120, 0], [134, 1]]\nmove = [9, -12, 6]\n\
    rotate = { axis = [1, 2, 0], angle = 40 }\n";
const HALOS_OF_PARTS: &str = "[shading]\n[[object]]\nname = \"half\"\nvalue = [[120, 0], [134, 1]]\n\
    move = [9, -12, 6]\n[[halo]]\nevery = 4\n[[halo]]\nobject = \"half\"\nkind = \"emissive\"\nevery = 4\n";
const MEETING: &str = "[shading]\n[[object]]\nname = \"half\"\nvalue = [[110, 0], [134, 0.8]]\nmove = [3, -2, 2]\n\
    [[intersection]]\nobject = \"half\"\nwith = \"ghost\"\ncolor = \"#ff4010\"\n";
const TWO_SELECTIONS: &str = "[shading]\n[combine]\nfuzzy = \"product\"\n\
    [[object]]\nname = \"half\"\nvalue = [[110, 0], [134, 0.8]]\n\
    [[object]]\nname = \"outer\"\nvalue = [[100, 0.6], [126, 0]]\nmove = [-7, 5, 3]\n";
const CUT_AWAY: &str = "[shading]\n[[object]]\nname = \"half\"\nvalue = [[130, 0], [134, 1]]\nmove = [0, 6, 0]\n\
    ghosting = 0.6\n";
const CUT_AWAY_BEFORE_OBJECT: &str = "[shading]\n[[object]]\nname = \"half\"\nvalue = [[130, 0], [134, 1]]\n\
    move = [0, 6, 0]\nghosting = 0.6\ncut = \"object\"\n";
const GHOSTED: &str = "[shading]\nmodel = \"lighting-function\"\n[[object]]\nname = \"half\"\n\
    value = [[130, 0], [134, 1]]\nmove = [0, 6, 0]\nghosting = 0.6\nfunnel = \"6 px\"\n";

/// The effect of colours alone.
const COLORS: &str = "";
/// The effect of styles alone.
const STYLES: &str = "";
/// Rows of a function over two quantities.
const OVER_GRADIENT: &str = "over = [\"value\", \"gradient-magnitude\"]\nunit = \"normalized\"\nrows = [
  { at = 0.1, nodes = [{ at = 0.4, color = \"#804020\", opacity = 0 }, { at = 0.6, color = \"#ffcc88\", opacity = 0.4 }] },
  { at = 0.8, nodes = [{ at = 0.4, color = \"#3366cc\", opacity = 0 }, { at = 0.6, color = \"#88ccff\", opacity = 0.5 }] },
]\n";
const OVER_DISTANCE: &str = "over = [\"value\", { distance = [23, 9, 24] }]\nrows = [
  { at = 5, nodes = [{ at = 100, color = \"#804020\", opacity = 0 }, { at = 128, color = \"#ffcc88\", opacity = 0.4 }] },
  { at = 30, nodes = [{ at = 90, color = \"#3366cc\", opacity = 0 }, { at = 120, color = \"#88ccff\", opacity = 0.5 }] },
]\n";

const OVER_LABEL: &str = "over = [\"value\", \"label\"]\nrows = [
  { at = 0, nodes = [{ at = 100, color = \"#804020\", opacity = 0 }, { at = 128, color = \"#ffcc88\", opacity = 0.4 }] },
  { at = 1, nodes = [{ at = 90, color = \"#3366cc\", opacity = 0 }, { at = 120, color = \"#88ccff\", opacity = 0.5 }] },
]\n";

/// The scene of an effect, in a picture so large.
pub(crate) fn scene(name: &str, more: &str, [width, height]: [usize; 2]) -> String {
    let is_style = ["styles", "contours", "mip-maps"].iter().any(|word| name.contains(word));
    let nodes = if name.starts_with("over ") {
        "kind = \"regular\""
    } else if is_style {
        "nodes = [{ at = 100, style = \"wax\", opacity = 0 }, { at = 128, style = \"wax\", opacity = 0.3 },\n\
         { at = 140, style = \"chalk\", opacity = 0.9 }]"
    } else {
        "kind = \"regular\"\n\
         nodes = [{ at = 100, color = \"#804020\", opacity = 0 }, { at = 128, color = \"#ffcc88\", opacity = 0.3 },\n\
         { at = 140, color = \"#88ccff\", opacity = 0.9 }]"
    };
    let samples = if name.ends_with("rays at edges") { "\"auto\"" } else { "1" };
    format!(
        "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 48 }}\n[picture]\nsize = [{width}, {height}]\n\
         samples = {samples}\nbackground = \"#203040\"\n[transfer]\n{nodes}\n{more}"
    )
}
