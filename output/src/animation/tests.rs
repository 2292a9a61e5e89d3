//! Animations read back.

use super::apng::ApngAnimation;
use super::gif::GifAnimation;
use crate::OutputError;
use crate::png::{KEYWORDS, encode_png};
use drypoint_scene::picture::{Layer, LayerKind, Picture, Provenance};
use std::io::Cursor;
use std::path::Path;

const SIZE: [usize; 2] = [7, 5];

/// A picture of linear premultiplied pixels; frames have other colours.
fn picture(frame: usize, pixel: impl Fn(usize) -> [f64; 4]) -> Picture {
    let [width, height] = SIZE;
    let channels = (0..4).map(|c| (0..width * height).map(|i| pixel(i + 40 * frame)[c]).collect()).collect();
    Picture { width, height, layers: vec![Layer { kind: LayerKind::Beauty, channels }] }
}

/// A colour and an opacity that differ from pixel to pixel.
fn veil(i: usize) -> [f64; 4] {
    let a = (i % 11) as f64 / 10.0;
    [0.9 * a, a * (i % 5) as f64 / 4.0, a * (i % 3) as f64 / 2.0, a]
}

fn opaque(i: usize) -> [f64; 4] {
    [(i % 7) as f64 / 6.0, (i % 5) as f64 / 4.0, (i % 3) as f64 / 2.0, 1.0]
}

fn provenance() -> Provenance {
    Provenance { software: "Drypoint 0.1.0".into(), scene_hash: "00ff".into(), plan: "κ along v".into() }
}

fn apng(bits: u8, fps: usize, frames: &[Picture]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let (count, path) = ([frames.len(), fps], Path::new("a.apng"));
    let mut animation = ApngAnimation::new(&mut bytes, SIZE, bits, count, &provenance(), path).unwrap();
    frames.iter().for_each(|frame| animation.frame(frame).unwrap());
    animation.finish().unwrap();
    bytes
}

fn gif(fps: usize, frames: &[Picture]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut animation = GifAnimation::new(&mut bytes, SIZE, fps, &provenance(), Path::new("a.gif")).unwrap();
    frames.iter().for_each(|frame| animation.frame(frame).unwrap());
    animation.finish().unwrap();
    bytes
}

/// The codes of a PNG, which are the first frame of an animated one.
fn png_codes(bytes: &[u8]) -> Vec<u8> {
    let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
    let mut data = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut data).unwrap();
    data
}

/// Frames of a GIF: delay, and RGBA codes.
fn gif_frames(bytes: &[u8]) -> Vec<(u16, Vec<u8>)> {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(bytes).unwrap();
    let mut frames = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        assert_eq!([frame.width, frame.height].map(usize::from), SIZE);
        frames.push((frame.delay, frame.buffer.to_vec()));
    }
    frames
}

#[test]
fn frames_of_an_apng_are_their_pngs() {
    for bits in [8, 16] {
        let frames: Vec<Picture> = (0..3).map(|i| picture(i, veil)).collect();
        let bytes = apng(bits, 12, &frames);
        let mut reader = png::Decoder::new(Cursor::new(&bytes)).read_info().unwrap();
        let control = reader.info().animation_control.unwrap();
        assert_eq!((control.num_frames, control.num_plays), (3, 0));
        let texts: Vec<_> = reader.info().utf8_text.iter().map(|chunk| chunk.get_text().unwrap()).collect();
        assert_eq!(texts, ["Drypoint 0.1.0", "00ff", "κ along v"]);
        assert_eq!(reader.info().utf8_text[1].keyword, KEYWORDS[1]);
        for frame in &frames {
            let mut data = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut data).unwrap();
            let control = reader.info().frame_control.unwrap();
            assert_eq!((control.delay_num, control.delay_den), (1, 12));
            assert_eq!(data, png_codes(&encode_png(frame, bits, &provenance()).unwrap()));
        }
    }
}

/// A frame of at most 255 colours loses none, and each frame has a palette of its own.
#[test]
fn a_gif_of_few_colours_is_exact() {
    let frames: Vec<Picture> = (0..3).map(|i| picture(i, opaque)).collect();
    let read = gif_frames(&gif(20, &frames));
    assert_eq!(read.len(), 3);
    for ((delay, codes), frame) in read.iter().zip(&frames) {
        assert_eq!(*delay, 5);
        assert_eq!(*codes, png_codes(&encode_png(frame, 8, &provenance()).unwrap()));
    }
    assert_ne!(read[0].1, read[1].1);
}

/// α is below ½ or not: nothing between.
#[test]
fn a_gif_is_transparent_or_not() {
    let frame = picture(0, veil);
    let codes = &gif_frames(&gif(10, std::slice::from_ref(&frame)))[0].1;
    let whole = png_codes(&encode_png(&frame, 8, &provenance()).unwrap());
    for (found, wanted) in codes.chunks(4).zip(whole.chunks(4)) {
        let expected = if wanted[3] < 128 { [0; 4] } else { [wanted[0], wanted[1], wanted[2], 255] };
        // The colour of a hole is nobody's.
        assert_eq!(found[3], expected[3]);
        assert!(expected[3] == 0 || found == expected, "{found:?} {expected:?}");
    }
    assert!(codes.chunks(4).any(|pixel| pixel[3] == 0) && codes.chunks(4).any(|pixel| pixel[3] == 255));
}

/// 30 frames a second are 3⅓ hundredths each; n of them take 100·n/30, rounded once.
#[test]
fn the_time_of_many_frames_is_right() {
    let frames: Vec<Picture> = (0..30).map(|i| picture(i, opaque)).collect();
    let delays: Vec<u16> = gif_frames(&gif(30, &frames)).iter().map(|(delay, _)| *delay).collect();
    assert_eq!(delays[..6], [3, 4, 3, 3, 4, 3]);
    assert_eq!(delays.iter().sum::<u16>(), 100);
}

#[test]
fn both_begin_again_and_say_where_they_come_from() {
    let bytes = gif(10, &[picture(0, opaque)]);
    let has = |part: &[u8]| bytes.windows(part.len()).any(|window| window == part);
    // The application block says 0 repetitions, which is endless.
    assert!(has(b"NETSCAPE2.0\x03\x01\x00\x00") && has(b"Drypoint 0.1.0, scene 00ff"));
    assert_eq!(bytes, gif(10, &[picture(0, opaque)]), "the same bytes every time");
}

#[test]
fn bad_requests_are_errors() {
    let (path, from) = (Path::new("a"), provenance());
    let is_layer = |error: OutputError| matches!(error, OutputError::Layer { .. });
    for size in [[0, 5], [65536, 1]] {
        assert!(is_layer(GifAnimation::new(Vec::new(), size, 10, &from, path).err().unwrap()));
    }
    assert!(is_layer(ApngAnimation::new(Vec::new(), SIZE, 8, [0, 10], &from, path).err().unwrap()));
    let bits = ApngAnimation::new(Vec::new(), SIZE, 12, [1, 10], &from, path).err().unwrap();
    assert!(matches!(bits, OutputError::Bits { bits: 12 }));
    let wide = Picture { width: 8, ..picture(0, opaque) };
    assert!(is_layer(GifAnimation::new(Vec::new(), SIZE, 10, &from, path).unwrap().frame(&wide).unwrap_err()));
    let mut two = ApngAnimation::new(Vec::new(), SIZE, 8, [2, 10], &from, path).unwrap();
    assert!(is_layer(two.frame(&wide).unwrap_err()));
    two.frame(&picture(0, opaque)).unwrap();
    assert!(is_layer(two.finish().unwrap_err()), "a frame is missing");
}
