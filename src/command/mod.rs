//! The verbs of the command line, one file each. Exit codes are decided here alone.

mod arguments;
mod compare;
mod completions;
mod cost;
mod empty;
mod figure;
mod frames;
mod graphics;
mod halo;
mod info;
mod input;
mod limits;
mod output_path;
mod page;
mod paint;
mod phantom;
mod pick;
mod plan;
mod points;
mod probe;
mod raw;
mod render;
mod report;
mod schema;
mod sheet;
mod signals;
mod stats;
mod strokes;
mod styles;
mod validate;
mod view;
mod wedge;

use crate::Failures;
use arguments::Arguments;
use clap::{Args, Parser, Subcommand};
use limits::LimitArgs;
use std::ffi::OsString;
use std::process::ExitCode;

/// Draws illustrations of volumes from CT, MRI and simulation: lit-sphere styles, contours, halos, clip planes, lifted
/// and ghosted parts with labels, stipples and hatching.
///
/// It implements five papers: Style Transfer Functions (Bruckner and Gröller 2007), Flexible Volumetric Halos (the same,
/// 2007), VolumeShop (the same, 2005), Volume Stippling (Lu et al. 2002) and Interactive Volume Illustration (Nagy et al.
/// 2002).
///
/// The default verb is render: `drypoint head.nii.gz` does the same as `drypoint render head.nii.gz`. Exit codes: 0
/// success, 1 a comparison failed, 2 bad use or bad input, 3 a comparison proved nothing, 130 interrupted, 143 or 129
/// ended by SIGTERM or SIGHUP.
#[derive(Debug, Parser)]
#[command(name = "drypoint", version, propagate_version = true, subcommand_required = true)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
    #[command(flatten)]
    talk: Talk,
    #[command(flatten)]
    limits: LimitArgs,
}

/// Verbosity of the command.
#[derive(Clone, Copy, Debug, Default, Args)]
struct Talk {
    /// Print errors only
    #[arg(short, long, global = true)]
    quiet: bool,
    /// Print details: loaded files, the plan, counts
    #[arg(short, long, global = true, conflicts_with = "quiet")]
    verbose: bool,
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// Render a scene or a bare volume to a picture (the default verb)
    Render(render::RenderArgs),
    /// Open a window in which a volume is turned and its scene file edited
    View(view::ViewArgs),
    /// Describe a volume file: size, type, range, histogram
    Info(info::InfoArgs),
    /// Print value, derivatives and curvature at points
    Probe(probe::ProbeArgs),
    /// Print which part of a volume is visible at a pixel
    Pick(pick::PickArgs),
    /// Write the selection that the strokes of a scene paint, as a volume
    Paint(paint::PaintArgs),
    /// Write a test volume with known values and curvatures
    Phantom(phantom::PhantomArgs),
    /// List the work that a scene needs, and the keys that ask for it
    Plan(plan::PlanArgs),
    /// Draw a scene or a volume in stipples, as SVG, PDF, PNG, EXR or a list of dots
    Points(points::PointsArgs),
    /// Draw a scene or a volume in hatching or outlines, as SVG, PDF, PNG, EXR or a list of strokes
    Strokes(strokes::StrokesArgs),
    /// List the styles of a theme or lighting functions, write a preview sheet, or make a style from a picture
    Styles(styles::StylesArgs),
    /// Compare two pictures; exit code 1 when a bound is exceeded
    Compare(compare::CompareArgs),
    /// Compare a graphics card with the reference, within derived bounds; exit code 1 when one is exceeded, 3 when
    /// nothing could have failed
    Validate(validate::ValidateArgs),
    /// Measure error and time of every accuracy setting of a scene
    Cost(cost::CostArgs),
    /// Draw several scenes on one page, with letters, captions and insets
    Figure(figure::FigureArgs),
    /// Write a contact sheet of volumes, scenes or pictures
    Sheet(sheet::SheetArgs),
    /// Spread a picture of seeds into a halo
    Halo(halo::HaloArgs),
    /// Write a step wedge to calibrate a pen, or plot its measured tones
    Wedge(wedge::WedgeArgs),
    /// Print the JSON Schema of scene files
    Schema(schema::SchemaArgs),
    /// Print shell completions
    Completions(completions::CompletionsArgs),
}

/// Successful end of a verb.
enum Done {
    /// The work is done.
    Yes,
    /// A comparison failed.
    Different,
    /// A comparison could not have failed.
    #[cfg(feature = "gpu")]
    NotProven,
}

type Outcome = Result<Done, Failures>;

/// Exit code of bad use or bad input.
const BAD: u8 = 2;

/// Exit code of a comparison that could not have failed.
#[cfg(feature = "gpu")]
const NOT_PROVEN: u8 = 3;

/// Runs a command line. Exit codes: 0 done, 1 a comparison failed, 2 bad use or bad input, 3 a comparison proved nothing,
/// 128 + n ended by signal n.
pub fn run(words: impl IntoIterator<Item = OsString>) -> ExitCode {
    signals::remove_unfinished_at_the_end();
    match parsed(words) {
        Ok(Ok(cli)) => exit_code(cli.run()),
        Ok(Err(help)) => {
            // Printing can only fail on a closed pipe, where nobody reads.
            let _ = help.print();
            ExitCode::SUCCESS
        }
        Err(failures) => exit_code(Err(failures)),
    }
}

fn exit_code(outcome: Outcome) -> ExitCode {
    match outcome {
        Ok(Done::Yes) => ExitCode::SUCCESS,
        Ok(Done::Different) => ExitCode::FAILURE,
        #[cfg(feature = "gpu")]
        Ok(Done::NotProven) => ExitCode::from(NOT_PROVEN),
        Err(failures) => {
            report::say(failures);
            ExitCode::from(BAD)
        }
    }
}

/// Returns the verb and its arguments, or the requested help or version.
fn parsed(words: impl IntoIterator<Item = OsString>) -> Result<Result<Cli, clap::Error>, Failures> {
    let Arguments { words, verb } = Arguments::new(words);
    match Cli::try_parse_from(words) {
        Err(error) if error.use_stderr() => Err(arguments::refused(&error, &verb).into()),
        result => Ok(result),
    }
}

impl Cli {
    fn run(self) -> Outcome {
        let talk = self.talk;
        self.limits.apply()?;
        match self.verb {
            Verb::Render(verb) => verb.run(talk),
            Verb::View(verb) => verb.run(),
            Verb::Info(verb) => verb.run(talk),
            Verb::Probe(verb) => verb.run(talk),
            Verb::Pick(verb) => verb.run(talk),
            Verb::Paint(verb) => verb.run(talk),
            Verb::Phantom(verb) => verb.run(talk),
            Verb::Plan(verb) => verb.run(talk),
            Verb::Points(verb) => verb.run(talk),
            Verb::Strokes(verb) => verb.run(talk),
            Verb::Styles(verb) => verb.run(talk),
            Verb::Compare(verb) => verb.run(talk),
            Verb::Validate(verb) => verb.run(talk),
            Verb::Cost(verb) => verb.run(talk),
            Verb::Figure(verb) => verb.run(talk),
            Verb::Sheet(verb) => verb.run(talk),
            Verb::Halo(verb) => verb.run(talk),
            Verb::Wedge(verb) => verb.run(talk),
            Verb::Schema(verb) => verb.run(),
            Verb::Completions(verb) => verb.run(),
        }
    }
}
