//! Toon shading: tones with hard steps, by the angle between normal and light (4.4, [HATCH-15]).

use crate::number::{Decision, Real, Vec3};
use drypoint_scene::shot::{Tone, ToonParams};

/// Tones under a light; vectors are in world space.
#[derive(Clone, Debug, PartialEq)]
pub struct Toon<R> {
    /// L: the unit vector towards the light.
    light: Vec3<R>,
    offset: R,
    /// Lower bounds of L·N + offset, ascending, and the factor of each tone. The first tone holds from −∞ on.
    tones: Vec<(R, [R; 3])>,
}

impl<R: Real> Toon<R> {
    /// Prepares the tones of a shot.
    pub fn new(toon: &ToonParams) -> Self {
        let tone = |tone: &Tone| (R::from_f64(tone.at), [0, 1, 2].map(|c| R::from_f64(tone.color[c])));
        Self {
            light: Vec3::from_glam(toon.light),
            offset: R::from_f64(toon.offset),
            tones: toon.tones.iter().map(tone).collect(),
        }
    }

    /// Shades a colour by the tone of a normal. With two tones, the second one holds where L·N + offset > ½, as in
    /// the paper.
    #[inline]
    pub fn shade(&self, c_u: [R; 3], n: Vec3<R>) -> [R; 3] {
        let x = (n.dot(self.light) + self.offset).deciding(Decision::Tone);
        let after_first = self.tones.iter().skip(1).take_while(|(at, _)| x > *at);
        match after_first.last().or(self.tones.first()) {
            Some((_, tone)) => [c_u[0] * tone[0], c_u[1] * tone[1], c_u[2] * tone[2]],
            None => c_u,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::DVec3;

    const COLOR: [f64; 3] = [0.9, 0.5, 0.1];

    fn toon<R: Real>(offset: f64, at: &[f64]) -> Toon<R> {
        // Tone i multiplies by (i + 1)/8, which changes no mantissa's length.
        let tone = |(i, &at): (usize, &f64)| Tone { at, color: [(i + 1) as f64 / 8.0, 0.25, 1.0, 1.0] };
        Toon::new(&ToonParams { light: DVec3::Z, offset, tones: at.iter().enumerate().map(tone).collect() })
    }

    /// Index of the tone of a normal with cos θ = L·N.
    fn tone<R: Real>(toon: &Toon<R>, cosine: f64) -> usize {
        let n = Vec3::from_glam(DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine));
        let [r, g, b] = toon.shade([R::ONE; 3], n).map(Real::to_f64);
        assert_eq!([g, b], [0.25, 1.0]);
        (8.0 * r) as usize - 1
    }

    /// The step is strict: x = ½ is dark, and the next larger number is not.
    #[test]
    fn two_tones_part_at_one_half() {
        for (offset, terminator) in [(0.0, 0.5), (0.5, 0.0), (0.25, 0.25), (1.0, -0.5), (-0.5, 1.0)] {
            let two = toon::<f64>(offset, &[0.0, 0.5]);
            assert_eq!(tone(&two, terminator), 0, "{offset}");
            if terminator < 1.0 {
                assert_eq!(tone(&two, terminator + f64::EPSILON), 1, "{offset}");
            }
            assert_eq!(tone(&two, -1.0), 0);
            assert_eq!(tone(&toon::<f32>(offset, &[0.0, 0.5]), terminator), 0, "{offset}");
        }
    }

    /// With n tones, the last one that begins below x holds. If none does, the first one holds, whatever its own
    /// `at`.
    #[test]
    fn tones_by_table() {
        for first in [-9.0, 0.0, -0.5] {
            let four = toon::<f64>(0.0, &[first, 0.0, 0.25, 0.75]);
            let cosines = [-1.0, -0.25, 0.0, 0.125, 0.25, 0.375, 0.75, 0.875, 1.0];
            assert_eq!(cosines.map(|c| tone(&four, c)), [0, 0, 0, 1, 1, 2, 2, 3, 3]);
        }
        let one = toon::<f64>(0.0, &[0.5]);
        assert_eq!([-1.0, 0.0, 1.0].map(|c| tone(&one, c)), [0; 3]);
    }

    #[test]
    fn tones_multiply_the_colour() {
        let two = toon::<f64>(0.0, &[0.0, 0.5]);
        let [r, g, b] = COLOR;
        assert_eq!(two.shade(COLOR, Vec3::new(0.0, 0.0, 1.0)), [r / 4.0, g / 4.0, b]);
        assert_eq!(two.shade(COLOR, Vec3::new(0.0, 0.0, -1.0)), [r / 8.0, g / 4.0, b]);
    }
}
