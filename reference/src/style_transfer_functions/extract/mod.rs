//! A style from a part of a picture ([STF-2]; Bruckner and Gröller 2007, 3.1, after Sloan et al., *The Lit Sphere*,
//! 2001).
//!
//! A region is read as the picture of a body: a circle as a sphere, an ellipse as an ellipsoid, a closed outline as the
//! body inflated from it. Each place then has a normal. The style shows at each normal what the picture shows at the
//! place.
//!
//! - **Circle, ellipse**: a formula gives the one place of each normal. A texel is the mean over its own square, in
//!   parts of half a pixel or less: an average where the style is coarser than the picture, cubic interpolation where
//!   it is finer.
//! - **Outline**: a normal may have several places. Every place inside contributes to the texel of its normal.
//!
//! Texels that the picture does not show, because the region reaches beyond its edge, continue the others smoothly.
//! Opacity is extracted too, so a picture with transparent parts gives a style with transparent parts.

mod check;
mod ellipse;
mod error;
mod fill;
mod inflate;
mod outline;
mod patch;
mod polygon;

pub use error::ExtractError;

use drypoint_scene::color::Rgba;
use drypoint_scene::parallel;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use drypoint_scene::style::{MAX_SIDE, SourcePicture, is_inside};
use ellipse::Ellipse;
use patch::Patch;

/// The largest coordinate or length of a region, in pixels: beyond every picture.
pub const LARGEST: f64 = 1e7;

/// The largest number of parts along a style's side, so that no region takes minutes. Regions up to half as many pixels
/// across are averaged without gaps.
const FINEST: usize = 16384;

/// A part of a picture, in pixels from its upper left corner: x to the right, y down. The pixel in column i and row j
/// reaches from (i, j) to (i + 1, j + 1).
#[derive(Clone, Debug, PartialEq)]
pub enum Region {
    /// A sphere.
    Circle {
        /// The centre's distance from the left.
        x: f64,
        /// The centre's distance from the top.
        y: f64,
        /// The radius.
        r: f64,
    },
    /// An ellipsoid.
    Ellipse {
        /// The centre's distance from the left.
        x: f64,
        /// The centre's distance from the top.
        y: f64,
        /// One half axis.
        a: f64,
        /// The half axis perpendicular to a.
        b: f64,
        /// Angle of the half axis a in degrees, anticlockwise as seen from the line to the right.
        angle: f64,
        /// The half axis out of the picture. The default is the smaller of a and b.
        depth: Option<f64>,
    },
    /// Any closed shape.
    Outline {
        /// The points in order, x and y of each. The last point is joined to the first.
        points: Vec<[f64; 2]>,
        /// The body's extent out of the picture. The default is the radius of the largest circle inside the outline.
        depth: Option<f64>,
    },
}

/// The result of [`extract`].
#[derive(Clone, Debug, PartialEq)]
pub struct Extracted {
    /// The layer `beauty` of S × S texels: linear, premultiplied; transparent black outside the disk ([STF-1]).
    pub picture: Picture,
    /// The share of the disk's texels that the picture shows. The other texels continue them.
    pub shown: f64,
}

/// Extracts a style of side × side texels from a region of a picture.
///
/// Only pixels whose centres lie in the region are read.
///
/// # Errors
/// The side is 0 or too large. A number is not finite or beyond [`LARGEST`]. A radius, half axis or depth is not
/// positive. An outline has fewer than three points, or lines that meet. The region lies outside the picture, or
/// contains no pixel.
pub fn extract(source: &SourcePicture, region: &Region, side: usize) -> Result<Extracted, ExtractError> {
    if side == 0 || side > MAX_SIDE {
        return Err(ExtractError::Side { side, limit: MAX_SIDE });
    }
    let texels = match *region {
        Region::Circle { x, y, r } => ellipse_texels(source, Ellipse::circle(x, y, r)?, side)?,
        Region::Ellipse { x, y, a, b, angle, depth } => {
            ellipse_texels(source, Ellipse::new([x, y], [a, b], angle, depth)?, side)?
        }
        Region::Outline { ref points, depth } => outline::texels(source, points, depth, side)?,
    };
    let inside = (0..side * side).filter(|t| is_inside(side, t % side, t / side));
    let (all, known) = inside.fold((0, 0), |(all, known), t| (all + 1, known + usize::from(texels[t].is_some())));
    let colors = fill::fill(side, &texels).ok_or(ExtractError::Empty)?;
    let channels = (0..4).map(|c| colors.iter().map(|color| color[c]).collect()).collect();
    let layers = vec![Layer { kind: LayerKind::Beauty, channels }];
    Ok(Extracted { picture: Picture { width: side, height: side, layers }, shown: known as f64 / all as f64 })
}

/// Fails for a box that does not overlap the picture.
fn overlap(source: &SourcePicture, low: [f64; 2], high: [f64; 2]) -> Result<(), ExtractError> {
    let [width, height] = [source.width(), source.height()];
    let apart = high[0] <= 0.0 || high[1] <= 0.0 || low[0] >= width as f64 || low[1] >= height as f64;
    if apart { Err(ExtractError::Outside { width, height }) } else { Ok(()) }
}

fn ellipse_texels(source: &SourcePicture, ellipse: Ellipse, side: usize) -> Result<Vec<Option<Rgba>>, ExtractError> {
    let [low, high] = ellipse.bounds();
    overlap(source, low, high)?;
    let patch = Patch::new(source, low, high, |x, y| ellipse.contains(x, y)).ok_or(ExtractError::Empty)?;
    let texel = |t: usize| is_inside(side, t % side, t / side).then(|| mean(&patch, ellipse, side, t)).flatten();
    Ok(parallel::gather(side * side, side, &|row, texels| texels.extend(row.map(texel))))
}

/// The mean over the part of texel t's square that lies in the disk and that the picture shows.
fn mean(patch: &Patch, ellipse: Ellipse, side: usize, t: usize) -> Option<Rgba> {
    let texel = 2.0 / side as f64;
    let [left, top] = [(t % side) as f64 * texel - 1.0, 1.0 - (t / side) as f64 * texel];
    let at = |u: f64, v: f64| [left + u * texel, top - v * texel];
    let place = |u: f64, v: f64| {
        let [nx, ny] = at(u, v);
        let beyond = (nx * nx + ny * ny).sqrt().max(1.0);
        ellipse.place(nx / beyond, ny / beyond)
    };
    let [p00, p10, p01, p11] = [place(0.0, 0.0), place(1.0, 0.0), place(0.0, 1.0), place(1.0, 1.0)];
    let span = [(p00, p11), (p10, p01)].map(|(p, q)| (p[0] - q[0]).abs().max((p[1] - q[1]).abs()));
    let n = ((2.0 * span[0].max(span[1])).ceil() as usize).clamp(1, (FINEST / side).max(1));
    let (mut sum, mut count) = ([0.0; 4], 0.0);
    for part in 0..n * n {
        let [u, v] = [part % n, part / n].map(|k| (k as f64 + 0.5) / n as f64);
        let [nx, ny] = at(u, v);
        if nx * nx + ny * ny > 1.0 {
            continue;
        }
        let [x, y] = ellipse.place(nx, ny);
        if let Some(color) = patch.sample(x, y) {
            sum = std::array::from_fn(|c| sum[c] + color[c]);
            count += 1.0;
        }
    }
    (count > 0.0).then(|| sum.map(|s: f64| s / count))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [usize; 2] = [220, 180];

    /// Opaque linear light by a formula of the place.
    fn picture(light: impl Fn(f64, f64) -> [f64; 3]) -> SourcePicture {
        let [width, height] = SIZE;
        let pixel = |t: usize| {
            let [r, g, b] = light((t % width) as f64 + 0.5, (t / width) as f64 + 0.5);
            [r, g, b, 1.0]
        };
        SourcePicture::from_straight(width, height, (0..width * height).map(pixel).collect(), true).unwrap()
    }

    /// A smooth style: light by the normal.
    fn light(nx: f64, ny: f64) -> [f64; 3] {
        [0.5 + 0.3 * nx - 0.2 * ny, 0.4 + 0.4 * nx * ny, 0.6 - 0.3 * ny * ny]
    }

    /// The largest difference of a style's texels from `light`.
    fn error(extracted: &Extracted) -> f64 {
        let side = extracted.picture.width;
        let channels = &extracted.picture.layers[0].channels;
        let centre = |k: usize| (2 * k + 1) as f64 / side as f64 - 1.0;
        let differ = |t: usize| {
            let expected = light(centre(t % side), -centre(t / side));
            (0..3).map(|c| (channels[c][t] - expected[c]).abs()).fold((channels[3][t] - 1.0).abs(), f64::max)
        };
        (0..side * side).filter(|t| is_inside(side, t % side, t / side)).map(differ).fold(0.0, f64::max)
    }

    /// The inner ellipse of a region, as an outline.
    fn outline([x, y]: [f64; 2], [a, b]: [f64; 2], angle: f64, points: usize, depth: Option<f64>) -> Region {
        let (cos, sin) = (angle.to_radians().cos(), angle.to_radians().sin());
        let point = |k: usize| {
            let t = std::f64::consts::TAU * k as f64 / points as f64;
            let (u, v) = (a * t.cos(), b * t.sin());
            [x + cos * u - sin * v, y - sin * u - cos * v]
        };
        Region::Outline { points: (0..points).map(point).collect(), depth }
    }

    /// Lookups off the centre and between pixels. Texels are means over squares of side 2/S, which differ from their
    /// middles by f''(2/S)²/24 < 10⁻³ each way. At the rim a texel's mean is over its part inside, and pixels outside
    /// are replaced by their neighbours: up to a slope of 0.5 times (1/S + 1/r).
    #[test]
    fn a_sphere_gives_its_style() {
        let (x, y, r) = (97.3, 88.8, 71.4);
        let source = picture(|px, py| light((px - x) / r, (y - py) / r));
        for side in [16, 64, 256] {
            let found = extract(&source, &Region::Circle { x, y, r }, side).unwrap();
            let bound = 0.5 * (1.0 / side as f64 + 1.0 / r);
            assert!(error(&found) < bound, "{side}: {} {bound}", error(&found));
            assert_eq!(found.shown, 1.0);
        }
    }

    /// An outline gives what the circle or ellipse gives that it is, up to a texel and a pixel at the rim: slopes are at
    /// most 0.7, on an ellipse steeper by its ratio of axes.
    #[test]
    fn an_outline_gives_what_its_ellipse_gives() {
        let centre = [110.2, 91.7];
        for (axes, angle, depth, points) in
            [([80.0, 80.0], 0.0, None, 400), ([90.0, 45.0], 20.0, Some(60.0), 400), ([75.0, 75.0], 0.0, None, 24)]
        {
            let [a, b] = axes;
            let ellipse = Region::Ellipse { x: centre[0], y: centre[1], a, b, angle, depth };
            let source = picture(|x, y| {
                let [u, v] = [(x - centre[0]) / 100.0, (centre[1] - y) / 100.0];
                [0.5 + 0.4 * u, 0.5 + 0.4 * v, 0.5 + 0.5 * u * v]
            });
            let [one, other] = [ellipse, outline(centre, axes, angle, points, depth)]
                .map(|region| extract(&source, &region, 64).unwrap().picture.layers.remove(0).channels);
            // A polygon of n corners lies up to r(1 − cos(π/n)) inside its circle: 0.6 pixels for 24 corners.
            let bound = 0.7 * (a / b) * (1.0 / 64.0 + 1.0 / b);
            for t in (0..64 * 64).filter(|t| is_inside(64, t % 64, t / 64)) {
                for c in 0..4 {
                    let d = (one[c][t] - other[c][t]).abs();
                    assert!(d < bound, "{axes:?} {points} texel {t} channel {c}: {d} {bound}");
                }
            }
        }
    }

    /// Stripes of a pixel in a style whose texels are ten pixels wide: all are grey, to a stripe in ten and the weight of
    /// the rim's parts.
    #[test]
    fn what_is_finer_than_a_texel_is_averaged() {
        let source = picture(|x, y| [((x + y) as i64 % 2) as f64; 3]);
        let circle = Region::Circle { x: 100.0, y: 90.0, r: 80.0 };
        for region in [circle, outline([100.0, 90.0], [80.0, 80.0], 0.0, 300, None)] {
            let found = extract(&source, &region, 16).unwrap();
            let channels = &found.picture.layers[0].channels;
            for t in (0..256).filter(|t| is_inside(16, t % 16, t / 16)) {
                assert!((channels[0][t] - 0.5).abs() < 0.1, "{region:?} {t}: {}", channels[0][t]);
            }
        }
    }

    /// A sphere cut off by the picture: what is shown is as if nothing were missing, and the rest lies between the least
    /// and the largest of it.
    #[test]
    fn a_cropped_sphere_is_continued() {
        let (x, y, r) = (20.0, 90.0, 60.0);
        let source = picture(|px, py| light((px - x) / r, (y - py) / r));
        let region = Region::Circle { x, y, r };
        let (side, texel) = (64, 2.0 / 64.0);
        let found = extract(&source, &region, side).unwrap();
        // Shown is what lies right of N_x = −1/3: 1 − (acos(1/3) − √(8)/9)/π of the disk.
        let expected = 1.0 - ((1.0f64 / 3.0).acos() - 8f64.sqrt() / 9.0) / std::f64::consts::PI;
        assert!((found.shown - expected).abs() < texel, "{} {expected}", found.shown);
        let red = &found.picture.layers[0].channels[0];
        for t in (0..side * side).filter(|t| is_inside(side, t % side, t / side)) {
            let [nx, ny] = [(t % side, 1.0), (t / side, -1.0)].map(|(k, s)| s * ((2 * k + 1) as f64 / 64.0 - 1.0));
            if nx > -1.0 / 3.0 + texel {
                assert!((red[t] - light(nx, ny)[0]).abs() < 0.5 * (1.0 / 64.0 + 1.0 / r));
            }
            // The least and the largest of 0.5 + 0.3 x − 0.2 y right of x = −1/3: at its ends, and √(0.09 + 0.04) off.
            assert!((0.2..=0.5 + 0.13f64.sqrt()).contains(&red[t]), "{nx} {ny}: {}", red[t]);
        }
    }

    #[test]
    fn a_corner_of_a_giant_is_a_style_too() {
        let source = picture(|x, _| [x / 220.0; 3]);
        let found = extract(&source, &Region::Circle { x: 1e6, y: 90.0, r: 999_990.0 }, 8).unwrap();
        assert!(found.shown > 0.0 && found.shown < 0.2);
        assert!(found.picture.layers[0].channels.iter().flatten().all(|v| (0.0..=1.0).contains(v)));
    }

    #[test]
    fn sides_and_places_are_checked() {
        let source = picture(|_, _| [0.5; 3]);
        let circle = |x: f64, r: f64| Region::Circle { x, y: 90.0, r };
        for side in [0, MAX_SIDE + 1] {
            let error = extract(&source, &circle(90.0, 10.0), side).unwrap_err();
            assert_eq!(error, ExtractError::Side { side, limit: MAX_SIDE });
        }
        assert_eq!(extract(&source, &circle(90.0, 10.0), 1).unwrap().picture.layers[0].channels[0], [0.5]);
        let outside = ExtractError::Outside { width: 220, height: 180 };
        assert_eq!(extract(&source, &circle(231.0, 10.0), 16), Err(outside.clone()));
        let triangle = [[-9.0, 0.0], [-1.0, 5.0], [-9.0, 9.0]].to_vec();
        assert_eq!(extract(&source, &Region::Outline { points: triangle, depth: None }, 16), Err(outside));
        assert_eq!(extract(&source, &circle(90.0, 0.3), 16), Err(ExtractError::Empty));
        let small = [[50.1, 50.1], [50.3, 50.1], [50.2, 50.3]].to_vec();
        assert_eq!(extract(&source, &Region::Outline { points: small, depth: None }, 16), Err(ExtractError::Empty));
    }
}
