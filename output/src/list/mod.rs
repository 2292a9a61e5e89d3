//! Lists of marks as data ([STIP-16]): the columns of the commands `points` and `strokes`, as CSV or as JSON lines. A
//! JSON line is an object with the columns as keys.
//!
//! | column | what | unit |
//! |---|---|---|
//! | `stroke`, `t` | lines only, a row a vertex: number of the line from 0, share of the way along it | |
//! | `x`, `y` | place on the page, y down | mm where the picture has mm, else px |
//! | `wx`, `wy`, `wz` | the point in the world | world |
//! | `radius` | of the dot, half the line's width | as `x` |
//! | `opacity` | in (0, 1] | |
//! | `color` | lines only, where a vertex has one of its own: `#rrggbb` | |
//! | `pen` | name of the pen, where there are several layers of dots or lines | |
//!
//! A closed line repeats its first vertex at the end. An open line that ends where it began is therefore read as
//! closed. Lists are read back bit for bit if the marks were rounded and on the page
//! ([`Marks::settle`](drypoint_scene::marks::Marks::settle)).

mod read;
mod write;

pub use read::read_list;
pub use write::{encode_dots, encode_lines, write_dots, write_lines};

use std::path::Path;

/// File format of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ListFormat {
    /// CSV: a header, then a row a mark.
    Csv,
    /// JSON lines: an object a mark.
    JsonLines,
}

impl ListFormat {
    /// Returns the format of a name that ends in `.csv` or `.jsonl`, in any case.
    pub fn of(path: &Path) -> Option<Self> {
        let suffix = path.extension()?;
        let is = |name: &str| suffix.eq_ignore_ascii_case(name);
        if is("csv") { Some(Self::Csv) } else { is("jsonl").then_some(Self::JsonLines) }
    }
}

/// The columns that dots and vertices share.
const COLUMNS: [&str; 7] = ["x", "y", "wx", "wy", "wz", "radius", "opacity"];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::OutputError;
    use drypoint_scene::glam::{DVec2, DVec3};
    use drypoint_scene::marks::{Dot, Layer, Marks, Page, Pen, Polyline, Vertex};
    use proptest::prelude::*;
    use std::path::PathBuf;

    fn pen(number: usize, name: &str) -> Pen {
        Pen { number, name: name.into(), width: 0.3, color: [0.0, 0.0, 0.0, 1.0] }
    }

    /// Marks with numbers that have no end in binary, on `page`.
    fn marks(page: Page, pens: &[Pen]) -> Marks {
        let world = |n: f64| DVec3::new(n / 3.0, -1e-12 * n, 1e9 / (n + 1.0));
        let dot = |n: f64| Dot {
            at: DVec2::new(n * 1.2347, n / 7.0),
            world: world(n),
            radius: 0.0133 * n,
            opacity: n / 60.0,
        };
        let vertex = |n: f64| Vertex {
            at: DVec2::new(n, n / 3.0),
            world: world(n),
            radius: 0.2,
            opacity: 1.0,
            t: n / 7.0,
            color: None,
        };
        let layer = |pen: &Pen| Layer {
            dots: (0..50).map(|n| dot(f64::from(n) + pen.number as f64)).collect(),
            lines: vec![
                Polyline { vertices: [0.0, 1.0, 2.0].map(vertex).to_vec(), closed: false },
                Polyline { vertices: [3.0, 4.0, 5.0, 6.0].map(vertex).to_vec(), closed: true },
            ],
            ..Layer::new(pen.clone())
        };
        let mut marks = Marks { page, layers: pens.iter().map(layer).collect() };
        marks.round();
        marks
    }

    const FORMS: [(ListFormat, &str); 2] = [(ListFormat::Csv, "list.csv"), (ListFormat::JsonLines, "list.JSONL")];

    fn pages() -> [Page; 4] {
        let px = |dpi| Page::in_pixels([500, 400], 1.0, dpi);
        [Page::in_millimetres(DVec2::splat(90.0), 5.0, 300.0), px(300.0), px(72.0), px(1.0)]
    }

    fn file(text: &[u8]) -> (tempfile::TempDir, PathBuf) {
        named("list.csv", text)
    }

    fn named(name: &str, text: &[u8]) -> (tempfile::TempDir, PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        (folder, path)
    }

    #[test]
    fn what_is_written_is_read_back_bit_for_bit() {
        for page in pages() {
            for pens in [vec![pen(1, "black")], vec![pen(1, "black"), pen(2, "a \"red\", one")]] {
                let marks = marks(page, &pens);
                for (form, name) in FORMS {
                    let read = |text: &[u8]| {
                        let (_folder, path) = named(name, text);
                        read_list(&path, &page, &pens).unwrap()
                    };
                    let (dots, lines) = (read(&encode_dots(&marks, form)), read(&encode_lines(&marks, form)));
                    for ((found, dots), lines) in marks.layers.iter().zip(dots).zip(lines) {
                        assert_eq!((&dots.pen, &dots.dots), (&found.pen, &found.dots));
                        assert_eq!((&lines.pen, &lines.lines), (&found.pen, &found.lines));
                        assert!(dots.lines.is_empty() && lines.dots.is_empty());
                    }
                }
            }
        }
    }

    /// Colours of vertices are a column of their own, empty where the pen's holds.
    #[test]
    fn colors_of_vertices() {
        for pens in [vec![pen(1, "black")], vec![pen(1, "black"), pen(2, "red")]] {
            let mut marks = marks(pages()[0], &pens);
            for (i, vertex) in marks.layers[0].lines[0].vertices.iter_mut().enumerate().take(2) {
                vertex.color = Some([0.3 * i as f64, 1.0, 0.0]);
            }
            marks.round();
            for (form, name) in FORMS {
                let text = encode_lines(&marks, form);
                let (_folder, path) = named(name, &text);
                let found = read_list(&path, &marks.page, &pens).unwrap();
                assert!(found.iter().zip(&marks.layers).all(|(a, b)| a.lines == b.lines), "{name}");
            }
            let csv = String::from_utf8(encode_lines(&marks, ListFormat::Csv)).unwrap();
            assert!(csv.starts_with("stroke,t,x,y,wx,wy,wz,radius,opacity,color"), "{csv}");
            // 0.3 is 1.055·0.3^(1/2.4) − 0.055 = 0.5838 in sRGB: 149 of 255.
            assert!(csv.contains(",1,#00ff00") && csv.contains(",1,#95ff00"), "{csv}");
        }
        let (_folder, path) = file(b"stroke,t,x,y,wx,wy,wz,radius,opacity,color\n0,0,1,2,0,0,0,0.1,1,blue\n");
        let error = read_list(&path, &pages()[0], &[pen(1, "black")]).unwrap_err();
        assert!(error.to_string().contains("found \"blue\", expected a colour such as #c04006"), "{error}");
    }

    #[test]
    fn hand_worked_rows() {
        let mut list = marks(pages()[0], &[pen(1, "black")]);
        list.layers[0].dots =
            vec![Dot { at: DVec2::new(1.5, 0.001), world: DVec3::new(0.1, -2.0, 3e20), radius: 0.15, opacity: 0.0625 }];
        list.layers[0].lines.truncate(1);
        list.layers[0].lines[0].vertices.truncate(2);
        let text = |bytes| String::from_utf8(bytes).unwrap();
        assert_eq!(
            text(encode_dots(&list, ListFormat::Csv)),
            "x,y,wx,wy,wz,radius,opacity\n1.5,0.001,0.1,-2,300000000000000000000,0.15,0.0625\n"
        );
        assert_eq!(
            text(encode_lines(&list, ListFormat::Csv)),
            "stroke,t,x,y,wx,wy,wz,radius,opacity\n0,0,0,0,0,-0,1000000000,0.2,1\n\
             0,0.14285714285714285,1,0.333,0.3333333333333333,-0.000000000001,500000000,0.2,1\n"
        );
        assert_eq!(
            text(encode_dots(&list, ListFormat::JsonLines)),
            "{\"x\":1.5,\"y\":0.001,\"wx\":0.1,\"wy\":-2,\"wz\":300000000000000000000,\"radius\":0.15,\"opacity\":0.0625}\n"
        );
        assert!(text(encode_lines(&list, ListFormat::JsonLines)).starts_with("{\"stroke\":0,\"t\":0,\"x\":0,"));
        // 1.5 mm at 254 dpi are 15 px.
        list.page = Page { dpi: 254.0, ..Page::in_pixels([100, 100], 0.0, 254.0) };
        assert!(
            text(encode_dots(&list, ListFormat::Csv)).contains("\n15,0.01,0.1,-2,300000000000000000000,1.5,0.0625\n")
        );
    }

    #[test]
    fn errors_name_line_and_column() {
        let head = "x,y,wx,wy,wz,radius,opacity";
        for (text, line, column, fault) in [
            (
                format!("{head}\n1,2,0,0,0,0.1,1\n1,2,0,0,0,zero,1\n"),
                3,
                "radius",
                "found \"zero\", expected a number above 0",
            ),
            (format!("{head}\n1,2,0,0,0,-0.1,1\n"), 2, "radius", "found \"-0.1\", expected a number above 0"),
            (format!("{head}\n1,inf,0,0,0,0.1,1\n"), 2, "y", "found \"inf\", expected a number"),
            (
                format!("{head}\n1,2,0,0,0,0.1,1.5\n"),
                2,
                "opacity",
                "found \"1.5\", expected a number above 0 and of at most 1",
            ),
            (
                format!("{head}\n1,2,0,0,0,0.1\n"),
                2,
                "opacity",
                "opacity is missing, expected a number above 0 and of at most 1",
            ),
            (format!("{head},pen\n1,2,0,0,0,0.1,1,blue\n"), 2, "pen", "found \"blue\", expected \"black\" or \"red\""),
            (format!("stroke,t,{head}\n0,2,1,2,0,0,0,0.1,1\n"), 2, "t", "found \"2\", expected a number from 0 to 1"),
            (format!("stroke,t,{head}\nx,1,1,2,0,0,0,0.1,1\n"), 2, "stroke", "found \"x\", expected a whole number"),
            ("x,y,wx,wy,radius,opacity\n".into(), 1, "wz", "the column wz is missing"),
            ("stroke,x,y,wx,wy,wz,radius,opacity\n".into(), 1, "t", "the column t is missing"),
            (String::new(), 1, "x", "the column x is missing"),
        ] {
            let (_folder, path) = file(text.as_bytes());
            match read_list(&path, &pages()[0], &[pen(1, "black"), pen(2, "red")]) {
                Err(OutputError::List { line: l, column: c, fault: f, .. }) => {
                    assert_eq!((l, c.as_str(), f.as_str()), (line, column, fault), "{text}");
                }
                other => panic!("{text}: {other:?}"),
            }
        }
    }

    #[test]
    fn errors_of_json_lines_name_them_too() {
        let row =
            |rest: &str| format!("{{\"x\":1,\"y\":2,\"wx\":0,\"wy\":0,\"wz\":0,\"radius\":0.1,\"opacity\":1{rest}}}\n");
        for (text, line, column, fault) in [
            (format!("{}\n{{\"x\":\n", row("")), 3, "character 5", "is not one JSON object"),
            ("[1, 2]\n".into(), 1, "character 1", "is not one JSON object"),
            ("{} {}\n".into(), 1, "character 4", "is not one JSON object"),
            ("{\"x\":1}\n".into(), 1, "y", "y is missing, expected a number"),
            (row("").replace("0.1", "\"0.1\""), 1, "radius", "found \"0.1\", expected a number above 0"),
            (row("").replace("0.1", "-1"), 1, "radius", "found -1, expected a number above 0"),
            (row(",\"pen\":3"), 1, "pen", "found 3, expected \"black\" or \"red\""),
            (row(",\"stroke\":0.5"), 1, "stroke", "found 0.5, expected a whole number"),
            (row(",\"stroke\":1"), 1, "t", "t is missing, expected a number from 0 to 1"),
        ] {
            let (_folder, path) = named("list.jsonl", text.as_bytes());
            match read_list(&path, &pages()[0], &[pen(1, "black"), pen(2, "red")]) {
                Err(OutputError::List { line: l, column: c, fault: f, .. }) => {
                    assert_eq!((l, c.as_str(), f.as_str()), (line, column, fault), "{text}");
                }
                other => panic!("{text}: {other:?}"),
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]

        /// Any file is read as a list, or gives an error that names a line of it.
        #[test]
        fn files_of_anything(
            bytes in prop::collection::vec(any::<u8>(), 0..200),
            places in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..8),
        ) {
            for (form, name) in FORMS {
                // Noise, and a list with some bytes changed.
                let mut changed = encode_dots(&marks(pages()[0], &[pen(1, "black"), pen(2, "red")]), form);
                changed.truncate(400);
                for (at, byte) in &places {
                    let at = at.index(changed.len());
                    changed[at] = *byte;
                }
                for text in [&bytes, &changed] {
                    let (_folder, path) = named(name, text);
                    match read_list(&path, &pages()[0], &[pen(1, "black"), pen(2, "red")]) {
                        Ok(layers) => prop_assert_eq!(layers.len(), 2),
                        Err(OutputError::List { line, .. }) => {
                            let lines = text.iter().filter(|&&b| b == b'\n' || b == b'\r').count() as u64;
                            prop_assert!((1..=lines + 1).contains(&line), "{}", line);
                        }
                        Err(other) => prop_assert!(false, "{}", other),
                    }
                }
            }
        }
    }

    #[test]
    fn files_that_are_no_list() {
        let page = pages()[0];
        let absent = read_list(&PathBuf::from("absent/list.csv"), &page, &[pen(1, "black")]).unwrap_err();
        assert!(absent.to_string().contains("list.csv: cannot be read"), "{absent}");
        let (_folder, path) = file(b"x,y,wx,wy,wz,radius,opacity\n\xff,2,3,4,5,6,1\n");
        let binary = read_list(&path, &page, &[pen(1, "black")]).unwrap_err();
        assert!(binary.to_string().contains("line 2, column x"), "{binary}");
    }

    #[test]
    fn columns_may_stand_in_any_order_and_beside_others() {
        let (_folder, path) = file(b"note,opacity,radius,wz,wy,wx,y,x\nhello,1,0.25,3,2,1,20,10\n");
        let layers = read_list(&path, &pages()[0], &[pen(1, "black")]).unwrap();
        let expected = Dot { at: DVec2::new(10.0, 20.0), world: DVec3::new(1.0, 2.0, 3.0), radius: 0.25, opacity: 1.0 };
        assert_eq!(layers[0].dots, [expected]);
    }
}
