//! Strokes without an iso-value ([HATCH-16]): wherever the transfer function shows something, and as opaque as that.

use super::page;
use drypoint::job::RenderTarget;
use drypoint::scene::glam::DVec3;

const RING: f64 = 14.0;
const TUBE: f64 = 6.0;

/// A torus of distances, of which values between 0 and 2 are seen, most at 1.
fn scene(more: &str) -> String {
    format!(
        "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 49, type = \"f64\", param = {{ R = {RING}, r = {TUBE} }} }}\n\
         [camera]\nprojection = \"orthographic\"\ndirection = [0.2, 0.5, -0.8]\n\
         [picture]\nwidth = \"100 mm\"\nheight = \"80 mm\"\ndpi = 100\n\
         [transfer]\nkind = \"regular\"\nnodes = [{{ at = 0, color = \"white\", opacity = 0 }}, {{ at = 1, color = \"white\", opacity = 1 }}, {{ at = 2, color = \"white\", opacity = 0 }}]\n\
         [hatching]\niso = \"transfer\"\n{more}"
    )
}

/// Seeds are in the cells whose range of voxels meets the open range of what is seen, and each stroke stays at a value.
#[test]
fn strokes_fill_what_is_seen() {
    let (marks, counts, job) = page(&scene("seeds = \"dense\"\n[hatching.stroke]\ntone = 0\n"), RenderTarget::Strokes);
    let volume = &job.volume;
    let seen = |x: usize, y: usize, z: usize| {
        let corners = (0..8).map(|c| volume.value([x + (c & 1), y + (c >> 1 & 1), z + (c >> 2)]));
        let (lo, hi) = corners.fold((f64::MAX, f64::MIN), |(lo, hi), v| (lo.min(v), hi.max(v)));
        hi > 0.0 && lo < 2.0
    };
    let cells = (0..48usize.pow(3)).filter(|i| seen(i % 48, i / 48 % 48, i / 48 / 48)).count();
    assert_eq!(counts.preprocess["seeds"], cells as u64);
    assert_eq!((counts.preprocess["looks for what hides"], counts.bytes["surface"]), (0, 0));
    // The value, which a trilinear field has to (1/8)·(1/r + 1/(R − r)) of a voxel, and a step of opacity.
    let value = |world: DVec3| {
        let p = world - volume.grid().centre();
        TUBE - (p.x.hypot(p.y) - RING).hypot(p.z)
    };
    let lines: Vec<_> = marks.layers.iter().flat_map(|layer| &layer.lines).collect();
    assert!(lines.len() > 3000, "{}", lines.len());
    let mut far = 0;
    for line in &lines {
        let values: Vec<f64> = line.vertices.iter().map(|v| value(v.world)).collect();
        // Where the next vertex is in another cell the stroke is as far off as its chord, 0.1 voxel, and the step's drift.
        let (lo, hi) = values.iter().fold((f64::MAX, f64::MIN), |(lo, hi), v| (lo.min(*v), hi.max(*v)));
        far += usize::from(hi - lo > 0.3);
        for (vertex, value) in line.vertices.iter().zip(&values) {
            let alpha = (1.0 - (value - 1.0).abs()).max(0.0);
            assert!((vertex.opacity - alpha).abs() < 0.1, "{} {alpha}", vertex.opacity);
        }
    }
    assert!(far * 50 < lines.len(), "{far}");
    // Some are outside the surface that has the value 1, some inside, and none where nothing is seen.
    let depths: Vec<f64> = lines.iter().map(|line| value(line.vertices[0].world)).collect();
    assert!(depths.iter().any(|d| *d < 0.6) && depths.iter().any(|d| *d > 1.4));
    assert!(depths.iter().all(|d| (-0.1..2.1).contains(d)));
}

/// A surface beside them hides what lies behind it.
#[test]
fn a_surface_hides_strokes_in_what_is_seen() {
    let lines = |more: &str| {
        let (marks, counts, _) = page(&scene(&format!("seeds = \"dense\"\n{more}")), RenderTarget::Strokes);
        let length: f64 = marks.layers.iter().flat_map(|layer| &layer.lines).map(|line| line.length()).sum();
        (length, counts.preprocess["looks for what hides"])
    };
    let ((all, none), (seen, looks)) = (lines(""), lines("[surface]\niso = 2\nlook = \"none\"\n"));
    assert!(none == 0 && looks > 1000 && seen < 0.8 * all && seen > 0.3 * all, "{all} {seen}");
}
