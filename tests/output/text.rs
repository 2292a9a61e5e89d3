//! Text and areas as librsvg and poppler draw and read them.

use crate::outside::{Codes, run};
use crate::sample;
use drypoint::output::vector::VectorPage;
use drypoint::output::vector::pdf::{encode_pdf, write_pdf};
use drypoint::output::vector::svg::write_svg;
use drypoint::scene::glam::DVec2;
use drypoint::scene::marks::{Area, Layer, Marks, Page, Pen, Text};
use drypoint::scene::picture::Provenance;
use std::path::Path;

/// Lines of text with kerned pairs, ligatures, accents of both kinds, other scripts, missing characters and odd spaces.
const LINES: [&str; 9] = [
    "AVATAR To Tokyo, fi ffl office",
    "Größe 0,4 µm × 12° – façade",
    "¿Dónde está el niño? L’œuvre",
    "e\u{301}tude nai\u{308}ve",
    "Ωμέγα и Жизнь",
    "snowman ☃ and cat 猫",
    "שלום",
    "<&> \"quoted\" 'single' \\ (x)",
    "two  spaces",
];

/// Lines of text over boxes of another colour, on 4 × 3 inches.
fn marks(opacity: f64) -> Marks {
    let page = Page::in_millimetres(DVec2::new(101.6, 76.2), 0.0, 300.0);
    let pen = |number, name: &str, color| Pen { number, name: name.into(), width: 0.3, color };
    let mut boxes = Layer::new(pen(1, "boxes", [0.0, 0.1, 0.5, 1.0]));
    let corners = [(4.0, 2.0), (60.0, 2.0), (66.0, 40.0), (50.0, 74.0), (4.0, 74.0)].map(DVec2::from);
    let hole = [(80.0, 10.0), (80.0, 20.0), (90.0, 20.0), (90.0, 10.0)].map(DVec2::from);
    let around = [(75.0, 5.0), (95.0, 5.0), (95.0, 25.0), (75.0, 25.0)].map(DVec2::from);
    boxes.areas = vec![
        Area { outlines: vec![corners.to_vec()], opacity: 0.25, color: Some([1.0, 0.3, 0.0]) },
        Area { outlines: vec![around.to_vec(), hole.to_vec()], opacity: 1.0, color: None },
    ];
    let mut words = Layer::new(pen(2, "words", [0.0, 0.0, 0.0, 1.0]));
    let text = |(i, line): (usize, &&str)| Text {
        characters: (*line).into(),
        at: DVec2::new(6.0, 9.0 + 8.0 * i as f64),
        size: 4.0 + 0.25 * i as f64,
        opacity,
    };
    words.texts = LINES.iter().enumerate().map(text).collect();
    let mut marks = Marks { page, layers: vec![boxes, words] };
    marks.settle();
    marks
}

/// The page as poppler draws it with so many times as many pixels, reduced again. Poppler bends coverage by a gamma and
/// moves letters to whole pixels.
fn drawn_by_poppler(sheet: &VectorPage, finer: usize, folder: &Path) -> Option<Codes> {
    write_pdf(sheet, &folder.join("a.pdf")).unwrap();
    let dpi = (300 * finer).to_string();
    run("pdftoppm", Some("poppler-utils"), &["-r", &dpi, "-singlefile", "a.pdf", "theirs"], folder)?;
    Some(Codes::of_ppm(&folder.join("theirs.ppm")).reduced(finer))
}

fn drawn_by_librsvg(sheet: &VectorPage, folder: &Path) -> Option<Codes> {
    write_svg(sheet, &folder.join("a.svg")).unwrap();
    let arguments = ["-d", "300", "-p", "300", "-b", "white", "-o", "theirs.png", "a.svg"];
    run("rsvg-convert", Some("librsvg2-bin"), &arguments, folder)?;
    Some(Codes::of_png(&folder.join("theirs.png")))
}

#[test]
fn poppler_draws_text_and_areas_as_we_do() {
    for (opacity, outlined, finer) in [(1.0, false, 8), (0.5, false, 4), (1.0, true, 4)] {
        let folder = tempfile::tempdir().unwrap();
        let (marks, provenance) = (marks(opacity), Provenance::default());
        let sheet = VectorPage { outlined, ..sample::sheet(&marks, &provenance) };
        let Some(theirs) = drawn_by_poppler(&sheet, finer, folder.path()) else { return };
        sample::picture(&marks, folder.path()).agrees_with(&theirs);
    }
}

#[test]
fn librsvg_draws_outlines_and_areas_as_we_do() {
    for opacity in [1.0, 0.5] {
        let folder = tempfile::tempdir().unwrap();
        let (marks, provenance) = (marks(opacity), Provenance::default());
        let sheet = VectorPage { outlined: true, ..sample::sheet(&marks, &provenance) };
        let Some(theirs) = drawn_by_librsvg(&sheet, folder.path()) else { return };
        sample::picture(&marks, folder.path()).agrees_with(&theirs);
    }
}

/// A viewer without the font draws other letters at the same places: the ink is similar, and the file is well-formed.
#[test]
fn librsvg_draws_text_in_a_font_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let (marks, provenance) = (marks(1.0), Provenance::default());
    let Some(theirs) = drawn_by_librsvg(&sample::sheet(&marks, &provenance), folder.path()) else { return };
    assert!(sample::picture(&marks, folder.path()).far_off(&theirs) < 0.1);
}

#[test]
fn poppler_reads_every_line() {
    let folder = tempfile::tempdir().unwrap();
    let (marks, provenance) = (marks(1.0), Provenance::default());
    write_pdf(&sample::sheet(&marks, &provenance), &folder.path().join("a.pdf")).unwrap();
    let Some(said) = run("pdftotext", Some("poppler-utils"), &["-layout", "a.pdf", "-"], folder.path()) else { return };
    // Poppler marks a line that runs from right to left, and squeezing evens out the spaces of its layout.
    let unmarked = |text: &str| text.replace(['\u{202b}', '\u{202c}'], "");
    let squeezed = |text: &str| unmarked(text).split_whitespace().collect::<Vec<_>>().join(" ");
    let said: Vec<String> = said.lines().map(squeezed).filter(|line| !line.is_empty()).collect();
    assert_eq!(said, LINES.map(squeezed));
    let Some(fonts) = run("pdffonts", Some("poppler-utils"), &["a.pdf"], folder.path()) else { return };
    let font = fonts.lines().last().unwrap_or_default();
    assert!(font.contains("+OpenSans") && font.contains("CID TrueType") && font.contains("yes yes yes"), "{fonts}");
}

#[test]
fn outlined_text_needs_no_font() {
    let folder = tempfile::tempdir().unwrap();
    let (marks, provenance) = (marks(1.0), Provenance::default());
    let sheet = VectorPage { outlined: true, ..sample::sheet(&marks, &provenance) };
    write_pdf(&sheet, &folder.path().join("a.pdf")).unwrap();
    let Some(said) = run("pdftotext", Some("poppler-utils"), &["a.pdf", "-"], folder.path()) else { return };
    assert!(said.trim().is_empty(), "{said}");
}

#[test]
fn equal_pages_give_equal_bytes() {
    let (marks, provenance) = (marks(0.5), Provenance::default());
    let sheet = sample::sheet(&marks, &provenance);
    let bytes = encode_pdf(&sheet).unwrap();
    println!("a PDF with nine lines of text: {} bytes", bytes.len());
    assert_eq!(bytes, encode_pdf(&sheet).unwrap());
}
