//! A first picture for a volume without a description: values, viewpoint and style.
//!
//! Nothing here comes from a paper. The choices serve a first look. They are written into the scene, where they can
//! be changed.

mod boundary;
mod content;
mod debris;
mod extent;
mod framing;
mod labels;
mod levels;
mod stance;
mod surface_styles;

use boundary::FirstSurfaces;
use content::{ContentRange, VolumeContent};
use drypoint_scene::counts::Counts;
use drypoint_scene::memory::{self, NoRoom};
use drypoint_scene::space::Grid;
use drypoint_scene::tables::{
    Camera, Contours, GradientEstimator, HessianEstimator, Ids, Iso, Kappa, Kernel, Length, Outside, Projection, Scene,
    Transfer, Unit, VolumeSource, VolumeTable,
};
use drypoint_scene::volume::Volume;
use levels::Levels;
use stance::Stance;
use surface_styles::Palette;

/// Vertical field of view of a suggested camera, in degrees.
const FOV: f64 = 30.0;

/// Thickness of contours as a share of the picture's height: 2½ pixels of 512.
const LINE: f64 = 0.005;

/// Least width of content in voxels, for sampling: smaller content is sampled as finely, and is as opaque, as content
/// of this width.
const FINE: f64 = 8.0;

/// Ratio of the largest spacing to the smallest above which slices are thick. Their terraces comb contours.
const THICK: f64 = 1.5;

/// Largest number of voxels of which a smoothed copy in f64 is worth its memory, a quarter of a GiB.
const SMOOTHED: usize = 1 << 25;

/// Makes a scene for a bare volume: an opaque surface, alone or in a translucent hull, with contours, framed by a
/// camera. A label volume is shown as the surface of all labels. The number of voxels read goes to `counts`.
///
/// # Errors
/// Memory that the budget does not allow.
pub fn scene(source: VolumeSource, volume: &Volume, size: [usize; 2], counts: &mut Counts) -> Result<Scene, NoRoom> {
    fill(Scene::for_volume(source), volume, size, counts)
}

/// Fills a scene that has tables of its own. A transfer function gets nodes and contours, an iso-surface or the
/// surface of stipples the value of the outermost boundary. A scene without them gets the camera alone. The number of
/// voxels read goes to `counts`.
///
/// # Errors
/// Memory that the budget does not allow.
pub fn fill(scene: Scene, volume: &Volume, size: [usize; 2], counts: &mut Counts) -> Result<Scene, NoRoom> {
    if labels::are_ids(volume) {
        memory::room(volume.grid().len() as u64)?;
        of_labels(scene, &volume.present(), size)
    } else {
        of_values(scene, volume, size, counts)
    }
}

/// Gives a transfer function without nodes those of the volume's strongest boundaries. The number of voxels read goes
/// to `counts`.
pub fn fill_function(transfer: &mut Transfer, volume: &Volume, outside: Outside, counts: &mut Counts) {
    let levels = levels(volume, outside, counts);
    let boundary = FirstSurfaces::find(levels.as_ref(), volume, outside);
    transfer.unit = Unit::Value;
    transfer.nodes = Some(surface_styles::nodes(&boundary, Palette::of(volume, &boundary), transfer.kind, outside));
}

/// The value of the surface that an automatic transfer function makes opaque. For parts that are shown as one, the
/// value lies halfway. The number of voxels read goes to `counts`.
pub fn iso(volume: &Volume, table: &VolumeTable, counts: &mut Counts) -> f64 {
    if table.ids == Ids::Mask {
        return 0.5;
    }
    let outside = table.outside;
    let main = FirstSurfaces::find(levels(volume, outside, counts).as_ref(), volume, outside).main;
    surface_styles::short(main.value, main.step)
}

/// Levels from the differences of each voxel to its neighbours. A constant volume has none.
fn levels(volume: &Volume, outside: Outside, counts: &mut Counts) -> Option<Levels> {
    let levels = Levels::of(volume, outside);
    let voxels = levels.as_ref().map_or(0, |_| volume.grid().len() as u64);
    *counts.preprocess.entry("differences".into()).or_default() += voxels;
    levels
}

fn of_values(mut scene: Scene, volume: &Volume, size: [usize; 2], counts: &mut Counts) -> Result<Scene, NoRoom> {
    let (boundary, outside) = FirstSurfaces::judge(levels(volume, Outside::Low, counts).as_ref(), volume);
    scene.volume.outside = outside;
    if let Some(transfer) = &mut scene.transfer {
        transfer.nodes = Some(surface_styles::nodes(&boundary, Palette::of(volume, &boundary), transfer.kind, outside));
    }
    // Without the outermost surface, content inside it would float. Outlines of stipples are those of the same surface.
    let outermost = boundary.outermost();
    let outermost = Iso::Value(surface_styles::short(outermost.value, outermost.step));
    let outlines = scene.outlines.as_mut().filter(|_| scene.stipples.is_some()).map(|outlines| &mut outlines.iso);
    let stipples = scene.stipples.as_mut().map(|stipples| [&mut stipples.iso, &mut stipples.hide_behind]);
    let surfaces = scene.surface.as_mut().map(|surface| &mut surface.iso).into_iter().chain(outlines);
    surfaces
        .chain(stipples.into_iter().flatten().flatten())
        .filter(|iso| **iso == Iso::Auto)
        .for_each(|iso| *iso = outermost);
    let [inside, seen] = [boundary.outermost().value, surface_styles::first_seen(&boundary, outside)]
        .map(|value| ContentRange { value, outside });
    // Parts are those of what is drawn: of the function, of the outermost surface, or of the main one.
    let (value, step) = if scene.transfer.is_some() {
        (seen.value, boundary.outermost().step)
    } else {
        let drawn =
            if scene.surface.is_some() || scene.stipples.is_some() { boundary.outermost() } else { boundary.main };
        (drawn.value, drawn.step)
    };
    let shown = surface_styles::short(value, step);
    scene.volume.parts = debris::without_debris(volume, ContentRange { value: shown, outside });
    frame(&mut scene, volume, [inside, seen], boundary.steep, size)?;
    Ok(scene)
}

/// A scene of labels. A smoothing kernel rounds the step from 0 to 1 between voxels, or every voxel would show.
fn of_labels(mut scene: Scene, present: &Volume, size: [usize; 2]) -> Result<Scene, NoRoom> {
    scene.volume.ids = Ids::Mask;
    scene.sampling.kernel = Kernel::BsplineSmooth;
    if let Some(transfer) = &mut scene.transfer {
        transfer.nodes = Some(surface_styles::label_nodes());
    }
    frame(&mut scene, present, [ContentRange { value: 0.5, outside: Outside::Low }; 2], false, size)?;
    Ok(scene)
}

/// Sets camera, picture, kernel and lines for the content, and for the visible surface around it.
fn frame(
    scene: &mut Scene,
    volume: &Volume,
    [inside, seen]: [ContentRange; 2],
    is_steep: bool,
    size: [usize; 2],
) -> Result<(), NoRoom> {
    let body = VolumeContent::of(volume, inside)?;
    let Stance { direction, up } = Stance::of(volume, &body);
    let fit = framing::fit(volume, &body, seen, direction, up, FOV, size);
    scene.picture.size = size;
    scene.camera = Camera {
        projection: Projection::Perspective { fov: FOV },
        eye: Some(fit.eye),
        target: Some(fit.target),
        up,
        ..Camera::default()
    };
    // Scans have terraces from slices, and noise has grain. Normals over 3³ voxels and curvatures of a smoothed grid
    // show neither.
    if scene.transfer.is_some() || scene.surface.is_some() || scene.stipples.is_some() {
        scene.sampling.gradient = GradientEstimator::Sobel;
    }
    if scene.transfer.is_none() {
        return Ok(());
    }
    let thick = has_thick_slices(volume.grid());
    // Small content gets finer steps, and a reference length that keeps it as opaque.
    let finer = fit.extent / (FINE * volume.grid().voxel());
    // Terraces are as high as a slice. A smoothing kernel rounds them off, and teeth, too. Small steep content would fade.
    if (thick || is_steep && finer >= 1.0) && scene.surface.is_none() {
        scene.sampling.kernel = Kernel::BsplineSmooth;
    }
    if finer < 1.0 {
        // Otherwise such small content would stay translucent.
        scene.sampling.step = Length::Voxels(three_digits(0.5 * finer));
        scene.sampling.reference_length = Length::Voxels(three_digits(finer));
    }
    let smoothed = volume.grid().len() <= SMOOTHED;
    if smoothed {
        scene.sampling.hessian = HessianEstimator::Gaussian;
        scene.sampling.scale = Length::Voxels(if thick { 3.0 } else { 2.0 });
    }
    scene.contours = Some(Contours {
        kappa: if smoothed { Kappa::Exact } else { Kappa::Ray },
        thickness: Length::World(three_digits(LINE * fit.height)),
        fade: Some([0.02, 0.1]),
        ..Contours::default()
    });
    Ok(())
}

/// Whether one spacing is much larger than another, as between the slices of a scan. Axes of one voxel do not count.
fn has_thick_slices(grid: &Grid) -> bool {
    let smallest = grid.voxel();
    grid.spacing().into_iter().zip(grid.dims()).any(|(spacing, n)| n > 1 && spacing > THICK * smallest)
}

/// Rounds a length to three digits, as a person would write it. Multiplication and division alone make the power of
/// ten.
fn three_digits(length: f64) -> f64 {
    let mut scale = 1.0;
    while length / scale >= 1000.0 {
        scale *= 10.0;
    }
    while length / scale < 100.0 && scale > 1e-300 {
        scale /= 10.0;
    }
    // The decimal text removes rounding digits.
    let rounded = (length / scale).round() * scale;
    format!("{rounded:.3e}").parse().unwrap_or(rounded)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::volume::{VoxelType, Voxels};

    /// 32³ voxels of a type.
    pub(super) fn typed(value: impl Fn([usize; 3]) -> f64, to: VoxelType) -> Volume {
        let n = 32;
        let values: Vec<f64> = (0..n * n * n).map(|i| value([i % n, i / n % n, i / (n * n)])).collect();
        let grid = Grid::with_spacing([n; 3], [1.0; 3]).unwrap();
        Volume::new(grid, Voxels::from_f64(&values, to), 1.0, 0.0).unwrap()
    }

    pub(super) fn volume(value: impl Fn([usize; 3]) -> f64) -> Volume {
        typed(value, VoxelType::F64)
    }

    /// Distance from the middle of such a volume.
    pub(super) fn radius([x, y, z]: [usize; 3]) -> f64 {
        let square = |i: usize| (i as f64 - 15.5).powi(2);
        (square(x) + square(y) + square(z)).sqrt()
    }

    fn suggested(volume: &Volume) -> Scene {
        let source = VolumeSource::File { path: "x.nrrd".into(), raw: None };
        scene(source, volume, [64, 64], &mut Counts::default()).unwrap()
    }

    #[test]
    fn labels_are_shown_as_one_body() {
        let ids = typed(|p| if radius(p) < 10.0 { 3.0 + (p[2] / 16) as f64 } else { 0.0 }, VoxelType::U8);
        let of_ids = suggested(&ids);
        assert_eq!((of_ids.volume.ids, of_ids.sampling.kernel), (Ids::Mask, Kernel::BsplineSmooth));
        let soft = typed(|p| 200.0 / (1.0 + (radius(p) - 10.0).exp()), VoxelType::U8);
        assert_eq!(suggested(&soft).volume.ids, Ids::Values);
    }

    #[test]
    fn an_iso_value_lies_where_the_function_turns_opaque() {
        let ball = volume(|p| 200.0 / (1.0 + (radius(p) - 10.0).exp()));
        let mut counts = Counts::default();
        let mut table = VolumeTable::new(VolumeSource::File { path: "x.nrrd".into(), raw: None });
        let iso = iso(&ball, &table, &mut counts);
        let mut transfer = Transfer::automatic(drypoint_scene::tables::TransferKind::Regular);
        fill_function(&mut transfer, &ball, Outside::Low, &mut counts);
        let nodes = transfer.nodes.unwrap();
        let [.., before, after] = &nodes[..] else { panic!("{nodes:?}") };
        assert!(before.at < iso && iso < after.at && (50.0..150.0).contains(&iso), "{iso}");
        assert_eq!(counts.preprocess["differences"], 2 * 32 * 32 * 32);
        table.ids = Ids::Mask;
        assert_eq!(super::iso(&ball.present(), &table, &mut counts), 0.5);
    }

    #[test]
    fn lines_are_as_thick_in_every_volume() {
        let lines = |scale: f64| {
            let grid = Grid::with_spacing([32; 3], [scale; 3]).unwrap();
            let ball = typed(|p| 200.0 / (1.0 + (radius(p) - 10.0).exp()), VoxelType::U8);
            let ball = Volume::new(grid, ball.voxels().clone(), 1.0, 0.0).unwrap();
            match suggested(&ball).contours.unwrap().thickness {
                Length::World(w) => w / scale,
                other => panic!("{other:?} is not in world units"),
            }
        };
        // Rounded to three digits: half a unit of the third.
        assert!((lines(1.0) / lines(0.013) - 1.0).abs() < 0.01);
    }

    /// Parts that are not drawn get no suggestions; the camera is the same.
    #[test]
    fn a_stage_is_the_camera_alone() {
        let ball = typed(|p| 200.0 / (1.0 + (radius(p) - 10.0).exp()), VoxelType::U8);
        let source = VolumeSource::File { path: "x.nrrd".into(), raw: None };
        let stage = Scene { transfer: None, ..Scene::for_volume(source) };
        let stage = fill(stage, &ball, [64, 64], &mut Counts::default()).unwrap();
        assert_eq!(stage.camera, suggested(&ball).camera);
        assert_eq!((stage.transfer, stage.contours), (None, None));
    }

    #[test]
    fn thick_slices_are_smoothed() {
        let ball = typed(|p| 200.0 / (1.0 + (radius(p) - 10.0).exp()), VoxelType::U8);
        for (spacing, thick) in [([1.0, 1.0, 1.4], false), ([1.0, 1.0, 2.0], true), ([3.0, 1.0, 1.0], true)] {
            let grid = Grid::with_spacing([32; 3], spacing).unwrap();
            let sampling = suggested(&Volume::new(grid, ball.voxels().clone(), 1.0, 0.0).unwrap()).sampling;
            assert_eq!(sampling.kernel == Kernel::BsplineSmooth, thick, "{spacing:?}");
            assert_eq!(sampling.scale, Length::Voxels(if thick { 3.0 } else { 2.0 }), "{spacing:?}");
        }
        // One slice has no neighbour.
        assert!(!has_thick_slices(&Grid::with_spacing([9, 9, 1], [1.0, 1.0, 5.0]).unwrap()));
    }

    /// The logistic edge of width w is as steep as 1/(4w).
    #[test]
    fn steep_surfaces_are_smoothed() {
        for (w, steep) in [(1.0, false), (0.5, true)] {
            let ball = typed(|p| 200.0 / (1.0 + ((radius(p) - 10.0) / w).exp()), VoxelType::U8);
            let found = suggested(&ball);
            let plan = drypoint_scene::plan::Plan::new(&found);
            let is_told = plan.has_pass(drypoint_scene::plan::Pass::SmoothingKernel);
            assert_eq!((found.sampling.kernel == Kernel::BsplineSmooth, is_told), (steep, steep), "{w}");
        }
    }

    #[test]
    fn lengths_are_short_numbers() {
        for (length, short) in [(1.23456, 1.23), (0.000987654, 0.000988), (123456.0, 123000.0), (99.96, 100.0)] {
            assert_eq!(three_digits(length), short);
        }
        assert_eq!(three_digits(0.0), 0.0);
    }
}
