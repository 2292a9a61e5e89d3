//! Lit-sphere pictures ([STF-1], [STF-12]; Bruckner and Gröller 2007, 3.1, after Sloan et al. 2001).
//!
//! A style is a square picture of a sphere under orthographic projection, lit as its maker likes. This module reads and
//! decodes it and prepares it for lookups. The lookup itself belongs to a renderer.

mod decode;
mod error;
mod lighting;
mod load;
mod mipmaps;
mod rim;
mod source;
mod theme;

pub use decode::MAX_SIDE;
pub use error::{PictureFault, StyleError};
pub use lighting::lighting_table;
pub use load::load;
pub use mipmaps::MipLevel;
pub use rim::is_inside;
pub use source::SourcePicture;
pub use theme::Theme;

use crate::color::{Rgba, premultiply, srgb_to_linear};
use decode::StraightPicture;

/// A lit sphere, ready for bilinear lookups.
#[derive(Clone, Debug, PartialEq)]
pub struct Style {
    /// The name that a scene gives it.
    pub name: String,
    /// S: the picture has S × S texels.
    pub side: usize,
    /// Texels row by row from the top, linear and premultiplied ([VAL-3]). A texel outside the inscribed disk is a copy
    /// of the inside texel with the nearest centre ([STF-1]), so a filter that straddles the rim reads only the sphere.
    pub texels: Vec<Rgba>,
}

impl Style {
    /// A style from a PNG, JPEG or OpenEXR file's bytes.
    ///
    /// Channels are divided by 2ⁿ − 1 and, unless the picture is `linear`, decoded from sRGB. gAMA, cHRM and ICC chunks
    /// are ignored ([VAL-3]). Without an alpha channel α_d = 1. OpenEXR is linear light, multiplied by α_d if there is
    /// one. Values above 1 become 1.
    ///
    /// # Errors
    /// Bytes that are no such picture, and the errors of [`Style::from_straight`].
    pub fn decode(name: &str, bytes: &[u8], linear: bool) -> Result<Self, PictureFault> {
        let StraightPicture { width, height, texels, light } = decode::straight(bytes)?;
        if width != height {
            return Err(PictureFault::NotSquare { width, height });
        }
        Self::from_straight(name, width, &texels, linear || light)
    }

    /// A style from S × S straight RGBA texels in [0, 1], row by row from the top, encoded as sRGB unless `linear`.
    /// Texels outside the inscribed disk are not read, so they may hold anything.
    ///
    /// # Errors
    /// A side of 0, or a number of texels other than S².
    pub fn from_straight(name: &str, side: usize, straight: &[Rgba], linear: bool) -> Result<Self, PictureFault> {
        if side == 0 || side.checked_mul(side) != Some(straight.len()) {
            return Err(PictureFault::Texels { side, found: straight.len() });
        }
        let mut texels = vec![[0.0; 4]; straight.len()];
        for j in 0..side {
            for i in rim::inside_of_row(side, j) {
                let [r, g, b, a] = straight[j * side + i];
                let light = if linear { [r, g, b] } else { [r, g, b].map(srgb_to_linear) };
                texels[j * side + i] = premultiply([light[0], light[1], light[2], a]);
            }
        }
        rim::extend(side, &mut texels);
        Ok(Self { name: name.into(), side, texels })
    }

    /// The texel in column i from the left and row j from the top.
    pub fn texel(&self, i: usize, j: usize) -> Rgba {
        self.texels[j * self.side + i]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_decoded_then_premultiplied() {
        // sRGB 0.5 is 0.2140411405 in linear light: ((0.5 + 0.055)/1.055)^2.4.
        let style = Style::from_straight("grey", 1, &[[0.5, 1.0, 0.0, 0.5]], false).unwrap();
        let [r, g, b, a] = style.texel(0, 0);
        assert!((r - 0.5 * 0.214_041_140_5).abs() < 1e-10);
        assert!((g - 0.5).abs() < 1e-15);
        assert_eq!((b, a), (0.0, 0.5));
        let linear = Style::from_straight("grey", 1, &[[0.5, 1.0, 0.0, 0.5]], true).unwrap();
        assert_eq!(linear.texel(0, 0), [0.25, 0.5, 0.0, 0.5]);
    }

    #[test]
    fn texels_outside_the_disk_are_never_read() {
        for side in [4, 5, 16, 31] {
            let paint = |outside: f64| -> Vec<Rgba> {
                let texel = |t: usize| {
                    let (i, j) = (t % side, t / side);
                    if is_inside(side, i, j) {
                        [i as f64 / side as f64, 0.25, j as f64 / side as f64, 0.75]
                    } else {
                        [outside; 4]
                    }
                };
                (0..side * side).map(texel).collect()
            };
            let style = Style::from_straight("s", side, &paint(f64::NAN), false).unwrap();
            assert_eq!(style, Style::from_straight("s", side, &paint(0.0), false).unwrap(), "{side}");
            assert!(style.texels.iter().flatten().all(|c| c.is_finite()), "{side}");
        }
    }

    #[test]
    fn a_wrong_number_of_texels_is_refused() {
        for (side, found) in [(0, 0), (2, 3), (usize::MAX, 1)] {
            let texels = vec![[0.0; 4]; found];
            assert_eq!(Style::from_straight("s", side, &texels, false), Err(PictureFault::Texels { side, found }));
        }
    }
}
