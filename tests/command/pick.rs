//! `pick`, on a sphere, a labelled slab and nothing.

use crate::folder::{Folder, SCENE};
use serde_json::{Value, json};

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

fn picked(folder: &Folder, line: &str) -> Value {
    serde_json::from_str(&folder.good(&format!("-q pick {line} --json"))).unwrap()
}

fn three(value: &Value) -> [f64; 3] {
    [0, 1, 2].map(|i| value[i].as_f64().unwrap_or_else(|| panic!("{value}")))
}

fn ball() -> Folder {
    let folder = Folder::new();
    folder.write("ball.toml", BALL);
    folder
}

/// In a picture of a pixel a voxel the ray of pixel (x, y) passes at (x + ½ − 16, 16 − y − ½) from the middle.
#[test]
fn a_ball_is_picked_on_its_front() {
    let folder = ball();
    let both = picked(&folder, "ball.toml --pixel 15,15 --pixel 20,12 --pixel 0,31");
    for (i, [x, y]) in [[15.0, 15.0], [20.0, 12.0]].into_iter().enumerate() {
        let place = &both[i];
        assert_eq!(place["pixel"], json!([x as u64, y as u64]));
        let offset = three(&place["world"]).map(|c| c - 15.5);
        let [right, up]: [f64; 2] = [x + 0.5 - 16.0, 16.0 - y - 0.5];
        // The front is the half of the ball with smaller y. Trilinear values are a little below the distance.
        let front = -(100.0 - right * right - up * up).sqrt();
        assert!((offset[1] - front - 0.125).abs() < 0.2, "{place}");
        assert!((offset[0].abs() - right.abs()).abs() < 1e-9 && (offset[2].abs() - up.abs()).abs() < 1e-9, "{place}");
        assert_eq!(
            (&place["index"], &place["opacity"], &place["on_surface"]),
            (&place["world"], &json!(1.0), &json!(false))
        );
        let normal = three(&place["normal"]);
        let along: f64 = (0..3).map(|a| normal[a] * offset[a]).sum::<f64>() / 10.0;
        assert!(along > 0.97, "{place}");
        assert!(place.get("label").is_none() && place["value"].as_f64().unwrap() >= 0.0);
    }
    assert_eq!((both.as_array().unwrap().len(), &both[2]), (3, &Value::Null));
    // However many rays a pixel has, its centre is picked.
    let same = picked(&folder, "ball.toml --pixel 20,12 --set picture.samples=2");
    assert_eq!(same[0], both[1]);
}

#[test]
fn a_person_gets_text_and_a_focus() {
    let folder = ball();
    let surface = r#"--set surface.look="white" --set surface.iso=2"#;
    let text = folder.good(&format!("-q pick ball.toml --pixel 16,16 --pixel 0,0 --set transfer=off {surface}"));
    let lines: Vec<&str> = text.lines().collect();
    let names: Vec<&str> = lines.iter().map(|line| line.get(..11).unwrap_or_default().trim_end()).collect();
    assert_eq!(
        names,
        ["pixel", "world", "index", "value", "eye depth", "normal", "opacity", "", "pixel", "", "[[halo]]"],
        "{text}"
    );
    assert_eq!(lines[0], "pixel      16,16");
    assert_eq!(lines[3], "value      2, on the iso-surface");
    assert_eq!(lines[6], "opacity    1 up to here");
    assert_eq!(lines[8], "pixel      0,0: nothing is seen there");
    let focus = lines[10].strip_prefix("[[halo]]   ").unwrap();
    let world: Vec<&str> = lines[1]["world      ".len()..].split("  ").collect();
    assert!(focus.starts_with(&format!("seed.focus = {{ at = [[{}]], inner = ", world.join(", "))), "{text}");
    let nothing = folder.good("-q pick ball.toml --pixel 0,0");
    assert_eq!(nothing, "pixel      0,0: nothing is seen there\n");
}

#[test]
fn labels_have_names_though_no_effect_reads_them() {
    let folder = ball();
    folder.good("-q phantom constant --size 32 --type u8 --param value=3 -o labels.nrrd");
    folder.write("names.csv", "id,name\n3,liver\n");
    let line = "ball.toml --pixel 15,15 --set volume.labels=\"labels.nrrd\"";
    let alone = &picked(&folder, line)[0];
    assert_eq!((&alone["label"], &alone["label_name"]), (&json!(3), &Value::Null));
    let named = format!("{line} --set volume.label_names=\"names.csv\"");
    assert_eq!(picked(&folder, &named)[0]["label_name"], "liver");
    assert!(folder.good(&format!("-q pick {named}")).contains("\nlabel      3, liver\n"));
}

#[test]
fn a_bare_volume_is_picked_as_it_is_rendered() {
    let folder = Folder::new();
    folder.torus();
    let place = &picked(&folder, "torus.nrrd --size 40x30 --pixel 20,9 --preset toon")[0];
    assert!(place["world"].is_array(), "{place}");
    folder.write("scene.toml", SCENE);
    assert!(folder.good("-q pick scene.toml --pixel 12,3").starts_with("pixel      12,3"));
}

#[test]
fn wrong_pixels_are_refused() {
    let folder = ball();
    assert_eq!(
        folder.refused("pick ball.toml --pixel 32,0 --pixel -1,2"),
        "error: the pixel 32,0 lies outside the picture of 32 × 32 pixels\n  at: --pixel 32,0\n  try: X goes from 0 at the left \
         to 31, and Y from 0 at the top to 31\nerror: the pixel -1,2 lies outside the picture of 32 × 32 pixels\n  at: --pixel \
         -1,2\n  try: X goes from 0 at the left to 31, and Y from 0 at the top to 31\n"
    );
    let help = "  at: drypoint pick\n  try: `drypoint pick --help` tells what there is\n";
    assert_eq!(
        folder.refused("pick ball.toml --pixel 1.5,2"),
        format!("error: invalid value '1.5,2' for '--pixel <X,Y>': a pixel is two whole numbers, as X,Y\n{help}")
    );
    assert_eq!(
        folder.refused("pick ball.toml"),
        format!("error: the following required arguments were not provided: --pixel <X,Y>\n{help}")
    );
    let marks = "pick ball.toml --pixel 1,2 --set transfer=off --set outlines.iso=1";
    assert!(folder.refused(marks).starts_with("error: the volume itself is not drawn\n"));
}

/// `seed.focus.pixels` of a halo means the places that `pick` tells, whatever the halo looks like.
#[test]
fn a_focus_in_pixels_is_picked() {
    let folder = ball();
    let halo = |pixels: &str| {
        let rest = "profile = [{ at = 1, color = \"#000000\" }]\nseed.focus = { pixels = ";
        folder.write("halo.toml", format!("{BALL}[[halo]]\n{rest}{pixels}, inner = 2 }}\n"));
    };
    halo("[[15, 15], [20, 12]]");
    let written = folder.good("-q plan halo.toml --full");
    let places = picked(&folder, "ball.toml --pixel 15,15 --pixel 20,12");
    let points = [0, 1].map(|i| three(&places[i]["world"]).map(|c| c.to_string()).join(", "));
    assert!(written.contains(&format!("at = [[{}], [{}]]", points[0], points[1])), "{written}\n{points:?}");
    assert!(!written.contains("pixels = "), "{written}");
    // A halo that shows nothing picks nothing, and its pixels stay.
    let hidden = folder.good("-q plan halo.toml --full --set halo[0].opacity=0");
    assert!(hidden.contains("pixels = [[15, 15], [20, 12]]"), "{hidden}");

    halo("[[0, 31], [15, 15], [32, 3]]");
    let at = "  at: halo.toml:17:16, key halo[0].seed.focus.pixels\n  try: give a pixel that shows the volume; `drypoint pick` tells \
              what is seen at one\n";
    assert_eq!(
        folder.refused("plan halo.toml --full"),
        format!(
            "error: nothing is seen at the pixel [0, 31], so it gives the halo no focus\n{at}error: the pixel [32, 3] lies \
             outside the picture of 32 × 32 pixels\n{at}"
        )
    );
}
