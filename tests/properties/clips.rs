//! Clip planes ([RAY-8]) in random scenes: what they leave keeps its bits, and planes outside leave everything.

use super::generator::{resized, scene, styles};
use crate::common::random::Random;
use crate::common::{LAYERS, Shown, Stage, ball, orthographic, perspective};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Clip, ClipSpace, Contours, Kappa, Kernel, Length, Number, PartName, Transparency};

/// Adds one to three clips to a scene: planes through the volume, along its axes or oblique, and boxes about its middle.
pub(super) fn clips(r: &mut Random, shot: &mut Stage) {
    let grid = shot.volume.grid().clone();
    shot.scene.clips = (0..1 + r.below(3)).map(|_| clip(r, &grid)).collect();
    let named = shot.scene.clips.iter().filter_map(|clip| clip.style.clone()).next().is_some();
    if named && shot.styles.iter().all(|style| style.name != "ramp") {
        shot.styles.extend(styles());
    }
}

fn clip(r: &mut Random, grid: &Grid) -> Clip {
    let mut clip = Clip {
        space: r.pick(&[ClipSpace::World, ClipSpace::Index]),
        applies: r.pick(&[vec![], vec![PartName::Background]]),
        ..Clip::default()
    };
    let [lo, hi] = grid.index_box();
    // Within the box, on voxels at times.
    let mut share = || if r.once_in(3) { r.below(3) as f64 / 2.0 } else { r.between(-0.1, 1.1) };
    let inside = lo + (hi - lo) * DVec3::new(share(), share(), share());
    let inside = if r.once_in(3) { inside.round() } else { inside };
    let point = match clip.space {
        ClipSpace::Index => inside,
        ClipSpace::World => grid.to_world(inside),
    };
    if r.once_in(3) {
        let reach = (hi - lo).max_element() * grid.voxel() * r.between(0.1, 0.8);
        clip.extent = Some(point.to_array().map(|x| [x - reach, x + reach]));
    } else {
        let axes = [[1.0, 0.0, 0.0], [0.0, -3.0, 0.0], [0.0, 0.0, 1.0]];
        let normal = if r.once_in(3) { r.pick(&axes) } else { r.direction() };
        (clip.point, clip.normal) = (Some(point), Some(normal.into()));
    }
    match r.below(4) {
        0 => clip.cap = Some([0.9, 0.1, 0.2, r.pick(&[1.0, 0.4])]),
        1 => clip.style = Some(r.pick(&["ramp", "grey"]).into()),
        _ => {}
    }
    clip
}

/// The counts of everything that was done.
fn done(shown: &Shown) -> [u64; 10] {
    let c = &shown.counts;
    [
        c.samples,
        c.gradients,
        c.hessians,
        c.style_lookups,
        c.without_normal,
        c.rays,
        c.rays_skipped,
        c.masked,
        c.halo_samples,
        c.halo_passes,
    ]
}

fn plane(space: ClipSpace, point: DVec3, normal: DVec3) -> Clip {
    Clip { space, point: Some(point), normal: Some(normal), cap: Some([1.0; 4]), ..Clip::default() }
}

/// Planes that reach no place of the box change no bit and no count.
#[test]
fn planes_outside_the_box_change_nothing() {
    for seed in 9000..9060 {
        let shot = resized(&scene(seed), [13, 11]).with(|s| s.clips.clear());
        let grid = shot.volume.grid();
        let [lo, hi] = grid.index_box();
        let r = &mut Random(seed);
        let normal = DVec3::from_array(r.direction()).normalize();
        let beyond = grid.centre() + normal * (grid.radius() * 1.001);
        let around = [0, 1, 2].map(|a| [lo[a], hi[a]]);
        let outside = shot.with(|s| {
            s.clips = vec![
                plane(ClipSpace::World, beyond, normal),
                plane(ClipSpace::Index, hi, DVec3::new(2.0, 0.0, 0.0)),
                Clip { space: ClipSpace::Index, extent: Some(around), ..Clip::default() },
            ];
        });
        let [with, without] = [outside.render(), shot.render()];
        assert_eq!(with.bits(), without.bits(), "seed {seed}");
        assert_eq!(done(&with), done(&without), "seed {seed}");
    }
}

/// A box is six planes, and a plane of index space is one of world space: the same bits and counts.
#[test]
fn a_box_is_six_planes() {
    let mut cut = 0;
    for seed in 9100..9140 {
        let r = &mut Random(seed ^ 0xb0c5);
        let shot = resized(&scene(seed), [13, 11]);
        let [lo, hi] = shot.volume.grid().index_box();
        let extent: [[f64; 2]; 3] = std::array::from_fn(|a| {
            let at = |share: f64| lo[a] + (hi[a] - lo[a]) * share;
            [at(r.between(0.0, 0.4)), at(r.between(0.6, 1.0))]
        });
        let (space, cap) = (ClipSpace::Index, Some([1.0, 0.0, 0.0, 0.5]));
        let whole = shot.with(|s| s.clips = vec![Clip { space, extent: Some(extent), cap, ..Clip::default() }]);
        let planes = shot.with(|s| {
            let side = |a: usize, i: usize| {
                let axis = DVec3::AXES[a];
                plane(space, axis * extent[a][i], if i == 0 { -axis } else { axis })
            };
            s.clips = (0..3).flat_map(|a| [side(a, 0), side(a, 1)]).map(|clip| Clip { cap, ..clip }).collect();
        });
        let [whole, planes] = [whole.render(), planes.render()];
        assert_eq!(whole.bits(), planes.bits(), "seed {seed}");
        assert_eq!(done(&whole), done(&planes), "seed {seed}");
        let shown = shot.with(|s| s.clips.clear()).render();
        cut += usize::from(shown.bits() != whole.bits());
    }
    assert!(cut > 15, "{cut}");
}

/// Planes that rays leave through change no bit of a pixel whose ray ends before them. What they cut away is not seen.
#[test]
fn what_lies_before_a_plane_keeps_its_bits() {
    let (mut before, mut behind) = (0, 0);
    for seed in 9200..9260 {
        let r = &mut Random(seed ^ 0xface);
        let nodes = [(0.0, "grey", 0.0), (0.0, "grey", 1.0)];
        let shot = Stage::styled(ball(18, 7.0), styles(), &nodes)
            .with_transfer(|t| t.transparency = Transparency::Plain)
            .layers(&LAYERS)
            .with(|s| {
                s.camera = if r.once_in(2) { orthographic(None) } else { perspective(40.0) };
                s.camera.direction = r.direction().into();
                s.sampling.step = Length::Voxels(r.pick(&[0.3, 0.5, 1.0]));
                s.sampling.kernel = r.pick(&[Kernel::Trilinear, Kernel::Bspline]);
                s.sampling.number = r.pick(&[Number::F64, Number::F32]);
                s.contours = Some(Contours { kappa: r.pick(&[Kappa::Ray, Kappa::Exact]), ..Contours::default() });
            });
        let (view, middle) = (shot.view(), shot.volume.grid().centre());
        let at = middle + view.forward * r.between(-6.0, 3.0);
        let clipped = shot.with(|s| s.clips = vec![plane(ClipSpace::World, at, view.forward)]);
        let at = (at - view.eye).dot(view.forward);
        let [whole, left] = [shot.render(), clipped.render()];
        let pixels = |shown: &Shown| -> Vec<Vec<u64>> {
            let layers = shown.picture.layers.iter().filter(|layer| layer.kind != LayerKind::Counts);
            let channels: Vec<&Vec<f64>> = layers.flat_map(|layer| &layer.channels).collect();
            (0..channels[0].len()).map(|i| channels.iter().map(|channel| channel[i].to_bits()).collect()).collect()
        };
        let (whole_bits, left_bits) = (pixels(&whole), pixels(&left));
        for (i, depth) in whole.one(LayerKind::Z).into_iter().enumerate() {
            if depth < at {
                assert_eq!(whole_bits[i], left_bits[i], "seed {seed}, pixel {i}");
                before += 1;
            } else {
                assert_eq!(left.pixels()[i][3], 0.0, "seed {seed}, pixel {i}");
                behind += usize::from(depth.is_finite());
            }
        }
    }
    assert!(before > 1000 && behind > 300, "{before} {behind}");
}
