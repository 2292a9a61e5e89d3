//! Scenes of dots and lines: whatever the tables say, marks are numbers on the page, one list with any number of threads; what
//! does not go together is refused by key.

mod from_schema;

use super::coverage::{described, drawn};
use super::generator::{dims, grid, volume};
use crate::common::random::Random;
use drypoint::Failures;
use drypoint::drawing::Drawing;
use drypoint::job::Job;
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse, schema};
use drypoint::scene::marks::Marks;
use drypoint::scene::picture::{LayerKind, Picture};
use drypoint::scene::volume::Volume;
use from_schema::value;
use std::collections::BTreeSet;
use std::path::Path;
use toml::Value;

const SEEDS: std::ops::Range<u64> = 0..400;

const TABLES: [&str; 3] = ["hatching", "outlines", "stipples"];

/// A scene's text, a volume of a few voxels for it, and the keys of [`TABLES`] that it has.
struct Sheet {
    text: String,
    volume: Volume,
    keys: Vec<String>,
}

fn sheet(seed: u64, described: &BTreeSet<String>) -> Sheet {
    let mut r = Random(seed ^ 0x3a7c_0000);
    let grid = if r.once_in(4) {
        let dims = dims(&mut r);
        grid(&mut r, dims)
    } else {
        let dims = [0; 3].map(|_| 5 + r.below(8));
        grid(&mut r, dims)
    };
    let volume = volume(&mut r, grid);
    let [lo, hi] = volume.range();
    let within = |r: &mut Random| Value::Float(r.between(lo - 0.02 * (hi - lo), hi + 0.02 * (hi - lo)));
    let schema = schema();
    let mut tables = toml::Table::new();
    let first = r.below(3);
    for (i, name) in TABLES.into_iter().enumerate() {
        if i == first || r.once_in(4) {
            let Value::Table(mut table) = value(&mut r, &schema["properties"][name]) else { unreachable!() };
            // A number that the volume knows nothing of would be refused nearly always.
            for key in ["iso", "hide_behind"] {
                if table.get(key).is_some_and(Value::is_float) {
                    table.insert(key.into(), within(&mut r));
                }
            }
            tables.insert(name.into(), Value::Table(table));
        }
    }
    let mut all = Vec::new();
    drawn("", &Value::Table(tables.clone()), described, &mut all);
    let with_transfer = r.once_in(2);
    if with_transfer {
        let mut node = |opacity: f64| {
            let mut node = toml::Table::new();
            node.insert("at".into(), within(&mut r));
            node.insert("color".into(), Value::String("#8060a0".into()));
            node.insert("opacity".into(), Value::Float(opacity));
            node
        };
        let mut nodes = [0.0, 0.7, 0.1].map(&mut node);
        nodes.sort_by(|a, b| a["at"].as_float().unwrap().total_cmp(&b["at"].as_float().unwrap()));
        let mut transfer = toml::Table::new();
        transfer.insert("kind".into(), Value::String("regular".into()));
        transfer.insert("nodes".into(), Value::Array(nodes.map(Value::Table).into()));
        tables.insert("transfer".into(), Value::Table(transfer));
    }
    if r.once_in(4) {
        let mut surface = toml::Table::new();
        surface.insert("iso".into(), within(&mut r));
        surface.insert("look".into(), Value::String(r.pick(&["white", "phong", "none"]).into()));
        tables.insert("surface".into(), Value::Table(surface));
    }
    let [direction, up] = [0; 2].map(|_| r.direction());
    let projection = r.pick(&["orthographic", "perspective"]);
    let kernel = r.pick(&["trilinear", "trilinear", "bspline", "bspline-smooth", "bspline5", "catmull-rom"]);
    let size = [8 + r.below(40), 8 + r.below(40)];
    let text = format!(
        "drypoint = 1\n[volume]\nphantom = {{ name = \"specimen\" }}\n\
         [camera]\nprojection = \"{projection}\"\ndirection = {direction:?}\nup = {up:?}\n\
         [picture]\nsize = {size:?}\ndpi = {}\n[sampling]\nkernel = \"{kernel}\"\n\
         [[pen]]\nname = \"black\"\nwidth = \"0.3 mm\"\ncolor = \"black\"\n\
         [[pen]]\nname = \"sepia\"\nwidth = \"0.5 mm\"\ncolor = \"#5a3a20\"\n{tables}",
        r.pick(&[25, 72])
    );
    Sheet { text, volume, keys: all.into_iter().map(|(key, _)| key).collect() }
}

/// What is drawn, or why not.
fn draw(sheet: &Sheet) -> Result<(Marks, Picture), Failures> {
    let scene = parse(&sheet.text, Path::new("scene.toml"), &Overrides::default())?;
    let job = Job::with_volume(scene, sheet.volume.clone())?;
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_| ())?;
    let view = job.view()?;
    let marks = marking.frames(&mut counts).map(|mut frames| frames.draw(&view, &mut counts)).transpose()?;
    let (frame, _) = Drawing::new(&job, &marking, &mut counts)?.frame(0, &|_| ())?;
    Ok((marks.unwrap(), frame.painted(&job)?))
}

/// Places, widths and opacities are numbers, t ascends along a line in [0, 1], and what goes to a file is on the page.
fn sound(marks: &Marks, place: &str) {
    for layer in &marks.layers {
        for dot in &layer.dots {
            assert!(dot.at.is_finite() && dot.world.is_finite() && dot.radius.is_finite(), "{place}: {dot:?}");
            assert!(dot.radius >= 0.0 && (0.0..=1.0).contains(&dot.opacity), "{place}: {dot:?}");
        }
        for line in &layer.lines {
            for v in &line.vertices {
                assert!(v.at.is_finite() && v.world.is_finite() && v.radius.is_finite(), "{place}: {v:?}");
                assert!(v.radius >= 0.0 && (0.0..=1.0).contains(&v.opacity), "{place}: {v:?}");
                assert!((0.0..=1.0).contains(&v.t), "{place}: {v:?}");
                assert!(v.color.is_none_or(|c| c.iter().all(|c| (0.0..=1.0).contains(c))), "{place}: {v:?}");
            }
            // What is seen of a closed line may lead over its beginning.
            let falls = line.vertices.windows(2).filter(|pair| pair[1].t < pair[0].t).count();
            assert!(falls <= 1, "{place}: {:?}", line.vertices);
        }
    }
    let mut settled = marks.clone();
    settled.settle();
    let page = settled.page;
    let inside = |at: drypoint::scene::glam::DVec2, radius: f64| {
        let low = at - radius - page.margin;
        let high = at + radius + page.margin - page.size;
        low.min_element() >= -1e-9 && high.max_element() <= 1e-9
    };
    for layer in &settled.layers {
        for dot in &layer.dots {
            assert!(inside(dot.at, 0.0) && dot.radius > 0.0 && dot.opacity > 0.0, "{place}: {dot:?}");
        }
        for v in layer.lines.iter().flat_map(|line| &line.vertices) {
            assert!(inside(v.at, 0.0), "{place}: {v:?}");
        }
    }
}

#[test]
fn marks_are_numbers_on_the_page() {
    let mut all = BTreeSet::new();
    described("", &schema(), &mut all);
    let mut keys = all.clone();
    keys.retain(|key| TABLES.iter().any(|table| key.starts_with(&format!("{table}."))));
    // Names of colours stand for numbers, which are drawn; what a pen is called is the pen's.
    keys.retain(|key| ![".color = ", ".front = ", ".back = "].iter().any(|color| key.contains(color)));
    let (mut found, mut with_marks, mut refused) = (BTreeSet::new(), 0, 0);
    for seed in SEEDS {
        let sheet = sheet(seed, &all);
        let place = format!("seed {seed}, {:?}:\n{}", sheet.volume.dims(), sheet.text);
        match draw(&sheet) {
            Ok((marks, picture)) => {
                sound(&marks, &place);
                let beauty = &picture.layer(LayerKind::Beauty).unwrap().channels;
                assert!(beauty.iter().flatten().all(|v| v.is_finite() && *v >= 0.0), "{place}");
                assert!(beauty[3].iter().all(|a| *a <= 1.0), "{place}");
                with_marks += usize::from(marks.layers.iter().any(|l| !l.dots.is_empty() || !l.lines.is_empty()));
                found.extend(sheet.keys);
            }
            Err(failures) => {
                refused += 1;
                for failure in failures.iter() {
                    println!("{seed}: {failure}");
                }
            }
        }
    }
    let missing: Vec<&String> = keys.iter().filter(|key| !found.contains(*key)).collect();
    println!(
        "{} of {} keys and names are drawn; {with_marks} scenes have marks, {refused} are refused",
        keys.len() - missing.len(),
        keys.len()
    );
    assert!(missing.is_empty(), "never drawn: {missing:?}");
    assert!(with_marks > 150 && refused < 150, "{with_marks} {refused}");
}

/// [RAY-3] of marks.
#[test]
fn threads_draw_the_same_marks() {
    let pools = [1, 2, 7].map(|n| rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap());
    let mut all = BTreeSet::new();
    described("", &schema(), &mut all);
    for seed in 1000..1060 {
        let sheet = sheet(seed, &all);
        let [a, b, c] = pools.each_ref().map(|pool| pool.install(|| draw(&sheet).ok().map(|(marks, _)| marks)));
        assert!(a == b && b == c, "seed {seed}:\n{}", sheet.text);
    }
}
