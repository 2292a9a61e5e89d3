//! Writing of SVG ([IO-2], [IO-7]). One user unit is a millimetre. Layers are top-level groups that Inkscape and
//! plotters know by their labels. Nothing has a transform.

use super::curves::PathSegment;
use super::decimals::{number, push_pair};
use super::groups::{PagePoint, PathGroup, Subpath, VectorPath, area_groups, groups, letter_groups};
use super::{VectorPage, base64, decimals, svg_text};
use crate::encode::hex;
use crate::finite::check_finite;
use crate::grid::micrometres;
use crate::png::{KEYWORDS, encode_png};
use crate::{OutputError, atomic};
use drypoint_scene::marks::Layer;
use std::io::Write;
use std::path::Path;

/// Writes a page as SVG. The file appears whole or not at all.
///
/// Dots are strokes of length zero with round ends, many to a path, so that half a million take a few megabytes. On a
/// plotter's page each dot is an element of its own in drawing order, since plotter programs skip empty strokes inside
/// a path. Coordinates have steps of 0.001 mm, as marks do. There is no date: equal pages give equal bytes.
///
/// Text names the bundled font and the width that it has there. A viewer without that font fits its own to the width.
///
/// # Errors
/// [`OutputError::Layer`] if the picture has no beauty that fits, [`OutputError::NotFinite`], [`OutputError::Io`].
pub fn write_svg(sheet: &VectorPage, path: &Path) -> Result<(), OutputError> {
    atomic::write(path, &encode_svg(sheet)?)
}

/// An SVG that shows frames in turn, repeatedly (SMIL). Frames are written one by one and not kept. A viewer without
/// animation shows frame 0.
pub struct Animation<'w> {
    out: &'w mut dyn Write,
    frames: usize,
    seconds: f64,
    written: usize,
}

impl<'w> Animation<'w> {
    /// Begins an SVG of `frames` frames of `seconds` each.
    pub fn new(out: &'w mut dyn Write, frames: usize, seconds: f64) -> Self {
        Self { out, frames, seconds, written: 0 }
    }

    /// Writes the next frame. The first frame determines page, metadata and background of all frames; the last frame
    /// ends the file.
    ///
    /// # Errors
    /// [`OutputError::Io`] of the file `path`, the errors of encoding the picture, and [`OutputError::NotFinite`].
    pub fn frame(&mut self, sheet: &VectorPage, path: &Path) -> Result<(), OutputError> {
        check_finite(sheet.marks)?;
        let (i, all) = (self.written, self.frames);
        let mut bytes = Vec::new();
        if i == 0 {
            head(sheet, &mut bytes);
        }
        let hidden = if i == 0 { "" } else { " display=\"none\"" };
        text(
            &mut bytes,
            format_args!("<g inkscape:groupmode=\"layer\" inkscape:label=\"%frame {i}\" id=\"frame{i}\"{hidden}>\n"),
        );
        // The end of one frame and the start of the next are the same number.
        let [from, to] = [i, i + 1].map(|i| i as f64 / all as f64);
        let turns = match (i, i + 1 == all) {
            (0, true) => None,
            (0, false) => Some(("inline;none", format!("0;{to}"))),
            (_, false) => Some(("none;inline;none", format!("0;{from};{to}"))),
            (_, true) => Some(("none;inline", format!("0;{from}"))),
        };
        if let Some((values, times)) = turns {
            let whole = self.seconds * all as f64;
            text(
                &mut bytes,
                format_args!(
                    "<animate attributeName=\"display\" calcMode=\"discrete\" values=\"{values}\" \
                     keyTimes=\"{times}\" dur=\"{whole}s\" repeatCount=\"indefinite\"/>\n"
                ),
            );
        }
        content(sheet, &format!("frame{i}-"), &mut bytes)?;
        bytes.extend_from_slice(b"</g>\n");
        self.written += 1;
        if self.written == all {
            bytes.extend_from_slice(b"</svg>\n");
        }
        let refused = |source| OutputError::Io { path: path.into(), action: "written", source };
        self.out.write_all(&bytes).map_err(refused)
    }
}

/// Returns the bytes of [`write_svg`].
///
/// # Errors
/// Same errors as [`write_svg`], except those of the file.
pub fn encode_svg(sheet: &VectorPage) -> Result<Vec<u8>, OutputError> {
    check_finite(sheet.marks)?;
    let mut out = Vec::new();
    head(sheet, &mut out);
    content(sheet, "", &mut out)?;
    out.extend_from_slice(b"</svg>\n");
    Ok(out)
}

/// Writes page, metadata and background.
fn head(sheet: &VectorPage, out: &mut Vec<u8>) {
    let [width, height] = sheet.marks.page.size.to_array().map(number);
    text(
        out,
        format_args!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" \
         xmlns:xlink=\"http://www.w3.org/1999/xlink\" \
         xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" version=\"1.1\" \
         width=\"{width}mm\" height=\"{height}mm\" viewBox=\"0 0 {width} {height}\">\n"
        ),
    );
    metadata(sheet, out);
    if let Some(color) = sheet.background {
        let (color, opacity) = (hex(color), opacity("fill-opacity", color[3]));
        text(
            out,
            format_args!(
                "<g inkscape:groupmode=\"layer\" inkscape:label=\"%background\" id=\"background\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"{color}\"{opacity}/>\n</g>\n"
            ),
        );
    }
}

/// Writes the picture and the marks. `id` is the prefix of their names.
fn content(sheet: &VectorPage, id: &str, out: &mut Vec<u8>) -> Result<(), OutputError> {
    let page = &sheet.marks.page;
    if let Some(picture) = sheet.picture {
        let [width, height] = page.picture().to_array().map(number);
        let margin = number(page.margin);
        text(
            out,
            format_args!(
                "<g inkscape:groupmode=\"layer\" inkscape:label=\"%picture\" id=\"{id}picture\">\n\
             <image x=\"{margin}\" y=\"{margin}\" width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" \
             xlink:href=\"data:image/png;base64,"
            ),
        );
        base64::encode(&encode_png(picture, 8, sheet.provenance)?, out);
        out.extend_from_slice(b"\"/>\n</g>\n");
    }
    for (i, layer) in sheet.marks.layers.iter().enumerate() {
        draw(layer, &format!("{id}layer{}", i + 1), sheet, out);
    }
    Ok(())
}

/// Writes program, scene and plan.
fn metadata(sheet: &VectorPage, out: &mut Vec<u8>) {
    let said = sheet.provenance;
    out.extend_from_slice(b"<metadata>\n");
    for (keyword, said) in KEYWORDS.into_iter().zip([&said.software, &said.scene_hash, &said.plan]) {
        text(out, format_args!("{}: {}\n", escaped(keyword), escaped(said)));
    }
    out.extend_from_slice(b"</metadata>\n");
}

fn draw(layer: &Layer, id: &str, sheet: &VectorPage, out: &mut Vec<u8>) {
    let (label, color, width) = (escaped(&layer.pen.label()), hex(layer.pen.color), number(layer.pen.width));
    text(
        out,
        format_args!(
            "<g inkscape:groupmode=\"layer\" inkscape:label=\"{label}\" id=\"{id}\" fill=\"none\" stroke=\"{color}\" \
         stroke-width=\"{width}\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n"
        ),
    );
    for group in area_groups(layer, sheet.beziers) {
        draw_group(&group, layer, false, out);
    }
    for group in groups(layer, sheet.plotter, sheet.beziers) {
        draw_group(&group, layer, sheet.plotter, out);
    }
    if sheet.outlined {
        letter_groups(layer).iter().for_each(|group| draw_group(group, layer, false, out));
    } else {
        svg_text::write_texts(layer, out);
    }
    out.extend_from_slice(b"</g>\n");
}

fn draw_group(group: &PathGroup, layer: &Layer, plotter: bool, out: &mut Vec<u8>) {
    // Marks in the pen's own width, opacity and colour need no group.
    let pen = micrometres(layer.pen.width);
    let plain = group.width == Some(pen) && group.opacity == 1.0 && group.color.is_none();
    if !plain {
        let own = group.color.map(|[r, g, b]| hex([r, g, b, 1.0]));
        match group.width {
            Some(width) => {
                out.extend_from_slice(b"<g stroke-width=\"");
                decimals::push(out, width);
                let color = own.map(|own| format!(" stroke=\"{own}\"")).unwrap_or_default();
                text(out, format_args!("\"{color}{}>\n", opacity("stroke-opacity", group.opacity)));
            }
            None => {
                let own = own.unwrap_or_else(|| hex(layer.pen.color));
                let faint = opacity("fill-opacity", group.opacity);
                text(out, format_args!("<g fill=\"{own}\" stroke=\"none\"{faint}>\n"));
            }
        }
    }
    dots(group, plotter, out);
    group.lines.iter().for_each(|line| path(line, out));
    if !plain {
        out.extend_from_slice(b"</g>\n");
    }
}

fn dots(group: &PathGroup, plotter: bool, out: &mut Vec<u8>) {
    for chunk in group.dots.iter().filter(|chunk| !chunk.is_empty()) {
        if plotter {
            for &at in chunk {
                out.extend_from_slice(b"<polyline points=\"");
                push_pair_apart(out, at);
                out.push(b' ');
                push_pair_apart(out, at);
                out.extend_from_slice(b"\"/>\n");
            }
            continue;
        }
        out.extend_from_slice(b"<path d=\"M");
        let mut last = chunk[0];
        push_pair(out, last);
        out.extend_from_slice(b"h0");
        for &at in &chunk[1..] {
            out.push(b'm');
            push_pair(out, [at[0] - last[0], at[1] - last[1]]);
            out.extend_from_slice(b"h0");
            last = at;
        }
        out.extend_from_slice(b"\"/>\n");
    }
}

/// Appends two numbers with a comma, the usual form in lists of points.
fn push_pair_apart(out: &mut Vec<u8>, [x, y]: [i64; 2]) {
    decimals::push(out, x);
    out.push(b',');
    decimals::push(out, y);
}

fn path(line: &VectorPath, out: &mut Vec<u8>) {
    let mut paths = line.paths.iter().filter_map(Subpath::steps).peekable();
    if paths.peek().is_none() {
        return;
    }
    out.extend_from_slice(b"<path d=\"");
    for (mut last, steps) in paths {
        out.push(b'M');
        push_pair(out, last);
        let mut letter = None;
        for step in steps {
            let (own, places): (u8, &[PagePoint]) = match &step {
                PathSegment::Line(at) => (b'l', std::slice::from_ref(at)),
                PathSegment::Curve(places) => (b'c', places),
            };
            let mut follows = letter == Some(own);
            if !follows {
                out.push(own);
            }
            for at in places {
                let [dx, dy] = [at[0] - last[0], at[1] - last[1]];
                if follows && dx >= 0 {
                    out.push(b' ');
                }
                push_pair(out, [dx, dy]);
                follows = true;
            }
            (letter, last) = (Some(own), step.end());
        }
        if line.closed {
            out.push(b'z');
        }
    }
    out.extend_from_slice(b"\"/>\n");
}

/// Returns the attribute; empty for a value of 1.
pub(super) fn opacity(name: &str, value: f64) -> String {
    if value == 1.0 { String::new() } else { format!(" {name}=\"{}\"", number(value)) }
}

pub(super) fn text(out: &mut Vec<u8>, said: std::fmt::Arguments) {
    // A Vec takes whatever is written to it.
    let _ = out.write_fmt(said);
}

/// Returns text escaped for XML, in an attribute or between tags. Characters that XML 1.0 does not allow become U+FFFD.
pub(super) fn escaped(said: &str) -> String {
    let mut out = String::with_capacity(said.len());
    for c in said.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' => out.push(c),
            '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            c if c.is_control() => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::{DVec2, DVec3};
    use drypoint_scene::marks::{Dot, Marks, Page, Pen, Polyline, Vertex};
    use drypoint_scene::picture::{Picture, Provenance};

    fn dot(x: f64, y: f64, radius: f64, opacity: f64) -> Dot {
        Dot { at: DVec2::new(x, y), world: DVec3::ZERO, radius, opacity }
    }

    fn marks() -> Marks {
        let vertex = |x: f64, y: f64| Vertex {
            at: DVec2::new(x, y),
            world: DVec3::ZERO,
            radius: 0.15,
            opacity: 1.0,
            t: 0.0,
            color: None,
        };
        let pen = |number, name: &str, width, color| Pen { number, name: name.into(), width, color };
        let black = Layer {
            dots: vec![dot(1.0, 2.0, 0.15, 1.0), dot(2.5, 1.999, 0.15, 1.0), dot(3.0, 3.0, 0.1, 0.5)],
            lines: vec![
                Polyline { vertices: vec![vertex(4.0, 4.0), vertex(5.0, 3.0), vertex(6.5, 4.0)], closed: false },
                Polyline { vertices: vec![vertex(1.0, 8.0), vertex(2.0, 8.0), vertex(2.0, 9.0)], closed: true },
            ],
            ..Layer::new(pen(1, "black", 0.3, [0.0, 0.0, 0.0, 1.0]))
        };
        let red = Layer::new(pen(2, "<red> & \"co\"", 0.5, [1.0, 0.0, 0.0, 0.5]));
        Marks { page: Page::in_millimetres(DVec2::new(20.0, 10.0), 2.0, 300.0), layers: vec![black, red] }
    }

    fn encoded(background: Option<[f64; 4]>, picture: Option<&Picture>, plotter: bool) -> String {
        let provenance =
            Provenance { software: "Drypoint 0.1.0".into(), scene_hash: "00ff".into(), plan: "κ < 1\n\u{1}".into() };
        let marks = marks();
        let sheet = VectorPage {
            marks: &marks,
            background,
            picture,
            plotter,
            beziers: false,
            outlined: false,
            provenance: &provenance,
        };
        String::from_utf8(encode_svg(&sheet).unwrap()).unwrap()
    }

    #[test]
    fn the_whole_file() {
        assert_eq!(
            encoded(None, None, false),
            r##"<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" version="1.1" width="24mm" height="14mm" viewBox="0 0 24 14">
<metadata>
Software: Drypoint 0.1.0
Drypoint scene: 00ff
Drypoint plan: κ &lt; 1
�
</metadata>
<g inkscape:groupmode="layer" inkscape:label="1-black 0.3" id="layer1" fill="none" stroke="#000000" stroke-width="0.3" stroke-linecap="round" stroke-linejoin="round">
<g stroke-width=".2" stroke-opacity="0.5">
<path d="M3 3h0"/>
</g>
<path d="M1 2h0m1.5-.001h0"/>
<path d="M4 4l1-1 1.5 1"/>
<path d="M1 8l1 0 0 1z"/>
</g>
<g inkscape:groupmode="layer" inkscape:label="2-&lt;red&gt; &amp; &quot;co&quot; 0.5" id="layer2" fill="none" stroke="#ff0000" stroke-width="0.5" stroke-linecap="round" stroke-linejoin="round">
</g>
</svg>
"##
        );
    }

    #[test]
    fn frames_take_turns() {
        let (provenance, marks) = (Provenance::default(), marks());
        let background = Some([1.0; 4]);
        let sheet = VectorPage {
            marks: &marks,
            background,
            picture: None,
            plotter: false,
            beziers: false,
            outlined: false,
            provenance: &provenance,
        };
        let frames = |n: usize| {
            let mut bytes = Vec::new();
            let mut animation = Animation::new(&mut bytes, n, 0.5);
            (0..n).for_each(|_| animation.frame(&sheet, Path::new("a.svg")).unwrap());
            String::from_utf8(bytes).unwrap()
        };
        let found = frames(4);
        let turn = |values: &str, times: &str| {
            let turn = format!("calcMode=\"discrete\" values=\"{values}\" keyTimes=\"{times}\"");
            format!("<animate attributeName=\"display\" {turn} dur=\"2s\" repeatCount=\"indefinite\"/>")
        };
        for said in [
            format!("id=\"frame0\">\n{}", turn("inline;none", "0;0.25")),
            format!("id=\"frame1\" display=\"none\">\n{}", turn("none;inline;none", "0;0.25;0.5")),
            format!("id=\"frame3\" display=\"none\">\n{}", turn("none;inline", "0;0.75")),
        ] {
            assert!(found.contains(&said), "{said}\n{found}");
        }
        assert_eq!((found.matches("%background").count(), found.matches(" id=\"frame2-layer1\"").count()), (1, 1));
        assert!(!frames(1).contains("<animate"));
    }

    #[test]
    fn a_plotter_gets_each_dot_by_itself() {
        let text = encoded(None, None, true);
        assert!(text.contains("<polyline points=\"1,2 1,2\"/>\n<polyline points=\"2.5,1.999 2.5,1.999\"/>"), "{text}");
        assert!(!text.contains("h0"));
    }

    #[test]
    fn what_lies_behind_is_not_plotted() {
        let picture = crate::paint::blank(&Page::in_pixels([2, 1], 0.0, 300.0), Some([1.0; 4])).unwrap();
        let text = encoded(Some([0.0, 0.0, 1.0, 0.25]), Some(&picture), false);
        let background = "inkscape:label=\"%background\" id=\"background\">\n\
                          <rect width=\"24\" height=\"14\" fill=\"#0000ff\" fill-opacity=\"0.25\"/>";
        assert!(text.contains(background), "{text}");
        let image = "inkscape:label=\"%picture\" id=\"picture\">\n<image x=\"2\" y=\"2\" width=\"20\" height=\"10\"";
        assert!(text.contains(image) && text.contains("base64,iVBORw0KGgo"), "{text}");
        assert!(text.find("%background") < text.find("%picture") && text.find("%picture") < text.find("1-black"));
    }
}
