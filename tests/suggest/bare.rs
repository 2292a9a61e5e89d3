//! A bare volume gives a good picture by itself: four measures, taken on the picture.

use crate::data;
use crate::measure::{Measures, measure};
use drypoint::job::{Job, bare};
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse, write_full};
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Background, Ids, Outside, PhantomSource};
use drypoint::scene::volume::write::write_nrrd;
use drypoint::scene::volume::{Volume, VoxelType, Voxels, read};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The picture of a volume that is all that is given.
fn picture_of(path: &Path, volume: Volume) -> (Measures, Ids) {
    let mut scene = bare(path.to_owned(), &volume, [160, 160], &mut Counts::default()).unwrap();
    scene.picture.background = Background::None;
    let ids = scene.volume.ids;
    let job = Job::with_volume(scene, volume).unwrap();
    (measure(&job.renderer().unwrap().frame(&|_| ()).0), ids)
}

/// What is wrong with a picture.
fn faults(m: &Measures) -> Vec<String> {
    let mut faults = Vec::new();
    let mut demand = |holds: bool, what: String| faults.extend((!holds).then_some(what));
    demand(m.finite, "a pixel is not finite".into());
    demand((0.60..=0.95).contains(&m.filled), format!("content fills {:.2} of the shorter side", m.filled));
    demand((0.05..=0.90).contains(&m.covered), format!("{:.3} of the pixels are covered", m.covered));
    demand(m.lightness >= 40.0, format!("L* spans {:.1}", m.lightness));
    demand(m.clipped <= 0.2, format!("a channel is clipped in {:.2}", m.clipped));
    faults
}

/// Every volume of a folder, by name.
fn volumes(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<PathBuf> = entries.filter(|path| read::is_volume(path)).collect();
    paths.sort();
    paths
}

#[test]
fn every_shared_volume_gives_a_good_picture() {
    let Some(folder) = data() else {
        println!("skipped: no data");
        return;
    };
    let start = Instant::now();
    let mut wrong = Vec::new();
    let mut seen = 0;
    for path in volumes(&folder) {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let Ok(volume) = read::read(&path, None) else { continue };
        let (m, ids) = picture_of(&path, volume);
        println!("{name}: {m:?}");
        wrong.extend(faults(&m).into_iter().map(|fault| format!("{name}: {fault}")));
        if (ids == Ids::Mask) != name.contains("_label") {
            wrong.push(format!("{name}: taken for {ids:?}"));
        }
        seen += 1;
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(seen >= 26, "{seen} volumes");
    // Half a minute on two cores; more is a sign that something has become slow.
    assert!(start.elapsed() < Duration::from_secs(600), "{:?}", start.elapsed());
}

fn phantom(name: &str) -> Volume {
    let source = PhantomSource {
        name: name.into(),
        size: [48; 3],
        spacing: [1.0; 3],
        voxel_type: VoxelType::U8,
        params: Vec::new(),
    };
    drypoint::scene::phantom::generate(&source).unwrap()
}

#[test]
fn every_phantom_gives_a_good_picture() {
    let mut wrong = Vec::new();
    for name in drypoint::scene::phantom::names() {
        let (m, ids) = picture_of(Path::new("phantom.nrrd"), phantom(name));
        // A half-space and a constant are boxes: a lit sphere shows a plane in one tone.
        let flat = ["plane", "constant"].contains(&name);
        let of_interest = faults(&m).into_iter().filter(|fault| !(flat && fault.starts_with("L*")));
        wrong.extend(of_interest.map(|fault| format!("{name}: {fault}")));
        // Six constant values that jump at their borders are what a volume of labels is.
        if (ids == Ids::Mask) != (name == "shepp-logan") {
            wrong.push(format!("{name}: taken for {ids:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_scene_of_a_label_volume_is_a_scene_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("labels.nrrd");
    write_nrrd(&phantom("shepp-logan"), &path).unwrap();
    let volume = read::read(&path, None).unwrap();
    let suggested = bare(path, &volume, [24, 24], &mut Counts::default()).unwrap();
    assert_eq!(suggested.volume.ids, Ids::Mask);
    let full = write_full(&suggested);
    let again = parse(&full, &folder.path().join("labels.toml"), &Overrides::default()).unwrap();
    assert_eq!(again, suggested, "{full}");
    let picture = |job: Job| job.renderer().unwrap().frame(&|_| ()).0;
    let (given, loaded) = (Job::with_volume(suggested, volume).unwrap(), Job::load(again).unwrap());
    assert_eq!(loaded.volume.range(), [0.0, 1.0]);
    assert_eq!(picture(given), picture(loaded));
}

/// 48³ voxels of about 200 where `inside` holds, in 10: ids of labels would not ripple.
fn solid(inside: impl Fn([f64; 3]) -> bool) -> Volume {
    let value = |i: usize| if inside([i % 48, i / 48 % 48, i / 2304].map(|i| i as f64)) { 200 } else { 10 };
    let voxels = Voxels::U8((0..48 * 48 * 48).map(|i| value(i) + (i * 7919 % 6) as u8).collect());
    Volume::new(Grid::with_spacing([48; 3], [1.0; 3]).unwrap(), voxels, 1.0, 0.0).unwrap()
}

#[test]
fn a_head_is_shown_without_its_rest_and_vessels_with_all_their_pieces() {
    // A ball, with a slab beside it that has a hundredth of its voxels, and a speck.
    let ball = |[x, y, z]: [f64; 3]| (x - 23.0).powi(2) + (y - 20.0).powi(2) + (z - 24.0).powi(2) < 196.0;
    let slab = |[x, y, z]: [f64; 3]| (18.0..28.0).contains(&x) && y == 42.0 && (20.0..31.0).contains(&z);
    let head = solid(|p| ball(p) || slab(p) || p == [2.0; 3]);
    let suggested = bare("head.nrrd".into(), &head, [24, 24], &mut Counts::default()).unwrap();
    // The scene says so, in a table that can be changed.
    let full = write_full(&suggested);
    assert!(full.contains("[volume.parts]") || full.contains("parts = {"), "{full}");
    assert_eq!(parse(&full, Path::new("head.toml"), &Overrides::default()).unwrap(), suggested);
    let job = Job::with_volume(suggested, head).unwrap();
    assert_eq!((job.counts.parts, job.counts.parts_kept, &job.counts.part_sizes[1..]), (3, 1, &[110, 1][..]));
    assert_eq!([[20, 42, 25], [2, 2, 2]].map(|p| job.volume.value(p)), [10.0; 2]);
    assert!(job.volume.value([23, 20, 24]) >= 200.0);

    // One vessel, and 60 pieces of others, each a hundredth of it.
    let piece = |[x, y, z]: [f64; 3]| x % 8.0 < 3.0 && y % 8.0 == 2.0 && z % 24.0 == 2.0 && x > 8.0;
    let vessels = solid(|p| piece(p) || (p[1] - 24.0).abs() < 2.0 && (p[2] - 24.0).abs() < 2.0);
    for content in [vessels, phantom("tube-tree")] {
        assert_eq!(bare("vessels.nrrd".into(), &content, [24, 24], &mut Counts::default()).unwrap().volume.parts, None);
    }
}

#[test]
fn the_camera_frames_what_is_shown_in_pictures_of_any_shape() {
    for size in [[90, 60], [60, 90]] {
        let volume = phantom("torus");
        let mut scene = bare("torus.nrrd".into(), &volume, size, &mut Counts::default()).unwrap();
        scene.picture.background = Background::None;
        let job = Job::with_volume(scene, volume).unwrap();
        let filled = measure(&job.renderer().unwrap().frame(&|_| ()).0).filled;
        assert!((0.75..=0.95).contains(&filled), "{size:?}: {filled}");
    }
}

/// A volume of a function of the voxel and of its distance from the middle, in voxels of the first axis.
fn field(dims: [usize; 3], spacing: [f64; 3], voxel_type: VoxelType, value: impl Fn(f64) -> f64) -> Volume {
    let grid = Grid::with_spacing(dims, spacing).unwrap();
    let square = |i: usize, a: usize| ((i as f64 - (dims[a] - 1) as f64 / 2.0) * spacing[a] / spacing[0]).powi(2);
    let radius = |i: usize| {
        let [nx, ny, _] = dims;
        (square(i % nx, 0) + square(i / nx % ny, 1) + square(i / (nx * ny), 2)).sqrt()
    };
    let values: Vec<f64> = (0..grid.len()).map(|i| value(radius(i))).collect();
    Volume::new(grid, Voxels::from_f64(&values, voxel_type), 1.0, 0.0).unwrap()
}

fn edge(d: f64) -> f64 {
    1.0 / (1.0 + (-d).exp())
}

#[test]
fn small_and_steep_content_is_framed_with_what_lies_between_voxels() {
    let cube = [40; 3];
    let mut volumes: Vec<(String, Volume)> = Vec::new();
    for r in [1.5, 2.0, 2.5, 3.0, 3.5, 4.0] {
        let ball = field(cube, [1.0; 3], VoxelType::U8, |d| 250.0 * edge((r - d) / 0.5));
        volumes.push((format!("ball of radius {r}"), ball));
        let thick = field([40, 40, 15], [1.0, 1.0, 4.0], VoxelType::U8, |d| 250.0 * edge((2.0 * r - d) / 0.7));
        volumes.push((format!("ball of radius {r} in slices"), thick));
    }
    let steep = field(cube, [1.0; 3], VoxelType::F32, |d| 1.0 / (0.5 + d * d));
    volumes.push(("1/(½ + r²)".into(), steep));
    let steeper = field(cube, [1.0; 3], VoxelType::F32, |d| 1e6 * (20.0 - 1.2 * d).exp());
    volumes.push(("10⁶ exp(20 − 1.2 r)".into(), steeper));
    let one = field([41; 3], [1.0; 3], VoxelType::U8, |d| if d < 0.9 { 200.0 } else { 0.0 });
    assert_eq!(one.range(), [0.0, 200.0]);
    volumes.push(("one voxel".into(), one));
    let grid = Grid::with_spacing([2; 3], [1.0; 3]).unwrap();
    let corner = (0..8).map(|i| 100 * (i % 2 + i / 2 % 2 + i / 4)).collect();
    volumes.push(("a corner".into(), Volume::new(grid, Voxels::I16(corner), 1.0, 0.0).unwrap()));
    let mut wrong = Vec::new();
    for (name, volume) in volumes {
        let (m, _) = picture_of(Path::new("small.nrrd"), volume);
        println!("{name}: {m:?}");
        // The plane that cuts off a corner has one tone.
        let flat = |fault: &String| name == "a corner" && fault.starts_with("L*");
        // The smoothing kernel of thick slices widens a ball of four slices by a quarter of a slice on each side.
        let widened =
            |fault: &String| name.ends_with("slices") && m.filled < 0.98 && fault.starts_with("content fills");
        wrong
            .extend(faults(&m).into_iter().filter(|f| !flat(f) && !widened(f)).map(|fault| format!("{name}: {fault}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn dark_content_is_drawn_as_its_mirror_image() {
    let noise = |d: f64| ((d * 1e6) as i64 % 7 - 3) as f64;
    type OfRadius<'a> = &'a dyn Fn(f64) -> f64;
    let fields: [(&str, VoxelType, OfRadius); 4] = [
        ("ball", VoxelType::I16, &|d| 100.0 * edge((13.0 - d) / 0.8)),
        ("hole", VoxelType::U8, &|d| 200.0 * edge((13.0 - d) / 0.8)),
        ("distances", VoxelType::F64, &|d| 13.0 - d),
        ("noisy ball", VoxelType::U8, &|d| 30.0 + 150.0 * edge((13.0 - d) / 0.7) + noise(d)),
    ];
    for (name, voxel_type, value) in fields {
        let mirror = if voxel_type == VoxelType::U8 { 250.0 } else { 0.0 };
        let [bright, dark] = [false, true].map(|dark| {
            let volume = field([40; 3], [1.0; 3], voxel_type, |d| if dark { mirror - value(d) } else { value(d) });
            let outside = bare("a.nrrd".into(), &volume, [8; 2], &mut Counts::default()).unwrap().volume.outside;
            assert_eq!(outside, if dark { Outside::High } else { Outside::Low }, "{name}");
            picture_of(Path::new("ball.nrrd"), volume).0
        });
        println!("{name}: {bright:?} {dark:?}");
        assert!(faults(&dark).is_empty(), "{name}: {:?}", faults(&dark));
        // A level where a value lies on the border of two bins.
        assert!((bright.covered - dark.covered).abs() < 0.02, "{name}: {bright:?} {dark:?}");
    }
}
