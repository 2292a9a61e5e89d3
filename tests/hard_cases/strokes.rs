//! Strokes along lines of curvature at the edges of their formulas ([HATCH-3] … [HATCH-9]).

use crate::common::{on, volume};
use crate::stability::{Case, Theme};
use drypoint::job::{Job, RenderTarget};
use drypoint::marking::Marking;
use drypoint::reference::field::{Field, Reconstruction, Rung};
use drypoint::reference::interactive_volume_illustration::{
    CurvatureFamily, DirectionEstimator, GrownStrokes, HatchParams, Pyramid, SeedRule, StrokeField, StrokeGrower,
};
use drypoint::reference::number::Vec3;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::philox::uniform;
use drypoint::scene::source::Disk;
use drypoint::scene::space::Grid;
use drypoint::scene::strokes::{Measure, Stroke};
use drypoint::scene::volume::{Volume, Voxels};
use std::path::Path;
use std::sync::Arc;

pub(crate) static THEME: Theme = Theme::new(
    "Strokes",
    &[
        Case {
            name: "noise of bytes, with every rule",
            breaks: "directions that turn from voxel to voxel; strokes that end nowhere",
            done: "steps end at their smallest, with a cause [HATCH-8]",
            of: FAULTS,
            bound: 0.0,
            why: NO_FAULT,
            measure: noise,
        },
        Case {
            name: "an iso-value that is stored, on a plateau, and at both ends of the range",
            breaks: "crossings without a sign change; places behind the surface",
            done: "ranges are closed, and the target lies a tenth of the range in front at the most [HATCH-6, HATCH-7]",
            of: FAULTS,
            bound: 0.0,
            why: NO_FAULT,
            measure: plateau,
        },
        Case {
            name: "a sheet that the line of a cell's gradient crosses twice",
            breaks: "a seed on the far side of the sheet",
            done: "the sign change nearest the cell's centre [HATCH-7]",
            of: "seeds with a sign change more than 0.01 voxels nearer",
            bound: 0.0,
            why: "two sides are at least 0.8 voxels apart",
            measure: sheet,
        },
        Case {
            name: "catenoid and Schwarz P, H = 0 everywhere",
            breaks: "|κ₁| = |κ₂|: a stroke that changes its family",
            done: "the seed chooses it, by value, for the whole stroke [HATCH-8]",
            of: OTHER,
            bound: 0.0,
            why: NEAREST,
            measure: minimal_surfaces,
        },
        Case {
            name: "saddle and monkey saddle",
            breaks: "signs of curvature; the umbilic in the middle of the monkey's",
            done: "there is no direction at an umbilic, and a stroke ends at it [HATCH-3, HATCH-8]",
            of: OTHER,
            bound: 0.0,
            why: NEAREST,
            measure: saddles,
        },
        Case {
            name: "a sphere of voxels 1:1:4, an ellipsoid of 1:1:1000",
            breaks: "lengths in voxels of one axis; steps that never end",
            done: "steps are in world units, searches in cells [HATCH-7, SPACE-2]",
            of: FAULTS,
            bound: 0.0,
            why: NO_FAULT,
            measure: long_voxels,
        },
        Case {
            name: "a torus that the border cuts, seeds in its cells",
            breaks: "stages outside the volume",
            done: "no direction there: the stroke ends [HATCH-8]",
            of: FAULTS,
            bound: 0.0,
            why: NO_FAULT,
            measure: border,
        },
        Case {
            name: "a world 2²⁰ and 2³⁰ voxels from its origin",
            breaks: "places that have no value to 2⁻⁴⁰ of the range: seeds beside the surface, strokes without vertices",
            done: "a value is met as near as places are known [HATCH-7]",
            of: "strokes more or fewer; vertices 10⁻⁴ and 0.05 voxels beside those at the origin; and all that may be wrong \
                 with strokes",
            bound: 0.0,
            why: "places round at 10⁻¹⁰ and 10⁻⁷ voxels; there a step may be decided otherwise, each errs by 0.01 voxels",
            measure: far_from_the_origin,
        },
        Case {
            name: "spheres of which voxels without a value leave a part",
            breaks: "directions of what fills those voxels",
            done: "a scale has no say within 3σ of them [HATCH-3, PREC-2]",
            of: "the share of seeds with a stroke",
            bound: 0.01,
            why: "a sphere has no directions [HATCH-3]",
            measure: masked_spheres,
        },
        Case {
            name: "tolerances 10⁻¹⁰ to 10³ voxels",
            breaks: "steps below their smallest, or over everything",
            done: "a largest step of two cells; below 0.005 voxels steps end at faces [HATCH-8]",
            of: FAULTS,
            bound: 0.0,
            why: NO_FAULT,
            measure: tolerances,
        },
        Case {
            name: "an eye inside the iso-surface; lines through the near plane",
            breaks: "vertices behind the eye, divided by their depth",
            done: "lines are clipped at `near` and at the frame [HATCH-14]",
            of: "vertices that an eye inside sees through the surface; vertices that are no numbers or lie off the page",
            bound: 0.0,
            why: "strokes lie in front of the surface; no such vertex may be",
            measure: eye_inside,
        },
    ],
);

const FAULTS: &str =
    "vertices that are no numbers or outside the box, u that does not ascend, segments behind the surface, lost cells";
const NO_FAULT: &str = "none may be";
const OTHER: &str = "segments that are nearer to the other family's direction";
const NEAREST: &str = "sampling turns a direction by some degrees, not by 45°";

#[test]
fn strokes() {
    THEME.hold();
}

/// The strokes of every cell of a surface, and the other way in each, with what is wrong with them; those that were grown must
/// not be none.
fn grown(volume: &Volume, iso: f64, how: HatchParams) -> (GrownStrokes, f64) {
    let field = Field::<f64>::new(volume, Reconstruction::default(), Rung::Hessian).unwrap();
    let strokes = StrokeGrower::new(&field, Some(iso), how);
    let range = (Measure::Mean, [0.0, 1.0]);
    let cells: Vec<_> = strokes.seeds(&Pyramid::new(volume), &field, iso, SeedRule::Dense, range).draw(1).collect();
    let grown = strokes.grow_all(&cells, |_| true);
    let counts = grown.counts;
    let lost = (counts.strokes + counts.rejected.total()).abs_diff(cells.len() as u64);
    let all = grown.strokes.iter().chain(&grown.cross);
    let faults: usize = all.map(|(_, stroke)| faults(&field, iso, stroke)).sum();
    (grown, faults as f64 + lost as f64)
}

fn faults(field: &Field<'_, f64>, iso: f64, stroke: &Stroke) -> usize {
    let grid = field.volume().grid();
    let [lo, hi] = grid.index_box();
    let wrong = |p: DVec3| {
        let index = grid.to_index(p);
        // Outside by no more than rounding.
        let near = 1e-9 * (DVec3::ONE + hi.abs());
        index.cmpge(lo - near).all() && index.cmple(hi + near).all()
    };
    let vertices = &stroke.vertices;
    let numbers = vertices.iter().filter(|v| !(wrong(v.world) && v.normal.is_finite() && v.u.is_finite())).count();
    let ascending = vertices.windows(2).filter(|v| v[0].u >= v[1].u).count();
    let [least, most] = field.volume().range();
    let rounding = 1e-12 * (most - least + iso.abs());
    let behind = |pair: &[DVec3; 2]| {
        (0..=16).any(|i| {
            let index = grid.to_index(pair[0].lerp(pair[1], f64::from(i) / 16.0)).clamp(lo, hi);
            StrokeField::value(field, Vec3::from_glam(index)) > iso + rounding
        })
    };
    let pairs = vertices.windows(2).map(|v| [v[0].world, v[1].world]);
    numbers + ascending + pairs.filter(behind).count()
}

/// Every rule and both families.
fn each(volume: &Volume, iso: f64, change: impl Fn(HatchParams) -> HatchParams) -> (f64, u64) {
    let (mut wrong, mut strokes) = (0.0, 0);
    for rule in [DirectionEstimator::Raw, DirectionEstimator::Scaled(Default::default())] {
        let how = change(HatchParams { rule, ..HatchParams::new(volume.grid()) });
        let (grown, faults) = grown(volume, iso, how);
        wrong += faults;
        strokes += grown.counts.strokes;
    }
    (wrong, strokes)
}

fn bytes(dims: [usize; 3], value: impl Fn([usize; 3]) -> u8) -> Volume {
    let [nx, ny, nz] = dims;
    let voxels = (0..nx * ny * nz).map(|i| value([i % nx, i / nx % ny, i / nx / ny])).collect();
    Volume::new(Grid::with_spacing(dims, [1.0; 3]).unwrap(), Voxels::U8(voxels), 1.0, 0.0).unwrap()
}

fn noise() -> f64 {
    let volume = bytes([16; 3], |at| (256.0 * uniform(3, at.map(|i| i as u32), 0)) as u8);
    let (wrong, strokes) = each(&volume, 127.5, |how| how);
    assert!(strokes > 1000, "{strokes}");
    wrong
}

/// 10 minus the distance from a ring of radius 9 about the centre of 32·32·20 voxels.
fn ring([x, y, z]: [f64; 3]) -> f64 {
    10.0 - ((x - 15.3).hypot(y - 15.6) - 9.0).hypot(z - 9.4)
}

fn plateau() -> f64 {
    let volume = bytes([32, 32, 20], |at| (20.0 * ring(at.map(|i| i as f64))).clamp(40.0, 120.0) as u8);
    let mut wrong = 0.0;
    let mut all = 0;
    for iso in [40.0, 100.0, 120.0] {
        let (faults, strokes) = each(&volume, iso, |how| HatchParams { length: 6.0, ..how });
        wrong += faults;
        all += strokes;
    }
    assert!(all > 1000, "{all}");
    for iso in [39.0, 121.0, f64::MAX, f64::MIN_POSITIVE] {
        wrong += each(&volume, iso, |how| how).1 as f64;
    }
    wrong
}

/// Shells of a cylinder that are one voxel thick.
fn sheet() -> f64 {
    let volume = volume([28, 28, 8], |p| 1.0 - ((p.x - 13.4).hypot(p.y - 13.7) - 8.3).abs());
    let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Hessian).unwrap();
    let how = HatchParams { rule: DirectionEstimator::Raw, ..HatchParams::new(volume.grid()) };
    let (grown, _) = grown(&volume, 0.5, how);
    assert!(grown.strokes.len() > 500, "{}", grown.strokes.len());
    let farther = grown.strokes.iter().filter(|(seed, _)| {
        let centre = DVec3::from_array(seed.cell.map(|i| i as f64 + 0.5));
        let reach = seed.world - centre;
        let (length, over) = (reach.length(), |p: DVec3| StrokeField::value(&field, Vec3::from_glam(p)) - seed.target);
        let along = reach / length;
        let side = over(centre) > 0.0;
        let places = (length * 100.0) as i32 - 1;
        (-places..=places).any(|i| (over(centre + along * (0.01 * f64::from(i))) > 0.0) != side)
    });
    farther.count() as f64
}

/// Segments that follow the other family's direction rather than their own, where the curvatures differ by a fifth of their
/// largest difference at least: of a function with its gradient and Hessian, bright inside, sampled.
fn of_the_other_family(n: usize, iso: f64, at: impl Fn(DVec3) -> (f64, DVec3, DMat3)) -> f64 {
    let volume = volume([n; 3], |p| at(p).0);
    let mut segments = Vec::new();
    for family in [CurvatureFamily::Max, CurvatureFamily::Min] {
        let how = HatchParams { family, length: 16.0, max_angle: 179.0, ..HatchParams::new(volume.grid()) };
        let (grown, wrong) = grown(&volume, iso, how);
        assert!(grown.strokes.len() > 200 && wrong == 0.0, "{} {wrong}", grown.strokes.len());
        for (_, stroke) in &grown.strokes {
            for pair in stroke.vertices.windows(2) {
                let (middle, along) = (0.5 * (pair[0].world + pair[1].world), pair[1].world - pair[0].world);
                let (_, g, h) = at(middle);
                let normal = g.normalize();
                let t = (along - normal * along.dot(normal)).normalize();
                let across = normal.cross(t);
                // The second derivatives along and across, over −‖g‖: curvatures, if these are the directions.
                let [kt, ka, both] = [t.dot(h * t), across.dot(h * across), t.dot(h * across)].map(|k| -k / g.length());
                let difference = kt - ka;
                let right = if family == CurvatureFamily::Max { difference > 0.0 } else { difference < 0.0 };
                segments.push((difference.hypot(2.0 * both), right));
            }
        }
    }
    let most = segments.iter().map(|s| s.0).fold(0.0, f64::max);
    segments.iter().filter(|(difference, right)| *difference > 0.2 * most && !right).count() as f64
}

fn minimal_surfaces() -> f64 {
    let centre = DVec3::splat(19.6);
    let (waist, k) = (7.0f64, std::f64::consts::TAU / 26.0);
    let catenoid = |p: DVec3| {
        let d = p - centre;
        let (rho, c, s) = (d.x.hypot(d.y), (d.z / waist).cosh(), (d.z / waist).sinh());
        let radial = DVec3::new(d.x, d.y, 0.0) / rho;
        let round = DVec3::new(-radial.y, radial.x, 0.0);
        let outer = |v: DVec3| DMat3::from_cols(v * v.x, v * v.y, v * v.z);
        let hessian = outer(DVec3::Z) * (c / waist) - outer(round) * (1.0 / rho);
        (waist * c - rho, DVec3::Z * s - radial, hessian)
    };
    let schwarz = |p: DVec3| {
        let d = (p - centre) * k;
        let (cos, sin) = (d.to_array().map(f64::cos), d.to_array().map(f64::sin));
        let hessian = DMat3::from_diagonal(DVec3::from_array(cos) * (-k * k));
        (cos.iter().sum(), DVec3::from_array(sin) * -k, hessian)
    };
    of_the_other_family(40, 0.0, catenoid) + of_the_other_family(40, 0.0, schwarz)
}

fn saddles() -> f64 {
    let centre = DVec3::splat(15.7);
    let saddle = |p: DVec3| {
        let d = p - centre;
        let (a, b) = (1.0 / 12.0, 1.0 / 20.0);
        let hessian = DMat3::from_diagonal(DVec3::new(-a, b, 0.0));
        (0.5 * (b * d.y * d.y - a * d.x * d.x) - d.z, DVec3::new(-a * d.x, b * d.y, -1.0), hessian)
    };
    let monkey = |p: DVec3| {
        let (d, c) = (p - centre, 1.0 / 500.0);
        let gradient = DVec3::new(3.0 * c * (d.x * d.x - d.y * d.y), -6.0 * c * d.x * d.y, -1.0);
        let (xx, xy) = (6.0 * c * d.x, -6.0 * c * d.y);
        let hessian = DMat3::from_cols(DVec3::new(xx, xy, 0.0), DVec3::new(xy, -xx, 0.0), DVec3::ZERO);
        (c * (d.x * d.x * d.x - 3.0 * d.x * d.y * d.y) - d.z, gradient, hessian)
    };
    of_the_other_family(32, 0.0, saddle) + of_the_other_family(32, 0.0, monkey)
}

fn long_voxels() -> f64 {
    let mut wrong = 0.0;
    for (nz, spacing, squeezed) in [(11, 4.0, 1.0), (9, 1000.0, 0.0045)] {
        let grid = Grid::with_spacing([36, 36, nz], [1.0, 1.0, spacing]).unwrap();
        let (centre, across) = (grid.centre(), DVec3::new(1.0, 1.0, squeezed));
        let volume = on(grid, |p| 15.3 - ((p - centre) * across).length());
        let (faults, strokes) = each(&volume, 0.0, |how| how);
        assert!(strokes > 20, "{spacing}: {strokes}");
        wrong += faults;
    }
    wrong
}

fn border() -> f64 {
    let volume = volume([20, 32, 9], |p| ring([p.x, p.y, p.z]) - 4.0);
    let (grown, mut wrong) =
        grown(&volume, 0.0, HatchParams { rule: DirectionEstimator::Raw, ..HatchParams::new(volume.grid()) });
    assert!(grown.counts.stops.volume > 100, "{:?}", grown.counts.stops);
    let at_border = grown.strokes.iter().filter(|(seed, _)| seed.cell[0] == 18 || seed.cell[2] == 7).count();
    assert!(at_border > 50, "{at_border}");
    wrong += each(&volume, 0.0, |how| how).0;
    wrong
}

fn far_from_the_origin() -> f64 {
    let at = |origin: DVec3| {
        let grid = Grid::new([32, 32, 20], DMat3::IDENTITY, origin).unwrap();
        let volume = on(grid, |p| ring((p - origin).to_array()) - 4.0);
        let how = HatchParams { rule: DirectionEstimator::Raw, ..HatchParams::new(volume.grid()) };
        grown(&volume, 0.0, how)
    };
    let (near, mut wrong) = at(DVec3::ZERO);
    for (far, most) in [(20, 1e-4), (30, 0.05)].map(|(k, most)| (2f64.powi(k), most)) {
        let origin = DVec3::new(far, -far, far / 2.0);
        let (found, faults) = at(origin);
        wrong += faults + found.strokes.len().abs_diff(near.strokes.len()) as f64;
        for ((_, a), (_, b)) in near.strokes.iter().zip(&found.strokes) {
            let pairs = a.vertices.iter().zip(&b.vertices);
            let beside = pairs.filter(|(a, b)| a.world.distance(b.world - origin) > most).count();
            wrong += (beside + a.vertices.len().abs_diff(b.vertices.len())) as f64;
        }
    }
    wrong
}

fn masked_spheres() -> f64 {
    let mut most = 0.0f64;
    for (radius, normal) in [(10.0, DVec3::Z), (15.0, DVec3::new(0.36, -0.48, 0.8))] {
        let volume = volume([48; 3], |p| {
            let p = p - DVec3::splat(23.5);
            if p.dot(normal) > 2.2 { f64::NAN } else { radius - p.length() }
        });
        let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
        let strokes = StrokeGrower::new(&field, Some(0.0), HatchParams::new(volume.grid()));
        let range = (Measure::Mean, [0.0, 1.0]);
        let cells: Vec<_> =
            strokes.seeds(&Pyramid::new(&volume), &field, 0.0, SeedRule::Dense, range).draw(1).collect();
        assert!(cells.len() > 500, "{}", cells.len());
        most = most.max(strokes.grow_all(&cells, |_| false).counts.strokes as f64 / cells.len() as f64);
    }
    most
}

fn tolerances() -> f64 {
    let volume = volume([32, 32, 20], |p| ring([p.x, p.y, p.z]) - 4.0);
    let mut wrong = 0.0;
    for tolerance in [1e-10, 1e-7, 1e-3, 0.1, 1e3] {
        let how = HatchParams { tolerance, length: 6.0, ..HatchParams::new(volume.grid()) };
        let (grown, faults) = grown(&volume, 0.0, how);
        assert!(grown.strokes.len() > 500, "{tolerance:e}: {}", grown.strokes.len());
        wrong += faults;
    }
    wrong
}

/// Inside the tube, where the surface hides all lines, and in the hole of the ring, with a near plane through the surface.
fn eye_inside() -> f64 {
    let found = ["eye = [31.7, 19.2, 19.9]\nnear = 1", "eye = [19.7, 19.2, 19.9]\nnear = 8.5"].map(|eye| {
        let scene = format!(
            "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 40, type = \"f64\", param = {{ R = 12, r = 5 }} }}\n\
             [camera]\nprojection = \"perspective\"\nfov = 80\n{eye}\ntarget = [31.5, 10, 20]\n\
             [picture]\nwidth = \"80 mm\"\nheight = \"60 mm\"\ndpi = 100\n\
             [hatching]\niso = 0\nseeds = \"dense\"\nspacing = \"random\"\n"
        );
        let scene = parse(&scene, Path::new("scene.toml"), &Overrides::default()).unwrap();
        let job = Job::load_for(scene, RenderTarget::Strokes, Arc::new(Disk)).unwrap();
        let mut counts = Counts::default();
        let marking = Marking::new(&job, &mut counts, &|_| ()).unwrap();
        let marks = marking.frames(&mut counts).unwrap().draw(&job.view().unwrap(), &mut counts).unwrap();
        let vertices = marks.layers.iter().flat_map(|layer| &layer.lines).flat_map(|line| &line.vertices);
        // Off the page by no more than half the widest line.
        let on = |v: f64, side: f64| (-1.0..=side + 1.0).contains(&v);
        let fine = vertices.map(|v| {
            let numbers = [v.radius, v.opacity, v.t].iter().all(|x| x.is_finite());
            numbers && on(v.at.x, 80.0) && on(v.at.y, 60.0)
        });
        let fine: Vec<bool> = fine.collect();
        (fine.len(), fine.iter().filter(|fine| !**fine).count())
    });
    assert!(found[1].0 > 100, "{found:?}");
    // What the surface hides is not drawn.
    (found[0].0 + found[1].1) as f64
}
