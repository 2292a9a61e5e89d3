//! Stipples at the edges of their formulas ([STIP-1] … [STIP-12]).

use crate::common::{ball, volume};
use crate::stability::{Case, Theme, differing, worst};
use drypoint::reference::volume_stippling::{FrameDots, FrameInputs, Frames, Preprocess};
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::glam::DVec3;
use drypoint::scene::marks::{Dot, Page};
use drypoint::scene::philox;
use drypoint::scene::points::{PointVoxel, Points};
use drypoint::scene::shot::StippleParams;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    Boundary, Camera, Distance, Interior, Length, Lighting, Resolution, Scene, Stipples, Threshold, VolumeSource,
};
use drypoint::scene::view::View;
use drypoint::scene::volume::Volume;
use std::path::Path;

pub(crate) static THEME: Theme = Theme::new(
    "Stipples",
    &[
        Case {
            name: "values × 2ᵏ, k = −300 … 200",
            breaks: "squares of derivatives leave the range of numbers",
            done: "derivatives are scaled by a power of two [SPACE-4]",
            of: "points that are another one",
            bound: 0.0,
            why: "scaling by a power of two is exact",
            measure: powers_of_two,
        },
        Case {
            name: "a constant volume; one bright voxel",
            breaks: "0/0 in the range of ‖∇V‖",
            done: "hi = lo: |g| is 0 everywhere [VAL-2]",
            of: "points of a constant volume, and whether one voxel has none around it",
            bound: 0.0,
            why: "nothing is above a threshold",
            measure: constant,
        },
        Case {
            name: "slab 0 and 1 voxel at 10⁴ random normals",
            breaks: "a slab that has no room in its voxel",
            done: "the centre is always in it; draws that fall outside are drawn again [STIP-4]",
            of: "how far points leave the voxel or the slab, in voxels",
            bound: 2.6e-8,
            why: "f32 rounds three numbers of at most ½ by 2⁻²⁶ each, and |n₁| + |n₂| + |n₃| ≤ √3",
            measure: slabs,
        },
        Case {
            name: "k_ge = 1000",
            breaks: "0·∞ or a power that is not a number",
            done: "‖∇V‖ lies in [0, 1] [STIP-7]",
            of: "dots too many or too few at ‖∇V‖ = 1, ½ and 0",
            bound: 0.0,
            why: "1ᵏ = 1, and 2⁻¹⁰⁰⁰ of a point is not drawn",
            measure: sharp_boundary,
        },
        Case {
            name: "k = 0 in every factor",
            breaks: "0⁰, or a mask in place of no effect",
            done: "the factor is off [STIP-9 … STIP-12]",
            of: "dots that are others than without the factors",
            bound: 0.0,
            why: "a factor that is off is 1",
            measure: no_exponents,
        },
        Case {
            name: "N_i at an integer ± 1 ulp",
            breaks: "a dot more or less flickers",
            done: "the fraction is the next dot's opacity [STIP-5]",
            of: "ink of a voxel off its N_i, in units of ε·N_max; N_max = 1, 7 and 10 000",
            bound: 4.0,
            why: "k_gc, V·k_gc and N_max·T round once each, and the page's opacity is N_i − ⌊N_i⌋",
            measure: near_integers,
        },
        Case {
            name: "an eye inside the volume",
            breaks: "division by the depth 0; dots from behind the eye",
            done: "what is nearer than `near` is not drawn; D ≤ near counts as near [STIP-9]",
            of: "dots that are no numbers, without size or behind `near`",
            bound: 0.0,
            why: "no such dot may be",
            measure: eye_inside,
        },
        Case {
            name: "negative exponents but k_de",
            breaks: "division by ‖∇V‖ = 0",
            done: "an error when the scene is read, with the key",
            of: "keys that are not refused by name",
            bound: 0.0,
            why: "every one is",
            measure: negative_exponents,
        },
    ],
);

#[test]
fn stipples() {
    THEME.hold();
}

fn params(stipples: &Stipples, grid: &Grid, view: &View) -> StippleParams {
    let scene = Scene::for_volume(VolumeSource::File { path: "test.nrrd".into(), raw: None });
    StippleParams { near: 0.5, ..StippleParams::new(&scene, stipples, grid, view.clone()).unwrap() }
}

fn made(volume: &Volume, stipples: &Stipples) -> Points {
    let view = View::new(&Camera::default(), volume.grid(), [200, 200]).unwrap();
    Preprocess::new(params(stipples, volume.grid(), &view), volume, None)
        .unwrap()
        .points(&mut Counts::default(), &|_| {})
        .unwrap()
}

fn drawn(points: &Points, stipples: &Stipples, view: &View) -> Vec<Dot> {
    let grid = &points.grid;
    let stipples = StippleParams { size: 0.5, ..params(stipples, grid, view) };
    let frames = Frames::new(FrameInputs { stipples, points, grid, nib: None, surface: None, tone: None });
    let mut drawn = FrameDots::default();
    frames.draw(view, &Page::in_pixels(view.size, 0.0, 254.0), &mut drawn);
    drawn.to_vec()
}

/// Voxels of given ‖∇V‖ and V = 1 that face the eye, `each` points at their centres.
fn voxels(magnitudes: &[f64], each: usize) -> (Points, View) {
    let grid = volume([5; 3], |_| 0.0).grid().clone();
    let view = View::new(&Camera::default(), &grid, [100, 100]).unwrap();
    let voxel = |&magnitude: &f64| PointVoxel { cell: [2; 3], value: 1.0, magnitude, normal: -view.forward };
    let voxels: Vec<PointVoxel> = magnitudes.iter().map(voxel).collect();
    let offsets = vec![[0.0; 3]; voxels.len() * each];
    (Points { grid, each, full: each as f64, voxels, offsets }, view)
}

fn powers_of_two() -> f64 {
    let scaled = |k: i32| {
        let centre = DVec3::splat(8.0);
        made(&volume([17; 3], |p| (5.0 - (p - centre).length()) * 2f64.powi(k)), &Stipples::default())
    };
    let wanted = scaled(0);
    assert!(!wanted.is_empty());
    worst([-300, -40, 7, 200].map(|k| differing(&scaled(k).offsets, &wanted.offsets)))
}

fn constant() -> f64 {
    let flat = made(&volume([9; 3], |_| 7.0), &Stipples::default()).len();
    let bright = made(&volume([9; 3], |p| f64::from(u8::from(p == DVec3::splat(4.0)))), &Stipples::default()).len();
    flat as f64 + f64::from(u8::from(bright == 0))
}

fn slabs() -> f64 {
    let noise = volume([22; 3], |p| philox::uniform(3, p.to_array().map(|x| x as u32), 0));
    let off = |h: f64| {
        let stipples = Stipples { slab: Length::World(h), threshold: Threshold::Magnitude(0.0), ..Stipples::default() };
        let points = made(&noise, &stipples);
        assert!(points.voxels.len() > 10_000 && points.grid.voxel() == 1.0, "{}", points.voxels.len());
        let of = |i: usize| {
            let n = points.voxels[i].normal;
            let over = |o: &[f32; 3]| {
                let o = DVec3::from_array(o.map(f64::from));
                (o.abs().max_element() - 0.5).max(n.dot(o).abs() - h).max(0.0)
            };
            worst(points.of(i).iter().map(over))
        };
        worst((0..points.voxels.len()).map(of))
    };
    worst([off(0.0), off(1.0)])
}

fn sharp_boundary() -> f64 {
    let (points, view) = voxels(&[1.0, 0.5, 0.0], 8);
    let boundary = Some(Boundary { gc: 0.0, gs: 1.0, ge: 1e3 });
    let dots = drawn(&points, &Stipples { boundary, ..Stipples::default() }, &view);
    // A dot of 2⁻¹⁰⁰⁰ is put onto its step of 1/16, which is none.
    (dots.iter().filter(|dot| dot.opacity > 1e-300).count() as f64 - 8.0).abs()
}

fn no_exponents() -> f64 {
    let points = made(&ball(15, 5.0), &Stipples::default());
    let view = View::new(&Camera::default(), &points.grid, [200, 200]).unwrap();
    let off = Stipples {
        resolution: Some(Resolution { re: 0.0, reference: None }),
        distance: Some(Distance { de: 0.0 }),
        interior: Some(Interior { te: 0.0 }),
        ..Stipples::default()
    };
    let wanted = drawn(&points, &Stipples::default(), &view);
    assert!(!wanted.is_empty());
    // Light takes away what faces away from the eye, and nothing else.
    let lit = Stipples { lighting: Some(Lighting { le: 0.0, light: None }), ..Stipples::default() };
    differing(&drawn(&points, &off, &view), &wanted) + differing(&drawn(&points, &lit, &view), &wanted)
}

fn near_integers() -> f64 {
    let off = |each: usize, k: usize| {
        let share = k as f64 / each as f64;
        let (points, view) = voxels(&[1.0], each);
        worst([share.next_down(), share, share.next_up()].map(|gc| {
            let stipples = Stipples { boundary: Some(Boundary { gc, gs: 0.0, ge: 1.0 }), ..Stipples::default() };
            let ink: f64 = drawn(&points, &stipples, &view).iter().map(|dot| dot.opacity).sum();
            (ink - k as f64).abs() / (f64::EPSILON * each as f64)
        }))
    };
    worst([(1, 1), (7, 1), (7, 3), (7, 7), (10_000, 1), (10_000, 3333), (10_000, 10_000)].map(|(each, k)| off(each, k)))
}

fn eye_inside() -> f64 {
    let points = made(&ball(21, 7.0), &Stipples::default());
    let eye = points.grid.centre();
    let camera = Camera { eye: Some(eye), direction: DVec3::X, direction_given: true, ..Camera::default() };
    let view = View::new(&camera, &points.grid, [200, 100]).unwrap();
    let stipples = Stipples {
        boundary: Some(Boundary::default()),
        resolution: Some(Resolution::default()),
        distance: Some(Distance { de: -1.0 }),
        ..Stipples::default()
    };
    let dots = drawn(&points, &stipples, &view);
    assert!(!dots.is_empty());
    let is_bad = |dot: &&Dot| {
        let sizes = dot.radius > 0.0 && dot.radius.is_finite() && dot.opacity > 0.0 && dot.opacity <= 1.0;
        !(sizes && dot.at.is_finite() && -view.to_eye(dot.world).z >= 0.5)
    };
    dots.iter().filter(is_bad).count() as f64
}

fn negative_exponents() -> f64 {
    let keys = ["boundary.ge", "silhouette.se", "resolution.re", "interior.te", "lighting.le", "boundary.gc"];
    let is_refused = |key: &&str| {
        let text = format!("drypoint = 1\nvolume.file = \"a.nrrd\"\nstipples.{key} = -1\n");
        let read = parse(&text, Path::new("scene.toml"), &Overrides::default());
        read.is_err_and(|faults| faults.to_string().contains(&format!("stipples.{key}")))
    };
    keys.iter().filter(|key| !is_refused(key)).count() as f64
}
