//! `paint`: the selections that strokes make.

use crate::folder::Folder;
use drypoint::scene::glam::DVec3;
use drypoint::scene::volume::{Volume, read};

/// A ball of radius 10 voxels about voxel 15.5, opaque from its surface on, seen along +y.
const BALL: &str = r##"drypoint = 1
[volume]
phantom = { name = "sphere", size = 32, type = "f64", param = { R = 10 } }
[camera]
direction = [0, 1, 0]
projection = "orthographic"
height = 32
[picture]
size = [32, 32]
[sampling]
step = 0.25
[transfer]
kind = "regular"
nodes = [{ at = 0, color = "#ffffff", opacity = 0 }, { at = 0, color = "#ffffff", opacity = 1 }]
"##;

fn object(name: &str, strokes: &str) -> String {
    format!("[[object]]\nname = \"{name}\"\nstrokes = [{strokes}]\n")
}

fn folder(objects: &str) -> Folder {
    let folder = Folder::new();
    folder.write("ball.toml", format!("{BALL}{objects}"));
    folder
}

fn selection(folder: &Folder, name: &str) -> Volume {
    read::read(&folder.path(name), None).unwrap()
}

fn voxels(volume: &Volume) -> impl Iterator<Item = ([usize; 3], f64)> {
    let [nx, ny, nz] = volume.dims();
    (0..nx * ny * nz).map(move |i| {
        let voxel = [i % nx, i / nx % ny, i / nx / ny];
        (voxel, volume.value(voxel))
    })
}

/// The brush stands at the voxel that the ray of a pixel meets first, and paints the ball alone.
#[test]
fn a_pixel_is_painted_where_it_is_picked() {
    let folder = folder(&object("a", "{ pixel = [20, 12], radius = \"4 voxels\" }"));
    let told = folder.good("paint ball.toml -o selection.nrrd");
    assert_eq!(told, "");
    let picked = folder.good("-q pick ball.toml --pixel 20,12 --json");
    let picked: serde_json::Value = serde_json::from_str(&picked).unwrap();
    let index: [f64; 3] = [0, 1, 2].map(|i| picked[0]["index"][i].as_f64().unwrap());
    let centre = DVec3::from_array(index.map(|x| (x - 0.5).ceil()));
    let mut painted = 0;
    for (voxel, f) in voxels(&selection(&folder, "selection.nrrd")) {
        let place = DVec3::from_array(voxel.map(|i| i as f64));
        let (r, from_middle) = ((place - centre).length(), (place - 15.5).length());
        let b = if r <= 4.0 && from_middle <= 10.0 { (-4.5 * (r / 4.0).powi(2)).exp() } else { 0.0 };
        assert!((f - b).abs() < 1e-12, "{voxel:?}: {f}, not {b}");
        painted += usize::from(f > 0.0);
    }
    assert!(painted > 50, "{painted}");
}

/// A region and two basins: without a mode that takes away, the whole ball; with one, its part.
#[test]
fn regions_and_basins_fill_the_ball() {
    let all = object("region", "{ grow = [15, 15, 15], tolerance = 1000, connect = 26 }");
    let basins = object(
        "basin",
        "{ watershed = [15, 15, 7] }, { watershed = [15, 15, 24], mode = \"subtract\" }, { at = [15, 15, 24], radius = 0 }",
    );
    let folder = folder(&(all + &basins));
    folder.good("-q paint ball.toml --object region -o region.nrrd");
    folder.good("-q paint ball.toml --object basin -o basin.nrrd");
    let [region, basin] = ["region.nrrd", "basin.nrrd"].map(|name| selection(&folder, name));
    let (mut inside, mut below) = (0, 0);
    for ((voxel, f), (_, basin)) in voxels(&region).zip(voxels(&basin)) {
        let from_middle = (DVec3::from_array(voxel.map(|i| i as f64)) - 15.5).length();
        assert_eq!(f, f64::from(u8::from(from_middle <= 10.0)), "{voxel:?}");
        assert!(basin <= f);
        inside += usize::from(f > 0.0);
        below += usize::from(basin > 0.0);
    }
    assert!(below > 1 && below < inside, "{below} of {inside}");
    assert_eq!([basin.value([15, 15, 7]), basin.value([15, 15, 24])], [1.0, 1.0]);
    // The selection is told in bricks.
    assert!(folder.good("info region.nrrd").contains("bricks     8 of 16³ voxels, 8 distinct"));
}

#[test]
fn strokes_that_cannot_be_painted_are_told_with_their_keys() {
    let two = object("a", "{ at = [1, 2, 3] }") + &object("b", "{ at = [1, 2, 3] }");
    for (objects, line, parts) in [
        (object("a", "{ grow = [0, 0, 0] }"), "", &["does not show the seed's voxel", "object[0].strokes[0].grow"][..]),
        (object("a", "{ grow = [0, 99, 0] }"), "", &["lies outside the volume", "object[0].strokes[0].grow"]),
        (
            object("a", "{ at = [9, 9, 9] }, { watershed = [15, 15, 15] }, { watershed = [0, 0, 0] }"),
            "",
            &["does not show", "object[0].strokes[2].watershed"],
        ),
        (object("a", "{ pixel = [0, 0] }"), "", &["nothing is seen at the pixel [0, 0]", "object[0].strokes[0].pixel"]),
        (object("a", "{ pixel = [99, 0] }"), "", &["outside the picture", "object[0].strokes[0].pixel"]),
        (two.clone(), "", &["several objects", "--object: a, b"]),
        (two, "--object c", &["no object called \"c\"", "--object: a, b"]),
        (String::new(), "", &["no object of the scene has strokes"]),
        (object("a", "{ radius = 3 }"), "", &["object[0].strokes[0].pixel", "watershed = [x, y, z]"]),
        (object("a", "{ at = [0, 0, 0], pixel = [1, 1] }"), "", &["object[0].strokes[0]", "both"]),
        (object("a", "{ grow = [0, 0, 0], connect = 7 }"), "", &["connect", "6, 18 or 26"]),
        (object("a", "{ at = [0, 0, 0] }") + "label = 3\n", "", &["object[0]", "both"]),
    ] {
        let said = folder(&objects).refused(&format!("paint ball.toml -o s.nrrd {line}"));
        assert!(parts.iter().all(|part| said.contains(part)), "{objects}{line}\n{said}");
    }
    let said = folder("").refused("paint ball.toml -o s.png");
    assert!(said.contains("a selection is written as NRRD"), "{said}");
    let said = folder(&object("a", "{ at = [0, 0, 0] }")).refused("paint ball.toml -o ball.toml");
    assert!(said.contains("a selection is written as NRRD"), "{said}");
}
