//! `docs/cost.md`: what accuracy costs, measured by `drypoint cost` on two phantoms and three scans.

use crate::files;
use drypoint::cost::{Form, Options, Sweep, markdown, sweep};
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

const SCENES: [Measured; 5] = [
    Measured { name: "torus", file: "cost/torus.toml", over: &[] },
    Measured { name: "marschner-lobb", file: "cost/marschner-lobb.toml", over: &[] },
    Measured { name: "engine", file: "style_transfer_functions/engine.toml", over: &[("picture.size", "[144, 128]")] },
    Measured { name: "head", file: "style_transfer_functions/head.toml", over: &[("picture.size", "[128, 139]")] },
    // Along the ray: smoothing 256³ voxels for the exact curvature of every setting takes longer than all else.
    Measured {
        name: "vessels",
        file: "style_transfer_functions/vessels.toml",
        over: &[("picture.size", "[144, 144]"), ("contours.kappa", "ray")],
    },
];

/// The most bytes of a picture in `docs`.
const LARGEST: usize = 300_000;

/// Measures all and writes the page and its plots.
///
/// # Errors
/// A scan that is not there, what the renderer or the system says, and a plot that is too large for a page.
pub(crate) fn write() -> Result<(), String> {
    let mut page = PAGE.to_owned();
    for Measured { name, file, over } in SCENES {
        let found = measured(file, over)?;
        let plot = Form::Png.of_sweep(&found, name)?;
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
    sweep(&job, &Options { runs: RUNS, only: Vec::new() }, &|_| ()).map_err(|e| e.to_string())
}

/// How often each setting is timed.
const RUNS: usize = 5;

/// The page around its tables, which stand where their names are.
const PAGE: &str = include_str!("page.md");
