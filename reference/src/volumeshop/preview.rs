//! Picture of a lighting transfer function on a sphere, with its table, as in Fig. 5.

use super::LightingFunction;
use crate::accumulator::Accumulator;
use crate::number::Vec3;
use drypoint_scene::color::srgb_to_linear;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use drypoint_scene::shot::LightingParams;

/// Sub-pixels along each axis of a pixel.
const PARTS: usize = 4;

/// The linear colour of the sphere.
const COLOR: [f64; 3] = [0.62, 0.42, 0.28];

/// α_u of the sphere and its |g|: eq. 8 makes it opaque where s_α is below 0.3.
const ALPHA_U: f64 = 0.8;
const MAGNITUDE: f64 = 0.5;

/// The sphere's radius, the table's side and the width of its frame, as shares of the picture's side.
const RADIUS: f64 = 0.4;
const TABLE: f64 = 0.28;
const FRAME: f64 = 0.005;

/// The layer `beauty` of a square picture on white. A translucent sphere, whose eye space is the light's space, is at
/// the upper right. The framed table is at the lower left, its red, green, blue and alpha as codes of a picture. The
/// picture is antialiased by 4 × 4 samples for each pixel.
pub fn preview(params: &LightingParams, side: usize) -> Picture {
    let function = LightingFunction::new(params);
    let mut channels = vec![vec![1.0; side * side]; 4];
    for at in 0..side * side {
        let mut sum = [0.0; 3];
        let place = |k: usize, part: usize| (k as f64 + (part as f64 + 0.5) / PARTS as f64) / side as f64;
        for part in 0..PARTS * PARTS {
            let front = sample(&function, place(at % side, part % PARTS), place(at / side, part / PARTS));
            sum = [0, 1, 2].map(|c| sum[c] + front[c]);
        }
        for (channel, sum) in channels.iter_mut().zip(sum) {
            channel[at] = sum / (PARTS * PARTS) as f64;
        }
    }
    Picture { width: side, height: side, layers: vec![Layer { kind: LayerKind::Beauty, channels }] }
}

/// Linear light at a place of the picture, in shares of its side from the upper left.
fn sample(function: &LightingFunction<f64>, x: f64, y: f64) -> [f64; 3] {
    let over_white = |rgb: [f64; 3], alpha: f64| {
        let mut front = Accumulator { rgb: rgb.map(|c| c * alpha), opacity: alpha };
        front.over_premultiplied([1.0; 4]);
        front.rgb
    };
    // The sphere.
    let [nx, ny] = [(x - (1.0 - RADIUS)) / RADIUS, (RADIUS - y) / RADIUS];
    let in_front = 1.0 - nx * nx - ny * ny;
    if in_front >= 0.0 {
        let v = Vec3::new(0.0, 0.0, 1.0);
        let found = function.reflectance(Vec3::new(nx, ny, in_front.sqrt()), function.half_vector(v));
        let shown = found.color(COLOR).map(|c| c.min(1.0));
        return over_white(shown, function.opacity(ALPHA_U, &found, MAGNITUDE));
    }
    // The table in its frame: N·L to the right, N·Ĥ upwards.
    let [right, up] = [x - FRAME, 1.0 - FRAME - y];
    if [right, up].iter().all(|at| (0.0..=TABLE).contains(at)) {
        let cell = function.at(2.0 * right / TABLE - 1.0, 2.0 * up / TABLE - 1.0);
        return over_white([cell.ambient, cell.diffuse, cell.specular].map(srgb_to_linear), cell.opacity);
    }
    if right.max(up) <= TABLE + FRAME {
        return [0.2; 3];
    }
    [1.0; 3]
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::DVec3;
    use drypoint_scene::lighting::LightingTable;
    use drypoint_scene::shot::LightingSource;
    use std::sync::Arc;

    /// A table of one cell: both parts are constant, and the rest is white.
    #[test]
    fn a_sphere_and_its_table_on_white() {
        let table = LightingTable::new(1, 1, vec![[0.5, 0.25, 0.0, 0.5]]).unwrap();
        let source = LightingSource::File { path: "t.png".into(), table: Arc::new(table) };
        let params = LightingParams { source, divisor_floor: 1.0 / 64.0, light: DVec3::Z };
        let picture = preview(&params, 100);
        let pixel = |x: usize, y: usize| [0, 1, 2, 3].map(|c| picture.layers[0].channels[c][y * 100 + x]);
        // The divisor is min(1, ½ + ½), and c = ¾ c_u.
        let sphere = pixel(60, 40);
        for c in 0..3 {
            let expected = ALPHA_U * 0.75 * COLOR[c] + (1.0 - ALPHA_U);
            assert!((sphere[c] - expected).abs() < 1e-14, "{sphere:?}");
        }
        let table = pixel(5, 95);
        for (c, code) in [0.5, 0.25, 0.0].into_iter().enumerate() {
            assert!((table[c] - (0.5 * srgb_to_linear(code) + 0.5)).abs() < 1e-14, "{table:?}");
        }
        assert_eq!([pixel(5, 5), pixel(95, 95), pixel(35, 95)], [[1.0; 4]; 3]);
        assert_eq!(sphere[3], 1.0);
    }
}
