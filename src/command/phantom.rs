//! The verb `phantom`: a volume with known truth.

use super::report::{Progress, note, print};
use super::{Done, Outcome, Talk, output_path};
use crate::Failure;
use crate::scene::phantom;
use crate::scene::phantom::PhantomError;
use crate::scene::tables::PhantomSource;
use crate::scene::volume::VoxelType;
use crate::scene::volume::write::write_nrrd;
use clap::Args;
use clap::builder::PossibleValuesParser;
use std::path::PathBuf;

/// Write a test volume with known values and curvatures, as NRRD.
#[derive(Debug, Args)]
pub(super) struct PhantomArgs {
    /// Name of the phantom; see `--list`
    #[arg(required_unless_present = "list", value_parser = PossibleValuesParser::new(phantom::names()), hide_possible_values = true)]
    name: Option<String>,
    /// Output file (.nrrd)
    #[arg(short, long, value_name = "FILE", required_unless_present = "list")]
    output: Option<PathBuf>,
    /// Number of voxels along the axes: N, or X,Y,Z
    #[arg(long, value_name = "N", value_delimiter = ',', default_value = "128")]
    size: Vec<usize>,
    /// Voxel spacing in world units: one number, or X,Y,Z
    #[arg(long, value_name = "X", value_delimiter = ',', default_value = "1")]
    spacing: Vec<f64>,
    /// Stored voxel type
    #[arg(long = "type", value_name = "TYPE", default_value = "u8", value_parser = PossibleValuesParser::new(VoxelType::ALL.iter().map(|t| t.name())))]
    voxel_type: String,
    /// Parameter of the phantom, such as R=40; can be repeated
    #[arg(long, value_name = "K=V", value_parser = parameter)]
    param: Vec<(String, f64)>,
    /// List the phantoms and their parameters
    #[arg(long)]
    list: bool,
}

impl PhantomArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let (false, Some(name), Some(output)) = (self.list, &self.name, &self.output) else { return print(&list()) };
        output_path::volume(output, "a phantom")?;
        let source = PhantomSource {
            name: name.clone(),
            size: three(&self.size, "--size")?,
            spacing: three(&self.spacing, "--spacing")?,
            voxel_type: VoxelType::from_name(&self.voxel_type).unwrap_or(VoxelType::U8),
            params: self.param,
        };
        let _making = Progress::new(talk, name);
        let volume = phantom::generate(&source).map_err(|error| {
            let remedy = match &error {
                PhantomError::Memory { .. } => "ask for fewer voxels with --size",
                PhantomError::Space(_) => "give other numbers with --size or --spacing",
                _ => "`drypoint phantom --list` lists phantoms and parameters",
            };
            Failure::new(&error, format_args!("drypoint phantom {name}"), remedy)
        })?;
        write_nrrd(&volume, output).map_err(Failure::from)?;
        note(talk, output.display());
        Ok(Done::Yes)
    }
}

/// Returns three numbers from one for all axes, or from three.
fn three<T: Copy>(given: &[T], flag: &str) -> Result<[T; 3], Failure> {
    match *given {
        [a] => Ok([a; 3]),
        [a, b, c] => Ok([a, b, c]),
        _ => Err(Failure::new(format!("{} numbers for three axes", given.len()), flag, "give one, or three as X,Y,Z")),
    }
}

/// Parses `k=v`.
fn parameter(text: &str) -> Result<(String, f64), &'static str> {
    let pair = text.split_once('=').and_then(|(k, v)| Some((k.trim().to_owned(), v.trim().parse::<f64>().ok()?)));
    pair.ok_or("a parameter is a name and a number, such as R=40")
}

/// Returns all phantoms with their parameters.
fn list() -> String {
    let mut text = String::new();
    for about in phantom::describe() {
        text += &format!("{}\n    {}\n", about.name, about.doc);
        for p in about.params {
            text += &format!("    {} = {}: {}\n", p.name, p.default, p.doc);
        }
    }
    text
}
