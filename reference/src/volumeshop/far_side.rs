//! The far side of an oriented box on a ray ([VS-7]).

use drypoint_scene::glam::DVec3;

/// The depths at which the line `origin + along · depth` enters and leaves a closed box, all in the box's own axes.
/// Returns none if the line misses the box. A line in the box's surface meets it.
pub fn through_box([origin, along]: [DVec3; 2], [lo, hi]: [DVec3; 2]) -> Option<[f64; 2]> {
    let mut range = [f64::NEG_INFINITY, f64::INFINITY];
    for axis in 0..3 {
        let (o, d) = (origin[axis], along[axis]);
        if d == 0.0 {
            if o < lo[axis] || o > hi[axis] {
                return None;
            }
            continue;
        }
        let (a, b) = ((lo[axis] - o) / d, (hi[axis] - o) / d);
        range = [range[0].max(a.min(b)), range[1].min(a.max(b))];
    }
    (range[0] <= range[1]).then_some(range)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn by_hand() {
        let unit = [DVec3::ZERO, DVec3::ONE];
        let through = |origin: [f64; 3], along: [f64; 3]| through_box([origin.into(), along.into()], unit);
        assert_eq!(through([-1.0, 0.5, 0.5], [1.0, 0.0, 0.0]), Some([1.0, 2.0]));
        assert_eq!(through([-1.0, 0.5, 0.5], [-1.0, 0.0, 0.0]), Some([-2.0, -1.0]));
        assert_eq!(through([-1.0, -1.0, 0.5], [1.0, 1.0, 0.0]), Some([1.0, 2.0]));
        assert_eq!(through([-1.0, 0.0, 0.0], [1.0, 1.5, 0.0]), None);
        assert_eq!(through([-1.0, 1.0, 0.0], [2.0, 0.0, 0.0]), Some([0.5, 1.0]), "along an edge");
        assert_eq!(through([-1.0, 1.5, 0.5], [1.0, 0.0, 0.0]), None);
        assert_eq!(through([0.5; 3], [0.0, 0.0, 0.25]), Some([-2.0, 2.0]), "from inside");
    }
}
