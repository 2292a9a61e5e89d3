//! `docs/pictures/cost/errors.png`: crops that show how errors of 10⁻¹, 10⁻² and 10⁻³ look.

use super::{Measured, job};
use drypoint::output::compare::{CompareOptions, compare};
use drypoint::output::png::encode_png;
use drypoint::output::read::Image;
use drypoint::output::sheet::{Layout, sheet};
use drypoint::scene::picture::Provenance;

/// The scene, which needs no data.
const SCENE: Measured = Measured { name: "default", file: "default.toml", over: &[("picture.size", "[320, 320]")] };

/// The errors shown.
const ERRORS: [f64; 3] = [1e-1, 1e-2, 1e-3];

/// Upper left corner and side of the crop, and the side that it is enlarged to.
const CROP: [usize; 3] = [112, 92, 96];
const CELL: usize = 192;

/// A setting that goes from coarse to exact: its key, the ends of its range, the coarse one first, and its unit.
struct Dial {
    key: &'static str,
    ends: [f64; 2],
    unit: &'static str,
}

const DIALS: [Dial; 2] = [
    Dial { key: "sampling.step", ends: [8.0, 1.0 / 32.0], unit: " voxels" },
    Dial { key: "sampling.stop_below", ends: [0.9, 1e-5], unit: "" },
];

/// Returns the PNG: a row for each dial, the exact picture first.
///
/// # Errors
/// Errors of the renderer.
pub(super) fn png() -> Result<Vec<u8>, String> {
    let mut crops = Vec::new();
    for dial in &DIALS {
        let key = dial.key.trim_start_matches("sampling.");
        let truth = dial.picture(dial.ends[1])?;
        crops.push(("exact".to_owned(), crop(&truth)));
        for error in ERRORS {
            let (setting, picture) = dial.at_error(&truth, error)?;
            crops.push((format!("{error:.0e}: {key} {}", dial.text(setting)), crop(&picture)));
        }
    }
    let page = sheet(&crops, Layout { columns: Some(ERRORS.len() + 1), cell: CELL }).map_err(|e| e.to_string())?;
    let from = Provenance { software: "drypoint-docs".into(), scene_hash: String::new(), plan: String::new() };
    encode_png(&page, 8, &from).map_err(|e| e.to_string())
}

impl Dial {
    /// Returns the setting as the scene has it.
    fn text(&self, setting: f64) -> String {
        // Three digits after the first that is not 0.
        let digits = (2.0 - setting.log10().floor()).max(0.0) as usize;
        format!("{setting:.digits$}{}", self.unit)
    }

    fn picture(&self, setting: f64) -> Result<Image, String> {
        let text = self.text(setting);
        let job = job(&SCENE, &[(self.key, text.as_str())])?;
        let (picture, _) = job.renderer().map_err(|e| e.to_string())?.frame(&|_| ());
        Ok(Image::from(&picture))
    }

    /// Returns the setting with an RMS error, within a tenth of it where there is one, and its picture.
    fn at_error(&self, truth: &Image, wanted: f64) -> Result<(f64, Image), String> {
        let [mut coarse, mut fine] = self.ends;
        loop {
            // The middle of a ratio: settings span some powers of ten.
            let setting = (coarse * fine).sqrt();
            let picture = self.picture(setting)?;
            let rms = compare(&picture, truth, &CompareOptions::default()).map_err(|e| e.to_string())?.rms;
            if (rms / wanted - 1.0).abs() < 0.1 || coarse / fine < 1.01 {
                return Ok((setting, picture));
            }
            *(if rms > wanted { &mut coarse } else { &mut fine }) = setting;
        }
    }
}

/// Returns the crop of a picture.
fn crop(image: &Image) -> Image {
    let [left, top, side] = CROP;
    let cut = |values: &[f64]| {
        let row = |y: usize| values[y * image.width + left..][..side].iter().copied();
        (top..top + side).flat_map(row).collect()
    };
    let channels = image.channels.iter().map(|(name, values)| (name.clone(), cut(values))).collect();
    Image { width: side, height: side, channels }
}
