//! Roots against closed forms, and against a dense search on the interpolation.

use super::*;
use crate::field::{GradientEstimator, Kernel, Reconstruction, Rung};
use crate::number::Vec3;
use drypoint_scene::glam::DMat3;
use drypoint_scene::math::scale_by_power_of_two;
use drypoint_scene::philox::uniform;
use drypoint_scene::space::Grid;
use drypoint_scene::tables::{Camera, Projection};
use drypoint_scene::view::View;
use drypoint_scene::volume::{Volume, Voxels};

const KERNELS: [Kernel; 5] =
    [Kernel::Trilinear, Kernel::Bspline, Kernel::BsplineSmooth, Kernel::Bspline5, Kernel::CatmullRom];

const ANYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

fn sampled(grid: Grid, mut f: impl FnMut(DVec3) -> f64) -> Volume {
    let [nx, ny, _] = grid.dims();
    let at = |i: usize| grid.to_world(DVec3::new((i % nx) as f64, (i / nx % ny) as f64, (i / nx / ny) as f64));
    let values = (0..grid.len()).map(|i| f(at(i))).collect();
    Volume::new(grid, Voxels::F64(values), 1.0, 0.0).unwrap()
}

fn cubic_grid(n: usize) -> Grid {
    Grid::with_spacing([n; 3], [1.0; 3]).unwrap()
}

/// A grid with spacings 1 : 1 : 4, and a sheared one.
fn odd_grids(n: usize) -> [Grid; 2] {
    let sheared = DMat3::from_cols(DVec3::new(1.0, 0.1, 0.0), DVec3::new(-0.3, 1.2, 0.2), DVec3::new(0.1, 0.4, 0.9));
    let origin = DVec3::new(3.0, -5.0, 2.0);
    [Grid::with_spacing([n; 3], [1.0, 1.0, 4.0]).unwrap(), Grid::new([n; 3], sheared, origin).unwrap()]
}

fn field(volume: &Volume, kernel: Kernel) -> Field<'_, f64> {
    let how = Reconstruction { kernel, gradient: GradientEstimator::Central, ..Reconstruction::default() };
    Field::new(volume, how, Rung::Gradient).unwrap()
}

/// Uniform in [0, 1).
struct Random(u32);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 += 1;
        uniform(7, [self.0, 0, 0], 0)
    }

    fn vector(&mut self, lo: f64, hi: f64) -> DVec3 {
        DVec3::from_array([0; 3].map(|_| lo + (hi - lo) * self.next()))
    }
}

/// Lines through a grid in index space: random ones, along axes and diagonals, on faces and edges of cells, and
/// through voxels.
fn lines(r: &mut Random, n: usize) -> Vec<[DVec3; 2]> {
    let far = (n - 1) as f64;
    let mut lines = Vec::new();
    for _ in 0..40 {
        let (through, d) = (r.vector(0.0, far), r.vector(-1.0, 1.0));
        lines.push([through - d * 60.0, d]);
        let voxel = through.round();
        lines.push([voxel - d * 32.0, d]);
        lines.push([voxel - 64.0, DVec3::ONE]);
        let axis = DVec3::AXES[(r.next() * 3.0) as usize] * if r.next() < 0.5 { 1.0 } else { -2.0 };
        lines.push([through - axis * 64.0, axis]);
        lines.push([voxel - axis * 64.0, axis]);
        lines.push([DVec3::new(voxel.x, through.y, through.z) - axis * 64.0, axis]);
    }
    lines
}

/// The first change of sign of the interpolation at steps of `step` along a line inside the box, refined by
/// bisection.
fn brute_force(field: &Field<'_, f64>, iso: f64, [o, d]: [DVec3; 2], step: f64) -> Option<f64> {
    let [lo, hi] = field.volume().grid().index_box();
    let over = |t: f64| {
        let p = o + d * t;
        let inside = p.cmpge(lo).all() && p.cmple(hi).all();
        inside.then(|| field.value(Vec3::from_glam(p)) - iso)
    };
    let (mut before, mut t) = (None, 0.0);
    while t < 140.0 {
        let now = over(t);
        if let (Some(a), Some(b)) = (before, now)
            && (a < 0.0) != (b < 0.0)
        {
            let (mut from, mut to) = (t - step, t);
            while 0.5 * (from + to) > from && 0.5 * (from + to) < to {
                let middle = 0.5 * (from + to);
                if (over(middle)? < 0.0) == (a < 0.0) { from = middle } else { to = middle }
            }
            return Some(to);
        }
        (before, t) = (now, t + step);
    }
    None
}

/// A plane n·x = c is linear along every line: its root is (c − n·o)/(n·d). Lengths are below 300. The slope is at
/// least a tenth of the steepest one, which multiplies rounding by ten.
#[test]
fn planes_are_met_where_they_are() {
    let mut r = Random(0);
    let normal = DVec3::new(0.6, -0.3, 0.9);
    for grid in odd_grids(12).into_iter().chain([cubic_grid(12)]) {
        let centre = grid.centre();
        let volume = sampled(grid, |p| normal.dot(p - centre));
        for kernel in KERNELS {
            let field = field(&volume, kernel);
            let surface = IsoSurface::new(&field, 0.75);
            let mut met = 0;
            for _ in 0..200 {
                let (through, d) = (centre + r.vector(-2.0, 2.0), r.vector(-1.0, 1.0).normalize());
                let slope = normal.dot(d);
                let t = (0.75 - normal.dot(through - centre)) / slope;
                let got = surface.first_root(through, d, [0.0, 3.0]);
                if slope.abs() < 0.1 || t.abs() < 1e-9 || (t - 3.0).abs() < 1e-9 {
                    continue;
                }
                met += u32::from((0.0..3.0).contains(&t));
                match got {
                    Some(got) => assert!((got - t).abs() <= 64.0 * f64::EPSILON * 30.0, "{kernel:?} {got} {t}"),
                    None => assert!(!(0.0..3.0).contains(&t), "{kernel:?} {t}"),
                }
            }
            assert!(met > 20, "{met}");
        }
    }
}

/// Noise has up to three roots in a cell and thousands of surfaces. The first root is the interpolation's first
/// change of sign, even on faces, on edges and through voxels, for every kernel. Skipping bricks changes no bit.
#[test]
fn the_first_root_is_that_of_the_interpolation() {
    let mut r = Random(1000);
    let n = 14;
    for grid in [cubic_grid(n), odd_grids(n)[0].clone(), odd_grids(n)[1].clone()] {
        let mut noise = Random(5000);
        let rough = sampled(grid.clone(), |_| noise.next());
        let centre = grid.centre();
        // A smooth volume, for the kernels that are evaluated every quarter of a voxel only.
        let smooth = sampled(grid, |p| (p - centre).length());
        for kernel in KERNELS {
            let trilinear = kernel == Kernel::Trilinear;
            let (volume, iso, step) = if trilinear { (&rough, 0.5, 2.3e-4) } else { (&smooth, 4.3, 2.3e-3) };
            let field = field(volume, kernel);
            let (with, without) = (IsoSurface::new(&field, iso), IsoSurface::without_skipping(&field, iso));
            for line in lines(&mut r, n) {
                let [o, d] = line;
                let got = with.first_root_in_index(o, d, [0.0, 140.0]);
                let all = without.first_root_in_index(o, d, [0.0, 140.0]);
                assert_eq!(got.map(f64::to_bits), all.map(f64::to_bits), "{kernel:?} {line:?}");
                // Every tenth line suffices for the dense search.
                if trilinear && r.next() > 0.1 {
                    continue;
                }
                match (got, brute_force(&field, iso, line, step)) {
                    // A value errs by 4 ε, a root by that over the slope. If the search stepped over a pair of roots,
                    // ours comes earlier and is a root all the same.
                    (Some(got), Some(brute)) if (got - brute).abs() <= 1e-12 * 140.0 => {}
                    (Some(got), brute) => {
                        let [lo, hi] = field.volume().grid().index_box();
                        let p = (o + d * got).clamp(lo, hi);
                        let off = field.value(Vec3::from_glam(p)) - iso;
                        assert!(off.abs() < 1e-12 && brute.is_none_or(|b| got < b), "{kernel:?} {got} {brute:?} {off}");
                    }
                    (None, None) => {}
                    (None, Some(brute)) => panic!("{kernel:?} {line:?}: {brute} was missed"),
                }
            }
        }
    }
}

/// One cell with f = (x − ¼)(x − ½)(x − ¾) along its diagonal, trilinear from the polar form of this cubic.
#[test]
fn of_three_roots_in_a_cell_the_first() {
    let [a, b, c] = [0.25, 0.5, 0.75];
    let polar = |x: f64, y: f64, z: f64| {
        let f = |p: f64, q: f64, s: f64| (x - p) * (y - q) * (z - s);
        (f(a, b, c) + f(a, c, b) + f(b, a, c) + f(b, c, a) + f(c, a, b) + f(c, b, a)) / 6.0
    };
    let volume = sampled(cubic_grid(2), |p| polar(p.x, p.y, p.z));
    let field = field(&volume, Kernel::Trilinear);
    let surface = IsoSurface::new(&field, 0.0);
    let from = |t: f64| surface.first_root(DVec3::splat(-1.0), DVec3::ONE, [t, 9.0]).unwrap_or(9.0) - 1.0;
    for (start, root) in [(0.0, a), (1.3, b), (1.6, c)] {
        assert!((from(start) - root).abs() < 1e-14, "{start}: {}", from(start));
    }
    assert_eq!(from(1.8), 8.0);
    let back = surface.first_root(DVec3::splat(2.0), -DVec3::ONE, [0.0, 9.0]).unwrap();
    assert!((back - 1.25).abs() < 1e-14);
}

#[test]
fn a_value_that_is_stored_a_plateau_a_constant_and_a_value_beyond() {
    // Steps 0 0 100 100 100 0 0 along x, as bytes.
    let grid = Grid::with_spacing([7, 3, 3], [1.0; 3]).unwrap();
    let bytes = Voxels::U8((0..63).map(|i| if (2..5).contains(&(i % 7)) { 100 } else { 0 }).collect());
    let steps = Volume::new(grid, bytes, 1.0, 0.0).unwrap();
    for kernel in [Kernel::Trilinear, Kernel::BsplineSmooth, Kernel::CatmullRom] {
        let field = field(&steps, kernel);
        let first = |iso: f64, x: f64, d: f64| {
            let with = IsoSurface::new(&field, iso);
            let (o, d) = (DVec3::new(x, 1.2, 0.7), DVec3::new(d, 0.0, 0.0));
            let got = with.first_root(o, d, [0.0, 99.0]);
            let all = IsoSurface::without_skipping(&field, iso).first_root(o, d, [0.0, 99.0]);
            assert_eq!(got.map(f64::to_bits), all.map(f64::to_bits));
            got
        };
        if kernel == Kernel::Trilinear {
            assert_eq!(first(100.0, -1.0, 1.0), Some(3.0), "the plateau begins at its first voxel");
            assert_eq!(first(100.0, 3.0, 1.0), Some(0.0), "an eye on the plateau is on the surface");
            assert_eq!(first(0.0, -1.0, 1.0), Some(1.0), "nothing but iso: met at the face of the box");
            assert_eq!(first(50.0, -1.0, 1.0), Some(2.5));
            assert_eq!(first(50.0, 3.0, 1.0), Some(1.5), "from inside");
            assert_eq!(first(50.0, 7.0, -1.0), Some(2.5));
        }
        assert_eq!(first(1e300, -1.0, 1.0), None);
        assert_eq!(first(-1e-300, -1.0, 1.0).is_some(), kernel == Kernel::CatmullRom, "only one undershoots");
        assert_eq!(first(f64::MAX, -1.0, 1.0), None);
    }
    let constant = sampled(cubic_grid(4), |_| 7.0);
    for kernel in KERNELS {
        let field = field(&constant, kernel);
        let from = DVec3::new(-1.0, 1.0, 2.5);
        // The prefilter rounds, so its result may lie on one side of 7 by the last digits.
        if matches!(kernel, Kernel::Trilinear | Kernel::CatmullRom) {
            assert_eq!(IsoSurface::new(&field, 7.0).first_root(from, DVec3::X, ANYWHERE), Some(1.0), "{kernel:?}");
        }
        assert_eq!(IsoSurface::new(&field, 7.1).first_root(from, DVec3::X, ANYWHERE), None);
    }
}

#[test]
fn values_times_a_power_of_two_move_no_bit() {
    let mut r = Random(3);
    let n = 10;
    let roots = |k: i32, kernel: Kernel, lines: &[[DVec3; 2]]| -> Vec<Option<u64>> {
        let mut noise = Random(77);
        let volume = sampled(cubic_grid(n), |_| scale_by_power_of_two(noise.next() - 0.4, k));
        let field = field(&volume, kernel);
        let surface = IsoSurface::new(&field, scale_by_power_of_two(0.3, k));
        lines.iter().map(|[o, d]| surface.first_root_in_index(*o, *d, ANYWHERE).map(f64::to_bits)).collect()
    };
    let lines = lines(&mut r, n);
    for kernel in [Kernel::Trilinear, Kernel::Bspline] {
        let plain = roots(0, kernel, &lines);
        assert!(plain.iter().filter(|root| root.is_some()).count() > 50);
        for k in [-900, -1, 3, 1000] {
            assert_eq!(roots(k, kernel, &lines), plain, "{kernel:?} {k}");
        }
    }
}

/// A wall of NaN in front of a ball: the cells that touch it contain no surface, and the cells behind it are
/// unchanged.
#[test]
fn masked_cells_hold_no_surface() {
    let centre = DVec3::splat(7.5);
    let ball = |p: DVec3| 5.0 - (p - centre).length();
    let holed = sampled(cubic_grid(16), |p| if p.x == 3.0 { f64::NAN } else { ball(p) });
    let whole = sampled(cubic_grid(16), ball);
    let (holed, whole) = (field(&holed, Kernel::Trilinear), field(&whole, Kernel::Trilinear));
    let [masked, open] = [&holed, &whole].map(|field| IsoSurface::new(field, 0.0));
    let first = |s: &IsoSurface<'_, '_>, y: f64| s.first_root(DVec3::new(-1.0, y, 7.3), DVec3::X, ANYWHERE);
    // The ball begins at x = 2.5, in a masked cell. The ray sees its back, as through a hole.
    let x = first(&masked, 7.4).unwrap() - 1.0;
    assert!((x - 12.5).abs() < 0.1, "{x}");
    // Nothing changes away from the wall.
    assert_eq!(first(&masked, 12.0), first(&open, 12.0));
    assert!(first(&open, 12.0).is_some());
    assert!(first(&open, 7.4).unwrap() - 1.0 < 2.6);
}

#[test]
fn ranges_clip_and_an_eye_inside_sees_the_other_side() {
    let centre = DVec3::splat(10.0);
    let volume = sampled(cubic_grid(21), |p| 6.0 - (p - centre).length());
    let field = field(&volume, Kernel::Trilinear);
    let surface = IsoSurface::new(&field, 0.0);
    let d = DVec3::new(0.48, -0.6, 0.64);
    // Trilinear interpolation of a distance errs by at most κ/8·3 of the squared voxel size.
    let near = |root: Option<f64>, t: f64| (root.unwrap() - t).abs() < 3.0 / 8.0 / 6.0 * 1.1;
    assert!(near(surface.first_root(centre - d * 20.0, d, ANYWHERE), 14.0));
    assert!(near(surface.first_root(centre, d, [0.0, 20.0]), 6.0));
    assert!(near(surface.first_root(centre, d, ANYWHERE), -6.0), "without an eye a line has no side");
    assert_eq!(surface.first_root(centre, d, [0.0, 5.5]), None);
    assert_eq!(surface.first_root(centre, d, [6.5, 20.0]), None);
    assert_eq!(surface.first_root(centre, d, [3.0, 2.0]), None);
    assert_eq!(surface.first_root(centre, DVec3::ZERO, [0.0, 9.0]), None);
}

/// HATCH-14's closed form for a point at δ outside a sphere: hidden where n·E < −√(1 − (R/(R + δ))²), visible
/// elsewhere. This function moves a foot by a distance in world units along its normal.
fn in_front(surface: &IsoSurface, foot: DVec3, distance: f64) -> DVec3 {
    let to_index = surface.field().volume().grid().inverse_axes();
    foot + to_index * (surface.normal(foot).unwrap() * distance)
}

#[test]
fn a_sphere_hides_its_back() {
    let (centre, radius) = (DVec3::splat(15.0), 11.0);
    let volume = sampled(cubic_grid(31), |p| radius - (p - centre).length());
    let field = field(&volume, Kernel::Trilinear);
    let surface = IsoSurface::new(&field, 0.0);
    let camera = |projection, eye| Camera {
        projection,
        eye: Some(eye),
        direction: DVec3::new(2.0, 1.0, -1.0),
        direction_given: true,
        ..Camera::default()
    };
    let view = View::new(&camera(Projection::Orthographic { height: None }, centre), volume.grid(), [64, 64]).unwrap();
    let mut r = Random(9);
    let delta = 0.15;
    let edge = -(2.0 * delta / radius).sqrt();
    let (mut front, mut back) = (0, 0);
    for _ in 0..4000 {
        let n = r.vector(-1.0, 1.0).normalize();
        let start = centre + n * (radius + 2.4 * (r.next() - 0.5));
        let foot = surface.foot(start, surface.normal(start).unwrap(), 1.5).unwrap();
        // The gradient of the interpolation differs from the radius by a few degrees at most.
        assert!(((foot - centre).length() - radius).abs() < 0.05, "{foot}");
        let point = in_front(&surface, foot, delta * surface.front(&view));
        let faces = -(foot - centre).normalize().dot(view.forward);
        let hidden = surface.hides(point, &view, 0.0);
        if faces > 0.0 {
            assert!(!hidden, "{faces}");
            front += 1;
        } else if faces < edge {
            assert!(hidden, "{faces}");
            back += 1;
        }
    }
    assert!(front > 1000 && back > 1000);
    // No foot is farther than `reach` or outside, and there is no normal outside.
    assert_eq!(surface.foot(centre + DVec3::X * 8.0, DVec3::X, 1.5), None);
    assert_eq!(surface.foot(DVec3::splat(-1.0), DVec3::X, 99.0), None);
    assert_eq!(surface.normal(DVec3::splat(-1.0)), None);
    // For an eye inside, the front is inwards, and nothing of the sphere is hidden.
    let inside =
        View::new(&camera(Projection::Perspective { fov: 60.0 }, centre + DVec3::X), volume.grid(), [64, 64]).unwrap();
    assert_eq!((surface.front(&view), surface.front(&inside)), (1.0, -1.0));
    let ahead = surface.foot(centre + inside.forward * radius, inside.forward, 1.5).unwrap();
    assert!(!surface.hides(in_front(&surface, ahead, -delta), &inside, 0.5));
    assert!(surface.hides(in_front(&surface, ahead, delta), &inside, 0.5));
    assert!(
        !surface.hides(centre - inside.forward * 4.0, &inside, 0.5),
        "behind the eye there is no surface before it"
    );
}
