//! Checks of layers against their picture, before anything is written.

use crate::OutputError;
use drypoint_scene::memory;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use std::path::Path;

/// Returns the layer of a kind, if the picture has it and it fits.
pub(crate) fn fitting(picture: &Picture, kind: LayerKind) -> Result<&Layer, OutputError> {
    let layer = picture.layer(kind).ok_or_else(|| fault(kind, "the picture does not have it".into()))?;
    check(picture, layer)?;
    Ok(layer)
}

/// Checks that the picture has pixels, and that the layer has its kind's channels with one number a pixel each.
pub(crate) fn check(picture: &Picture, layer: &Layer) -> Result<(), OutputError> {
    let (width, height, names) = (picture.width, picture.height, layer.kind.channels());
    let pixels = width.checked_mul(height).filter(|&n| n > 0);
    let lengths: Vec<usize> = layer.channels.iter().map(Vec::len).collect();
    if lengths.len() == names.len() && lengths.iter().all(|&n| Some(n) == pixels) {
        Ok(())
    } else {
        Err(fault(layer.kind, format!("channels of {lengths:?} numbers for {names:?} of {width}x{height} pixels")))
    }
}

/// Returns a side as u32, in the range 1 … 2³¹ − 1 that PNG and EXR share.
pub(crate) fn side(pixels: usize, kind: LayerKind) -> Result<u32, OutputError> {
    match u32::try_from(pixels) {
        Ok(n) if n > 0 && n < 1 << 31 => Ok(n),
        _ => Err(fault(kind, format!("a side of {pixels} pixels"))),
    }
}

/// Asks the memory budget for a picture of `each` bytes a pixel. `path` is the file that it comes from, if any.
pub(crate) fn room(path: Option<&Path>, size: [usize; 2], each: usize) -> Result<(), OutputError> {
    let bytes = size.into_iter().chain([each]).fold(1u64, |product, n| product.saturating_mul(n as u64));
    memory::room(bytes).map_err(|no_room| OutputError::NoRoom { path: path.map(Into::into), size, no_room })
}

/// Returns the error of a layer.
pub(crate) fn fault(kind: LayerKind, fault: String) -> OutputError {
    OutputError::Layer { layer: kind.name().into_owned(), fault }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_fit_is_refused() {
        let layer = |n: usize| Layer { kind: LayerKind::Z, channels: vec![vec![0.0; n]] };
        let picture = |width, layers| Picture { width, height: 2, layers };
        assert!(fitting(&picture(3, vec![layer(6)]), LayerKind::Z).is_ok());
        for (width, layers) in [(3, vec![layer(5)]), (0, vec![layer(0)]), (3, vec![]), (usize::MAX, vec![layer(6)])] {
            assert!(fitting(&picture(width, layers), LayerKind::Z).is_err());
        }
        let beauty = Layer { kind: LayerKind::Beauty, channels: vec![vec![0.0; 6]; 3] };
        assert!(fitting(&picture(3, vec![beauty]), LayerKind::Beauty).is_err());
    }
}
