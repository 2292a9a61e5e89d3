//! Writing of PDF ([IO-2], [IO-7]): the groups of the SVG with the same numbers. Each layer is an optional-content
//! group.

use super::VectorPage;
use super::curves::PathSegment;
use super::decimals::{number, push};
use super::groups::{PathGroup, Subpath, area_groups, groups, letter_groups};
use super::pdf_text::EmbeddedFont;
use crate::encode::{quantize, srgb_bytes, straight_srgb};
use crate::finite::check_finite;
use crate::layers::{fitting, side};
use crate::{OutputError, atomic};
use drypoint_scene::color::Rgba;
use drypoint_scene::marks::{INCH, Layer, Text};
use drypoint_scene::picture::{LayerKind, Picture};
use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, TextStr};
use std::path::Path;

/// Keys of the document's information: hash of the scene, and plan. The program is its `Producer`.
pub const KEYS: [&str; 2] = ["DrypointScene", "DrypointPlan"];

/// Points in a millimetre.
const POINTS: f64 = 72.0 / INCH;

/// Compression level of the streams, of 10.
const LEVEL: u8 = 6;

const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const INFO: Ref = Ref::new(5);
const IMAGE: Ref = Ref::new(6);
const MASK: Ref = Ref::new(7);
/// First reference of the layers.
const FIRST: i32 = 8;

/// Writes a page as PDF. The file appears whole or not at all.
///
/// The PDF page has the marks' page size. Dots are strokes of length zero with round ends, as PDF defines them. There
/// is no date and no random number: equal pages give equal bytes.
///
/// Text is in a subset of the bundled font, which the file holds.
///
/// # Errors
/// [`OutputError::Layer`] if the picture has no beauty that fits, [`OutputError::NotFinite`], [`OutputError::Io`].
pub fn write_pdf(sheet: &VectorPage, path: &Path) -> Result<(), OutputError> {
    atomic::write(path, &encode_pdf(sheet)?)
}

/// Returns the bytes of [`write_pdf`].
///
/// # Errors
/// Same errors as [`write_pdf`], except those of the file.
pub fn encode_pdf(sheet: &VectorPage) -> Result<Vec<u8>, OutputError> {
    check_finite(sheet.marks)?;
    let mut content = Content::new(sheet);
    if let Some(color) = sheet.background {
        content.background(sheet, color);
    }
    if sheet.picture.is_some() {
        content.picture(sheet);
    }
    for layer in &sheet.marks.layers {
        content.layer(layer, sheet);
    }

    // The picture, then an optional-content group for each layer.
    let mut pdf = Pdf::new();
    if let Some(picture) = sheet.picture {
        image(&mut pdf, picture)?;
    }
    let layers: Vec<Ref> = (FIRST..).map(Ref::new).take(content.labels.len()).collect();
    for (&layer, label) in layers.iter().zip(&content.labels) {
        pdf.indirect(layer).dict().pair(Name(b"Type"), Name(b"OCG")).pair(Name(b"Name"), TextStr(label));
    }
    let font = Ref::new(FIRST + content.labels.len() as i32);
    if let Some(embedded) = &content.font {
        embedded.write(&mut pdf, font, LEVEL);
    }
    // The catalog lists the layers and their order.
    let mut catalog = pdf.catalog(CATALOG);
    catalog.pages(PAGES);
    let mut properties = catalog.insert(Name(b"OCProperties")).dict();
    properties.insert(Name(b"OCGs")).array().items(layers.iter().copied());
    let mut shown = properties.insert(Name(b"D")).dict();
    shown.insert(Name(b"Order")).array().items(layers.iter().copied());
    shown.finish();
    properties.finish();
    catalog.finish();
    // The page and its resources: the picture, the font, opacities, layers.
    pdf.pages(PAGES).kids([PAGE]).count(1);
    let size = sheet.marks.page.size * POINTS;
    let mut page = pdf.page(PAGE);
    page.media_box(Rect::new(0.0, 0.0, size.x as f32, size.y as f32)).parent(PAGES).contents(CONTENT);
    let mut resources = page.resources();
    if sheet.picture.is_some() {
        resources.x_objects().pair(Name(b"P"), IMAGE);
    }
    if content.font.is_some() {
        resources.fonts().pair(Name(b"F"), font);
    }
    let mut states = resources.ext_g_states();
    for (i, &opacity) in content.opacities.iter().enumerate() {
        let mut state = states.insert(Name(format!("G{i}").as_bytes())).dict();
        state.pair(Name(b"CA"), opacity as f32).pair(Name(b"ca"), opacity as f32);
    }
    states.finish();
    let mut names = resources.insert(Name(b"Properties")).dict();
    for (i, &layer) in layers.iter().enumerate() {
        names.pair(Name(format!("L{i}").as_bytes()), layer);
    }
    names.finish();
    resources.finish();
    page.finish();
    let said = sheet.provenance;
    let mut info = pdf.document_info(INFO);
    info.producer(TextStr(&said.software));
    for (key, said) in KEYS.iter().zip([&said.scene_hash, &said.plan]) {
        info.pair(Name(key.as_bytes()), TextStr(said));
    }
    info.finish();
    pdf.stream(CONTENT, &compress_to_vec_zlib(&content.bytes, LEVEL)).filter(Filter::FlateDecode);
    Ok(pdf.finish())
}

/// The content stream, and the objects that it refers to by number.
struct Content {
    bytes: Vec<u8>,
    /// Labels of the layers, `L0` and on.
    labels: Vec<String>,
    /// Opacities of the graphics states, `G0` and on.
    opacities: Vec<f64>,
    /// The font `F` of the page's text; none without text, or if text is outlines.
    font: Option<EmbeddedFont>,
}

impl Content {
    /// Begins a page in millimetres, y down, with round caps and joins.
    fn new(sheet: &VectorPage) -> Self {
        let height = number(sheet.marks.page.size.y * POINTS);
        let bytes = format!("{POINTS:.9} 0 0 -{POINTS:.9} 0 {height} cm 1 J 1 j\n");
        let font = if sheet.outlined { None } else { EmbeddedFont::of(sheet.marks) };
        Self { bytes: bytes.into_bytes(), labels: Vec::new(), opacities: Vec::new(), font }
    }

    /// Wraps drawing in a layer of that label.
    fn within(&mut self, label: String, draw: impl FnOnce(&mut Self)) {
        self.add(&format!("/OC /L{} BDC q\n", self.labels.len()));
        self.labels.push(label);
        draw(self);
        self.add("Q EMC\n");
    }

    fn background(&mut self, sheet: &VectorPage, color: Rgba) {
        let [width, height] = sheet.marks.page.size.to_array().map(number);
        self.within("%background".into(), |content| {
            content.state(color[3]);
            content.color(color, "rg");
            content.add(&format!("0 0 {width} {height} re f\n"));
        });
    }

    fn picture(&mut self, sheet: &VectorPage) {
        let page = &sheet.marks.page;
        let [width, height] = page.picture().to_array().map(number);
        let (left, bottom) = (number(page.margin), number(page.size.y - page.margin));
        // A picture fills the unit square, upright.
        self.within("%picture".into(), |content| {
            content.add(&format!("{width} 0 0 -{height} {left} {bottom} cm /P Do\n"));
        });
    }

    fn layer(&mut self, layer: &Layer, sheet: &VectorPage) {
        self.within(layer.pen.label(), |content| {
            content.color(layer.pen.color, "RG");
            for group in area_groups(layer, sheet.beziers) {
                content.group(&group, layer.pen.color);
            }
            for group in groups(layer, sheet.plotter, sheet.beziers) {
                content.group(&group, layer.pen.color);
            }
            if sheet.outlined {
                letter_groups(layer).iter().for_each(|group| content.group(group, layer.pen.color));
            } else {
                layer.texts.iter().for_each(|text| content.text(text, layer.pen.color));
            }
        });
    }

    fn text(&mut self, text: &Text, pen: Rgba) {
        self.add("q ");
        self.state(text.opacity * pen[3]);
        self.color(pen, "rg");
        if let Some(font) = &self.font {
            font.show(text, &mut self.bytes);
        }
        self.add("Q\n");
    }

    fn group(&mut self, group: &PathGroup, pen: Rgba) {
        // Graphics state of the group: opacity, then width and colour of strokes or colour of fills.
        self.add("q ");
        self.state(group.opacity);
        let [r, g, b] = group.color.unwrap_or([pen[0], pen[1], pen[2]]);
        match group.width {
            Some(width) => {
                if group.color.is_some() {
                    self.color([r, g, b, 1.0], "RG");
                }
                push(&mut self.bytes, width);
                self.add(" w\n");
            }
            None => self.color([r, g, b, 1.0], "rg"),
        }
        // Dots, then lines: moves, segments, and the operator that paints the path.
        for chunk in group.dots.iter().filter(|chunk| !chunk.is_empty()) {
            for &at in chunk {
                self.step(at, b" m ");
                self.step(at, b" l\n");
            }
            self.add("S\n");
        }
        for line in &group.lines {
            for (start, steps) in line.paths.iter().filter_map(Subpath::steps) {
                self.step(start, b" m\n");
                for step in steps {
                    match step {
                        PathSegment::Line(at) => self.step(at, b" l\n"),
                        PathSegment::Curve([a, b, at]) => {
                            self.step(a, b" ");
                            self.step(b, b" ");
                            self.step(at, b" c\n");
                        }
                    }
                }
            }
            self.add(match (group.width, line.closed) {
                (None, _) => "f\n",
                (Some(_), true) => "s\n",
                (Some(_), false) => "S\n",
            });
        }
        self.add("Q\n");
    }

    fn step(&mut self, at: [i64; 2], operator: &[u8]) {
        // An outline may reach over the page's edge, and here a sign parts no numbers.
        push(&mut self.bytes, at[0]);
        self.bytes.push(b' ');
        push(&mut self.bytes, at[1]);
        self.bytes.extend_from_slice(operator);
    }

    fn color(&mut self, color: Rgba, operator: &str) {
        let [r, g, b] = srgb_bytes(color).map(|byte| number(f64::from(byte) / 255.0));
        self.add(&format!("{r} {g} {b} {operator}\n"));
    }

    /// Sets the opacity of everything that follows.
    fn state(&mut self, opacity: f64) {
        if opacity != 1.0 {
            let known = self.opacities.iter().position(|&o| o == opacity);
            let state = known.unwrap_or(self.opacities.len());
            if known.is_none() {
                self.opacities.push(opacity);
            }
            self.add(&format!("/G{state} gs "));
        }
    }

    fn add(&mut self, text: &str) {
        self.bytes.extend_from_slice(text.as_bytes());
    }
}

/// Adds the picture as 8-bit sRGB, with its opacity as a mask.
fn image(pdf: &mut Pdf, picture: &Picture) -> Result<(), OutputError> {
    let channels = &fitting(picture, LayerKind::Beauty)?.channels;
    let (mut color, mut mask) = (Vec::new(), Vec::new());
    let pixels = picture.width * picture.height;
    for pixel in (0..pixels).map(|i| [0, 1, 2, 3].map(|c| channels[c][i])) {
        let [r, g, b, a] = straight_srgb(pixel).map(|c| quantize(c, 255) as u8);
        color.extend([r, g, b]);
        mask.push(a);
    }
    // Below 2³¹, as `side` says.
    let [width, height] =
        [side(picture.width, LayerKind::Beauty)? as i32, side(picture.height, LayerKind::Beauty)? as i32];
    let translucent = mask.iter().any(|&a| a < 255);
    for (id, samples, space) in [(IMAGE, color, &b"DeviceRGB"[..]), (MASK, mask, b"DeviceGray")] {
        if id == MASK && !translucent {
            break;
        }
        let packed = compress_to_vec_zlib(&samples, LEVEL);
        let mut image = pdf.image_xobject(id, &packed);
        image.filter(Filter::FlateDecode);
        image.width(width).height(height).bits_per_component(8).color_space_name(Name(space));
        if id == IMAGE && translucent {
            image.s_mask(MASK);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::{DVec2, DVec3};
    use drypoint_scene::marks::{Dot, Marks, Page, Pen, Polyline, Vertex};
    use drypoint_scene::picture::Provenance;

    fn marks() -> Marks {
        let vertex = |x: f64, y: f64| Vertex {
            at: DVec2::new(x, y),
            world: DVec3::ZERO,
            radius: 0.15,
            opacity: 1.0,
            t: 0.0,
            color: None,
        };
        let dot = |x: f64, opacity: f64| Dot { at: DVec2::new(x, 2.0), world: DVec3::ZERO, radius: 0.15, opacity };
        let black = Layer {
            dots: vec![dot(1.0, 1.0), dot(2.5, 1.0), dot(3.0, 0.5)],
            lines: vec![Polyline {
                vertices: vec![vertex(4.0, 4.0), vertex(5.0, 3.0), vertex(6.5, 4.0)],
                closed: true,
            }],
            ..Layer::new(Pen { number: 1, name: "schwarz ß".into(), width: 0.3, color: [0.0, 0.0, 0.0, 1.0] })
        };
        Marks { page: Page::in_millimetres(DVec2::new(20.0, 10.0), 2.0, 300.0), layers: vec![black] }
    }

    fn encoded(background: Option<Rgba>, picture: Option<&Picture>) -> Vec<u8> {
        let provenance = Provenance { software: "Drypoint 0.1.0".into(), scene_hash: "00ff".into(), plan: "κ".into() };
        let marks = marks();
        encode_pdf(&VectorPage {
            marks: &marks,
            background,
            picture,
            plotter: false,
            beziers: false,
            outlined: false,
            provenance: &provenance,
        })
        .unwrap()
    }

    fn holds(bytes: &[u8], text: &str) -> bool {
        bytes.windows(text.len()).any(|window| window == text.as_bytes())
    }

    #[test]
    fn what_is_drawn() {
        let provenance = Provenance::default();
        let marks = marks();
        let sheet = VectorPage {
            marks: &marks,
            background: None,
            picture: None,
            plotter: false,
            beziers: false,
            outlined: false,
            provenance: &provenance,
        };
        let mut content = Content::new(&sheet);
        content.layer(&marks.layers[0], &sheet);
        // 72/25.4 = 2.834645669 points a millimetre; 14 mm are 39.685039 points.
        assert_eq!(
            String::from_utf8(content.bytes).unwrap(),
            "2.834645669 0 0 -2.834645669 0 39.685039 cm 1 J 1 j\n\
             /OC /L0 BDC q\n0 0 0 RG\n\
             q /G0 gs .3 w\n3 2 m 3 2 l\nS\nQ\n\
             q .3 w\n1 2 m 1 2 l\n2.5 2 m 2.5 2 l\nS\n4 4 m\n5 3 l\n6.5 4 l\ns\nQ\n\
             Q EMC\n"
        );
        assert_eq!((content.labels, content.opacities), (vec!["1-schwarz ß 0.3".to_owned()], vec![0.5]));
    }

    #[test]
    fn layers_and_provenance_but_no_date() {
        let bytes = encoded(Some([1.0; 4]), None);
        for text in
            ["%PDF-1.7", "/OCProperties", "/Type /OCG", "(%background)", "(Drypoint 0.1.0)", "(00ff)", "/CA 0.5"]
        {
            assert!(holds(&bytes, text), "{text}");
        }
        assert!(!holds(&bytes, "Date") && !holds(&bytes, "/ID"));
        assert_eq!(encoded(Some([1.0; 4]), None), bytes);
    }

    #[test]
    fn a_picture_has_a_mask_where_it_is_translucent() {
        let picture = |color| crate::paint::blank(&Page::in_pixels([2, 1], 0.0, 300.0), Some(color)).unwrap();
        let opaque = encoded(None, Some(&picture([1.0; 4])));
        assert!(holds(&opaque, "/Subtype /Image") && !holds(&opaque, "/SMask"));
        assert!(holds(&encoded(None, Some(&picture([1.0, 1.0, 1.0, 0.5]))), "/SMask"));
    }
}
