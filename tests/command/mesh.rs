//! Meshes beside the volume.

use crate::folder::Folder;

/// A square in front of the torus of `scene.toml`, 20 voxels a side: corners x and z from 6 to 13 at y.
fn corners(y: f64) -> [[f64; 3]; 4] {
    [[6.0, y, 6.0], [13.0, y, 6.0], [13.0, y, 13.0], [6.0, y, 13.0]]
}

const FACES: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

fn ply(y: f64) -> String {
    let rows = corners(y).map(|[x, y, z]| format!("{x} {y} {z}\n")).concat();
    let faces = FACES.map(|[a, b, c]| format!("3 {a} {b} {c}\n")).concat();
    format!(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\nelement face \
         2\nproperty list uchar int vertex_indices\nend_header\n{rows}{faces}"
    )
}

fn obj(y: f64) -> String {
    corners(y).map(|[x, y, z]| format!("v {x} {y} {z}\n")).concat() + "f 1 2 3 4\n"
}

fn stl(y: f64) -> String {
    let facet = |face: [usize; 3]| {
        let vertices = face.map(|i| corners(y)[i]).map(|[x, y, z]| format!("vertex {x} {y} {z}\n")).concat();
        format!("facet normal 0 1 0\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    format!("solid square\n{}endsolid square\n", FACES.map(facet).concat())
}

/// `scene.toml` along +y with a mesh.
fn folder(mesh: &str) -> Folder {
    let folder = Folder::new();
    folder.write("square.ply", ply(-3.0));
    folder.write("square.obj", obj(-3.0));
    folder.write("square.stl", stl(-3.0));
    folder.write("behind.ply", ply(12.0));
    folder.scene(&format!("[camera]\ndirection = [0, 1, 0]\n[[mesh]]\n{mesh}"));
    folder
}

fn picture(folder: &Folder, more: &str) -> Vec<u8> {
    folder.good(&format!("-q render scene.toml -o out.png {more}"));
    folder.read("out.png")
}

#[test]
fn every_format_gives_the_same_picture() {
    let folder = folder("file = \"square.ply\"\n");
    let drawn = picture(&folder, "");
    for other in ["obj", "stl"] {
        // The metadata of a picture name the scene, so only pixels are compared.
        folder.write("first.png", &drawn);
        folder.good(&format!("-q render scene.toml -o other.png --set mesh.0.file=square.{other}"));
        folder.good("compare first.png other.png --max 0");
    }
    let without = picture(&folder, "--set mesh=off");
    folder.write("without.png", without);
    assert_eq!(folder.line("compare first.png without.png --max 0.1").code, Some(1));
}

#[test]
fn a_mesh_is_placed_as_an_object_is() {
    let folder = folder("file = \"square.ply\"\n");
    folder.good("-q render scene.toml -o there.png --set mesh.0.file=behind.ply");
    for motion in ["--set mesh.0.move=[0,15,0]", "--set mesh.0.matrix=[[1,0,0,0],[0,1,0,15],[0,0,1,0],[0,0,0,1]]"] {
        folder.good(&format!("-q render scene.toml -o moved.png {motion}"));
        folder.good("compare there.png moved.png --max 0");
    }
    // A square that is turned about its middle is the same square.
    folder.good("-q render scene.toml -o before.png");
    folder.good("-q render scene.toml -o turned.png --set mesh.0.rotate.axis=[0,1,0] --set mesh.0.rotate.angle=90");
    folder.good("compare before.png turned.png --max 0.01");
}

#[test]
fn a_mesh_is_picked_and_planned() {
    let folder = folder("file = \"square.ply\"\n");
    let text = folder.good("pick scene.toml --pixel 12,8");
    assert!(text.contains("of the volume; the place is on mesh 0\n"), "{text}");
    let json: serde_json::Value = serde_json::from_str(&folder.good("pick scene.toml --pixel 12,8 --json")).unwrap();
    let near = |key: &str, expected: f64| (json[0][key][1].as_f64().unwrap() - expected).abs() < 1e-9;
    assert!(json[0]["mesh"] == 0 && near("normal", -1.0), "{json}");
    assert!(near("world", -3.0), "{json}");
    let plan = folder.good("plan scene.toml");
    let line = plan.lines().find(|line| line.starts_with("mesh 0 ")).unwrap_or_else(|| panic!("{plan}"));
    let words: Vec<&str> = line.split_whitespace().collect();
    assert_eq!(
        words.join(" "),
        "mesh 0 nearest triangle one search a ray, through a tree of the triangles mesh[0] (line 10)"
    );
    let counts: serde_json::Value = serde_json::from_str(&folder.good("-q render scene.toml --stats")).unwrap();
    assert!(counts["bytes"]["meshes"].as_u64().unwrap() > 0, "{counts}");
}

#[test]
fn meshes_that_cannot_be_read() {
    let folder = folder("file = \"broken.ply\"\n");
    for (text, what) in [
        (None, "error: broken.ply is not there\n"),
        (Some(ply(2.0).replace("3 0 2 3\n", "")), "error: the file is no mesh: "),
        (Some(ply(2.0).replace("3 0 2 3", "3 0 2 9")), "error: triangle 1 has the vertex 9, and the mesh has 4\n"),
        (Some(ply(f64::NAN)), "error: the file is no mesh: Line 10: "),
    ] {
        if let Some(text) = text {
            folder.write("broken.ply", text);
        }
        let error = folder.refused("render scene.toml");
        assert!(error.starts_with(what) && error.contains("key mesh[0].file\n"), "{error}");
    }
}
