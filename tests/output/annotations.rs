//! Annotated pages as poppler reads them: labels are text, and no two lie on each other.

use crate::outside::run;
use drypoint::drawing::{Drawing, Frame};
use drypoint::job::Job;
use drypoint::marking::Marking;
use drypoint::output::text::font::{cap_height, extent};
use drypoint::reference::style_transfer_functions::SphereMap;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::glam::DVec2;
use drypoint::scene::picture::Picture;
use drypoint::scene::source::Disk;
use drypoint::scene::style::Theme;
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
    let (job, frame) = drawn(text);
    frame.write(&job, path).unwrap().notes
}

/// Draws a frame.
fn drawn(text: &str) -> (Job, Frame) {
    let scene = parse(text, Path::new("scene.toml"), &Overrides::default()).unwrap();
    let job = Job::load(scene).unwrap();
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_| ()).unwrap();
    let frame = Drawing::new(&job, &marking, &mut counts).unwrap().frame(0, &|_| ()).unwrap().0;
    (job, frame)
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

/// An arrow and a fan of an object are those of tables from its ghost to its selection.
#[test]
fn an_object_has_its_arrow_and_its_fan() {
    let bare = SCENE.replace("[[arrow]]\nends = \"box\"\n[[fan]]\nshape = \"circle\"\n", "");
    let own = bare.replace("move = [0, 0, 22]\n", "move = [0, 0, 22]\narrow = true\nfan = true\n");
    let ends = "from = \"Größe ghost\"\nto = \"Größe\"\n";
    let tables = format!("{bare}[[arrow]]\noccluded = false\n{ends}[[fan]]\n{ends}");
    let [own, tables, bare] = [&own, &tables, &bare].map(|text| drawn(text).1);
    assert_eq!((own.picture, own.marks), (tables.picture, tables.marks.clone()));
    assert_ne!(tables.marks, bare.marks);
}

/// A phantom in two styles, with a legend.
const LEGEND: &str = r##"drypoint = 1
[volume]
phantom = { name = "specimen", size = 24 }
[picture]
size = [240, 180]
dpi = 200
background = "#f0e8d8"
layers = ["beauty", "Z"]
[transfer]
nodes = [{ at = 60, style = "wax", opacity = 0 }, { at = 200, style = "wax", opacity = 0.4 }, { at = 250, style = "metal" }]
[legend]
title = "Tissues"
size = "2 mm"
"##;

/// The texts of the legend of a frame.
fn texts(frame: &Frame) -> Vec<&str> {
    let layers = frame.marks.iter().flat_map(|marks| &marks.layers);
    layers.flat_map(|layer| &layer.texts).map(|text| text.characters.as_str()).collect()
}

#[test]
fn a_legend_covers_its_spheres_and_its_letters_alone() {
    let (job, frame) = drawn(LEGEND);
    let without = LEGEND.replace("[legend]\ntitle = \"Tissues\"\nsize = \"2 mm\"\n", "");
    let (bare_job, bare) = drawn(&without);
    assert_eq!(texts(&frame), ["Tissues", "wax", "metal"]);
    assert_eq!(bare.marks, None);
    let letters = frame.marks.clone().unwrap();
    let [with, bare] = [frame.painted(&job).unwrap(), bare.painted(&bare_job).unwrap()];
    // Other layers stay as they are.
    assert_eq!(with.layers[1], bare.layers[1]);
    let pixel = |picture: &Picture, x: usize, y: usize| -> [f64; 4] {
        std::array::from_fn(|c| picture.layers[0].channels[c][y * picture.width + x])
    };
    // The rectangles around letters, and around the spheres to the left of all names, in pixels.
    let scale = 200.0 / 25.4;
    let (mut covered, mut spheres): (Vec<[f64; 4]>, Vec<[f64; 2]>) = Default::default();
    for text in letters.layers.iter().flat_map(|layer| &layer.texts) {
        let extent = extent(&text.characters, text.size);
        let [lo, hi] = [text.at.y - extent.ascent, text.at.y + extent.descent].map(|y| y * scale);
        covered.push([text.at.x * scale - 2.0, lo - 1.0, (text.at.x + extent.advance) * scale + 2.0, hi + 1.0]);
        if text.characters != "Tissues" {
            // A sphere is as high as two sizes of the text, and its centre at half the height of a capital.
            let centre = [text.at.x - 1.6 * text.size, text.at.y - 0.35 * text.size].map(|mm| mm * scale);
            let reach = text.size * scale + 1.0;
            covered.push([centre[0] - reach, centre[1] - reach, centre[0] + reach, centre[1] + reach]);
            spheres.push(centre);
        }
    }
    let mut changed = 0;
    for (x, y) in (0..240 * 180).map(|i| (i % 240, i / 240)) {
        let at = [x as f64 + 0.5, y as f64 + 0.5];
        let is_covered = covered.iter().any(|[l, t, r, b]| (*l..*r).contains(&at[0]) && (*t..*b).contains(&at[1]));
        let is_changed = pixel(&with, x, y) != pixel(&bare, x, y);
        assert!(is_covered || !is_changed, "{x}, {y}");
        changed += usize::from(is_changed);
    }
    assert!(changed > 1000, "{changed}");
    // The middle of a sphere has the style's colour where it faces the eye.
    let theme = Theme::open(&Disk, &job.scene.styles.theme).unwrap();
    for (centre, name) in spheres.iter().zip(["wax", "metal"]) {
        let style = theme.style(&Disk, name).unwrap().unwrap();
        let [x, y] = centre.map(|c| c as usize);
        let expected = SphereMap::new(&style).sample(0.0, 0.0);
        let found = pixel(&with, x, y);
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.01), "{name}: {found:?} {expected:?}");
    }
}

#[test]
fn a_legend_has_the_names_that_are_given() {
    let scene = LEGEND.replace("title = \"Tissues\"", "names = [\"\", \"bone\"]");
    let (_, frame) = drawn(&scene);
    assert_eq!(texts(&frame), ["bone"]);
    // An automatic function has its rows with the data.
    let start = scene.find("[transfer]").unwrap();
    let automatic =
        format!("{}[legend]\nnames = [\"a\", \"b\", \"c\", \"d\", \"e\", \"f\", \"g\", \"h\"]\n", &scene[..start]);
    let job = Job::load(parse(&automatic, Path::new("s.toml"), &Overrides::default()).unwrap()).unwrap();
    let marking = Marking::new(&job, &mut Counts::default(), &|_| ()).unwrap();
    let failure = Drawing::new(&job, &marking, &mut Counts::default()).err().unwrap();
    assert!(failure.what.starts_with("legend.names has 8 names, and the legend has "), "{failure}");
    assert!(failure.place.ends_with("key legend.names"), "{failure}");
}

/// Colours are circles of their own colour, in vectors too; a plotter draws empty ones.
#[test]
fn colours_of_a_legend_are_areas() {
    let scene =
        LEGEND.replace("style = \"wax\"", "color = \"#c08040\"").replace("style = \"metal\"", "color = \"#fff\"");
    let scene = scene.replace("[transfer]", "[transfer]\nkind = \"regular\"");
    let (_, frame) = drawn(&scene);
    assert_eq!(texts(&frame), ["Tissues", "200", "250"]);
    let legend = &frame.marks.as_ref().unwrap().layers[0];
    assert_eq!([legend.areas.len(), legend.lines.len()], [2, 2]);
    let (_, plotted) = drawn(&LEGEND.replace("[legend]", "[page]\nplotter = true\n[legend]"));
    let legend = &plotted.marks.as_ref().unwrap().layers[0];
    assert_eq!([legend.areas.len(), legend.lines.len()], [0, 2]);
    assert!(plotted.notes[0].starts_with("the legend has circles"), "{:?}", plotted.notes);
    let (_, small) = drawn(&LEGEND.replace("2 mm", "3 mm"));
    // A legend without room is left out whole.
    assert!(small.notes[0].starts_with("the legend is left out: it has no room"), "{:?}", small.notes);
    assert!(texts(&small).is_empty());
}

/// Each thing of the margin, its texts and lines as rectangles. Lines of a triad begin at one point, and count together.
fn extents(frame: &Frame) -> Vec<(String, [DVec2; 2])> {
    let mut found = Vec::new();
    for layer in frame.marks.iter().flat_map(|marks| &marks.layers) {
        found.extend(layer.texts.iter().map(|text| {
            let high = DVec2::new(0.0, cap_height(text.size));
            let wide = DVec2::new(extent(&text.characters, text.size).advance, 0.0);
            (text.characters.clone(), [text.at - high, text.at + wide])
        }));
        let vertices = layer.lines.iter().flat_map(|line| &line.vertices);
        let ends = vertices.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[lo, hi], vertex| {
            [lo.min(vertex.at - vertex.radius), hi.max(vertex.at + vertex.radius)]
        });
        found.extend((!layer.lines.is_empty()).then(|| (layer.pen.name.clone(), ends)));
    }
    found
}

/// A page of 100 mm × 80 mm whose height is 90 units of the world, with a margin.
fn with_margin(corners: [&str; 3], legend: &str, bar: &str) -> String {
    let head = SCENE[..SCENE.find("[[object]]").unwrap()].replace("dpi = 60", "dpi = 10");
    let [a, b, c] = corners;
    format!(
        "{head}[legend]\ncorner = \"{a}\"\n{legend}[scale_bar]\ncorner = \"{b}\"\n{bar}[orientation]\ntriad = true\ncorner = \"{c}\"\n"
    )
}

/// Whatever stands in which corner, nothing lies on another thing or leaves the picture.
#[test]
fn things_in_the_margin_lie_apart() {
    let corners = ["top-left", "top-right", "bottom-left", "bottom-right"];
    let mut left_out = 0;
    for i in 0..64 {
        let corners = [0, 1, 2].map(|digit| corners[i >> (2 * digit) & 3]);
        for legend in ["", "size = \"6 mm\"\n", "size = \"3 mm\"\nnames = [\"the skin and the fat below it\"]\n"] {
            let frame = drawn(&with_margin(corners, legend, "size = \"4 mm\"\n")).1;
            let found = extents(&frame);
            for (k, (a, [lo, hi])) in found.iter().enumerate() {
                assert!(lo.cmpge(DVec2::ZERO).all() && hi.cmple(DVec2::new(100.0, 80.0)).all(), "{a} {corners:?}");
                for (b, [low, high]) in &found[..k] {
                    let apart = !(lo.cmplt(*high).all() && low.cmplt(*hi).all());
                    // A triad's letters lie beside its axes.
                    assert!(apart || b == "orientation" || a == "orientation", "{a} lies on {b}: {corners:?} {legend}");
                }
            }
            // A row, a bar with its text, four letters, and a triad.
            let missing = frame.notes.len();
            left_out += missing;
            assert!(missing > 0 || found.len() >= 2 + 2 + 4 + 4, "{found:?}");
        }
    }
    assert!((1..64).contains(&left_out), "{left_out}");
}

/// A scale bar has exactly the length that its text says, or there is none and a note tells so.
#[test]
fn a_scale_bar_has_its_length_or_is_left_out() {
    let long = format!("unit = \"{}\"\n", "µ".repeat(60));
    let bars = [
        ("", 1),
        ("length = 80\n", 1),
        ("length = 104\n", 1),
        ("length = 109\n", 0),
        ("length = 1000\n", 0),
        ("length = 1e300\n", 0),
        ("length = 1e-5\n", 0),
        ("length = 5\nwidth = \"6 mm\"\n", 0),
        (&long, 0),
    ];
    for (bar, expected) in bars {
        let orthographic = with_margin(["top-left", "bottom-left", "top-right"], "", bar);
        let perspective = orthographic.replace("\"orthographic\"\nheight = 90", "\"perspective\"");
        assert_ne!(orthographic, perspective);
        for text in [orthographic, perspective] {
            let (job, frame) = drawn(&text);
            let view = job.view().unwrap();
            let said = texts(&frame)
                .into_iter()
                .find_map(|text| text.split(' ').next()?.parse::<f64>().ok().filter(|_| text.contains("mm")));
            let layers = frame.marks.iter().flat_map(|marks| &marks.layers);
            let drawn: Vec<f64> = layers
                .filter(|layer| layer.pen.name == "scale bar")
                .flat_map(|layer| &layer.lines)
                .map(|line| line.vertices[1].at.x - line.vertices[0].at.x + 2.0 * line.vertices[0].radius)
                .collect();
            let notes = frame.notes.iter().filter(|note| note.starts_with("the scale bar is left out: it ")).count();
            assert_eq!((drawn.len(), notes), (said.iter().count(), 1 - said.iter().count()), "{bar} {:?}", frame.notes);
            assert!(view.perspective || drawn.len() == expected, "{bar} {:?}", frame.notes);
            // The length across the view axis at the target, on a page 100 mm wide.
            let middle = job.volume.grid().centre();
            for (mm, length) in drawn.iter().zip(said) {
                let [from, to] = [-0.5, 0.5].map(|way| view.point_of(middle + view.right * (way * length)).unwrap()[0]);
                assert!((mm - (to - from) * 100.0 / view.size[0] as f64).abs() < 0.01, "{bar}: {mm}");
            }
        }
    }
    // A narrow picture has no room for the words on perspective. A target behind the eye has no scale.
    let scene = |eye: &str, unit: &str| {
        format!(
            "drypoint = 1\n[volume]\nphantom = {{ name = \"specimen\", size = 16 }}\n[picture]\nsize = [100, 100]\ndpi = 100\n\
            [camera]\n{eye}[scale_bar]\nsize = \"1.5 mm\"\nlength = 5\nunit = \"{unit}\"\n"
        )
    };
    assert_eq!(texts(&drawn(&scene("", "mm")).1), ["5 mm at the target"]);
    assert_eq!(texts(&drawn(&scene("", "thousandths of a metre")).1), ["5 thousandths of a metre"]);
    let behind = drawn(&scene("eye = [8, -9, 8]\ndirection = [0, -1, 0]\ntarget = [8, 8, 8]\n", "mm")).1;
    assert!(behind.notes[0].starts_with("the scale bar is left out: the camera's target"), "{:?}", behind.notes);
}

/// The texts of a layer, with the rectangles around their lines.
fn boxes_of_texts<'a>(frame: &'a Frame, layer: &'a str) -> impl Iterator<Item = (&'a str, [DVec2; 2])> {
    let layers = frame.marks.iter().flat_map(|marks| &marks.layers).filter(move |found| found.pen.name == layer);
    layers.flat_map(|layer| &layer.texts).map(|text| {
        let size = extent(&text.characters, text.size);
        let corners = [text.at - DVec2::new(0.0, size.ascent), text.at + DVec2::new(size.advance, size.descent)];
        (text.characters.as_str(), corners)
    })
}

/// Labels lie on no line of an arrow or a fan.
#[test]
fn labels_keep_off_arrows_and_fans() {
    let labels = (0..5).map(|i| format!("[[label]]\ntext = \"part {i}\"\nat = [{}, 14, {}]\n", 9 + 4 * i, 18 + 2 * i));
    let head = "drypoint = 1\n[volume]\nphantom = { name = \"specimen\", size = 32 }\n[picture]\nsize = [200, 200]\ndpi = 55\n\
        [camera]\nprojection = \"orthographic\"\nheight = 90\ndirection = [0, 1, 0]\n[[object]]\nname = \"o\"\n\
        value = [[100, 0], [110, 1]]\nmove = [7, 27, 0]\n";
    let labels: String = labels.collect();
    let mut shown = 0;
    for layout in ["hull", "columns"] {
        for ways in [
            "[[arrow]]\nbend = 2.2\noccluded = false\n",
            "[[fan]]\n",
            "[[fan]]\nshape = \"circle\"\n[[arrow]]\nbend = 1\n",
        ] {
            let frame = drawn(&format!("{head}{ways}[labels]\nlayout = \"{layout}\"\n{labels}")).1;
            let marks = frame.marks.as_ref().unwrap();
            let lines = marks.layers.iter().filter(|layer| ["arrow", "fan"].contains(&&*layer.pen.name));
            let lines: Vec<_> = lines.flat_map(|layer| &layer.lines).collect();
            assert!(!lines.is_empty());
            for (text, [low, high]) in boxes_of_texts(&frame, "labels") {
                shown += 1;
                for pair in lines.iter().flat_map(|line| line.vertices.windows(2)) {
                    let is_on = (0..=100).map(|i| pair[0].at.lerp(pair[1].at, f64::from(i) / 100.0));
                    let mut is_on = is_on.filter(|at| at.cmpgt(low).all() && at.cmplt(high).all());
                    assert!(is_on.next().is_none(), "{text} {layout} {ways}");
                }
            }
        }
    }
    assert!(shown > 15, "{shown}");
}

/// An arrow that cannot be drawn is told. Only one without any way is silent.
#[test]
fn arrows_that_are_not_drawn_are_told() {
    let arrow = |keys: &str| {
        let scene = "drypoint = 1\n[volume]\nphantom = { name = \"specimen\", size = 16 }\n[picture]\nsize = [60, 60]\n\
            [camera]\neye = [8, -9, 8]\ndirection = [0, 1, 0]\nfov = 60\nnear = 1\n";
        drawn(&format!("{scene}[[arrow]]\noccluded = false\n{keys}")).1
    };
    for (keys, what) in [
        ("from = [8, -30, 8]\nto = [8, 8, 8]\n", "one of its ends is not before the eye"),
        ("from = [8, 3, 8]\nto = [8, 8, 8]\nbend = 0\n", "it is seen along its direction"),
        ("from = [4, 3, 8]\nto = [8, 8, 8]\nbend = 1e308\n", "it is too long for the picture"),
        ("from = [-1e300, 3, 8]\nto = [1e300, 8, 8]\n", "it is too long for the picture"),
        ("from = [8, 8, 8]\nto = [8, 8, 8]\n", ""),
        ("from = [4, 8, 8]\nto = [12, 8, 8]\n", ""),
    ] {
        let notes = arrow(keys).notes;
        let expected = format!("the arrow 0 is left out: {what}");
        assert!(if what.is_empty() { notes.is_empty() } else { notes[0].starts_with(&expected) }, "{keys} {notes:?}");
    }
    // A head is at most half as long as its arrow.
    let frame = arrow("from = [6, 8, 8]\nto = [10, 8, 8]\nhead = \"5000 mm\"\n");
    let layer = &frame.marks.as_ref().unwrap().layers[0];
    let x = |points: Vec<DVec2>| {
        points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], p| [lo.min(p.x), hi.max(p.x)])
    };
    let [from, neck] = x(layer.lines[0].vertices.iter().map(|vertex| vertex.at).collect());
    let [back, tip] = x(layer.areas[0].outlines[0].clone());
    assert!((tip - back - (tip - from) / 2.0).abs() < 0.01 && back < neck && neck < tip, "{from} {neck} {back} {tip}");
}

/// A label of a point beyond the picture's edge says so.
#[test]
fn a_label_outside_the_picture_is_told() {
    let notes = drawn(&SCENE.replace("at = [4, 4, 4]", "at = [4000, 4, 4]")).1.notes;
    assert_eq!(notes, ["the label \"first & last\" is left out: what it names is outside the picture"]);
}
