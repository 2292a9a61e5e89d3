//! What can be measured on a picture without knowing what it shows.

use drypoint::scene::color::linear_to_srgb;
use drypoint::scene::picture::{LayerKind, Picture};

/// Measures of a picture with the background "none", over the pixels that are covered: α > ½.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measures {
    /// Share of all pixels that are covered.
    pub covered: f64,
    /// The longer side of the smallest rectangle that holds them, over the shorter side of the picture.
    pub filled: f64,
    /// L* of CIE 1976 from the 5th to the 95th percentile.
    pub lightness: f64,
    /// The largest share of them in which one channel of an 8-bit picture would be 0 or 255.
    pub clipped: f64,
    /// Whether every number of every channel is finite.
    pub finite: bool,
}

/// The measures of a picture's beauty.
pub(crate) fn measure(picture: &Picture) -> Measures {
    let beauty = &picture.layer(LayerKind::Beauty).unwrap().channels;
    let finite = beauty.iter().flatten().all(|v| v.is_finite());
    let (width, height) = (picture.width, picture.height);
    let covered: Vec<usize> = (0..width * height).filter(|&i| beauty[3][i] > 0.5).collect();
    let (mut lo, mut hi) = ([usize::MAX; 2], [0; 2]);
    for &i in &covered {
        for (axis, at) in [i % width, i / width].into_iter().enumerate() {
            (lo[axis], hi[axis]) = (lo[axis].min(at), hi[axis].max(at + 1));
        }
    }
    let extent = (0..2).map(|axis| hi[axis].saturating_sub(lo[axis])).max().unwrap();
    let straight = |c: usize, i: usize| beauty[c][i] / beauty[3][i];
    let mut lightness: Vec<f64> =
        covered.iter().map(|&i| l_star([0, 1, 2].map(|c| straight(c, i).clamp(0.0, 1.0)))).collect();
    lightness.sort_by(f64::total_cmp);
    let percentile = |p: usize| lightness[(lightness.len() * p / 100).min(lightness.len() - 1)];
    let clipped = |c: usize| {
        let byte = |i: usize| (linear_to_srgb(straight(c, i).clamp(0.0, 1.0)) * 255.0).round();
        covered.iter().filter(|&&i| [0.0, 255.0].contains(&byte(i))).count() as f64 / covered.len() as f64
    };
    Measures {
        covered: covered.len() as f64 / (width * height) as f64,
        filled: extent as f64 / width.min(height) as f64,
        lightness: if covered.is_empty() { 0.0 } else { percentile(95) - percentile(5) },
        clipped: if covered.is_empty() { 0.0 } else { (0..3).map(clipped).fold(0.0, f64::max) },
        finite,
    }
}

/// L* of linear sRGB, D65: the luminance of IEC 61966-2-1 and the cube root of CIE 15.
fn l_star([r, g, b]: [f64; 3]) -> f64 {
    let y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    if y > 216.0 / 24389.0 { 116.0 * y.cbrt() - 16.0 } else { y * 24389.0 / 27.0 }
}

mod tests {
    use super::*;
    use drypoint::scene::picture::Layer;

    #[test]
    fn measures_by_hand() {
        // 4 × 2 pixels: white, mid-grey (Y 18.4187 %: L* 50), black, at α 1, 1 and 0.6; the rest clear.
        let grey = 0.184_186_518;
        let rgb = vec![1.0, grey, 0.0, 0.3, 0.0, 0.0, 0.0, 0.0];
        let alpha = vec![1.0, 1.0, 0.6, 0.5, 0.0, 0.0, 0.0, 0.0];
        let layer = Layer { kind: LayerKind::Beauty, channels: vec![rgb.clone(), rgb.clone(), rgb, alpha] };
        let m = measure(&Picture { width: 4, height: 2, layers: vec![layer] });
        assert_eq!((m.covered, m.filled, m.finite), (3.0 / 8.0, 3.0 / 2.0, true));
        assert!((m.lightness - 100.0).abs() < 1e-9 && (m.clipped - 2.0 / 3.0).abs() < 1e-12, "{m:?}");
        assert!((l_star([grey; 3]) - 50.0).abs() < 1e-4);
    }
}
