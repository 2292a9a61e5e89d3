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
        assert_eq!(folder.line(line).err, format!("{name}\n"));
        assert!(folder.path(name).is_file());
    }
}

#[test]
fn places_that_cannot_be_written_to_are_refused_before_any_work() {
    let folder = Folder::new();
    folder.torus();
    folder.scene("");
    std::fs::create_dir(folder.path("taken.png")).unwrap();
    // The volume is not even looked at.
    for (name, what) in [
        ("gone/out.png", "the picture cannot be written: No such file or directory (os error 2)"),
        ("torus.nrrd/out.png", "the picture cannot be written: Not a directory (os error 20)"),
        ("taken.png", "the picture cannot be written: it is a folder"),
    ] {
        let expected = format!(
            "error: {what}\n  at: {name}\n  try: check that the folder exists, may be written to and has room\n"
        );
        for line in ["render missing.nrrd", "render scene.toml", "styles", "sheet missing.nrrd"] {
            assert_eq!(folder.refused(&format!("{line} -o {name}")), expected);
        }
    }
    assert_eq!(
        folder.refused("phantom torus -o gone/out.nrrd"),
        "error: the volume cannot be written: No such file or directory (os error 2)\n  at: gone/out.nrrd\n  try: give a path in a folder that exists, may be written and has room\n"
    );
}

#[test]
fn suffixes_choose_the_format() {
    let folder = Folder::new();
    folder.scene("");
    let remedy = "give a name that ends in .png or .exr";
    for (name, what, remedy) in [
        ("out.svg", ".svg is for points and strokes, which are not built yet ([IO-7])", remedy),
        ("out.pdf", ".pdf is for points and strokes, which are not built yet ([IO-7])", remedy),
        ("out.jpg", ".jpg is the suffix of no picture format that is written", remedy),
        ("out", "the name has no suffix, which chooses the format of the picture", remedy),
        (
            "turn_###.png",
            "a # stands for the number of a frame, and [orbit] is not built yet ([STIP-4])",
            "give a name without #",
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
        "error: picture.layers[1] cannot be \"nomal\"\n  at: --layers Z,nomal\n  try: write \"normal\"; expected is \"beauty\", \"Z\", \"depth\", \"normal\", \"gradient\", \"curvature\", \"curvature.KV\", \"first\", \"first.normal\", \"first.curvature\", \"first.curvature.KV\" or \"counts\"\n"
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
