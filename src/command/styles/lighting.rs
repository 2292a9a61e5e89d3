//! The verb `styles lighting`: the presets of lighting transfer functions ([VS-5]).

use super::super::report::{note, print};
use super::super::{Done, Outcome, Talk, output_path};
use crate::output::png;
use crate::output::read::Image;
use crate::output::sheet::{Layout, sheet};
use crate::reference::volumeshop::preview;
use crate::scene::glam::DVec3;
use crate::scene::lighting::{ContourRule, LightingModel, LightingPreset};
use crate::scene::picture::Provenance;
use crate::scene::shot::{LightingParams, LightingSource};
use crate::scene::tables::Shading;
use crate::{Failure, Format};
use clap::Args;
use clap::builder::PossibleValuesParser;
use std::path::PathBuf;

/// Pixels across a picture of the sheet.
const CELL: usize = 240;

/// List the presets of lighting functions, shading.preset of a scene.
///
/// With -o, write a sheet of lit spheres, each with its table. With --table, too, write the table of one preset: a PNG of 16
/// bits to paint on, for shading.table. Red, green, blue and alpha are ambient, diffuse and specular light and opacity
/// enhancement; N·L is −1 on the left and 1 on the right, N·H is 1 at the top and −1 at the bottom.
#[derive(Debug, Args)]
pub(super) struct LightingArgs {
    /// Write the table of this preset instead of a sheet
    #[arg(long, value_name = "PRESET", requires = "output",
        value_parser = PossibleValuesParser::new(LightingPreset::ALL.map(LightingPreset::name)))]
    table: Option<String>,
    /// Direction towards the light in eye space, on which contours depend
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,1", allow_hyphen_values = true)]
    light: String,
    /// Output file (.png)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl LightingArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let Some(output) = &self.output else {
            return print(&LightingPreset::ALL.map(|preset| format!("{}\n", preset.name())).concat());
        };
        output_path::picture(output, &[Format::Png])?;
        let light = self.light()?;
        let failed = |error| Failure::picture(&error, output.display());
        if let Some(preset) = self.table.as_deref().and_then(LightingPreset::named) {
            let table = model(preset, light).table();
            let size = [table.width(), table.height()];
            png::write_rgba_table(size, table.cells(), 16, output).map_err(failed)?;
        } else {
            let spheres = LightingPreset::ALL.map(|preset| {
                let source = LightingSource::Preset(model(preset, light));
                let params = LightingParams { source, divisor_floor: Shading::default().divisor_floor, light };
                (preset.name().to_owned(), Image::from(&preview(&params, CELL)))
            });
            let picture = sheet(&spheres, Layout { columns: Some(3), cell: CELL }).map_err(failed)?;
            png::write_png(&picture, 8, &Provenance::default(), output).map_err(failed)?;
        }
        note(talk, output.display());
        Ok(Done::Yes)
    }

    /// Returns the unit vector towards the light, in eye space.
    fn light(&self) -> Result<DVec3, Failure> {
        let numbers: Option<Vec<f64>> = self.light.split(',').map(|number| number.trim().parse().ok()).collect();
        let direction = match numbers.as_deref() {
            Some(&[x, y, z]) => DVec3::new(x, y, z).try_normalize(),
            _ => None,
        };
        direction.ok_or_else(|| {
            let what = format!("{:?} is no direction", self.light);
            Failure::new(what, format!("--light {}", self.light), "write x,y,z, not all 0, such as -0.5,0.7,0.5")
        })
    }
}

/// Returns a preset with the constants of a scene's defaults, for light and an eye at (0, 0, 1).
fn model(preset: LightingPreset, light: DVec3) -> LightingModel {
    let Shading { ambient, diffuse, specular, shininess, .. } = Shading::default();
    let contour_factor = ContourRule::Exact.factor(light.z);
    LightingModel { preset, ambient, diffuse, specular, shininess, contour_factor }
}
