//! Strokes that fill dots larger than the nib.

use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{Dot, Polyline, Vertex, on_step};
use drypoint_scene::math::{cos, sin};
use std::f64::consts::TAU;

/// Largest overhang of the nib beyond the dot's rim, in mm: half the step of radii.
const SLACK: f64 = 0.0025;

/// Pitch of the spiral, in nibs. Turns overlap, so that no paper shows between them.
const PITCH: f64 = 0.8;

/// Largest distance of a chord from its curve, in mm.
const CHORD: f64 = 0.005;

/// Returns the stroke that fills a dot with a nib of that width. The stroke is a circle along the rim. If the circle
/// leaves a hole, a spiral from the centre precedes it. None for a dot that one touch of the nib fills.
pub(super) fn stroke(dot: &Dot, nib: f64) -> Option<Polyline> {
    let rim = dot.radius - nib / 2.0;
    if rim <= SLACK || nib <= 0.0 {
        return None;
    }
    // Points as (distance from the centre, turns). First the spiral, if one circle leaves a hole; then the circle along
    // the rim.
    let mut places = Vec::new();
    if rim > nib / 2.0 {
        let turns = (rim / (PITCH * nib)).ceil();
        let steps = (turns * steps_of(rim)).ceil();
        places.extend((0..steps as usize).map(|i| i as f64 / steps).map(|s| (s * rim, s * turns)));
    }
    let steps = steps_of(rim);
    places.extend((0..=steps as usize).map(|i| (rim, i as f64 / steps)));
    let last = (places.len() - 1) as f64;
    let vertex = |(i, (radius, turn)): (usize, (f64, f64))| Vertex {
        at: on_step(dot.at + radius * DVec2::new(cos(TAU * turn), sin(TAU * turn))),
        world: dot.world,
        radius: nib / 2.0,
        opacity: 1.0,
        t: i as f64 / last,
        color: None,
    };
    Some(Polyline { vertices: places.into_iter().enumerate().map(vertex).collect(), closed: false })
}

/// Returns an upper bound of the number of vertices of [`stroke`].
pub(super) fn vertices(dot: &Dot, nib: f64) -> f64 {
    let rim = dot.radius - nib / 2.0;
    if rim <= SLACK || nib <= 0.0 {
        return 0.0;
    }
    let turns = if rim > nib / 2.0 { (rim / (PITCH * nib)).ceil() } else { 0.0 };
    (turns + 1.0) * steps_of(rim) + 2.0
}

/// Returns the steps of a turn of that radius. A chord over the angle 2φ lies r(1 − cos φ) ≈ rφ²/2 off its arc.
fn steps_of(radius: f64) -> f64 {
    (TAU / (2.0 * (2.0 * CHORD / radius).sqrt())).ceil().max(8.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::coverage;
    use drypoint_scene::glam::DVec3;
    use std::f64::consts::PI;

    fn dot(radius: f64) -> Dot {
        Dot { at: DVec2::splat(2.0), world: DVec3::ONE, radius, opacity: 1.0 }
    }

    #[test]
    fn the_nib_inks_the_whole_dot() {
        // At 100 px a mm: no hole, and the disc's area within the chord's share of the rim and a rasterizer's tenth.
        for radius in [0.2, 0.29, 0.31, 0.5, 0.9, 1.7] {
            let line = stroke(&dot(radius), 0.3).unwrap();
            let places: Vec<[f64; 2]> = line.vertices.iter().map(|v| (v.at * 100.0).to_array()).collect();
            let cover = coverage(400, 400, &[places], 30.0);
            let area = cover.iter().sum::<f64>() / 1e4;
            let bound = TAU * radius * CHORD + 0.002;
            assert!((area - PI * radius * radius).abs() < bound, "{radius}: {area}");
            let inside = (radius - CHORD - 0.015) * 100.0;
            for (i, covered) in cover.iter().enumerate() {
                let (x, y) = ((i % 400) as f64 + 0.5 - 200.0, (i / 400) as f64 + 0.5 - 200.0);
                assert!(x * x + y * y > inside * inside || *covered > 0.99, "{radius}: a hole at {x}, {y}");
            }
        }
    }

    #[test]
    fn the_nib_itself_is_a_touch() {
        for radius in [0.05, 0.15, 0.152] {
            assert_eq!(stroke(&dot(radius), 0.3), None);
        }
        let line = stroke(&dot(0.155), 0.3).unwrap();
        assert!(line.vertices.iter().all(|v| v.world == DVec3::ONE && v.radius == 0.15));
    }
}
