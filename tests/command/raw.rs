//! Volumes without a header.

use crate::folder::Folder;

/// 8×6×4 voxels of 16 bits, highest byte first, behind 5 bytes of something else.
fn folder() -> Folder {
    let folder = Folder::new();
    let mut bytes = b"intro".to_vec();
    for i in 0..8 * 6 * 4u16 {
        bytes.extend((i % 8 * 100).to_be_bytes());
    }
    folder.write("a.raw", bytes);
    folder
}

const LAYOUT: &str = "size = [8, 6, 4]\ntype = \"u16\"\nendian = \"big\"\nspacing = [1, 2, 3]\nskip = 5\n";

#[test]
fn a_sidecar_and_a_key_say_the_same() {
    let folder = folder();
    folder.write(
        "scene.toml",
        format!(
            "drypoint = 1\n[volume]\nfile = \"a.raw\"\nraw = {{ {} }}\n[picture]\nsize = [16, 16]\n",
            LAYOUT.trim().replace('\n', ", ")
        ),
    );
    folder.good("render scene.toml -o key.exr --layers beauty,first");
    folder.write("a.raw.toml", LAYOUT);
    folder.good("render scene.toml --set volume.raw=off -o sidecar.exr --layers beauty,first");
    let compared = folder.line("compare key.exr sidecar.exr --max 0");
    assert_eq!(compared.code, Some(0), "{}", compared.out);
    folder.good("render a.raw --size 16x16");
    let info: serde_json::Value = serde_json::from_str(&folder.good("info a.raw --json")).unwrap();
    assert_eq!(info["dims"], serde_json::json!([8, 6, 4]));
    assert_eq!(info["spacing"], serde_json::json!([1.0, 2.0, 3.0]));
    assert_eq!(info["range"], serde_json::json!([0.0, 700.0]));
}

/// `--raw` is `--set volume.raw` and a sidecar, for every verb that reads one volume.
#[test]
fn a_flag_says_the_same_as_a_sidecar() {
    let folder = folder();
    let layout = LAYOUT.trim().replace('\n', ", ");
    folder.write("b.dat", folder.read("a.raw"));
    folder.write("a.raw.toml", LAYOUT);
    folder.good("render a.raw --size 12x16 -o sidecar.exr --layers beauty,first");
    let run = |words: &[&str]| {
        let said = folder.run(words);
        assert_eq!(said.code, Some(0), "{words:?}\n{}", said.err);
        said.out
    };
    let to = |name| ["--size", "12x16", "--layers", "beauty,first", "-o", name];
    run(&[&["render", "b.dat", "--raw", &layout], &to("flag.exr")[..]].concat());
    run(&[&["render", "b.dat", "--set", &format!("volume.raw={{ {layout} }}")], &to("set.exr")[..]].concat());
    for other in ["flag", "set"] {
        let compared = folder.line(&format!("compare sidecar.exr {other}.exr --max 0"));
        assert_eq!(compared.code, Some(0), "{}", compared.out);
    }
    let histogram = |text: String| serde_json::from_str::<serde_json::Value>(&text).unwrap()["histogram"].clone();
    let sidecar = histogram(run(&["info", "a.raw", "--json"]));
    assert!(sidecar.is_object() || sidecar.is_array());
    assert_eq!(histogram(run(&["info", "b.dat", "--raw", &layout, "--json"])), sidecar);
    let probed = run(&["probe", "b.dat", "--raw", &layout, "--at", "2,2,3"]);
    assert_eq!(probed, run(&["probe", "a.raw", "--at", "2,2,3"]));
    let said = folder.run(["info", "b.dat", "--raw", "size = [8, 6, 4], kind = 3"]);
    assert_eq!(said.code, Some(2));
    assert!(said.err.contains("--raw size = [8, 6, 4], kind = 3"), "{}", said.err);
}

#[test]
fn any_suffix_may_have_a_sidecar() {
    let folder = folder();
    folder.write("a.dat", folder.read("a.raw"));
    folder.write("a.dat.toml", LAYOUT);
    folder.good("render a.dat --size 8x8");
    assert!(folder.path("a.png").is_file());
}

#[test]
fn layouts_that_do_not_fit() {
    let folder = folder();
    assert_eq!(
        folder.refused("render a.raw"),
        "error: raw voxels without a description of their layout\n  at: a.raw\n  try: open the header that belongs to it, or describe it in a.raw.toml, with --raw or as volume.raw: size, type, endian, spacing and skip\n"
    );
    folder.write("a.raw.toml", LAYOUT.replace("4]", "5]"));
    assert_eq!(
        folder.refused("render a.raw"),
        "error: the data are too short: found 384 bytes, expected 480\n  at: a.raw, field size of a.raw.toml\n  try: get the file again, or correct the sizes and the type in the layout\n"
    );
    let said = folder.run(["info", "a.raw", "--raw", "size = [8, 6, 5], type = \"u16\", skip = 5"]);
    assert_eq!(
        said.err,
        "error: the data are too short: found 384 bytes, expected 480\n  at: a.raw, field size of its layout\n  try: get the file again, or correct the sizes and the type in the layout\n"
    );
    folder.write("a.raw.toml", LAYOUT.replace("u16", "short"));
    assert_eq!(
        folder.refused("info a.raw"),
        "error: found `short`, expected one of u8, i8, u16, i16, u32, i32, u64, i64, f32, f64\n  at: a.raw.toml, field type\n  try: correct the layout\n"
    );
    folder.write("a.raw.toml", LAYOUT.replace("skip", "offset"));
    assert_eq!(
        folder.refused("info a.raw"),
        "error: the description of raw voxels is not valid: unknown field `offset`, expected one of `size`, `type`, `endian`, `spacing`, `skip`\n  at: a.raw.toml, line 5\n  try: correct the layout\n"
    );
}

/// The error of a `--raw` that is no table shows one.
#[test]
fn a_layout_without_brackets_is_shown_the_right_form() {
    let folder = folder();
    for (keys, what) in [
        ("size=8,6,4", "this is no layout: size has no brackets, and type is missing"),
        ("size=8,6,4, type=\"u16\"", "this is no layout: size has no brackets"),
        ("8,6,4", "this is no layout: size is missing"),
        ("size = [8, 6, 4], type = u16", "this is no layout: type = u16 needs quotes, as in type = \"u16\""),
        (
            "size=[8,6,4],type=\"u16\",endian=big",
            "this is no layout: endian = big needs quotes, as in endian = \"big\"",
        ),
    ] {
        let form = "write --raw 'size = [256, 256, 113], type = \"i16\"', with size and type of these voxels";
        let expected = format!("error: {what}\n  at: --raw {keys}\n  try: {form}\n");
        for line in [&["info", "a.raw"][..], &["render", "a.raw"], &["probe", "a.raw", "--at", "1,1,1"]] {
            let said = folder.run([line, &["--raw", keys]].concat());
            assert_eq!((said.code, said.err), (Some(2), expected.clone()), "{line:?}");
        }
    }
    let said = folder.run(["info", "a.raw", "--raw", "size = [8, 6, 4]"]);
    assert!(said.err.starts_with("error: volume.raw.type is missing\n"), "{}", said.err);
}
