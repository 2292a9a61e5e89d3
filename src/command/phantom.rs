//! `phantom`: a volume with known truth.

use super::report::{note, print};
use super::{Done, Outcome, Talk};
use clap::Args;
use drypoint::Failure;
use drypoint::scene::phantom;
use drypoint::scene::tables::PhantomSource;
use drypoint::scene::volume::{VoxelType, write};
use std::path::PathBuf;

/// Write a phantom as an NRRD volume.
#[derive(Debug, Args)]
pub(super) struct Phantom {
    /// Which phantom; `--list` shows all
    #[arg(required_unless_present = "list")]
    name: Option<String>,
    /// Where to write (.nrrd)
    #[arg(short, long, value_name = "FILE", required_unless_present = "list")]
    output: Option<PathBuf>,
    /// Voxels along each axis: one number, or three as X,Y,Z
    #[arg(long, value_delimiter = ',', default_value = "128")]
    size: Vec<usize>,
    /// World units between voxels: one number, or three as X,Y,Z
    #[arg(long, value_delimiter = ',', default_value = "1")]
    spacing: Vec<f64>,
    /// Stored type: u8, i8, u16, i16, u32, i32, u64, i64, f32, f64
    #[arg(long = "type", value_name = "TYPE", default_value = "u8")]
    voxel_type: String,
    /// A parameter of the phantom, such as R=40
    #[arg(long, value_name = "K=V")]
    param: Vec<String>,
    /// List the phantoms and their parameters
    #[arg(long)]
    list: bool,
}

impl Phantom {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let (false, Some(name), Some(output)) = (self.list, &self.name, &self.output) else { return print(&list()) };
        let voxel_type = VoxelType::from_name(&self.voxel_type).ok_or_else(|| {
            let known: Vec<_> = VoxelType::ALL.iter().map(|t| t.name()).collect();
            Failure::new(
                format!("there is no type `{}`", self.voxel_type),
                "--type",
                format!("one of {}", known.join(", ")),
            )
        })?;
        let source = PhantomSource {
            name: name.clone(),
            size: three(&self.size, "--size")?,
            spacing: three(&self.spacing, "--spacing")?,
            voxel_type,
            params: self.param.iter().map(|p| parameter(p)).collect::<Result<_, _>>()?,
        };
        let volume = phantom::generate(&source).map_err(|e| {
            Failure::new(e, format!("phantom {name}"), "`drypoint phantom --list` lists phantoms and parameters")
        })?;
        write::write_nrrd(&volume, output).map_err(|e| Failure::new(e.what(), e.place(), e.remedy()))?;
        note(talk, output.display());
        Ok(Done::Yes)
    }
}

/// One number for all axes, or three.
fn three<T: Copy>(given: &[T], flag: &str) -> Result<[T; 3], Failure> {
    match *given {
        [a] => Ok([a; 3]),
        [a, b, c] => Ok([a, b, c]),
        _ => Err(Failure::new(format!("{} numbers", given.len()), flag, "give one, or three as X,Y,Z")),
    }
}

/// `k=v`.
fn parameter(text: &str) -> Result<(String, f64), Failure> {
    text.split_once('=')
        .and_then(|(k, v)| Some((k.trim().to_owned(), v.trim().parse::<f64>().ok().filter(|v| v.is_finite())?)))
        .ok_or_else(|| Failure::new(format!("`{text}` is no parameter"), "--param", "write it as R=40"))
}

/// Every phantom with its parameters.
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
