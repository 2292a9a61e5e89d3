//! The check of marks before any file or picture is made of them.

use crate::OutputError;
use drypoint_scene::marks::{Layer, Marks};

/// Checks that all numbers of a page and its marks are finite. Files of marks hold finite numbers only.
pub(crate) fn check_finite(marks: &Marks) -> Result<(), OutputError> {
    let page = &marks.page;
    let refuse = |what: String| Err(OutputError::NotFinite { what });
    if !(page.size.is_finite() && page.margin.is_finite() && page.dpi.is_finite()) {
        return refuse("the page".into());
    }
    for layer in &marks.layers {
        let Layer { pen, dots, lines, areas, texts } = layer;
        if !(pen.width.is_finite() && pen.color.iter().all(|c| c.is_finite())) {
            return refuse(format!("the pen {:?}", pen.name));
        }
        let is_finite = |numbers: [f64; 2]| numbers.iter().all(|number| number.is_finite());
        let dot = dots
            .iter()
            .find(|dot| !(dot.at.is_finite() && dot.world.is_finite() && is_finite([dot.radius, dot.opacity])));
        let vertex = lines.iter().flat_map(|line| &line.vertices).find(|vertex| {
            let color = vertex.color.unwrap_or_default();
            let is_placed = vertex.at.is_finite() && vertex.world.is_finite() && vertex.t.is_finite();
            !(is_placed && is_finite([vertex.radius, vertex.opacity]) && color.iter().all(|c| c.is_finite()))
        });
        let area = areas.iter().find(|area| {
            let color = area.color.unwrap_or_default();
            let is_placed = area.outlines.iter().flatten().all(|at| at.is_finite());
            !(is_placed && area.opacity.is_finite() && color.iter().all(|c| c.is_finite()))
        });
        let text = texts.iter().find(|text| !(text.at.is_finite() && is_finite([text.size, text.opacity])));
        if let Some(dot) = dot {
            return refuse(format!("a dot of the pen {:?} at {}", pen.name, dot.at));
        }
        if let Some(vertex) = vertex {
            return refuse(format!("a line of the pen {:?} at {}", pen.name, vertex.at));
        }
        if area.is_some() {
            return refuse(format!("an area of the pen {:?}", pen.name));
        }
        if let Some(text) = text {
            return refuse(format!("the text {:?} of the pen {:?}", text.characters, pen.name));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::list::{ListFormat, write_dots, write_lines};
    use crate::paint::{PageWindow, blank, paint};
    use crate::vector::VectorPage;
    use crate::vector::pdf::encode_pdf;
    use crate::vector::svg::{Animation, encode_svg};
    use drypoint_scene::glam::{DVec2, DVec3};
    use drypoint_scene::marks::{Area, Dot, Page, Pen, Polyline, Text, Vertex};
    use drypoint_scene::picture::Provenance;
    use drypoint_scene::tables::BlendSpace;
    use std::path::Path;

    /// A page with a dot, a line, an area and text.
    fn marks() -> Marks {
        let pen = Pen { number: 1, name: "black".into(), width: 0.3, color: [0.0, 0.0, 0.0, 1.0] };
        let dot = Dot { at: DVec2::ONE, world: DVec3::ONE, radius: 0.1, opacity: 1.0 };
        let vertex = |x: f64| Vertex {
            at: DVec2::new(x, 2.0),
            world: DVec3::ONE,
            radius: 0.1,
            opacity: 1.0,
            t: 0.0,
            color: Some([0.5; 3]),
        };
        let line = Polyline { vertices: vec![vertex(1.0), vertex(3.0)], closed: false };
        let page = Page::in_millimetres(DVec2::splat(4.0), 0.0, 25.4);
        let outlines = vec![vec![DVec2::ZERO, DVec2::X, DVec2::Y]];
        let area = Area { outlines, opacity: 1.0, color: Some([0.5; 3]) };
        let text = Text { characters: "label".into(), at: DVec2::new(1.0, 3.0), size: 1.0, opacity: 1.0 };
        let layer =
            Layer { dots: vec![dot], lines: vec![line], areas: vec![area], texts: vec![text], ..Layer::new(pen) };
        Marks { page, layers: vec![layer] }
    }

    /// What every writer of marks says.
    fn written(marks: &Marks) -> [Result<(), OutputError>; 6] {
        let folder = tempfile::tempdir().unwrap();
        let list = folder.path().join("list.csv");
        let provenance = Provenance::default();
        let sheet = VectorPage {
            marks,
            background: None,
            picture: None,
            plotter: false,
            beziers: false,
            outlined: false,
            provenance: &provenance,
        };
        let mut picture = blank(&self::marks().page, None).unwrap();
        let window = PageWindow::page(&self::marks().page);
        let all = [
            encode_svg(&sheet).map(drop),
            Animation::new(&mut Vec::new(), 1, 1.0).frame(&sheet, Path::new("a.svg")),
            encode_pdf(&sheet).map(drop),
            write_dots(marks, ListFormat::Csv, &list),
            write_lines(marks, ListFormat::Csv, &list),
            paint(marks, &window, BlendSpace::Linear, &mut picture),
        ];
        assert_eq!(list.exists(), all[3].is_ok());
        all
    }

    #[test]
    fn no_writer_takes_a_number_that_is_not_finite() {
        assert!(written(&marks()).iter().all(Result::is_ok));
        type Change = fn(&mut Marks, f64);
        let changes: [(&str, Change); 18] = [
            ("the page", |marks, x| marks.page.size.x = x),
            ("the page", |marks, x| marks.page.margin = x),
            ("the pen \"black\"", |marks, x| marks.layers[0].pen.width = x),
            ("the pen \"black\"", |marks, x| marks.layers[0].pen.color[2] = x),
            ("a dot of the pen \"black\" at ", |marks, x| marks.layers[0].dots[0].at.y = x),
            ("a dot of the pen \"black\" at ", |marks, x| marks.layers[0].dots[0].radius = x),
            ("a dot of the pen \"black\" at ", |marks, x| marks.layers[0].dots[0].world.z = x),
            ("a line of the pen \"black\" at ", |marks, x| marks.layers[0].lines[0].vertices[1].at.x = x),
            ("a line of the pen \"black\" at ", |marks, x| marks.layers[0].lines[0].vertices[1].radius = x),
            ("a line of the pen \"black\" at ", |marks, x| marks.layers[0].lines[0].vertices[1].opacity = x),
            ("a line of the pen \"black\" at ", |marks, x| marks.layers[0].lines[0].vertices[1].t = x),
            ("a line of the pen \"black\" at ", |marks, x| {
                marks.layers[0].lines[0].vertices[1].color = Some([0.0, x, 0.0])
            }),
            ("an area of the pen \"black\"", |marks, x| marks.layers[0].areas[0].outlines[0][2].x = x),
            ("an area of the pen \"black\"", |marks, x| marks.layers[0].areas[0].opacity = x),
            ("an area of the pen \"black\"", |marks, x| marks.layers[0].areas[0].color = Some([x, 0.0, 0.0])),
            ("the text \"label\" of the pen \"black\"", |marks, x| marks.layers[0].texts[0].at.y = x),
            ("the text \"label\" of the pen \"black\"", |marks, x| marks.layers[0].texts[0].size = x),
            ("the text \"label\" of the pen \"black\"", |marks, x| marks.layers[0].texts[0].opacity = x),
        ];
        for (what, change) in changes {
            for x in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
                let mut marks = marks();
                change(&mut marks, x);
                for result in written(&marks) {
                    let said = result.unwrap_err().to_string();
                    assert!(
                        said.starts_with(what) && said.ends_with(" has a number that is infinite or NaN"),
                        "{said}"
                    );
                }
            }
        }
    }
}
