//! The label volume of a scene and the names of its labels ([STF-13]).

use crate::Failure;
use drypoint_reference::labels::Labels;
use drypoint_scene::source::Source;
use drypoint_scene::space::Grid;
use drypoint_scene::tables::VolumeTable;
use drypoint_scene::volume::labels::{LabelError, LabelNames, LabelVolume};
use drypoint_scene::volume::{Anatomy, KeptVoxels, Volume, read};
use std::path::Path;

/// Label volume and names of labels.
#[derive(Clone, Debug, Default)]
pub struct SceneLabels {
    /// The label volume, if the scene has one.
    pub volume: Option<LabelVolume>,
    /// The names; empty if the scene has no table of them.
    pub names: LabelNames,
}

impl SceneLabels {
    /// Loads the labels of a scene's `[volume]`, whose data are given. Labels on the grid of the data's file are read
    /// where the data are ([VOL-1]); those on another grid are read whole. Errors go to `failures`. Call this only if
    /// an effect reads labels ([PLAN-1]).
    pub fn load(source: &dyn Source, table: &VolumeTable, data: &Volume, failures: &mut Vec<Failure>) -> Self {
        let mut wrong = |failure| failures.push(failure);
        let volume = table.labels.as_ref().and_then(|path| volume(source, path, table, data).map_err(&mut wrong).ok());
        let names = table.label_names.as_ref().and_then(|path| names(source, path).map_err(&mut wrong).ok());
        Self { volume, names: names.unwrap_or_default() }
    }

    /// Returns a warning if the labels do not overlap the data.
    pub fn warning(&self, table: &VolumeTable, data: &Volume) -> Option<String> {
        let labels = Labels::new(self.volume.as_ref()?, data.grid(), data.anatomy(), table.label_lookup);
        let cells = data.dims().map(|n| n.max(2) - 1);
        let none = labels.ids_in([0; 3], cells) == [0];
        none.then(|| "volume.labels has no label where the data lie: every sample has label 0".into())
    }
}

fn volume(source: &dyn Source, path: &Path, table: &VolumeTable, data: &Volume) -> Result<LabelVolume, Failure> {
    let beside_data = |grid: &Grid, anatomy| {
        let kept = table.subset.of(grid.dims()).ok()?;
        let grid = kept.grid(&Anatomy::between(grid, anatomy, data.anatomy())).ok()?;
        grid.coincides(data.grid()).then_some(kept)
    };
    let choose = |grid: &Grid, anatomy| Ok(beside_data(grid, anatomy).unwrap_or(KeptVoxels::all(grid.dims())));
    LabelVolume::new(&read::read_part(source, path, None, &choose)?).map_err(|error| {
        let LabelError::NotAnId { voxel: [x, y, z], .. } = error;
        let place = format!("{}, voxel ({x}, {y}, {z})", path.display());
        Failure::new(error, place, "name a volume of labels, not a scan, with volume.labels")
    })
}

fn names(source: &dyn Source, path: &Path) -> Result<LabelNames, Failure> {
    LabelNames::read(source, path).map_err(|error| Failure::new(error.what(), error.place(), error.remedy()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::{DMat3, DVec3};
    use drypoint_scene::source::Disk;
    use drypoint_scene::tables::VolumeSource;
    use drypoint_scene::volume::Voxels;
    use drypoint_scene::volume::write::write_nrrd;

    fn row(from: f64, voxels: Voxels) -> Volume {
        let grid = Grid::new([3, 1, 1], DMat3::IDENTITY, DVec3::X * from).unwrap();
        Volume::new(grid, voxels, 1.0, 0.0).unwrap()
    }

    #[test]
    fn what_is_wrong_with_both_files_is_told_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let [labels, names] = ["parts.nrrd", "parts.csv"].map(|name| folder.path().join(name));
        let mut table = VolumeTable::new(VolumeSource::File { path: "a.nrrd".into(), raw: None });
        (table.labels, table.label_names) = (Some(labels.clone()), Some(names.clone()));
        let load = || {
            let mut failures = Vec::new();
            let named = SceneLabels::load(&Disk, &table, &row(0.0, Voxels::U8(vec![0; 3])), &mut failures);
            (named, failures)
        };
        write_nrrd(&row(0.0, Voxels::F32(vec![0.0, 2.0, 2.5])), &labels).unwrap();
        std::fs::write(&names, "id,name\n1\n").unwrap();
        let (_, failures) = load();
        let said: Vec<String> = failures.iter().map(Failure::to_string).collect();
        let voxel = "error: 2.5 is not a label: an id is a whole number from 0 to 4294967295\n";
        assert!(said[0].starts_with(voxel) && said[0].contains("parts.nrrd, voxel (2, 0, 0)\n"), "{said:?}");
        let line = "error: label 1 has no name\n";
        assert!(said.len() == 2 && said[1].starts_with(line) && said[1].contains("parts.csv, line 2\n"), "{said:?}");

        write_nrrd(&row(0.0, Voxels::U8(vec![0, 2, 2])), &labels).unwrap();
        std::fs::write(&names, "id,name\n2,liver\n").unwrap();
        let (named, failures) = load();
        assert!(failures.is_empty());
        assert_eq!((named.names.id("liver"), named.volume.as_ref().map(|v| v.id(1))), (Some(2), Some(2)));
        assert_eq!(named.warning(&table, &row(0.0, Voxels::U8(vec![0; 3]))), None);
        let apart = "volume.labels has no label where the data lie: every sample has label 0";
        assert_eq!(named.warning(&table, &row(9.0, Voxels::U8(vec![0; 3]))).as_deref(), Some(apart));
    }
}
