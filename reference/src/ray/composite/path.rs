//! The path of a ray: everything that it meets, front to back, before any sample is evaluated.

use crate::mesh::MeshHit;
use crate::number::Real;
use crate::ray::lattice::IndexRay;
use crate::surface::SurfaceHit;
use drypoint_scene::fragments::Fragment;

/// One step of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Step<'l> {
    /// Whole samples first..=last.
    Samples([i64; 2]),
    /// A share of a sample, `steps` steps long. `again` is true if a share of the same sample came before.
    Share { k: i64, steps: f64, again: bool },
    /// A line, between samples or between shares of sample k.
    Line { k: i64, line: &'l Fragment },
    /// The iso-surface or a cut of it, where the ray ends. k is the first plane behind it.
    Surface { k: i64, hit: SurfaceHit },
    /// A mesh, where the ray ends. k is the first plane behind it.
    Mesh { k: i64, hit: MeshHit },
}

/// The opaque thing that ends a ray at its own depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum End {
    /// The iso-surface or a cut of it.
    Surface(SurfaceHit),
    /// A mesh.
    Mesh(MeshHit),
}

impl End {
    /// The nearer of two hits. At equal depths it is the surface.
    pub(crate) fn nearer(surface: Option<SurfaceHit>, mesh: Option<MeshHit>) -> Option<Self> {
        match (surface, mesh) {
            (Some(surface), Some(mesh)) if mesh.t < surface.t => Some(Self::Mesh(mesh)),
            (Some(surface), _) => Some(Self::Surface(surface)),
            (None, mesh) => mesh.map(Self::Mesh),
        }
    }

    /// Depth of the hit.
    fn depth(&self) -> f64 {
        match self {
            Self::Surface(hit) => hit.t,
            Self::Mesh(hit) => hit.t,
        }
    }
}

impl Step<'_> {
    /// Splits the step into steps of one sample each.
    pub(crate) fn one_by_one(self) -> impl Iterator<Item = Self> {
        let planes = if let Self::Samples([first, last]) = self { first..=last } else { self.plane()..=self.plane() };
        planes.map(move |k| if let Self::Samples(_) = self { Self::Samples([k, k]) } else { self })
    }

    /// The first sample plane of the step.
    pub(crate) fn plane(&self) -> i64 {
        match *self {
            Self::Samples([first, _]) => first,
            Self::Share { k, .. } | Self::Line { k, .. } | Self::Surface { k, .. } | Self::Mesh { k, .. } => k,
        }
    }
}

/// Appends the steps of a ray: samples of its visits, and lines and the end of the ray at their own depths.
///
/// A sample stands for one step of the ray about its plane. A line in this step splits it: the share before the line is
/// composited, then the line, then the rest. Both shares together transmit as much as the whole step: (1 − α)^s·(1 −
/// α)^(1−s) = 1 − α.
///
/// A sample counts if its plane lies before the surface or mesh. The last one stands for the way from the beginning of
/// its own step to the surface, between half a step and one and a half. So the length through a translucent volume in
/// front of a surface grows evenly with the surface's depth, and shows no terraces.
pub(crate) fn steps<'l, R: Real>(
    ray: &IndexRay<R>,
    visits: impl Iterator<Item = [i64; 2]>,
    lines: &'l [Fragment],
    end: Option<End>,
    steps: &mut Vec<Step<'l>>,
) {
    // The depth at which the ray ends.
    let surface = end.map(|end| end.depth());
    if lines.is_empty() && surface.is_none() {
        steps.extend(visits.map(Step::Samples));
        return;
    }
    let step = ray.depth_step.to_f64();
    let plane = |depth: f64| (depth / step).floor() as i64;
    // Lines behind the end are invisible.
    let has_lines = !lines.is_empty();
    let mut lines = surface.map_or(lines, |end| &lines[..lines.iter().take_while(|line| line.depth < end).count()]);
    // The last sample before the end stands for the way up to it.
    let last_of_all = surface.map_or(i64::MAX, |depth| ray.last_before(depth));
    for [first, last] in visits {
        let last = last.min(last_of_all);
        let mut next = first;
        while next <= last {
            // Lines between visible bricks come before the next samples.
            let passed = lines.iter().take_while(|line| line.depth <= next as f64 * step).count();
            steps.extend(lines[..passed].iter().map(|line| Step::Line { k: plane(line.depth).min(next), line }));
            lines = &lines[passed..];
            let met = lines.first().map_or(i64::MAX, |line| plane(line.depth).max(next));
            let split = met.min(last_of_all);
            if next < split {
                let to = last.min(split - 1);
                steps.push(Step::Samples([next, to]));
                next = to + 1;
                continue;
            }
            // The step of sample `split`, share by share.
            let end = surface.filter(|_| split == last_of_all);
            let until = end.unwrap_or((split + 1) as f64 * step);
            let within = lines.iter().take_while(|line| line.depth < until).count();
            let mut from = split as f64 * step;
            let mut again = false;
            for (depth, line) in lines[..within].iter().map(|line| (line.depth, Some(line))).chain([(until, None)]) {
                if depth > from {
                    // If no line is on the ray, k is subtracted from the quotient, which saves one rounding.
                    let share = if has_lines { (depth - from) / step } else { depth / step - split as f64 };
                    steps.push(Step::Share { k: split, steps: share, again });
                    (from, again) = (depth, true);
                }
                steps.extend(line.map(|line| Step::Line { k: split, line }));
            }
            lines = &lines[within..];
            next = split + 1;
        }
    }
    steps.extend(lines.iter().map(|line| Step::Line { k: plane(line.depth), line }));
    let k = last_of_all.saturating_add(1);
    steps.extend(end.map(|end| match end {
        End::Surface(hit) => Step::Surface { k, hit },
        End::Mesh(hit) => Step::Mesh { k, hit },
    }));
}
