//! `[picture]`: what the picture is drawn on.

use crate::document::check::Check;
use crate::document::declare::{choices, table};
use crate::document::describe::{Instead, Kind, Shape, Table};
use crate::document::fault::Problem;
use crate::document::item::{Item, Value};
use crate::document::kind::{
    Bounds, Choice, ChoiceOption, Colors, FEW, Lengths, ListOf, Number, On, Whole, Wholes, nearest_color, parse_color,
};
use crate::document::out::Out;
use crate::nearest::nearest;
use crate::picture::LayerKind;
use crate::quantity::Quantity;
use crate::tables::Length;
use serde::{Deserialize, Serialize};
use serde_json::{Value as Json, json};
use std::path::PathBuf;

table! {
    /// The table `[picture]`.
    ///
    /// `dpi` is read before the lengths that it turns into pixels.
    #[derive(Clone, Debug, PartialEq)]
    pub struct PictureSettings {
        /// Pixels per inch, which turns mm into pixels.
        dpi: f64 = 300.0, key("IO-7", Number { bounds: Bounds::POSITIVE, unit: "" });
        /// Width and height in pixels.
        size: [usize; 2] = [512, 512], key("RAY-6", SIZE, |p| p.extent().is_none().then_some(p.size));
        /// Width and height as lengths on the page, where the scene gives them so; [`Self::extent`] says whether they
        /// still hold.
        lengths: [Option<Length>; 2] = [None; 2];
        /// Width on the page, with `height` in place of `size`.
        width: key("IO-7", EXTENT,
            |p| p.extent().map(|[length, _]| length),
            |p, v| (p.lengths[0], p.size[0]) = (Some(v), pixels(v, p.dpi))).absent("`size`");
        /// Height on the page, with `width` in place of `size`.
        height: key("IO-7", EXTENT,
            |p| p.extent().map(|[_, length]| length),
            |p, v| (p.lengths[1], p.size[1]) = (Some(v), pixels(v, p.dpi))).absent("`size`");
        /// Rays a pixel: n×n, or "auto", one, and five or nine at edges. With halos, style mip-maps or strokes inside the volume "auto" is 2×2 everywhere.
        samples: RaysPerPixel = RaysPerPixel::Auto, key("RAY-6", RaysPerPixelKind);
        /// Edges of samples = "auto": places where neighbours differ by more in R, G, B as displayed, or in opacity.
        contrast: f64 = 0.0625, key("RAY-7", Number { bounds: Bounds::UNIT, unit: "" });
        /// Background: a colour, "none", or the path of a picture that is stretched to the frame.
        background: Background = Background::Color([1.0; 4]), key("IO-6", Behind);
        /// Encoding of the numbers that are composited.
        blend_space: BlendSpace = BlendSpace::Linear, key("VAL-3", BlendSpace::KIND);
        /// Bits a channel of a PNG.
        ///
        /// 8 or 16.
        bits: u8 = 8, key("IO-2", Bits);
        /// Layers of an EXR.
        layers: Vec<LayerKind> = vec![LayerKind::Beauty],
            key("IO-6", ListOf { what: "a list of layers", most: FEW, each: LayerName })
                .needs(&[Quantity::Gradient, Quantity::PreviousNormal, Quantity::Hessian]);
    }
}

/// Rays of each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RaysPerPixel {
    /// One, and five or nine where the picture has edges ([RAY-7]).
    Auto,
    /// n×n ([RAY-6]).
    Across(usize),
}

impl RaysPerPixel {
    /// The number n of the n×n rays that each pixel begins with. Where halos, style mip-maps or lines inside the volume need
    /// equally many rays in all pixels, "auto" is 2×2.
    pub fn across(self, equal_rays: bool) -> usize {
        match self {
            Self::Across(n) => n,
            Self::Auto => 1 + usize::from(equal_rays),
        }
    }
}

/// Background of the picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Background {
    /// Nothing: A is the coverage.
    None,
    /// A colour: linear, straight.
    Color([f64; 4]),
    /// A picture, stretched to the frame.
    Picture(PathBuf),
}

choices! {
    /// Which numbers are composited ([VAL-3]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum BlendSpace {
        /// Linear light.
        Linear = "linear",
        /// sRGB-encoded values, to remake old figures.
        Srgb = "srgb",
    }
}

impl PictureSettings {
    /// Width and height on the page as the scene gives them. None if the scene counts in pixels, or if `size` has been
    /// changed since.
    pub fn extent(&self) -> Option<[Length; 2]> {
        let [Some(width), Some(height)] = self.lengths else { return None };
        ([width, height].map(|length| pixels(length, self.dpi)) == self.size).then_some([width, height])
    }

    /// The pixels of a length on the page, or of a share of the picture's height; none for a length in the world.
    pub fn in_pixels(&self, length: Length) -> Option<f64> {
        match length {
            Length::Millimetres(mm) => Some(mm * self.dpi / INCH),
            Length::Pixels(px) => Some(px),
            Length::Percent(share) => Some(share * self.size[1] as f64 / 100.0),
            Length::World(_) | Length::Voxels(_) => None,
        }
    }
}

/// Width and height: at most 2³⁰ pixels, which are 32 GiB of `beauty` alone.
const SIZE: Wholes<2> = Wholes {
    what: "a size [width, height]",
    each: Whole { lo: 1, hi: 1 << 20 },
    product: 1 << 30,
    of_what: "pixels in all",
};

/// Width or height on the page.
const EXTENT: Lengths = Lengths { on: On::Page, bounds: Bounds::POSITIVE };

/// Millimetres of an inch.
const INCH: f64 = 25.4;

/// A length on the page in whole pixels. A length that is too long for any picture gives the largest number.
fn pixels(length: Length, dpi: f64) -> usize {
    match length {
        Length::Millimetres(mm) => (mm / INCH * dpi).round_ties_even() as usize,
        Length::Pixels(px) => px.round_ties_even() as usize,
        // The kind of `width` and `height` lets no other unit pass.
        Length::World(_) | Length::Voxels(_) | Length::Percent(_) => 0,
    }
}

/// The description of `[picture]`.
pub(crate) static TABLE: Table<PictureSettings> = Table {
    instead: &[Instead { one: "size", others: &["width", "height"] }],
    check: |picture, check| {
        for (one, other) in [("width", "height"), ("height", "width")] {
            if check.has(one) && !check.has(other) {
                check.fault_in(
                    other,
                    Problem::Missing { expected: format!("{other} beside {one}, such as {other} = \"120 mm\"") },
                );
            }
        }
        let [width, height] = picture.size.map(|n| n as u64);
        let complete = check.has("width") && check.has("height") && check.sound(&["width", "height", "dpi"]);
        if complete && SIZE.fits([width, height]).is_none() {
            check.fault_in(
                "width",
                Problem::Contradiction {
                    what: format!("picture.width and picture.height make {width} × {height} pixels"),
                    remedy: format!("change width, height or dpi: expected is {}", SIZE.expected()),
                },
            );
        }
        check_layers(&picture.layers, check);
    },
    ..PictureSettings::description("[picture]", "What the picture is drawn on.")
};

/// Layers by name.
const LAYER: Choice<LayerKind> = Choice {
    options: &[
        ChoiceOption::new("beauty", LayerKind::Beauty, "The picture."),
        ChoiceOption::new("Z", LayerKind::Z, "Eye depth where the opacity first reaches ½."),
        ChoiceOption::new("depth", LayerKind::Depth, "First, half and mean depth."),
        ChoiceOption::new("normal", LayerKind::Normal, "Mean outward normal in eye space."),
        ChoiceOption::new("gradient", LayerKind::Gradient, "Mean gradient in world space."),
        ChoiceOption::new("curvature", LayerKind::Curvature, "Mean κ₁, κ₂ and κ_v."),
        ChoiceOption::new("curvature.KV", LayerKind::CurvatureAlongView, "Mean κ_v alone, as [contours] has it."),
        ChoiceOption::new("first", LayerKind::First, "The value at the first visible sample."),
        ChoiceOption::new("first.normal", LayerKind::FirstNormal, "Outward normal there, in eye space."),
        ChoiceOption::new("first.curvature", LayerKind::FirstCurvature, "κ₁, κ₂ and κ_v there."),
        ChoiceOption::new("first.curvature.KV", LayerKind::FirstCurvatureAlongView, "κ_v there, as [contours] has it."),
        ChoiceOption::new("counts", LayerKind::Counts, "Samples evaluated on the ray."),
    ],
};

/// A layer by its name. The name of a halo's or an object's layer has the index in the list, from 0.
struct LayerName;

impl Shape for LayerName {
    fn expected(&self) -> String {
        let of_halos = "or \"haloN\", N the place of one of [[halo]], from 0";
        let of_objects = "or \"partN\", N the place of a part, 0 the background";
        format!("{}, {of_halos}, {of_objects}", LAYER.expected())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [LAYER.schema(), { "type": "string", "pattern": "^(halo|part)(0|[1-9][0-9]*)$" }] })
    }
}

impl Kind for LayerName {
    type Of = LayerKind;

    fn read(&self, item: &Item, check: &mut Check) -> Option<LayerKind> {
        let Some(name) = item.text() else { return check.wrong(item, self.expected()) };
        // "halo0.H" and "part0.A" are names of channels.
        let of_channel = name.strip_suffix(".H").or_else(|| name.strip_suffix(".A")).and_then(LayerKind::from_name);
        let names = LAYER.options.iter().map(|option| option.name).chain(["halo0", "part0"]);
        let nearest = || match of_channel {
            Some(layer) => Some(layer.name().into_owned()),
            None => nearest(name, names).map(Into::into),
        };
        LayerKind::from_name(name).or_else(|| check.wrong_name(item, self.expected(), nearest()))
    }

    fn write(&self, value: &LayerKind) -> Out {
        Out::Text(value.name().into_owned())
    }
}

/// A channel can be in a file once.
fn check_layers(layers: &[LayerKind], check: &mut Check) {
    for (i, layer) in layers.iter().enumerate() {
        let clash = |other: &&LayerKind| other.channels().iter().any(|name| layer.channels().contains(name));
        if let Some(other) = layers[..i].iter().find(clash) {
            let what = if other == layer {
                format!("picture.layers has {layer:?} twice", layer = layer.name())
            } else {
                format!("the layers {:?} and {:?} share a channel", other.name(), layer.name())
            };
            let remedy = "leave one of them out".into();
            check.fault_in(&format!("layers[{i}]"), Problem::Contradiction { what, remedy });
        }
    }
}

/// n of n×n rays, or `"auto"`.
struct RaysPerPixelKind;

/// n of n×n rays.
const ACROSS: Whole = Whole { lo: 1, hi: 1024 };

/// The word in place of n.
const AUTO: &str = "auto";

impl Shape for RaysPerPixelKind {
    fn expected(&self) -> String {
        format!("{}, or {AUTO:?}", ACROSS.expected())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [ACROSS.schema(), { "const": AUTO }] })
    }
}

impl Kind for RaysPerPixelKind {
    type Of = RaysPerPixel;

    fn read(&self, item: &Item, check: &mut Check) -> Option<RaysPerPixel> {
        let read = match &item.value {
            Value::Text(text) => (text == AUTO).then_some(RaysPerPixel::Auto),
            _ => ACROSS.of(item).map(|n| RaysPerPixel::Across(n as usize)),
        };
        read.or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &RaysPerPixel) -> Out {
        match value {
            RaysPerPixel::Across(n) => Out::Whole(*n as u64),
            RaysPerPixel::Auto => Out::Text(AUTO.into()),
        }
    }
}

/// 8 or 16.
struct Bits;

impl Shape for Bits {
    fn expected(&self) -> String {
        "8 or 16".into()
    }

    fn schema(&self) -> Json {
        json!({ "enum": [8, 16] })
    }
}

impl Kind for Bits {
    type Of = u8;

    fn read(&self, item: &Item, check: &mut Check) -> Option<u8> {
        match (Whole { lo: 8, hi: 16 }).of(item) {
            Some(8) => Some(8),
            Some(16) => Some(16),
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &u8) -> Out {
        Out::Whole(u64::from(*value))
    }
}

/// A colour, `"none"` or the path of a picture.
struct Behind;

impl Shape for Behind {
    fn expected(&self) -> String {
        format!("{}, \"none\", or the path of a picture", Colors.expected())
    }

    fn schema(&self) -> Json {
        json!({ "type": "string", "minLength": 1 })
    }
}

impl Kind for Behind {
    type Of = Background;

    /// Reads a text with a point or a separator of folders as a path, unless it begins with `#`.
    fn read(&self, item: &Item, check: &mut Check) -> Option<Background> {
        match item.text() {
            Some("none") => Some(Background::None),
            Some(text) => match parse_color(text) {
                Some(color) => Some(Background::Color(color)),
                None if !text.starts_with('#') && text.contains(['.', '/', '\\']) && !text.contains('\0') => {
                    Some(Background::Picture(check.resolve(text, &item.place)))
                }
                None => check.wrong_name(item, self.expected(), nearest_color(text)),
            },
            None => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &Background) -> Out {
        match value {
            Background::None => Out::Text("none".into()),
            Background::Color(color) => Colors.write(color),
            Background::Picture(path) => Out::Path(path.clone()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn millimetres_become_pixels() {
        // An inch at 300 dpi; 180 mm are 2125.98 px.
        assert_eq!(pixels(Length::Millimetres(25.4), 300.0), 300);
        assert_eq!(pixels(Length::Millimetres(180.0), 300.0), 2126);
        assert_eq!(pixels(Length::Pixels(700.0), 300.0), 700);
        assert_eq!(pixels(Length::Millimetres(1e300), 1e300), usize::MAX);
    }
}
