//! The verb `figure`: several scenes on one page.

use super::input::{self, SceneOverrides, SetArgs, VerbInput};
use super::report::{Progress, note};
use super::{Done, Outcome, Talk, output_path, render::Backend};
use crate::figure::{DrawnPanel, FigureLayout, PanelPlace};
use crate::gpu::Gpu;
use crate::job::RenderTarget;
use crate::output::read::{Image, read_image};
use crate::scene::file::{self, Overrides};
use crate::scene::tables::{Camera, Figure, PanelCameras, PanelSource};
use crate::{Failure, Failures, Format};
use clap::Args;
use std::path::{Path, PathBuf};

/// Draw several scenes on one page, with letters, captions and insets.
#[derive(Debug, Args)]
pub(super) struct FigureArgs {
    /// Figure file (.toml)
    #[arg(value_name = "FIGURE")]
    figure: PathBuf,
    /// Output file (.png, .exr, .svg, .pdf) [default: the figure's name with .png, in the working directory]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Renderer
    #[arg(long, value_enum, default_value_t = Backend::Reference)]
    backend: Backend,
    #[command(flatten)]
    set: SetArgs,
}

/// A panel's picture before it is drawn.
enum PanelInput {
    Scene(Box<VerbInput>),
    Picture(Image),
}

impl FigureArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let output = self.output.clone().unwrap_or_else(|| format!("{}.png", output_path::stem(&self.figure)).into());
        output_path::picture(&output, &FORMATS)?;
        let gpu = self.backend.open(talk)?;
        let mut overrides = Overrides::default();
        for argument in &self.set.set {
            overrides.push_argument(argument)?;
        }
        let figure = file::load_figure(&self.figure, &overrides)?;
        let sources = figure.sources();
        let named = sources.iter().flat_map(|(_, source)| source.files()).map(PathBuf::as_path);
        output_path::check_not_read(&output, named.chain([self.figure.as_path()]))?;
        let mut inputs = sources
            .iter()
            .map(|(table, source)| Ok((table.as_str(), found(&figure, table, source)?)))
            .collect::<Result<Vec<_>, Failures>>()?;
        if figure.figure.camera == PanelCameras::Shared {
            share_camera(&mut inputs);
        }
        let sizes: Vec<[usize; 2]> = inputs.iter().map(|(_, input)| input.size()).collect();
        let layout = FigureLayout::new(&figure, &sizes)?;
        let panels = inputs
            .into_iter()
            .zip(layout.places())
            .map(|((table, input), place)| {
                input.drawn(&layout, place, table, [&output, &self.figure], gpu.as_ref(), talk)
            })
            .collect::<Result<Vec<_>, Failures>>()?;
        for line in layout.write_panels(panels, &output)?.notes {
            note(talk, line);
        }
        note(talk, output.display());
        Ok(Done::Yes)
    }
}

/// Formats of a page.
const FORMATS: [Format; 4] = [Format::Png, Format::Exr, Format::Svg, Format::Pdf];

/// Reads a picture, or finds a scene.
fn found(figure: &Figure, table: &str, source: &PanelSource) -> Result<PanelInput, Failures> {
    if let Some(path) = &source.picture {
        let image = read_image(path).map_err(|error| Failure::picture(&error, path.display()))?;
        return Ok(PanelInput::Picture(image));
    }
    let set = SetArgs { set: source.set.clone() };
    let scene = SceneOverrides::new(&set, Vec::new()).and_then(|mut over| {
        (over.beauty_only, over.volume) = (true, source.volume.clone());
        input::find(source.scene.as_deref(), &over)
    });
    // The keys of a panel stand in the figure, not on the command line.
    let position = || figure.given.position(&format!("{table}.set"));
    let in_figure = |failure: Failure| match failure.place.strip_prefix("--set ") {
        Some(set) => Failure { place: format!("{}, {set}", position()), ..failure },
        None => failure,
    };
    Ok(PanelInput::Scene(Box::new(scene.map_err(|failures| failures.map(in_figure))?)))
}

/// Gives all scenes the camera of the first one.
fn share_camera(inputs: &mut [(&str, PanelInput)]) {
    let mut first: Option<Camera> = None;
    for (_, input) in inputs {
        if let PanelInput::Scene(input) = input {
            input.scene.camera = first.get_or_insert_with(|| input.scene.camera.clone()).clone();
        }
    }
}

impl PanelInput {
    /// Width and height of the picture, of which the proportions count.
    fn size(&self) -> [usize; 2] {
        match self {
            Self::Scene(input) => input.scene.picture.size,
            Self::Picture(image) => [image.width, image.height],
        }
    }

    /// Draws the first frame of a scene in the size of its place.
    fn drawn(
        self,
        layout: &FigureLayout<'_>,
        place: &PanelPlace,
        table: &str,
        [output, figure]: [&Path; 2],
        gpu: Option<&Gpu>,
        talk: Talk,
    ) -> Result<DrawnPanel, Failures> {
        let mut input = match self {
            Self::Scene(input) => *input,
            Self::Picture(image) => return Ok(DrawnPanel { picture: Some(image), ..DrawnPanel::default() }),
        };
        layout.fit(&mut input.scene, place);
        output_path::check_not_read(output, input.scene.files())?;
        let progress = Progress::new(talk, format_args!("{}: {table}", figure.display()));
        let job = input.load(RenderTarget::Picture)?;
        input::tell(talk, &job);
        let panel = DrawnPanel::draw(&job, layout, place, gpu, &|share| progress.hear(share))?;
        panel.notes.iter().for_each(|line| note(talk, format_args!("{table}: {line}")));
        Ok(panel)
    }
}
