//! Lines inside a translucent volume ([HATCH-14] d): a ray comes upon a line at the line's own depth, between samples.
//!
//! A sample stands for the way of one step about it, so the step is split there: the share of it that lies before the line is
//! composited, then the line, then the rest. Of an opacity α a step both shares leave what the whole leaves, (1 − α)^s·(1 − α)^(1−s).

use super::cast::{Cast, Walk};
use super::draw::CastAll;
use super::need::{self, Need, Needs};
use super::opacity::Correction;
use super::prepared::Prepared;
use super::skip::Boxes;
use crate::field::Sampler;
use crate::number::Real;
use drypoint_scene::counts::Counts;
use drypoint_scene::fragments::Fragment;

impl<R: Real, S: Sampler<R>> Walk<'_, '_, R, S> {
    /// Visits the samples and the lines before a depth, if one is given, in their order. Returns how many samples were evaluated,
    /// one that is split once a share, and whether the ray is still open.
    pub(super) fn run_among(
        &mut self,
        lines: &[Fragment],
        end: Option<f64>,
        boxes: Option<&mut Boxes>,
        counts: &mut Counts,
    ) -> (u64, bool) {
        match self.prepared.needs {
            Needs::Value => self.run_among_with::<need::Value>(lines, end, boxes, counts),
            Needs::Normal => self.run_among_with::<need::Normal>(lines, end, boxes, counts),
            Needs::Anything => self.run_among_with::<need::Anything>(lines, end, boxes, counts),
        }
    }

    /// Puts lines before a depth over each other, where nothing lies between them. Returns whether the ray is still open.
    pub(super) fn put_all(&mut self, lines: &[Fragment], end: Option<f64>) -> bool {
        before(lines, end).iter().all(|line| self.put(line.rgb.map(R::from_f64), R::from_f64(line.opacity)))
    }

    fn run_among_with<N: Need>(
        &mut self,
        lines: &[Fragment],
        end: Option<f64>,
        boxes: Option<&mut Boxes>,
        counts: &mut Counts,
    ) -> (u64, bool) {
        let mut lines = before(lines, end);
        let step = self.ray.depth_step.to_f64();
        // The sample that stands for the way up to the end.
        let last_of_all = end.map_or(i64::MAX, |depth| self.ray.last_before(depth));
        let mut samples = 0;
        for [first, last] in self.ray.visits(self.prepared.ends, self.ray.intervals(boxes)) {
            let last = last.min(last_of_all);
            let mut next = first;
            while next <= last {
                // What lies between visible bricks, where nothing is seen.
                let passed = lines.iter().take_while(|line| line.depth <= next as f64 * step).count();
                if !self.put_all(&lines[..passed], None) {
                    return (samples, false);
                }
                lines = &lines[passed..];
                let met = lines.first().map_or(i64::MAX, |line| ((line.depth / step).floor() as i64).max(next));
                let split = met.min(last_of_all);
                let ((n, open), after) = if next < split {
                    let to = last.min(split - 1);
                    (self.run::<N>([next, to], counts), to + 1)
                } else {
                    let until = end.filter(|_| split == last_of_all).unwrap_or((split + 1) as f64 * step);
                    let within = lines.iter().take_while(|line| line.depth < until).count();
                    let run = self.run_split::<N>(split, &lines[..within], until, counts);
                    lines = &lines[within..];
                    (run, split + 1)
                };
                samples += n;
                if !open {
                    return (samples, false);
                }
                next = after;
            }
        }
        (samples, self.put_all(lines, None))
    }

    /// Visits a sample in whose way lines lie: share by share.
    fn run_split<N: Need>(&mut self, k: i64, lines: &[Fragment], until: f64, counts: &mut Counts) -> (u64, bool) {
        let before = self.previous;
        let mut from = k as f64 * self.ray.depth_step.to_f64();
        let mut samples = 0;
        let depths = lines.iter().map(|line| (line.depth, Some(line))).chain([(until, None)]);
        for (depth, line) in depths {
            if depth > from {
                self.correct_over(depth - from);
                // The sample before is that of all shares.
                self.previous = before;
                let (n, open) = self.run::<N>([k, k], counts);
                samples += n;
                if !open {
                    return (samples, false);
                }
                from = depth;
            }
            if line.is_some_and(|line| !self.put_all(std::slice::from_ref(line), None)) {
                return (samples, false);
            }
        }
        self.correct_over(self.ray.depth_step.to_f64());
        (samples, true)
    }

    /// Corrects the opacities that follow for a way of so much depth.
    fn correct_over(&mut self, depth: f64) {
        let steps = depth / self.ray.depth_step.to_f64();
        self.correct_for(Correction::new(steps * self.ray.step / self.prepared.reference_length));
    }
}

/// Those before a depth.
fn before(lines: &[Fragment], end: Option<f64>) -> &[Fragment] {
    let number = end.map_or(lines.len(), |end| lines.iter().take_while(|line| line.depth < end).count());
    &lines[..number]
}

/// Casts rays with lines on them alone, and those without side by side; what comes out of each is appended in the order of the
/// points.
pub(super) fn cast_apart<R: Real>(
    prepared: &Prepared<'_, R>,
    [alone, together]: [&dyn CastAll; 2],
    points: &[[f64; 2]],
    mut boxes: Option<&mut Boxes>,
    counts: &mut Counts,
    casts: &mut Vec<Cast>,
) {
    let (with, without): (Vec<_>, Vec<_>) = points.iter().partition(|&&point| !prepared.lines_at(point).is_empty());
    let mut found = [Vec::with_capacity(with.len()), Vec::with_capacity(without.len())];
    alone(&with, boxes.as_deref_mut(), counts, &mut found[0]);
    together(&without, boxes, counts, &mut found[1]);
    let [mut with, mut without] = found.map(Vec::into_iter);
    casts.extend(
        points.iter().filter_map(
            |&point| {
                if prepared.lines_at(point).is_empty() { without.next() } else { with.next() }
            },
        ),
    );
}
