//! Contact sheets: pictures side by side on white, each with its label. Figures: pictures at given places of one picture.

mod canvas;
mod scaled;

use crate::OutputError;
use crate::layers::room;
use crate::raster::coverage;
use crate::read::Image;
use crate::text::{CAP_HEIGHT, DESCENT, WEIGHT, fit, strokes, width};
use canvas::Canvas;
use drypoint_scene::color::{Rgba, srgb_to_linear};
use drypoint_scene::picture::Picture;
use scaled::scaled;

/// Layout of a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Pictures in a row; none: enough to make the sheet about as wide as high.
    pub columns: Option<usize>,
    /// Largest width and height of a picture, 16 to 4096 pixels.
    pub cell: usize,
}

impl Default for Layout {
    fn default() -> Self {
        Self { columns: None, cell: 256 }
    }
}

/// Largest sheet, in pixels: two gibibytes of channels.
const LARGEST: usize = 1 << 26;

/// Bytes of memory a pixel of a sheet until it is written: light, channels and codes.
const PIXEL: usize = 2 * 4 * 8 + 4;

/// sRGB code of the labels' ink.
const INK: f64 = 0.1;

/// Lays out labelled pictures in rows on white. Each picture is scaled to fit its cell and centred in the cell, with
/// its label below. Scaling takes the mean over each new pixel's area, in linear premultiplied light. The sheet's only
/// layer is an opaque `beauty`.
///
/// # Errors
/// [`OutputError::Sheet`] for no pictures, an empty one, or a sheet that is too large; [`OutputError::NoColor`] with
/// the label.
pub fn sheet(pictures: &[(String, Image)], layout: Layout) -> Result<Picture, OutputError> {
    // Rows, columns and the size of each picture in its cell.
    let fault = |fault: String| OutputError::Sheet { fault };
    if pictures.is_empty() {
        return Err(fault("there are no pictures".into()));
    }
    let cell = layout.cell;
    if !(16..=4096).contains(&cell) {
        return Err(fault(format!("a cell of {cell} pixels")));
    }
    let root = (1..).find(|n| n * n >= pictures.len()).unwrap_or(1);
    let columns = layout.columns.unwrap_or(root).clamp(1, pictures.len());
    let sizes = pictures
        .iter()
        .map(|(label, image)| fitted(image, cell).ok_or_else(|| fault(format!("{label} has no pixels"))))
        .collect::<Result<Vec<_>, _>>()?;

    // Sizes are proportional to the cell, but letters stay readable.
    let margin = (cell / 16).max(8);
    let cap = (cell / 26).max(9);
    let rows: Vec<usize> = sizes.chunks(columns).map(|row| row.iter().map(|s| s[1]).max().unwrap_or(0)).collect();
    let label_height = 2 * cap + cap / 2;
    let total_width = margin + columns * (cell + margin);
    let total_height = margin + rows.iter().map(|height| height + label_height + margin).sum::<usize>();
    if total_width.saturating_mul(total_height) > LARGEST {
        return Err(fault(format!("{total_width}x{total_height} pixels are more than {LARGEST}")));
    }

    room(None, [total_width, total_height], PIXEL)?;
    // Row by row: pictures centred in their cells, labels below.
    let mut canvas = Canvas::new([total_width, total_height], [1.0; 4]);
    let mut top = margin;
    for ((pictures, sizes), height) in pictures.chunks(columns).zip(sizes.chunks(columns)).zip(rows) {
        for (column, ((label, image), &[w, h])) in pictures.iter().zip(sizes).enumerate() {
            let left = margin + column * (cell + margin);
            let pixels = scaled(image, w, h)
                .ok_or_else(|| OutputError::NoColor { name: label.clone(), found: image.names() })?;
            canvas.lay(&pixels, w, [left + (cell - w) / 2, top + (height - h) / 2]);
            write(&mut canvas, label, [left, top + height], [cell, label_height], cap);
        }
        top += height + label_height + margin;
    }
    Ok(canvas.into_picture())
}

/// Returns the largest size of the image's proportions within a square cell.
fn fitted(image: &Image, cell: usize) -> Option<[usize; 2]> {
    let (w, h) = (image.width, image.height);
    let longer = w.max(h);
    let side = |n: usize| ((n as f64 * cell as f64 / longer as f64).round() as usize).max(1);
    (w.min(h) > 0).then(|| [side(w), side(h)])
}

/// A picture at a place of a figure, in whole pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedPicture {
    /// Left and upper end.
    pub corner: [usize; 2],
    /// Width and height to which it is scaled.
    pub size: [usize; 2],
    /// The picture.
    pub image: Image,
}

/// Lays pictures over each other on a background, which is linear and straight. Each is scaled to its size, and clipped
/// to the picture that is made. Its only layer is `beauty`.
///
/// # Errors
/// [`OutputError::NoColor`] for a picture without colours, and no memory for the pixels.
pub fn lay_out(size: [usize; 2], background: Rgba, pictures: &[PlacedPicture]) -> Result<Picture, OutputError> {
    room(None, size, PIXEL)?;
    let mut canvas = Canvas::new(size, background);
    for (i, PlacedPicture { corner, size, image }) in pictures.iter().enumerate() {
        let pixels = scaled(image, size[0], size[1]);
        let pixels =
            pixels.ok_or_else(|| OutputError::NoColor { name: format!("picture {i}"), found: image.names() })?;
        canvas.lay(&pixels, size[0], *corner);
    }
    Ok(canvas.into_picture())
}

/// Writes a line of text, centred in a box below `corner`, with capitals `cap` pixels high.
fn write(canvas: &mut Canvas, text: &str, corner: [usize; 2], size: [usize; 2], cap: usize) {
    let scale = cap as f64 / CAP_HEIGHT;
    let text = fit(text, size[0] as f64 / scale - WEIGHT);
    let left = (0.5 * (size[0] as f64 - width(&text) * scale)).round();
    // The space above the capitals equals that below the descenders. Whole pixels keep level strokes sharp.
    let baseline = (0.5 * (size[1] as f64 + (CAP_HEIGHT - DESCENT) * scale)).round();
    let lines: Vec<Vec<[f64; 2]>> = strokes(&text)
        .into_iter()
        .map(|line| line.into_iter().map(|[x, y]| [left + x * scale, baseline - y * scale]).collect())
        .collect();
    let ink = srgb_to_linear(INK);
    let pixels: Vec<[f64; 4]> = coverage(size[0], size[1], &lines, WEIGHT * scale)
        .into_iter()
        .map(|a| [a * ink, a * ink, a * ink, a])
        .collect();
    canvas.lay(&pixels, size[0], corner);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: usize, height: usize, value: impl Fn(usize, usize) -> f64, alpha: f64) -> Image {
        let plane: Vec<f64> = (0..width * height).map(|i| value(i % width, i / width)).collect();
        let opacity = vec![alpha; plane.len()];
        let channels = [("R", &plane), ("G", &plane), ("B", &plane), ("A", &opacity)];
        Image { width, height, channels: channels.map(|(n, v)| (n.to_string(), v.clone())).into() }
    }

    #[test]
    fn pictures_keep_their_shape_and_their_pixels() {
        let wide = image(64, 32, |x, _| if x < 32 { 0.25 } else { 0.0 }, 0.5);
        let layout = Layout { columns: Some(2), cell: 64 };
        let found = sheet(&[("a".into(), wide.clone()), ("b".into(), image(10, 10, |_, _| 0.5, 1.0))], layout).unwrap();
        // Margins of 8; letters of 9 px in 22 px; the second picture, scaled up, is 64 high.
        assert_eq!((found.width, found.height), (8 + 2 * 72, 8 + 64 + 22 + 8));
        let red = &found.layers[0].channels[0];
        let at = |x: usize, y: usize| red[y * found.width + x];
        // The wide one is in the middle of its row: half covered, on white.
        assert_eq!((at(8, 24), at(71, 24), at(8, 23)), (0.75, 0.5, 1.0));
        assert_eq!((at(80, 8), at(143, 71), at(144, 71), at(79, 8)), (0.5, 0.5, 1.0, 1.0));
        assert!(found.layers[0].channels[3].iter().all(|&a| a == 1.0));
    }

    #[test]
    fn labels_stand_below_and_inside() {
        let blank = image(4, 4, |_, _| 1.0, 1.0);
        let long = "a_label_much_too_long_for_its_cell.nii.gz".to_string();
        let found = sheet(&[(long, blank)], Layout { columns: None, cell: 64 }).unwrap();
        let dark: Vec<[usize; 2]> = (0..found.width * found.height)
            .filter(|&i| found.layers[0].channels[0][i] < 0.9)
            .map(|i| [i % found.width, i / found.width])
            .collect();
        assert!(dark.len() > 100);
        assert!(dark.iter().all(|[x, y]| (8..72).contains(x) && (72..94).contains(y)));
    }

    #[test]
    fn rows_are_filled_in_order() {
        let one = || ("x".to_string(), image(2, 2, |_, _| 0.5, 1.0));
        let size = |n: usize, columns| {
            let pictures: Vec<_> = (0..n).map(|_| one()).collect();
            let found = sheet(&pictures, Layout { columns, cell: 32 }).unwrap();
            [(found.width - 8) / 40, (found.height - 8) / 62]
        };
        assert_eq!(size(1, None), [1, 1]);
        assert_eq!(size(5, None), [3, 2]);
        assert_eq!(size(4, Some(4)), [4, 1]);
        assert_eq!(size(2, Some(9)), [2, 1]);
    }

    #[test]
    fn bad_use_is_an_error() {
        let one = ("x".to_string(), image(2, 2, |_, _| 0.5, 1.0));
        assert!(sheet(&[], Layout::default()).is_err());
        assert!(sheet(std::slice::from_ref(&one), Layout { columns: None, cell: 0 }).is_err());
        let empty = ("none".to_string(), Image::default());
        assert_eq!(sheet(&[empty], Layout::default()).unwrap_err().to_string(), "sheet: none has no pixels");
        let depth = Image { width: 1, height: 1, channels: vec![("Z".into(), vec![1.0])] };
        let error = sheet(&[("depth".into(), depth)], Layout::default()).unwrap_err();
        assert_eq!(error.to_string(), "depth: has no channels R, G and B; it has Z");
        let many = vec![one; 9];
        assert!(matches!(sheet(&many, Layout { columns: None, cell: 4096 }), Err(OutputError::Sheet { .. })));
    }
}
