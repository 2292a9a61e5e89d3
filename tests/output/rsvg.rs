//! SVG as librsvg draws it.

use crate::outside::{Codes, run};
use crate::sample;
use drypoint::output::vector::VectorPage;
use drypoint::output::vector::svg::write_svg;
use drypoint::scene::picture::Provenance;

#[test]
fn librsvg_draws_what_we_draw() {
    for opaque in [true, false] {
        let folder = tempfile::tempdir().unwrap();
        let (marks, provenance) = (sample::marks(opaque), Provenance::default());
        write_svg(&sample::sheet(&marks, &provenance), &folder.path().join("a.svg")).unwrap();
        let arguments = ["-d", "300", "-p", "300", "-b", "white", "-o", "theirs.png", "a.svg"];
        if run("rsvg-convert", Some("librsvg2-bin"), &arguments, folder.path()).is_none() {
            return;
        }
        sample::picture(&marks, folder.path()).agrees_with(&Codes::of_png(&folder.path().join("theirs.png")));
    }
}

/// [HATCH-10]: curves in chords that are up to 0.05 mm beside them, written as Béziers, look as the curves themselves do; the
/// chords do not.
#[test]
fn beziers_are_the_curves_that_their_chords_stand_for() {
    let folder = tempfile::tempdir().unwrap();
    let (marks, provenance) = (sample::curves(0.05), Provenance::default());
    let ours = sample::picture(&sample::curves(0.0005), folder.path());
    let sheet = sample::sheet(&marks, &provenance);
    let drawn = [true, false].map(|beziers| {
        write_svg(&VectorPage { beziers, ..sheet }, &folder.path().join("a.svg")).unwrap();
        let arguments = ["-d", "300", "-p", "300", "-b", "white", "-o", "theirs.png", "a.svg"];
        run("rsvg-convert", Some("librsvg2-bin"), &arguments, folder.path())?;
        Some(Codes::of_png(&folder.path().join("theirs.png")))
    });
    let [Some(curves), Some(chords)] = drawn else { return };
    ours.agrees_with(&curves);
    assert!(ours.far_off(&chords) > 0.005, "{}", ours.far_off(&chords));
}
