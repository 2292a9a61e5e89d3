//! Pictures of intersection transfer functions ([VS-4]).

use super::read_image;
use crate::OutputError;
use drypoint_scene::color::unpremultiply;
use drypoint_scene::intersection_picture::IntersectionPicture;
use std::path::Path;

/// Reads a picture as straight linear colours.
///
/// # Errors
/// Same errors as [`read_image`]; [`OutputError::NoColor`]; [`OutputError::Malformed`] for a value that is not finite.
pub fn read_intersection_picture(path: &Path) -> Result<IntersectionPicture, OutputError> {
    let image = read_image(path)?;
    let no_color = || OutputError::NoColor { name: path.display().to_string(), found: image.names() };
    let colors = image.colors().filter(|_| image.width > 0 && image.height > 0).ok_or_else(no_color)?;
    let pixel = |i: usize| {
        let [r, g, b] = colors.rgb.map(|channel| channel[i]);
        unpremultiply([r, g, b, colors.alpha.map_or(1.0, |alpha| alpha[i])])
    };
    let pixels: Vec<[f64; 4]> = (0..image.width * image.height).map(pixel).collect();
    if pixels.iter().flatten().any(|c| !c.is_finite()) {
        let fault = "it has values that are not finite".into();
        return Err(OutputError::Malformed { path: path.into(), field: "color".into(), fault });
    }
    Ok(IntersectionPicture { size: [image.width, image.height], pixels, has_opacity: colors.alpha.is_some() })
}
