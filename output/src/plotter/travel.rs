//! Distances and drawing time of a pen.

use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::Layer;

/// Speeds of a plotter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// Speed with the pen down, in mm/s.
    pub down: f64,
    /// Speed with the pen up, in mm/s.
    pub up: f64,
    /// Time to lower the pen and raise it again, in seconds.
    pub touch: f64,
}

impl Default for Speed {
    /// A small plotter with a servo for the pen, at an unhurried setting.
    fn default() -> Self {
        Self { down: 50.0, up: 150.0, touch: 0.3 }
    }
}

/// Pen travel of a layer, from the page's upper left corner.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Travel {
    /// Distance with the pen up, in mm.
    pub pen_up: f64,
    /// Distance with the pen down, in mm.
    pub pen_down: f64,
    /// Number of times the pen is lowered.
    pub touches: usize,
    /// Estimated seconds: distances over speeds, and the touches. Acceleration is not counted.
    pub seconds: f64,
}

impl Travel {
    /// Returns the travel of a layer drawn in its order: dots, then lines.
    pub fn of(layer: &Layer, speed: &Speed) -> Self {
        let mut travel = Self::default();
        let mut pen = DVec2::ZERO;
        let mut touch = |from: DVec2, to: DVec2, down: f64| {
            travel.pen_up += pen.distance(from);
            travel.pen_down += down;
            travel.touches += 1;
            pen = to;
        };
        layer.dots.iter().for_each(|dot| touch(dot.at, dot.at, 0.0));
        for line in &layer.lines {
            if let [first, .., last] = line.vertices.as_slice() {
                let last = if line.closed { first } else { last };
                let back = line.vertices[line.vertices.len() - 1].at.distance(last.at);
                let down = line.vertices.windows(2).map(|w| w[0].at.distance(w[1].at)).sum::<f64>();
                touch(first.at, last.at, down + back);
            }
        }
        travel.seconds = travel.pen_up / speed.up + travel.pen_down / speed.down + travel.touches as f64 * speed.touch;
        travel
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::DVec3;
    use drypoint_scene::marks::{Dot, Pen, Polyline, Vertex};

    #[test]
    fn a_way_by_hand() {
        let vertex = |x: f64, y: f64| Vertex {
            at: DVec2::new(x, y),
            world: DVec3::ZERO,
            radius: 0.1,
            opacity: 1.0,
            t: 0.0,
            color: None,
        };
        let layer = Layer {
            dots: vec![Dot { at: DVec2::new(3.0, 4.0), world: DVec3::ZERO, radius: 0.1, opacity: 1.0 }],
            lines: vec![
                Polyline { vertices: vec![vertex(3.0, 5.0), vertex(3.0, 7.0)], closed: false },
                Polyline { vertices: vec![vertex(6.0, 11.0), vertex(9.0, 11.0), vertex(9.0, 15.0)], closed: true },
            ],
            ..Layer::new(Pen { number: 1, name: String::new(), width: 0.2, color: [0.0; 4] })
        };
        // Up: 5 to the dot, 1 to the first line, 5 to the ring. Down: 2, and a ring of 3 + 4 + 5.
        let travel = Travel::of(&layer, &Speed { down: 2.0, up: 11.0, touch: 0.5 });
        assert_eq!(travel, Travel { pen_up: 11.0, pen_down: 14.0, touches: 3, seconds: 1.0 + 7.0 + 1.5 });
    }
}
