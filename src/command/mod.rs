//! The verbs of the command line, one file each; exit codes are decided here and nowhere else.

mod compare;
mod completions;
mod info;
mod input;
mod phantom;
mod plan;
mod probe;
mod render;
mod report;
mod schema;
mod sheet;
mod styles;

use clap::{Args, Parser, Subcommand};
use drypoint::Failure;
use drypoint::output::atomic;
use std::ffi::OsString;
use std::process::ExitCode;

/// Illustrations from volumes: CT, MRI and simulation data in lit-sphere styles with contours of controlled thickness.
#[derive(Debug, Parser)]
#[command(name = "drypoint", version, about, propagate_version = true, args_conflicts_with_subcommands = true)]
struct Cli {
    #[command(subcommand)]
    verb: Option<Verb>,
    #[command(flatten)]
    render: render::Render,
    #[command(flatten)]
    talk: Talk,
}

/// How much the command says.
#[derive(Clone, Copy, Debug, Default, Args)]
struct Talk {
    /// Say nothing but errors
    #[arg(short, long, global = true)]
    quiet: bool,
    /// Say more: what was loaded, the plan, the counts
    #[arg(short, long, global = true)]
    verbose: bool,
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// Render a scene or a bare volume to a picture (the default verb)
    Render(render::Render),
    /// Say what a volume file holds
    Info(info::Info),
    /// Print value, derivatives and curvature at points
    Probe(probe::Probe),
    /// Write a phantom with known truth as a volume
    Phantom(phantom::Phantom),
    /// Say what a scene calls for, and why
    Plan(plan::Plan),
    /// List the styles of a theme, or write a preview sheet
    Styles(styles::Styles),
    /// Compare two pictures; exit code 1 when a bound is exceeded
    Compare(compare::Compare),
    /// Write a contact sheet of volumes, scenes or pictures
    Sheet(sheet::Sheet),
    /// Print the JSON Schema of scene files
    Schema(schema::Schema),
    /// Print completions for a shell
    Completions(completions::Completions),
}

/// How a verb ended well.
enum Done {
    /// It did what it was asked.
    Yes,
    /// A comparison failed.
    Different,
}

/// Runs a command line. 0: done; 1: a comparison failed; 2: bad use or bad input.
pub(crate) fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) => {
            // Printing can only fail on a closed pipe, where nobody reads.
            let _ = error.print();
            return if error.use_stderr() { ExitCode::from(2) } else { ExitCode::SUCCESS };
        }
    };
    let talk = cli.talk;
    // Ctrl-C leaves no half file. Where no handler can be set, the unfinished file has a name of its own beside the target.
    let _ = ctrlc::set_handler(|| {
        atomic::remove_unfinished();
        std::process::exit(2);
    });
    let result = match cli.verb {
        None => cli.render.run(talk),
        Some(Verb::Render(verb)) => verb.run(talk),
        Some(Verb::Info(verb)) => verb.run(),
        Some(Verb::Probe(verb)) => verb.run(),
        Some(Verb::Phantom(verb)) => verb.run(talk),
        Some(Verb::Plan(verb)) => verb.run(),
        Some(Verb::Styles(verb)) => verb.run(talk),
        Some(Verb::Compare(verb)) => verb.run(),
        Some(Verb::Sheet(verb)) => verb.run(talk),
        Some(Verb::Schema(verb)) => verb.run(),
        Some(Verb::Completions(verb)) => verb.run(),
    };
    match result {
        Ok(Done::Yes) => ExitCode::SUCCESS,
        Ok(Done::Different) => ExitCode::from(1),
        Err(failures) => {
            for failure in failures.0 {
                eprintln!("{failure}");
            }
            ExitCode::from(2)
        }
    }
}

/// Everything that was wrong.
struct Failures(Vec<Failure>);

impl From<Failure> for Failures {
    fn from(failure: Failure) -> Self {
        Self(vec![failure])
    }
}

impl From<Vec<Failure>> for Failures {
    fn from(failures: Vec<Failure>) -> Self {
        Self(failures)
    }
}

type Outcome = Result<Done, Failures>;
