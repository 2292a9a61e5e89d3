//! Differences of two pictures ([GPU-1], [GPU-5]).

pub mod blur;
pub mod difference;
pub mod flip;
pub mod line_distance;

use crate::OutputError;
use crate::read::{ColorChannels, Image};
use serde::Serialize;
use std::fmt;

/// Settings of a comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompareOptions {
    /// Pixels with a larger difference than this in any channel count as `over`.
    pub tolerance: f64,
    /// Viewing distance for FLIP, in pixels per degree.
    pub pixels_per_degree: f64,
}

impl Default for CompareOptions {
    /// One step of 8 bits in linear light, and FLIP's usual screen.
    fn default() -> Self {
        Self { tolerance: 1.0 / 255.0, pixels_per_degree: flip::PIXELS_PER_DEGREE }
    }
}

/// Limits of a comparison's differences. None: no limit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ErrorLimits {
    /// Limit of [`Comparison::max`].
    pub max: Option<f64>,
    /// Limit of [`Comparison::rms`].
    pub rms: Option<f64>,
    /// Limit of [`Comparison::flip`].
    pub flip: Option<f64>,
}

/// The difference of two pictures, in the channels' units: linear premultiplied light for colours.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Pixels from left to right.
    pub width: usize,
    /// Pixels from top to bottom.
    pub height: usize,
    /// The largest difference in any layer.
    pub max: f64,
    /// The largest root mean square of any layer's differences.
    pub rms: f64,
    /// Mean of [`flip::flip`]; none if one of the pictures has no colours.
    pub flip: Option<f64>,
    /// Pixels with any difference at all.
    pub differing: usize,
    /// The tolerance above which a pixel counts as `over`.
    pub tolerance: f64,
    /// Pixels with a larger difference than `tolerance`.
    pub over: usize,
    /// Values of all layers that cannot be compared, as [`LayerDifference::apart`] counts them. Their pixels count as
    /// differing and as over; `max` and `rms` leave the values out.
    pub apart: usize,
    /// The layers that both pictures have.
    pub layers: Vec<LayerDifference>,
    /// Channels that only the first picture has.
    pub only_in_a: Vec<String>,
    /// Channels that only the second picture has.
    pub only_in_b: Vec<String>,
}

/// The difference of one layer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LayerDifference {
    /// `beauty`, `Z`, or the part of the channels' names before the last dot.
    pub name: String,
    /// The channels that were compared.
    pub channels: Vec<String>,
    /// The largest |a − b|.
    pub max: f64,
    /// Column and row of the first pixel with the difference `max`.
    pub at: [usize; 2],
    /// √(Σ(a − b)²/n) over all n values of the layer's channels.
    pub rms: f64,
    /// Values that only one of the pictures has as a finite number, or that are infinite with different signs.
    pub apart: usize,
}

impl Comparison {
    /// Returns a line for each limit that is exceeded. Values that are `apart` exceed every limit of `max` and `rms`.
    pub fn exceeded(&self, limits: &ErrorLimits) -> Vec<String> {
        let mut lines = Vec::new();
        for (name, found, limit) in [("max", self.max, limits.max), ("rms", self.rms, limits.rms)] {
            if let Some(limit) = limit {
                if found > limit {
                    lines.push(format!("{name} {found:e} is over {limit:e}"));
                }
                if self.apart > 0 {
                    lines.push(format!("{} values are finite in one picture only: no {name} holds them", self.apart));
                }
            }
        }
        match (self.flip, limits.flip) {
            (Some(found), Some(limit)) if found > limit => lines.push(format!("flip {found} is over {limit}")),
            (None, Some(_)) => lines.push("flip cannot be held: one of the pictures has no colours".into()),
            _ => {}
        }
        lines
    }
}

/// Returns the common width and height of two pictures. They must be equal and not 0.
fn common_size(a: &Image, b: &Image) -> Result<[usize; 2], OutputError> {
    let [size, other] = [a, b].map(|image| [image.width, image.height]);
    if size != other {
        return Err(OutputError::Sizes { a: size, b: other });
    }
    if size.contains(&0) {
        return Err(OutputError::Layer { layer: "beauty".into(), fault: "the pictures have no pixels".into() });
    }
    Ok(size)
}

/// Compares the channels that both pictures have. A picture with colours and without α counts as opaque.
///
/// # Errors
/// [`OutputError::Sizes`], [`OutputError::Layer`] for pictures without pixels, [`OutputError::NothingInCommon`],
/// [`OutputError::Viewing`], [`OutputError::NoRoom`].
pub fn compare(a: &Image, b: &Image, options: &CompareOptions) -> Result<Comparison, OutputError> {
    let [width, height] = common_size(a, b)?;
    let flip = match (a.colors(), b.colors()) {
        (Some(_), Some(_)) => Some(flip::flip(a, b, options.pixels_per_degree)?.mean()),
        _ => None,
    };
    // Channels with a counterpart. A missing α is opaque.
    let opaque = vec![1.0; width * height];
    let (names_a, names_b) = (channels(a), channels(b));
    let (common, only_in_a): (Vec<_>, Vec<_>) = names_a.iter().cloned().partition(|name| names_b.contains(name));
    if common.is_empty() {
        return Err(OutputError::NothingInCommon { a: names_a, b: names_b });
    }
    let only_in_b = names_b.into_iter().filter(|name| !common.contains(name)).collect();

    // Differences of each channel, merged by layer; the largest of each pixel beside them.
    let mut largest = vec![0.0f64; width * height];
    let mut layers: Vec<LayerDifference> = Vec::new();
    for name in common {
        let [x, y] = [a, b].map(|image| image.channel(&name).unwrap_or(&opaque));
        let difference = channel_difference(x, y, width, &mut largest);
        let layer = layer_of(&name);
        match layers.iter_mut().find(|found| found.name == layer) {
            Some(found) => found.join(name, difference),
            None => layers.push(LayerDifference { name: layer.into(), channels: vec![name], ..difference }),
        }
    }
    for layer in &mut layers {
        // Up to here `rms` holds the sum of squares.
        layer.rms = (layer.rms / (width * height * layer.channels.len()) as f64).sqrt();
    }
    let most = |value: fn(&LayerDifference) -> f64| layers.iter().map(value).fold(0.0, f64::max);
    Ok(Comparison {
        width,
        height,
        max: most(|layer| layer.max),
        rms: most(|layer| layer.rms),
        flip,
        differing: largest.iter().filter(|&&d| d > 0.0).count(),
        tolerance: options.tolerance,
        over: largest.iter().filter(|&&d| d > options.tolerance).count(),
        apart: layers.iter().map(|layer| layer.apart).sum(),
        layers,
        only_in_a,
        only_in_b,
    })
}

/// Returns the names of an image's channels. An image with colours always has α, even if the file does not write it.
fn channels(image: &Image) -> Vec<String> {
    let mut names = image.names();
    if matches!(image.colors(), Some(ColorChannels { alpha: None, .. })) {
        names.push("A".into());
    }
    names
}

/// The layer of a channel ([IO-6]).
fn layer_of(channel: &str) -> &str {
    match (channel, channel.rsplit_once('.')) {
        ("R" | "G" | "B" | "A", _) => "beauty",
        (_, Some((layer, _))) => layer,
        (bare, None) => bare,
    }
}

/// Returns one channel's difference and raises `largest` at each pixel. Its `rms` is still the sum of squares.
fn channel_difference(a: &[f64], b: &[f64], width: usize, largest: &mut [f64]) -> LayerDifference {
    let mut found =
        LayerDifference { name: String::new(), channels: Vec::new(), max: 0.0, at: [0, 0], rms: 0.0, apart: 0 };
    for (i, ((&x, &y), largest)) in a.iter().zip(b).zip(largest).enumerate() {
        if x.is_finite() && y.is_finite() {
            let d = (x - y).abs();
            if d > found.max {
                (found.max, found.at) = (d, [i % width, i / width]);
            }
            found.rms += d * d;
            *largest = largest.max(d);
        } else if x != y && !(x.is_nan() && y.is_nan()) {
            found.apart += 1;
            *largest = f64::INFINITY;
        }
    }
    found
}

impl LayerDifference {
    /// Merges a further channel. Both `rms` are still sums of squares.
    fn join(&mut self, channel: String, other: Self) {
        self.channels.push(channel);
        if other.max > self.max {
            (self.max, self.at) = (other.max, other.at);
        }
        self.rms += other.rms;
        self.apart += other.apart;
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let pixels = self.width * self.height;
        let share = |n: usize| 100.0 * n as f64 / pixels as f64;
        writeln!(f, "{:<16} {:>12} {:>12} {:>14} {:>8}", "layer", "max", "rms", "at", "apart")?;
        for layer in &self.layers {
            let at = format!("{}, {}", layer.at[0], layer.at[1]);
            writeln!(f, "{:<16} {:>12.4e} {:>12.4e} {at:>14} {:>8}", layer.name, layer.max, layer.rms, layer.apart)?;
        }
        match self.flip {
            Some(flip) => writeln!(f, "flip (mean)      {flip:>12.6}")?,
            None => writeln!(f, "flip (mean)      {:>12}", "no colours")?,
        }
        writeln!(f, "pixels           {pixels:>12}")?;
        writeln!(f, "  that differ    {:>12} {:>11.3} %", self.differing, share(self.differing))?;
        write!(f, "  over {:<9.3e} {:>12} {:>11.3} %", self.tolerance, self.over, share(self.over))?;
        for (which, names) in [("first", &self.only_in_a), ("second", &self.only_in_b)] {
            if !names.is_empty() {
                write!(f, "\nonly in the {which}: {}", names.join(", "))?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: usize, channels: &[(&str, &[f64])]) -> Image {
        let channels: Vec<_> = channels.iter().map(|(n, v)| (n.to_string(), v.to_vec())).collect();
        Image { width, height: channels[0].1.len() / width, channels }
    }

    #[test]
    fn by_hand() {
        let a = image(2, &[("normal.X", &[0.0, 1.0, 2.0, 3.0]), ("normal.Y", &[0.0; 4]), ("Z", &[5.0; 4])]);
        let b =
            image(2, &[("Z", &[5.0; 4]), ("normal.X", &[0.0, 1.0, 2.0, -1.0]), ("normal.Y", &[0.0, 0.0, 2.0, 0.0])]);
        let found = compare(&a, &b, &CompareOptions { tolerance: 2.0, ..Default::default() }).unwrap();
        // Differences 4 and 2 among 8 values: √(20/8).
        let normal = &found.layers[0];
        assert_eq!((normal.name.as_str(), normal.max, normal.at), ("normal", 4.0, [1, 1]));
        assert_eq!(normal.rms, (20.0f64 / 8.0).sqrt());
        assert_eq!((found.layers[1].name.as_str(), found.layers[1].max), ("Z", 0.0));
        assert_eq!((found.max, found.rms), (4.0, normal.rms));
        // Of four pixels two differ, one of them by more than 2.
        assert_eq!((found.differing, found.over, found.flip), (2, 1, None));
    }

    #[test]
    fn infinite_depths_are_equal_or_apart() {
        let far = f64::INFINITY;
        let a = image(4, &[("Z", &[far, far, 1.0, f64::NAN])]);
        let b = image(4, &[("Z", &[far, 2.0, 1.5, f64::NAN])]);
        let found = compare(&a, &b, &CompareOptions::default()).unwrap();
        assert_eq!((found.max, found.apart, found.differing, found.over), (0.5, 1, 2, 2));
        assert_eq!(found.rms, 0.25);
        assert_eq!(found.exceeded(&ErrorLimits { max: Some(1.0), ..Default::default() }).len(), 1);
        assert_eq!(found.exceeded(&ErrorLimits { rms: Some(0.1), ..Default::default() }).len(), 2);
    }

    #[test]
    fn what_only_one_has_is_named_and_no_alpha_is_opaque() {
        let grey: &[f64] = &[0.5];
        let a = image(1, &[("R", grey), ("G", grey), ("B", grey)]);
        let b = image(1, &[("R", grey), ("G", grey), ("B", grey), ("A", &[0.75]), ("Z", grey)]);
        let found = compare(&a, &b, &CompareOptions::default()).unwrap();
        assert_eq!((found.max, found.layers[0].name.as_str()), (0.25, "beauty"));
        assert_eq!((found.only_in_a, found.only_in_b), (vec![], vec!["Z".to_string()]));
        assert!(found.flip.unwrap() > 0.0);
    }

    #[test]
    fn limits_hold_or_not() {
        let [a, b] = [0.25, 0.5].map(|v| image(1, &[("R", &[v]), ("G", &[v]), ("B", &[v])]));
        let found = compare(&a, &b, &CompareOptions::default()).unwrap();
        let flip = found.flip.unwrap();
        assert_eq!(found.exceeded(&ErrorLimits { max: Some(0.25), rms: Some(0.25), flip: Some(flip) }), [""; 0]);
        let tight = ErrorLimits { max: Some(0.2), rms: Some(0.1), flip: Some(flip / 2.0) };
        assert_eq!(found.exceeded(&tight).len(), 3);
        let depth = image(1, &[("Z", &[1.0])]);
        let found = compare(&depth, &depth, &CompareOptions::default()).unwrap();
        assert_eq!(found.exceeded(&ErrorLimits { flip: Some(1.0), ..Default::default() }).len(), 1);
    }

    #[test]
    fn what_cannot_be_compared() {
        let (a, wide) = (image(1, &[("Z", &[1.0])]), image(2, &[("Z", &[1.0, 2.0])]));
        assert!(matches!(compare(&a, &wide, &CompareOptions::default()), Err(OutputError::Sizes { .. })));
        let none = image(1, &[("Z", &[])]);
        assert!(matches!(compare(&none, &none, &CompareOptions::default()), Err(OutputError::Layer { .. })));
        let error = compare(&a, &image(1, &[("Y", &[1.0])]), &CompareOptions::default()).unwrap_err();
        assert_eq!(error.to_string(), "the pictures have no channel in common: the first has Z, the second Y");
    }

    #[test]
    fn as_a_table_and_as_json() {
        let a = image(1, &[("first.VALUE", &[1.0]), ("Y", &[0.0])]);
        let b = image(1, &[("first.VALUE", &[1.5])]);
        let found = compare(&a, &b, &CompareOptions::default()).unwrap();
        let expected = "\
layer                     max          rms             at    apart
first               5.0000e-1    5.0000e-1           0, 0        0
flip (mean)        no colours
pixels                      1
  that differ               1     100.000 %
  over 3.922e-3             1     100.000 %
only in the first: Y";
        assert_eq!(found.to_string(), expected);
        let json = serde_json::to_value(&found).unwrap();
        assert_eq!(json["layers"][0]["max"], 0.5);
        assert_eq!(json["flip"], serde_json::Value::Null);
    }
}
