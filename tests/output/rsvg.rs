//! SVG as librsvg draws it.

use crate::outside::{Codes, run};
use crate::sample;
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
