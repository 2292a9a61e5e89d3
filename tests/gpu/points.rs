//! Points that an iso-surface hides.

use crate::double::load;
use crate::field::scene;
use crate::formulas::random;
use crate::gpu;
use drypoint::drawing::Drawing;
use drypoint::gpu::{GpuError, HiddenPoints, Hiding, Precision, UploadedVolume};
use drypoint::job::Job;
use drypoint::marking::Marking;
use drypoint::reference::field::{Field, GradientEstimator, Kernel, Reconstruction, Rung};
use drypoint::reference::surface::IsoSurface;
use drypoint::reference::volume_stippling::hides;
use drypoint::scene::clip::{ClipPlane, ClipPlanes};
use drypoint::scene::counts::Counts;
use drypoint::scene::glam::DVec3;
use drypoint::scene::points::SurfacePoint;

/// The value of the surface in the volumes of bumps.
const ISO: f64 = 150.0;

/// Points anywhere in a volume, with the directions of their voxels: from far away, near the surface, and beyond its reach.
fn points(job: &Job, count: usize) -> Vec<SurfacePoint> {
    let grid = job.volume.grid();
    let [low, high] = grid.index_box();
    let mut next = random(31);
    let mut anywhere = |low: DVec3, high: DVec3| low + (high - low) * DVec3::new(next(), next(), next());
    let point = |_| {
        let at = grid.to_world(anywhere(low, high));
        let normal = (at - grid.centre() + anywhere(DVec3::splat(-1.0), DVec3::splat(1.0))).normalize();
        // Up to the other side of the volume's inside.
        let reach = anywhere(DVec3::ONE, DVec3::splat(12.0)).x * grid.voxel();
        SurfacePoint { at, normal, reach }
    };
    (0..count).map(point).collect()
}

/// The camera, the surface and the planes of a comparison.
pub(crate) struct Case<'c> {
    pub(crate) kernel: Kernel,
    pub(crate) gradient: GradientEstimator,
    pub(crate) clip: &'c ClipPlanes,
    pub(crate) precision: Precision,
    /// The distance in front of the surface, in voxels.
    pub(crate) in_front: f64,
}

/// Points that both see, points that both find hidden, and points on which they differ.
pub(crate) fn compare(job: &Job, case: &Case<'_>, edit: &dyn Fn(String) -> String) -> Option<[usize; 3]> {
    let gpu = gpu()?;
    let (view, near) = (job.view().unwrap(), 0.25);
    let how = Reconstruction { kernel: case.kernel, gradient: case.gradient, ..Reconstruction::default() };
    let field = Field::new(&job.volume, how, Rung::Gradient).unwrap();
    let surface = IsoSurface::new(&field, ISO).clipped(case.clip);
    let in_front = case.in_front * job.volume.grid().voxel();
    let points = points(job, 3000);
    let measured = surface.measured();
    let draw = || -> Result<Vec<bool>, GpuError> {
        let volume = UploadedVolume::new(&gpu, &measured, case.precision)?;
        let hiding = Hiding {
            volume: &job.volume,
            measured: &measured,
            reconstruction: how,
            iso: ISO,
            clip: case.clip,
            perspective: view.perspective,
            near,
        };
        HiddenPoints::edited(&gpu, &volume, &hiding, edit)?.hidden(&view, in_front, &points)
    };
    let found = draw().unwrap_or_else(|error| panic!("{error}"));
    let mut counts = [0; 3];
    for (point, &hidden) in points.iter().zip(&found) {
        let truth = hides(&surface, &view, near, in_front, point);
        counts[if truth == hidden { usize::from(truth) } else { 2 }] += 1;
    }
    Some(counts)
}

/// A plane through the volume of bumps.
pub(crate) fn plane(job: &Job) -> ClipPlanes {
    let plane = |normal| ClipPlane::in_index(DVec3::new(4.3, 3.1, 4.2), DVec3::from_array(normal), job.volume.grid());
    ClipPlanes(vec![plane([0.3, -0.3, 1.0])])
}

const PERSPECTIVE: &str = "";
const PARALLEL: &str = "projection = \"orthographic\"\n";

#[test]
fn points_are_hidden_like_the_references() {
    let none = ClipPlanes(Vec::new());
    let [small, masked, bytes] = [([9, 8, 10], "float"), ([11, 9, 8], "masked"), ([11, 9, 8], "uchar")];
    use GradientEstimator::{Analytic, Central, Sobel};
    for ((dims, kind), camera, kernel, gradient, is_cut, in_front) in [
        (small, PERSPECTIVE, Kernel::Trilinear, Central, false, 0.15),
        (small, PARALLEL, Kernel::Trilinear, Analytic, true, 0.15),
        (small, PERSPECTIVE, Kernel::Bspline, Analytic, false, -0.15),
        (masked, PERSPECTIVE, Kernel::CatmullRom, Sobel, true, 0.15),
        (masked, PARALLEL, Kernel::Trilinear, Central, false, 0.15),
        (bytes, PARALLEL, Kernel::Bspline, Analytic, false, 0.15),
        (bytes, PERSPECTIVE, Kernel::Trilinear, Central, true, -0.15),
    ] {
        let job = load(&scene(dims, kind, "").replace("[camera]\n", &format!("[camera]\n{camera}")));
        let cut = plane(&job);
        let clip = if is_cut { &cut } else { &none };
        let of = |precision| compare(&job, &Case { kernel, gradient, clip, precision, in_front }, &|text| text);
        let (Some(double), Some(single)) = (of(Precision::Double), of(Precision::Single)) else { return };
        println!("{kind}, {kernel:?}, {gradient:?}, {} planes: {double:?}, {single:?}", clip.0.len());
        assert!(double[0] > 100 && double[1] > 100, "{double:?}");
        assert_eq!(double[2], 0, "{kind}, {kernel:?}, {gradient:?}");
        // Points within rounding of a decision may part.
        assert!(single[2] <= 3, "{single:?}");
    }
}

/// The frames of a turn have the dots that the reference draws, up to the few at a decision.
#[test]
fn dots_of_every_frame() {
    let Some(gpu) = gpu() else { return };
    let text = "drypoint = 1\n[volume]\nphantom = { name = \"torus\", size = 24 }\n[camera]\ndirection = [0.4, 1, -0.3]\n\
                [picture]\nsize = [96, 80]\n[orbit]\nframes = 3\ndegrees = 90\n\
                [stipples]\nsize = \"1 px\"\nhide_behind = 128\n[stipples.lighting]\n";
    let job = load(text);
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_| {}).unwrap_or_else(|failure| panic!("{failure}"));
    let mut frames = Drawing::new(&job, &marking, &mut counts).unwrap_or_else(|failure| panic!("{failure}"));
    let mut on_gpu = Drawing::on(&job, &marking, Some(&gpu), &mut counts).unwrap_or_else(|failure| panic!("{failure}"));
    for i in 0..3 {
        let [truth, drawn] = [&mut frames, &mut on_gpu].map(|frames| {
            let (frame, counts) = frames.frame(i, &|_| {}).unwrap_or_else(|failure| panic!("{failure}"));
            (frame.marks.unwrap().layers[0].dots.clone(), counts.preprocess["hidden points"])
        });
        println!("frame {i}: {} and {} dots, {} and {} hidden", truth.0.len(), drawn.0.len(), truth.1, drawn.1);
        assert!(truth.0.len() > 500 && truth.1 > 500);
        assert_eq!(truth.0.len() as u64 + truth.1, drawn.0.len() as u64 + drawn.1);
        let missing = truth.0.iter().filter(|dot| !drawn.0.contains(dot)).count();
        assert!(missing <= 3, "{missing}");
    }
}
