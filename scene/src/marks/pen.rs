//! Pens.

use super::Page;
use crate::color::linear_to_oklab;
use crate::tables::PenSettings;

/// The pen that draws a layer: one of `[[pen]]`, or the colour that an effect has instead ([IO-7]).
#[derive(Clone, Debug, PartialEq)]
pub struct Pen {
    /// Number of the layer, from 1, in the order of `[[pen]]`.
    pub number: usize,
    /// Name of the layer.
    pub name: String,
    /// Width of the nib, in mm.
    pub width: f64,
    /// The colour: linear, straight.
    pub color: [f64; 4],
}

impl Pen {
    /// Returns the scene's pens, numbered in their order. Widths are rounded to steps of 0.001 mm, and are at least one
    /// step.
    pub fn of(pens: &[PenSettings], page: &Page) -> Vec<Self> {
        let pen = |(i, pen): (usize, &PenSettings)| Self {
            number: i + 1,
            name: pen.name.clone(),
            width: ((page.length(pen.width).unwrap_or_default() * 1000.0).round_ties_even().max(1.0)) / 1000.0,
            color: pen.color,
        };
        pens.iter().enumerate().map(pen).collect()
    }

    /// Returns the pen of the least lightness in OKLab, the first of equals; none of no pens.
    pub fn darkest(pens: &[Self]) -> Option<&Self> {
        let lightness = |pen: &&Self| linear_to_oklab([0, 1, 2].map(|c| pen.color[c]))[0];
        pens.iter().min_by(|a, b| lightness(a).total_cmp(&lightness(b)))
    }

    /// The layer's name for plotters, such as `1-black 0.3`: the number comes first, then name and width.
    pub fn label(&self) -> String {
        format!("{}-{} {}", self.number, self.name, self.width)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::Length;

    #[test]
    fn widths_are_on_steps() {
        // 2 px at 300 dpi are 0.16933 mm.
        let page = Page::in_pixels([100, 100], 0.0, 300.0);
        let pen = |width| PenSettings { name: "p".into(), width, color: [0.0; 4], tone: None };
        let pens = [Length::Pixels(2.0), Length::Millimetres(0.35), Length::Pixels(1e-6)].map(pen);
        let found: Vec<(usize, f64)> = Pen::of(&pens, &page).iter().map(|pen| (pen.number, pen.width)).collect();
        assert_eq!(found, [(1, 0.169), (2, 0.35), (3, 0.001)]);
    }

    /// Blue is darker than red, and red than yellow, though a colour's opacity counts for nothing.
    #[test]
    fn the_darkest_pen_has_the_least_lightness() {
        let pen = |name: &str, color| Pen { number: 1, name: name.into(), width: 0.1, color };
        let pens = [
            pen("yellow", [1.0, 1.0, 0.0, 1.0]),
            pen("blue", [0.0, 0.0, 1.0, 1.0]),
            pen("red", [1.0, 0.0, 0.0, 1.0]),
            pen("other blue", [0.0, 0.0, 1.0, 0.1]),
        ];
        assert_eq!(Pen::darkest(&pens).map(|pen| &*pen.name), Some("blue"));
        assert_eq!(Pen::darkest(&[]), None);
    }

    #[test]
    fn the_label_begins_with_the_number() {
        let pen = |number, name: &str, width| Pen { number, name: name.into(), width, color: [0.0, 0.0, 0.0, 1.0] };
        assert_eq!(pen(1, "black", 0.3).label(), "1-black 0.3");
        assert_eq!(pen(12, "2nd red", 1.0).label(), "12-2nd red 1");
    }
}
