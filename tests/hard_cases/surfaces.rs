//! Opaque iso-surfaces ([HATCH-14]): where they are, what they hide, what they cost.

use crate::common::random::Random;
use crate::common::{LAYERS, Stage, ball, on, orthographic, perspective, quadratic_ball, volume};
use crate::stability::{Case, Theme, rounding, worst};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    Camera, GradientEstimator, Iso, Kernel, Length, Number, Outside, Shading, StepAlong, Surface, SurfaceLook,
};
use drypoint::scene::volume::{Volume, Voxels};

pub(crate) static THEME: Theme = Theme::new(
    "Iso-surfaces",
    &[
        Case {
            name: "a plane, seen along axes, obliquely, from inside; 1:1:4 and sheared",
            breaks: "roots lost at the faces of cells; depths rounded to sample planes",
            done: "the first root of the cubic in each cell along the ray, faces shared to the bit [HATCH-14]",
            of: "|Z − closed form| in units of 256 ε times the distance from the eye; missed pixels count 10⁹",
            bound: 1.0,
            why: "values round by some ε, and a plane is met at no less than a tenth of its slope",
            measure: || plane_depths(Number::F64),
        },
        Case {
            name: "the same in f32",
            breaks: "as above",
            done: "as above",
            of: "|Z − closed form| in units of 512 u times the distance from the eye; missed pixels count 10⁹",
            bound: 1.0,
            why: "as above, with the ε of f32",
            measure: || plane_depths(Number::F32),
        },
        Case {
            name: "a translucent slab before a plane that moves by small parts of a step",
            breaks: "terraces: one sample more or less",
            done: "the last sample before the surface stands for the way up to it",
            of: "|ln T − closed form| between neighbouring planes; Δ 0.1 to 1.7, planes and shells",
            bound: 1e-12,
            why: "the way grows by as much as the plane moves; the rest is rounding",
            measure: slab_before_a_plane,
        },
        Case {
            name: "the same against the whole way from the box's face on",
            breaks: "samples behind the surface that count",
            done: "a sample counts if its plane lies before the root",
            of: "|α − closed form| in units of one step's opacity",
            bound: 1.0,
            why: "the lattice belongs to the camera: one step at the face of the box [RAY-1]",
            measure: slab_up_to_a_plane,
        },
        Case {
            name: "a ball, white, orthographic",
            breaks: "holes, and a rim that is cut off or too wide",
            done: "as above; other kernels are looked at every quarter of a voxel",
            of: "pixels within 0.01 voxels of the rim left out: those that the disc of radius R has wrong",
            bound: 0.0,
            why: "a chord that is shorter than a quarter of a voxel lies nearer to the rim than that",
            measure: disc,
        },
        Case {
            name: "the eye inside the iso-surface",
            breaks: "a surface whose front lies behind the eye",
            done: "roots begin at `near`; both sides of a surface are drawn",
            of: "|Z − closed form| in units of 10⁻⁹; pixels without a surface count 10⁹",
            bound: 1.0,
            why: "the quintic spline has the field to 10⁻¹³, and bisection goes on to the last bit",
            measure: from_inside,
        },
        Case {
            name: "values × 2⁻⁹⁰⁰ … 2¹⁰⁰⁰",
            breaks: "squares in the discriminant leave the numbers",
            done: "differences from the value are scaled by the power of two of the largest",
            of: "differing bits of coverage and depth",
            bound: 0.0,
            why: "roots do not depend on the scale",
            measure: scaled,
        },
    ],
);

#[test]
fn surfaces() {
    THEME.hold();
}

fn surface(look: SurfaceLook, iso: f64) -> Option<Surface> {
    Some(Surface { iso: Iso::Value(iso), look, ..Surface::default() })
}

/// A surface alone.
fn alone(volume: Volume, look: SurfaceLook, iso: f64) -> Stage {
    Stage::regular(volume, &[(0.0, [1.0; 3], 0.0)]).layers(&[LayerKind::Z]).with(|s| {
        s.transfer = None;
        s.surface = surface(look, iso);
    })
}

fn grids() -> [Grid; 3] {
    let sheared = DMat3::from_cols(DVec3::new(1.0, 0.2, 0.0), DVec3::new(-0.3, 0.9, 0.1), DVec3::new(0.2, 0.4, 1.1));
    [
        Grid::with_spacing([9, 8, 10], [1.0; 3]).unwrap(),
        Grid::with_spacing([9, 10, 5], [1.0, 1.0, 4.0]).unwrap(),
        Grid::new([8, 9, 9], sheared, DVec3::new(-4.0, 7.0, 10.0)).unwrap(),
    ]
}

const NORMAL: DVec3 = DVec3::new(0.48, 0.6, -0.64);

/// Off the middle, so that no ray has its root on a face that it runs in.
const LEVEL: f64 = 0.371;

/// The field of a plane through the middle of a grid.
fn plane(grid: &Grid) -> Volume {
    let centre = grid.centre();
    on(grid.clone(), |p| NORMAL.dot(p - centre))
}

fn plane_depths(number: Number) -> f64 {
    let mut all = Vec::new();
    for grid in grids() {
        for kernel in [Kernel::Trilinear, Kernel::CatmullRom, Kernel::BsplineSmooth] {
            let shot = alone(plane(&grid), SurfaceLook::White, LEVEL).with(|s| {
                s.sampling.kernel = kernel;
                s.sampling.number = number;
                s.picture.size = [12, 12];
            });
            for direction in [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.7, 0.5, -0.2], [1.0, 1.0, -1.0]] {
                for (camera, inside) in
                    [(orthographic(None), false), (perspective(40.0), false), (perspective(90.0), true)]
                {
                    let shot = shot.with(|s| {
                        s.camera = camera.clone();
                        s.camera.direction = direction.into();
                        s.camera.eye = inside.then(|| grid.centre() - DVec3::from(direction) * 0.4);
                        s.camera.direction_given = inside;
                        s.camera.near = Some(Length::World(1e-3));
                    });
                    all.extend(off_the_plane(&shot));
                }
            }
        }
    }
    assert!(all.len() > 5000, "{}", all.len());
    worst(all)
}

/// For each pixel that meets the plane well inside the box, how far off its Z is.
fn off_the_plane(shot: &Stage) -> Vec<f64> {
    let (view, grid) = (shot.view(), shot.volume.grid());
    let [lo, hi] = grid.index_box();
    let z = shot.render().one(LayerKind::Z);
    let width = shot.scene.picture.size[0];
    let pixels = z.into_iter().enumerate().filter_map(|(t, z)| {
        let ray = view.ray((t % width) as f64 + 0.5, (t / width) as f64 + 0.5);
        let slope = NORMAL.dot(ray.along);
        let depth = (LEVEL - NORMAL.dot(ray.origin - grid.centre())) / slope;
        let at = grid.to_index(ray.origin + ray.along * depth);
        let inside = at.cmpgt(lo + 1e-6).all() && at.cmplt(hi - 1e-6).all();
        let met = inside && slope.abs() > 0.1 * ray.along.length() && (!view.perspective || depth > 2e-3);
        let distance = depth.abs() + ray.origin.length() + 10.0;
        met.then(|| {
            if z.is_finite() {
                (z - depth).abs() / (512.0 * rounding(shot.scene.sampling.number) * distance)
            } else {
                1e9
            }
        })
    });
    pixels.collect()
}

const ALPHA: f64 = 0.3;

/// A red haze before a white plane y = `at`, in a box that begins at y = 0, seen along +y.
fn haze(at: f64, step: f64, shells: bool) -> Stage {
    let field = volume([5, 21, 5], |p| p.y);
    Stage::regular(field, &[(0.0, [1.0, 0.0, 0.0], ALPHA)]).with(|s| {
        s.surface = surface(SurfaceLook::White, at);
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

fn slab_before_a_plane() -> f64 {
    let mut all = Vec::new();
    for (step, shells) in [(0.1, false), (0.37, false), (1.0, false), (1.7, false), (0.37, true), (1.7, true)] {
        let through = |at: f64| -> Vec<[f64; 2]> {
            let shot = haze(at, step, shells);
            let view = shot.view();
            let pixels = shot.render().pixels().into_iter().enumerate();
            pixels
                .map(|(t, p)| {
                    assert_eq!(p[3], 1.0, "a surface is opaque");
                    [p[1].ln(), view.ray((t % 16) as f64 + 0.5, (t / 16) as f64 + 0.5).cos_phi]
                })
                .collect()
        };
        let moved = 0.013;
        let planes: Vec<_> = (0..150).map(|i| through(5.0 + f64::from(i) * moved)).collect();
        for pair in planes.windows(2) {
            for ([a, cos], [b, _]) in pair[0].iter().zip(&pair[1]) {
                all.push((b - a - moved / cos * f64::ln_1p(-ALPHA)).abs());
            }
        }
    }
    worst(all)
}

fn slab_up_to_a_plane() -> f64 {
    let mut all = Vec::new();
    for (step, at) in [(0.1, 7.3), (0.37, 3.0), (0.5, 12.0), (1.7, 11.9)] {
        let shot = haze(at, step, false);
        for p in shot.render().pixels() {
            let (through, closed) = (p[1], (at * f64::ln_1p(-ALPHA)).exp());
            // Where the haze is red, what is not red came from the plane.
            assert!((p[0] - 1.0).abs() < 1e-12 && p[1] == p[2]);
            all.push((through - closed).abs() / -f64::exp_m1(step * f64::ln_1p(-ALPHA)));
        }
    }
    worst(all)
}

const RADIUS: f64 = 8.0;

/// A ball that the quintic spline has to rounding.
fn exact_ball(look: SurfaceLook) -> Stage {
    alone(quadratic_ball(26, RADIUS), look, 0.0).with(|s| {
        s.sampling.kernel = Kernel::Bspline5;
        s.sampling.gradient = GradientEstimator::Analytic;
        s.camera = orthographic(Some(20.0));
        s.camera.direction = DVec3::new(0.3, 0.9, -0.5);
        s.picture.size = [64, 64];
    })
}

/// Distance of each pixel's centre from the middle of the picture, in world units, with the pixel.
fn from_the_middle(shot: &Stage) -> impl Iterator<Item = (usize, f64)> {
    let view = shot.view();
    let ([w, h], pixel) = (view.size, view.pixel);
    let middle = move |i: usize, n: usize| (i as f64 + 0.5 - n as f64 / 2.0) * pixel;
    (0..w * h).map(move |t| (t, middle(t % w, w).hypot(middle(t / w, h))))
}

fn disc() -> f64 {
    let shot = exact_ball(SurfaceLook::White);
    let pixels = shot.render().pixels();
    let wrong = from_the_middle(&shot).filter(|&(t, r)| {
        let expected = if r <= RADIUS { [1.0; 4] } else { [0.0; 4] };
        (r - RADIUS).abs() > 0.01 && pixels[t] != expected
    });
    let covered = pixels.iter().filter(|p| p[3] == 1.0).count() as f64;
    // The disc's area to what a circle of that many pixels can be off by.
    let area = std::f64::consts::PI * (RADIUS / shot.view().pixel).powi(2);
    assert!((covered - area).abs() < 4.0 * area.powf(1.0 / 3.0), "{covered} {area}");
    wrong.count() as f64
}

fn from_inside() -> f64 {
    let shot = exact_ball(SurfaceLook::Phong).with(|s| {
        s.camera = perspective(100.0);
        s.camera.eye = Some(DVec3::splat(12.5) + DVec3::new(1.0, -2.0, 0.5));
        (s.camera.direction, s.camera.direction_given) = (DVec3::new(0.2, 0.4, -1.0), true);
        s.picture.size = [24, 24];
    });
    let view = shot.view();
    let offset = view.eye - DVec3::splat(12.5);
    let z = shot.render().one(LayerKind::Z);
    worst(z.into_iter().enumerate().map(|(t, z)| {
        let d = view.ray((t % 24) as f64 + 0.5, (t / 24) as f64 + 0.5).along;
        let (a, b, c) = (d.length_squared(), offset.dot(d), offset.length_squared() - RADIUS * RADIUS);
        let depth = (-b + (b * b - a * c).sqrt()) / a;
        if z.is_finite() { (z - depth).abs() / 1e-9 } else { 1e9 }
    }))
}

fn noise(n: usize, seed: u64, scale: f64) -> Volume {
    let mut r = Random(seed);
    let values = (0..n * n * n).map(|_| r.between(0.0, 1.0) * scale).collect();
    Volume::new(Grid::with_spacing([n; 3], [1.0; 3]).unwrap(), Voxels::F64(values), 1.0, 0.0).unwrap()
}

fn scaled() -> f64 {
    let shown = |k: i32| {
        let scale = f64::powi(2.0, k);
        let shot = alone(noise(9, 5, scale), SurfaceLook::White, 0.8 * scale).seen_along([0.3, 0.8, -0.6]);
        let shown = shot.render();
        assert!((20..256).contains(&shown.covered()), "{}", shown.covered());
        shown.bits()
    };
    let plain = shown(0);
    let differ = |k| plain.iter().zip(shown(k)).filter(|(a, b)| **a != *b).count() as f64;
    worst([-900, -30, 7, 1000].map(differ))
}

/// Sides, lights and materials on a ball, in closed form: N = (centre → point)/R, also where it is turned.
#[test]
fn a_lit_ball_in_closed_form() {
    let material = Shading { ambient: 0.2, diffuse: 0.5, specular: 0.25, shininess: 8.0, ..Shading::default() };
    let lit = exact_ball(SurfaceLook::Phong).with(|s| {
        s.shading = Some(material);
        s.surface = s.surface.clone().map(|surface| Surface { color: [0.9, 0.6, 0.3, 1.0], ..surface });
    });
    // The mirrored field, with the outside high: the same picture.
    let mut mirrored = lit.with(|s| s.volume.outside = Outside::High);
    let grid = mirrored.volume.grid().clone();
    let negated = (0..grid.len()).map(|i| -mirrored.volume.voxels().get(i)).collect();
    mirrored.volume = Volume::new(grid, Voxels::F64(negated), 1.0, 0.0).unwrap();
    let (a, b) = (lit.layers(&LAYERS).render(), mirrored.layers(&LAYERS).render());
    assert!(crate::common::largest_difference(&a, &b) < 1e-12);
    let (normals, curvatures) = (a.layer::<3>(LayerKind::Normal), a.layer::<3>(LayerKind::Curvature));
    let firsts = a.layer::<3>(LayerKind::FirstNormal);
    for (t, r) in from_the_middle(&lit).filter(|(_, r)| *r < RADIUS - 0.02) {
        // The head light is v: N·L = N·Ĥ.
        let cosine = (1.0 - (r / RADIUS).powi(2)).sqrt();
        let [red, green, blue, alpha] = a.pixels()[t];
        for (got, own) in [(red, 0.9), (green, 0.6), (blue, 0.3)] {
            let expected = own * (0.2 + 0.5 * cosine) + 0.25 * cosine.powi(8);
            assert!((got - expected).abs() < 1e-9, "{r}: {got} {expected}");
        }
        assert_eq!(alpha, 1.0);
        assert!((normals[t][2] - cosine).abs() < 1e-9 && normals[t] == firsts[t]);
        assert!((curvatures[t][0] - 1.0 / RADIUS).abs() < 1e-8 && (curvatures[t][1] - 1.0 / RADIUS).abs() < 1e-8);
        assert_eq!(a.one(LayerKind::First)[t], 0.0, "the value is iso");
    }
    let depths = a.layer::<3>(LayerKind::Depth);
    assert!(depths.iter().all(|[first, half, mean]| first == half && half == mean), "one hit, one depth");
}

/// Alone it evaluates no sample; white no gradient, lit one a hit; without the table there is nothing of it.
#[test]
fn what_a_surface_costs() {
    let white = exact_ball(SurfaceLook::White).render();
    let lit = exact_ball(SurfaceLook::Phong).render();
    let hits = white.covered() as u64;
    assert_eq!((white.counts.samples, white.counts.gradients, white.counts.rays), (0, 0, 64 * 64));
    assert_eq!((lit.counts.samples, lit.counts.gradients, lit.counts.hessians), (0, hits, 0));
    assert!(white.counts.bytes["surface"] > 0 && white.counts.preprocess.is_empty());
    // A layer of normals asks once a hit, lit or not; one of what is first only where nothing lies before.
    let normals = exact_ball(SurfaceLook::White).layers(&[LayerKind::Normal]).render();
    assert_eq!(normals.counts.gradients, hits);
    let opaque = haze(10.0, 0.5, false).with_transfer(|t| t.nodes.as_mut().unwrap()[0].opacity = 1.0);
    let first = opaque.layers(&[LayerKind::FirstNormal]).render();
    assert_eq!(first.counts.gradients, 256, "the haze's first samples alone");
    assert_eq!(first.counts.samples, 256, "and nothing is looked at behind something opaque");
    // The haze before the plane: as many samples as its planes hold, and no surface in a scene without.
    let before = haze(10.0, 0.5, false).render().counts;
    let through = haze(10.0, 0.5, false).with(|s| s.surface = None).render().counts;
    assert_eq!((before.samples, through.samples), (256 * 20, 256 * 40));
    assert!(!through.bytes.contains_key("surface"));
    let hidden = haze(10.0, 0.5, false).with(|s| s.surface = surface(SurfaceLook::None, 10.0)).render();
    assert_eq!((hidden.counts.samples, hidden.counts.bytes.contains_key("surface")), (256 * 40, false));
}

/// Translucent layers before a surface, by hand: three samples of ½ each, then white.
#[test]
fn layers_of_a_haze_before_a_surface() {
    let shot = haze(1.5, 0.5, false).layers(&LAYERS).with_transfer(|t| t.nodes.as_mut().unwrap()[0].opacity = 0.5);
    let shown = shot.with(|s| s.sampling.reference_length = Length::World(0.5)).render();
    let (near, centre) = (-10.0, 10.0);
    for p in shown.pixels() {
        assert!((p[0] - 1.0).abs() < 1e-12 && (p[1] - 0.125).abs() < 1e-12 && p[3] == 1.0, "{p:?}");
    }
    assert_eq!(shown.one(LayerKind::Z)[0], near + 0.25);
    let [first, half, mean] = shown.layer::<3>(LayerKind::Depth)[0];
    let expected = near + 0.5 * 0.25 + 0.25 * 0.75 + 0.125 * 1.25 + 0.125 * 1.5;
    assert!(first == near + 0.25 && half == first && (mean - expected).abs() < 1e-12, "{mean} {expected}");
    assert!((shot.view().eye.y - centre).abs() < 1e-12);
}

/// Neither bricks nor threads nor tiles show, with noise, NaN, every kernel and both numbers; nothing is NaN.
#[test]
fn skipping_and_tiles_show_nowhere() {
    for (seed, kernel) in
        [Kernel::Trilinear, Kernel::Bspline, Kernel::BsplineSmooth, Kernel::Bspline5, Kernel::CatmullRom]
            .into_iter()
            .enumerate()
    {
        let mut field = noise(18, 40 + seed as u64, 100.0);
        let mut r = Random(seed as u64);
        let values = (0..field.grid().len()).map(|i| {
            if r.once_in(300) { f64::NAN } else { field.voxels().get(i) * if i % 18 < 9 { 0.2 } else { 1.0 } }
        });
        field = Volume::new(field.grid().clone(), Voxels::F64(values.collect()), 1.0, 0.0).unwrap();
        for number in [Number::F64, Number::F32] {
            let nodes = [(20.0, [0.8, 0.1, 0.1], 0.0), (60.0, [0.1, 0.1, 0.9], 0.2)];
            let shot = Stage::regular(field.clone(), &nodes).layers(&LAYERS).with(|s| {
                s.surface = surface(SurfaceLook::Phong, 55.0);
                s.camera = perspective(50.0);
                s.camera.direction = DVec3::new(-0.3, 0.8, 0.4);
                s.sampling.kernel = kernel;
                s.sampling.number = number;
            });
            let shown = shot.render();
            let without = shot.with(|s| s.sampling.skip_empty = false).render();
            assert_eq!(shown.bits(), without.bits(), "{kernel:?} {number:?}");
            assert_eq!(shown.counts.gradients, without.counts.gradients);
            assert_eq!(shown.bits(), shot.render_in_tiles(5).bits());
            assert!(!shown.bits().iter().any(|bits| f64::from_bits(*bits).is_nan()));
            let covered = shown.pixels().iter().filter(|p| p[3] == 1.0).count();
            assert!((20..256).contains(&covered), "{covered}");
        }
    }
}

/// A volume that is iso everywhere, and values at and beyond the ends of the range.
#[test]
fn constants_and_extremes() {
    let constant =
        |look, iso| alone(volume([6; 3], |_| 7.0), look, iso).with(|s| s.camera = perspective(30.0)).render();
    let (at, above) = (constant(SurfaceLook::Phong, 7.0), constant(SurfaceLook::White, 7.5));
    assert!(at.covered() > 50 && above.covered() == 0);
    // Without a gradient nothing is shaded.
    assert_eq!(at.counts.without_normal, at.covered() as u64);
    assert!(at.pixels().iter().filter(|p| p[3] > 0.0).all(|p| *p == [1.0; 4]));
    let whole = ball(16, 5.0);
    let [lo, hi] = whole.range();
    // The lowest value is at corners alone, the highest fills the cell in the middle.
    for (iso, some) in [(lo, false), (hi, true), (hi + 1.0, false), (f64::MAX, false), (f64::MIN, false)] {
        let shown =
            alone(whole.clone(), SurfaceLook::Phong, iso).with(|s| s.camera.direction = DVec3::new(0.2, 0.9, 0.1));
        let shown = shown.with(|s| s.picture.size = [31, 31]).render();
        assert!(!shown.bits().iter().any(|bits| f64::from_bits(*bits).is_nan()));
        assert_eq!(shown.covered() > 0, some, "{iso}");
    }
}
