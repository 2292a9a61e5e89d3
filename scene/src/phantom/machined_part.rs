//! Machined part: an angle bracket milled and drilled from a block, boxes minus boxes minus cylinders.
//!
//! f = min(d_block, −d_cut …, −d_hole …), each d the exact signed distance of a box or of an endless cylinder. Inside
//! the part f is exactly the distance to its surface: a ball inside the block that meets no cut lies in the part.
//! Outside, −f never exceeds the distance. It is the distance except where the nearest point lies on an edge between
//! two of the bodies. f has kinks; its faces are flat or cylindrical: curvatures 0 and 0, or −1/r in the holes.

use super::jet::{Scalar, length};
use super::params::{About, Allowed, HIGH, Param, Preset, W};
use super::placed::Formula;

pub(super) const MACHINED_PART: About = About {
    name: "machined-part",
    doc: "distance to an angle bracket: a block minus boxes minus cylinders",
    params: &[
        Param { name: "s", doc: "length of the block", default: Preset::Side(0.8), allowed: Allowed::Positive },
        W,
        HIGH,
    ],
    build: |args| {
        let [s, w, high] = args.values();
        Ok(args.distance(MachinedPart { s }, w, high))
    },
};

/// Lowest and highest corner, in block lengths.
type Corners = [[f64; 3]; 2];

const BLOCK: Corners = [[-0.5, -0.4, -0.4], [0.5, 0.4, 0.4]];

/// Boxes milled away: the corner over the base, and a groove under it.
const CUTS: [Corners; 2] = [[[-0.28, -1.0, -0.16], [1.0, 1.0, 1.0]], [[-1.0, -0.14, -1.0], [1.0, 0.14, -0.31]]];

/// Holes drilled: axis, the two other coordinates of the centre in ascending order of axes, radius.
const HOLES: [(usize, [f64; 2], f64); 6] = [
    (0, [0.0, 0.12], 0.15),     // the bore through the wall
    (1, [-0.39, 0.335], 0.035), // a pin along the wall's top
    (2, [-0.02, -0.27], 0.07),
    (2, [-0.02, 0.27], 0.07),
    (2, [0.34, -0.27], 0.07),
    (2, [0.34, 0.27], 0.07),
];

struct MachinedPart {
    s: f64,
}

/// Exact distance to a box, positive inside.
fn cuboid<S: Scalar>(p: [S; 3], [lo, hi]: Corners, s: f64) -> S {
    // Distance outside the slab of each axis.
    let q: [S; 3] = std::array::from_fn(|i| (p[i] - 0.5 * (lo[i] + hi[i]) * s).abs() - 0.5 * (hi[i] - lo[i]) * s);
    let most = q[0].max(q[1]).max(q[2]);
    if most.real() <= 0.0 {
        return -most;
    }
    let zero = S::constant(0.0);
    -length(q.map(|x| x.max(zero)))
}

impl Formula for MachinedPart {
    fn at<S: Scalar>(&self, p: [S; 3]) -> S {
        let s = self.s;
        let milled = CUTS.into_iter().fold(cuboid(p, BLOCK, s), |d, cut| d.min(-cuboid(p, cut, s)));
        HOLES.into_iter().fold(milled, |d, (axis, [u, v], r)| {
            let [a, b] = [[1, 2], [0, 2], [0, 1]][axis];
            d.min(length([p[a] - u * s, p[b] - v * s]) - r * s)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{assert_near, made};
    use glam::DVec3;

    #[test]
    fn distances_by_hand() {
        let (part, centre) = made("machined-part", &[("s", 1.0)]);
        for (x, y, z, d) in [
            (0.6, 0.0, -0.2, -0.1),                        // beside the base
            (0.2, 0.0, -0.2, 0.04),                        // in the base, below its top
            (0.16, 0.27, -0.24, 0.08),                     // between two bolts, base top is nearest
            (0.34, 0.27, -0.3, -0.07),                     // on a bolt's axis
            (-0.4, 0.0, 0.12, -0.15),                      // on the bore's axis
            (-0.4, 0.2, 0.12, 0.05),                       // beside the bore
            (0.8, 0.44 + 0.26, -0.28, -0.3 * 2f64.sqrt()), // off a vertical edge of the block
            (0.0, 0.0, -0.36, -0.05),                      // in the groove
        ] {
            assert_near(part.value(centre + DVec3::new(x, y, z)), d, 1e-15);
        }
        // A hole's wall is curved towards its axis.
        let [k1, k2] = part.curvatures(centre + DVec3::new(0.34 - 0.08, 0.27, -0.25)).unwrap();
        assert_near(k1, 0.0, 1e-13);
        assert_near(k2, -1.0 / 0.08, 1e-12);
    }
}
