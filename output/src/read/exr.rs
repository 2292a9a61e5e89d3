//! Reading of EXR: every flat channel of every part, unchanged.

use super::{DEFLATE, Image, ImageLimits, check_claim};
use crate::OutputError;
use exr::meta::attribute::{IntegerBounds, SampleType};
use exr::meta::header::Header;
use exr::prelude::{Compression, FlatImage, FlatSamples, ReadChannels, ReadLayers, f16, read};
use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// Decodes the largest level of every part.
pub(super) fn decode(bytes: &[u8], path: &Path, limits: &ImageLimits) -> Result<Image, OutputError> {
    let broken = |field: &str, fault: String| OutputError::Malformed { path: path.into(), field: field.into(), fault };
    // The decoder asserts its invariants by panics. A damaged file that reaches one is an error here.
    let image = catch_unwind(AssertUnwindSafe(|| -> Result<FlatImage, OutputError> {
        let chunks = exr::block::read(Cursor::new(bytes), false).map_err(|e| broken("EXR", e.to_string()))?;
        check_headers(chunks.headers(), bytes, path, limits)?;
        read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .all_layers()
            .all_attributes()
            .non_parallel()
            .from_chunks(chunks)
            .map_err(|e| broken("EXR", e.to_string()))
    }))
    .unwrap_or_else(|_| Err(broken("EXR", "the pixels cannot be unpacked".into())))?;

    let window = image.attributes.display_window;
    let (width, height) = (window.size.width(), window.size.height());
    let mut result = Image { width, height, channels: Vec::new() };
    for (index, part) in image.layer_data.iter().enumerate() {
        let prefix = match &part.attributes.layer_name {
            Some(name) if index > 0 => format!("{name}."),
            _ => String::new(),
        };
        let placed = IntegerBounds { position: part.attributes.layer_position, size: part.size };
        for channel in &part.channel_data.list {
            let name = format!("{prefix}{}", channel.name);
            if result.channel(&name).is_some() {
                return Err(broken("channels", format!("{name} occurs twice")));
            }
            result.channels.push((name, place(&numbers(&channel.sample_data), placed, window)));
        }
    }
    Ok(result)
}

/// Refuses unsupported files and claims that the file cannot hold, before anything is allocated.
fn check_headers(headers: &[Header], bytes: &[u8], path: &Path, limits: &ImageLimits) -> Result<(), OutputError> {
    let refuse =
        |field: &str, fault: String| Err(OutputError::Malformed { path: path.into(), field: field.into(), fault });
    let mut claimed = Some(0u64);
    let mut ratio = DEFLATE;
    for header in headers {
        if header.deep {
            return refuse("type", "deep data is not supported".into());
        }
        if let Some(channel) = header.channels.list.iter().find(|c| (c.sampling.x(), c.sampling.y()) != (1, 1)) {
            return refuse("channels", format!("{} is subsampled, which is not supported", channel.name));
        }
        if matches!(header.compression, Compression::DWAA(_) | Compression::DWAB(_)) {
            // A block of 64 equal samples is one code before DEFLATE.
            ratio = 64 * DEFLATE;
        }
        let sizes = header.channels.list.iter().map(|c| if c.sample_type == SampleType::F16 { 2 } else { 4 });
        let pixel: u64 = sizes.sum();
        let window = header.shared_attributes.display_window.size;
        for size in [header.layer_size, window] {
            let area = (size.width() as u64).checked_mul(size.height() as u64);
            claimed = claimed.zip(area.and_then(|n| n.checked_mul(pixel))).and_then(|(a, b)| a.checked_add(b));
        }
    }
    // Both windows were counted, and one file fills both.
    check_claim(claimed, 2 * ratio, bytes, path)?;
    // A sample is decoded, converted to f64, and placed in the frame.
    let channels: usize = headers.iter().map(|header| header.channels.list.len()).sum();
    let sizes = headers.iter().flat_map(|h| [h.layer_size, h.shared_attributes.display_window.size]);
    let largest = sizes.max_by_key(|size| size.area()).unwrap_or_default();
    limits.check(path, [largest.width(), largest.height()], (4 + 8 + 8) * channels, 8 * channels)
}

/// Returns the samples as f64, which holds every f16, f32 and u32.
fn numbers(samples: &FlatSamples) -> Vec<f64> {
    match samples {
        FlatSamples::F16(values) => values.iter().copied().map(f16::to_f64).collect(),
        FlatSamples::F32(values) => values.iter().copied().map(f64::from).collect(),
        FlatSamples::U32(values) => values.iter().copied().map(f64::from).collect(),
    }
}

/// Moves the values of the window `data` into the frame `window`. The frame is 0 where there is no data.
fn place(values: &[f64], data: IntegerBounds, window: IntegerBounds) -> Vec<f64> {
    if data == window {
        return values.to_vec();
    }
    let (width, height) = (window.size.width(), window.size.height());
    let offset = |from: i32, to: i32| i64::from(from) - i64::from(to);
    let (dx, dy) = (offset(window.position.x(), data.position.x()), offset(window.position.y(), data.position.y()));
    let inside = |n: i64, length: usize| usize::try_from(n).ok().filter(|&n| n < length);
    let mut placed = Vec::with_capacity(width * height);
    for y in 0..height {
        let row = inside(y as i64 + dy, data.size.height());
        for x in 0..width {
            let column = inside(x as i64 + dx, data.size.width());
            placed.push(row.zip(column).map_or(0.0, |(y, x)| values[y * data.size.width() + x]));
        }
    }
    placed
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::*;

    fn write(image: &exr::image::Image<Layers<AnyChannels<FlatSamples>>>) -> Vec<u8> {
        let mut file = Cursor::new(Vec::new());
        image.write().non_parallel().to_buffered(&mut file).unwrap();
        file.into_inner()
    }

    fn part(
        name: Option<&str>,
        at: (i32, i32),
        size: (usize, usize),
        compression: Compression,
    ) -> Layer<AnyChannels<FlatSamples>> {
        let n = size.0 * size.1;
        let half = FlatSamples::F16((0..n).map(|i| f16::from_f32(i as f32 + 0.5)).collect());
        let id = FlatSamples::U32((0..n).map(|i| u32::MAX - i as u32).collect());
        let list = [AnyChannel::new("R", half), AnyChannel::new("id", id)].into_iter().collect();
        let mut attributes = LayerAttributes { layer_position: at.into(), ..Default::default() };
        attributes.layer_name = name.map(Text::from);
        let encoding = Encoding { compression, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
        Layer::new(size, attributes, encoding, AnyChannels::sort(list))
    }

    fn image(window: ((i32, i32), (usize, usize)), parts: Vec<Layer<AnyChannels<FlatSamples>>>) -> Vec<u8> {
        let (position, size) = window;
        let attributes = ImageAttributes::new(IntegerBounds { position: position.into(), size: size.into() });
        write(&exr::image::Image { attributes, layer_data: parts.into_iter().collect() })
    }

    #[test]
    fn half_and_whole_numbers_in_every_lossless_packing() {
        for compression in
            [Compression::Uncompressed, Compression::RLE, Compression::ZIP1, Compression::ZIP16, Compression::PIZ]
        {
            let file = image(((0, 0), (3, 2)), vec![part(None, (0, 0), (3, 2), compression)]);
            let image = crate::read::decode(&file, Path::new("a.exr")).unwrap();
            assert_eq!(image.channel("R").unwrap(), [0.5, 1.5, 2.5, 3.5, 4.5, 5.5]);
            assert_eq!(image.channel("id").unwrap()[1], 4_294_967_294.0);
        }
    }

    #[test]
    fn the_display_window_is_the_picture() {
        // The data lie one to the left of the window and one below its top.
        let file = image(((10, 10), (3, 2)), vec![part(None, (9, 11), (3, 2), Compression::ZIP1)]);
        let image = crate::read::decode(&file, Path::new("a.exr")).unwrap();
        assert_eq!((image.width, image.height), (3, 2));
        assert_eq!(image.channel("R").unwrap(), [0.0, 0.0, 0.0, 1.5, 2.5, 0.0]);
    }

    #[test]
    fn further_parts_bear_their_names() {
        let parts = ["beauty", "masks"].map(|name| part(Some(name), (0, 0), (2, 2), Compression::ZIP16));
        let image = crate::read::decode(&image(((0, 0), (2, 2)), parts.into()), Path::new("a.exr")).unwrap();
        assert_eq!(image.names(), ["R", "id", "masks.R", "masks.id"]);
    }

    #[test]
    fn a_header_that_lies_allocates_nothing() {
        // The windows are the only boxes of two corners; claim 2³⁰ pixels a side.
        let mut file = image(((0, 0), (3, 2)), vec![part(None, (0, 0), (3, 2), Compression::ZIP1)]);
        let corner: Vec<u8> = [0i32, 0, 2, 1].into_iter().flat_map(i32::to_le_bytes).collect();
        let places: Vec<_> = (0..file.len() - 16).filter(|&at| file[at..at + 16] == corner[..]).collect();
        assert_eq!(places.len(), 2);
        for at in places {
            file[at + 8..at + 16].copy_from_slice(&[0, 0, 0, 0x40, 0, 0, 0, 0x40]);
        }
        let error = crate::read::decode(&file, Path::new("a.exr")).unwrap_err();
        assert!(matches!(error, OutputError::TooLarge { .. } | OutputError::Malformed { .. }), "{error}");
    }
}
