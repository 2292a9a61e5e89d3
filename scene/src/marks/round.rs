//! Marks on steps ([STIP-16]), so that every file has the same geometry.

use super::{Marks, PageUnit};
use crate::color::{Rgb, linear_to_srgb, srgb_to_linear};
use glam::DVec2;

/// Steps of a millimetre for places: 0.001 mm.
const PLACE: f64 = 1000.0;

/// Steps of 1 for opacities: sixteenths.
pub(super) const OPACITY: f64 = 16.0;

/// The multiple of 1/`steps` nearest to `x`; ties go to the even one. Dividing an integer by an integer gives the
/// number that the decimals are read as.
pub(super) fn nearest(x: f64, steps: f64) -> f64 {
    (x * steps).round_ties_even() / steps
}

/// A colour on the codes of sRGB's bytes.
fn on_codes(color: Rgb) -> Rgb {
    color.map(|c| srgb_to_linear(nearest(linear_to_srgb(c).clamp(0.0, 1.0), 255.0)))
}

/// A place on the page on its step of 0.001 mm.
pub fn on_step(at: DVec2) -> DVec2 {
    DVec2::new(nearest(at.x, PLACE), nearest(at.y, PLACE))
}

impl Marks {
    /// Prepares marks for every writer: rounds them to steps and clips them to the frame.
    pub fn settle(&mut self) {
        // First the steps: a radius that grows must not reach over the edge. Then again for the ends of lines that are cut.
        self.round();
        self.keep_inside();
        self.round();
    }

    /// Rounds every mark to its step: places to 0.001 mm, radii to 0.005 mm, opacities to 1/16, colours of vertices to
    /// 1/255 of sRGB. If the scene counts in pixels, the step of radii is 0.001 mm too, because dots may then be a few
    /// hundredths of a millimetre.
    ///
    /// Dots that then have no radius or opacity, or whose place is not a number, are removed. Vertices whose place is
    /// not a number are removed, too, and then lines of fewer than two vertices. Rounding twice changes nothing.
    pub fn round(&mut self) {
        let radius_steps = match self.page.unit {
            PageUnit::Millimetres => 200.0,
            PageUnit::Pixels => PLACE,
        };
        for layer in &mut self.layers {
            layer.dots.retain_mut(|dot| {
                dot.at = on_step(dot.at);
                dot.radius = nearest(dot.radius, radius_steps);
                dot.opacity = nearest(dot.opacity.min(1.0), OPACITY);
                dot.at.is_finite() && dot.radius > 0.0 && dot.radius.is_finite() && dot.opacity > 0.0
            });
            layer.lines.retain_mut(|line| {
                line.vertices.retain_mut(|vertex| {
                    vertex.at = on_step(vertex.at);
                    vertex.radius = nearest(vertex.radius, radius_steps);
                    vertex.opacity = nearest(vertex.opacity.clamp(0.0, 1.0), OPACITY);
                    vertex.color = vertex.color.map(on_codes);
                    vertex.at.is_finite() && vertex.radius.is_finite()
                });
                line.vertices.len() > 1
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Dot, Layer, Page, Pen, Polyline, Vertex};
    use super::*;
    use glam::DVec3;

    fn dot(x: f64, y: f64, radius: f64, opacity: f64) -> Dot {
        Dot { at: DVec2::new(x, y), world: DVec3::new(0.1234567, 0.0, 0.0), radius, opacity }
    }

    fn marks(page: Page, dots: Vec<Dot>) -> Marks {
        let pen = Pen { number: 1, name: "black".into(), width: 0.3, color: [0.0, 0.0, 0.0, 1.0] };
        Marks { page, layers: vec![Layer { dots, ..Layer::new(pen) }] }
    }

    #[test]
    fn hand_worked_steps() {
        let list = vec![dot(12.34567, 0.00049, 0.1234, 0.52), dot(1.0, 2.0, 0.0024, 1.0), dot(1.0, 2.0, 1.0, 0.03)];
        let mut paper = marks(Page::in_millimetres(DVec2::splat(100.0), 0.0, 300.0), list.clone());
        paper.round();
        // 0.1234 lies between 0.120 and 0.125; 0.52 between 8/16 and 9/16; 0.0024 is below half a step, 0.03 below 1/32.
        assert_eq!(paper.layers[0].dots, [dot(12.346, 0.0, 0.125, 0.5)]);
        let mut screen = marks(Page::in_pixels([100, 100], 0.0, 300.0), list);
        screen.round();
        assert_eq!(screen.layers[0].dots, [dot(12.346, 0.0, 0.123, 0.5), dot(1.0, 2.0, 0.002, 1.0)]);
    }

    #[test]
    fn a_step_is_the_number_that_its_decimals_say() {
        // Otherwise a list that is written in decimals would come back with other bits.
        for n in 0..20_000u32 {
            let text = format!("{}.{:03}", n / 1000, n % 1000);
            let said: f64 = text.parse().unwrap();
            assert_eq!(nearest(said + 2e-4, PLACE).to_bits(), said.to_bits(), "{text}");
            assert_eq!(nearest(said, PLACE).to_bits(), said.to_bits(), "{text}");
        }
    }

    #[test]
    fn rounding_twice_changes_nothing() {
        let dots = (1..2000).map(|i| f64::from(i) * 0.0777).map(|x| dot(x, 1.0 / x, x / 90.0, x / 160.0)).collect();
        let mut once = marks(Page::in_millimetres(DVec2::splat(100.0), 0.0, 300.0), dots);
        once.round();
        let mut twice = once.clone();
        twice.round();
        assert_eq!(once, twice);
    }

    #[test]
    fn a_dot_that_rounding_pushes_over_the_edge_is_left_out() {
        // Radius 0.1026 becomes 0.105; the centre is 0.103 from the edge, and 0.105 for the one that stays.
        let mut list = marks(
            Page::in_millimetres(DVec2::splat(90.0), 5.0, 300.0),
            vec![dot(5.103, 50.0, 0.1026, 1.0), dot(5.1049, 50.0, 0.1026, 1.0)],
        );
        list.settle();
        assert_eq!(list.layers[0].dots, [dot(5.105, 50.0, 0.105, 1.0)]);
    }

    #[test]
    fn what_is_no_number_is_left_out() {
        let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        let mut dots: Vec<Dot> = bad.iter().map(|&x| dot(x, 1.0, 1.0, 1.0)).collect();
        dots.extend([dot(1.0, 1.0, f64::NAN, 1.0), dot(1.0, 1.0, f64::INFINITY, 1.0), dot(1.0, 1.0, -1.0, 1.0)]);
        let mut list = marks(Page::in_millimetres(DVec2::splat(100.0), 0.0, 300.0), dots);
        let vertex =
            |x| Vertex { at: DVec2::new(x, 0.0), world: DVec3::ZERO, radius: 0.1, opacity: 2.0, t: 0.0, color: None };
        let line = |xs: [f64; 3]| Polyline { vertices: xs.map(vertex).to_vec(), closed: false };
        list.layers[0].lines = vec![line([0.0, f64::NAN, 1.0]), line([0.0, f64::NAN, f64::INFINITY])];
        list.round();
        assert_eq!((list.layers[0].dots.len(), list.layers[0].lines.len()), (0, 1));
        let vertices = &list.layers[0].lines[0].vertices;
        assert_eq!((vertices.len(), vertices[0].opacity), (2, 1.0));
    }
}
