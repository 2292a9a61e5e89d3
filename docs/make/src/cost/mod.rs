//! `docs/cost.md`: what accuracy costs, measured by `drypoint cost` on two phantoms and four data sets.

use crate::files;
use drypoint::cost::{Sweep, SweepFormat, SweepOptions, markdown, sweep};
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

/// Measures all, or those that are named behind `cost`, and writes the page and its plots; what is not measured stays as the
/// page has it.
///
/// # Errors
/// A name of none, a scan that is not there, what the renderer or the system says, and a plot that is too large for a page.
pub(crate) fn write() -> Result<(), String> {
    let only: Vec<String> = std::env::args().skip(2).collect();
    if let Some(other) = only.iter().find(|only| SCENES.iter().all(|scene| scene.name != **only)) {
        let names = SCENES.map(|scene| scene.name).join(", ");
        return Err(format!("{other} is none of {names}"));
    }
    let place = files::in_docs("cost.md");
    let before = std::fs::read_to_string(&place).map_err(|error| format!("{}: {error}", place.display()))?;
    let mut page = PAGE.to_owned();
    for Measured { name, file, over } in SCENES {
        if !only.is_empty() && !only.iter().any(|only| only == name) {
            page = page.replace(&format!("{{{name}}}"), table_of(&before, name)?);
            continue;
        }
        let found = measured(file, over)?;
        let plot = SweepFormat::Png.of_sweep(&found, name)?;
        if plot.len() > LARGEST {
            return Err(format!("the plot of {name} has {} bytes, more than {LARGEST}", plot.len()));
        }
        files::write(&format!("pictures/cost/{name}.png"), &plot)?;
        page = page.replace(&format!("{{{name}}}"), &markdown(&found));
    }
    files::write("cost.md", page.as_bytes())
}

fn measured(file: &str, over: &[(&str, &str)]) -> Result<Sweep, String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/scenes").join(file);
    let scene = load(&path, &over.iter().copied().collect::<Overrides>()).map_err(|e| e.to_string())?;
    let job = Job::load(scene).map_err(|e| e.to_string())?;
    sweep(&job, &SweepOptions { runs: RUNS, only: Vec::new() }, &|_| ()).map_err(|e| e.to_string())
}

/// The table under a plot, from its line of runs to its last row.
fn table_of<'p>(page: &'p str, name: &str) -> Result<&'p str, String> {
    let plot = format!("(pictures/cost/{name}.png)\n\n");
    let table = page.split_once(&plot).and_then(|(_, rest)| rest.split_once("\n- **Preview**"));
    table.map(|(table, _)| table).ok_or_else(|| format!("docs/cost.md has no table of {name}: measure it, too"))
}

/// How often each setting is timed.
const RUNS: usize = 5;

/// The page around its tables, which stand where their names are.
const PAGE: &str = include_str!("page.md");
