//! Lighting tables read from pictures ([VS-5]).

use super::PictureFault;
use super::decode::{StraightPicture, straight};
use crate::lighting::LightingTable;

/// The lighting table of a picture of 8 or 16 bits: red, green, blue and alpha are s_a, s_d, s_s and s_α, each divided
/// by 2ⁿ − 1, with no other change. Without an alpha channel s_α = 1.
///
/// # Errors
/// Bytes that are no such picture, and sides above 4096.
pub fn lighting_table(bytes: &[u8]) -> Result<LightingTable, PictureFault> {
    let StraightPicture { width, height, texels, light } = straight(bytes)?;
    if light {
        return Err(PictureFault::FloatingPoint);
    }
    let found = texels.len();
    LightingTable::new(width, height, texels).ok_or(PictureFault::Pixels { width, height, found })
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{DynamicImage, ImageBuffer, ImageFormat, Rgb, RgbImage, Rgba, Rgba32FImage, RgbaImage};
    use std::io::Cursor;

    fn file(picture: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        picture.into().write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    }

    /// Neither decoded from sRGB nor premultiplied: a cell of s_α = 0 keeps its light.
    #[test]
    fn cells_are_codes_over_the_largest_code() {
        let eight = RgbaImage::from_fn(3, 2, |i, j| Rgba([i as u8 * 100, 51, 255, j as u8 * 255]));
        let table = lighting_table(&file(eight, ImageFormat::Png)).unwrap();
        assert_eq!((table.width(), table.height()), (3, 2));
        assert_eq!(table.cells()[1], [100.0 / 255.0, 0.2, 1.0, 0.0]);
        assert_eq!(table.cells()[5], [200.0 / 255.0, 0.2, 1.0, 1.0]);
        let sixteen: ImageBuffer<Rgba<u16>, Vec<u16>> =
            ImageBuffer::from_fn(1, 2, |_, j| Rgba([13107, 0, j as u16, 65535]));
        let table = lighting_table(&file(sixteen, ImageFormat::Png)).unwrap();
        assert_eq!(table.cells(), [[0.2, 0.0, 0.0, 1.0], [0.2, 0.0, 1.0 / 65535.0, 1.0]]);
    }

    #[test]
    fn without_alpha_opacities_stay() {
        let table = lighting_table(&file(RgbImage::from_pixel(2, 2, Rgb([0, 51, 255])), ImageFormat::Png)).unwrap();
        assert_eq!(table.cells(), [[0.0, 0.2, 1.0, 1.0]; 4]);
    }

    #[test]
    fn floating_point_is_refused() {
        let light = Rgba32FImage::from_pixel(2, 2, Rgba([0.5; 4]));
        assert_eq!(lighting_table(&file(light, ImageFormat::OpenExr)), Err(PictureFault::FloatingPoint));
        assert!(matches!(lighting_table(b"P6"), Err(PictureFault::Unreadable { .. })));
    }
}
