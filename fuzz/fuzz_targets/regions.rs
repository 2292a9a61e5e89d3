//! Regions of a picture that a style is taken from. The first byte chooses the shape, the second the picture; the rest is
//! numbers of two bytes in tenths of a pixel.

#![no_main]

use drypoint_fuzz::{check_error, start};
use drypoint_reference::style_transfer_functions::extract::{Region, extract};
use drypoint_scene::style::SourcePicture;
use libfuzzer_sys::fuzz_target;

fuzz_target!(init: start(), |data: &[u8]| {
    let [shape, picture, rest @ ..] = data else { return };
    let numbers: Vec<f64> = rest.chunks_exact(2).map(|pair| f64::from(i16::from_le_bytes([pair[0], pair[1]])) / 10.0).collect();
    let depth = (shape / 3 % 2 == 1).then_some(5.0);
    let region = match (shape % 3, numbers.as_slice()) {
        (0, &[x, y, r, ..]) => Region::Circle { x, y, r },
        (1, &[x, y, a, b, angle, ..]) => Region::Ellipse { x, y, a, b, angle, depth },
        (2, numbers) => Region::Outline { points: numbers.as_chunks().0.to_vec(), depth },
        _ => return,
    };
    let [width, height] = [1 + usize::from(picture % 16), 1 + usize::from(picture / 16)];
    let pixels = (0..width * height).map(|i| [0.1, 0.9, (i % 7) as f64 / 7.0, (i % 3) as f64 / 2.0]).collect();
    let source = SourcePicture::from_straight(width, height, pixels, false).expect("a picture with pixels");
    match extract(&source, &region, 8) {
        Ok(found) => {
            let mut values = found.picture.layers.iter().flat_map(|layer| &layer.channels).flatten();
            assert!(values.all(|value| (-1e-9..=1.0 + 1e-9).contains(value)), "{found:?}");
            assert!((0.0..=1.0).contains(&found.shown));
        }
        Err(error) => check_error([error.to_string(), "a region".into(), error.help().into()]),
    }
});
