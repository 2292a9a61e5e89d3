//! A pixel is a function of its ray and of what lies on it: not of the other pixels, of a box around, of a setting that
//! means the same.

use super::generator::scene;
use crate::common::random::Random;
use crate::common::strip::ramp;
use crate::common::{LAYERS, Stage, plain};
use drypoint::scene::glam::DVec3;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    Contours, GradientEstimator, Kappa, Kernel, Length, Projection, RaysPerPixel, SphereFrame, StepAlong, Unit,
};
use drypoint::scene::volume::{Volume, Voxels};

/// An orthographic picture with more rows above and below and the same pixels has the same bits in the middle ([RAY-6]: X
/// and Y count from the middle of the picture).
#[test]
fn more_rows_above_and_below_change_no_pixel() {
    let mut checked = 0;
    for seed in 3000..3060 {
        // A background picture is stretched to the frame, so another frame shows another one. Edges are found with the
        // rows beyond.
        let shot = Stage { behind: None, ..scene(seed) };
        let [width, height] = shot.scene.picture.size;
        let Projection::Orthographic { .. } = shot.scene.camera.projection else { continue };
        // A pixel of exactly ½, so that neither height rounds it.
        let with = |rows: usize| {
            shot.with(|s| {
                s.picture.samples = RaysPerPixel::Across(s.picture.samples.across(false));
                s.picture.size = [width, rows];
                s.camera.projection = crate::common::orthographic(Some(0.5 * rows as f64)).projection;
            })
            .render()
            .pixels()
        };
        let (small, tall) = (with(height), with(height + 6));
        assert_eq!(small, tall[3 * width..(3 + height) * width], "seed {seed}");
        checked += 1;
    }
    assert!(checked > 15);
}

/// In orthographic pictures shells are planes ([RAY-1]) and v is z everywhere, so both frames of the lit sphere are one
/// ([STF-1]), bit for bit.
#[test]
fn orthographic_pictures_know_no_shells_and_no_second_frame() {
    let mut checked = 0;
    for seed in 4000..4060 {
        let shot = scene(seed);
        let Projection::Orthographic { .. } = shot.scene.camera.projection else { continue };
        let with = |along, frame| {
            shot.with(|s| s.sampling.step_along = along).with_transfer(|t| t.sphere_frame = frame).render().bits()
        };
        let planes = with(StepAlong::Plane, SphereFrame::Eye);
        assert_eq!(planes, with(StepAlong::Ray, SphereFrame::Eye), "seed {seed}");
        assert_eq!(planes, with(StepAlong::Plane, SphereFrame::View), "seed {seed}");
        checked += 1;
    }
    assert!(checked > 15);
}

/// The lattice belongs to the camera ([RAY-1]): empty voxels added behind the last ones of each axis change no bit of what
/// was there, though rays enter and leave the box elsewhere. Only what reads the border itself could tell: here it is
/// empty too, and the estimators read no farther than the next voxels.
#[test]
fn a_larger_box_changes_no_pixel() {
    for seed in 0..24 {
        let r = &mut Random(seed ^ 0x5eed);
        let inner = [0; 3].map(|_| 8 + r.below(8));
        let spacing = [0; 3].map(|_| r.between(0.6, 1.5));
        let seeds = r.bits();
        let with = |more: usize| {
            let dims = inner.map(|n| n + more);
            let noise = &mut Random(seeds);
            let mut voxels = vec![0.0; dims.iter().product()];
            for z in 3..inner[2] - 3 {
                for y in 3..inner[1] - 3 {
                    for x in 3..inner[0] - 3 {
                        voxels[(z * dims[1] + y) * dims[0] + x] = noise.unit();
                    }
                }
            }
            Volume::new(Grid::with_spacing(dims, spacing).unwrap(), Voxels::F64(voxels), 1.0, 0.0).unwrap()
        };
        let target = with(0).grid().centre();
        let eye = target - DVec3::from_array(r.direction()).normalize() * 40.0;
        let kappa = r.pick(&[Kappa::Ray, Kappa::Exact, Kappa::None { threshold: 0.3 }]);
        let gradient = r.pick(&[GradientEstimator::Central, GradientEstimator::Analytic, GradientEstimator::Sobel]);
        let kernel = r.pick(&[Kernel::Trilinear, Kernel::CatmullRom, Kernel::BsplineSmooth]);
        let camera = r.pick(&[crate::common::perspective(25.0), crate::common::orthographic(Some(15.0))]);
        let seen = |more: usize| {
            let shot = Stage::styled(with(more), vec![ramp()], &[(0.2, "ramp", 0.0), (0.9, "ramp", 0.6)]);
            shot.layers(&LAYERS)
                .with(|s| {
                    s.camera = camera.clone();
                    (s.camera.eye, s.camera.target) = (Some(eye), Some(target));
                    (s.sampling.kernel, s.sampling.gradient) = (kernel, gradient);
                    s.contours = Some(Contours { kappa, ..Contours::default() });
                    s.sampling.scale = Length::Voxels(0.1);
                })
                .render()
        };
        let small = seen(0);
        assert!(small.covered() > 5, "seed {seed}");
        for more in [1, 6, 20] {
            assert_eq!(small.bits(), seen(more).bits(), "seed {seed}: {kernel:?} {gradient:?} {kappa:?} + {more}");
        }
    }
}

/// Nodes over normalized values and over per cents of the voxels are nodes over values ([VAL-1]): with a range whose
/// width is a power of two, to the bit.
#[test]
fn units_of_nodes_are_one_function() {
    let grid = Grid::with_spacing([9, 8, 7], [1.0; 3]).unwrap();
    let r = &mut Random(5);
    // 504 voxels: k per cent of them are the ⌈5.04 k⌉-th.
    let voxels: Vec<f64> = (0..504).map(|_| (r.unit() * 64.0).floor()).collect();
    let mut sorted = voxels.clone();
    sorted.sort_by(f64::total_cmp);
    let volume = Volume::new(grid, Voxels::F64(voxels), 1.0, 0.0).unwrap();
    let seen = |unit, at: [f64; 3]| {
        let nodes: Vec<_> = at.into_iter().zip([0.0, 0.3, 0.6]).map(|(at, opacity)| (at, "a", opacity)).collect();
        Stage::styled(volume.clone(), vec![plain("a", [0.2, 0.5, 0.7, 0.9])], &nodes)
            .with_transfer(|t| t.unit = unit)
            .with(|s| s.volume.range = Some([-64.0, 64.0]))
            .render()
            .bits()
    };
    let normalized = [0.5, 0.625, 0.875];
    assert_eq!(seen(Unit::Normalized, normalized), seen(Unit::Value, normalized.map(|t| t * 128.0 - 64.0)));
    let percent = [25.0, 60.0, 100.0];
    let value = |p: f64| sorted[(p * 5.04).ceil() as usize - 1];
    assert_eq!(seen(Unit::Percentile, percent), seen(Unit::Value, percent.map(value)));
}
