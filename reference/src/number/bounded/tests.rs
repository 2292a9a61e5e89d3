//! Each formula on numbers with errors against itself in f32: within the bound, and the bound not far beyond.

use crate::accumulator::Accumulator;
use crate::field::{Field, Reconstruction, Rung, Sampler, curvature, normal};
use crate::number::{Arithmetic, Bounded, Real, Sym3, Vec3};
use crate::ray::opacity::Correction;
use crate::shading::Phong;
use crate::style_transfer_functions::{Contour, contour, curvature_along_ray, frame, transparency};
use crate::transfer::Piecewise;
use crate::with_sampler;
use drypoint_scene::glam::DVec3;
use drypoint_scene::philox::uniform;
use drypoint_scene::shot::{PhongParams, Turn};
use drypoint_scene::space::Grid;
use drypoint_scene::tables::{Kappa, Kernel, Outside, SphereFrame, Transparency};
use drypoint_scene::volume::{Volume, Voxels};

/// A formula of `N` numbers, with `M` results.
trait Formula<const N: usize, const M: usize> {
    fn of<R: Real>(&self, x: [R; N]) -> [R; M];
}

/// Draws of each formula.
const DRAWS: u32 = 4000;

/// The error of the inputs beside their own rounding, relative to the largest.
const OF_INPUTS: f64 = 1e-6;

/// The formula in f32, of inputs that are moved by up to their error, against its bounds. Returns the largest bound and the
/// largest error.
fn compare<const N: usize, const M: usize>(
    name: &str,
    ranges: [[f64; 2]; N],
    formula: &impl Formula<N, M>,
) -> [f64; 2] {
    let (mut largest, mut measured): (f64, f64) = (0.0, 0.0);
    for draw in 0..DRAWS {
        let unit = |i: usize, which: u32| uniform(11, [draw, i as u32, which], 0);
        let x: [f64; N] = std::array::from_fn(|i| ranges[i][0] + (ranges[i][1] - ranges[i][0]) * unit(i, 0));
        let error: [f64; N] = ranges.map(|[a, b]| OF_INPUTS * a.abs().max(b.abs()));
        // Most errors are at their ends, of which sums are the largest.
        let moved: [f32; N] =
            std::array::from_fn(|i| (x[i] + error[i] * (2.0 * unit(i, 1) - 1.0).signum() * unit(i, 2).sqrt()) as f32);
        let bounded = formula.of(std::array::from_fn::<_, N, _>(|i| {
            Bounded::new(x[i], error[i] + 0.6 * f64::from(f32::EPSILON) * x[i].abs())
        }));
        let (exact, single) = (formula.of(x), formula.of(moved));
        for (i, (bounded, (exact, single))) in bounded.iter().zip(exact.into_iter().zip(single)).enumerate() {
            assert_eq!(bounded.value().to_bits(), exact.to_bits(), "{name} {i}: the value is that of f64");
            let off = (f64::from(single) - exact).abs();
            assert!(off <= bounded.error(), "{name} {i} at {x:?}: off by {off:e}, bound {:e}", bounded.error());
            (largest, measured) = (largest.max(bounded.error()), measured.max(off));
        }
    }
    println!("{name:<24} {largest:9.2e} {measured:9.2e} {:6.1}", largest / measured);
    [largest, measured]
}

/// Compares a formula that is written out, with its ranges.
macro_rules! formula {
    ($name:literal, [$($x:ident in $range:expr),*] -> $m:literal, $of:expr) => {{
        struct Written;
        impl Formula<{ [$(stringify!($x)),*].len() }, $m> for Written {
            fn of<R: Real>(&self, [$($x),*]: [R; [$(stringify!($x)),*].len()]) -> [R; $m] {
                $of
            }
        }
        compare($name, [$($range),*], &Written)
    }};
}

/// A field of 9³ voxels without order.
struct Sampling(Volume, Reconstruction);

impl Sampling {
    fn new(kernel: Kernel) -> Self {
        let grid = Grid::with_spacing([9; 3], [1.0, 0.8, 1.5]).unwrap();
        let voxels = (0..grid.len()).map(|i| (255.0 * uniform(3, [i as u32, 0, 0], 0)) as u8).collect();
        let volume = Volume::new(grid, Voxels::U8(voxels), 0.01, -1.0).unwrap();
        Self(volume, Reconstruction { kernel, ..Reconstruction::default() })
    }
}

/// Value and gradient.
impl Formula<3, 4> for Sampling {
    fn of<R: Real>(&self, [x, y, z]: [R; 3]) -> [R; 4] {
        let field = Field::<R>::new(&self.0, self.1, Rung::Gradient).unwrap();
        with_sampler!(field, |s| {
            let at = s.place(Vec3::new(x, y, z));
            let g = s.gradient_at(at);
            [s.value_at(at), g.x, g.y, g.z]
        })
    }
}

fn phong<R: Real>(n: Vec3<R>, v: Vec3<R>) -> [R; 3] {
    let light = DVec3::new(0.3, 0.5, 0.8).normalize();
    let phong = Phong::<R>::new(&PhongParams { ambient: 0.3, diffuse: 0.6, specular: 0.3, shininess: 30.0, light });
    phong.shade([R::HALF, R::ONE, R::ZERO], n, phong.half_vector(v))
}

fn unit<R: Real>(x: R, y: R, z: R) -> Vec3<R> {
    let v = Vec3::new(x, y, z);
    v * (R::ONE / v.length())
}

const ABOUT_0: [f64; 2] = [-1.0, 1.0];
const SHARE: [f64; 2] = [0.0, 1.0];
/// Away from 0, where a direction is lost.
const FRONT: [f64; 2] = [0.5, 1.0];

/// The table of formulas. A ratio beyond 100 would be a bound that says nothing.
#[test]
fn formulas_in_f32_are_within_their_bounds() {
    println!("formula                      bound  measured  ratio");
    let rows = [
        compare("trilinear", [[0.5, 7.5]; 3], &Sampling::new(Kernel::Trilinear)),
        compare("B-spline, smooth", [[1.5, 6.5]; 3], &Sampling::new(Kernel::BsplineSmooth)),
        compare("Catmull–Rom", [[1.5, 6.5]; 3], &Sampling::new(Kernel::CatmullRom)),
        formula!("normal", [x in ABOUT_0, y in ABOUT_0, z in FRONT] -> 3, {
            let n = normal::Normal::outward(Vec3::new(x, y, z), Outside::Low, R::NO_NORMAL).n;
            [n.x, n.y, n.z]
        }),
        formula!("Phong", [x in ABOUT_0, y in ABOUT_0, z in FRONT] -> 3, {
            phong(unit(x, y, z), Vec3::new(R::ZERO, R::ZERO, R::ONE))
        }),
        formula!("κ along the ray", [x in ABOUT_0, y in ABOUT_0, a in FRONT, b in FRONT] -> 1, {
            [curvature_along_ray::kappa(Turn::OfNormals, unit(x, y, a), unit(x, y, b), true, R::HALF)]
        }),
        formula!("κ exact", [x in ABOUT_0, y in ABOUT_0, z in FRONT, xx in ABOUT_0, yz in ABOUT_0, zz in ABOUT_0] -> 1, {
            let h = Sym3 { xx, xy: yz, xz: R::HALF, yy: zz, yz, zz };
            let v = Vec3::new(R::from_f64(0.6), R::from_f64(0.8), R::ZERO);
            [curvature::along_view(Vec3::new(x, y, z), h, v, Outside::Low)]
        }),
        formula!("τ", [kappa in [0.01, 0.4], g in SHARE] -> 1, {
            [Contour::new(2.0, Kappa::Ray, Some([0.1, 0.7])).tau(kappa, g)]
        }),
        formula!("push", [x in FRONT, y in ABOUT_0, d in SHARE, tau in FRONT] -> 2, {
            let (x, y) = contour::push(x, y, d, tau);
            [x, y]
        }),
        formula!("share, eq. 2", [alpha in [0.01, 1.0], d in SHARE, tau in SHARE, g in SHARE] -> 1, {
            [transparency::share(Transparency::Illustrative, alpha, d, tau, g)]
        }),
        formula!("frame of the sphere", [x in ABOUT_0, y in ABOUT_0, z in FRONT] -> 2, {
            let v = unit(R::from_f64(0.3), R::from_f64(-0.4), R::ONE);
            let n = frame::on_sphere(SphereFrame::View, unit(x, y, z), v);
            [n.x, n.y]
        }),
        formula!("lerp", [a in ABOUT_0, b in ABOUT_0, w in SHARE] -> 1, [R::lerp(a, b, w)]),
        formula!("nodes", [s in [0.1, 0.9]] -> 1, {
            let place = Piecewise::<R>::new(&[0.0, 0.3, 1.0], &[0.1, 0.9, 0.2]).unwrap().locate(s);
            [place.map_or(R::ZERO, |place| place.alpha_u)]
        }),
        formula!("opacity correction", [alpha in [0.01, 1.0]] -> 2, {
            [Correction::new(0.37).apply(alpha), Correction::new(2.5).apply(alpha)]
        }),
        formula!("hypot, √, ÷", [x in ABOUT_0, y in FRONT] -> 3, [Real::hypot(x, y), y.sqrt(), x / y]),
        formula!("200 layers", [alpha in [0.001, 0.05], a in SHARE, b in SHARE] -> 2, {
            let mut front = Accumulator::empty(R::ZERO);
            for i in 0..200 {
                front.over(if i % 2 == 0 { [a; 3] } else { [b; 3] }, alpha);
            }
            [front.rgb[0], front.opacity]
        }),
    ];
    for (i, [bound, measured]) in rows.into_iter().enumerate() {
        assert!(bound <= 100.0 * measured, "row {i}: {bound:e} {measured:e}");
    }
}

/// A·α is laid behind for ever: the error of A stays a few roundings of 1, where plain rules reach (1 + α)ⁿ.
#[test]
fn opacities_forget_their_errors() {
    let mut a = Bounded::exact(0.0);
    for _ in 0..10_000 {
        a = a.laid_before(Bounded::from_f64(0.01)).1;
    }
    // Each step adds about a rounding of A and keeps 99 %: a hundred of them.
    assert!(a.error() < 100.0 * f64::from(f32::EPSILON), "{:e}", a.error());
}

/// By hand, in units of 2⁻²⁴.
#[test]
fn grants_by_hand() {
    let unit = 1.0 / f64::from(1 << 24);
    let close = |got: Bounded, units: f64| {
        let want = units * unit;
        assert!((got.error() - want).abs() <= 1e-6 * want, "{got:?} {want:e}");
    };
    let [two, three] = [2.0, 3.0].map(Bounded::exact);
    // What f32 holds has no error, except behind a division or a root.
    close(two + three, 0.0);
    close(two * three, 0.0);
    close(three / two, 5.0 * 1.5);
    close(Bounded::exact(4.0).sqrt(), 9.0 * 2.0);
    // ⅓ as a number of the scene: its own distance to f32.
    close(Bounded::from_f64(1.0 / 3.0), ((1.0f64 / 3.0) - f64::from(1.0f32 / 3.0)).abs() / unit);
    // |a|e_b + |b|e_a, and half a unit of 6.
    let [a, b] = [Bounded::new(2.0, 8.0 * unit), Bounded::new(3.0, 2.0 * unit)];
    close(a * b, 2.0 * 2.0 + 3.0 * 8.0 + 6.0);
    close(a - b, 8.0 + 2.0 + 1.0);
    // A quotient whose divisor may be 0 is anything, a root at 0 is finite.
    assert_eq!((two / Bounded::new(0.5, 0.5)).error(), f64::INFINITY);
    close(Bounded::new(0.0, unit * unit).sqrt(), 1.0);
    // A clamp that holds for sure is exact.
    assert_eq!(Bounded::new(1.5, 0.1).clamp_01().error(), 0.0);
    assert_eq!(Bounded::new(0.875, 0.25).clamp_01().error(), 0.25);
}
