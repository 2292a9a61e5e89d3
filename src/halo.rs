//! Halos of pictures: from a map of seeds to the intensities of the paper's stages ([HALO-10]).

use crate::Failure;
use drypoint_output::OutputError;
use drypoint_output::read::Image;
use drypoint_output::sheet::{Layout, sheet};
use drypoint_reference::volumetric_halos::{Border, HaloField, Process, SpreadParams};
use drypoint_scene::color::srgb_to_linear;
use drypoint_scene::memory;
use drypoint_scene::picture::Picture;
use drypoint_scene::source::Disk;
use drypoint_scene::style::SourcePicture;
use std::path::Path;

/// A picture that is a map of intensities.
#[derive(Clone, Debug, PartialEq)]
pub struct IntensityMap {
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// Numbers in [0, 1], row by row from the top.
    pub values: Vec<f64>,
}

impl IntensityMap {
    /// Reads a PNG, JPEG or EXR. Its numbers are not converted, since they are not colours. They are codes over 2ⁿ − 1,
    /// or those of an EXR, clamped to [0, 1]. A pixel's intensity is its luminance times its α.
    ///
    /// # Errors
    /// The file cannot be read, is not such a picture, or does not fit into memory.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let bytes = memory::read(&Disk, path).map_err(|source| {
            Failure::picture(&OutputError::Io { path: path.into(), action: "read", source }, path.display())
        })?;
        let picture =
            SourcePicture::decode(&bytes, true).map_err(|fault| Failure::new(&fault, path.display(), fault.help()))?;
        let size = [picture.width(), picture.height()];
        room(path, size, size8(size))?;
        let values = (0..size[0] * size[1]).map(|t| {
            let [r, g, b, _] = picture.pixel(t % size[0], t / size[0]);
            // Exactly g for a grey.
            (g + 0.2126 * (r - g) + 0.0722 * (b - g)).clamp(0.0, 1.0)
        });
        Ok(Self { size, values: values.collect() })
    }

    /// Returns the intensities of a stage of the process. `path` is for messages.
    ///
    /// # Errors
    /// Images that do not fit into memory.
    pub fn halo(&self, spread: SpreadParams, border: Border, process: Process, path: &Path) -> Result<Self, Failure> {
        room(path, self.size, HaloField::bytes_of(self.size).saturating_add(size8(self.size)))?;
        let mut field = HaloField::with_border(self.size, spread, border);
        field.seeds_mut().copy_from_slice(&self.values);
        field.generate_as(process);
        Ok(Self { size: self.size, values: field.intensities().to_vec() })
    }

    /// Returns the map as linear light whose sRGB codes are the intensities.
    fn as_light(&self) -> Image {
        let light: Vec<f64> = self.values.iter().map(|v| srgb_to_linear(*v)).collect();
        let channels = ["R", "G", "B"].map(|name| (name.to_owned(), light.clone()));
        Image { width: self.size[0], height: self.size[1], channels: channels.into() }
    }
}

/// Returns the bytes of one number for each pixel.
fn size8([width, height]: [usize; 2]) -> u64 {
    8 * width as u64 * height as u64
}

fn room(path: &Path, size: [usize; 2], bytes: u64) -> Result<(), Failure> {
    memory::room(bytes).map_err(|no_room| {
        Failure::picture(&OutputError::NoRoom { path: Some(path.into()), size, no_room }, path.display())
    })
}

/// A figure of the paper with six or four halos of one map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HaloFigure {
    /// Fig. 3: seeds and their gradient, each unfiltered, with a low-pass filter, and spread.
    Stages,
    /// Fig. 4: spread gradients for δ = 0.70, 0.80, 0.90 and 0.95.
    Deltas,
}

impl HaloFigure {
    /// δ of Fig. 4.
    pub const DELTAS: [f64; 4] = [0.70, 0.80, 0.90, 0.95];

    /// Returns label, parameters and stage of each picture, row by row in two columns.
    fn pictures(self, spread: SpreadParams) -> Vec<(String, SpreadParams, Process)> {
        let from = |from_gradient| SpreadParams { from_gradient, ..spread };
        match self {
            Self::Stages => [
                ("(a) seeds", false, Process::Source),
                ("(d) gradient", true, Process::Source),
                ("(b) low-pass of the seeds", false, Process::LowPass),
                ("(e) low-pass of the gradient", true, Process::LowPass),
                ("(c) seeds, spread", false, Process::Spread),
                ("(f) gradient, spread", true, Process::Spread),
            ]
            .map(|(label, from_gradient, process)| (label.to_owned(), from(from_gradient), process))
            .into(),
            Self::Deltas => ["a", "b", "c", "d"]
                .into_iter()
                .zip(Self::DELTAS)
                .map(|(letter, delta)| {
                    let spread = SpreadParams { delta, ..spread };
                    (format!("({letter}) delta = {delta:.2}"), spread, Process::Spread)
                })
                .collect(),
        }
    }

    /// Draws the figure for a map. `path` is for messages.
    ///
    /// # Errors
    /// Images that do not fit into memory, or a sheet that is too large.
    pub fn draw(
        self,
        seeds: &IntensityMap,
        spread: SpreadParams,
        border: Border,
        path: &Path,
    ) -> Result<Picture, Failure> {
        let mut images = Vec::new();
        for (label, spread, process) in self.pictures(spread) {
            images.push((label, seeds.halo(spread, border, process, path)?.as_light()));
        }
        // Pixels stay pixels up to the largest cell.
        let cell = seeds.size[0].max(seeds.size[1]).clamp(16, 1024);
        sheet(&images, Layout { columns: Some(2), cell }).map_err(|error| Failure::picture(&error, path.display()))
    }
}
