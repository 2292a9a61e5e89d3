//! Fragments of lines on the rays of a picture, which composites them at their depths ([HATCH-14] d).

use super::PageWindow;
use super::lines::{each_of_joined, goes_on};
use super::pixel_rect::PixelRect;
use drypoint_scene::fragments::{Fragment, Fragments};
use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{Marks, Piece, Polyline};
use drypoint_scene::view::View;

/// Returns the fragments of lines on the n×n rays of each pixel of a view. A line has one fragment on each ray whose
/// part of the pixel it covers. The depth is taken at the point on the line's middle that is nearest to the ray on the
/// page.
pub fn fragments(marks: &Marks, view: &View, samples: usize) -> Fragments {
    let rays = view.size.map(|n| n * samples);
    let window = PageWindow::frame(&marks.page, rays);
    let mut found = Vec::new();
    for layer in &marks.layers {
        let [r, g, b, opacity] = layer.pen.color;
        for line in &layer.lines {
            let pieces = line.pieces();
            let Some(part) = PixelRect::around(&pieces, &window, rays) else { continue };
            let depths = depths(line, &part, &window, view);
            for joined in pieces.chunk_by(goes_on) {
                each_of_joined(joined, &part, &window, opacity, |i, ray, color, share| {
                    let fragment =
                        Fragment { depth: depths[i], rgb: color.unwrap_or([r, g, b]), opacity: share * opacity };
                    // A pixel that no segment comes near has an infinite depth.
                    if fragment.depth.is_finite() && fragment.opacity > 0.0 {
                        found.push((ray, fragment));
                    }
                });
            }
        }
    }
    Fragments::new(view.size, samples, &found)
}

/// Returns the depth of a line's middle at the point nearest to each pixel of a rectangle; infinite where the line is
/// not near.
fn depths(line: &Polyline, part: &PixelRect, window: &PageWindow, view: &View) -> Vec<f64> {
    // Squared distance and depth of the nearest point so far.
    let mut nearest = vec![[f64::INFINITY; 2]; part.columns * part.rows];
    let ends = line.vertices.windows(2).map(|pair| [pair[0], pair[1]]);
    let joint = line.vertices.last().zip(line.vertices.first()).filter(|_| line.closed).map(|(a, b)| [*a, *b]);
    for segment in ends.chain(joint) {
        let piece = Piece {
            points: segment.map(|vertex| vertex.at).to_vec(),
            radii: segment.map(|vertex| vertex.radius).to_vec(),
            opacity: 1.0,
            color: None,
            closed: false,
            ends: [true; 2],
        };
        let Some(near) =
            PixelRect::around(std::slice::from_ref(&piece), window, [part.left + part.columns, part.top + part.rows])
        else {
            continue;
        };
        let [a, b] = segment.map(|vertex| DVec2::from(window.place(vertex.at)));
        let depth = segment.map(|vertex| -view.to_eye(vertex.world).z);
        let along = b - a;
        let length = along.length_squared();
        for y in near.top.max(part.top)..near.top + near.rows {
            for x in near.left.max(part.left)..near.left + near.columns {
                let at = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let s = if length > 0.0 { ((at - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
                let distance = (a + along * s - at).length_squared();
                let best = &mut nearest[(y - part.top) * part.columns + x - part.left];
                if distance < best[0] {
                    *best = [distance, between(depth, s, view.perspective)];
                }
            }
        }
    }
    nearest.into_iter().map(|[_, depth]| depth).collect()
}

/// Returns the depth at the share `s` of a segment on the page. In perspective 1/depth is linear on the page.
fn between([a, b]: [f64; 2], s: f64, perspective: bool) -> f64 {
    if !perspective {
        return a + (b - a) * s;
    }
    a * b / (b + (a - b) * s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::color::Rgba;
    use drypoint_scene::glam::DVec3;
    use drypoint_scene::marks::{Layer, Page, Pen, Vertex};
    use drypoint_scene::space::Grid;
    use drypoint_scene::tables::{Camera, Projection};

    /// Down −z on 40 × 20 pixels of 0.1 mm.
    fn view(projection: Projection, eye: f64) -> View {
        let grid = Grid::with_spacing([3; 3], [1.0; 3]).unwrap();
        let (eye, direction) = (Some(DVec3::new(0.0, 0.0, eye)), DVec3::NEG_Z);
        let camera = Camera { projection, eye, direction, direction_given: true, up: DVec3::Y, ..Camera::default() };
        View::new(&camera, &grid, [40, 20]).unwrap()
    }

    fn marks(color: Rgba, ends: [([f64; 2], f64); 2]) -> Marks {
        let vertex = |(at, z): ([f64; 2], f64)| Vertex {
            at: DVec2::from(at),
            world: DVec3::new(0.0, 0.0, z),
            radius: 0.1,
            opacity: 0.5,
            t: 0.0,
            color: None,
        };
        let line = Polyline { vertices: ends.map(vertex).to_vec(), closed: false };
        let pen = Pen { number: 1, name: "pen".into(), width: 0.2, color };
        let page = Page::in_pixels([40, 20], 0.0, 254.0);
        Marks { page, layers: vec![Layer { lines: vec![line], ..Layer::new(pen) }] }
    }

    /// A line two pixels wide from x = 10 to 30, between the rows 9 and 10, which it covers whole. Its depth goes from
    /// 3 to 8.
    #[test]
    fn depths_are_linear_where_rays_are_parallel() {
        let view = view(Projection::Orthographic { height: None }, 5.0);
        let found = fragments(&marks([0.25, 0.5, 1.0, 0.5], [([1.0, 1.0], 2.0), ([3.0, 1.0], -3.0)]), &view, 1);
        for i in 11..29 {
            for j in [9.5, 10.5] {
                let [only] = found.at([f64::from(i) + 0.5, j]) else { panic!("{i}") };
                assert_eq!((only.rgb, only.opacity), ([0.25, 0.5, 1.0], 0.25));
                assert!((only.depth - (3.0 + 5.0 * (f64::from(i) - 9.5) / 20.0)).abs() < 1e-12, "{only:?}");
            }
            assert!(found.at([f64::from(i) + 0.5, 7.5]).is_empty());
        }
    }

    /// The depth is interpolated as 1/depth in perspective, and each of four rays a pixel has its own point.
    #[test]
    fn one_over_depth_is_linear_in_perspective() {
        let view = view(Projection::Perspective { fov: 90.0 }, 10.0);
        let found = fragments(&marks([0.0, 0.0, 0.0, 1.0], [([1.0, 1.0], 6.0), ([3.0, 1.0], -2.0)]), &view, 2);
        for k in 0..37 {
            let x = 10.75 + 0.5 * f64::from(k);
            let [only] = found.at([x, 9.75]) else { panic!("{x}") };
            let s = (x - 10.0) / 20.0;
            assert!((1.0 / only.depth - ((1.0 - s) / 4.0 + s / 12.0)).abs() < 1e-12, "{x}: {only:?}");
        }
    }

    /// A line that crosses itself covers once.
    #[test]
    fn a_line_covers_a_ray_once() {
        let view = view(Projection::Orthographic { height: None }, 5.0);
        let mut both = marks([0.0, 0.0, 0.0, 1.0], [([1.0, 1.0], 0.0), ([3.0, 1.0], 0.0)]);
        let back = Vertex { at: DVec2::new(1.0, 1.0), ..both.layers[0].lines[0].vertices[0] };
        both.layers[0].lines[0].vertices.push(back);
        let found = fragments(&both, &view, 1);
        assert_eq!(found.at([20.5, 9.5]).len(), 1);
        let [line] = both.layers[0].lines.as_slice() else { panic!() };
        both.layers[0].lines = vec![line.clone(), line.clone()];
        assert_eq!(fragments(&both, &view, 1).at([20.5, 9.5]).len(), 2);
    }
}
