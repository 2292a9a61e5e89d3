//! Figure files.

use crate::file::{Overrides, is_figure, parse_figure, write_full_figure};
use crate::tables::{Corner, Length, PanelCameras, PanelLetters};
use std::path::{Path, PathBuf};

const FIGURE: &str = r##"drypoint = 1
[figure]
dpi = 150
width = "90 mm"
columns = 3
gap = "6 px"
letters = "A"
camera = "shared"
title = "Title"
caption = "Caption"
size = "2.5 mm"
color = "#102030"
background = "#fffef0"
[page]
margin = "7 mm"
[[panel]]
scene = "template.toml"
volume = "head.nrrd"
set = ["camera.fov=20", "contours=off"]
caption = "skin"
columns = 2
[[panel.inset]]
scene = "head.toml"
set = ["camera.fov=5"]
corner = "top-left"
share = 0.25
[[panel.inset]]
picture = "a.png"
[[panel]]
picture = "b.exr"
"##;

#[test]
fn a_figure_is_read_and_written_back() {
    let read = |text: &str| parse_figure(text, Path::new("in/figure.toml"), &Overrides::default()).unwrap();
    let figure = read(FIGURE);
    let settings = &figure.figure;
    assert_eq!((settings.width, settings.gap), (Length::Millimetres(90.0), Length::Pixels(6.0)));
    assert_eq!((settings.letters, settings.camera), (PanelLetters::Capital, PanelCameras::Shared));
    let [first, second] = &figure.panels[..] else { panic!() };
    assert_eq!(first.source.scene.as_deref(), Some(Path::new("in/template.toml")));
    assert_eq!(first.source.set, ["camera.fov=20", "contours=off"]);
    assert_eq!((first.insets[0].corner, first.insets[0].share, first.insets[1].share), (Corner::TopLeft, 0.25, 0.35));
    assert_eq!(second.source.picture, Some(PathBuf::from("in/b.exr")));
    let tables: Vec<String> = figure.sources().into_iter().map(|(table, _)| table).collect();
    assert_eq!(tables, ["panel[0]", "panel[0].inset[0]", "panel[0].inset[1]", "panel[1]"]);
    // Paths are absolute or from the working directory, so the text is read from there.
    let again = parse_figure(&write_full_figure(&figure), Path::new("figure.toml"), &Overrides::default());
    assert_eq!(again.unwrap(), figure);
    assert!(is_figure(FIGURE) && !is_figure("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n") && !is_figure("["));
}

#[test]
fn a_panel_has_one_picture() {
    let faults = |panel: &str| {
        let text = format!("drypoint = 1\n[[panel]]\n{panel}");
        parse_figure(&text, Path::new("figure.toml"), &Overrides::default()).unwrap_err().to_string()
    };
    assert!(faults("").starts_with("panel[0].scene is missing\n"));
    assert!(faults("scene = \"a.toml\"\npicture = \"a.png\"\n").starts_with("a panel has both scene and picture\n"));
    let text = faults("picture = \"a.png\"\nset = [\"camera.fov=3\"]\n");
    assert!(text.starts_with("set changes a scene, and the panel shows a picture as it is\n"), "{text}");
    let text = parse_figure("drypoint = 1\n", Path::new("figure.toml"), &Overrides::default()).unwrap_err().to_string();
    assert!(text.starts_with("panel is missing\n"), "{text}");
}
