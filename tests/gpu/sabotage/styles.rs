//! Faults in the shaders of styles and of functions over two quantities, each of which parts the pictures.

use crate::styles::scene;
use crate::two_quantities::{ALONG, LOW, holes, labels, styles, torus};
use crate::{double, gpu};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::space::Grid;

/// A fault: the module, the text that is there, the text in its place, the scene, and the first stage that must part.
pub(crate) struct Fault {
    pub(crate) file: &'static str,
    pub(crate) old: &'static str,
    pub(crate) new: &'static str,
    pub(crate) scene: String,
    pub(crate) stage: &'static str,
}

/// The faults.
pub(crate) fn faults() -> Vec<Fault> {
    let fault = |file, old, new, scene, stage| Fault { file, old, new, scene, stage };
    let plain = || scene(true, "", "");
    let contours = |more: &str| scene(true, "", &format!("[contours]\nthickness = \"1.5 voxels\"\n{more}"));
    let cut = || scene(true, "", &crate::styles::cut("glass"));
    let mip = || scene(true, "", "[style_mipmaps]\nturn = 0.3\n");
    let over = |over: &str, rows: &str| torus("", &format!("over = {over}\n{rows}"), "");
    let gradients = || over("[\"value\", \"gradient-magnitude\"]", &styles([2.0, 10.0, 20.0]));
    let label = |lookup: &str, same: bool| {
        let grid = if same {
            Grid::with_spacing([32; 3], [1.0; 3]).unwrap()
        } else {
            let axes = DMat3::from_rotation_z(0.3) * DMat3::from_diagonal(DVec3::new(1.7, 1.3, 1.9));
            Grid::new([17, 21, 14], axes, DVec3::new(8.3, 0.4, 2.1)).unwrap()
        };
        let path = labels(&format!("fault-{lookup}-{same}"), &grid, "uint8", 77);
        let volume = format!("labels = {path:?}\nlabel_lookup = \"{lookup}\"");
        torus(&volume, &format!("over = [\"value\", \"label\"]\n{}", styles([1.0, 2.0, 77.0])), "")
    };
    let along = || {
        let path = labels("fault-along", &Grid::with_spacing([32; 3], [1.0; 3]).unwrap(), "uint8", 77);
        torus(&format!("labels = {path:?}"), &format!("over = [\"label\", \"value\"]\n{ALONG}"), "")
    };
    let further = || {
        let axes = DMat3::from_rotation_x(0.4) * DMat3::from_diagonal(DVec3::new(1.7, 1.3, 1.9));
        let grid = Grid::new([12, 15, 11], axes, DVec3::new(5.3, 6.4, 2.1)).unwrap();
        let path = labels("fault-further", &grid, "int16", 120);
        over(&format!("[\"value\", {{ volume = {path:?} }}]"), &styles([1.5, 4.0, 60.0]))
    };
    let holed = || {
        let grid = Grid::with_spacing([32; 3], [1.0; 3]).unwrap();
        let [a, b] = [("fault-a", 7), ("fault-b", 20)].map(|(name, first)| holes(name, first, &grid));
        over(&format!("[{{ volume = {a:?} }}, {{ volume = {b:?} }}]"), LOW)
    };
    let points = "[{ distance = [20.5, 9.25, 14.75] }, { distance = [3.5, 20.25, 12.75] }]";
    const STYLES: &str = "style_transfer_functions";
    let in_styles = |file: &str| -> &'static str { Box::leak(format!("{STYLES}/{file}").into_boxed_str()) };
    let in_two = |file: &str| -> &'static str { Box::leak(format!("transfer/over/{file}").into_boxed_str()) };
    vec![
        // Lookups: half a texel, a swapped axis, a sign, a texel too few.
        fault(in_styles("sphere_map"), "(n.x + 1.0) * half_side - 0.5", "(n.x + 1.0) * half_side", plain(), "colour"),
        fault(in_styles("sphere_map"), "(1.0 - n.y)", "(1.0 + n.y)", plain(), "colour"),
        fault(in_styles("sphere_map"), "y.i * side + x.i", "x.i * side + y.i", plain(), "colour"),
        fault(
            in_styles("sphere_map"),
            "texels_of_row(at + next * side, next, x.w)",
            "texels_of_row(at, next, x.w)",
            plain(),
            "colour",
        ),
        fault(in_styles("lookup"), "style_of(place.node + 1)", "style_of(place.node)", plain(), "style coordinate"),
        fault(
            in_styles("style"),
            "return Shaded(c.rgb / c.a, c.a * share);",
            "return Shaded(c.rgb, c.a * share);",
            plain(),
            "colour",
        ),
        fault(in_styles("transparency_illustrative"), "(1.0 - g)", "g", plain(), "colour"),
        fault(
            in_styles("lookup_mix_printed"),
            "return unpremultiply(c);",
            "return c;",
            scene(true, "mix = \"printed\"", ""),
            "colour",
        ),
        fault(
            in_styles("frame_view"),
            "vec3<real>(v.y, -v.x, 0.0)",
            "vec3<real>(-v.y, v.x, 0.0)",
            scene(true, "sphere_frame = \"view\"", ""),
            "style coordinate",
        ),
        fault(
            "ray/eye_normal",
            "-dot(a.normal, view_forward())",
            "dot(a.normal, view_forward())",
            scene(true, "sphere_frame = \"view\"", ""),
            "style coordinate",
        ),
        // Cuts: the cap's own opacity, a swapped axis.
        fault(in_styles("cut_style"), "shaded.alpha * c.a", "shaded.alpha", cut(), "colour"),
        fault(
            in_styles("cut_style"),
            "planes[cut_plane].r), n.xy)",
            "planes[cut_plane].r), n.yx)",
            cut(),
            "style coordinate",
        ),
        // Contours: the sample before, an angle's fold, the root, the push, the fade.
        fault(in_styles("curvature_along_ray"), "has_sample(ray, k - 1)", "false", contours(""), "curvature"),
        fault(
            in_styles("curvature_along_ray"),
            "locate(position(ray, k - 1))",
            "locate(position(ray, k - 2))",
            contours(""),
            "curvature",
        ),
        fault(
            in_styles("curvature_along_ray_of_lines"),
            "return abs(cosine);",
            "return cosine;",
            contours("[sampling]\nnormal = \"facing\"\nstep = \"2 voxels\"\n"),
            "curvature",
        ),
        fault(in_styles("contour_by_curvature"), "x * (2.0 - x)", "x", contours(""), "style coordinate"),
        fault(in_styles("contour"), "max(r, n_dot_v / tau)", "max(r, n_dot_v)", contours(""), "style coordinate"),
        fault(
            in_styles("contour_fade"),
            "(3.0 - (t + t))",
            "(3.0 - t)",
            contours("fade = [0.2, 0.8]\n"),
            "style coordinate",
        ),
        // Mip-maps: the level, the next level, the footprint.
        fault(
            in_styles("mipmaps"),
            "lambdas[levels + above] <= lambda",
            "lambdas[levels + above] < lambda - 1.0",
            mip(),
            "colour",
        ),
        fault(in_styles("mipmaps"), "(lambda - start) /", "0.5 * (lambda - start) /", mip(), "colour"),
        fault(in_styles("mipmaps"), "p = p / (depth_of(ray, sample.k)", "p = p / (depth_of(ray, 0)", mip(), "colour"),
        fault(
            in_styles("mipmaps"),
            "params.gradient_bias * (1.0 - a.magnitude)",
            "params.gradient_bias * a.magnitude",
            mip(),
            "colour",
        ),
        // Two quantities: rows, ids, what holds alone.
        fault(in_two("plane"), "place_in_row(row.k + 1, x)", "place_in_row(row.k, x)", gradients(), "colour"),
        fault(
            in_two("plane"),
            "patch_alone(below.place, 1.0 - row.w)",
            "patch_alone(below.place, 1.0)",
            along(),
            "colour",
        ),
        fault(
            in_two("plane"),
            "low < end && plane_words[min(low, end - 1)] == id",
            "low < end",
            along(),
            "style coordinate",
        ),
        fault(
            in_two("plane"),
            "let w = (x - a) / (plane_numbers[low] - a);",
            "let w = (x - a);",
            gradients(),
            "colour",
        ),
        fault(
            in_two("lookup_over_two"),
            "blended(above, n, level), node_patch.w",
            "blended(above, n, level), 0.5",
            gradients(),
            "colour",
        ),
        fault(
            in_two("sample_quantities"),
            "length_of(a.gradient), a.has_normal",
            "length_of(a.gradient) * 0.5, a.has_normal",
            gradients(),
            "style coordinate",
        ),
        fault(
            in_two("point"),
            "world_axis_y() * position.y",
            "world_axis_y() * position.x",
            over(points, LOW),
            "style coordinate",
        ),
        // Labels: half a voxel, a neighbour's id, a tie, the other grid.
        fault(
            in_two("labels_nearest"),
            "at.w > vec3<real>(0.5)",
            "at.w > vec3<real>(1.0)",
            label("nearest", true),
            "style coordinate",
        ),
        fault(
            in_two("labels_smooth"),
            "weights[c] = w.x * w.y * w.z;",
            "weights[c] = 1.0;",
            label("smooth", true),
            "style coordinate",
        ),
        fault(
            in_two("labels_smooth"),
            "select(rest, at.w, upper == vec3(1))",
            "select(at.w, rest, upper == vec3(1))",
            label("smooth", true),
            "style coordinate",
        ),
        fault(
            in_two("labels"),
            "(i % in_word) * LABEL_BITS",
            "(3 - i % in_word) * LABEL_BITS",
            label("nearest", true),
            "style coordinate",
        ),
        fault(
            in_two("labels_other_grid"),
            "to_labels_z() * position.z",
            "to_labels_z() * position.y",
            label("nearest", false),
            "style coordinate",
        ),
        fault(in_two("labels_other_grid"), "return 0u;", "return 1u;", label("smooth", false), "style coordinate"),
        fault(
            in_two("other_volume"),
            "further_component(first + 8, position)",
            "further_component(first + 4, position)",
            further(),
            "style coordinate",
        ),
        fault(in_two("grid_numbers"), "min(cell.x + 1, dims.x - 1)", "cell.x", further(), "style coordinate"),
        fault(
            in_two("other_volume_masked"),
            "(c.z * dims.y + c.y) * dims.x + c.x",
            "(c.z * dims.y + c.y) * dims.x + c.x + 1",
            holed(),
            "style coordinate",
        ),
        fault(
            in_two("other_volume_masked"),
            "further_masks[mask + (i >> 5u)]",
            "further_masks[i >> 5u]",
            holed(),
            "style coordinate",
        ),
        fault(
            in_two("other_volume_masked"),
            "further_masks[mask + (i >> 5u)] & (1u << u32(i & 31))) != 0u",
            "further_masks[mask + (i >> 5u)] & (1u << u32(i & 31))) == 0u",
            holed(),
            "style coordinate",
        ),
    ]
}

#[test]
fn faults_of_styles_are_noticed() {
    if gpu().is_none() {
        return;
    }
    let mut missed = Vec::new();
    for fault in faults() {
        let Some(found) = double::difference_with(&fault.scene, (fault.old, fault.new)) else { return };
        println!("{}, {:?}: {found:.1e} ({})", fault.file, fault.new, fault.stage);
        if found < 1e-4 {
            missed.push(format!("{}: {} → {}", fault.file, fault.old, fault.new));
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}
