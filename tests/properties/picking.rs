//! Picking ([HALO-12]): in closed form on spheres and slabs, and in agreement with the layers of random scenes.

use super::generator::{resized, scene};
use crate::common::{Stage, orthographic, perspective, quadratic_ball, volume};
use drypoint::job::Job;
use drypoint::picking::pick_pixel;
use drypoint::reference::ray::{Picked, VISIBLE};
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::fragments::{Fragment, Fragments};
use drypoint::scene::glam::DVec3;
use drypoint::scene::phantom;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{
    Camera, GradientEstimator, Iso, Kernel, Length, Number, RaysPerPixel, StepAlong, Surface, SurfaceLook,
};
use drypoint::scene::volume::labels::LabelVolume;
use std::collections::BTreeMap;

const RADIUS: f64 = 8.0;
const STEP: f64 = 0.3;

/// Picks at points of a picture, among lines if there are some.
fn picks(stage: &Stage, lines: Option<Fragments>, points: &[[f64; 2]]) -> Vec<Option<Picked>> {
    let mut picked = Vec::new();
    stage.render_by(|mut renderer| {
        renderer.merge(lines);
        picked = points.iter().map(|&point| renderer.pick(point)).collect();
        renderer
    });
    picked
}

/// The points that the first rays of all pixels go through.
fn first_rays(stage: &Stage) -> Vec<[f64; 2]> {
    let ([width, height], n) = (stage.scene.picture.size, stage.resolved(stage.view()).rays_across);
    let at = |i: usize| i as f64 + 0.5 / n as f64;
    (0..width * height).map(|t| [at(t % width), at(t / width)]).collect()
}

/// A ball that the quintic spline has to rounding, opaque from the radius on.
fn opaque_ball() -> Stage {
    Stage::regular(quadratic_ball(26, RADIUS), &[(0.0, [1.0; 3], 0.0), (0.0, [1.0; 3], 1.0)]).with(|s| {
        s.sampling.kernel = Kernel::Bspline5;
        s.sampling.gradient = GradientEstimator::Analytic;
        s.sampling.step = Length::World(STEP);
        s.camera.direction = DVec3::new(0.4, 0.8, -0.3);
    })
}

/// A picked point of an opaque ball lies inside, at most a step along the ray behind the sphere. Rays that miss the ball by a
/// clear margin pick nothing.
#[test]
fn picks_on_a_sphere_in_closed_form() {
    for (camera, samples, along) in [
        (orthographic(Some(20.0)), 1, StepAlong::Plane),
        (orthographic(Some(20.0)), 2, StepAlong::Plane),
        (perspective(50.0), 1, StepAlong::Ray),
        (perspective(50.0), 2, StepAlong::Plane),
        (perspective(50.0), 3, StepAlong::Plane),
    ] {
        let stage = opaque_ball().layers(&[LayerKind::Depth]).with(|s| {
            (s.picture.samples, s.sampling.step_along) = (RaysPerPixel::Across(samples), along);
            s.camera = Camera { direction: s.camera.direction, ..camera };
        });
        let (view, centre) = (stage.view(), stage.volume.grid().centre());
        let centres: Vec<[f64; 2]> = (0..256).map(|t| [(t % 16) as f64 + 0.5, (t / 16) as f64 + 0.5]).collect();
        let (mut hits, mut misses) = (0, 0);
        for (picked, [i, j]) in picks(&stage, None, &centres).into_iter().zip(centres) {
            let ray = view.ray(i, j);
            let along_ray = ray.along.normalize();
            let to_centre = centre - ray.origin;
            let nearest = (to_centre - along_ray * to_centre.dot(along_ray)).length();
            let step = if along == StepAlong::Ray { STEP } else { STEP / ray.cos_phi };
            let Some(picked) = picked else {
                // A chord of at most a step can lie between two samples.
                assert!(nearest > RADIUS - step * step / RADIUS, "{nearest}");
                misses += 1;
                continue;
            };
            hits += 1;
            let entry = to_centre.dot(along_ray) - (RADIUS * RADIUS - nearest * nearest).max(0.0).sqrt();
            let behind = (picked.world - ray.origin).dot(along_ray) - entry;
            assert!((-1e-9..step + 1e-9).contains(&behind), "{behind}");
            assert!((ray.origin + along_ray * (entry + behind)).distance(picked.world) < 1e-9);
            let outside = (picked.world - centre).length() - RADIUS;
            assert!((-step..1e-9).contains(&outside), "{outside}");
            assert!((picked.depth - -view.to_eye(picked.world).z).abs() < 1e-9);
            let normal = picked.normal.unwrap();
            assert!(normal.dot((picked.world - centre).normalize()) > 1.0 - 1e-9, "{normal}");
            assert_eq!((picked.opacity, picked.label, picked.on_surface), (1.0, None, false));
        }
        assert!(hits > 20 && misses > 20, "{hits} {misses}");
        // The rays of the picture itself end where picks are.
        let depths = stage.render().layer::<3>(LayerKind::Depth);
        for (picked, [first, half, mean]) in picks(&stage, None, &first_rays(&stage)).iter().zip(depths) {
            let depth = picked.map_or(f64::INFINITY, |picked| picked.depth);
            assert_eq!([first, half, mean], [depth; 3], "{samples} {along:?}");
        }
    }
}

/// On the iso-surface a picked point is exact, alone and behind something faint.
#[test]
fn picks_on_an_iso_surface_to_rounding() {
    let mut found = 0;
    for alone in [true, false] {
        for camera in [orthographic(Some(20.0)), perspective(50.0)] {
            let stage = opaque_ball().layers(&[LayerKind::Z]).with(|s| {
                s.camera = Camera { direction: s.camera.direction, ..camera };
                s.surface = Some(Surface { iso: Iso::Value(1.0), look: SurfaceLook::White, ..Surface::default() });
            });
            let faint = stage.with_transfer(|t| {
                for node in t.nodes.as_mut().unwrap() {
                    node.opacity *= 1e-4;
                }
            });
            let stage = if alone { stage.with(|s| s.transfer = None) } else { faint };
            let centre = stage.volume.grid().centre();
            let z = stage.render().one(LayerKind::Z);
            for (picked, z) in picks(&stage, None, &first_rays(&stage)).into_iter().zip(z) {
                let Some(picked) = picked.filter(|picked| picked.on_surface) else {
                    assert_eq!(z, f64::INFINITY);
                    continue;
                };
                found += 1;
                // f = (R² − ρ²)/2R is 1 at ρ = √(R² − 2R).
                let off = (picked.world - centre).length() - (RADIUS * RADIUS - 2.0 * RADIUS).sqrt();
                assert!(off.abs() < 1e-9, "{off}");
                assert_eq!((picked.value, picked.opacity, picked.depth), (1.0, 1.0, z));
                let normal = picked.normal.unwrap();
                assert!(normal.dot((picked.world - centre).normalize()) > 1.0 - 1e-9, "{normal}");
            }
        }
    }
    assert!(found > 150, "{found}");
}

/// Layers along the view: skin of four samples, and bone behind it.
fn skin(skin: [f64; 2], bone: f64) -> Stage {
    let white = [1.0; 3];
    let level =
        |from: f64, to: f64, alpha| [(from, white, 0.0), (from, white, alpha), (to, white, alpha), (to, white, 0.0)];
    let nodes = [level(3.0, 4.0, skin[0]), level(6.0, 7.0, skin[1]), level(9.0, 20.0, bone)].concat();
    Stage::regular(volume([8, 14, 8], |p| p.y), &nodes).step(0.25)
}

#[test]
fn faint_skin_is_passed_over() {
    let pick = |stage: &Stage| picks(stage, None, &[[8.5, 7.5]])[0];
    // A = 1 − 0.99⁸ = 0.077 after both layers of four samples of 0.01, above 1/16; with 0.007 it is 0.055.
    let opaque = pick(&skin([0.007, 0.007], 1.0)).unwrap();
    assert!((9.0..9.25).contains(&opaque.value), "{opaque:?}");
    assert_eq!((opaque.opacity, opaque.world.y), (1.0, opaque.value));
    let second = pick(&skin([0.01, 0.01], 1.0)).unwrap();
    assert!((6.0..7.0).contains(&second.value), "{second:?}");
    assert!(second.opacity >= VISIBLE && second.opacity < VISIBLE + 0.01);
    // Skin that can be seen is met at its second sample: 1 − 0.96² = 0.0784.
    let skinned = pick(&skin([0.04, 0.04], 1.0)).unwrap();
    assert!((3.25..3.5).contains(&skinned.value), "{skinned:?}");
    assert!((skinned.opacity - 0.0784).abs() < 1e-12);
    // Where all is faint, the heaviest sample holds, and of equal opacities the first.
    let faint = pick(&skin([0.002, 0.003], 0.0)).unwrap();
    assert!((6.0..6.25).contains(&faint.value), "{faint:?}");
    let first = pick(&skin([0.002, 0.002], 0.0)).unwrap();
    assert!((3.0..3.25).contains(&first.value), "{first:?}");
    // From ½ on, 1 − 0.96⁸ = 0.28 is a veil, and 1 − 0.9⁸ = 0.57 is not: its seventh sample, in the second layer.
    for (skin, of, stage) in [(0.04, 9.0..9.25, skin([0.04; 2], 1.0)), (0.1, 6.5..6.75, skin([0.1; 2], 1.0))] {
        stage.render_by(|renderer| {
            let picked = renderer.pick_from(0.5, [8.5, 7.5]).unwrap();
            assert!(of.contains(&picked.value), "{skin}: {picked:?}");
            renderer
        });
    }
}

/// Masked cells are transparent, so what lies behind is picked.
#[test]
fn masked_cells_are_passed_over() {
    let mut stage = skin([0.0, 0.0], 1.0);
    let with_hole = volume([8, 14, 8], |p| if p.y == 10.0 { f64::NAN } else { p.y });
    stage.volume = with_hole;
    // The cells from 9 to 11 have an invalid voxel.
    let picked = picks(&stage, None, &[[8.5, 7.5]])[0].unwrap();
    assert!((11.0..11.25).contains(&picked.world.y), "{picked:?}");
}

/// A phantom's own formula is picked where it has the value, without the error of voxels.
#[test]
fn a_phantom_is_picked_by_its_formula() {
    let text = r##"drypoint = 1
[volume]
phantom = { name = "sphere", size = 20, type = "f64", param = { R = 6 } }
[picture]
size = [15, 15]
[transfer]
kind = "regular"
nodes = [{ at = 0, color = "#ffffff", opacity = 0 }, { at = 0, color = "#ffffff", opacity = 1 }]
"##;
    let job = Job::load(parse(text, "sphere.toml".as_ref(), &Overrides::default()).unwrap()).unwrap();
    let grid = job.volume.grid();
    let phantom = phantom::by_name("sphere", grid, &[("R".into(), 6.0)]).unwrap();
    let variant = job.variant(job.scene.clone());
    let exact = job.exact_renderer_of(&variant, &*phantom).unwrap();
    let [by_voxels, by_formula] = [job.renderer().unwrap(), exact].map(|r| pick_pixel(&r, [7, 7]).unwrap());
    assert!((by_formula.value - (6.0 - by_formula.world.distance(grid.centre()))).abs() < 1e-12);
    assert!(by_formula.value >= 0.0 && by_formula.world.distance(by_voxels.world) < 1.0);
}

#[test]
fn nothing_is_picked_where_nothing_is_seen() {
    assert_eq!(picks(&skin([0.0, 0.0], 0.0), None, &[[8.5, 7.5]]), [None]);
    let everywhere = skin([1.0, 1.0], 1.0);
    let outside = [[-0.5, 8.0], [8.0, 16.5], [f64::NAN, 8.0], [8.0, f64::INFINITY], [-1e300, 8.0]];
    assert_eq!(picks(&everywhere, None, &outside), [None; 5]);
    // The corners themselves are in the picture, and beside the volume's box.
    assert_eq!(picks(&everywhere, None, &[[0.0, 0.0], [16.0, 16.0]]), [None; 2]);
}

#[test]
fn a_picked_place_has_the_label_of_its_voxel() {
    let mut stage = skin([0.0, 0.0], 1.0);
    assert_eq!(picks(&stage, None, &[[8.5, 7.5]])[0].unwrap().label, None);
    // Labels 1 and 2 in the halves of the volume, left and right in the picture.
    stage.labels = Some(LabelVolume::new(&volume([8, 14, 8], |p| if p.x < 4.0 { 1.0 } else { 2.0 })).unwrap());
    let labels: Vec<_> = picks(&stage, None, &[[7.5, 7.5], [8.5, 7.5]]).iter().map(|p| p.unwrap().label).collect();
    let right = stage.view().right.x > 0.0;
    assert_eq!(labels, if right { [Some(1), Some(2)] } else { [Some(2), Some(1)] });
}

/// Picks agree with the layers where both mean one sample: a first sample with A ≥ 1/16 is `depth.FIRST`, one with A ≥ 1/2 is
/// `Z`. Lines change nothing.
#[test]
fn picks_agree_with_the_layers() {
    let (mut seen, mut firsts, mut halves, mut surfaces, mut faint) = (0, 0, 0, 0, 0);
    let mut kinds = BTreeMap::new();
    for seed in 9000..9350 {
        let layers = [LayerKind::Depth, LayerKind::First, LayerKind::FirstNormal];
        let stage = resized(&scene(seed), [9, 7]).layers(&layers);
        let shown = stage.render();
        let depths = shown.layer::<3>(LayerKind::Depth);
        let (values, normals) = (shown.one(LayerKind::First), shown.layer::<3>(LayerKind::FirstNormal));
        let points = first_rays(&stage);
        let picked = picks(&stage, None, &points);
        let across = stage.resolved(stage.view()).rays_across;
        let line = Fragment { depth: 1.0, rgb: [0.9, 0.2, 0.1], opacity: 0.9 };
        let lines: Vec<(usize, Fragment)> = (0..63 * across * across).map(|ray| (ray, line)).collect();
        let lines = Fragments::new([9, 7], across, &lines);
        assert_eq!(picks(&stage, Some(lines), &points), picked, "seed {seed}");
        let view = stage.view();
        let rounding = if stage.scene.sampling.number == Number::F32 { 1e-4 } else { 1e-9 };
        for (t, (picked, [first, half, _])) in picked.into_iter().zip(depths).enumerate() {
            let context = format!("seed {seed}, pixel {t}: {picked:?}, {first} {half}");
            let Some(picked) = picked else {
                assert_eq!(first, f64::INFINITY, "{context}");
                continue;
            };
            seen += 1;
            assert!(picked.depth >= first, "{context}");
            let distance = -view.to_eye(picked.world).z;
            assert!(
                (picked.depth - distance).abs() <= rounding * (1.0 + distance.abs() + view.eye.length()),
                "{context}"
            );
            if picked.opacity >= 0.5 {
                halves += 1;
                assert_eq!(picked.depth, half, "{context}");
            }
            faint += usize::from(picked.opacity < VISIBLE);
            surfaces += usize::from(picked.on_surface);
            if picked.depth == first {
                firsts += 1;
                assert_eq!(picked.value, values[t], "{context}");
                let eye = picked.normal.map(|n| view.direction_to_eye(n));
                let eye = eye.unwrap_or_else(|| view.ray(points[t][0], points[t][1]).v);
                assert!(eye.distance(normals[t].into()) < 1e-5, "{context}: {eye} {:?}", normals[t]);
            }
        }
        *kinds.entry(format!("{:?} {:?}", stage.scene.sampling.number, stage.scene.sampling.kernel)).or_insert(0) += 1;
    }
    println!("{seen} picks: {firsts} first samples, {halves} halves, {surfaces} on surfaces, {faint} faint; {kinds:?}");
    assert!(
        seen > 1500 && firsts > 500 && halves > 500 && surfaces > 50 && faint > 50 && kinds.len() == 10,
        "{kinds:?}"
    );
}
