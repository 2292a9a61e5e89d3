//! The halos over some rows of rays, with the errors of their intensities ([HALO-1] … [HALO-8]).
//!
//! Seeds depend on the field alone. So the images of all groups of planes are made before any ray is cast, and each ray
//! then finds its tint and its glow on each plane. A seed that hangs on a decision is anything between its results on
//! all ways, and so is an intensity that may lie below the floor. [`PossibleField`] spreads both ends.

use super::positions::RayOrigin;
use super::seeds::{SeedAt, seeds_of_ray};
use crate::accumulator::Accumulator;
use crate::number::{Arithmetic, Bounded, Real};
use crate::ray::draw::ray_point;
use crate::ray::opacity::correct;
use crate::ray::prepared::Prepared;
use crate::ray::prepared_halos::PreparedHalos;
use crate::volumetric_halos::{HaloProfile, PossibleField, PreparedHalo};
use drypoint_scene::parallel;
use drypoint_scene::shot::{HaloAccumulation, HaloKind};
use std::sync::Arc;

/// A unit in the last place of 1 in f32.
const ULP: f64 = f32::EPSILON as f64;

/// An image of intensities; none if all are 0.
type Image = Option<Arc<Vec<Bounded>>>;

/// The halos over some rows of rays, in memory for all groups of planes.
pub(super) struct BandHalos<'p> {
    halos: &'p [PreparedHalo],
    /// Rays across the images, and in the guard band on each side.
    width: usize,
    guard: usize,
    /// The first row of rays.
    first: usize,
    groups: Vec<Group>,
}

/// The images under which some planes are composited.
struct Group {
    last: i64,
    /// O of each occlusive halo.
    occlusion: Vec<Image>,
    /// H of each emissive halo.
    glowing: Vec<Image>,
}

/// A mix of a colour with the colours of occlusive halos: c ← keep·c + add, in the blend space.
#[derive(Clone, Copy)]
pub(super) struct BoundedTint {
    keep: Bounded,
    add: [Bounded; 3],
}

impl BoundedTint {
    const NONE: Self = Self { keep: Bounded::ONE, add: [Bounded::ZERO; 3] };

    fn mix(self, rgb: [Bounded; 3], m: Bounded) -> Self {
        let rest = Bounded::ONE - m;
        Self { keep: rest * self.keep, add: [0, 1, 2].map(|c| rest * self.add[c] + m * rgb[c]) }
    }

    /// The tinted colour.
    pub(super) fn apply(&self, rgb: [Bounded; 3]) -> [Bounded; 3] {
        [0, 1, 2].map(|c| self.keep * rgb[c] + self.add[c])
    }
}

impl<'p> BandHalos<'p> {
    /// Makes the images of the rows first..end of rays.
    #[inline]
    pub(super) fn new<'v>(
        (prepared, halos): (&'p Prepared<'v, Bounded>, &'p PreparedHalos<'v>),
        origin: RayOrigin,
        [first, end]: [usize; 2],
    ) -> Self {
        let (n, guard, list) = (prepared.rays_across, halos.guard(), halos.list.as_slice());
        let size = [prepared.view.size[0] * n + 2 * guard, end - first + 2 * guard];
        let row = |y: usize| -> Vec<SeedAt> {
            let of_ray = |x: usize| {
                let ray = [x as i64 - guard as i64, (y + first) as i64 - guard as i64];
                seeds_of_ray((prepared, halos), origin, ray_point(n, ray), y * size[0] + x)
            };
            (0..size[0]).flat_map(of_ray).collect()
        };
        let mut seeds: Vec<SeedAt> = parallel::map(size[1], &row).into_iter().flatten().collect();
        // The order of planes on each ray is kept.
        seeds.sort_by_key(|seed| seed.k);
        let mut fields: Vec<_> = list.iter().map(|halo| PossibleField::new(size, halo.spread)).collect();
        let none = || -> Vec<Image> { vec![None; list.len()] };
        let (mut occlusion, mut glowing, mut groups) = (none(), none(), Vec::new());
        let mut seeds = seeds.into_iter().peekable();
        let mut next = seeds.peek().map_or(0, |seed| seed.k);
        while seeds.peek().is_some() || glowing.iter().any(Option::is_some) {
            let ends = |halo: &PreparedHalo| (next.div_euclid(halo.every) + 1) * halo.every - 1;
            let last = list.iter().map(ends).min().unwrap_or(next);
            groups.push(Group { last, occlusion: occlusion.clone(), glowing: glowing.clone() });
            while let Some(seed) = seeds.next_if(|seed| seed.k <= last) {
                add(&mut fields[seed.halo], &list[seed.halo], &seed);
            }
            for (i, halo) in list.iter().enumerate().filter(|(_, halo)| (last + 1).rem_euclid(halo.every) == 0) {
                let image = fields[i].generate();
                match halo.kind {
                    HaloKind::Emissive => glowing[i] = image.map(Arc::new),
                    HaloKind::Occlusive => occlusion[i] = united(occlusion[i].take(), image),
                }
            }
            next = last + 1;
        }
        groups.push(Group { last: i64::MAX, occlusion, glowing: none() });
        Self { halos: list, width: size[0], guard, first, groups }
    }

    /// The index of a ray of the picture in the images.
    pub(super) fn place(&self, [x, y]: [usize; 2]) -> usize {
        (y - self.first + self.guard) * self.width + x + self.guard
    }

    /// The last plane of a group.
    pub(super) fn last(&self, group: usize) -> i64 {
        self.groups[group].last
    }

    /// The last plane that can glow.
    pub(super) fn last_glow(&self) -> i64 {
        self.groups.iter().rev().nth(1).map_or(i64::MIN, |group| group.last)
    }

    /// The tint of a group at a place. The first halo in the list is mixed last.
    #[inline]
    pub(super) fn tint(&self, group: usize, place: usize) -> BoundedTint {
        self.tint_by(group, place, |_| true)
    }

    #[inline]
    fn tint_by(&self, group: usize, place: usize, acts: impl Fn(&PreparedHalo) -> bool) -> BoundedTint {
        let images = self.halos.iter().zip(&self.groups[group].occlusion).rev().filter(|(halo, _)| acts(halo));
        images.fold(BoundedTint::NONE, |tint, (halo, image)| {
            let seen = image.as_ref().and_then(|image| profile_at(&halo.profile, image[place]));
            seen.map_or(tint, |(rgb, m)| tint.mix(rgb, m))
        })
    }

    /// The premultiplied glow of a plane of a group at a place, where a step is `steps` reference lengths long. Returns
    /// none without a glow.
    #[inline]
    pub(super) fn glow(&self, group: usize, place: usize, steps: Bounded) -> Option<[Bounded; 4]> {
        let mut front = Accumulator::empty(Bounded::ZERO);
        for (i, (halo, image)) in self.halos.iter().zip(&self.groups[group].glowing).enumerate() {
            let seen = image.as_ref().and_then(|image| profile_at(&halo.profile, image[place]));
            let Some((rgb, alpha)) = seen else { continue };
            let tint = self.tint_by(group, place, |occlusive| occlusive.tints.contains(&i));
            let alpha = Bounded::monotone([alpha, steps], |[alpha, steps]| correct(alpha.min(1.0), steps));
            front.over(tint.apply(rgb), alpha);
        }
        let Accumulator { rgb: [r, g, b], opacity } = front;
        (opacity.ends()[1] > 0.0).then_some([r, g, b, opacity])
    }
}

/// Adds a seed to those of its group.
#[inline]
fn add(field: &mut PossibleField, halo: &PreparedHalo, seed: &SeedAt) {
    for ((image, s), rounded) in field.seeds.iter_mut().zip(seed.s).zip([0.0, -2.0 * ULP, 2.0 * ULP]) {
        let pixel = &mut image[seed.place];
        *pixel = match halo.accumulate {
            HaloAccumulation::Max => pixel.max(s),
            HaloAccumulation::Mean => (*pixel + s / halo.every as f64) * (1.0 + rounded),
        };
    }
}

/// O = max(O, H).
#[inline]
fn united(occlusion: Image, image: Option<Vec<Bounded>>) -> Image {
    match (occlusion, image) {
        (Some(o), Some(h)) => Some(Arc::new(o.iter().zip(h).map(|(o, h)| Arithmetic::max(*o, h)).collect())),
        (o, h) => o.or(h.map(Arc::new)),
    }
}

/// Colour and opacity of a profile at an intensity with its error. Between nodes it is linear, so its ends lie at nodes
/// or at those of the intensity. Returns none if nothing can be seen.
#[inline]
fn profile_at(profile: &HaloProfile, h: Bounded) -> Option<([Bounded; 3], Bounded)> {
    /// Roundings of colours and opacities: those of a mix, and of sRGB.
    const ROUNDINGS: f64 = 24.0 * ULP;
    let here = profile.at(h.value());
    if h.error() == 0.0 && here.is_none() {
        return None;
    }
    let [low, high] = h.ends();
    // Nodes are rounded, and so is the difference to them. An intensity above 0 stays above it.
    let low = if low > 0.0 { (low - 4.0 * ULP).max(f64::MIN_POSITIVE) } else { 0.0 };
    let high = high + 4.0 * ULP;
    let nodes = profile.nodes().flat_map(|at| [at.next_down(), at]).filter(|at| low < *at && *at < high);
    let others: Vec<_> = nodes.chain([low, high]).map(|h| profile.at(h)).collect();
    let (rgb, opacity) = here.or_else(|| others.iter().flatten().next().copied().map(|(rgb, _)| (rgb, 0.0)))?;
    let mut errors = [0.0f64; 4];
    for other in others {
        // Where nothing is seen, the colour does not matter.
        let (there, alpha) = other.unwrap_or((rgb, 0.0));
        for (error, (a, b)) in
            errors.iter_mut().zip([there[0], there[1], there[2], alpha].iter().zip([rgb[0], rgb[1], rgb[2], opacity]))
        {
            *error = error.max((a - b).abs());
        }
    }
    let bounded = |x: f64, error: f64| Bounded::new(x, error + ROUNDINGS * (x.abs() + error));
    Some(([0, 1, 2].map(|c| bounded(rgb[c], errors[c])), bounded(opacity, errors[3])))
}
