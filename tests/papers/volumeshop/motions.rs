//! Moved selections are the moved field ([VS-2]): an object that is moved looks as if the camera had moved the other way.

use super::{SHELLS, difference, drawn, scene_of, seen};

/// Everything moves, and its ghost is not seen.
fn moved(look: &str, camera: &str, motion: &str) -> String {
    let clear = "[object.ghost.transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 0 }]\n";
    scene_of(VOLUME, &format!("{look}[camera]\n{camera}[[object]]\n{motion}\n{clear}"))
}

/// A body without symmetries, on a grid of unequal spacings.
pub(super) const VOLUME: &str = "phantom = { name = \"specimen\", size = [28, 24, 20], spacing = [1, 1.25, 1.5] }";

/// Looks that read the normal, |N|, κ along the ray and by Hessians.
const LOOKS: [&str; 4] = [
    "[transfer]\nkind = \"regular\"\n\
     nodes = [{ at = 60, color = \"#c08040\", opacity = 0 }, { at = 200, color = \"#4080c0\", opacity = 0.4 }]\n[shading]\n",
    "[transfer]\nnodes = [{ at = 60, style = \"wax\", opacity = 0 }, { at = 200, style = \"metal\", opacity = 0.5 }]\n[contours]\n",
    "[transfer]\nnodes = [{ at = 60, style = \"wax\", opacity = 0 }, { at = 200, style = \"metal\", opacity = 0.5 }]\n\
     [contours]\nkappa = \"exact\"\n[sampling]\nkernel = \"bspline\"\n",
    "[transfer]\nkind = \"regular\"\nover = [\"value\", \"k1\"]\nrows = [{ at = -0.3, nodes = [{ at = 60, color = \"red\", opacity = 0.2 }] }, \
     { at = 0.3, nodes = [{ at = 60, color = \"blue\", opacity = 0.6 }] }]\n[sampling]\nkernel = \"bspline\"\n",
];

/// Each motion beside the camera that undoes it: the eye about the target (14, 15, 15), and up.
#[test]
fn a_moved_object_is_seen_as_by_a_moved_camera() {
    let about = "center = [14, 15, 15]\n";
    for (motion, [eye, up, target], back) in [
        // Moved by (2, 3, −1).
        (
            "move = [2, 3, -1]".to_string(),
            ["[-30, 5, 20]", "[0, 0, 1]", "[14, 15, 15]"],
            ["[-32, 2, 21]", "[0, 0, 1]", "[12, 12, 16]"],
        ),
        // Turned by 90° about z through the target: (x, y) → (−y, x) of the offsets. The camera turns back.
        (
            format!("rotate = {{ axis = [0, 0, 2], angle = 90 }}\n{about}"),
            ["[-30, 5, 20]", "[0, 0, 1]", "[14, 15, 15]"],
            ["[4, 59, 20]", "[0, 0, 1]", "[14, 15, 15]"],
        ),
    ] {
        for look in LOOKS {
            let camera = |[eye, up, target]: [&str; 3]| format!("eye = {eye}\nup = {up}\ntarget = {target}\n");
            let (picture, _) = drawn(&moved(look, &camera([eye, up, target]), &motion));
            let (plain, _) = drawn(&scene_of(VOLUME, &format!("{look}[camera]\n{}", camera(back))));
            let off = difference(&plain, &picture);
            assert!(seen(&plain) > 10.0 && off < 1e-9, "{motion}: {off:e}\n{look}");
        }
    }
}

/// A body that a plane mirrors onto itself is the same mirrored; the sign of the determinant turns no normal.
#[test]
fn a_mirrored_body_with_a_plane_of_symmetry_is_itself() {
    let volume = "phantom = { name = \"ellipsoid\", size = 24 }";
    let clear = "[object.ghost.transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 0 }]\n";
    for look in LOOKS {
        let rest = format!("{look}[camera]\ndirection = [-1, -0.4, -0.7]\n");
        let (plain, _) = drawn(&scene_of(volume, &rest));
        for scale in ["[-1, 1, 1]", "[1, -1, 1]", "-1"] {
            let (picture, _) = drawn(&scene_of(volume, &format!("{rest}[[object]]\nscale = {scale}\n{clear}")));
            let off = difference(&plain, &picture);
            assert!(seen(&plain) > 10.0 && off < 1e-9, "{scale}: {off:e}\n{look}");
        }
    }
}

/// |N| and the test for normals are those of the data: a copy a million times as large has normals, too, and is not all
/// contour.
#[test]
fn a_huge_copy_has_normals() {
    let text = |scale: &str, rest: &str| {
        let camera = "[camera]\nprojection = \"orthographic\"\nheight = 30\ndirection = [0, 0, -1]\nup = [0, 1, 0]\n";
        let large = camera.replace("height = 30", "height = 3e7");
        let camera = if scale == "1" { camera.to_string() } else { large };
        let step = if scale == "1" { "0.5" } else { "5e5" };
        scene_of(
            SHELLS,
            &format!(
                "{}{camera}[sampling]\nstep = {step}\nreference_length = {}\n{rest}",
                LOOKS[0],
                if scale == "1" { "1" } else { "1e6" }
            ),
        )
    };
    let (plain, _) = drawn(&text("1", ""));
    let clear = "[object.ghost.transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 0 }]\n";
    let (large, counts) = drawn(&text("1e6", &format!("[[object]]\nscale = 1e6\n{clear}")));
    assert!(difference(&plain, &large) < 1e-6 && counts.without_normal * 10 < counts.samples);
}
