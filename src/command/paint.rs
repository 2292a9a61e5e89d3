//! The verb `paint`: the selection that the strokes of a scene make.

use super::input::{self, SceneOverrides, SetArgs, TemplateArgs};
use super::report::{Progress, note};
use super::{Done, Outcome, Talk, output_path};
use crate::Failure;
use crate::job::{Job, Painting};
use crate::scene::volume::bricked::SIDE;
use crate::scene::volume::write::write_nrrd;
use clap::Args;
use std::path::PathBuf;

/// Write the selection that the strokes of an object paint, as NRRD.
///
/// Strokes are brushes at pixels or points, regions grown from a seed, and watershed basins: `strokes` of [[object]]. Each
/// voxel of the file has a membership from 0 to 1; `selection` of [[object]] reads it back.
#[derive(Debug, Args)]
pub(super) struct PaintArgs {
    /// Scene with [[object]] that has strokes
    #[arg(value_name = "SCENE")]
    input: PathBuf,
    #[command(flatten)]
    template: TemplateArgs,
    /// Output file (.nrrd)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Name of the object, if several have strokes
    #[arg(long, value_name = "NAME")]
    object: Option<String>,
    #[command(flatten)]
    set: SetArgs,
}

impl PaintArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        output_path::volume(&self.output, "a selection")?;
        let mut over = SceneOverrides::new(&self.set, Vec::new())?;
        over.beauty_only = true;
        over.volume.clone_from(&self.template.volume);
        let _working = Progress::new(talk, "painting");
        let job = input::load(Some(&self.input), &over)?;
        output_path::check_not_read(&self.output, job.scene.files().into_iter().chain([&*self.input]))?;
        let object = self.object(&job)?;
        let painting = job.paint(object)?;
        if talk.verbose {
            tell(talk, &painting);
        }
        let volume = painting.selection.to_volume().map_err(|no_room| {
            Failure::new(
                format!("the selection needs {no_room}"),
                self.output.display(),
                "read less with volume.stride",
            )
        })?;
        write_nrrd(&volume, &self.output).map_err(Failure::from)?;
        note(talk, self.output.display());
        Ok(Done::Yes)
    }

    /// Index of the object to paint: the one with the requested name, or the only one with strokes.
    fn object(&self, job: &Job) -> Result<usize, Failure> {
        let objects = || job.scene.objects.iter().enumerate().filter(|(_, object)| object.strokes.is_some());
        let names = || objects().map(|(_, object)| object.name.as_str()).collect::<Vec<_>>().join(", ");
        let scene = self.input.display();
        match (&self.object, &objects().map(|(i, _)| i).collect::<Vec<_>>()[..]) {
            (_, []) => {
                let remedy = "add strokes = [{ pixel = [x, y] }] to an [[object]]";
                Err(Failure::new("no object of the scene has strokes", scene, remedy))
            }
            (Some(name), _) => match objects().find(|(_, object)| object.name == *name) {
                Some((i, _)) => Ok(i),
                None => {
                    let what = format!("no object called {name:?} has strokes");
                    Err(Failure::new(what, scene, format!("name one of these with --object: {}", names())))
                }
            },
            (None, [one]) => Ok(*one),
            (None, _) => {
                let remedy = format!("name one of these with --object: {}", names());
                Err(Failure::new("several objects of the scene have strokes", scene, remedy))
            }
        }
    }
}

/// Reports the extent of each stroke, and the bricks of the selection.
fn tell(talk: Talk, Painting { selection, painted }: &Painting) {
    for (i, painted) in painted.iter().enumerate() {
        note(talk, format_args!("stroke {i}: {} voxels, {} bricks changed", painted.voxels, painted.bricks));
    }
    let memberships = &selection.memberships;
    let (count, distinct) = (memberships.table().len(), memberships.distinct_bricks());
    note(
        talk,
        format_args!("selection: {count} bricks of {SIDE}³ voxels, {distinct} distinct, {} bytes", memberships.bytes()),
    );
}
