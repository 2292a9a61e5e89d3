//! Volume stippling: what the paper and the specification say of the points and of what a frame draws.

mod curves;
mod drawing;
mod even;
mod faces;
mod frames;
mod hidden;
mod preprocess;
mod quality;
mod rows;
mod spectrum;
mod tone;

use crate::common;
use drypoint::reference::volume_stippling::{FrameInputs, Preprocess, viewing_distance};
use drypoint::scene::counts::Counts;
use drypoint::scene::glam::DVec3;
use drypoint::scene::points::Points;
use drypoint::scene::shot::StippleParams;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    Camera, GradientRange, Ink, Length, PointsPerPixel, Projection, Resolution, Scene, Stipples, VolumeSource,
    VolumeTable,
};
use drypoint::scene::view::View;
use drypoint::scene::volume::Volume;

/// The points of a volume, in unit voxels.
struct Preprocessed {
    points: Points,
}

impl Preprocessed {
    /// The first `k` points of every voxel, in index space.
    fn prefix(&self, k: usize) -> impl Iterator<Item = DVec3> {
        let points = &self.points;
        let of = move |i: usize| points.of(i)[..k].iter().map(move |o| points.voxels[i].centre() + wide(*o));
        (0..points.voxels.len()).flat_map(of)
    }

    fn centres(&self) -> impl Iterator<Item = DVec3> {
        self.points.voxels.iter().map(|voxel| voxel.centre())
    }

    fn offsets_of(&self, voxel: usize) -> impl Iterator<Item = DVec3> {
        self.points.of(voxel).iter().map(|o| wide(*o))
    }
}

fn wide(o: [f32; 3]) -> DVec3 {
    DVec3::from_array(o.map(f64::from))
}

/// A `[volume]` whose |g| is ‖g‖ over the largest.
fn table() -> VolumeTable {
    let source = VolumeSource::File { path: "test.nrrd".into(), raw: None };
    VolumeTable { gradient_range: GradientRange::Quantile(1.0), ..VolumeTable::new(source) }
}

/// An orthographic view along y in which a unit is so many pixels.
fn orthographic(volume: &Volume, pixels_a_unit: f64) -> View {
    let projection = Projection::Orthographic { height: Some(Length::World(100.0 / pixels_a_unit)) };
    let camera = Camera { projection, direction: DVec3::new(0.3, 1.0, -0.4), ..Camera::default() };
    View::new(&camera, volume.grid(), [100, 100]).unwrap()
}

/// What points and dots are made by, A_vol in pixels.
fn params(stipples: &Stipples, table: &VolumeTable, grid: &Grid, view: &View) -> StippleParams {
    let scene = Scene { volume: table.clone(), ..Scene::for_volume(table.source.clone()) };
    StippleParams { near: 0.5, ..StippleParams::new(&scene, stipples, grid, view.clone()).unwrap() }
}

/// Frames of dots `size` mm wide that nothing hides and no pen draws.
fn drawn_from<'a>(
    stipples: &Stipples,
    points: &'a Points,
    grid: &'a Grid,
    reference: &View,
    size: f64,
) -> FrameInputs<'a> {
    let stipples = StippleParams { size, ..params(stipples, &table(), grid, reference) };
    FrameInputs { stipples, points, grid, nib: None, surface: None, tone: None }
}

/// A flat tone in opaque ink: T_r is one number for all voxels, and has `tone` points of each drawn.
fn flat(stipples: Stipples, points: &Points, grid: &Grid, view: &View, tone: f64) -> Stipples {
    let reference = viewing_distance(view, grid.centre(), 0.5) * tone / points.each as f64;
    Stipples { ink: Ink::Opaque, resolution: Some(Resolution { re: 1.0, reference: Some(reference) }), ..stipples }
}

/// Points of a function of the index, `each` for a voxel.
fn points_of(dims: [usize; 3], value: impl Fn(DVec3) -> f64, stipples: &Stipples, each: usize) -> Preprocessed {
    let volume = common::volume(dims, value);
    let (view, table) = (orthographic(&volume, 8.0), table());
    // Eq. 1 is linear in k_max.
    let once = Preprocess::new(params(stipples, &table, volume.grid(), &view), &volume, None).unwrap();
    let face = (dims.iter().product::<usize>() as f64).cbrt().powi(2);
    let stipples = Stipples { k_max: PointsPerPixel::Number(each as f64 * face / once.area), ..stipples.clone() };
    let preprocess = Preprocess::new(params(&stipples, &table, volume.grid(), &view), &volume, None).unwrap();
    assert_eq!((preprocess.each, preprocess.box_side), (each, 1));
    Preprocessed { points: preprocess.points(&mut Counts::default(), &|_| {}).unwrap() }
}
