//! Tone from spacing, for pens of one width ([HATCH-19]; after Jobard and Lefer, *Creating Evenly-Spaced Streamlines
//! of Arbitrary Density*, 1997).
//!
//! Lines arrive with their tone as opacity and leave opaque. Where the tone is τ, their mean distance is the pen's
//! width over τ. Suppose parallel lines are accepted in some order, if they are farther than d from all accepted
//! ones. Then their mean distance is d/0.7476 (Rényi 1958, the parking problem). So d is 0.7476 times the wanted
//! distance.

use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{Polyline, Vertex};

/// Rényi's constant: the filled share of a street on which cars park at random.
const RENYI: f64 = 0.747_597_920_253_411_4;

/// Share of d at which a line ends. A line begins where it is farther than d from all others, and ends where it is
/// nearer than this share of d. The gain makes up for gaps before the ends of other lines and for changing distances.
const GOES_ON: f64 = 0.88;

/// The wanted distance of lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LineDistance {
    /// The pen's width over the tone, which is a line's opacity. Tones below `least` are not drawn.
    Tone {
        /// The faintest tone.
        least: f64,
    },
    /// A constant distance, in mm. Tone 0 is white.
    Everywhere(f64),
}

impl LineDistance {
    /// The wanted distance at the tone τ; none if nothing is drawn.
    fn at(self, nib: f64, tone: f64) -> Option<f64> {
        match self {
            Self::Tone { least } => (tone >= least).then(|| nib / tone.min(1.0)),
            Self::Everywhere(d) => (tone > 0.0).then_some(d),
        }
    }

    /// The largest distance.
    fn most(self, nib: f64) -> f64 {
        match self {
            Self::Tone { least } => nib / least,
            Self::Everywhere(d) => d,
        }
    }
}

/// A page on which lines keep their distance from each other.
pub struct LineSpacing {
    paper: NearestPlaces,
    nib: f64,
    apart: LineDistance,
    shortest: f64,
}

impl LineSpacing {
    /// An empty page between two corners, for a nib of width `nib`. Parts of lines shorter than `shortest` are left
    /// out. All lengths are in mm.
    pub fn new(corners: [DVec2; 2], nib: f64, apart: LineDistance, shortest: f64) -> Self {
        Self { paper: NearestPlaces::new(corners, nib, RENYI * apart.most(nib)), nib, apart, shortest }
    }

    /// The least distance of lines, at tone 1.
    pub(super) fn least(&self) -> f64 {
        RENYI * self.apart.at(self.nib, 1.0).unwrap_or(self.nib)
    }

    /// Whether a line may begin at a place where the tone is τ.
    pub fn is_open(&self, at: DVec2, tone: f64) -> bool {
        !self.paper.is_closed(at) && self.distance(tone).is_some_and(|d| self.paper.is_free(at, d))
    }

    /// Forbids lines to begin within a nib's width of a place.
    pub fn close(&mut self, at: DVec2) {
        self.paper.close(at);
    }

    fn distance(&self, tone: f64) -> Option<f64> {
        self.apart.at(self.nib, tone).map(|d| RENYI * d)
    }

    /// Whether a part of the lines would be accepted, each line taken alone.
    pub fn has_room(&self, lines: &[Polyline]) -> bool {
        lines.iter().any(|line| self.parts(line).next().is_some())
    }

    /// Parts of a line that are far enough from all accepted lines.
    fn parts(&self, line: &Polyline) -> impl Iterator<Item = Polyline> {
        let parts =
            if line.length() < self.shortest { Vec::new() } else { self.paper.free(line, |tone| self.distance(tone)) };
        let parts = parts.into_iter().map(|vertices| Polyline { vertices, closed: false });
        parts.filter(|part| part.length() >= self.shortest)
    }

    /// Accepts the parts of lines that are far enough from all earlier ones, longest lines first. Returns these parts
    /// with the nib's width.
    pub fn add(&mut self, lines: &[Polyline]) -> Vec<Polyline> {
        let mut order: Vec<(f64, &Polyline)> = lines.iter().map(|line| (line.length(), line)).collect();
        order.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut kept = Vec::new();
        for (_, line) in order {
            let parts: Vec<Polyline> = self.parts(line).collect();
            for mut part in parts {
                self.paper.take(&part);
                for vertex in &mut part.vertices {
                    (vertex.radius, vertex.opacity) = (self.nib / 2.0, 1.0);
                }
                kept.push(part);
            }
        }
        kept
    }
}

/// The largest number of cells along a side.
const MOST: f64 = 4096.0;

/// Index for no place nearby.
const NONE: u32 = u32::MAX;

/// The places of accepted lines, and for each cell of a raster the nearest of them.
struct NearestPlaces {
    first: DVec2,
    /// Side of a cell, and distance of places along a line, in mm.
    cell: f64,
    dims: [usize; 2],
    /// Largest distance at which a line affects others, in mm.
    reach: f64,
    near: Vec<u32>,
    places: Vec<DVec2>,
    /// Cells in which no line may begin.
    closed: Vec<bool>,
}

impl NearestPlaces {
    fn new([first, last]: [DVec2; 2], nib: f64, reach: f64) -> Self {
        let cell = (0.5 * nib).max((last - first).max_element() / MOST);
        let dims = [last.x - first.x, last.y - first.y].map(|length| (length / cell) as usize + 1);
        let cells = dims[0] * dims[1];
        Self { first, cell, dims, reach, near: vec![NONE; cells], places: Vec::new(), closed: vec![false; cells] }
    }

    fn is_closed(&self, at: DVec2) -> bool {
        let [x, y] = self.cell_of(at);
        self.closed[x + y * self.dims[0]]
    }

    fn close(&mut self, at: DVec2) {
        let [x, y] = self.cell_of(at);
        for j in about(y, 1, self.dims[1]) {
            for i in about(x, 1, self.dims[0]) {
                self.closed[i + j * self.dims[0]] = true;
            }
        }
    }

    fn cell_of(&self, at: DVec2) -> [usize; 2] {
        let inside = |x: f64, n: usize| ((x / self.cell) as usize).min(n - 1);
        [inside(at.x - self.first.x, self.dims[0]), inside(at.y - self.first.y, self.dims[1])]
    }

    /// Whether a place is at least `d` from all accepted lines.
    fn is_free(&self, at: DVec2, d: f64) -> bool {
        let [x, y] = self.cell_of(at);
        // The place nearest to a cell's middle need not be nearest to every point of the cell. So the eight
        // neighbours are tested, too.
        about(y, 1, self.dims[1]).flat_map(|j| about(x, 1, self.dims[0]).map(move |i| (i, j))).all(|(i, j)| {
            let near = self.near[i + j * self.dims[0]];
            near == NONE || self.places[near as usize].distance_squared(at) >= d * d
        })
    }

    /// Returns the parts of a line that may continue and that contain a place at which a line may begin. `apart` maps
    /// a tone to its distance; places without a distance end a part.
    fn free(&self, line: &Polyline, apart: impl Fn(f64) -> Option<f64>) -> Vec<Vec<Vertex>> {
        let mut parts = Vec::new();
        let (mut part, mut begins) = (Vec::<Vertex>::new(), false);
        let joined = line.closed.then(|| line.vertices.first().map(|v| Vertex { t: 1.0, ..*v })).flatten();
        let vertices: Vec<Vertex> = line.vertices.iter().copied().chain(joined).collect();
        for (k, pair) in vertices.windows(2).enumerate() {
            let steps = self.steps(pair[0].at, pair[1].at);
            for step in usize::from(k > 0)..=steps {
                let place = pair[0].between(&pair[1], step as f64 / steps as f64);
                let wanted = apart(place.opacity);
                if wanted.is_some_and(|d| self.is_free(place.at, GOES_ON * d)) {
                    begins = begins || wanted.is_some_and(|d| self.is_free(place.at, d));
                    // Places inside a straight segment are dropped; its ends are kept.
                    if part.len() > 1 && step > 1 {
                        part.pop();
                    }
                    part.push(place);
                } else {
                    let ended = std::mem::take(&mut part);
                    if std::mem::take(&mut begins) {
                        parts.push(ended);
                    }
                }
            }
        }
        if begins {
            parts.push(part);
        }
        parts.retain(|part| part.len() > 1);
        parts
    }

    /// Number of steps along a straight segment; a step is at most one cell long.
    fn steps(&self, a: DVec2, b: DVec2) -> usize {
        ((a.distance(b) / self.cell).ceil() as usize).max(1)
    }

    /// Marks the places of an accepted line.
    fn take(&mut self, line: &Polyline) {
        for pair in line.vertices.windows(2) {
            let steps = self.steps(pair[0].at, pair[1].at);
            for step in 0..=steps {
                self.put(pair[0].at.lerp(pair[1].at, step as f64 / steps as f64));
            }
        }
    }

    fn put(&mut self, at: DVec2) {
        let number = self.places.len() as u32;
        self.places.push(at);
        let cells = (self.reach / self.cell).ceil() as usize + 1;
        let [x, y] = self.cell_of(at);
        for j in about(y, cells, self.dims[1]) {
            for i in about(x, cells, self.dims[0]) {
                let middle = self.first + DVec2::new(i as f64 + 0.5, j as f64 + 0.5) * self.cell;
                let near = &mut self.near[i + j * self.dims[0]];
                let nearer = |other: u32| self.places[other as usize].distance_squared(middle);
                if *near == NONE || at.distance_squared(middle) < nearer(*near) {
                    *near = number;
                }
            }
        }
    }
}

/// The cells of a row within `cells` of cell i.
fn about(i: usize, cells: usize, n: usize) -> std::ops::Range<usize> {
    i.saturating_sub(cells)..(i + cells + 1).min(n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::DVec3;
    use drypoint_scene::philox::uniforms;

    const NIB: f64 = 0.3;

    /// Adds all lines at once.
    fn spread(lines: &[Polyline], apart: LineDistance, shortest: f64) -> Vec<Polyline> {
        LineSpacing::new([DVec2::splat(-10.0), DVec2::splat(90.0)], NIB, apart, shortest).add(lines)
    }

    fn line(from: DVec2, to: DVec2, tone: impl Fn(DVec2) -> f64) -> Polyline {
        let vertex = |k: usize| {
            let t = k as f64 / 20.0;
            let at = from.lerp(to, t);
            Vertex { at, world: DVec3::ZERO, radius: 0.0, opacity: tone(at), t, color: None }
        };
        Polyline { vertices: (0..=20).map(vertex).collect(), closed: false }
    }

    /// Nearly horizontal lines over 60 × 60 mm.
    fn lines(n: u32, tone: impl Fn(DVec2) -> f64) -> Vec<Polyline> {
        let of = |k: u32| {
            let [y, x, length, _] = uniforms(9, [k, 0, 0], 0);
            let from = DVec2::new(70.0 * x - 10.0, 60.0 * y);
            line(from, from + DVec2::new(10.0 + 10.0 * length, 0.0), &tone)
        };
        (0..n).map(of).collect()
    }

    /// The total length of lines between two x, times the nib, over the area.
    fn ink(lines: &[Polyline], [from, to]: [f64; 2]) -> f64 {
        let inside = |pair: &[Vertex]| (pair[0].at.x.max(from)..pair[1].at.x.min(to)).len_f64();
        lines.iter().flat_map(|line| line.vertices.windows(2).map(inside)).sum::<f64>() * NIB / (60.0 * (to - from))
    }

    trait Length {
        fn len_f64(&self) -> f64;
    }

    impl Length for std::ops::Range<f64> {
        fn len_f64(&self) -> f64 {
            (self.end - self.start).max(0.0)
        }
    }

    fn distance(a: &Polyline, b: &Polyline) -> f64 {
        let one_way = |a: &Polyline, b: &Polyline| {
            let to_piece = |at: DVec2, pair: &[Vertex]| {
                let (from, along) = (pair[0].at, pair[1].at - pair[0].at);
                let s = ((at - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
                at.distance(from + along * s)
            };
            a.vertices
                .iter()
                .flat_map(|v| b.vertices.windows(2).map(|pair| to_piece(v.at, pair)))
                .fold(f64::MAX, f64::min)
        };
        one_way(a, b).min(one_way(b, a))
    }

    /// The printed tone is within ±0.05 of the wanted one, from 0.1 to 0.8.
    #[test]
    fn flat_tones_print_as_they_are_wanted() {
        for tone in [0.1, 0.2, 0.35, 0.5, 0.65, 0.8] {
            let all = lines(12_000, |_| tone);
            let kept = spread(&all, LineDistance::Tone { least: 0.05 }, 1.0);
            let found = ink(&kept, [10.0, 50.0]);
            assert!((found - tone).abs() <= 0.05, "{tone}: {found}");
        }
    }

    #[test]
    fn a_ramp_prints_as_it_is_wanted() {
        let tone = |at: DVec2| (0.8 * at.x / 60.0).clamp(0.0, 1.0);
        let kept = spread(&lines(30_000, tone), LineDistance::Tone { least: 0.05 }, 0.6);
        for k in 1..8 {
            let range = [60.0 / 8.0 * f64::from(k), 60.0 / 8.0 * f64::from(k + 1)];
            let wanted = tone(DVec2::new(0.5 * (range[0] + range[1]), 0.0));
            let found = ink(&kept, range);
            assert!((found - wanted).abs() <= 0.05, "{wanted}: {found}");
        }
    }

    /// Parts of different lines come no nearer than 0.88 d, less the spacing of places along a line. The spacing is
    /// half a nib, so the distance across is at least √((0.88 d)² − (nib/4)²).
    #[test]
    fn lines_keep_their_distance() {
        let slanted = |k: u32| {
            let [x, y, a, _] = uniforms(4, [k, 0, 0], 0);
            let from = DVec2::new(20.0 * x, 20.0 * y);
            line(from, from + 8.0 * DVec2::new(a - 0.5, 1.0 - a), |_| 0.3)
        };
        let kept = spread(&(0..800).map(slanted).collect::<Vec<_>>(), LineDistance::Tone { least: 0.05 }, 0.5);
        assert!(kept.len() > 20, "{}", kept.len());
        let d = GOES_ON * RENYI * NIB / 0.3;
        let bound = (d * d - NIB * NIB / 16.0).sqrt() - 1e-9;
        for (i, a) in kept.iter().enumerate() {
            for b in &kept[..i] {
                // Parts of one line follow each other on it.
                let one = a.vertices[0].at.distance(b.vertices[0].at) < 8.0 && distance(a, b) < bound;
                assert!(!one || same_line(a, b), "{}", distance(a, b));
            }
        }
    }

    fn same_line(a: &Polyline, b: &Polyline) -> bool {
        let direction = |l: &Polyline| (l.vertices[l.vertices.len() - 1].at - l.vertices[0].at).normalize();
        let between = b.vertices[0].at - a.vertices[0].at;
        direction(a).perp_dot(direction(b)).abs() < 1e-9 && direction(a).perp_dot(between).abs() < 1e-9
    }

    #[test]
    fn a_length_is_a_distance_everywhere_and_white_is_white() {
        let kept = spread(&lines(30_000, |at| if at.x < 30.0 { 0.9 } else { 0.0 }), LineDistance::Everywhere(1.5), 1.0);
        assert!((ink(&kept, [5.0, 25.0]) - NIB / 1.5).abs() < 0.02);
        assert_eq!(ink(&kept, [33.0, 60.0]), 0.0);
        assert!(kept.iter().flat_map(|l| &l.vertices).all(|v| v.opacity == 1.0 && v.radius == NIB / 2.0));
    }

    #[test]
    fn nothing_and_one() {
        assert!(spread(&[], LineDistance::Everywhere(1.0), 0.0).is_empty());
        let alone = line(DVec2::ZERO, DVec2::new(5.0, 2.0), |_| 0.5);
        let kept = spread(std::slice::from_ref(&alone), LineDistance::Tone { least: 0.05 }, 1.0);
        assert_eq!(kept.len(), 1);
        assert!((kept[0].length() - alone.length()).abs() < 1e-12);
        // A dash that is too short is dropped, and so is one without tone.
        assert!(spread(std::slice::from_ref(&alone), LineDistance::Everywhere(1.0), 6.0).is_empty());
        let mut page = LineSpacing::new([DVec2::ZERO, DVec2::splat(9.0)], NIB, LineDistance::Tone { least: 0.05 }, 1.0);
        assert!(page.is_open(alone.vertices[3].at, 0.5) && !page.is_open(alone.vertices[3].at, 0.01));
        page.add(std::slice::from_ref(&alone));
        assert!(!page.is_open(alone.vertices[3].at, 0.5) && page.is_open(DVec2::new(1.0, 5.0), 0.5));
        page.close(DVec2::new(1.0, 5.0));
        assert!(!page.is_open(DVec2::new(1.1, 5.0), 0.5) && page.is_open(DVec2::new(1.6, 5.0), 0.5));
        let faint = line(DVec2::ZERO, DVec2::new(5.0, 2.0), |_| 0.04);
        assert!(spread(&[faint], LineDistance::Tone { least: 0.05 }, 1.0).is_empty());
        let closed = Polyline { closed: true, ..alone };
        let kept = spread(std::slice::from_ref(&closed), LineDistance::Everywhere(1.0), 1.0);
        assert!((kept[0].length() - closed.length()).abs() < 1e-12);
    }
}
