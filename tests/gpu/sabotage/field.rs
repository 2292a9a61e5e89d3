//! Faults in the shaders of the field and of iso-surfaces, each of which parts the pictures.

use crate::field::scene;
use crate::sabotage_of_styles::Fault;
use crate::{double, gpu};

/// The faults.
pub(crate) fn faults() -> Vec<Fault> {
    let fault = |file, old, new, scene, stage| Fault { file, old, new, scene, stage };
    let sampled = |keys: &str| scene([11, 9, 8], "float", &format!("[shading]\n[sampling]\n{keys}\n"));
    let kernel = |name: &str| sampled(&format!("kernel = \"{name}\"\ngradient = \"analytic\""));
    let gradient = |name: &str| sampled(&format!("gradient = \"{name}\""));
    let curved = |hessian: &str, kernel: &str| {
        let layers = "layers = [\"beauty\", \"curvature\"]\n[shading]\n";
        let more = format!("{layers}[sampling]\nkernel = \"{kernel}\"\nhessian = \"{hessian}\"\n");
        scene([11, 9, 8], "float", &more)
    };
    let surface =
        |more: &str| scene([11, 9, 8], "float", &format!("[shading]\n[surface]\niso = 150\nlook = \"phong\"\n{more}"));
    let stepped = || surface("[sampling]\nkernel = \"bspline\"\n");
    let masked = || scene([11, 9, 8], "masked", "[shading]\n");
    vec![
        // Kernels: a mirrored tap, half a voxel, a sign.
        fault("field/kernel/bspline", "0.5 * t * (1.0 + t - t * t)", "0.5 * t * (1.0 + t)", kernel("bspline"), "value"),
        fault("field/kernel/tensor", "return first + sum;", "return first - sum;", kernel("bspline"), "value"),
        fault("field/kernel/bspline5", "(b.z, b.y, b.x, a.x", "(b.z, b.x, b.y, a.x", kernel("bspline5"), "value"),
        fault(
            "field/kernel/catmull_rom",
            "return -(0.5 * t * t",
            "return (0.5 * t * t",
            kernel("catmull-rom"),
            "value",
        ),
        fault(
            "field/gradient/tensor_gradient",
            "s1 * w[1].value[j], s0 * w[1].first[j]",
            "s0 * w[1].first[j], s1 * w[1].value[j]",
            kernel("bspline"),
            "gradient",
        ),
        // Gradients: a border, a case, a swapped axis.
        fault("field/gradient/sobel", "select(0.5 * u, u, at_start)", "0.5 * u", gradient("sobel"), "gradient"),
        fault(
            "field/gradient/regression",
            "4 * sides(voxel.y, last.y",
            "4 * sides(voxel.x, last.x",
            gradient("regression"),
            "gradient",
        ),
        fault(
            "field/gradient/regression",
            "lerp3(near, far, at.w.z)",
            "lerp3(near, far, at.w.y)",
            gradient("regression"),
            "gradient",
        ),
        // Curvatures: a one-sided difference, swapped entries, a sign, the unit.
        fault(
            "field/hessian/central",
            "-1.5, 2.0, -0.5",
            "-1.0, 1.0, 0.0",
            curved("central", "trilinear"),
            "curvature",
        ),
        fault(
            "field/hessian/tensor_hessian",
            "vec3<real>(s01 * slope, s10 * slope",
            "vec3<real>(s10 * slope, s01 * slope",
            curved("analytic", "bspline"),
            "curvature",
        ),
        fault(
            "field/hessian/curvature",
            "vec2<real>(m + r, m - r)",
            "vec2<real>(m - r, m + r)",
            curved("gaussian", "trilinear"),
            "curvature",
        ),
        // Masked cells: the sample on the wrong side of a cell, nothing masked.
        fault("ray/skip_masked", "select(0, 1, is_masked", "select(0, 0, is_masked", masked(), "value"),
        fault("field/mask", "cell.z * MASK_Y + cell.y", "cell.z * MASK_Y + cell.x", masked(), "value"),
        // Surfaces: the last share, the corners, the step.
        fault("ray/surface", "return hit + 0.5 - real(k);", "return 1.0;", surface(""), "opacity"),
        fault("ray/surface", "i32(ceil(hit)) - 1", "i32(ceil(hit))", surface(""), "opacity"),
        fault("surface/first_root_trilinear", "two / 3.0", "one / 3.0", surface(""), "depth"),
        fault("surface/traversal", "face = real(behind);", "face = real(behind) + 0.5;", surface(""), "depth"),
        fault("surface/first_root_stepped", "bracketed(start, at_start, end, at_end)", "end", stepped(), "depth"),
    ]
}

#[test]
fn faults_of_the_field_are_noticed() {
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
