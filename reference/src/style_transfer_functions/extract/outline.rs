//! Closed outlines ([STF-2]).

use super::ExtractError;
use super::check::positive;
use super::inflate::{Body, Corner};
use super::patch::Patch;
use super::polygon::Polygon;
use drypoint_scene::color::Rgba;
use drypoint_scene::style::{SourcePicture, is_inside};

/// Number of parts of a triangle for each pixel of the picture, and for each texel of the style, that its longest side
/// spans.
const DENSITY: f64 = 3.0;

/// The largest number of parts along a triangle's side.
const FINEST: f64 = 512.0;

/// The texels of a style from the area that an outline encloses. A texel is none if no place inside has its normal.
///
/// Every place counts by its area. A texel is the mean of all places with its normals. This style shows the region with
/// the smallest sum of squared differences. A region with bays has several places for one normal.
///
/// # Errors
/// The errors of [`Polygon::new`], a depth that is not positive, [`ExtractError::Outside`], [`ExtractError::Empty`].
pub(super) fn texels(
    source: &SourcePicture,
    points: &[[f64; 2]],
    depth: Option<f64>,
    side: usize,
) -> Result<Vec<Option<Rgba>>, ExtractError> {
    let polygon = Polygon::new(points)?;
    let depth = depth.map(|depth| positive("the depth", depth)).transpose()?;
    let [low, high] = polygon.bounds();
    super::overlap(source, low, high)?;
    let rows: Vec<Vec<f64>> = (0..source.height())
        .map(|j| j as f64 + 0.5)
        .map(|y| if y < low[1] || y > high[1] { Vec::new() } else { crossings(&polygon, y) })
        .collect();
    let inside = |x: f64, y: f64| rows[y as usize].partition_point(|&at| at <= x) % 2 == 1;
    let patch = Patch::new(source, low, high, inside).ok_or(ExtractError::Empty)?;
    let mut style = TexelSums { side, sums: vec![([0.0; 4], 0.0); side * side] };
    for triangle in Body::new(&polygon, depth).triangles() {
        style.add(&patch, &triangle);
    }
    Ok(style.sums.into_iter().map(|(sum, weight)| (weight > 0.0).then(|| sum.map(|s| s / weight))).collect())
}

fn crossings(polygon: &Polygon, y: f64) -> Vec<f64> {
    polygon.meetings(0, y).into_iter().map(|meeting| meeting.at).collect()
}

/// Sums for the texels of a style: for each texel Σ area · colour and Σ area.
struct TexelSums {
    side: usize,
    sums: Vec<(Rgba, f64)>,
}

impl TexelSums {
    /// Adds the places of a triangle, in parts that are small in the picture and in the style.
    fn add(&mut self, patch: &Patch, corners: &[Corner; 3]) {
        let half = self.side as f64 / 2.0;
        let mut span = 0.0f64;
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            span = span.max(distance(a.place, b.place)).max(half * distance(a.normal, b.normal));
        }
        let n = (DENSITY * span).ceil().clamp(1.0, FINEST) as usize;
        let [a, b, c] = corners;
        let area = side_of(a.place, b.place, c.place).abs() / (n * n) as f64;
        // The centroids of n² equal triangles: upright ones, and inverted ones between them.
        for row in 0..n {
            for column in 0..2 * (n - row) - 1 {
                let shift = if column % 2 == 0 { 1.0 / 3.0 } else { 2.0 / 3.0 };
                let v = ((column / 2) as f64 + shift) / n as f64;
                let w = (row as f64 + shift) / n as f64;
                let blend = |f: fn(&Corner) -> [f64; 2]| {
                    let [a, b, c] = [f(a), f(b), f(c)];
                    [0, 1].map(|k| a[k] + v * (b[k] - a[k]) + w * (c[k] - a[k]))
                };
                let [x, y] = blend(|corner| corner.place);
                let [nx, ny] = blend(|corner| corner.normal);
                if let Some(color) = patch.sample(x, y) {
                    self.put(nx, ny, color, area);
                }
            }
        }
    }

    fn put(&mut self, nx: f64, ny: f64, color: Rgba, area: f64) {
        let half = self.side as f64 / 2.0;
        let [i, j] = [(nx + 1.0) * half, (1.0 - ny) * half].map(|x| (x.max(0.0) as usize).min(self.side - 1));
        if is_inside(self.side, i, j) {
            let (sum, weight) = &mut self.sums[j * self.side + i];
            *sum = std::array::from_fn(|c| sum[c] + area * color[c]);
            *weight += area;
        }
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    ((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])).sqrt()
}

/// Twice the signed area of a triangle.
fn side_of(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
