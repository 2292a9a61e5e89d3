//! A scene of each kind: its bound, the error of f32, their ratio, and the share of pixels that hang on a decision.

use crate::common::{Stage, ball, orthographic, perspective, style};
use drypoint::reference::ray::bounds::RayOrigin;
use drypoint::scene::glam::DVec3;
use drypoint::scene::lighting::LightingPreset;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{
    Axis, BlendSpace, Clip, Contours, Iso, Kappa, Kernel, Length, Node, NodeColor, Number, Over, RaysPerPixel, Row,
    RowAt, Shading, ShadingModel, SignFlip, SilhouetteShading, StyleMipmaps, Surface, SurfaceLook, Table, Transparency,
};
use std::collections::BTreeMap;

/// A ball of 24³ voxels, seen from an angle at which no lattice lies on another.
fn seen(stage: Stage) -> Stage {
    stage.seen_along([0.37, 0.81, -0.43]).with(|s| {
        s.picture.size = [48, 48];
        s.camera.projection = perspective(28.3).projection;
        s.sampling.step = Length::Voxels(0.5);
        s.sampling.reference_length = Length::Voxels(1.0);
    })
}

const NODES: [(f64, [f64; 3], f64); 4] =
    [(-2.0, [0.9, 0.4, 0.2], 0.0), (0.5, [0.9, 0.6, 0.2], 0.3), (3.0, [0.3, 0.5, 0.9], 0.1), (6.0, [1.0; 3], 0.8)];

fn regular() -> Stage {
    seen(Stage::regular(ball(24, 8.0), &NODES))
}

fn shaded(change: impl FnOnce(&mut Shading)) -> Stage {
    regular().with(|s| change(s.shading.insert(Shading::default())))
}

fn styled() -> Stage {
    let styles = vec![
        style("wax", 32, |x, y| [0.6 + 0.4 * x, 0.5 - 0.3 * y, 0.3 + 0.2 * x * y, 1.0]),
        style("glass", 32, |x, y| [0.2, 0.4, 0.9, 0.1 + 0.9 * (x * x + y * y).min(1.0)]),
    ];
    let nodes = [(-2.0, "glass", 0.0), (0.5, "glass", 0.4), (3.0, "wax", 0.2), (6.0, "wax", 0.9)];
    seen(Stage::styled(ball(24, 8.0), styles, &nodes))
}

fn contours(kappa: Kappa) -> Contours {
    Contours { thickness: Length::Voxels(1.5), kappa, sign_flip: SignFlip::TwoSided, fade: None }
}

/// Rows over the magnitude of the gradient.
fn over_two() -> Stage {
    let row = |at: f64, opacity: f64| {
        let node =
            |&(at, color, o): &(f64, [f64; 3], f64)| Node { at, color: NodeColor::Color(color), opacity: o * opacity };
        Row { at: RowAt::Number(at), nodes: NODES.iter().map(node).collect() }
    };
    regular().with_transfer(|t| {
        t.over = Over::Two([Axis::Value, Axis::GradientMagnitude]);
        (t.nodes, t.rows) = (None, Some(vec![row(0.0, 0.1), row(0.9, 0.5), row(1.1, 1.0)]));
    })
}

fn surface(look: SurfaceLook) -> Stage {
    regular().with(|s| s.surface = Some(Surface { iso: Iso::Value(4.0), look, ..Surface::default() }))
}

/// An iso-surface alone, of a kernel whose cells are no cubics along a ray.
fn smooth(kernel: Kernel) -> Stage {
    surface(SurfaceLook::Phong).with(|s| {
        s.sampling.kernel = kernel;
        s.transfer = None;
    })
}

/// A cut through the middle.
fn cut(cap: Option<[f64; 4]>) -> Clip {
    let (point, normal) = (DVec3::new(11.7, 11.1, 12.9), DVec3::new(0.4, -0.8, 0.3));
    Clip { point: Some(point), normal: Some(normal), cap, ..Clip::default() }
}

/// A function that is read from a table.
fn from_table(stage: Stage, entries: usize) -> Stage {
    stage.with_transfer(|t| t.table = Table::Entries(entries))
}

/// All kinds, by name.
fn kinds() -> Vec<(&'static str, Stage)> {
    let all = |kappa| {
        styled().with(|s| {
            s.contours = Some(contours(kappa));
            s.style_mipmaps = Some(StyleMipmaps::default());
            s.transfer.as_mut().unwrap().transparency = Transparency::Illustrative;
        })
    };
    vec![
        ("unshaded", regular()),
        ("orthographic", regular().with(|s| s.camera.projection = orthographic(None).projection)),
        ("Phong", shaded(|_| {})),
        ("Phong, encoded", shaded(|_| {}).with(|s| s.picture.blend_space = BlendSpace::Srgb)),
        (
            "toon, silhouette",
            shaded(|shading| {
                shading.model = ShadingModel::Toon;
                shading.silhouette = Some(SilhouetteShading { offset: 0.45 });
            }),
        ),
        (
            "lighting function",
            shaded(|shading| {
                shading.model = ShadingModel::Function;
                shading.preset = Some(LightingPreset::MetalContours);
            }),
        ),
        ("view-dependent opacity", shaded(|shading| shading.view_opacity = 1.0)),
        ("ends at 0.9", shaded(|_| {}).with(|s| s.sampling.stop_below = 0.1)),
        ("styles", styled()),
        ("styles, contours, mips", all(Kappa::Ray)),
        ("styles, exact κ", all(Kappa::Exact)),
        ("two quantities", over_two()),
        ("iso-surface", surface(SurfaceLook::Phong)),
        ("iso-surface, toon", surface(SurfaceLook::Toon)),
        ("clip plane", shaded(|_| {}).with(|s| s.clips = vec![cut(None)])),
        ("table", from_table(shaded(|_| {}), 64)),
        ("table of 4096", from_table(shaded(|_| {}), 4096)),
        ("table of styles", from_table(all(Kappa::Ray), 256)),
        ("rays at edges", shaded(|_| {}).with(|s| s.picture.samples = RaysPerPixel::Auto)),
        ("rays at edges, toon", surface(SurfaceLook::Toon).with(|s| s.picture.samples = RaysPerPixel::Auto)),
        ("iso-surface, cut", surface(SurfaceLook::Phong).with(|s| s.clips = vec![cut(None)])),
        (
            "iso-surface alone, capped",
            surface(SurfaceLook::Phong).with(|s| {
                s.clips = vec![cut(Some([0.9, 0.1, 0.2, 0.5]))];
                s.transfer = None;
            }),
        ),
        ("iso-surface, B-spline", smooth(Kernel::BsplineSmooth)),
        ("iso-surface, Catmull–Rom", smooth(Kernel::CatmullRom)),
        ("iso-surface, B-spline, cut", smooth(Kernel::BsplineSmooth).with(|s| s.clips = vec![cut(None)])),
    ]
}

/// The largest bound and error of the decided pixels, and the share of the others.
fn compared(name: &str, stage: &Stage) -> (f64, f64, f64) {
    let bounds = stage.bounds(RayOrigin::Eye).unwrap();
    let single = stage.in_number(Number::F32).render();
    let [values, errors] = [&bounds.values, &bounds.errors].map(|p| &p.layer(LayerKind::Beauty).unwrap().channels);
    let (mut bound, mut measured): (f64, f64) = (0.0, 0.0);
    let mut reasons = BTreeMap::new();
    for (i, pixel) in single.pixels().iter().enumerate() {
        if let Some(decision) = bounds.undecided[i] {
            *reasons.entry(decision).or_insert(0) += 1;
            continue;
        }
        for c in 0..4 {
            let off = (pixel[c] - values[c][i]).abs();
            assert!(off <= errors[c][i], "{name}, pixel {i}, channel {c}: off by {off:e}, bound {:e}", errors[c][i]);
            (bound, measured) = (bound.max(errors[c][i]), measured.max(off));
        }
    }
    let share = reasons.values().sum::<usize>() as f64 / bounds.undecided.len() as f64;
    println!("{name:<24} {bound:9.2e} {measured:9.2e} {:7.1} {:6.2} % {reasons:?}", bound / measured, 100.0 * share);
    (bound, measured, share)
}

#[test]
fn each_kind_of_scene_is_within_its_bounds() {
    println!("scene                        bound  measured   ratio undecided");
    for (name, stage) in kinds() {
        let (_, measured, share) = compared(name, &stage);
        assert!(measured > 0.0 && share < 0.02, "{name}: {measured:e}, {share}");
    }
}
