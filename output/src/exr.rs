//! Writing EXR ([IO-6]).

use crate::layers::{check, fault, side};
use crate::{OutputError, atomic};
use drypoint_scene::picture::{LayerKind, Picture, Provenance};
use exr::meta::attribute::AttributeValue;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes, LineOrder,
    SmallVec, Text, WritableImage,
};
use std::io::Cursor;
use std::path::Path;

/// Names of the text attributes: program with version, hash of the scene, plan.
pub const ATTRIBUTES: [&str; 3] = ["software", "drypointScene", "drypointPlan"];

/// Writes every layer of the picture as one part: 32-bit float, ZIP in blocks of 16 lines. Channels are named as
/// [`LayerKind::channels`]; values are linear and premultiplied, row 0 at the top.
///
/// Text attributes (UTF-8) carry the provenance. There is no date: equal pictures give equal bytes. A channel that two
/// layers share (`curvature.KV`) is written once. The file appears whole or not at all.
///
/// # Errors
/// [`OutputError::Layer`] when the picture has no layer or one that does not fit its size, [`OutputError::Io`].
pub fn write_exr(picture: &Picture, provenance: &Provenance, path: &Path) -> Result<(), OutputError> {
    atomic::write(path, &encode_exr(picture, provenance)?)
}

/// Returns the bytes of [`write_exr`].
///
/// # Errors
/// Same errors as [`write_exr`], except those of the file.
pub fn encode_exr(picture: &Picture, provenance: &Provenance) -> Result<Vec<u8>, OutputError> {
    // Every channel once, as 32-bit floats.
    let mut channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = SmallVec::new();
    for layer in &picture.layers {
        check(picture, layer)?;
        for (name, values) in layer.kind.channels().iter().zip(&layer.channels) {
            let name = Text::new_or_panic(name);
            if channels.iter().all(|channel| channel.name != name) {
                let samples = values.iter().map(|&v| v as f32).collect();
                channels.push(AnyChannel::new(name, FlatSamples::F32(samples)));
            }
        }
    }
    if channels.is_empty() {
        return Err(fault(LayerKind::Beauty, "the picture has no layer at all".into()));
    }
    for n in [picture.width, picture.height] {
        side(n, LayerKind::Beauty)?;
    }

    // Each of the two maps of further attributes gets one entry: they are hash maps, whose order differs from run to
    // run.
    let mut attributes = LayerAttributes { software_name: Some(utf8(&provenance.software)), ..Default::default() };
    attributes.other.insert(utf8(ATTRIBUTES[1]), AttributeValue::Text(utf8(&provenance.scene_hash)));
    let encoding =
        Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let layer = Layer::new((picture.width, picture.height), attributes, encoding, AnyChannels::sort(channels));
    let mut image = Image::from_layer(layer);
    image.attributes.other.insert(utf8(ATTRIBUTES[2]), AttributeValue::Text(utf8(&provenance.plan)));

    let mut file = Cursor::new(Vec::new());
    image.write().non_parallel().to_buffered(&mut file).map_err(|error| fault(LayerKind::Beauty, error.to_string()))?;
    Ok(file.into_inner())
}

/// Returns a text attribute as UTF-8, which the format requires. The crate's own conversion knows Latin-1 only.
fn utf8(text: &str) -> Text {
    Text::from_slice_unchecked(text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::read_image;
    use drypoint_scene::picture::Layer;
    use exr::meta::MetaData;

    /// Every layer, with numbers that f32 does not hold exactly, signs, zeros, huge, tiny and infinite ones.
    fn picture(width: usize, height: usize) -> Picture {
        let special = [0.0, -0.0, f64::INFINITY, 1e300, -1e300, 1e-300, 1e-42, 16_777_217.0];
        let mut n = 0u32;
        let mut value = || {
            n += 1;
            let n = n as usize;
            if n.is_multiple_of(5) { special[n / 5 % special.len()] } else { (n as f64).sqrt() - 7.3 }
        };
        let layers = LayerKind::ALL
            .into_iter()
            .filter(|kind| ![LayerKind::CurvatureAlongView, LayerKind::FirstCurvatureAlongView].contains(kind))
            .map(|kind| Layer {
                kind,
                channels: kind.channels().iter().map(|_| (0..width * height).map(|_| value()).collect()).collect(),
            })
            .collect();
        Picture { width, height, layers }
    }

    fn provenance() -> Provenance {
        Provenance { software: "Drypoint 0.1.0".into(), scene_hash: "00ff".into(), plan: "κ: [contours]\n".into() }
    }

    #[test]
    fn every_layer_comes_back_bit_for_bit_as_f32() {
        // 37 rows are two whole blocks of 16 lines and a part of one.
        let picture = picture(13, 37);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        write_exr(&picture, &provenance(), &path).unwrap();
        let image = read_image(&path).unwrap();
        assert_eq!((image.width, image.height), (13, 37));
        let mut count = 0;
        for layer in &picture.layers {
            for (name, values) in layer.kind.channels().iter().zip(&layer.channels) {
                let found = image.channel(name).unwrap();
                let bits = |v: &f64| (*v as f32).to_bits();
                assert!(found.iter().map(bits).eq(values.iter().map(bits)), "{name}");
                count += 1;
            }
        }
        assert_eq!(image.channels.len(), count);
    }

    #[test]
    fn one_part_zip_float_and_provenance() {
        let bytes = encode_exr(&picture(4, 4), &provenance()).unwrap();
        let meta = MetaData::read_from_buffered(bytes.as_slice(), true).unwrap();
        let [header] = meta.headers.as_slice() else { panic!("{} parts", meta.headers.len()) };
        assert_eq!(header.compression, Compression::ZIP16);
        assert_eq!(header.blocks, exr::meta::BlockDescription::ScanLines);
        let names: Vec<_> = header.channels.list.iter().map(|c| c.name.to_string()).collect();
        assert!(names.is_sorted());
        for name in ["R", "G", "B", "A", "Z", "normal.X", "gradient.Y", "curvature.K1", "first.VALUE"] {
            assert!(names.iter().any(|n| n == name), "{name} is not in {names:?}");
        }
        assert!(header.channels.list.iter().all(|c| c.sample_type == exr::meta::attribute::SampleType::F32));
        let own = &header.own_attributes;
        assert_eq!(own.software_name.as_ref().unwrap().as_slice(), b"Drypoint 0.1.0");
        assert_eq!(own.capture_date, None);
        let text = |v: Option<&AttributeValue>| match v {
            Some(AttributeValue::Text(text)) => String::from_utf8(text.as_slice().to_vec()).unwrap(),
            other => panic!("{other:?}"),
        };
        assert_eq!(text(own.other.get(ATTRIBUTES[1].as_bytes())), "00ff");
        assert_eq!(text(own.other.get(ATTRIBUTES[2].as_bytes())), "κ: [contours]\n");
    }

    #[test]
    fn same_picture_same_bytes() {
        let first = encode_exr(&picture(5, 3), &provenance()).unwrap();
        for _ in 0..16 {
            assert_eq!(encode_exr(&picture(5, 3), &provenance()).unwrap(), first);
        }
    }

    #[test]
    fn a_shared_channel_is_written_once() {
        let mut both = picture(2, 2);
        both.layers.push(Layer { kind: LayerKind::CurvatureAlongView, channels: vec![vec![9.0; 4]] });
        assert_eq!(encode_exr(&both, &provenance()).unwrap(), encode_exr(&picture(2, 2), &provenance()).unwrap());
    }

    #[test]
    fn an_empty_picture_is_an_error() {
        let empty = Picture { width: 2, height: 2, layers: vec![] };
        assert!(matches!(encode_exr(&empty, &provenance()), Err(OutputError::Layer { .. })));
    }
}
