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
