//! Tube tree: a vessel that forks again and again.
//!
//! f = max over the tubes of r − dist(p, segment). Each fork follows C. D. Murray: The physiological principle of
//! minimum work, 1926: radii r₀³ = 2 r₁³, and so an angle θ with cos θ = 2^(−1/3) between parent and child (37.5°);
//! lengths shrink like radii, and each fork's plane is a right angle from the last. Outside the tubes −f is exactly the
//! distance to the surface; inside, f is the distance to the surface of the tube that p lies deepest in. A tube has the
//! curvatures 1/ρ and 0, and 1/ρ and 1/ρ at its round ends.

use super::jet::{Scalar, length, length_squared};
use super::params::{About, Allowed, HIGH, Param, Preset, W};
use super::placed::Formula;
use glam::DVec3;

pub(super) const TUBE_TREE: About = About {
    name: "tube-tree",
    doc: "distance to a tree of round tubes that forks by Murray's law",
    params: &[
        Param { name: "R", doc: "radius of the stem", default: Preset::Side(0.05), allowed: Allowed::Positive },
        Param { name: "h", doc: "length of the stem", default: Preset::Side(0.26), allowed: Allowed::Positive },
        Param {
            name: "n",
            doc: "levels: the tree has 2ⁿ − 1 tubes",
            default: Preset::Number(6.0),
            allowed: Allowed::Whole(1.0, 10.0),
        },
        W,
        HIGH,
    ],
    build: |args| {
        let [radius, stem, levels, w, high] = args.values();
        Ok(args.distance(TubeTree::new(radius, stem, levels as u32), w, high))
    },
};

/// 2^(−1/3): the ratio of radii and lengths, and the cosine of a fork's half angle.
const MURRAY: f64 = 0.793_700_525_984_099_7;

/// A tube, and a ball that holds it with all that grows from it.
struct Tube {
    from: DVec3,
    to: DVec3,
    radius: f64,
    ball: f64,
}

impl Tube {
    /// r − the distance to the segment.
    fn at<S: Scalar>(&self, p: [S; 3]) -> S {
        let along = (self.to - self.from).to_array();
        let [x, y, z]: [S; 3] = std::array::from_fn(|i| p[i] - self.from.to_array()[i]);
        let t = (x * along[0] + y * along[1] + z * along[2]) * (1.0 / (self.to - self.from).length_squared());
        let t = t.max(S::constant(0.0)).min(S::constant(1.0));
        S::constant(self.radius) - length([x - t * along[0], y - t * along[1], z - t * along[2]])
    }

    /// An upper bound of the values at p of all tubes that grow from here.
    fn bound(&self, p: [f64; 3]) -> f64 {
        let away = length_squared(std::array::from_fn::<_, 3, _>(|i| p[i] - self.to.to_array()[i])).sqrt();
        // The slack is for the rounding of both sides.
        self.ball - away * (1.0 - 1e-12)
    }
}

/// The tubes as a heap: those that fork from tube i are 2i + 1 and 2i + 2.
struct TubeTree {
    tubes: Vec<Tube>,
}

impl TubeTree {
    fn new(radius: f64, stem: f64, levels: u32) -> Self {
        let count = (1usize << levels) - 1;
        let fork = |parent: &Tube, side: DVec3, sign: f64| {
            let run = parent.to - parent.from;
            let sine = (1.0 - MURRAY * MURRAY).sqrt();
            let step = (run * MURRAY + side * (sign * sine * run.length())) * MURRAY;
            Tube { from: parent.to, to: parent.to + step, radius: parent.radius * MURRAY, ball: 0.0 }
        };
        // The whole tree is about 2.9 stems high; the stem starts so that it stands in the middle.
        let foot = DVec3::new(0.0, 0.0, -1.45 * stem);
        let mut tubes = vec![Tube { from: foot, to: foot + DVec3::Z * stem, radius, ball: 0.0 }];
        let mut sides = vec![DVec3::X];
        for i in 1..count {
            let (parent, side) = (&tubes[(i - 1) / 2], sides[(i - 1) / 2]);
            let tube = fork(parent, side, if i % 2 == 1 { 1.0 } else { -1.0 });
            sides.push((parent.to - parent.from).cross(side).normalize());
            tubes.push(tube);
        }
        for i in (0..count).rev() {
            let own = (tubes[i].to - tubes[i].from).length() + tubes[i].radius;
            let child = |j: usize| tubes.get(j).map_or(0.0, |c| c.ball + (c.to - tubes[i].to).length());
            tubes[i].ball = own.max(child(2 * i + 1)).max(child(2 * i + 2)) * (1.0 + 1e-12);
        }
        Self { tubes }
    }

    /// The first tube with the largest value at p, among `i` and all that grows from it.
    fn best(&self, i: usize, p: [f64; 3], found: &mut (f64, usize)) {
        let Some(tube) = self.tubes.get(i) else { return };
        if tube.bound(p) <= found.0 {
            return;
        }
        let value = tube.at(p);
        if value > found.0 {
            *found = (value, i);
        }
        self.best(2 * i + 1, p, found);
        self.best(2 * i + 2, p, found);
    }
}

impl Formula for TubeTree {
    fn at<S: Scalar>(&self, p: [S; 3]) -> S {
        let mut found = (f64::NEG_INFINITY, 0);
        self.best(0, p.map(S::real), &mut found);
        self.tubes[found.1].at(p)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{assert_near, made, points, unit_grid};
    use super::*;

    #[test]
    fn the_stem_by_hand() {
        let (tree, centre) = made("tube-tree", &[("R", 0.05), ("h", 0.26), ("n", 1.0)]);
        // The stem stands on z = −0.377 and ends at −0.117.
        assert_near(tree.value(centre + DVec3::new(0.03, 0.04, -0.2)), 0.0, 1e-16);
        assert_near(tree.value(centre + DVec3::new(0.0, 0.0, 0.083)), -0.15, 1e-15);
        let [k1, k2] = tree.curvatures(centre + DVec3::new(0.0, 0.1, -0.2)).unwrap();
        assert_near(k1, 10.0, 1e-13);
        assert_near(k2, 0.0, 1e-13);
        assert_near(tree.curvatures(centre + DVec3::new(0.0, 0.0, 0.083)).unwrap()[1], 5.0, 1e-13);
    }

    #[test]
    fn forks_follow_murray() {
        let tree = TubeTree::new(0.05, 0.26, 5);
        assert_eq!(tree.tubes.len(), 31);
        for i in 1..31 {
            let (child, parent) = (&tree.tubes[i], &tree.tubes[(i - 1) / 2]);
            assert_near(2.0 * child.radius.powi(3), parent.radius.powi(3), 1e-18);
            let (u, v) = (child.to - child.from, parent.to - parent.from);
            assert_near(u.dot(v) / (u.length() * v.length()), MURRAY, 1e-15);
            assert_near(u.length(), v.length() * MURRAY, 1e-15);
        }
    }

    #[test]
    fn pruning_changes_nothing() {
        let tree = TubeTree::new(0.05, 0.26, 7);
        for p in points(&unit_grid(), 500) {
            let p = (p - unit_grid().centre()).to_array();
            let all = tree.tubes.iter().map(|tube| tube.at(p)).fold(f64::NEG_INFINITY, f64::max);
            assert_eq!(tree.at(p), all);
        }
    }
}
