//! Lines inside a picture: their contribution to each of its rays, at its depth ([HATCH-14] d).

use crate::color::Rgb;

/// The part of a line in the part of a pixel that one ray stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fragment {
    /// Eye depth.
    pub depth: f64,
    /// The colour: linear, straight.
    pub rgb: Rgb,
    /// The covered share times the line's opacity, in (0, 1].
    pub opacity: f64,
}

/// The fragments of all rays of a picture, n×n a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Fragments {
    /// Rays of a row, and rows.
    rays: [usize; 2],
    /// n.
    samples: usize,
    /// The index of each ray's first fragment in `all`, and the end of the last.
    starts: Vec<usize>,
    all: Vec<Fragment>,
}

impl Fragments {
    /// The fragments of a picture of `size` pixels of `samples`² rays, each with the number of its ray, row by row. On
    /// each ray they are ordered from the nearest to the farthest; equal depths keep their order in `found`.
    pub fn new(size: [usize; 2], samples: usize, found: &[(usize, Fragment)]) -> Self {
        let rays = size.map(|n| n * samples);
        let mut starts = vec![0; rays[0] * rays[1] + 1];
        let inside = || found.iter().filter(|(ray, _)| *ray < rays[0] * rays[1]);
        for (ray, _) in inside() {
            starts[ray + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut all = vec![Fragment { depth: 0.0, rgb: [0.0; 3], opacity: 0.0 }; inside().count()];
        for (ray, fragment) in inside() {
            all[next[*ray]] = *fragment;
            next[*ray] += 1;
        }
        for ends in starts.windows(2) {
            // A stable sort keeps the order of equal depths.
            all[ends[0]..ends[1]].sort_by(|a, b| a.depth.total_cmp(&b.depth));
        }
        Self { rays, samples, starts, all }
    }

    /// The fragments of the ray through a point of the picture, in pixels from the top left corner.
    pub fn at(&self, point: [f64; 2]) -> &[Fragment] {
        let [column, row] = point.map(|x| (x * self.samples as f64) as usize);
        let ray = row * self.rays[0] + column;
        let inside = column < self.rays[0] && row < self.rays[1];
        if inside { &self.all[self.starts[ray]..self.starts[ray + 1]] } else { &[] }
    }

    /// Number of fragments.
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(self.starts.as_slice()) + size_of_val(self.all.as_slice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fragment(depth: f64, red: f64) -> Fragment {
        Fragment { depth, rgb: [red, 0.0, 0.0], opacity: 0.5 }
    }

    /// Two pixels in a row, four rays each: those of ray 5, in the lower row, come by depth, and of equal depths the first
    /// first.
    #[test]
    fn each_ray_has_its_own_by_depth() {
        let found = [
            (5, fragment(3.0, 0.1)),
            (0, fragment(1.0, 0.2)),
            (5, fragment(2.0, 0.3)),
            (5, fragment(3.0, 0.4)),
            (8, fragment(0.0, 0.5)),
        ];
        let fragments = Fragments::new([2, 1], 2, &found);
        let reds = |point| fragments.at(point).iter().map(|f| f.rgb[0]).collect::<Vec<_>>();
        assert_eq!(reds([0.75, 0.75]), [0.3, 0.1, 0.4]);
        assert_eq!((reds([0.25, 0.25]), reds([1.75, 0.75]), reds([2.25, 0.25])), (vec![0.2], vec![], vec![]));
        // One that belongs to no ray is left out.
        assert_eq!((fragments.len(), fragments.is_empty()), (4, false));
        assert!(Fragments::new([2, 1], 1, &[]).is_empty());
    }
}
