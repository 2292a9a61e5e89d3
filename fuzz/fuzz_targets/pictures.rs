//! Pictures: as they are read to be compared or put behind a volume, as styles, and as the source of a style.

#![no_main]

use drypoint_fuzz::{check_error, start};
use drypoint_output::read::{decode, stretch};
use drypoint_scene::style::{SourcePicture, Style};
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(init: start(), |data: &[u8]| {
    match decode(data, Path::new("a.png")) {
        Ok(image) => {
            let pixels = image.width * image.height;
            assert!(image.channels.iter().all(|(_, values)| values.len() == pixels));
            assert!(stretch(&image, 5, 3).is_none_or(|pixels| pixels.len() == 15));
        }
        Err(error) => check_error([error.to_string(), "a.png".into(), error.help().into()]),
    }
    match Style::decode("style", data, false) {
        Ok(style) => {
            assert_eq!(style.texels.len(), style.side * style.side);
            assert!(style.texels.iter().flatten().all(|value| (0.0..=1.0).contains(value)));
        }
        Err(fault) => check_error([fault.to_string(), "a.png".into(), fault.help().into()]),
    }
    match SourcePicture::decode(data, false) {
        Ok(source) => {
            let last = source.pixel(source.width() - 1, source.height() - 1);
            assert!(last.iter().all(|value| (0.0..=1.0).contains(value)));
        }
        Err(fault) => check_error([fault.to_string(), "a.png".into(), fault.help().into()]),
    }
});
