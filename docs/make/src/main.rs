//! Writes the generated pages and pictures of the repository.

mod accuracy;
mod blue_noise;
mod called_for;
mod commands;
mod contour_error;
mod cost;
mod faults;
mod files;
mod halos;
mod integrator;
mod labels;
#[cfg(test)]
mod pages;
mod painting;
mod pictures;
mod reference;
mod results;
mod rings;
mod rules;
mod stability;
mod styles;
mod switches;
mod turntable;
mod validation;

use std::process::ExitCode;

/// A page or a set of pictures: the word that asks for it, and what writes it.
type Page = (&'static str, fn() -> Result<(), String>);

const PAGES: &[Page] = &[
    ("accuracy", accuracy::write),
    ("blue-noise", blue_noise::write),
    ("called-for", called_for::write),
    ("commands", commands::run),
    ("contour-error", contour_error::write),
    ("cost", cost::write),
    ("faults", faults::write),
    ("figure-1", painting::figure::write),
    ("halos", halos::write),
    ("integrator", integrator::write),
    ("painting", painting::write),
    ("pictures", pictures::write),
    ("reference", reference::write),
    ("rings", rings::write),
    ("rules", rules::write),
    ("stability", stability::write),
    ("styles", styles::write),
    ("switches", switches::write),
    ("turntable", turntable::write),
    ("validation", validation::write),
];

fn main() -> ExitCode {
    let what = std::env::args().nth(1).unwrap_or_default();
    let done = match PAGES.iter().find(|(name, _)| *name == what) {
        Some((_, write)) => write(),
        None if what == "all" => PAGES.iter().try_for_each(|(_, write)| write()),
        None => Err(format!(
            "usage: drypoint-docs {}|all",
            PAGES.iter().map(|(name, _)| *name).collect::<Vec<_>>().join("|")
        )),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}
