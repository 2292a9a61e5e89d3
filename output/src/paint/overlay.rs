//! Compositing of pixels over a part of a picture.

use super::beauty;
use super::canvas::Canvas;
use crate::OutputError;
use drypoint_scene::color::unpremultiply;
use drypoint_scene::picture::{Overlay, Picture};
use drypoint_scene::tables::BlendSpace;

/// Composites pixels over the layer `beauty`, in the space of `blend`. Pixels outside the picture are left out, and where
/// the overlay is transparent the picture keeps its bits.
///
/// # Errors
/// [`OutputError::Layer`] if the picture has no beauty, or one that does not fit its size.
pub fn overlay(over: &Overlay, blend: BlendSpace, picture: &mut Picture) -> Result<(), OutputError> {
    let size = [picture.width, picture.height];
    let mut canvas = Canvas::new(&mut beauty(picture)?.channels, blend);
    for (i, pixel) in over.pixels.iter().enumerate().filter(|(_, pixel)| pixel[3] > 0.0) {
        let (x, y) = (over.corner[0] + i % over.width, over.corner[1] + i / over.width);
        if x < size[0] && y < size[1] {
            canvas.put(y * size[0] + x, &canvas.ink(unpremultiply(*pixel)), 1.0);
        }
    }
    canvas.finish();
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::blank;
    use super::*;
    use drypoint_scene::color::{linear_to_srgb, srgb_to_linear};
    use drypoint_scene::marks::Page;

    #[test]
    fn pixels_lie_over_the_picture() {
        let white = blank(&Page::in_pixels([4, 3], 0.0, 127.0), Some([1.0; 4])).unwrap();
        // Opaque red, half green, nothing, and a pixel outside the picture.
        let pixels = vec![[1.0, 0.0, 0.0, 1.0], [0.0, 0.5, 0.0, 0.5], [0.0; 4], [0.0, 0.0, 0.0, 1.0]];
        let over = Overlay { corner: [2, 2], width: 2, pixels };
        let half = srgb_to_linear(0.5 * linear_to_srgb(1.0));
        for (blend, half) in [(BlendSpace::Linear, 0.5), (BlendSpace::Srgb, half)] {
            let mut picture = white.clone();
            overlay(&over, blend, &mut picture).unwrap();
            let pixel = |i: usize| [0, 1, 2, 3].map(|c| picture.layers[0].channels[c][i]);
            assert!((0..10).all(|i| pixel(i) == [1.0; 4]));
            let near = |a: [f64; 4], b: [f64; 4]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
            assert!(near(pixel(10), [1.0, 0.0, 0.0, 1.0]) && near(pixel(11), [half, 1.0, half, 1.0]), "{blend:?}");
        }
        assert!(overlay(&over, BlendSpace::Linear, &mut Picture::default()).is_err());
    }
}
