//! `plan`.

use crate::folder::Folder;

#[test]
fn it_says_what_is_needed_and_which_line_asked() {
    let folder = Folder::new();
    folder.scene("[camera]\nprojection = \"orthographic\"\nfov = 30\n[contours]\n");
    let plan = folder.good("plan scene.toml");
    for line in [
        "effect                       needs            adds                                                                    because of",
        "styles                       gradient         one gradient a visible sample                                           transfer.kind (line 6)",
        "contours                     previous normal  one gradient where the sample before has none yet                       contours.kappa (line 11)",
        "  camera.fov (line 10): the camera is orthographic: height counts",
    ] {
        assert!(plan.lines().any(|l| l == line), "{line}\n{plan}");
    }
    let plan = folder.good("plan scene.toml --set contours=off --set sampling.step=3");
    assert!(!plan.contains("contours"), "{plan}");
    assert!(plan.contains("\nwarnings\n  samples are up to 3.0000 apart along a ray"), "{plan}");
}

/// An eye in the volume is a warning, and a picture.
#[test]
fn a_camera_inside_the_volume_is_warned_of() {
    let folder = Folder::new();
    let warning = "the camera is inside the volume: what lies behind it is not seen; move camera.eye away, or leave it out \
                   for a view of the whole";
    for (camera, is_inside) in [
        ("eye = [9, 9, 9]\ndirection = [1, 0, 0]\n", true),
        ("eye = [0, 9, 9]\ndirection = [1, 0, 0]\n", true),
        ("eye = [-0.1, 9, 9]\ndirection = [1, 0, 0]\n", false),
        ("projection = \"orthographic\"\neye = [9, 9, 9]\ndirection = [1, 0, 0]\n", false),
        ("", false),
    ] {
        folder.scene(&format!("[camera]\n{camera}"));
        assert_eq!(
            folder.good("plan scene.toml").contains(&format!("\nwarnings\n  {warning}\n")),
            is_inside,
            "{camera}"
        );
        let said = folder.line("render scene.toml -o a.png");
        assert_eq!(said.code, Some(0));
        assert_eq!(said.err.contains(&format!("warning: {warning}\n")), is_inside, "{}", said.err);
    }
}

#[test]
fn a_function_that_is_found_in_the_data_is_part_of_the_plan() {
    let folder = Folder::new();
    folder.write("scene.toml", "drypoint = 1\nvolume.phantom = { name = \"torus\", size = 16 }\n");
    let plan = folder.good("plan scene.toml");
    assert!(plan.contains(" automatic function "), "{plan}");
}

#[test]
fn what_the_volume_decides_is_in_the_plan_as_it_decided() {
    let folder = Folder::new();
    folder.torus();
    let scene = "drypoint = 1\nvolume.file = \"torus.nrrd\"\ncontours.kappa = \"exact\"\nsampling.scale = 2\n";
    folder.write("scene.toml", scene);
    // In f64 nothing is smoothed.
    let plan = folder.good("plan scene.toml");
    assert!(plan.contains("\ncontours ") && !plan.contains("smoothed coefficients"), "{plan}");
    assert!(plan.contains("  sampling.scale (line 4): hessian = \"auto\" smooths integers only"), "{plan}");
    folder.good("-q phantom torus --size 24 --type u8 -o torus.nrrd");
    let plan = folder.good("plan scene.toml");
    assert!(plan.contains("\ncontours, integer voxels ") && !plan.contains("sampling.scale (line 4)"), "{plan}");
}

#[test]
fn the_full_scene_is_a_scene_and_gives_the_same_picture() {
    let folder = Folder::new();
    folder.torus();
    folder.scene("[contours]\nfade = [0.1, 0.3]\n[sampling]\nkernel = \"catmull-rom\"\n");
    folder.write("short.toml", "drypoint = 1\nvolume.file = \"torus.nrrd\"\npicture.size = [20, 20]\n");
    for input in ["scene.toml", "short.toml", "torus.nrrd", ""] {
        let small = match input {
            "" => "--set picture.size=[21,17] --set volume.phantom.size=24",
            "torus.nrrd" => "--set picture.size=[21,17]",
            _ => "",
        };
        folder.write("full.toml", folder.good(&format!("plan --full {input} {small}")));
        for suffix in ["png", "exr"] {
            folder.good(&format!("render {input} {small} -o a.{suffix}"));
            folder.good(&format!("render full.toml -o b.{suffix}"));
            assert!(folder.read(&format!("a.{suffix}")) == folder.read(&format!("b.{suffix}")), "{input} {suffix}");
        }
        assert_eq!(folder.good("plan --full full.toml").into_bytes(), folder.read("full.toml"), "{input}");
    }
}

/// `--preset` is what `render` takes: the scene that it prints is the one that `render` draws.
#[test]
fn a_preset_of_a_bare_volume() {
    let folder = Folder::new();
    folder.good("phantom torus --size 16 --type u8 -o torus.nrrd -q");
    for preset in ["toon", "stipple", "outline", "hatch", "halo", "halo-glow", "halo-lines"] {
        let scene = format!("torus.nrrd --preset {preset} --set picture.size=[90,60]");
        let said = folder.good(&format!("plan {scene} --full"));
        folder.write("said.toml", said);
        folder.good(&format!("render {scene} -o a.png -q"));
        folder.good("render said.toml -o b.png -q");
        let [a, b] = ["a.png", "b.png"].map(|name| folder.read(name));
        assert!(a.len() > 500, "{preset}");
        let size = |png: &[u8]| png[16..24].to_vec();
        assert_eq!(size(&a), size(&b), "{preset}");
    }
    let refused = folder.refused("plan torus.nrrd --preset gone");
    assert!(refused.contains("--preset gone"), "{refused}");
}

/// Labels that seed halos are looked up by their names.
#[test]
fn names_of_labels_that_seed_halos_become_ids() {
    let folder = Folder::new();
    folder.torus();
    folder.good("-q phantom torus --size 16 --type u8 -o labels.nrrd");
    folder.write("names.csv", "id,name\n5,liver\n6,spleen\n");
    let scene = |labels: &str| {
        let files = "volume = { file = \"torus.nrrd\", labels = \"labels.nrrd\", label_names = \"names.csv\" }";
        folder.write("scene.toml", format!("drypoint = 1\n{files}\n[[halo]]\nseed.labels = {labels}\n"));
    };
    scene("[\"spleen\", 7]");
    let shot: serde_json::Value = serde_json::from_str(&folder.good("plan scene.toml --json")).unwrap();
    assert_eq!(shot["halos"]["list"][0]["seed"]["labels"], serde_json::json!([6, 7]));
    scene("[5, \"splen\"]");
    let told = folder.refused("plan scene.toml --json");
    let expected = "error: there is no label \"splen\"\n  at: scene.toml:4:19, key halo[0].seed.labels[1]\n  try: write \"spleen\"\n";
    assert_eq!(told, expected);
    folder.write("scene.toml", "drypoint = 1\nvolume.file = \"torus.nrrd\"\n[[halo]]\nseed.focus.pixels = [[3, 4]]\n");
    let told = folder.refused("plan scene.toml --json");
    assert!(told.starts_with("error: nothing is seen at the pixel [3, 4]"), "{told}");
}

/// The shot has nothing left to decide: lengths are numbers of the world, `auto` is what the volume made of it.
#[test]
fn json_is_the_picture_with_nothing_left_to_decide() {
    let folder = Folder::new();
    let shot = |more: &str, set: &str| -> serde_json::Value {
        folder.scene(more);
        let text = folder.good(&format!("plan scene.toml --json {set}"));
        assert!(!text.contains("auto"), "{text}");
        serde_json::from_str(&text).unwrap()
    };
    let plain = shot("[sampling]\nstep = \"0.25 voxels\"\n", "--set picture.layers=[\"beauty\",\"first.normal\"]");
    assert_eq!(plain["lattice"]["along"], "plane");
    assert_eq!(plain["lattice"]["step"], plain["lattice"]["near"]);
    assert_eq!(plain["layers"], serde_json::json!(["beauty", "first.normal"]));
    assert_eq!(plain["stop_at"], 1.0);
    let object = &plain["objects"][0];
    // The phantom is a file of integers.
    assert_eq!([&object["reconstruction"]["hessian"], &object["reconstruction"]["kernel"]], ["gaussian", "trilinear"]);
    assert_eq!(object["rung"], "gradient");
    assert_eq!(
        object["query"],
        serde_json::json!({ "gradient": true, "hessian": false, "principal": false, "kappa": "none" })
    );
    assert!(object["material"]["style"]["contour"].is_null());
    assert!(object["function"]["style"]["nodes"]["at"].as_array().unwrap().len() > 1);
    // The page of formats has every field.
    let page = include_str!("../../docs/formats.md");
    let keys = |value: &serde_json::Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    let fields = keys(&plain).into_iter().chain(keys(object).into_iter().map(|key| format!(".{key}")));
    assert_eq!(fields.filter(|field| !page.contains(&format!("`{field}`"))).collect::<Vec<_>>(), [""; 0]);
    // Halos: of the table, with the reach in rays, or of a preset for a bare volume.
    assert_eq!(plain["halos"]["list"], serde_json::json!([]));
    let halo = &shot("[[halo]]\nspread.reach = \"30 px\"\n", "")["halos"];
    assert_eq!([&halo["list"][0]["name"], &halo["list"][0]["seed"]["value"]], ["halo 0", "opacity"]);
    // Each pixel has 2×2 rays.
    assert_eq!(halo["list"][0]["spread"]["stretch"], 4.0);
    assert_eq!(halo["query"]["gradient"], true);
    folder.torus();
    let text = folder.good("plan torus.nrrd --preset halo --json --set picture.layers=[\"beauty\",\"halo1\"]");
    let preset: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(preset["halos"]["list"].as_array().unwrap().len(), 2);
    assert_eq!(preset["layers"], serde_json::json!(["beauty", "halo1"]));
    // A step twice as long, in a world twice as large a voxel, and contours by the Hessian.
    let exact =
        shot("[sampling]\nstep = \"0.5 voxels\"\n[contours]\nkappa = \"exact\"\nthickness = \"2 voxels\"\n", "");
    let step = |shot: &serde_json::Value| shot["lattice"]["step"].as_f64().unwrap();
    assert_eq!(step(&exact), 2.0 * step(&plain));
    let object = &exact["objects"][0];
    assert_eq!([&object["query"]["kappa"], &object["rung"]], ["exact", "hessian"]);
    assert_eq!(object["material"]["style"]["contour"]["thickness"].as_f64().unwrap(), 4.0 * step(&exact));
    assert_ne!(folder.line("plan scene.toml --json --full").code, Some(0));
}
