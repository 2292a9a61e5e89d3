//! Pixels that get more rays at edges ([RAY-7]).
//!
//! A pixel is at an edge if it differs from one of its eight neighbours by more than the contrast, in one channel of
//! the displayed picture of one ray a pixel. It then has five rays, and nine if two of the five differ so. If errors leave
//! that open, the pixel is drawn both ways. Where both results overlap, their union is the bound. Otherwise the pixel is
//! undecided.

use super::BoundedPixel;
use super::positions::Answer;
use crate::number::{Arithmetic, Bounded, Decision, Real};
use crate::ray::refinement::PARTS;
use drypoint_scene::color::linear_to_srgb;
use drypoint_scene::parallel;

/// A pixel or a ray as it is displayed, and whether its errors can be relied on.
pub(super) struct Displayed {
    rgba: [Bounded; 4],
    is_enclosed: bool,
}

/// Draws a pixel of the picture with some parts of its 3×3, and tells how these are displayed.
pub(super) type DrawParts<'d> = dyn Fn(usize, &[usize]) -> (BoundedPixel, Vec<Displayed>) + Sync + 'd;

/// The refinement of a picture of one ray a pixel.
pub(super) struct Refinement {
    pub(super) size: [usize; 2],
    pub(super) contrast: f64,
    /// Whether each channel beyond the beauty is a mean over rays. The others keep the numbers of the middle ray.
    pub(super) is_mean: Vec<bool>,
}

impl Refinement {
    /// Adds rays to a picture.
    #[inline]
    pub(super) fn refined(&self, pixels: Vec<BoundedPixel>, draw: &DrawParts<'_>) -> Vec<BoundedPixel> {
        let [width, height] = self.size;
        let displayed: Vec<Displayed> =
            pixels.iter().map(|pixel| Displayed::new(pixel.rgba, pixel.is_enclosed)).collect();
        let contrast = Bounded::from_f64(self.contrast);
        let draw = |at: usize, plain: &BoundedPixel| {
            let (five, rays) = draw(at, PARTS[0]);
            let pairs = (0..rays.len()).flat_map(|i| (0..i).map(move |j| [i, j]));
            let apart = any_differ(pairs.map(|[i, j]| [&rays[i], &rays[j]]), contrast);
            let mut pixel = chosen(apart, five, &|_| draw(at, PARTS[1]).0);
            for (c, _) in self.is_mean.iter().enumerate().filter(|(_, is_mean)| !**is_mean) {
                pixel.more[c] = plain.more[c];
            }
            pixel
        };
        parallel::map_of(pixels, &|at, plain| {
            let [x, y] = [at % width, at / width];
            let rows = y.saturating_sub(1)..(y + 2).min(height);
            let near = rows.flat_map(|y| (x.saturating_sub(1)..(x + 2).min(width)).map(move |x| y * width + x));
            let pairs = near.filter(|&other| other != at).map(|other| [&displayed[at], &displayed[other]]);
            let at_edge = any_differ(pairs, contrast);
            chosen(at_edge, plain, &|plain| draw(at, plain))
        })
    }
}

/// Whether one of some pairs differs by more than the contrast: for the reference, and for an f32 renderer.
fn any_differ<'d>(pairs: impl Iterator<Item = [&'d Displayed; 2]>, contrast: Bounded) -> (bool, Answer) {
    let (mut any, mut answer) = (false, Answer::No);
    for [a, b] in pairs {
        let (by_value, of_pair) = differ(a, b, contrast);
        any |= by_value;
        answer = match (answer, of_pair) {
            (Answer::Yes, _) | (_, Answer::Yes) => Answer::Yes,
            (Answer::No, Answer::No) => Answer::No,
            _ => Answer::Open,
        };
    }
    (any, answer)
}

/// The pixel with fewer or with more rays, by the reference's answer and by that of an f32 renderer.
#[inline]
fn chosen(
    (by_value, answer): (bool, Answer),
    fewer: BoundedPixel,
    more: &dyn Fn(&BoundedPixel) -> BoundedPixel,
) -> BoundedPixel {
    match (answer, by_value) {
        (Answer::No, _) => fewer,
        (Answer::Yes, _) => more(&fewer),
        (Answer::Open, true) => either(more(&fewer), &fewer),
        (Answer::Open, false) => {
            let other = more(&fewer);
            either(fewer, &other)
        }
    }
}

impl Displayed {
    /// The displayed channels of a colour over its background: R, G and B in [0, 1] and encoded to sRGB, and α.
    pub(super) fn new([r, g, b, a]: [Bounded; 4], is_enclosed: bool) -> Self {
        let encoded = |c: Bounded| Bounded::monotone([c.clamp_01()], |[c]| linear_to_srgb(c));
        Self { rgba: [encoded(r), encoded(g), encoded(b), a], is_enclosed }
    }
}

/// Whether two pixels differ by more than the contrast: for the reference, and for an f32 renderer.
fn differ(a: &Displayed, b: &Displayed, contrast: Bounded) -> (bool, Answer) {
    let over = [0, 1, 2, 3].map(|c| {
        let apart = a.rgba[c] - b.rgba[c];
        Bounded::new(apart.value().abs() - contrast.value(), apart.error() + contrast.error())
    });
    let by_value = over.iter().any(|over| over.value() > 0.0);
    let answer = if !(a.is_enclosed && b.is_enclosed) {
        Answer::Open
    } else if over.iter().any(|over| over.ends()[0] > 0.0) {
        Answer::Yes
    } else if over.iter().all(|over| over.ends()[1] <= 0.0) {
        Answer::No
    } else {
        Answer::Open
    };
    (by_value, answer)
}

/// The reference's pixel, with a bound that also covers the other outcome.
#[inline]
fn either(pixel: BoundedPixel, other: &BoundedPixel) -> BoundedPixel {
    let gap = |c: usize| (pixel.rgba[c].value() - other.rgba[c].value()).abs();
    let is_apart = (0..4).any(|c| gap(c) > pixel.rgba[c].error() + other.rgba[c].error());
    BoundedPixel {
        rgba: [0, 1, 2, 3].map(|c| pixel.rgba[c].joined(other.rgba[c])),
        undecided: pixel.undecided.or(other.undecided).or(is_apart.then_some(Decision::Edge)),
        is_enclosed: pixel.is_enclosed && other.is_enclosed,
        more: pixel.more.iter().zip(&other.more).map(|(own, other)| own.joined(*other)).collect(),
    }
}
