//! A box and a stride give the picture of a file with just those voxels ([VOL-1]), and labels follow.

use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::picture::Picture;
use drypoint::scene::space::Grid;
use drypoint::scene::volume::write::write_nrrd;
use drypoint::scene::volume::{Volume, Voxels};
use std::path::Path;

/// A volume on a sheared grid whose numbers are short in decimals.
fn volume(dims: [usize; 3], axes: DMat3, origin: DVec3, voxels: &dyn Fn(usize) -> Voxels) -> Volume {
    Volume::new(Grid::new(dims, axes, origin).unwrap(), voxels(dims.iter().product()), 1.0, 0.0).unwrap()
}

fn picture(folder: &Path, data: &str, labels: &str, more: &str) -> Picture {
    let text = format!(
        "drypoint = 1\n[volume]\nfile = \"{data}\"\nlabels = \"{labels}\"\n{more}\n[camera]\neye = [40, -30, 25]\n\
         target = [9, 8, 7]\n[picture]\nsize = [40, 36]\nsamples = 1\nlayers = [\"beauty\", \"Z\", \"normal\"]\n\
         [sampling]\nkernel = \"bspline\"\n[transfer]\nkind = \"regular\"\nunit = \"normalized\"\nover = [\"value\", \
         \"label\"]\nrows = [{{ at = 0, nodes = [{{ at = 0.3, color = \"red\", opacity = 0 }}, {{ at = 0.8, color = \
         \"white\", opacity = 0.4 }}] }}, {{ at = 1, nodes = [{{ at = 0.4, color = \"blue\", opacity = 0.1 }}] }}]\n\
         [shading]\n"
    );
    let scene = parse(&text, &folder.join("scene.toml"), &Overrides::default()).unwrap();
    Job::load(scene).unwrap().renderer().unwrap().frame(&|_| ()).0
}

#[test]
fn a_part_of_a_file_is_a_file_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let dims = [17, 14, 12];
    let axes = DMat3::from_cols(DVec3::new(1.0, 0.25, 0.0), DVec3::new(0.0, 1.5, 0.0), DVec3::new(0.5, 0.0, 2.0));
    let origin = DVec3::new(-2.0, 1.0, 0.5);
    let value = |i: usize| match i * 7919 % 1009 {
        n if n < 3 => f32::NAN,
        n => (i % 17) as f32 * 3.0 + (n % 40) as f32,
    };
    let label = |i: usize| (i / 5 % 3) as u8;
    let write = |name: &str, volume: &Volume| write_nrrd(volume, &folder.path().join(name)).unwrap();
    write("whole.nrrd", &volume(dims, axes, origin, &|n| Voxels::F32((0..n).map(value).collect())));
    write("labels.nrrd", &volume(dims, axes, origin, &|n| Voxels::U8((0..n).map(label).collect())));
    let elsewhere = volume([7, 6, 5], 3.0 * DMat3::IDENTITY, origin, &|n| Voxels::U8((0..n).map(label).collect()));
    write("elsewhere.nrrd", &elsewhere);
    // The kept voxels, one by one.
    let (first, last, stride) = ([2, 1, 0], [15, 12, 10], [2, 1, 3]);
    let kept = [0, 1, 2].map(|a| (first[a]..=last[a]).step_by(stride[a]).collect::<Vec<_>>());
    let mut all = Vec::new();
    for z in &kept[2] {
        for y in &kept[1] {
            all.extend(kept[0].iter().map(|x| (z * dims[1] + y) * dims[0] + x));
        }
    }
    let at = axes * DVec3::from(first.map(|n| n as f64)) + origin;
    let [a, b, c] = [axes.x_axis * 2.0, axes.y_axis, axes.z_axis * 3.0];
    let (dims, axes) = ([kept[0].len(), kept[1].len(), kept[2].len()], DMat3::from_cols(a, b, c));
    write("own.nrrd", &volume(dims, axes, at, &|_| Voxels::F32(all.iter().map(|&i| value(i)).collect())));
    write("own_labels.nrrd", &volume(dims, axes, at, &|_| Voxels::U8(all.iter().map(|&i| label(i)).collect())));

    let part = "box = [[2, 15], [1, 12], [0, 10]]\nstride = [2, 1, 3]";
    for (labels, own) in [("labels.nrrd", "own_labels.nrrd"), ("elsewhere.nrrd", "elsewhere.nrrd")] {
        let [of_part, of_own] =
            [picture(folder.path(), "whole.nrrd", labels, part), picture(folder.path(), "own.nrrd", own, "")];
        assert_eq!(of_part, of_own, "{labels}");
    }
    // The whole is another picture, and so is another stride.
    let whole = picture(folder.path(), "whole.nrrd", "labels.nrrd", "");
    assert_ne!(whole, picture(folder.path(), "whole.nrrd", "labels.nrrd", part));
    assert_eq!(whole, picture(folder.path(), "whole.nrrd", "labels.nrrd", "stride = 1"));
}
