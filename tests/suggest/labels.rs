//! Labels of a real scan, on its own grid and on others ([STF-13], [SPACE-2]).

use crate::data;
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, load};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::picture::{LayerKind, Picture};
use drypoint::scene::space::Grid;
use drypoint::scene::volume::{Anatomy, Volume, Voxels, read, write};
use std::path::Path;

/// Figure 9, small, with other labels.
fn picture(labels: Option<&Path>, lookup: &str) -> Picture {
    let mut settings: Overrides = [("picture.size", "[64, 64]"), ("picture.samples", "1")].into_iter().collect();
    settings.push("volume.label_lookup", format!("{lookup:?}"));
    if let Some(path) = labels {
        settings.push("volume.labels", format!("{:?}", path.to_str().unwrap()));
    }
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/scenes/style_transfer_functions/figure_9.toml");
    let scene = load(&scene, &settings).unwrap_or_else(|faults| panic!("{faults}"));
    let job = Job::load(scene).unwrap_or_else(|failure| panic!("{failure}"));
    assert_eq!(job.plan.warnings, [""; 0]);
    job.renderer().unwrap().frame(&|_| ()).0
}

fn pixels(picture: &Picture) -> &[Vec<f64>] {
    &picture.layer(LayerKind::Beauty).unwrap().channels
}

/// The labels' box alone, its axes in another order, one of them backwards, in LPS where the scan is in RAS.
fn turned(labels: &Volume) -> Volume {
    assert_eq!(labels.anatomy(), Some(Anatomy::RightAnteriorSuperior));
    let [nx, ny, nz] = labels.dims();
    let all = || (0..nx * ny * nz).map(|i| [i % nx, i / nx % ny, i / nx / ny]);
    // One voxel more to each side, where there is one: between it and the first with an id lies a border.
    let taken = all().filter(|&p| labels.value(p) > 0.0).fold([[usize::MAX; 3], [0; 3]], |[lo, hi], p| {
        [std::array::from_fn(|a| lo[a].min(p[a])), std::array::from_fn(|a| hi[a].max(p[a]))]
    });
    let lo = taken[0].map(|x| x.saturating_sub(1));
    let hi: [usize; 3] = std::array::from_fn(|a| (taken[1][a] + 1).min(labels.dims()[a] - 1));
    // x, y, z of the new grid run along z, −x, y of the old one.
    let old = |[x, y, z]: [usize; 3]| [hi[0] - y, lo[1] + z, lo[2] + x];
    let dims = [hi[2] - lo[2] + 1, hi[0] - lo[0] + 1, hi[1] - lo[1] + 1];
    let grid = labels.grid();
    let axes = grid.axes();
    let axes = DMat3::from_cols(axes.z_axis, -axes.x_axis, axes.y_axis);
    let origin = grid.to_world(DVec3::from_array(old([0; 3]).map(|i| i as f64)));
    let flip = DVec3::new(-1.0, -1.0, 1.0);
    let lies = Grid::new(dims, DMat3::from_diagonal(flip) * axes, flip * origin).unwrap();
    let ids = (0..lies.len()).map(|i| labels.value(old([i % dims[0], i / dims[0] % dims[1], i / dims[0] / dims[1]])));
    let turned = Volume::new(lies, Voxels::U16(ids.map(|id| id as u16).collect()), 1.0, 0.0).unwrap();
    turned.with_anatomy(Some(Anatomy::LeftPosteriorSuperior))
}

/// On a grid with voxels of half the size, each with the id of the nearest of `labels`.
fn finer(labels: &Volume) -> Volume {
    let dims = labels.dims().map(|n| 2 * n - 1);
    let lies = Grid::new(dims, labels.grid().axes() * 0.5, labels.grid().origin()).unwrap();
    let ids = (0..lies.len()).map(|i| {
        let p = [i % dims[0], i / dims[0] % dims[1], i / dims[0] / dims[1]];
        labels.value(p.map(|x| x / 2))
    });
    Volume::new(lies, Voxels::U8(ids.map(|id| id as u8).collect()), 1.0, 0.0).unwrap().with_anatomy(labels.anatomy())
}

#[test]
fn labels_on_another_grid_give_the_same_picture() {
    let Some(folder) = data() else {
        println!("skipped: no data");
        return;
    };
    let labels = read::read(&folder.join("abdomen_ct_labels.nii.gz"), None).unwrap();
    let temporary = tempfile::tempdir().unwrap();
    let [elsewhere, fine] = ["turned.nrrd", "finer.nrrd"].map(|name| temporary.path().join(name));
    write::write_nrrd(&turned(&labels), &elsewhere).unwrap();
    write::write_nrrd(&finer(&labels), &fine).unwrap();
    for lookup in ["nearest", "smooth"] {
        let own = picture(None, lookup);
        // The same voxels at the same places: only a sum of weights that is even to the last bit may fall otherwise, and
        // here none does.
        assert!(pixels(&picture(Some(&elsewhere), lookup)) == pixels(&own), "{lookup}");
        // Resampled, borders lie up to a quarter of a voxel elsewhere. Most of the picture stays.
        let fine = picture(Some(&fine), lookup);
        let (a, b) = (pixels(&own), pixels(&fine));
        let moved = (0..64 * 64).filter(|&i| (0..4).any(|c| (a[c][i] - b[c][i]).abs() > 0.1)).count();
        assert!(moved > 0 && moved < 64 * 64 / 4, "{lookup}: {moved}");
    }
    let [nearest, smooth] = ["nearest", "smooth"].map(|lookup| picture(None, lookup));
    assert!(pixels(&nearest) != pixels(&smooth));
}
