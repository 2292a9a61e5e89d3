//! LDR-FLIP: the difference that a viewer sees when two pictures alternate.
//!
//! P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. D. Fairchild: FLIP: A Difference Evaluator
//! for Alternating Images. Proc. ACM Comput. Graph. Interact. Tech. 3(2), 15:1–15:23, 2020 (HPG).
//!
//! The colour pipeline (section 4.1) filters both pictures as the eye does at the viewing distance, then measures
//! colour distances. The feature pipeline (4.2) finds edges and points that only one picture has. The difference of a
//! pixel (4.3) is ΔE = ΔE_c^(1 − ΔE_f), in [0, 1]. It is symmetric in the two pictures.
//!
//! The authors' tool computes in f32; this module computes in f64. FLIP's inputs are decoded sRGB files, so linear
//! pictures are clamped to [0, 1]. Encoding and decoding a picture has the same effect, apart from the rounding to 8
//! bits. FLIP has no α: pictures that are not opaque are laid on white.

mod color;
pub(super) mod filter;

use crate::OutputError;
use crate::layers::room;
use crate::read::{ColorChannels, Image};
use color::{hunt_lab, lab_distance, linear_to_ycxcz, ycxcz_to_linear};
use drypoint_scene::math;
use filter::{Kernels, separable};

/// Pixels per degree of a screen 0.7 m wide with 3840 pixels, seen from 0.7 m: 0.7 · 3840/0.7 · π/180.
pub const PIXELS_PER_DEGREE: f64 = 67.0206;

/// q_c of section 4.1: the exponent of colour distances.
const Q_C: f64 = 0.7;
/// p_c: colour distances up to this share of the largest one fill [0, p_t].
const P_C: f64 = 0.4;
/// p_t: the value where the two linear pieces meet.
const P_T: f64 = 0.95;
/// q_f of section 4.2: the exponent of feature differences.
const Q_F: f64 = 0.5;

/// Bytes of memory a pixel: colours, edges and points of both pictures, and the filtered planes.
const PIXEL: usize = 400;

/// A map of differences in [0, 1], one a pixel, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct FlipMap {
    /// Pixels from left to right.
    pub width: usize,
    /// Pixels from top to bottom.
    pub height: usize,
    /// The differences.
    pub values: Vec<f64>,
}

impl FlipMap {
    /// Returns the mean over all pixels, the single number that the authors recommend.
    pub fn mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len() as f64
    }
}

/// Returns the FLIP map of two pictures of equal size. `pixels_per_degree` is from 1 to 1000, usually
/// [`PIXELS_PER_DEGREE`].
///
/// # Errors
/// [`OutputError::Viewing`], [`OutputError::Sizes`], [`OutputError::Layer`] for pictures without pixels,
/// [`OutputError::NoColor`] for one without colours, [`OutputError::NoRoom`].
pub fn flip(a: &Image, b: &Image, pixels_per_degree: f64) -> Result<FlipMap, OutputError> {
    if !(1.0..=1000.0).contains(&pixels_per_degree) {
        return Err(OutputError::Viewing { pixels_per_degree });
    }
    let [width, height] = super::common_size(a, b)?;
    room(None, [width, height], PIXEL)?;
    let kernels = Kernels::new(pixels_per_degree);
    let [a, b] = [("the first picture", a), ("the second picture", b)].map(|(name, image)| {
        let rgb = seen(image).ok_or_else(|| OutputError::NoColor { name: name.into(), found: image.names() })?;
        Ok(FilteredImage::new(&rgb, width, height, &kernels))
    });
    let (a, b): (FilteredImage, FilteredImage) = (a?, b?);
    let largest = largest_distance();
    let values = (0..width * height)
        .map(|i| {
            let colour = redistribute(math::pow(lab_distance(a.lab[i], b.lab[i]), Q_C), largest);
            let feature = feature_difference([a.edge[i], a.point[i]], [b.edge[i], b.point[i]]);
            math::pow(colour, 1.0 - feature)
        })
        .collect();
    Ok(FlipMap { width, height, values })
}

/// Returns the linear colours that a viewer sees: laid on white, clamped to [0, 1], NaN as 0. None if the picture has
/// no colours.
fn seen(image: &Image) -> Option<Vec<[f64; 3]>> {
    let ColorChannels { rgb, alpha } = image.colors()?;
    let white = |i: usize| alpha.map_or(0.0, |a| 1.0 - unit(a[i]));
    Some((0..image.width * image.height).map(|i| rgb.map(|c| unit(c[i] + white(i)))).collect())
}

/// Returns c clamped to [0, 1], and 0 for NaN.
fn unit(c: f64) -> f64 {
    if c.is_nan() { 0.0 } else { c.clamp(0.0, 1.0) }
}

/// One picture filtered by both pipelines.
struct FilteredImage {
    /// Filtered colours in L*a*b*, chroma adjusted after Hunt.
    lab: Vec<[f64; 3]>,
    /// ‖gradient‖ of the filtered luminance.
    edge: Vec<f64>,
    /// Norm of the second derivatives of the filtered luminance.
    point: Vec<f64>,
}

impl FilteredImage {
    fn new(rgb: &[[f64; 3]], width: usize, height: usize, k: &Kernels) -> Self {
        let [y, cx, cz]: [Vec<f64>; 3] = {
            let opponent: Vec<_> = rgb.iter().map(|&c| linear_to_ycxcz(c)).collect();
            [0, 1, 2].map(|channel| opponent.iter().map(|c| c[channel]).collect())
        };
        let smooth = |plane: &[f64], kernel: &[f64]| separable(plane, width, height, kernel, kernel);

        // Section 4.1: each opponent channel goes through its contrast sensitivity function. That of Cz is the sum of
        // two Gaussians.
        let [y_seen, cx_seen] = [smooth(&y, &k.y), smooth(&cx, &k.cx)];
        let cz_seen = k.cz.each_ref().map(|kernel| smooth(&cz, kernel));
        let lab = (0..rgb.len())
            .map(|i| {
                let linear = ycxcz_to_linear([y_seen[i], cx_seen[i], cz_seen[0][i] + cz_seen[1][i]]);
                hunt_lab(linear.map(unit))
            })
            .collect();

        // Section 4.2: derivatives of Gaussians on the unfiltered luminance, in [0, 1].
        let grey: Vec<f64> = y.iter().map(|y| (y + 16.0) / 116.0).collect();
        let norm = |kernel: &[f64]| -> Vec<f64> {
            let along_x = separable(&grey, width, height, kernel, &k.gaussian);
            let along_y = separable(&grey, width, height, &k.gaussian, kernel);
            along_x.iter().zip(&along_y).map(|(x, y)| (x * x + y * y).sqrt()).collect()
        };
        Self { lab, edge: norm(&k.edge), point: norm(&k.point) }
    }
}

/// Returns the largest colour distance, that of the green and the blue primary, to the power q_c.
fn largest_distance() -> f64 {
    math::pow(lab_distance(hunt_lab([0.0, 1.0, 0.0]), hunt_lab([0.0, 0.0, 1.0])), Q_C)
}

/// ΔE_c: maps distances up to p_c of the largest one to [0, p_t], and larger distances to (p_t, 1].
fn redistribute(distance: f64, largest: f64) -> f64 {
    let knee = P_C * largest;
    if distance < knee { distance * P_T / knee } else { P_T + (distance - knee) / (largest - knee) * (1.0 - P_T) }
}

/// ΔE_f of a pixel, from the norms of edges and points in both pictures.
fn feature_difference(a: [f64; 2], b: [f64; 2]) -> f64 {
    let [edge, point] = [(a[0] - b[0]).abs(), (a[1] - b[1]).abs()];
    math::pow(edge.max(point) / 2f64.sqrt(), Q_F)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::color::srgb_to_linear;
    use proptest::prelude::*;

    const WIDTH: usize = 32;
    const HEIGHT: usize = 24;

    type Pattern = fn(usize, usize) -> [u8; 3];

    fn black(_: usize, _: usize) -> [u8; 3] {
        [0; 3]
    }

    fn white(_: usize, _: usize) -> [u8; 3] {
        [255; 3]
    }

    fn ramp(x: usize, y: usize) -> [u8; 3] {
        [8 * x, 10 * y, 4 * (x + y)].map(|c| c as u8)
    }

    fn dotted(x: usize, y: usize) -> [u8; 3] {
        if (x, y) == (12, 9) { [255; 3] } else { ramp(x, y) }
    }

    fn checker(x: usize, y: usize) -> [u8; 3] {
        [if (x / 4 + y / 4).is_multiple_of(2) { 230 } else { 20 }; 3]
    }

    fn shifted(x: usize, y: usize) -> [u8; 3] {
        checker(x + 1, y)
    }

    fn waves(x: usize, y: usize) -> [u8; 3] {
        [3 * x * x + 5 * y, 7 * x * y, 11 * y * y + 2 * x].map(|c| c as u8)
    }

    fn warm(x: usize, y: usize) -> [u8; 3] {
        let [r, g, b] = waves(x, y);
        [r.saturating_add(30), g, b / 2]
    }

    fn image(width: usize, codes: impl Fn(usize, usize) -> [u8; 3], height: usize) -> Image {
        let pixels: Vec<_> = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).collect();
        let channels = ["R", "G", "B"].into_iter().enumerate().map(|(c, name)| {
            let plane = pixels.iter().map(|&(x, y)| srgb_to_linear(f64::from(codes(x, y)[c]) / 255.0)).collect();
            (name.to_string(), plane)
        });
        Image { width, height, channels: channels.collect() }
    }

    /// Figures of the authors' C++ tool (as the crate nv-flip 0.1.2 builds it), for pictures of 32 × 24 pixels.
    ///
    /// `mean` and `pixels` are the tool's own, in f32; see [`rounding`]. `mean_f64` comes from the same source with
    /// `double` in place of `float`. There only the nine digits of its matrices differ from ours: 10⁻⁹ of Y, which
    /// where both pictures agree is 10⁻⁷ of L* and (10⁻⁷)^0.7 · 0.95/16.5 = 7·10⁻⁷ of the difference; in the mean less.
    struct FlipCase {
        name: &'static str,
        a: Pattern,
        b: Pattern,
        pixels_per_degree: f64,
        mean_f64: f64,
        mean: f64,
        pixels: [f64; 6],
    }

    const PIXELS: [(usize, usize); 6] = [(0, 0), (12, 9), (14, 9), (31, 23), (16, 0), (5, 17)];

    const CASES: [FlipCase; 6] = [
        FlipCase {
            name: "black and white",
            a: black,
            b: white,
            pixels_per_degree: 67.0206,
            mean_f64: 0.967379763236,
            mean: 0.967385530,
            pixels: [0.96738553; 6],
        },
        FlipCase {
            name: "one white dot",
            a: ramp,
            b: dotted,
            pixels_per_degree: 67.0206,
            mean_f64: 0.007998743176,
            mean: 0.007999178,
            pixels: [0.0, 0.44633532, 0.17539598, 0.0, 0.00012188, 0.00007049],
        },
        FlipCase {
            name: "a checkerboard moved by a pixel",
            a: checker,
            b: shifted,
            pixels_per_degree: 67.0206,
            mean_f64: 0.305720981388,
            mean: 0.305729509,
            pixels: [0.04387386, 0.52227437, 0.52227414, 0.79876256, 0.45823967, 0.00006766],
        },
        FlipCase {
            name: "a change of colour",
            a: waves,
            b: warm,
            pixels_per_degree: 67.0206,
            mean_f64: 0.574709276871,
            mean: 0.574709254,
            pixels: [0.09415459, 0.54917300, 0.62672675, 0.78083360, 0.39407003, 0.58299398],
        },
        FlipCase {
            name: "the same from nearby",
            a: waves,
            b: warm,
            pixels_per_degree: 20.0,
            mean_f64: 0.533823951629,
            mean: 0.533823973,
            pixels: [0.11913928, 0.54064381, 0.75210541, 0.88782686, 0.23207051, 0.69818944],
        },
        FlipCase {
            name: "nothing in common",
            a: ramp,
            b: waves,
            pixels_per_degree: 30.0,
            mean_f64: 0.780092220713,
            mean: 0.780092230,
            pixels: [0.03188546, 0.96601409, 0.47932041, 0.95846426, 0.63415426, 0.94203436],
        },
    ];

    /// Bound of the error by f32 for a difference c.
    ///
    /// The weights of the feature filters sum to 0; in f32 the positive and the negative half leave δ = 2⁻²³, and ΔE_f
    /// is its root, √(δ/√2) = 2.9·10⁻⁴, so that c^(1 − ΔE_f) is off by 2.9·10⁻⁴·(−c ln c). The colour filters sum
    /// 21 + 21 terms: 42·2⁻²⁴ of Y is 10⁻⁴ of L*, which d^0.7·0.95/16.5 turns into 10⁻⁴ where the distance d is near 0,
    /// and into 4·10⁻⁶ or less from d = 1 on.
    fn rounding(c: f64) -> f64 {
        let colour = if c < 0.01 { 1e-4 } else { 4e-6 };
        if c > 0.0 { colour - 2.9e-4 * c * c.ln() } else { colour }
    }

    #[test]
    fn the_authors_figures() {
        for case in CASES {
            let [a, b] = [case.a, case.b].map(|pattern| image(WIDTH, pattern, HEIGHT));
            let map = flip(&a, &b, case.pixels_per_degree).unwrap();
            let mean = map.mean();
            assert!((mean - case.mean_f64).abs() < 1e-7, "{}: {mean} for {}", case.name, case.mean_f64);
            assert!((mean - case.mean).abs() < 1e-5, "{}: {mean} for {}", case.name, case.mean);
            for ((x, y), expected) in PIXELS.into_iter().zip(case.pixels) {
                let found = map.values[y * WIDTH + x];
                assert!(
                    (found - expected).abs() < rounding(expected),
                    "{} at {x}, {y}: {found} for {expected}",
                    case.name
                );
            }
        }
    }

    #[test]
    fn no_difference_is_zero_and_both_ways_are_the_same() {
        for case in CASES {
            let [a, b] = [case.a, case.b].map(|pattern| image(WIDTH, pattern, HEIGHT));
            let map = flip(&a, &b, case.pixels_per_degree).unwrap();
            assert_eq!(map, flip(&b, &a, case.pixels_per_degree).unwrap(), "{}", case.name);
            assert!(flip(&a, &a, case.pixels_per_degree).unwrap().values.iter().all(|&v| v == 0.0));
        }
    }

    #[test]
    fn what_is_seen() {
        let with = |value: f64, alpha: f64| Image {
            width: 1,
            height: 1,
            channels: [("R", value), ("G", value), ("B", value), ("A", alpha)].map(|(n, v)| (n.into(), vec![v])).into(),
        };
        // Half covered, premultiplied 0.25: 0.25 + 0.5 of the white ground.
        assert_eq!(seen(&with(0.25, 0.5)).unwrap(), [[0.75; 3]]);
        for (value, expected) in [(7.0, 1.0), (-1.0, 0.0), (f64::NAN, 0.0)] {
            assert_eq!(seen(&with(value, 1.0)).unwrap(), [[expected; 3]]);
        }
    }

    #[test]
    fn bad_use_is_an_error() {
        let (a, wide) = (image(2, ramp, 2), image(3, ramp, 2));
        let grey = Image { width: 2, height: 2, channels: vec![("Y".into(), vec![0.0; 4])] };
        assert!(matches!(flip(&a, &wide, 67.0), Err(OutputError::Sizes { .. })));
        assert!(matches!(flip(&a, &grey, 67.0), Err(OutputError::NoColor { .. })));
        let none = image(0, ramp, 0);
        assert!(matches!(flip(&none, &none, 67.0), Err(OutputError::Layer { .. })));
        for bad in [0.0, -1.0, f64::NAN, 1e9] {
            assert!(matches!(flip(&a, &a, bad), Err(OutputError::Viewing { .. })));
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn always_between_zero_and_one(values in prop::collection::vec(-0.5f64..1.5, 2 * 3 * 20), near in 1.0f64..100.0) {
            let picture = |values: &[f64]| Image {
                width: 5,
                height: 4,
                channels: ["R", "G", "B"].iter().zip(values.chunks(20)).map(|(n, v)| ((*n).into(), v.to_vec())).collect(),
            };
            let map = flip(&picture(&values[..60]), &picture(&values[60..]), near).unwrap();
            prop_assert!(map.values.iter().all(|v| (0.0..=1.0).contains(v)));
        }
    }
}
