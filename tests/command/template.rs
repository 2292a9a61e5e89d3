//! A scene for another volume than its own, and templates, which have none.

use crate::folder::Folder;

/// A scene without a volume, over the places of values in the volume's range.
const TEMPLATE: &str = r#"drypoint = 1
[camera]
direction = [1, -2, -1]
[picture]
size = [24, 16]
[transfer]
unit = "normalized"
nodes = [{ at = 0.35, style = "wax", opacity = 0 }, { at = 0.6, style = "wax", opacity = 0.9 }]
"#;

fn folder() -> Folder {
    let folder = Folder::new();
    folder.torus();
    folder.write("template.toml", TEMPLATE);
    folder
}

#[test]
fn a_template_draws_a_volume_as_a_scene_that_names_it() {
    let folder = folder();
    folder.write("scene.toml", format!("{TEMPLATE}[volume]\nfile = \"torus.nrrd\"\n"));
    folder.good("-q render scene.toml");
    folder.good("-q template.toml torus.nrrd");
    // The picture has the volume's name.
    assert_eq!(folder.read("torus.png"), folder.read("scene.png"));
    folder.good("-q render template.toml -o set.png --set volume.file=torus.nrrd");
    assert_eq!(folder.read("set.png"), folder.read("scene.png"));
}

/// A torus of twice the spacing in other values: the camera frames it, and the range maps it.
#[test]
fn a_template_fits_volumes_of_other_sizes_and_values() {
    let folder = folder();
    folder.good("-q phantom torus --size 24 --type f64 --spacing 2,2,2 -o large.nrrd");
    folder.good("-q render template.toml torus.nrrd");
    folder.good("-q render template.toml large.nrrd");
    let range =
        |file: &str| folder.good(&format!("info {file}")).lines().find(|l| l.starts_with("range")).unwrap().to_owned();
    assert_ne!(range("torus.nrrd"), range("large.nrrd"));
    // Values are distances, twice as long: everything is scaled by a power of two.
    let same = "compare torus.png large.png --max 0";
    folder.good(same);
    // In values the nodes of the one are not those of the other.
    for file in ["torus", "large"] {
        folder.good(&format!("-q render template.toml {file}.nrrd --set transfer.unit=value"));
    }
    assert_eq!(folder.line(same).code, Some(1));
}

#[test]
fn the_volume_takes_the_place_of_the_scenes_own() {
    let folder = folder();
    folder.good("-q phantom sphere --size 20 -o sphere.nrrd");
    let own = "[volume]\nfile = \"sphere.nrrd\"\nbox = [[0, 9], [0, 9], [0, 9]]\nlabels = \"sphere.nrrd\"\noutside = \"high\"\n";
    folder.write("scene.toml", format!("{TEMPLATE}{own}"));
    let full = folder.good("plan scene.toml torus.nrrd --full");
    assert!(full.contains("file = \"torus.nrrd\"\n") && full.contains("outside = \"high\"\n"), "{full}");
    assert!(!full.contains("\nbox = ") && !full.contains("\nlabels = "), "{full}");
    let plan = folder.good("plan scene.toml torus.nrrd");
    for key in ["volume.box (line 11)", "volume.labels (line 12)"] {
        let line = format!("  {key}: it describes the volume that the scene names, and another one is drawn\n");
        assert!(plan.contains(&line), "{line}{plan}");
    }
    // What the command line says holds for the volume that is drawn.
    let full = folder.good("plan scene.toml torus.nrrd --full --set volume.box=[[0,5],[0,5],[0,5]]");
    assert!(full.contains("\nbox = [[0, 5], [0, 5], [0, 5]]\n"), "{full}");
    // A template names no volume, so its keys are for any.
    folder.write("part.toml", format!("{TEMPLATE}[volume]\nbox = [[0, 9], [0, 9], [0, 9]]\n"));
    let full = folder.good("plan part.toml torus.nrrd --full");
    assert!(full.contains("\nbox = [[0, 9], [0, 9], [0, 9]]\n"), "{full}");
    // Layouts of raw voxels go with their file, and a phantom with its place.
    folder.write("phantom.toml", format!("{TEMPLATE}[volume]\nphantom = {{ name = \"sphere\", size = 20 }}\n"));
    let full = folder.good("plan phantom.toml torus.nrrd --full");
    assert!(full.contains("file = \"torus.nrrd\"\n") && !full.contains("phantom"), "{full}");
}

#[test]
fn every_verb_of_scenes_takes_a_volume() {
    let folder = folder();
    folder
        .write("dots.toml", "drypoint = 1\n[stipples]\n[outlines]\n[picture]\nwidth = \"30 mm\"\nheight = \"30 mm\"\n");
    for line in [
        "-q plan template.toml torus.nrrd",
        "-q plan template.toml torus.nrrd --json",
        "-q pick template.toml torus.nrrd --pixel 12,8",
        "-q points dots.toml torus.nrrd -o dots.svg",
        "-q strokes dots.toml torus.nrrd -o lines.svg",
        "-q cost template.toml torus.nrrd --knob sampling.stop_below --runs 1",
    ] {
        folder.good(line);
        assert!(folder.line(&line.replace(" torus.nrrd", "")).code == Some(2), "{line}");
    }
}

#[test]
fn the_plan_tells_the_values_of_nodes() {
    let folder = folder();
    // u8 values 0 … 255.
    folder.good("-q phantom plane --size 16 --type u8 -o plane.nrrd");
    let plan = folder.good("plan template.toml plane.nrrd --set volume.range=[0,200]");
    assert!(plan.contains("\ntransfer.unit = \"normalized\"\n  0.35 is 70\n  0.6 is 120\n"), "{plan}");
    let plan = folder.good("plan template.toml plane.nrrd --set transfer.unit=value");
    assert!(!plan.contains("transfer.unit ="), "{plan}");
}

/// Functions of objects and of ghosts, each once, and the picture's in the data of an object; each in its own range.
#[test]
fn the_plan_tells_the_values_of_nodes_of_objects() {
    let folder = folder();
    folder.good("-q phantom plane --size 16 --type u8 -o plane.nrrd");
    let of = |table: &str, unit: &str, at: &str| {
        format!("[object.{table}]\nkind = \"regular\"\nunit = \"{unit}\"\nnodes = [{{ at = {at}, color = \"red\" }}]\n")
    };
    let scene = TEMPLATE.to_owned()
        + "[[object]]\nmove = [1, 0, 0]\n"
        + &of("transfer", "normalized", "0.5")
        + &of("ghost.transfer", "normalized", "0.25")
        + "[[object]]\nmove = [2, 0, 0]\n"
        + &of("transfer", "normalized", "0.75")
        + "[[object]]\nvolume = \"plane.nrrd\"\nrange = [0, 100]\nmove = [3, 0, 0]\n"
        + "[[object]]\nvolume = \"plane.nrrd\"\nrange = [0, 1000]\n"
        + &of("transfer", "normalized", "0.125")
        + "[[object]]\nmove = [4, 0, 0]\n"
        + &of("transfer", "value", "7");
    folder.write("objects.toml", scene);
    let plan = folder.good("plan objects.toml plane.nrrd --set volume.range=[0,200]");
    let told = "\ntransfer.unit = \"normalized\"\n  0.35 is 70\n  0.6 is 120\n\
                \nobject[0].transfer.unit = \"normalized\"\n  0.5 is 100\n\
                \nobject[0].ghost.transfer.unit = \"normalized\"\n  0.25 is 50\n\
                \nobject[1].transfer.unit = \"normalized\"\n  0.75 is 150\n\
                \ntransfer.unit = \"normalized\" in object[2].volume\n  0.35 is 35\n  0.6 is 60\n\
                \nobject[3].transfer.unit = \"normalized\"\n  0.125 is 125\n";
    assert!(plan.contains(told) && plan.matches("unit = ").count() == 6, "{plan}");
}

#[test]
fn pairs_that_are_no_scene_and_volume() {
    let folder = folder();
    folder.write("dots.csv", "");
    let order = "try: write the scene, then the volume: drypoint render template.toml head.nrrd\n";
    for (line, expected) in [
        (
            "render template.toml",
            "error: the scene is a template: it names no volume\n  at: template.toml:1:1, key volume\n  try: name a volume \
             after the scene on the command line or by volume of a figure's panel, or write file = \"…\" or phantom = { name = \"…\" } in [volume]\n"
                .to_owned(),
        ),
        (
            "render torus.nrrd template.toml",
            format!("error: the volume stands before its scene\n  at: template.toml\n  {order}"),
        ),
        (
            "render torus.nrrd torus.nrrd",
            format!("error: a volume is drawn by a scene, and the file before this one is none\n  at: torus.nrrd\n  {order}"),
        ),
        (
            "render template.toml template.toml",
            format!("error: a scene is drawn for a volume, and this is a second scene\n  at: template.toml\n  {order}"),
        ),
        (
            "render template.toml none.nrrd",
            "error: the file cannot be read: No such file or directory (os error 2)\n  at: none.nrrd\n  try: check the \
             path; scenes end in .toml, volumes in .nrrd, .nhdr, .nii, .nii.gz, .hdr, .hdr.gz, .img, .img.gz, .mhd, .mha, \
             .raw, .raw.gz\n"
                .to_owned(),
        ),
        (
            "points dots.csv torus.nrrd -o dots.svg",
            "error: a list of dots is drawn without a volume\n  at: torus.nrrd\n  try: leave it out\n".to_owned(),
        ),
    ] {
        assert_eq!(folder.refused(line), expected, "{line}");
    }
}
