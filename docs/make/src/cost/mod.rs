//! `docs/cost.md` and `docs/cost-tables.md`: what accuracy costs, measured by `drypoint cost` on two phantoms and four
//! data sets.

mod choices;
mod errors;
mod stored;

use crate::files;
use drypoint::cost::{SweepFormat, SweepOptions, markdown, sweep};
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, load};
use std::path::Path;

/// A scene to measure.
struct Measured {
    /// Its name on the page.
    name: &'static str,
    /// Its file under `data/scenes`.
    file: &'static str,
    /// What is other than in the file, so that the page takes minutes.
    over: &'static [(&'static str, &'static str)],
}

/// Which pixels get further rays at edges would be part of the error of every knob.
const ONE_RAY: (&str, &str) = ("picture.samples", "1");

const SCENES: [Measured; 7] = [
    Measured { name: "torus", file: "cost/torus.toml", over: &[] },
    Measured { name: "marschner-lobb", file: "cost/marschner-lobb.toml", over: &[] },
    Measured {
        name: "engine",
        file: "style_transfer_functions/engine.toml",
        over: &[("picture.size", "[144, 128]"), ONE_RAY],
    },
    Measured {
        name: "head",
        file: "style_transfer_functions/head.toml",
        over: &[("picture.size", "[128, 139]"), ONE_RAY],
    },
    // Along the ray: smoothing 256³ voxels for the exact curvature of every setting takes longer than all else.
    Measured {
        name: "vessels",
        file: "style_transfer_functions/vessels.toml",
        over: &[("picture.size", "[144, 144]"), ("contours.kappa", "ray"), ONE_RAY],
    },
    // A quarter of the points: N_max counts pixels.
    Measured { name: "dots", file: "volume_stippling/figure_1_b.toml", over: &[("picture.size", "[430, 360]")] },
    Measured { name: "strokes", file: "cost/strokes.toml", over: &[] },
];

/// The most bytes of a picture in `docs`.
const LARGEST: usize = 300_000;

/// Scenes of the table of choices: pictures of volumes.
const CHOSEN: [&str; 4] = ["torus", "engine", "head", "vessels"];

/// The parts beside the scenes that can be named. `plots` measures nothing.
const PARTS: [&str; 3] = ["choices", "errors", "plots"];

/// Measures all, or the scenes and parts that are named behind `cost`, and writes the pages and their pictures. What is
/// not measured stays as the pages have it, and its plots are drawn anew from the tables.
///
/// # Errors
/// An unknown name, a scan that is not there, errors of the renderer or the system, and a plot that is too large for a
/// page.
pub(crate) fn write() -> Result<(), String> {
    let only: Vec<String> = std::env::args().skip(2).collect();
    let known: Vec<&str> = SCENES.iter().map(|scene| scene.name).chain(PARTS).collect();
    if let Some(other) = only.iter().find(|only| !known.contains(&only.as_str())) {
        return Err(format!("{other} is none of {}", known.join(", ")));
    }
    let is_wanted = |part: &str| only.is_empty() || only.iter().any(|only| only == part);
    let before = |page: &str| {
        let place = files::in_docs(page);
        std::fs::read_to_string(&place).map_err(|error| format!("{}: {error}", place.display()))
    };
    if is_wanted("errors") {
        picture("errors.png", &errors::png()?)?;
    }
    // The tables of the scenes, under their headings.
    let mut tables = TABLES.to_owned();
    for scene in &SCENES {
        let Measured { name, .. } = scene;
        let found = if is_wanted(name) {
            let options = SweepOptions { runs: RUNS, only: Vec::new() };
            sweep(&job(scene, &[])?, &options, &[], &|_| ()).map_err(|e| e.to_string())?
        } else {
            stored::sweep(&part(&before("cost-tables.md")?, &format!("<a id=\"{name}\"></a>\n\n"), "\n## ")?)?
        };
        picture(&format!("{name}.png"), &SweepFormat::Png.of_sweep(&found, name)?)?;
        let table = markdown(&found);
        tables = tables.replace(&format!("{{{name}}}"), &table);
    }
    // The page itself.
    let choices = if is_wanted("choices") {
        choices::table(&SCENES.iter().filter(|scene| CHOSEN.contains(&scene.name)).collect::<Vec<_>>())?
    } else {
        let before = before("cost.md")?;
        format!("| for |{}", part(&before, "\n| for |", "\n\n")?)
    };
    files::write("cost-tables.md", format!("{}\n", tables.trim_end()).as_bytes())?;
    files::write("cost.md", PAGE.replace("{choices}", choices.trim_end()).as_bytes())
}

/// Writes a picture of the page.
fn picture(name: &str, png: &[u8]) -> Result<(), String> {
    if png.len() > LARGEST {
        return Err(format!("{name} has {} bytes, more than {LARGEST}", png.len()));
    }
    files::write(&format!("pictures/cost/{name}"), png)
}

/// Loads a scene with further settings.
fn job(scene: &Measured, settings: &[(&str, &str)]) -> Result<Job, String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/scenes").join(scene.file);
    let overrides: Overrides = scene.over.iter().chain(settings).copied().collect();
    let scene = load(&path, &overrides).map_err(|e| e.to_string())?;
    Job::load(scene).map_err(|e| e.to_string())
}

/// Returns the part of a page between two texts, or up to its end.
fn part(page: &str, from: &str, to: &str) -> Result<String, String> {
    let (_, rest) = page.split_once(from).ok_or_else(|| format!("the page has no {from:?}: measure it, too"))?;
    Ok(rest.split(to).next().unwrap_or(rest).into())
}

/// How often each setting is timed.
const RUNS: usize = 5;

/// The page around its table of choices.
const PAGE: &str = include_str!("page.template");

/// The page of tables, which stand where their names are.
const TABLES: &str = include_str!("tables.template");
