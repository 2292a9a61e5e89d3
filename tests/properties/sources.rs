//! Scenes whose files are in memory ([`Source`]).

use drypoint::drawing::Drawing;
use drypoint::job::{Job, RenderTarget};
use drypoint::marking::Marking;
use drypoint::output::png::encode_png;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::picture::{Layer, LayerKind, Picture, Provenance};
use drypoint::scene::source::{Disk, Source};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

/// A scene that names a file of every kind.
const SCENE: &str = r#"
drypoint = 1
[volume]
file = "ball.nhdr"
labels = "labels.nrrd"
label_names = "names.csv"
[picture]
width = "20 mm"
height = "15 mm"
dpi = 40
background = "behind.png"
[styles]
theme = "theme"
own = "own.png"
[transfer]
over = ["value", "label"]
rows = [
  { at = ["near"], nodes = [{ at = 40, style = "own", opacity = 0 }, { at = 90, style = "own", opacity = 1 }] },
  { at = ["far"], nodes = [{ at = 40, style = "wax", opacity = 0 }, { at = 90, style = "wax", opacity = 1 }] },
]
[[mesh]]
file = "part.ply"
[stipples]
pen = "black"
k_max = 0.1
[[pen]]
name = "black"
width = "0.3 mm"
tone = "tone.csv"
[[object]]
name = "part"
selection = "selection.nrrd"
move = [2, 0, 0]
[object.transfer]
kind = "regular"
over = ["value", { volume = "second.nrrd" }]
rows = [{ at = 0, nodes = [{ at = 40, color = "red", opacity = 0 }, { at = 90, color = "red", opacity = 1 }] }]
[object.shading]
model = "lighting-function"
table = "light.png"
[[intersection]]
object = "part"
color = "met.png"
"#;

/// A PNG of one colour.
fn png(color: [f64; 4]) -> Vec<u8> {
    let layer = Layer { kind: LayerKind::Beauty, channels: color.map(|c| vec![c; 4]).to_vec() };
    encode_png(&Picture { width: 2, height: 2, layers: vec![layer] }, 8, &Provenance::default()).unwrap()
}

fn nrrd(voxels: &[u8], data_file: &str) -> Vec<u8> {
    let head = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 8 8 8\nspacings: 1 1 1\nencoding: raw\n";
    [format!("{head}{data_file}\n").as_bytes(), voxels].concat()
}

#[test]
fn files_in_memory_draw_the_picture_of_files_on_disk() {
    let folder = tempfile::tempdir().unwrap();
    let voxel = |f: &dyn Fn([f64; 3]) -> f64| -> Vec<u8> {
        (0..512).map(|i| f([i % 8, i / 8 % 8, i / 64].map(|i| f64::from(i) - 3.5)) as u8).collect()
    };
    let ball = voxel(&|[x, y, z]| 160.0 - 40.0 * (x * x + y * y + z * z).sqrt());
    let halves = |values: [f64; 2]| voxel(&|[x, ..]| if x < 0.0 { values[0] } else { values[1] });
    let files = [
        ("ball.nhdr", nrrd(&[], "data file: ball.raw")),
        ("ball.raw", ball.clone()),
        ("labels.nrrd", nrrd(&halves([1.0, 2.0]), "")),
        ("names.csv", b"1,near\n2,far\n".to_vec()),
        ("behind.png", png([0.2, 0.4, 0.6, 1.0])),
        ("own.png", png([0.8, 0.1, 0.1, 1.0])),
        ("theme/wax.png", png([0.1, 0.8, 0.1, 1.0])),
        (
            "part.ply",
            b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
            element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n8 0 0\n0 8 0\n3 0 1 2\n"
                .to_vec(),
        ),
        ("tone.csv", b"wanted,measured\n0,0\n0.5,0.6\n".to_vec()),
        ("selection.nrrd", nrrd(&halves([0.0, 255.0]), "")),
        ("second.nrrd", nrrd(&ball, "")),
        ("light.png", png([0.5, 0.5, 0.5, 1.0])),
        ("met.png", png([0.0, 0.0, 1.0, 1.0])),
    ];
    let files: BTreeMap<PathBuf, Vec<u8>> =
        files.into_iter().map(|(name, bytes)| (folder.path().join(name), bytes)).collect();
    std::fs::create_dir(folder.path().join("theme")).unwrap();
    for (path, bytes) in &files {
        std::fs::write(path, bytes).unwrap();
    }
    let scene =
        parse(SCENE, &folder.path().join("scene.toml"), &Overrides::default()).unwrap_or_else(|e| panic!("{e}"));
    let draw = |source: Arc<dyn Source>| -> Result<Picture, String> {
        let told = |failure: drypoint::Failure| failure.to_string();
        let job = Job::load_for(scene.clone(), RenderTarget::Picture, source).map_err(|e| e.to_string())?;
        let marking = Marking::new(&job, &mut Counts::default(), &|_| ()).map_err(told)?;
        let mut drawing = Drawing::new(&job, &marking, &mut Counts::default()).map_err(told)?;
        drawing.frame(0, &|_| ()).and_then(|(frame, _)| frame.painted(&job)).map_err(told)
    };
    let from_disk = draw(Arc::new(Disk)).unwrap_or_else(|e| panic!("{e}"));
    drop(folder);
    assert!(draw(Arc::new(files.clone())) == Ok(from_disk), "the pictures differ");
    for path in files.keys() {
        let mut others = files.clone();
        others.remove(path);
        assert!(draw(Arc::new(others)).is_err(), "{} is not read", path.display());
    }
}
