use super::*;
use drypoint_scene::file::{Overrides, parse, parse_figure};

/// A sphere with a scale bar.
const LABELLED: &str = r##"drypoint = 1
[volume]
phantom = { name = "sphere", size = 24 }
[camera]
projection = "orthographic"
height = 60
direction = [0, 1, 0]
[picture]
size = [60, 60]
[transfer]
nodes = [{ at = 90, style = "wax", opacity = 0 }, { at = 160, style = "wax", opacity = 1 }]
[scale_bar]
corner = "bottom-left"
"##;

/// The marks of a panel of 60 mm with an inset in a corner, and the figure's notes.
fn drawn(corner: &str, layout: &str) -> (DrawnPanel, Marks, Vec<String>, Vec<[DVec2; 2]>) {
    let text = format!(
        "drypoint = 1\n[figure]\nwidth = \"60 mm\"\ndpi = 30\ncolumns = 1\n[[panel]]\nscene = \"a.toml\"\n\
         [[panel.inset]]\nscene = \"b.toml\"\nshare = 0.4\ncorner = {corner:?}\n"
    );
    let figure = parse_figure(&text, Path::new("figure.toml"), &Overrides::default()).unwrap();
    let page = FigureLayout::new(&figure, &[[1, 1]; 2]).unwrap();
    let place = page.places()[0];
    let labels = (0..6).map(|i| {
        let at = [6 + i % 2 * 12, 12, 4 + i / 2 * 8];
        format!("[[label]]\ntext = \"label {i}\"\nat = {at:?}\n")
    });
    let scene = format!("{LABELLED}[labels]\nlayout = {layout:?}\n{}", labels.collect::<String>());
    let mut scene = parse(&scene, Path::new("a.toml"), &Overrides::default()).unwrap();
    page.fit(&mut scene, &place);
    let panel = DrawnPanel::draw(&Job::load(scene).unwrap(), &page, &place, None, &|_| ()).unwrap();
    let (_, marks, notes) = page.compose(vec![panel.clone(), DrawnPanel::default()]).unwrap();
    (panel, marks, notes, page.insets_on(&place))
}

fn texts(marks: &Marks) -> Vec<&Text> {
    marks.layers.iter().flat_map(|layer| &layer.texts).collect()
}

/// Labels stand beside an inset wherever it is.
#[test]
fn labels_stand_beside_insets() {
    for layout in ["hull", "columns"] {
        let mut places = Vec::new();
        for corner in ["top-left", "top-right", "bottom-right"] {
            let (panel, marks, notes, insets) = drawn(corner, layout);
            let own = panel.marks.unwrap();
            let labels: Vec<&Text> = texts(&own).into_iter().filter(|text| text.characters.contains("label")).collect();
            assert!(labels.len() >= 3, "{layout} {corner}: {:?}", panel.notes);
            for text in &labels {
                let ([start, end], [low, high]) = (corners_of(text), insets[0]);
                assert!(start.cmpge(high).any() || end.cmple(low).any(), "{layout} {corner}: {text:?}");
            }
            // The figure has all of them, in order, and tells nothing.
            assert_eq!((texts(&marks).len(), notes), (texts(&own).len() + 1, Vec::new()), "{layout} {corner}");
            places.push(labels.iter().map(|text| text.at.to_array()).collect::<Vec<_>>());
        }
        assert_ne!(places[0], places[1]);
    }
}

/// Scale bars stand beside an inset, too.
#[test]
fn the_margin_stands_beside_insets() {
    let (panel, marks, notes, insets) = drawn("bottom-left", "columns");
    let own = panel.marks.unwrap();
    let bar = texts(&own).into_iter().find(|text| text.characters.contains("mm")).unwrap();
    let ([start, end], [low, high]) = (corners_of(bar), insets[0]);
    assert!(start.cmpge(high).any() || end.cmple(low).any(), "{bar:?}");
    assert!(texts(&marks).iter().any(|text| text.characters == bar.characters) && notes.is_empty(), "{notes:?}");
}

/// The text of an inset that a later inset of its corner covers is told.
#[test]
fn what_an_inset_covers_is_told() {
    let inset = "[[panel.inset]]\nscene = \"a.toml\"\nshare = 0.4\n";
    let text = format!("drypoint = 1\n[figure]\nwidth = \"60 mm\"\n[[panel]]\nscene = \"a.toml\"\n{inset}{inset}");
    let figure = parse_figure(&text, Path::new("figure.toml"), &Overrides::default()).unwrap();
    let page = FigureLayout::new(&figure, &[[1, 1]; 3]).unwrap();
    let text = Text { characters: "covered".into(), at: DVec2::splat(5.0), size: 2.0, opacity: 1.0 };
    let layer = Layer { texts: vec![text], ..Layer::new(page.pen()) };
    let written = DrawnPanel { marks: Some(Marks { page: page.page, layers: vec![layer] }), ..DrawnPanel::default() };
    let (_, marks, notes) = page.compose(vec![DrawnPanel::default(), written, DrawnPanel::default()]).unwrap();
    assert!(texts(&marks).iter().all(|text| text.characters != "covered"));
    assert_eq!(notes, ["panel[0]: the text \"covered\" is left out: an inset lies over it"]);
}
