//! `--set` and files that are looked for.

use super::*;
use crate::tables::{GradientRange, Length, NodeColor, Projection, Stipples, StyleSource, VolumeSource};
use std::path::PathBuf;

const SCENE: &str = "drypoint = 1
[volume]
file = \"a.nrrd\"
[camera]
fov = 40
[contours]
thickness = \"3 voxels\"
fade = [0.1, 0.2]
[transfer]
nodes = [{ at = 1, style = \"wax\" }, { at = 2, style = \"metal\" }, { at = 3, style = \"wax\" }]
";

fn set(settings: &[(&str, &str)]) -> Result<Scene, Faults> {
    parse(SCENE, Path::new("folder/scene.toml"), &settings.iter().copied().collect())
}

#[test]
fn values_are_toml_or_bare_texts_and_the_last_one_stays() {
    let scene = set(&[
        ("camera.fov", "50"),
        ("camera.fov", "60"),
        ("sampling.step", "2 voxels"),
        ("volume.gradient_range", "[1, 2]"),
        ("transfer.nodes[1].opacity", "0.25"),
        ("transfer.nodes.2.style", "metal"),
        ("styles.\"my wax\"", "w.png"),
    ])
    .unwrap();
    assert_eq!(scene.camera.projection, Projection::Perspective { fov: 60.0 });
    assert_eq!(scene.sampling.step, Length::Voxels(2.0));
    assert_eq!(scene.volume.gradient_range, GradientRange::Fixed([1.0, 2.0]));
    let nodes = scene.transfer.unwrap().nodes.unwrap();
    assert_eq!((nodes[1].opacity, &nodes[2].color), (0.25, &NodeColor::Style("metal".into())));
    assert_eq!(scene.styles.files[0].0, "my wax");
    assert_eq!(scene.given.place("camera.fov"), Some(&Place::Set("camera.fov=60".into())));
    assert_eq!(scene.given.line("contours"), Some(6));
}

#[test]
fn off_removes_tables_items_and_keys() {
    let base = set(&[]).unwrap();
    assert_eq!(set(&[("contours", "off")]).unwrap().contours, None);
    assert!(base.contours.unwrap().fade.is_some());
    assert_eq!(set(&[("contours.fade", "off")]).unwrap().contours.unwrap().fade, None);
    assert_eq!(set(&[("transfer.nodes.1", "off")]).unwrap().transfer.unwrap().nodes.unwrap().len(), 2);
    assert_eq!(set(&[("camera", "off")]).unwrap().camera, crate::tables::Camera::default());
    // What is not there cannot be removed, but must be a thing that could.
    assert_eq!(set(&[("shading", "off"), ("halo.0", "off"), ("styles.wax", "off")]).unwrap(), set(&[]).unwrap());
    // What is not built may be taken out of a scene that has it.
    let mesh = format!("{SCENE}[[mesh]]\nfile = \"plate.ply\"\n");
    assert!(parse(&mesh, Path::new("s"), &[("mesh", "off")].into_iter().collect()).is_ok());
    // The text "off" in quotes is a text.
    assert!(set(&[("contours.kappa", "\"off\"")]).is_err());
}

#[test]
fn an_override_can_make_an_effect() {
    let base = "drypoint = 1\n[volume]\nfile = \"a\"\n";
    let with =
        |settings: &[(&str, &str)]| parse(base, Path::new("s"), &settings.iter().copied().collect()).unwrap().contours;
    assert_eq!(with(&[]), None);
    assert_eq!(with(&[("contours", "{}")]), Some(crate::tables::Contours::default()));
    assert_eq!(with(&[("contours.thickness", "4")]).unwrap().thickness, Length::World(4.0));
}

/// A key of a table that the preset supplies is set in that table, however deep; a table that is given whole, by the file or
/// an override, takes the preset's place ([SCN-3]).
#[test]
fn an_override_changes_a_key_of_a_preset_and_leaves_the_others() {
    let base = "drypoint = 1\npreset = \"stipple-fig1\"\n[volume]\nfile = \"a\"\n";
    let read = |text: &str, settings: &[(&str, &str)]| {
        parse(text, Path::new("s"), &settings.iter().copied().collect()).unwrap()
    };
    let preset = read(base, &[]).stipples.unwrap();
    let scene = read(base, &[("stipples.seed", "7"), ("stipples.boundary.gs", "0.25")]);
    let mut wanted = preset.clone();
    wanted.seed = 7;
    wanted.boundary.as_mut().unwrap().gs = 0.25;
    assert_eq!(scene.stipples, Some(wanted));
    assert!(!scene.given.contains("stipples") && scene.given.contains("stipples.seed"));
    let whole = read(base, &[("stipples", "{ seed = 7 }")]).stipples;
    assert_eq!(whole, Some(Stipples { seed: 7, ..Stipples::default() }));
    let file = format!("{base}[stipples]\n");
    assert_eq!(read(&file, &[("stipples.seed", "7")]).stipples, whole);
    // The preset itself may be an override, before or after.
    let bare = "drypoint = 1\n[volume]\nfile = \"a\"\n";
    let both = read(bare, &[("stipples.seed", "7"), ("preset", "stipple-fig1")]).stipples;
    assert_eq!(both, Some(Stipples { seed: 7, ..preset }));
}

#[test]
fn faults_of_overrides_name_them() {
    for (setting, text) in [
        (
            ("camera.fov", "wide"),
            "camera.fov cannot be \"wide\"\n  at --set camera.fov=wide, key camera.fov\n  write a number above 0 and \
             below 180, in degrees",
        ),
        (
            ("contour", "off"),
            "a scene has no key \"contour\"\n  at --set contour=off, key contour\n  write \"contours\"; the keys here are \
             drypoint, preset, light, volume, clip, camera, orbit, picture, page, pen, sampling, transfer, styles, shading, contours, style_mipmaps, halo, combine, object, intersection, stipples, hatching, outlines, surface, mesh, box, arrow, fan, label, labels, scale_bar, orientation, legend",
        ),
        (
            ("contours.thicknes", "off"),
            "[contours] has no key \"thicknes\"\n  at --set contours.thicknes=off, key contours.thicknes\n  write \
             \"thickness\"; the keys here are thickness, kappa, threshold, sign_flip, fade",
        ),
        (
            ("transfer.nodes[3].at", "1"),
            "there is no item 3 in a list of 3\n  at --set transfer.nodes[3].at=1, key transfer.nodes[3].at\n  items \
             count from 0",
        ),
        (
            ("camera..fov", "1"),
            "\"camera..fov\" is no key\n  at --set camera..fov=1, key camera..fov\n  write names with points between them, \
             such as transfer.nodes[2].opacity",
        ),
        (
            ("contours", "on"),
            "contours cannot be \"on\"\n  at --set contours=on, key contours\n  write a table with the keys thickness, \
             kappa, threshold, sign_flip, fade",
        ),
    ] {
        assert_eq!(set(&[setting]).unwrap_err().to_string(), text);
    }
}

#[test]
fn an_override_drives_out_what_it_stands_for() {
    let phantom = set(&[("volume.phantom.name", "torus")]).unwrap();
    assert!(matches!(phantom.volume.source, VolumeSource::Phantom(_)));
    let text =
        "drypoint = 1\n[volume]\nphantom = { name = \"torus\" }\n[picture]\nwidth = \"10 mm\"\nheight = \"10 mm\"\n";
    let settings = [("volume.file", "b.nrrd"), ("picture.size", "[3, 4]")];
    let scene = parse(text, Path::new("s"), &settings.into_iter().collect()).unwrap();
    assert_eq!(scene.volume.source, VolumeSource::File { path: "b.nrrd".into(), raw: None });
    assert_eq!(scene.picture.size, [3, 4]);
    assert!(!scene.given.contains("picture.width"));
    let both = [("volume.file", "b.nrrd"), ("volume.phantom.name", "torus")];
    assert!(set(&both).unwrap_err().to_string().starts_with("[volume] has both phantom and file\n  at --set "));
}

#[test]
fn paths_of_the_file_are_beside_it_and_those_of_the_command_line_are_not() {
    let path = |scene: Scene| match scene.volume.source {
        VolumeSource::File { path, .. } => path,
        VolumeSource::Phantom(_) => panic!(),
    };
    assert_eq!(path(set(&[]).unwrap()), PathBuf::from("folder/a.nrrd"));
    assert_eq!(path(set(&[("volume.file", "a.nrrd")]).unwrap()), PathBuf::from("a.nrrd"));
    let theme = set(&[("styles.theme", "pencils"), ("transfer", "off")]).unwrap().styles.theme;
    assert_eq!(theme, StyleSource::Folder("pencils".into()));
}

#[test]
fn files_are_found_beside_the_scene_then_in_the_listed_folders() {
    let root = std::env::temp_dir().join(format!("drypoint-scene-{}", std::process::id()));
    let (scenes, data) = (root.join("scenes"), root.join("data"));
    std::fs::create_dir_all(&scenes).unwrap();
    std::fs::create_dir_all(&data).unwrap();
    std::fs::write(data.join("a.nrrd"), "").unwrap();
    let file = scenes.join("s.toml");
    let look = |text: &str, settings: &[(&str, &str)]| {
        let mut check = Check::new(&file);
        let overrides: Overrides = settings.iter().copied().collect();
        let mut scene = read(text, None, &overrides, &mut check).unwrap();
        find::files(&mut scene, &mut check, &[root.join("nowhere"), data.clone()]);
        finish(Some(scene), |scene| &mut scene.given, check)
    };
    let text = "drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n";
    let found = |path: PathBuf| VolumeSource::File { path, raw: None };
    assert_eq!(look(text, &[]).unwrap().volume.source, found(data.join("a.nrrd")));
    assert_eq!(look(text, &[("volume.file", "a.nrrd")]).unwrap().volume.source, found(data.join("a.nrrd")));
    std::fs::write(scenes.join("a.nrrd"), "").unwrap();
    assert_eq!(look(text, &[]).unwrap().volume.source, found(scenes.join("a.nrrd")));

    let missing = "drypoint = 1\n[volume]\nfile = \"b.nrrd\"\noutside = \"lo\"\n[picture]\nbackground = \"p.png\"\n[styles]\n\
                   theme = \"textbok\"\nwax = \"w.png\"\n";
    let faults = look(missing, &[]).unwrap_err();
    let whats: Vec<String> = faults.iter().map(|fault| fault.what()).collect();
    let gone = |name: &str| format!("{} is not there", scenes.join(name).display());
    assert_eq!(
        whats,
        [
            gone("b.nrrd"),
            "volume.outside cannot be \"lo\"".into(),
            gone("p.png"),
            "there is no theme or folder \"textbok\"".into(),
            gone("w.png"),
        ]
    );
    assert!(faults.to_string().contains("s.toml:8:1, key styles.theme\n  write \"textbook\"; there is "), "{faults}");

    let unreadable = load(&scenes.join("none.toml"), &Overrides::default()).unwrap_err().to_string();
    assert!(unreadable.starts_with("the scene cannot be read: "), "{unreadable}");
    assert!(unreadable.contains(&format!("\n  at {}\n", scenes.join("none.toml").display())), "{unreadable}");
    std::fs::remove_dir_all(&root).unwrap();
}

#[test]
fn a_themes_folder_gives_the_names_of_its_styles() {
    let folder = std::env::temp_dir().join(format!("drypoint-theme-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("pencils")).unwrap();
    std::fs::write(folder.join("pencils/soft.png"), "").unwrap();
    let text = "drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n[styles]\ntheme = \"pencils\"\n[transfer]\nnodes = [{ at = 1, \
                style = \"soft\" }, { at = 2, style = \"wax\" }]\n";
    let faults = parse(text, &folder.join("s.toml"), &Overrides::default()).unwrap_err();
    let whats: Vec<String> = faults.iter().map(|fault| format!("{}; {}", fault.what(), fault.remedy())).collect();
    assert_eq!(whats, ["there is no style \"wax\"; there is soft"]);
    std::fs::remove_dir_all(&folder).unwrap();
}

/// Items of a list of tables at the top are set and removed by their numbers; without its last item the list is absent.
#[test]
fn items_of_a_list_of_tables_have_numbers() {
    let pens = |text: &str, settings: &[(&str, &str)]| {
        let text = format!("drypoint = 1\n[volume]\nfile = \"a\"\n{text}");
        parse(&text, Path::new("s"), &settings.iter().copied().collect()).map(|scene| scene.pens)
    };
    let two = "[[pen]]\nname = \"a\"\n[[pen]]\nname = \"b\"\n";
    let base = pens(two, &[]).unwrap();
    for key in ["pen.1.width", "pen[1].width"] {
        let set = pens(two, &[(key, "2 mm")]).unwrap();
        assert_eq!((&set[0], &set[1].name, set[1].width), (&base[0], &base[1].name, Length::Millimetres(2.0)));
    }
    assert_eq!(pens(two, &[("pen.0", "off")]).unwrap(), base[1..]);
    assert_eq!(pens(two, &[("pen.0", "off"), ("pen.0", "off")]).unwrap(), []);
    let faults = |setting| pens(two, &[setting]).unwrap_err().to_string();
    let none = "there is no item 2 in a list of 2\n  at --set pen.2.width=1 mm, key pen.2.width\n  items count from 0";
    assert_eq!(faults(("pen.2.width", "1 mm")), none);
    assert!(faults(("pen.1.width", "wide")).contains("pen[1].width cannot be \"wide\""));
    assert!(pens("pen = []\n", &[]).is_err());
}

/// Overrides lead into a list that a preset supplies, as into a table.
#[test]
fn items_of_a_list_of_a_preset_have_numbers() {
    let tones = |settings: &[(&str, &str)]| {
        let text = "drypoint = 1\npreset = \"toon\"\n[volume]\nfile = \"a\"\n";
        let scene = parse(text, Path::new("s"), &settings.iter().copied().collect());
        scene.map(|scene| scene.surface.unwrap().toon.unwrap().tones).map_err(|faults| faults.to_string())
    };
    let base = tones(&[]).unwrap();
    let set = tones(&[("surface.toon.tones.1", "[0.25, \"white\"]")]).unwrap();
    assert_eq!((set.len(), set[0], set[2]), (3, base[0], base[2]));
    assert_eq!(set[1], crate::tables::Tone { at: 0.25, color: [1.0; 4] });
    let rest = tones(&[("surface.toon.tones[0]", "off"), ("surface.toon.tones[2]", "off")]).unwrap();
    assert_eq!(rest, base[1..2], "the numbers are those of the preset's list");
    let fault = tones(&[("surface.toon.tones.3", "[1, \"white\"]")]).unwrap_err();
    assert!(fault.starts_with("there is no item 3 in a list of 3\n  at --set surface.toon.tones.3="), "{fault}");
    let all = [0, 1, 2].map(|i| (format!("surface.toon.tones.{i}"), "off"));
    let all: Vec<(&str, &str)> = all.iter().map(|(key, off)| (key.as_str(), *off)).collect();
    assert!(tones(&all).unwrap_err().contains("surface.toon.tones cannot be a table"));
}

/// What a preset supplies is removed as what the file has: tables, tables in them, keys.
#[test]
fn off_removes_what_a_preset_supplies() {
    let with = |preset: &str, settings: &[(&str, &str)]| {
        let text = format!("drypoint = 1\npreset = \"{preset}\"\n[volume]\nfile = \"a.nrrd\"\n");
        parse(&text, Path::new("scene.toml"), &settings.iter().copied().collect()).unwrap()
    };
    let hatch = with("hatch", &[]);
    assert!(hatch.outlines.is_some() && hatch.hatching.as_ref().unwrap().cross.is_some());
    let scene = with("hatch", &[("outlines", "off")]);
    assert_eq!((scene.outlines.is_none(), &scene.hatching), (true, &hatch.hatching));
    let scene = with("hatch", &[("hatching.cross", "off")]);
    assert_eq!(scene.outlines, hatch.outlines);
    let (without, table) = (scene.hatching.unwrap(), hatch.hatching.unwrap());
    assert_eq!(without, crate::tables::Hatching { cross: None, ..table });
    let lit = with("hatch-fig5", &[("hatching.lighting", "off"), ("hatching.width", "1 mm")]).hatching.unwrap();
    assert_eq!((lit.lighting.is_none(), lit.width), (true, Length::Millimetres(1.0)));
    assert_eq!(lit.hidden, crate::tables::Hidden::Drawn);
    assert!(with("hatch-fig2", &[("surface.silhouette", "off")]).surface.unwrap().silhouette.is_none());
    // Off, and then on again: the table as the format has it, and not the preset's.
    let again = with("hatch-fig5", &[("hatching.lighting", "off"), ("hatching.lighting.p", "2")]);
    assert_eq!(again.hatching.unwrap().lighting, Some(crate::tables::LineLighting { p: 2.0, ..Default::default() }));
    // Tables that neither has stay away.
    assert_eq!(with("hatch", &[("shading.toon", "off"), ("stipples.lighting", "off")]), with("hatch", &[]));
    // The last preset stays off, too: the scene is then what it would be without.
    assert!(with("hatch", &[("preset", "off")]).hatching.is_none());
}
