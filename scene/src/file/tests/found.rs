//! Files of data are looked for in folders, whichever key names them ([SCN-2]).

use super::super::find;
use super::*;

/// A scene over data that lie in another folder, each file named by its key.
const TEXT: &str = "drypoint = 1
[volume]
file = \"v.nrrd\"
labels = \"l.nrrd\"
label_names = \"l.csv\"
[transfer]
over = [\"value\", { volume = \"t.nrrd\" }]
rows = [{ at = 1, nodes = [{ at = 1, style = \"wax\" }] }]
[[object]]
volume = \"ov.nrrd\"
labels = \"ol.nrrd\"
label_names = \"ol.csv\"
[object.transfer]
over = [\"value\", { volume = \"ot.nrrd\" }]
rows = [{ at = 1, nodes = [{ at = 1, style = \"wax\" }] }]
[object.ghost.transfer]
over = [{ volume = \"gt.nrrd\" }, \"value\"]
rows = [{ at = 1, nodes = [{ at = 1, style = \"wax\" }] }]
[[object]]
selection = \"os.nrrd\"
[[mesh]]
file = \"m.ply\"
";

/// Keys and files of [`TEXT`].
const FILES: [(&str, &str); 11] = [
    ("volume.file", "v.nrrd"),
    ("volume.labels", "l.nrrd"),
    ("volume.label_names", "l.csv"),
    ("transfer.over[1].volume", "t.nrrd"),
    ("object[0].volume", "ov.nrrd"),
    ("object[0].labels", "ol.nrrd"),
    ("object[0].label_names", "ol.csv"),
    ("object[0].transfer.over[1].volume", "ot.nrrd"),
    ("object[0].ghost.transfer.over[0].volume", "gt.nrrd"),
    ("object[1].selection", "os.nrrd"),
    ("mesh[0].file", "m.ply"),
];

/// The scene and its faults after its files were looked for in a folder.
fn looked_for(folder: &Path) -> (Scene, Vec<Fault>) {
    let mut check = Check::new(Path::new("elsewhere/scene.toml"));
    let mut scene = read(TEXT, None, &Overrides::default(), &mut check).unwrap();
    find::files(&mut scene, &mut check, &[folder.to_owned()]);
    (scene, check.done().1)
}

#[test]
fn data_of_objects_are_looked_for_like_those_of_the_volume() {
    let folder = tempfile::tempdir().unwrap();
    let (_, faults) = looked_for(folder.path());
    assert_eq!(faults.len(), FILES.len());
    for (key, file) in FILES {
        let fault = faults.iter().find(|fault| fault.key == key).unwrap_or_else(|| panic!("{key}"));
        assert_eq!(fault.what(), format!("elsewhere/{file} is not there"));
        assert!(fault.position().ends_with(&format!("key {key}")), "{fault}");
        assert_eq!(fault.remedy(), format!("write another path; nor is it in {}", folder.path().display()));
    }
    for (_, file) in FILES {
        std::fs::write(folder.path().join(file), "").unwrap();
    }
    let (scene, faults) = looked_for(folder.path());
    assert_eq!(faults, []);
    let mut found = scene.files();
    found.retain(|path| path.starts_with(folder.path()));
    assert_eq!(found.len(), FILES.len());
}
