//! Faults that are planted in the test of hidden points: each must be noticed.

use crate::double::load;
use crate::field::scene;
use crate::points::{Case, compare, plane};
use drypoint::gpu::Precision;
use drypoint::reference::field::{GradientEstimator, Kernel};
use drypoint::scene::clip::ClipPlanes;

#[test]
fn faults_of_hidden_points_are_noticed() {
    let job = load(&scene([9, 8, 10], "float", ""));
    let (none, cut) = (ClipPlanes(Vec::new()), plane(&job));
    for (clip, old, new) in [
        (&none, "return normal_of(g, vec3<real>());", "return -normal_of(g, vec3<real>());"),
        (&none, "* params.in_front;", "* -params.in_front;"),
        (&none, "line_from(p, -voxel_along(n))", "line_from(p, voxel_along(n))"),
        (&none, "<= 0.0 && dot(surface_normal(far), n) > 0.0", "<= 2.0 && dot(surface_normal(far), n) > -2.0"),
        (&none, "line_from(p, way / depth)", "line_from(p, -way / depth)"),
        (&none, "params.near - depth)", "params.near - 0.02 * depth)"),
        (&cut, "return is_cut(p);", "return false;"),
        (&cut, "if (kept.entry >= 0 && is_inside_surface", "if (kept.entry >= 9 && is_inside_surface"),
        (&cut, "if (kept.start > kept.end) {", "if (kept.start > kept.end + 4.0) {"),
    ] {
        let case = Case {
            kernel: Kernel::Trilinear,
            gradient: GradientEstimator::Central,
            clip,
            precision: Precision::Double,
            in_front: 0.15,
        };
        let edit = |text: String| {
            assert_eq!(text.matches(old).count(), 1, "{old}");
            text.replace(old, new)
        };
        let Some(found) = compare(&job, &case, &edit) else { return };
        println!("{new}: {found:?}");
        assert!(found[2] > 0, "{old} → {new}");
    }
}
