//! Where pictures go: default names, suffixes, layers, and places that cannot be written to.

use crate::folder::Folder;
use drypoint::output::read::read_image;

#[test]
fn the_default_name_is_the_input_s_in_the_working_directory() {
    let folder = Folder::new();
    folder.torus();
    folder.scene("");
    folder.write("sub/my.scene.toml", folder.read("scene.toml"));
    folder.write("sub/head.v2.nrrd", folder.read("torus.nrrd"));
    for (line, name) in [
        ("--size 8x8 --set volume.phantom.size=24", "drypoint.png"),
        ("sub/my.scene.toml", "my.scene.png"),
        ("render sub/head.v2.nrrd --size 8x8", "head.v2.png"),
        ("scene.toml --layers Z,normal", "scene.exr"),
    ] {
        // What is smaller than the embedded phantom lies beside its camera's view, and that is told first.
        assert_eq!(folder.line(line).err.lines().last(), Some(name));
        assert!(folder.path(name).is_file());
    }
}

#[test]
fn places_that_cannot_be_written_to_are_refused_before_any_work() {
    let folder = Folder::new();
    folder.torus();
    folder.scene("");
    std::fs::create_dir(folder.path("taken.png")).unwrap();
    std::fs::create_dir(folder.path("taken")).unwrap();
    // The volume is not even looked at.
    let a_file = "give the name of a file, such as one in that folder";
    for (name, what, remedy) in [
        (
            "gone/out.png",
            "No such file or directory (os error 2)",
            "make the folder first, or give a path in one that is there",
        ),
        ("torus.nrrd/out.png", "Not a directory (os error 20)", "give a path in a folder"),
        ("taken.png", "it is a folder", a_file),
        ("taken.png/", "it is a folder", a_file),
        ("taken", "it is a folder", a_file),
        (".", "it is a folder", a_file),
    ] {
        let expected = format!("error: the picture cannot be written: {what}\n  at: {name}\n  try: {remedy}\n");
        for line in ["render missing.nrrd", "render scene.toml", "styles", "sheet missing.nrrd"] {
            assert_eq!(folder.refused(&format!("{line} -o {name}")), expected);
        }
    }
    for (name, what, remedy) in [
        (
            "gone/out.nrrd",
            "No such file or directory (os error 2)",
            "make the folder first, or give a path in one that is there",
        ),
        ("taken", "it is a folder", a_file),
    ] {
        let expected = format!("error: the volume cannot be written: {what}\n  at: {name}\n  try: {remedy}\n");
        assert_eq!(folder.refused(&format!("phantom torus -o {name}")), expected);
    }
}

#[cfg(unix)]
#[test]
fn a_folder_without_permission_is_told_as_that() {
    use std::fs::{Permissions, set_permissions};
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new();
    folder.scene("");
    std::fs::create_dir(folder.path("locked")).unwrap();
    set_permissions(folder.path("locked"), Permissions::from_mode(0o555)).unwrap();
    // Some users may write anywhere.
    if std::fs::File::create(folder.path("locked/a")).is_ok() {
        println!("skipped: this user may write to every folder");
        return;
    }
    let expected = "error: the picture cannot be written: Permission denied (os error 13)\n  at: locked/out.png\n  try: give \
                    a path in a folder that you may write to: a file is written beside its place, then renamed\n";
    assert_eq!(folder.refused("render scene.toml -o locked/out.png"), expected);
    set_permissions(folder.path("locked"), Permissions::from_mode(0o755)).unwrap();
}

#[cfg(unix)]
#[test]
fn a_file_that_is_replaced_keeps_its_permissions_and_a_read_only_one_stays() {
    use std::fs::{Permissions, metadata, set_permissions};
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new();
    folder.scene("");
    for name in ["out.png", "out.nrrd", "list.csv"] {
        folder.write(name, "old");
        set_permissions(folder.path(name), Permissions::from_mode(0o600)).unwrap();
    }
    folder.good("-q render scene.toml -o out.png");
    folder.good("-q phantom torus --size 8 -o out.nrrd");
    folder.good("-q strokes scene.toml --set outlines.iso=128 -o list.csv");
    for name in ["out.png", "out.nrrd", "list.csv"] {
        assert_ne!(folder.read(name), b"old");
        assert_eq!(metadata(folder.path(name)).unwrap().permissions().mode() & 0o777, 0o600, "{name}");
        set_permissions(folder.path(name), Permissions::from_mode(0o444)).unwrap();
    }
    let told = |what: &str, name: &str| {
        format!(
            "error: the {what} cannot be written: the file is read-only\n  at: {name}\n  try: allow writing to this file \
             first, or give another name\n"
        )
    };
    // Before the input is even looked at.
    assert_eq!(folder.refused("render missing.nrrd -o out.png"), told("picture", "out.png"));
    assert_eq!(folder.refused("points missing.nrrd -o list.csv"), told("picture", "list.csv"));
    assert_eq!(folder.refused("phantom torus --size 8 -o out.nrrd"), told("volume", "out.nrrd"));
}

#[test]
fn names_may_be_as_long_as_the_system_allows() {
    let folder = Folder::new();
    folder.scene("");
    for length in [244, 255] {
        let name = format!("{}.png", "a".repeat(length - 4));
        folder.good(&format!("-q render scene.toml -o {name}"));
        assert_eq!(read_image(&folder.path(&name)).unwrap().width, 24);
    }
    let said = folder.refused(&format!("render scene.toml -o {}.png", "a".repeat(252)));
    assert!(said.ends_with("\n  try: give a shorter name\n"), "{said}");
}

/// No verb writes over a file that it reads, by whatever path or link.
#[cfg(unix)]
#[test]
fn inputs_are_never_overwritten() {
    let folder = Folder::new();
    folder.scene("");
    for name in ["theme", "sub"] {
        std::fs::create_dir(folder.path(name)).unwrap();
    }
    folder.good("-q render scene.toml --size 16x16 -o a.png");
    folder.write("b.png", folder.read("a.png"));
    folder.write("theme/wax.png", folder.read("a.png"));
    folder.write("dots.csv", "x,y,wx,wy,wz,radius,opacity\n10,10,0,0,0,1,1\n");
    folder.write("tone.csv", "wanted,measured\n0,0\n0.5,0.6\n0.9,1\n");
    folder.write("measured.svg", folder.read("tone.csv"));
    std::os::unix::fs::symlink(folder.path("a.png"), folder.path("link.png")).unwrap();
    let scene = String::from_utf8(folder.read("scene.toml")).unwrap();
    let behind = scene.replace("[picture]", "[picture]\nbackground = \"a.png\"");
    folder.write("behind.toml", &behind);
    folder.write("turn.toml", behind.replace("a.png", "a_1.png") + "[orbit]\nframes = 2\n");
    folder.write("a_1.png", folder.read("a.png"));
    folder.write("themed.toml", format!("{scene}[styles]\ntheme = \"theme\"\n"));
    folder.write("single.toml", format!("{scene}[styles]\nwax = \"b.png\"\n"));
    folder.write("pens.toml", format!("{scene}[stipples]\n[[pen]]\nname = \"black\"\ntone = \"tone.csv\"\n"));
    for (line, output) in [
        ("sheet a.png b.png -o", "a.png"),
        ("sheet a.png b.png -o", "link.png"),
        ("sheet link.png -o", "a.png"),
        ("sheet behind.toml -o", "a.png"),
        ("compare a.png b.png --diff", "b.png"),
        ("compare a.png b.png --diff", "sub/../a.png"),
        ("styles extract a.png --circle 8,8,5 -o", "./a.png"),
        ("styles --theme theme -o", "theme/wax.png"),
        ("render behind.toml -o", "a.png"),
        ("render turn.toml -o", "a_#.png"),
        ("render themed.toml -o", "theme/wax.png"),
        ("render single.toml -o", "b.png"),
        ("points pens.toml -o", "tone.csv"),
        ("points dots.csv -o", "dots.csv"),
        ("strokes dots.csv -o", "dots.csv"),
        ("cost behind.toml -o", "a.png"),
        ("wedge --measured measured.svg -o", "measured.svg"),
    ] {
        let place = if output == "a_#.png" { "a_1.png" } else { output };
        assert_eq!(
            folder.refused(&format!("{line} {output}")),
            format!(
                "error: this file is read too, and would be overwritten\n  at: {place}\n  try: give another name\n"
            ),
            "{line} {output}"
        );
    }
    // Beside what is read there is room.
    folder.good("-q styles --theme theme -o theme/sheet.png");
    folder.good("-q sheet a.png b.png -o c.png");
}

/// With little address space a picture is drawn or refused, and the process never aborted: neither where its channels do
/// not fit nor where they do and their encoding does not.
#[cfg(target_os = "linux")]
#[test]
fn a_picture_for_which_there_is_no_memory_is_refused() {
    let folder = Folder::new();
    // Rays along a face of the box: nearly all of them miss it at once.
    folder.scene("[camera]\nprojection = \"orthographic\"\nheight = 1e6\n");
    let render = |line: &str| {
        let limited = format!("ulimit -v 400000 && exec \"$0\" -q render scene.toml --threads 1 {line}");
        let mut command = std::process::Command::new("sh");
        command.arg("-c").arg(limited).arg(env!("CARGO_BIN_EXE_drypoint"));
        let said = command.current_dir(folder.path("")).env("DRYPOINT_DATA", "").output().unwrap();
        (said.status.code(), String::from_utf8(said.stderr).unwrap())
    };
    let (code, err) =
        render("--size 32768x32768 --set picture.samples=1 --layers normal,curvature,depth,gradient -o a.exr");
    let what = "error: a picture of 32768 × 32768 pixels needs 192.00 GiB of memory, ";
    assert!(code == Some(2) && err.starts_with(what) && err.contains("smaller, or ask for fewer layers: "), "{err}");
    let sides = [500, 1000, 1400, 1700, 2000, 2400, 3000, 4000];
    let codes = sides.map(|side| {
        let (code, err) = render(&format!("--size {side}x{side} --set picture.samples=1 -o a.png"));
        assert!(matches!(code, Some(0 | 2)) && (code == Some(0)) == err.is_empty(), "{side}: {code:?}\n{err}");
        code
    });
    assert_eq!((codes[0], codes[7]), (Some(0), Some(2)), "{codes:?}");
}

#[test]
fn suffixes_choose_the_format() {
    let folder = Folder::new();
    folder.scene("");
    let (pictures, sheets) =
        ("give a name that ends in .png or .exr", "give a name that ends in .png, .exr, .svg, .pdf, .gif or .apng");
    for (name, what, remedy) in [
        ("out.svg", ".svg is for points, lines and annotations, and the scene has none", pictures),
        ("out.pdf", ".pdf is for points, lines and annotations, and the scene has none", pictures),
        ("out.csv", ".csv is for lists of points, which `drypoint points` writes", sheets),
        ("out.jpg", ".jpg is the suffix of no picture format that is written", sheets),
        ("out", "the name has no suffix, which chooses the format of the picture", sheets),
        (
            "turn_###.png",
            "a # stands for the number of a frame, and the scene has no [orbit]",
            "add a table [orbit], or give a name without #",
        ),
    ] {
        let expected = format!("error: {what}\n  at: {name}\n  try: {remedy}\n");
        assert_eq!(folder.refused(&format!("render scene.toml -o {name}")), expected);
    }
    for line in ["styles -o out.exr", "sheet scene.toml -o out.exr"] {
        let expected = "error: this picture is written as PNG\n  at: out.exr\n  try: give a name that ends in .png\n";
        assert_eq!(folder.refused(line), expected);
    }
}

#[test]
fn layers_belong_to_an_exr() {
    let folder = Folder::new();
    folder.scene("");
    assert_eq!(
        folder.refused("render scene.toml --layers Z -o out.png"),
        "error: a PNG has no layers, and --layers asks for some\n  at: out.png\n  try: give a name that ends in .exr, or leave --layers out\n"
    );
    assert_eq!(
        folder.refused("render scene.toml --layers Z,nomal"),
        "error: picture.layers[1] cannot be \"nomal\"\n  at: --layers Z,nomal\n  try: write \"normal\"; expected is \"beauty\", \"Z\", \"depth\", \"normal\", \"gradient\", \"curvature\", \"curvature.KV\", \"first\", \"first.normal\", \"first.curvature\", \"first.curvature.KV\" or \"counts\", or \"haloN\", N the place of one of [[halo]], from 0, or \"partN\", N the place of a part, 0 the background\n"
    );
    folder.good("render scene.toml --layers beauty,Z,curvature,counts -o all.exr");
    let image = read_image(&folder.path("all.exr")).unwrap();
    assert_eq!((image.width, image.height), (24, 16));
    for channel in ["R", "A", "Z", "curvature.K1", "curvature.KV", "counts.SAMPLES"] {
        assert!(image.channel(channel).is_some(), "{channel}");
    }
}

#[test]
fn layers_that_a_png_does_not_hold_are_not_computed() {
    let folder = Folder::new();
    folder.scene("[sampling]\nkernel = \"bspline\"\n");
    let hessians = |line: &str| {
        let stats: serde_json::Value = serde_json::from_str(&folder.good(line)).unwrap();
        stats["hessians"].as_u64().unwrap()
    };
    let layers = "--set picture.layers=[\"Z\",\"curvature\"]";
    assert!(hessians(&format!("render scene.toml --stats -o a.exr {layers}")) > 0);
    assert_eq!(hessians(&format!("render scene.toml --stats -o a.png {layers}")), 0);
    folder.good("render scene.toml -o b.png");
    assert_eq!(folder.read("a.png"), folder.read("b.png"), "and the picture is the same");
}

#[test]
fn sixteen_bits_and_no_background() {
    let folder = Folder::new();
    folder.scene("");
    folder.good("render scene.toml --set picture.bits=16 --set picture.background=none -o a.png");
    // IHDR: bit depth 16, colour type RGBA.
    assert_eq!(folder.read("a.png")[24..26], [16, 6]);
    let image = read_image(&folder.path("a.png")).unwrap();
    assert_eq!(image.channel("A").unwrap()[0], 0.0, "nothing in the corner");
}

#[test]
fn the_metadata_say_program_scene_and_plan_but_no_date() {
    let folder = Folder::new();
    folder.scene("");
    folder.good("render scene.toml -o a.png");
    let bytes = folder.read("a.png");
    let mut texts = Vec::new();
    let (mut at, mut names) = (8, Vec::new());
    while at < bytes.len() {
        let length = u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        let name = &bytes[at + 4..at + 8];
        if name == b"iTXt" {
            // Keyword, two bytes for compression, language, translated keyword, text; zeros between.
            let text = String::from_utf8(bytes[at + 8..at + 8 + length].to_vec()).unwrap();
            texts.push((text.split('\0').next().unwrap().to_owned(), text.rsplit('\0').next().unwrap().to_owned()));
        }
        names.push(String::from_utf8(name.to_vec()).unwrap());
        at += 12 + length;
    }
    assert!(names.iter().all(|name| name != "tIME"));
    let [(software, program), (scene, hash), (plan, needs)] = &texts[..] else { panic!("{texts:?}") };
    assert_eq!([software, scene, plan], ["Software", "Drypoint scene", "Drypoint plan"]);
    assert_eq!(program, concat!("drypoint ", env!("CARGO_PKG_VERSION")));
    // SHA-256 in hexadecimal digits.
    assert!(hash.len() == 64 && hash.bytes().all(|b| b.is_ascii_hexdigit()), "{hash}");
    assert!(needs.contains("\nstyles: gradient, because of transfer.kind\n"), "{needs}");
}
