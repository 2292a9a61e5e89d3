//! Annotated pages as poppler reads them: labels are text, and no two lie on each other.

use crate::outside::run;
use drypoint::drawing::Drawing;
use drypoint::job::Job;
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse};
use std::path::Path;

/// A phantom with a box, an arrow, a fan, labels, a scale bar and letters.
const SCENE: &str = r##"drypoint = 1
[volume]
phantom = { name = "specimen", size = 32 }
[picture]
width = "100 mm"
height = "80 mm"
dpi = 60
background = "white"
[camera]
projection = "orthographic"
height = 90
[transfer]
kind = "regular"
nodes = [{ at = 60, color = "#c08040", opacity = 0 }, { at = 200, color = "#4080c0", opacity = 0.4 }]
[[object]]
name = "Größe"
value = [[150, 0], [170, 1]]
move = [0, 0, 22]
[[box]]
[[arrow]]
ends = "box"
[[fan]]
shape = "circle"
[labels]
size = "3.2 mm"
[scale_bar]
[orientation]
triad = true
[[label]]
object = "Größe"
[[label]]
at = [4, 4, 4]
text = "first & last"
[[label]]
at = [28, 20, 10]
text = "Zweites Ding"
[[label]]
pixel = [118, 94]
text = "picked"
"##;

/// Writes the page and returns the notes.
fn write(text: &str, path: &Path) -> Vec<String> {
    let scene = parse(text, Path::new("scene.toml"), &Overrides::default()).unwrap();
    let job = Job::load(scene).unwrap();
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_| ()).unwrap();
    let (frame, _) = Drawing::new(&job, &marking, &mut counts).unwrap().frame(0, &|_| ()).unwrap();
    frame.write(&job, path).unwrap().notes
}

#[test]
fn labels_are_text_and_lie_apart() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(write(SCENE, &folder.path().join("a.pdf")), [""; 0]);
    let Some(said) = run("pdftotext", Some("poppler-utils"), &["-bbox", "a.pdf", "-"], folder.path()) else { return };
    // Each word with its box: xMin, yMin, xMax, yMax.
    let words: Vec<(String, [f64; 4])> = said
        .lines()
        .filter_map(|line| {
            let (attributes, word) = line.trim().strip_prefix("<word ")?.split_once('>')?;
            let mut numbers = attributes.split('"').skip(1).step_by(2).map(|number| number.parse().unwrap());
            let ends = std::array::from_fn(|_| numbers.next().unwrap());
            Some((word.trim_end_matches("</word>").to_owned(), ends))
        })
        .collect();
    for word in ["Größe", "first", "&amp;", "last", "Zweites", "Ding", "picked", "20", "mm", "x", "y", "z", "−y"] {
        assert!(words.iter().any(|(said, _)| said == word), "{word}: {words:?}");
    }
    for (i, (a, [left, top, right, bottom])) in words.iter().enumerate() {
        for (b, other) in &words[..i] {
            let apart = *right <= other[0] || other[2] <= *left || *bottom <= other[1] || other[3] <= *top;
            assert!(apart, "{a:?} lies on {b:?}");
        }
    }
}

/// SVG and PNG have the same page; a scene with the same volume and no annotations has none of it.
#[test]
fn every_format_takes_annotations() {
    let folder = tempfile::tempdir().unwrap();
    let [svg, png] = ["a.svg", "a.png"].map(|name| folder.path().join(name));
    write(SCENE, &svg);
    write(SCENE, &png);
    let text = std::fs::read_to_string(&svg).unwrap();
    for part in [">Zweites Ding</text>", ">first &amp; last</text>", "-arrow ", "-fan ", "-fan area ", "-scale bar "] {
        assert!(text.contains(part), "{part}");
    }
    let plotter = SCENE.replace("[camera]", "[page]\nmargin = \"5 mm\"\nplotter = true\n[camera]");
    write(&plotter, &svg);
    let text = std::fs::read_to_string(&svg).unwrap();
    assert!(!text.contains("<text") && text.contains("-labels "));
}

#[test]
fn labels_without_room_and_missing_characters_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let close = SCENE.replace("height = 90", "height = 30");
    let notes = write(&close, &folder.path().join("a.png"));
    assert!(notes.iter().any(|note| note.ends_with("there is no room for it in the picture")), "{notes:?}");
    let strange = write(&SCENE.replace("picked", "picked \u{732b}"), &folder.path().join("a.png"));
    // The box is wider than the letters, and the label may meet another one.
    let last = strange.last().map(String::as_str);
    assert_eq!(last, Some("boxes stand for the characters \"\u{732b}\", which the letters lack"));
}
