//! Files parsed back: the same places, widths and opacities in SVG, PDF and CSV.

use crate::random::Random;
use crate::sample;
use drypoint::output::list::{ListFormat, encode_dots, read_list};
use drypoint::output::plotter::{Speed, plan};
use drypoint::output::vector::VectorPage;
use drypoint::output::vector::pdf::encode_pdf;
use drypoint::output::vector::svg::encode_svg;
use drypoint::scene::glam::{DVec2, DVec3};
use drypoint::scene::marks::{Dot, Layer, Marks, Page, Polyline};
use drypoint::scene::picture::Provenance;
use std::io::Read;

/// A dot in micrometres: x, y, diameter, and opacity in thousandths.
type Found = [i64; 4];

/// The width of an outline that is filled.
const FILLED: i64 = -1;

/// Dots and lines of a layer, in any order.
#[derive(Debug, Default, PartialEq)]
struct Drawn {
    dots: Vec<Found>,
    /// Places of each line, first its width and opacity.
    lines: Vec<Vec<[i64; 2]>>,
}

impl Drawn {
    fn sorted(mut self) -> Self {
        self.dots.sort();
        self.lines.sort();
        self
    }

    /// A stroke of a file.
    fn stroke(&mut self, places: Vec<[i64; 2]>, [width, opacity]: [i64; 2]) {
        match places.as_slice() {
            [[x, y]] => self.dots.push([*x, *y, width, opacity]),
            [a, b] if a == b => self.dots.push([a[0], a[1], width, opacity]),
            _ => self.lines.push([vec![[width, opacity]], places].concat()),
        }
    }
}

fn step(x: f64) -> i64 {
    (x * 1000.0).round() as i64
}

fn steps(at: DVec2) -> [i64; 2] {
    at.to_array().map(step)
}

/// What the marks say.
fn of_marks(layer: &Layer) -> Drawn {
    let dot = |d: &Dot| [step(d.at.x), step(d.at.y), step(2.0 * d.radius), step(d.opacity)];
    let mut drawn = Drawn { dots: layer.dots.iter().map(dot).collect(), lines: Vec::new() };
    for piece in layer.lines.iter().flat_map(Polyline::pieces) {
        let Some(radius) = piece.stroke(layer.pen.color[3]) else {
            for outline in piece.outlines(layer.pen.color[3]) {
                let places = outline.iter().chain(outline.first()).map(|&p| steps(p)).collect();
                drawn.stroke(places, [FILLED, step(piece.opacity)]);
            }
            continue;
        };
        let close = piece.points.first().filter(|_| piece.closed);
        let places = piece.points.iter().chain(close).map(|&p| steps(p)).collect();
        drawn.stroke(places, [step(2.0 * radius), step(piece.opacity)]);
    }
    drawn.sorted()
}

/// The value of an attribute of a tag.
fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    let from = tag.find(&format!(" {name}=\""))? + name.len() + 3;
    tag[from..].split('"').next()
}

/// The layers of our SVG, by a reader that knows paths of M, m, l, h and z, polylines and groups.
fn of_svg(svg: &str) -> Vec<Drawn> {
    let (mut layers, mut open): (Vec<Drawn>, Vec<[i64; 2]>) = (Vec::new(), Vec::new());
    for tag in svg.split('<').skip(1).map(|tag| tag.split('>').next().unwrap()) {
        let number = |name: &str| attribute(tag, name).map(|n| step(n.parse().unwrap()));
        if tag.starts_with("g ") {
            if attribute(tag, "inkscape:groupmode") == Some("layer") {
                assert!(open.is_empty(), "a layer stands at the top");
                layers.push(Drawn::default());
            }
            assert!(!tag.contains("transform"));
            let [width, opacity] = open.last().copied().unwrap_or([0, 1000]);
            let filled = attribute(tag, "stroke") == Some("none");
            let width = if filled { FILLED } else { number("stroke-width").unwrap_or(width) };
            let opacity = number(if filled { "fill-opacity" } else { "stroke-opacity" }).unwrap_or(opacity);
            open.push([width, opacity]);
        } else if tag == "/g" {
            open.pop();
        } else if let Some(d) = attribute(tag, "d") {
            let (layer, pen) = (layers.last_mut().unwrap(), *open.last().unwrap());
            strokes(d).into_iter().for_each(|stroke| layer.stroke(stroke, pen));
        } else if let Some(points) = attribute(tag, "points") {
            let numbers: Vec<i64> = points.split([' ', ',']).map(|n| step(n.parse().unwrap())).collect();
            let places = numbers.chunks(2).map(|p| [p[0], p[1]]).collect();
            layers.last_mut().unwrap().stroke(places, *open.last().unwrap());
        }
    }
    layers.into_iter().map(Drawn::sorted).collect()
}

/// The strokes of a path.
fn strokes(d: &str) -> Vec<Vec<[i64; 2]>> {
    let (mut all, mut at): (Vec<Vec<[i64; 2]>>, [i64; 2]) = (Vec::new(), [0, 0]);
    let mut rest = d;
    while let Some(command) = rest.chars().next() {
        let end = rest[1..].find(char::is_alphabetic).map_or(rest.len(), |i| i + 1);
        let numbers = numbers(&rest[1..end]);
        rest = &rest[end..];
        match command {
            'M' | 'm' => {
                let from = if command == 'm' { at } else { [0, 0] };
                at = [from[0] + numbers[0], from[1] + numbers[1]];
                all.push(vec![at]);
            }
            'h' => {
                assert_eq!(numbers, [0]);
                all.last_mut().unwrap().push(at);
            }
            'l' => {
                for pair in numbers.chunks(2) {
                    at = [at[0] + pair[0], at[1] + pair[1]];
                    all.last_mut().unwrap().push(at);
                }
            }
            'z' => {
                let line = all.last_mut().unwrap();
                line.push(line[0]);
                at = line[0];
            }
            other => panic!("{other} in {d}"),
        }
    }
    all
}

/// Numbers parted by a space or a sign.
fn numbers(text: &str) -> Vec<i64> {
    let spaced = text.replace('-', " -");
    spaced.split_whitespace().map(|n| step(n.parse().unwrap())).collect()
}

/// The layers of our PDF.
fn of_pdf(pdf: &[u8]) -> Vec<Drawn> {
    let find = |from: usize, what: &[u8]| from + pdf[from..].windows(what.len()).position(|w| w == what).unwrap();
    let object = find(0, b"\n4 0 obj");
    let from = find(object, b"stream\n") + 7;
    let mut content = String::new();
    flate2::read::ZlibDecoder::new(&pdf[from..]).read_to_string(&mut content).unwrap();
    // The states by number: /G0 << /CA 0.5 …
    let text = String::from_utf8_lossy(pdf);
    let opacity = |state: &str| {
        let at = text.find(&format!("{state} <<")).unwrap();
        let value = text[at..].split("/CA").nth(1).unwrap().split_whitespace().next().unwrap();
        step(value.trim_end_matches('/').parse().unwrap())
    };
    let mut layers: Vec<Drawn> = Vec::new();
    let (mut numbers, mut names, mut pens): (Vec<i64>, Vec<String>, Vec<[i64; 2]>) = (vec![], vec![], vec![[0, 1000]]);
    let mut path: Vec<Vec<[i64; 2]>> = Vec::new();
    for word in content.split_whitespace() {
        if let Ok(number) = word.parse::<f64>() {
            numbers.push(step(number));
            continue;
        }
        match word {
            "BDC" => layers.push(Drawn::default()),
            "q" => pens.push(*pens.last().unwrap()),
            "Q" => drop(pens.pop()),
            "gs" => pens.last_mut().unwrap()[1] = opacity(names.last().unwrap()),
            "w" => pens.last_mut().unwrap()[0] = numbers[0],
            "m" => path.push(vec![[numbers[0], numbers[1]]]),
            "l" => path.last_mut().unwrap().push([numbers[0], numbers[1]]),
            "S" | "s" | "f" => {
                for mut stroke in path.drain(..) {
                    if word != "S" {
                        stroke.push(stroke[0]);
                    }
                    let [width, opacity] = *pens.last().unwrap();
                    let width = if word == "f" { FILLED } else { width };
                    layers.last_mut().unwrap().stroke(stroke, [width, opacity]);
                }
            }
            "cm" | "J" | "j" | "RG" | "rg" | "EMC" => {}
            name => {
                assert!(name.starts_with('/'), "{name}");
                names.push(name.into());
                continue;
            }
        }
        numbers.clear();
    }
    layers.into_iter().map(Drawn::sorted).collect()
}

/// Dots that are opaque and many, of a few sizes.
fn many(n: usize) -> Marks {
    let r = &mut Random(3);
    let mut marks = sample::marks(true);
    marks.page = Page::in_millimetres(DVec2::new(297.0, 210.0), 0.0, 300.0);
    for layer in &mut marks.layers {
        layer.lines.clear();
        let at = |r: &mut Random| DVec2::new(r.between(0.5, 296.5), r.between(0.5, 209.5));
        let dot = |_| Dot { at: at(r), world: DVec3::ZERO, radius: r.between(0.03, 0.12), opacity: 1.0 };
        layer.dots = (0..n / 2).map(dot).collect();
    }
    marks.round();
    marks
}

#[test]
fn every_file_has_every_mark_where_it_is() {
    let provenance = Provenance::default();
    for marks in [sample::marks(true), sample::marks(false), many(20_000)] {
        let expected: Vec<Drawn> = marks.layers.iter().map(of_marks).collect();
        let sheet = sample::sheet(&marks, &provenance);
        let svg = String::from_utf8(encode_svg(&sheet).unwrap()).unwrap();
        assert!(of_svg(&svg) == expected, "SVG");
        assert!(of_pdf(&encode_pdf(&sheet).unwrap()) == expected, "PDF");
        let folder = tempfile::tempdir().unwrap();
        for (form, name) in [(ListFormat::Csv, "a.csv"), (ListFormat::JsonLines, "a.jsonl")] {
            let path = folder.path().join(name);
            std::fs::write(&path, encode_dots(&marks, form)).unwrap();
            let pens: Vec<_> = marks.layers.iter().map(|layer| layer.pen.clone()).collect();
            let read = read_list(&path, &marks.page, &pens).unwrap();
            assert!(read.iter().zip(&marks.layers).all(|(a, b)| a.dots == b.dots), "{name}");
        }
    }
}

#[test]
fn a_plotter_gets_the_plan_in_its_order() {
    let provenance = Provenance::default();
    let plan = plan(&sample::marks(false), &Speed::default());
    let sheet = VectorPage { plotter: true, ..sample::sheet(&plan.marks, &provenance) };
    let svg = String::from_utf8(encode_svg(&sheet).unwrap()).unwrap();
    let expected: Vec<Drawn> = plan.marks.layers.iter().map(of_marks).collect();
    assert!(of_svg(&svg) == expected);
    let place = |rest: &str| -> Vec<i64> {
        rest.split(' ').next().unwrap().split(',').map(|n| step(n.parse().unwrap())).collect()
    };
    let found: Vec<Vec<i64>> = svg.split("<polyline points=\"").skip(1).map(place).collect();
    let dots = plan.marks.layers.iter().flat_map(|layer| &layer.dots);
    assert!(found.into_iter().eq(dots.map(|dot| steps(dot.at).to_vec())));
}

/// The list that [IO-7]'s bound is for: half a million dots; a naive SVG of as many circles has 21 MB.
#[test]
fn half_a_million_dots_fit_into_eight_megabytes() {
    let (marks, provenance) = (many(500_000), Provenance::default());
    let dots: usize = marks.layers.iter().map(|layer| layer.dots.len()).sum();
    assert_eq!(dots, 500_000);
    let bytes = encode_svg(&sample::sheet(&marks, &provenance)).unwrap().len();
    println!("{bytes} bytes");
    assert!(bytes < 8_000_000, "{bytes}");
}
