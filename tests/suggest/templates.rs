//! The templates that come with the program: made for one volume, and drawn for others.

use crate::data;
use crate::measure::measure;
use drypoint::job::Job;
use drypoint::scene::file::load_for;
use drypoint::scene::tables::Unit;
use std::path::Path;

/// A head of 512 values in voxels of 0.9 mm, and a mean of heads of 256 values in voxels of 2 mm.
#[test]
fn a_template_for_one_head_works_on_another() {
    let Some(data) = data() else {
        println!("skipped: no data");
        return;
    };
    let template = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/templates/head.toml");
    let small = [("picture.size", "[64, 64]"), ("picture.background", "none")].into_iter().collect();
    let mut skins = Vec::new();
    for head in ["mri_head.nii.gz", "avg152T1_RL_bigendian.nii.gz"] {
        let scene = load_for(&template, &data.join(head), &small).unwrap_or_else(|faults| panic!("{faults}"));
        assert_eq!(scene.transfer.as_ref().unwrap().unit, Unit::Percentile);
        let job = Job::load(scene).unwrap_or_else(|failure| panic!("{head}: {failure}"));
        assert_eq!(job.plan.idle_keys, [], "{head}: keys without effect");
        skins.push(job.node_values().remove(0).values);
        let picture = job.renderer().unwrap().frame(&|_| ()).0;
        let m = measure(&picture);
        // Skin alone: a box full of noise would cover half of the picture, an empty one nothing.
        assert!(m.finite && (0.12..=0.40).contains(&m.covered), "{head}: {m:?}");
    }
    // The same percentiles are values that are far from each other.
    assert!(skins[0].iter().zip(&skins[1]).all(|(a, b)| a[0] == b[0] && (a[1] - b[1]).abs() > 10.0), "{skins:?}");
}
