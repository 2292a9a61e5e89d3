//! Lists of dots and lines, and tables of tones. The first byte chooses the form, the pens and the page; the rest is the
//! file.

#![no_main]

use drypoint_fuzz::{Folder, check_error, start};
use drypoint_output::list::{ListFormat, encode_dots, encode_lines, read_list};
use drypoint_output::paint::{PageWindow, blank, paint};
use drypoint_output::plotter::{Speed, plan};
use drypoint_output::vector::{VectorPage, pdf::encode_pdf, svg::encode_svg};
use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{Layer, Marks, Page, Pen, Polyline};
use drypoint_scene::picture::Provenance;
use drypoint_scene::source::Disk;
use drypoint_scene::tables::BlendSpace;
use drypoint_scene::tone::Tone;
use libfuzzer_sys::fuzz_target;

fuzz_target!(init: start(), |data: &[u8]| {
    let Some((choice, file)) = data.split_first() else { return };
    let name = match choice % 3 {
        0 => "a.csv",
        1 => "a.jsonl",
        _ => return check_tone(file),
    };
    let page = match choice / 3 % 2 {
        0 => Page::in_millimetres(DVec2::new(30.0, 20.0), 5.0, 72.0),
        _ => Page::in_pixels([60, 40], 1.0, 127.0),
    };
    let pens = if choice / 6 % 2 == 0 { vec![pen(1, "black"), pen(2, "red")] } else { Vec::new() };
    match read_list(&Folder::new().put(name, file), &page, &pens) {
        Ok(layers) => check_list(page, layers),
        Err(error) => check_error([error.to_string(), "a list".into(), error.help().into()]),
    }
});

fn pen(number: usize, name: &str) -> Pen {
    Pen { number, name: name.into(), width: 0.3, color: [0.5, 0.0, 0.0, 1.0] }
}

/// Checks that what the page holds of a list is read back as it was written, and draws it in every way.
fn check_list(page: Page, layers: Vec<Layer>) {
    let mut marks = Marks { page, layers };
    marks.settle();
    marks.layers.iter_mut().flat_map(|layer| &mut layer.lines).for_each(close);
    for (form, name) in [(ListFormat::Csv, "a.csv"), (ListFormat::JsonLines, "a.jsonl")] {
        if !marks.layers.is_empty() {
            read_back(&marks, &encode_dots(&marks, form), name, |a, b| a.dots == b.dots);
            read_back(&marks, &encode_lines(&marks, form), name, |a, b| a.lines == b.lines);
        }
    }
    let provenance = Provenance::default();
    let drawn = plan(&marks, &Speed::default());
    for (marks, plotter, beziers) in [(&marks, false, true), (&marks, false, false), (&drawn.marks, true, false)] {
        let sheet = VectorPage { marks, background: None, picture: None, plotter, beziers, outlined: false, provenance: &provenance };
        assert!(encode_svg(&sheet).is_ok_and(|file| !file.is_empty()));
        assert!(encode_pdf(&sheet).is_ok_and(|file| !file.is_empty()));
    }
    for blend in [BlendSpace::Linear, BlendSpace::Srgb] {
        let mut picture = blank(&page, Some([1.0; 4])).expect("a page of few pixels");
        paint(&marks, &PageWindow::page(&page), blend, &mut picture).expect("a picture with beauty");
        let mut values = picture.layers.iter().flat_map(|layer| &layer.channels).flatten();
        assert!(values.all(|value| (-1e-9..=1.0 + 1e-9).contains(value)));
    }
}

/// Closes an open line that ends where it began: a list cannot tell the two apart.
fn close(line: &mut Polyline) {
    if let [first, .., last] = line.vertices.as_slice()
        && line.vertices.len() > 3
        && !line.closed
        && (first.at, first.world) == (last.at, last.world)
    {
        line.vertices.pop();
        line.closed = true;
    }
}

/// Checks what a written list is read back to.
fn read_back(marks: &Marks, file: &[u8], name: &str, same: impl Fn(&Layer, &Layer) -> bool) {
    let pens: Vec<Pen> = marks.layers.iter().map(|layer| layer.pen.clone()).collect();
    let back = read_list(&Folder::new().put(name, file), &marks.page, &pens);
    let back = back.unwrap_or_else(|error| panic!("{error}\n{}", String::from_utf8_lossy(file)));
    assert_eq!(back.len(), marks.layers.len());
    for (a, b) in marks.layers.iter().zip(&back) {
        assert!(same(a, b), "{a:?}\n{b:?}\n{}", String::from_utf8_lossy(file));
    }
}

/// Checks that a tone is finite, and never less where more is asked for.
fn check_tone(file: &[u8]) {
    let tone = match Tone::read(&Disk, &Folder::new().put("a.csv", file)) {
        Ok(tone) => tone,
        Err(error) => return check_error([error.to_string(), error.place(), "write the table again".into()]),
    };
    let steps = || (0..=64).map(|step| f64::from(step) / 64.0);
    for of in [Tone::printed, Tone::asked, Tone::coverage, Tone::ink] {
        let values: Vec<f64> = steps().map(|x| of(&tone, x)).collect();
        assert!(values.iter().all(|value| value.is_finite()), "{values:?}");
        assert!(values.windows(2).all(|pair| pair[0] <= pair[1] + 1e-12), "{values:?}");
    }
    for x in steps() {
        assert!(tone.coverage_of_layers(x, 2.0).is_finite() && tone.ink_of_layers(x, 2.0).is_finite());
    }
}
