//! The verb `pick`: what is seen at a pixel, and where it is in the volume.

use super::input::{self, KeyFlag, SceneOverrides, SetArgs, TemplateArgs};
use super::raw::RawArgs;
use super::report::{Progress, print, print_json};
use super::{Outcome, Talk};
use crate::picking::{focus_lengths, pick_pixel, pixel_inside};
use crate::reference::ray::Picked;
use crate::scene::glam::DVec3;
use crate::scene::space::Grid;
use crate::scene::volume::info::short;
use crate::scene::volume::labels::LabelNames;
use crate::{Failure, Failures};
use clap::Args;
use serde_json::json;
use std::fmt::Write;
use std::path::PathBuf;

/// Print position, value and label of the first visible structure at a pixel.
///
/// A structure is visible where the opacity accumulated from the eye reaches 1/16. Fainter haze and noise in front of it
/// is ignored. If the whole ray is fainter, the sample with the largest share of the pixel is printed. Points and lines
/// are ignored. For an empty pixel the text says so, and --json prints null; the exit code is 0. [orbit] shows its first
/// frame.
#[derive(Debug, Args)]
pub(super) struct PickArgs {
    /// Scene or volume [default: the embedded scene]
    #[arg(value_name = "SCENE|VOLUME")]
    input: Option<PathBuf>,
    #[command(flatten)]
    template: TemplateArgs,
    /// Column from the left and row from the top, both from 0; can be repeated. The ray goes through the pixel's centre
    #[arg(long = "pixel", value_name = "X,Y", required = true, value_parser = pixel)]
    pixels: Vec<[i64; 2]>,
    /// Print a JSON array with an object, or null, for each pixel
    #[arg(long)]
    json: bool,
    /// Width and height of the picture in pixels
    #[arg(long, value_name = "WxH")]
    size: Option<String>,
    /// Preset of a bare volume; see `render --help`
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    #[command(flatten)]
    raw: RawArgs,
    #[command(flatten)]
    set: SetArgs,
}

impl PickArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let mut over = SceneOverrides::new(&self.set, self.flags()?)?;
        over.beauty_only = true;
        over.volume.clone_from(&self.template.volume);
        let _working = Progress::new(talk, "picking");
        let mut job = input::load(self.input.as_deref(), &over)?;
        let size = job.scene.picture.size;
        let inside: Vec<_> =
            self.pixels.iter().map(|&[x, y]| pixel_inside([x, y], size, &format!("--pixel {x},{y}"))).collect();
        Failures::check(inside.iter().filter_map(|pixel| pixel.as_ref().err().cloned()))?;
        let names = job.load_labels()?;
        let renderer = job.renderer()?;
        let pixels = inside.into_iter().filter_map(Result::ok);
        let picked: Vec<_> = pixels.map(|pixel| (pixel, pick_pixel(&renderer, pixel))).collect();
        if self.json {
            let of_pixel = |(pixel, picked): &([usize; 2], Option<Picked>)| picked.map(|p| object(*pixel, &p, &names));
            let objects: Vec<_> = picked.iter().map(of_pixel).collect();
            return print_json(serde_json::to_string_pretty(&objects));
        }
        print(&text(&picked, &names, job.volume.grid()))
    }

    /// Returns the flags that stand for scene keys.
    fn flags(&self) -> Result<Vec<KeyFlag>, Failure> {
        let mut flags: Vec<KeyFlag> = self.raw.flag().into_iter().collect();
        if let Some(size) = &self.size {
            flags.push(input::size_flag(size)?);
        }
        if let Some(preset) = &self.preset {
            flags.extend(input::preset_flags(preset, self.input.as_deref(), &self.set, self.size.is_some()));
        }
        Ok(flags)
    }
}

/// Parses a pixel: two integers, separated by a comma.
fn pixel(text: &str) -> Result<[i64; 2], &'static str> {
    let whole = |text: &str| text.trim().parse().ok();
    let pixel = text.split_once(',').and_then(|(x, y)| Some([whole(x)?, whole(y)?]));
    pixel.ok_or("a pixel is two whole numbers, as X,Y")
}

/// Returns a picked place as JSON.
fn object([x, y]: [usize; 2], picked: &Picked, names: &LabelNames) -> serde_json::Value {
    let three = |v: DVec3| json!([v.x, v.y, v.z]);
    let mut object = json!({
        "pixel": [x, y],
        "world": three(picked.world),
        "index": three(picked.index),
        "depth": picked.depth,
        "value": picked.value,
        "normal": picked.normal.map(three),
        "opacity": picked.opacity,
        "on_surface": picked.on_surface,
        "mesh": picked.mesh,
    });
    if let (Some(id), Some(object)) = (picked.label, object.as_object_mut()) {
        object.insert("label".into(), json!(id));
        object.insert("label_name".into(), json!(names.name(id)));
    }
    object
}

/// Returns picked places as text: a block for each pixel, then the line that focuses a halo on the places.
fn text(picked: &[([usize; 2], Option<Picked>)], names: &LabelNames, grid: &Grid) -> String {
    let mut text = String::new();
    for ([x, y], picked) in picked {
        match picked {
            Some(picked) => text += &block([*x, *y], picked, names, grid.voxel()),
            None => _ = writeln!(text, "pixel      {x},{y}: nothing is seen there"),
        }
        text.push('\n');
    }
    let places: Vec<String> =
        picked.iter().filter_map(|(_, picked)| Some(toml(picked.as_ref()?.world, grid.voxel()))).collect();
    if places.is_empty() {
        text.pop();
        return text;
    }
    let [inner, falloff] = focus_lengths(grid).map(short);
    let places = places.join(", ");
    let _ = writeln!(text, "[[halo]]   seed.focus = {{ at = [{places}], inner = {inner}, falloff = {falloff} }}");
    text
}

fn block([x, y]: [usize; 2], picked: &Picked, names: &LabelNames, voxel: f64) -> String {
    let row = |v: DVec3, unit: f64| v.to_array().map(|x| coordinate(x, unit)).join("  ");
    let normal = picked.normal.map_or("none".into(), |n| row(n, 1.0));
    let surface = match picked.mesh {
        Some(mesh) => format!(", of the volume; the place is on mesh {mesh}"),
        None if picked.on_surface => ", on the iso-surface".into(),
        None => String::new(),
    };
    let mut text = format!(
        "pixel      {x},{y}\nworld      {}\nindex      {}\nvalue      {}{surface}\neye depth  {}\nnormal     {normal}\n\
         opacity    {} up to here\n",
        row(picked.world, voxel),
        row(picked.index, 1.0),
        short(picked.value),
        coordinate(picked.depth, voxel),
        short(picked.opacity),
    );
    if let Some(id) = picked.label {
        let name = names.name(id).map(|name| format!(", {name}")).unwrap_or_default();
        let _ = writeln!(text, "label      {id}{name}");
    }
    text
}

/// Returns a position as an array of TOML.
fn toml(v: DVec3, voxel: f64) -> String {
    format!("[{}]", v.to_array().map(|x| coordinate(x, voxel)).join(", "))
}

/// Returns a coordinate with six digits if they resolve a hundredth of a unit, else with all digits. A coordinate of
/// less than 10⁻⁹ units becomes 0.
fn coordinate(x: f64, unit: f64) -> String {
    if x.abs() < 1e-9 * unit {
        return "0".into();
    }
    let text = short(x);
    let is_near = text.parse().is_ok_and(|near: f64| (near - x).abs() <= unit / 100.0);
    if is_near { text } else { format!("{x:?}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_whole_numbers() {
        assert_eq!((pixel("3,4"), pixel(" -1, 2")), (Ok([3, 4]), Ok([-1, 2])));
        for wrong in ["3", "3.5,4", "3,4,5", "", "a,b", "99999999999999999999,0"] {
            assert!(pixel(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn coordinates_tell_voxels_apart() {
        assert_eq!((coordinate(12.25, 1.0), coordinate(1.0 / 3.0, 1.0)), ("12.25".into(), "0.333333".into()));
        assert_eq!((coordinate(1e6 + 0.123, 1.0), coordinate(1e-7, 1e-7)), ("1000000.123".into(), "1.00000e-7".into()));
        assert_eq!((coordinate(-1e-17, 1.0), coordinate(-0.0, 1.0)), ("0".into(), "0".into()));
    }
}
