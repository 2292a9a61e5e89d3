//! `styles`.

use crate::folder::Folder;
use drypoint::output::read::read_image;

#[test]
fn the_embedded_theme_and_a_folder() {
    let folder = Folder::new();
    let list = folder.good("styles");
    let names: Vec<&str> = list.lines().collect();
    assert!(names.len() >= 6 && names.contains(&"wax") && names.contains(&"metal"), "{list}");
    assert_eq!(folder.good("styles --theme textbook"), list);
    folder.torus();
    std::fs::create_dir(folder.path("theme")).unwrap();
    folder.good("render torus.nrrd --size 16x16 -o theme/ball.png");
    let said = folder.line("styles --theme theme -o theme.png");
    assert_eq!((said.code, said.out.as_str(), said.err.as_str()), (Some(0), "", "theme.png\n"));
    assert!(read_image(&folder.path("theme.png")).unwrap().width > 16);
    assert_eq!(folder.good("styles --theme theme"), "ball\n");
}

#[test]
fn themes_that_cannot_be_had() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("empty")).unwrap();
    folder.write("broken/wax.png", "no picture");
    for (line, expected) in [
        (
            "--theme textbok",
            "error: no theme `textbok` (did you mean `textbook`?); the program has `textbook`, `naturalist`, `studio`\n  at: --theme textbok\n  try: name an embedded theme, or a folder of pictures\n",
        ),
        (
            "--theme empty",
            "error: the theme has no style\n  at: --theme empty\n  try: put square pictures into its folder\n",
        ),
    ] {
        assert_eq!(folder.refused(&format!("styles {line}")), expected);
    }
    let said = folder.refused("styles --theme broken -o sheet.png");
    assert!(said.starts_with("error: style `wax`: broken/wax.png: not a readable PNG, JPEG or OpenEXR: "), "{said}");
    assert!(said.ends_with("\n  at: --theme broken\n  try: give a picture in PNG, JPEG or OpenEXR\n"), "{said}");
}

#[test]
fn lighting_functions_are_listed_drawn_and_written() {
    let folder = Folder::new();
    let names = "blinn-phong\nblinn-phong-contours\ncartoon-contours\nmetal-contours\ngradient\ntone\n";
    assert_eq!(folder.good("styles lighting"), names);
    let said = folder.line("styles lighting -o sheet.png");
    assert_eq!((said.code, said.out.as_str(), said.err.as_str()), (Some(0), "", "sheet.png\n"));
    // Six pictures in two rows of three.
    let sheet = read_image(&folder.path("sheet.png")).unwrap();
    assert!(sheet.width > 3 * 240 && sheet.height > 2 * 240 && sheet.width > sheet.height);
    assert_eq!(
        folder.refused("styles lighting -o sheet.png --light 0,0,0"),
        "error: \"0,0,0\" is no direction\n  at: --light 0,0,0\n  try: write x,y,z, not all 0, such as -0.5,0.7,0.5\n"
    );
}

/// A preset's table, written and read back, draws the preset's picture within the codes of 16 bits: half a code in each of
/// s_a, s_d and s_s, and in s_α relative to a divisor of at least 1/64.
#[test]
fn a_written_table_draws_its_preset() {
    let folder = Folder::new();
    let scene = |table: &str| {
        format!(
            "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 24 }}\n[camera]\nprojection = \
             \"orthographic\"\n[picture]\nsize = [48, 40]\nsamples = 1\n[transfer]\nkind = \"regular\"\nnodes = \
             [{{ at = 90, color = \"#804020\", opacity = 0 }}, {{ at = 140, color = \"#ffcc88\", opacity = 0.5 }}]\n\
             [shading]\nmodel = \"lighting-function\"\nlight = [-0.5, 0.4, 0.7]\n{table}\n"
        )
    };
    let code = 1.0 / 65535.0;
    for preset in ["blinn-phong", "metal-contours", "gradient"] {
        folder.good(&format!("styles lighting --table {preset} --light -0.5,0.4,0.7 -o table.png"));
        folder.write("preset.toml", scene(&format!("preset = \"{preset}\"")));
        folder.write("table.toml", scene("table = \"table.png\""));
        folder.good("render preset.toml -o preset.exr");
        folder.good("render table.toml -o table.exr");
        folder.good(&format!("compare preset.exr table.exr --max {}", 32.0 * code));
        let other = folder.line("render preset.toml -o other.exr --set shading.preset=tone");
        assert_eq!(other.code, Some(0));
        assert_eq!(folder.line("compare preset.exr other.exr --max 0.01").code, Some(1), "{preset}");
    }
    // Tables that cannot be had.
    let said = folder.refused("render table.toml -o none.exr --set shading.table=none.png");
    assert!(said.starts_with("error: the lighting table none.png: "), "{said}");
    assert!(said.ends_with("\n  try: give a picture that may be read\n"), "{said}");
    folder.write("bad.png", "no picture");
    let said = folder.refused("render table.toml -o none.exr --set shading.table=bad.png");
    assert!(said.starts_with("error: the lighting table bad.png: not a readable PNG, JPEG or OpenEXR: "), "{said}");
}
