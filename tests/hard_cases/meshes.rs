//! Opaque meshes beside the volume ([VS-12]): where they are, what they hide, and what covers them.

use crate::common::{Stage, ball, orthographic, perspective, volume};
use crate::stability::{Case, Theme, rounding, worst};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::mesh::TriangleMesh;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Camera, Iso, Length, MeshTable, Number, Shading, StepAlong, Surface, SurfaceLook};

pub(crate) static THEME: Theme = Theme::new(
    "Meshes",
    &[
        Case {
            name: "a plane of two triangles before, in and behind the volume; sheared and 1:1:4",
            breaks: "triangles that a tree in f32 leaves out; depths rounded to sample planes",
            done: "the tree is grown outwards and only says which triangles are tested; the test is in f64 [VS-12]",
            of: "|Z − closed form| in units of 256 ε times the distance from the eye; missed pixels count 10⁹",
            bound: 1.0,
            why: "corners and rays round by some ε in index space, and a plane is met at no less than a tenth of its slope",
            measure: || plane_depths(Number::F64),
        },
        Case {
            name: "the same in f32",
            breaks: "as above",
            done: "rays are rounded to f32, triangles are not",
            of: "|Z − closed form| in units of 512 u times the distance from the eye; missed pixels count 10⁹",
            bound: 1.0,
            why: "as above, with the ε of f32",
            measure: || plane_depths(Number::F32),
        },
        Case {
            name: "a translucent slab before a mesh that moves by small parts of a step",
            breaks: "terraces: one sample more or less",
            done: "the last sample before the mesh stands for the way up to it",
            of: "|ln T − closed form| between neighbouring places; Δ 0.1 to 1.7, planes and shells",
            bound: 1e-12,
            why: "the way grows by as much as the mesh moves; the rest is rounding",
            measure: slab_before_a_mesh,
        },
        Case {
            name: "a mesh and an iso-surface that cut each other",
            breaks: "the farther of the two in front",
            done: "the nearer one ends the ray",
            of: "differing bits of Z from the smaller of both alone",
            bound: 0.0,
            why: "each is found by itself",
            measure: crossing_a_surface,
        },
        Case {
            name: "a mesh in a translucent ball, ray by ray and plane by plane, with and without skipping",
            breaks: "a share of a sample that one order takes and the other does not",
            done: "one path for both orders [RAY-3]",
            of: "differing bits",
            bound: 0.0,
            why: "the path is made before it is walked",
            measure: orders,
        },
    ],
);

#[test]
fn meshes() {
    THEME.hold();
}

const NORMAL: DVec3 = DVec3::new(0.48, 0.6, -0.64);

/// Half the side of a plane.
const REACH: f64 = 40.0;

/// A square of two triangles about a point.
fn square(at: DVec3, normal: DVec3, half: f64) -> TriangleMesh {
    let (u, w) = normal.any_orthonormal_pair();
    let corner = |x: f64, y: f64| at + (u * x + w * y) * half;
    let corners = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    TriangleMesh::new(corners, None, vec![[0, 1, 2], [0, 2, 3]]).unwrap()
}

/// A scene with a white mesh that shines by itself.
fn with_mesh(stage: &Stage, mesh: TriangleMesh) -> Stage {
    let mut stage = stage.with(|s| {
        s.meshes = vec![MeshTable { color: [1.0; 4], ..MeshTable::default() }];
        s.shading = Some(Shading { ambient: 1.0, diffuse: 0.0, specular: 0.0, ..Shading::default() });
    });
    stage.meshes = vec![mesh];
    stage
}

fn plane_depths(number: Number) -> f64 {
    let sheared = DMat3::from_cols(DVec3::new(1.0, 0.2, 0.0), DVec3::new(-0.3, 0.9, 0.1), DVec3::new(0.2, 0.4, 1.1));
    let grids = [
        Grid::with_spacing([9, 8, 10], [1.0; 3]).unwrap(),
        Grid::with_spacing([9, 10, 5], [1.0, 1.0, 4.0]).unwrap(),
        Grid::new([8, 9, 9], sheared, DVec3::new(-4.0, 7.0, 10.0)).unwrap(),
    ];
    let mut all = Vec::new();
    for grid in grids {
        let empty = Stage::regular(crate::common::on(grid.clone(), |_| 0.0), &[(0.0, [1.0; 3], 0.0)]);
        for level in [0.371, -8.3, 9.7] {
            let shot = with_mesh(&empty, square(grid.centre() + NORMAL * level, NORMAL, REACH));
            let shot = shot.layers(&[LayerKind::Z]).in_number(number).with(|s| s.picture.size = [12, 12]);
            for direction in [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.7, 0.5, -0.2]] {
                for camera in [orthographic(None), perspective(40.0)] {
                    let camera = Camera { direction: direction.into(), ..camera };
                    all.extend(off_the_plane(&shot.with(|s| s.camera = camera), level));
                }
            }
        }
    }
    assert!(all.len() > 5000, "{}", all.len());
    worst(all)
}

/// The error of each pixel's Z, of those that meet the plane well before its end.
fn off_the_plane(shot: &Stage, level: f64) -> Vec<f64> {
    let (view, centre) = (shot.view(), shot.volume.grid().centre());
    let z = shot.render().one(LayerKind::Z);
    let width = shot.scene.picture.size[0];
    let pixels = z.into_iter().enumerate().filter_map(|(t, z)| {
        let ray = view.ray((t % width) as f64 + 0.5, (t / width) as f64 + 0.5);
        let slope = NORMAL.dot(ray.along);
        let depth = (level - NORMAL.dot(ray.origin - centre)) / slope;
        let is_met = (ray.origin + ray.along * depth - centre - NORMAL * level).length() < 0.9 * REACH
            && slope.abs() > 0.1 * ray.along.length()
            && (!view.perspective || depth > 1.0);
        let distance = depth.abs() + ray.origin.length() + 10.0;
        let off = (z - depth).abs() / (512.0 * rounding(shot.scene.sampling.number) * distance);
        is_met.then_some(if z.is_finite() { off } else { 1e9 })
    });
    pixels.collect()
}

const ALPHA: f64 = 0.3;

/// A red haze before a white square at y = `at`, in a box that begins at y = 0, seen along +y.
fn haze(at: f64, step: f64, shells: bool) -> Stage {
    let field = volume([5, 21, 5], |p| p.y);
    let red = Stage::regular(field, &[(0.0, [1.0, 0.0, 0.0], ALPHA)]);
    with_mesh(&red, square(DVec3::new(2.0, at, 2.0), DVec3::Y, REACH)).with(|s| {
        s.camera = Camera { direction: DVec3::Y, ..orthographic(Some(3.0)) };
        s.sampling.step = Length::World(step);
        s.sampling.reference_length = Length::World(1.0);
        if shells {
            s.camera = perspective(5.0);
            (s.camera.eye, s.camera.target) = (Some(DVec3::new(2.0, -30.0, 2.0)), Some(DVec3::new(2.0, 10.0, 2.0)));
            s.sampling.step_along = StepAlong::Ray;
        }
    })
}

fn slab_before_a_mesh() -> f64 {
    let mut all = Vec::new();
    for (step, shells) in [(0.1, false), (0.37, false), (1.0, false), (1.7, false), (0.37, true), (1.7, true)] {
        let through = |at: f64| -> Vec<[f64; 2]> {
            let shot = haze(at, step, shells);
            let view = shot.view();
            let of_pixel = |(t, p): (usize, [f64; 4])| {
                assert_eq!(p[3], 1.0, "a mesh is opaque");
                [p[1].ln(), view.ray((t % 16) as f64 + 0.5, (t / 16) as f64 + 0.5).cos_phi]
            };
            shot.render().pixels().into_iter().enumerate().map(of_pixel).collect()
        };
        let moved = 0.013;
        let places: Vec<_> = (0..150).map(|i| through(5.0 + f64::from(i) * moved)).collect();
        for pair in places.windows(2) {
            for ([a, cos], [b, _]) in pair[0].iter().zip(&pair[1]) {
                all.push((b - a - moved / cos * f64::ln_1p(-ALPHA)).abs());
            }
        }
    }
    worst(all)
}

/// A ball of radius 8 in a box of 26³, translucent, from an oblique view.
fn translucent_ball() -> Stage {
    let hill = [(-1.0, [0.0, 0.0, 1.0], 0.0), (2.0, [0.0, 1.0, 0.0], 0.2), (8.0, [1.0, 0.0, 0.0], 0.1)];
    Stage::regular(ball(26, 8.0), &hill).with(|s| {
        s.camera.direction = DVec3::new(0.3, 0.9, -0.5);
        s.picture.size = [48, 48];
    })
}

fn crossing_a_surface() -> f64 {
    let stage = translucent_ball().layers(&[LayerKind::Z]).with(|s| s.transfer = None);
    let surface = Some(Surface { iso: Iso::Value(0.0), look: SurfaceLook::White, ..Surface::default() });
    let alone = stage.with(|s| s.surface = surface.clone());
    let mesh = square(DVec3::splat(12.0), NORMAL, 11.0);
    let both = with_mesh(&alone, mesh.clone());
    let depths = |stage: &Stage| stage.render().one(LayerKind::Z);
    let [ball, plane, both] = [&alone, &with_mesh(&stage, mesh), &both].map(depths);
    let nearer = |wins: fn(&f64, &f64) -> bool| ball.iter().zip(&plane).filter(|(a, b)| wins(a, b)).count();
    assert!(nearer(|a, b| a < b) > 100 && nearer(|a, b| b < a) > 100);
    let closer = ball.iter().zip(&plane).map(|(a, b)| a.min(*b));
    closer.zip(&both).filter(|(expected, got)| expected.to_bits() != got.to_bits()).count() as f64
}

fn orders() -> f64 {
    let stage = with_mesh(&translucent_ball(), square(DVec3::splat(12.0), NORMAL, 6.0)).layers(&crate::common::LAYERS);
    let first = stage.render();
    let ways = [
        stage.render_by(|renderer| renderer.plane_by_plane()),
        stage.render_in_tiles(3),
        stage.with(|s| s.sampling.skip_empty = false).render(),
    ];
    let (bits, opaque) = (first.bits(), first.pixels().iter().filter(|p| p[3] == 1.0).count());
    assert!((100..2000).contains(&opaque), "{opaque}");
    ways.iter().map(|way| way.bits().iter().zip(&bits).filter(|(a, b)| a != b).count() as f64).sum()
}

/// Blinn–Phong by hand on a square that is seen obliquely, from both sides; it has no value, gradient or curvature.
#[test]
fn light_and_layers_of_a_mesh_in_closed_form() {
    let empty = Stage::regular(volume([9; 3], |_| 0.0), &[(0.0, [1.0; 3], 0.0)]);
    let material = Shading { ambient: 0.2, diffuse: 0.5, specular: 0.25, shininess: 8.0, ..Shading::default() };
    for normal in [NORMAL, -NORMAL] {
        let stage =
            with_mesh(&empty, square(DVec3::splat(4.0), normal, REACH)).layers(&crate::common::LAYERS).with(|s| {
                s.shading = Some(material.clone());
                s.meshes[0].color = [0.9, 0.6, 0.3, 1.0];
            });
        let shown = stage.render();
        // The head light is v, and v = −y in an orthographic view along +y.
        let cosine = NORMAL.y.abs();
        for (p, color) in shown.pixels().iter().flat_map(|p| [(p[0], 0.9), (p[1], 0.6), (p[2], 0.3)]) {
            let expected = color * (0.2 + 0.5 * cosine) + 0.25 * cosine.powi(8);
            assert!((p - expected).abs() < 1e-14, "{p} {expected}");
        }
        assert!(shown.layer::<3>(LayerKind::Normal).iter().all(|n| (n[2] - cosine).abs() < 1e-14));
        assert!(shown.layer::<3>(LayerKind::Gradient).iter().all(|g| *g == [0.0; 3]));
        assert_eq!(shown.counts.gradients, 0);
        assert!(shown.counts.bytes["meshes"] > 0);
    }
}

/// Without a mesh no count and no byte of one is there; a mesh out of sight changes no bit of the picture.
#[test]
fn a_mesh_beside_the_picture_changes_nothing() {
    let stage = translucent_ball().layers(&crate::common::LAYERS);
    let without = stage.render();
    assert!(!without.counts.bytes.contains_key("meshes"));
    let mut beside = stage.clone();
    beside.scene.meshes = vec![MeshTable::default()];
    beside.meshes = vec![square(DVec3::new(900.0, 0.0, 0.0), DVec3::X, 1.0)];
    let beside = beside.render();
    assert_eq!(beside.bits(), without.bits());
    assert_eq!(beside.counts.samples, without.counts.samples);
}
