//! Region growing and watershed on scans with labels: the overlap with the label ([VS-6]).

use crate::data;
use drypoint::reference::volumeshop::painting::{Growth, PaintError, Painted, Painter, Seed};
use drypoint::scene::glam::DVec3;
use drypoint::scene::tables::{Connectivity, PaintMode};
use drypoint::scene::volume::{Selection, Volume, read};

/// A scan, and its label volume on the same grid.
struct Scan {
    volume: Volume,
    labels: Volume,
}

impl Scan {
    fn new(volume: &str, labels: &str) -> Option<Self> {
        let folder = data()?;
        let read = |name: &str| read::read(&folder.join(name), None).unwrap_or_else(|e| panic!("{e}"));
        Some(Self { volume: read(volume), labels: read(labels) })
    }

    /// The Dice coefficient 2|A ∩ B|/(|A| + |B|) of a label and what is painted on the values of a range.
    fn dice(
        &self,
        label: u32,
        [lo, hi]: [f64; 2],
        paint: impl Fn(&Painter<'_>, &mut Selection) -> Result<Painted, PaintError>,
    ) -> f64 {
        let is_shown = |value: f64| (lo..=hi).contains(&value);
        let mut selection = Selection::nothing(&self.volume);
        paint(&Painter::new(&self.volume, &is_shown), &mut selection).unwrap();
        let [nx, ny, nz] = self.volume.dims();
        let (mut both, mut sum) = (0, 0);
        for i in 0..nx * ny * nz {
            let voxel = [i % nx, i / nx % ny, i / nx / ny];
            let (a, b) = (selection.memberships.value(voxel) > 0.5, self.labels.value(voxel) == f64::from(label));
            both += usize::from(a && b);
            sum += usize::from(a) + usize::from(b);
        }
        2.0 * both as f64 / sum as f64
    }

    /// The overlap of a region that grows from a voxel.
    fn grown(&self, label: u32, shown: [f64; 2], seed: [f64; 3], tolerance: f64) -> f64 {
        let at = self.volume.grid().to_world(DVec3::from_array(seed));
        let growth = Growth { at, tolerance, connect: Connectivity::Faces, mode: PaintMode::Add };
        self.dice(label, shown, |painter, selection| painter.grow(selection, &growth))
    }

    /// The overlap of the first of two basins.
    fn flooded(&self, label: u32, shown: [f64; 2], seeds: [[f64; 3]; 2]) -> f64 {
        let seed = |at: [f64; 3], mode| Seed { at: self.volume.grid().to_world(DVec3::from_array(at)), mode };
        let seeds = [seed(seeds[0], PaintMode::Add), seed(seeds[1], PaintMode::Subtract)];
        self.dice(label, shown, |painter, selection| painter.watershed(selection, &seeds))
    }
}

/// An overlap that is at least so large.
fn told(what: &str, dice: f64, least: f64) {
    println!("{what}: Dice {dice:.3}");
    assert!(dice >= least, "{what}: {dice}");
}

#[test]
fn organs_of_an_abdomen() {
    let Some(scan) = Scan::new("abdomen_ct.nii.gz", "abdomen_ct_labels.nii.gz") else {
        println!("skipped: no data");
        return;
    };
    // Voxels deep in organs.
    let [right, left, spleen] = [[86.0, 43.0, 74.0], [31.0, 33.0, 90.0], [29.0, 35.0, 104.0]];
    let [liver, bowel] = [[86.0, 47.0, 111.0], [41.0, 65.0, 41.0]];
    let soft = [-20.0, 200.0];
    told("abdomen_ct, region from the right kidney, 10 HU", scan.grown(2, soft, right, 10.0), 0.5);
    told("abdomen_ct, region from the liver, 15 HU", scan.grown(5, soft, liver, 15.0), 0.6);
    told("abdomen_ct, basins of the left kidney and the bowel", scan.flooded(3, soft, [left, bowel]), 0.9);
    told("abdomen_ct, basins of the spleen and the bowel", scan.flooded(1, soft, [spleen, bowel]), 0.75);
}

/// The aorta touches heart, vessels and bones of the same values, and parts of it have other values: a region has all of
/// them or a part of it.
#[test]
fn an_aorta() {
    let Some(scan) = Scan::new("aorta_cta.nii.gz", "aorta_cta_label.nii.gz") else {
        println!("skipped: no data");
        return;
    };
    let filled = [200.0, 650.0];
    let (above, below) = ([51.0, 46.0, 100.0], [69.0, 103.0, 80.0]);
    told("aorta_cta, region from above, 450 HU", scan.grown(1, filled, above, 450.0), 0.3);
    told("aorta_cta, region from below, 120 HU", scan.grown(1, filled, below, 120.0), 0.3);
    told("aorta_cta, basins of the aorta and a vessel", scan.flooded(1, filled, [below, [80.0, 60.0, 60.0]]), 0.3);
    told("aorta_cta, basins of the aorta and its arch", scan.flooded(1, filled, [above, [62.0, 86.0, 137.0]]), 0.3);
}
