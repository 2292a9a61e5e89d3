//! PDF as poppler draws it.

use crate::outside::{Codes, run};
use crate::sample;
use drypoint::output::vector::VectorPage;
use drypoint::output::vector::pdf::write_pdf;
use drypoint::scene::picture::Provenance;

/// `pdftoppm` counts 4 × 4 places a pixel and bends the share by a gamma of 1.5, which takes a tenth of a small dot's ink.
/// Four times as many pixels, reduced again, leave little of both.
const FINER: usize = 4;

#[test]
fn poppler_draws_what_we_draw() {
    for opaque in [true, false] {
        let folder = tempfile::tempdir().unwrap();
        let (marks, provenance) = (sample::marks(opaque), Provenance::default());
        write_pdf(&sample::sheet(&marks, &provenance), &folder.path().join("a.pdf")).unwrap();
        let dpi = (300 * FINER).to_string();
        let arguments = ["-r", &dpi, "-singlefile", "a.pdf", "theirs"];
        if run("pdftoppm", Some("poppler-utils"), &arguments, folder.path()).is_none() {
            return;
        }
        let theirs = Codes::of_ppm(&folder.path().join("theirs.ppm")).reduced(FINER);
        sample::picture(&marks, folder.path()).agrees_with(&theirs);
    }
}

/// [HATCH-10]: as with SVG.
#[test]
fn beziers_are_the_curves_that_their_chords_stand_for() {
    let folder = tempfile::tempdir().unwrap();
    let (marks, provenance) = (sample::curves(0.05), Provenance::default());
    let sheet = VectorPage { beziers: true, ..sample::sheet(&marks, &provenance) };
    write_pdf(&sheet, &folder.path().join("a.pdf")).unwrap();
    let dpi = (300 * FINER).to_string();
    let arguments = ["-r", &dpi, "-singlefile", "a.pdf", "theirs"];
    if run("pdftoppm", Some("poppler-utils"), &arguments, folder.path()).is_none() {
        return;
    }
    let theirs = Codes::of_ppm(&folder.path().join("theirs.ppm")).reduced(FINER);
    sample::picture(&sample::curves(0.0005), folder.path()).agrees_with(&theirs);
}

#[test]
fn poppler_reads_size_and_provenance() {
    let folder = tempfile::tempdir().unwrap();
    let provenance = Provenance { software: "Drypoint 0.1.0".into(), scene_hash: "00ff".into(), plan: "κ".into() };
    let marks = sample::marks(true);
    write_pdf(&sample::sheet(&marks, &provenance), &folder.path().join("a.pdf")).unwrap();
    let Some(said) = run("pdfinfo", Some("poppler-utils"), &["-custom", "a.pdf"], folder.path()) else { return };
    assert!(said.contains("DrypointScene") && said.contains("00ff") && said.contains('κ'), "{said}");
    let Some(said) = run("pdfinfo", Some("poppler-utils"), &["a.pdf"], folder.path()) else { return };
    // 4 × 3 inches.
    assert!(
        said.contains("288 x 216 pts") && said.contains("Drypoint 0.1.0") && !said.contains("CreationDate"),
        "{said}"
    );
}
