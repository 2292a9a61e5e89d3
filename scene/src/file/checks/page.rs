//! Checks of lengths on the page against the page ([IO-7]).

use crate::document::Problem;
use crate::document::check::Check;
use crate::marks::Page;
use crate::tables::{Length, Scene, Spacing};

/// Shortest and longest side of a picture on the page, in mm: a step of places, and 10 km.
const SIDES: [f64; 2] = [0.001, 1e7];

/// The longest length on a page, in longer sides of the picture, each at least a millimetre. Larger numbers are mistakes,
/// and the largest ones become infinite in millimetres or pixels.
const LONGEST: f64 = 1000.0;

/// Reports a picture that no page has room for, and lengths that are absurd on their page.
pub(super) fn check(scene: &Scene, check: &mut Check) {
    let has_page = scene.draws_on_page() || scene.page.is_some() || !scene.pens.is_empty();
    if !has_page || !check.sound(&["picture", "page", "pen", "stipples", "hatching", "outlines"]) {
        return;
    }
    let page = Page::of_picture(&scene.picture);
    let [width, height] = page.size.to_array();
    if [width, height].iter().any(|side| !(SIDES[0]..=SIDES[1]).contains(side)) {
        let what = format!("the picture is {width:.1e} mm wide and {height:.1e} mm high on the page");
        let remedy = "change picture.dpi: a side is 0.001 mm to 10 km long".into();
        check.fault_in("picture.dpi", Problem::Contradiction { what, remedy });
        return;
    }
    let longest = LONGEST * width.max(height).max(1.0);
    for (key, length) in lengths(scene) {
        if let Some(mm) = page.length(length).filter(|&mm| mm > longest) {
            let what = format!("{key} is {mm:.1e} mm, on a page whose picture is {width:.1} mm × {height:.1} mm");
            let remedy = format!("give at most {longest:.0} mm");
            check.fault_in(&key, Problem::Contradiction { what, remedy });
        }
    }
}

/// The lengths on the page of a scene, with their keys.
fn lengths(scene: &Scene) -> Vec<(String, Length)> {
    let mut all: Vec<(String, Length)> = Vec::new();
    all.extend(scene.page.iter().map(|page| ("page.margin".into(), page.margin)));
    all.extend(scene.pens.iter().enumerate().map(|(i, pen)| (format!("pen[{i}].width"), pen.width)));
    all.extend(scene.stipples.iter().map(|stipples| ("stipples.size".into(), stipples.size)));
    if let Some(hatching) = &scene.hatching {
        let stroke = &hatching.stroke;
        let spacing = match hatching.spacing {
            Spacing::Length(length) => Some(length),
            Spacing::Random | Spacing::Tone => None,
        };
        let [on, off] = stroke.dash.map_or([None; 2], |dash| dash.map(Some));
        let of_hatching = [
            ("width", Some(hatching.width)),
            ("spacing", spacing),
            ("gap", hatching.gap),
            ("stroke.min_width", Some(stroke.min_width)),
            ("stroke.dash", on),
            ("stroke.dash", off),
        ];
        all.extend(of_hatching.into_iter().filter_map(|(key, length)| Some((format!("hatching.{key}"), length?))));
    }
    if let Some(outlines) = &scene.outlines {
        all.push(("outlines.width".into(), outlines.width));
        all.push(("outlines.min_length".into(), outlines.min_length));
    }
    let annotations = scene.annotations.lengths();
    all.extend(annotations.into_iter().map(|(table, key, length)| (format!("{table}.{key}"), length)));
    all
}

#[cfg(test)]
mod tests {
    use crate::file::{Overrides, parse};
    use std::path::Path;

    fn faults(rest: &str) -> Option<String> {
        let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n{rest}");
        parse(&text, Path::new("scene.toml"), &Overrides::default()).err().map(|faults| faults.to_string())
    }

    #[test]
    fn lengths_that_are_absurd_on_the_page_name_their_key() {
        for (key, rest) in [
            ("stipples.size", "[stipples]\nsize = LENGTH\n"),
            ("hatching.width", "[hatching]\nwidth = LENGTH\n"),
            ("hatching.spacing", "[hatching]\nspacing = LENGTH\n"),
            ("hatching.gap", "[hatching]\ngap = LENGTH\n"),
            ("hatching.stroke.min_width", "[hatching.stroke]\nmin_width = LENGTH\n"),
            ("hatching.stroke.dash", "[hatching.stroke]\ndash = [\"1 mm\", LENGTH]\n"),
            ("outlines.width", "[outlines]\nwidth = LENGTH\n"),
            ("outlines.min_length", "[outlines]\nmin_length = LENGTH\n"),
            ("pen[0].width", "[[pen]]\nname = \"a\"\nwidth = LENGTH\n"),
            ("page.margin", "[page]\nmargin = LENGTH\n"),
        ] {
            // The picture's 512 px at 300 dpi are 43.3 mm.
            for length in ["1e308 px", "1e308 mm", "1e10 px", "43360 mm"] {
                let said = faults(&rest.replace("LENGTH", &format!("{length:?}"))).unwrap_or_else(|| panic!("{key}"));
                assert!(said.contains(&format!("{key} is ")) && said.contains("43.3 mm × 43.3 mm"), "{said}");
                assert!(said.contains("give at most 43349 mm"), "{said}");
            }
            assert_eq!(faults(&rest.replace("LENGTH", "\"43340 mm\"")), None, "{key}");
        }
    }

    #[test]
    fn a_picture_that_no_page_has_room_for_is_told_by_its_resolution() {
        for dpi in ["1e-300", "1e-3", "1e300", "1e8"] {
            let said = faults(&format!("[picture]\ndpi = {dpi}\n[outlines]\n"));
            assert!(said.is_some_and(|said| said.contains("picture.dpi") && said.contains("10 km")), "{dpi}");
            // Without a page a resolution has no effect.
            assert_eq!(faults(&format!("[picture]\ndpi = {dpi}\n")), None);
        }
        assert_eq!(faults("[picture]\ndpi = 1\n[outlines]\n"), None);
    }
}
