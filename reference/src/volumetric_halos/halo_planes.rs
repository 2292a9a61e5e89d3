//! The halos of a picture from one plane to the next (3.3 and 4): groups of planes, glows and tints ([HALO-7],
//! [HALO-8]).

use super::{HaloField, HaloProfile, SpreadParams};
use crate::accumulator::Accumulator;
use drypoint_scene::shot::{HaloAccumulation, HaloKind, HaloParams, HaloSource};

/// A halo prepared for any picture.
#[derive(Clone, Debug)]
pub(crate) struct PreparedHalo {
    pub(crate) profile: HaloProfile,
    pub(crate) spread: SpreadParams,
    pub(crate) kind: HaloKind,
    /// M.
    pub(crate) every: i64,
    pub(crate) accumulate: HaloAccumulation,
    pub(crate) tints: Vec<usize>,
    /// Whether a layer shows its intensities.
    pub(crate) is_watched: bool,
}

impl PreparedHalo {
    /// Prepares a halo. `encode` tells whether compositing is encoded, and `is_watched` whether a layer shows the
    /// halo's intensities.
    pub(crate) fn new(halo: &HaloParams, encode: bool, is_watched: bool) -> Self {
        let spread = &halo.spread;
        Self {
            profile: HaloProfile::new(&halo.profile, halo.opacity, encode),
            spread: SpreadParams {
                from_gradient: spread.from == HaloSource::Gradient,
                passes: spread.passes,
                delta: spread.delta,
                stretch: spread.stretch,
                median: spread.median,
                floor: halo.floor,
            },
            kind: halo.kind,
            every: halo.every.max(1),
            accumulate: halo.accumulate,
            tints: halo.tints.clone(),
            is_watched,
        }
    }

    /// The seed s, or 0 if s is below the floor.
    pub(crate) fn floored(&self, s: f64) -> f64 {
        if s < self.spread.floor { 0.0 } else { s }
    }

    /// Whether the halo's intensities count even if no sample follows.
    fn outlives_samples(&self) -> bool {
        self.kind == HaloKind::Emissive || self.is_watched
    }
}

/// Width in rays of the guard band that all halos of a picture need.
pub(crate) fn guard(halos: &[PreparedHalo]) -> usize {
    halos.iter().map(|halo| halo.spread.guard()).max().unwrap_or(0)
}

/// The images of all halos over a region of the picture, with its guard band. A pixel is a ray.
pub(crate) struct HaloPlanes<'p> {
    halos: Vec<HaloImages<'p>>,
    /// Rays across and down, with the guard band.
    size: [usize; 2],
    guard: usize,
}

/// The images of one halo.
struct HaloImages<'p> {
    halo: &'p PreparedHalo,
    /// S and H.
    field: HaloField,
    /// O; empty for emissive halos.
    occlusion: Vec<f64>,
    /// Whether S has seeds of an unfinished group.
    is_seeded: bool,
    /// Whether H ≠ 0 somewhere and the planes of the next group need it.
    is_due: bool,
}

/// A mix of a colour with the colours of occlusive halos: c ← keep·c + add, in the blend space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tint {
    pub(crate) keep: f64,
    pub(crate) add: [f64; 3],
}

impl Tint {
    /// No tint.
    const NONE: Self = Self { keep: 1.0, add: [0.0; 3] };

    /// Mixes in a further colour: c ← (1 − m)·c + m·c_h.
    fn mix(self, rgb: [f64; 3], m: f64) -> Self {
        let add = std::array::from_fn(|c| (1.0 - m) * self.add[c] + m * rgb[c]);
        Self { keep: (1.0 - m) * self.keep, add }
    }

    /// The tinted colour.
    #[inline]
    pub(crate) fn apply(&self, rgb: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|c| self.keep * rgb[c] + self.add[c])
    }
}

impl<'p> HaloPlanes<'p> {
    /// Bytes of a pixel of the images of one halo: S, H₀, H, working memory and O ([HALO-9]).
    pub(crate) const BYTES_OF_PIXEL: u64 = 8 * (HaloField::BUFFERS + 1);

    /// Images for a number of rays across and down, without the guard band.
    pub(crate) fn new(halos: &'p [PreparedHalo], [width, height]: [usize; 2]) -> Self {
        let guard = guard(halos);
        let size = [width + 2 * guard, height + 2 * guard];
        let images = |halo: &'p PreparedHalo| HaloImages {
            halo,
            field: HaloField::new(size, halo.spread),
            occlusion: if halo.kind == HaloKind::Occlusive { vec![0.0; size[0] * size[1]] } else { Vec::new() },
            is_seeded: false,
            is_due: false,
        };
        Self { halos: halos.iter().map(images).collect(), size, guard }
    }

    /// Rays across and down, with the guard band.
    pub(crate) fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The index of a ray of the region in the images.
    pub(crate) fn place(&self, [i, j]: [usize; 2]) -> usize {
        (j + self.guard) * self.size[0] + i + self.guard
    }

    /// The last plane of the group, of any halo, that is the first to end at or after plane k.
    pub(crate) fn group_end(&self, k: i64) -> i64 {
        let end = |halo: &HaloImages<'_>| (k.div_euclid(halo.halo.every) + 1) * halo.halo.every - 1;
        self.halos.iter().map(end).min().unwrap_or(i64::MAX)
    }

    /// Whether some H or S is needed on later planes.
    pub(crate) fn is_waiting(&self) -> bool {
        self.halos.iter().any(|halo| halo.is_due || halo.is_seeded)
    }

    /// Whether some intensities count even if no sample follows.
    pub(crate) fn outlive_samples(&self) -> bool {
        self.halos.iter().any(|halo| halo.halo.outlives_samples())
    }

    /// Whether some H affects rays that have no sample.
    pub(crate) fn reach_all_rays(&self) -> bool {
        self.halos.iter().any(|halo| halo.is_due)
    }

    /// The seed images, cut into strips of `rows` rows. Each strip has a slice for each halo.
    pub(crate) fn seed_strips(&mut self, rows: usize) -> Vec<SeedStrip<'_>> {
        let mut strips: Vec<SeedStrip<'_>> = Vec::new();
        for images in &mut self.halos {
            let share = match images.halo.accumulate {
                HaloAccumulation::Max => None,
                HaloAccumulation::Mean => Some(images.halo.every as f64),
            };
            for (i, pixels) in images.field.seeds_mut().chunks_mut(rows * self.size[0]).enumerate() {
                if i == strips.len() {
                    strips.push(SeedStrip::default());
                }
                strips[i].images.push(SeedImage { pixels, mean_of: share, is_seeded: false });
            }
        }
        strips
    }

    /// Records which halos received seeds.
    pub(crate) fn note_seeded(&mut self, seeded: &[bool]) {
        for (images, seeded) in self.halos.iter_mut().zip(seeded) {
            images.is_seeded |= seeded;
        }
    }

    /// Ends the groups whose last plane is k: computes H from the seeds, then O = max(O, H) and S = 0.
    pub(crate) fn end(&mut self, k: i64) {
        for images in &mut self.halos {
            if (k + 1).rem_euclid(images.halo.every) != 0 {
                continue;
            }
            if !images.is_seeded {
                if images.is_due {
                    images.field.clear();
                    images.is_due = false;
                }
                continue;
            }
            images.is_seeded = false;
            let any = images.field.generate();
            images.is_due = any && images.halo.outlives_samples();
            if any && !images.occlusion.is_empty() {
                let width = self.size[0];
                for y in 0..self.size[1] {
                    let range = images.field.intensity_range(y);
                    let row = y * width + range.start..y * width + range.end;
                    for (o, h) in images.occlusion[row.clone()].iter_mut().zip(&images.field.intensities()[row]) {
                        *o = o.max(*h);
                    }
                }
            }
        }
    }

    /// The tint of all occlusive halos at a place of the images. Returns none if it changes no colour.
    #[inline]
    pub(crate) fn tint(&self, place: usize) -> Option<Tint> {
        self.tint_by(place, |_| true)
    }

    /// The tint of the occlusive halos for which `acts` holds. The first in the list is mixed last.
    #[inline]
    fn tint_by(&self, place: usize, acts: impl Fn(&PreparedHalo) -> bool) -> Option<Tint> {
        let mut tint = None;
        for images in self.halos.iter().rev() {
            if let Some(&o) = images.occlusion.get(place)
                && o > 0.0
                && acts(images.halo)
                && let Some((rgb, m)) = images.halo.profile.at(o)
            {
                tint = Some(tint.unwrap_or(Tint::NONE).mix(rgb, m));
            }
        }
        tint
    }

    /// The premultiplied glow of all emissive halos at a place of the images, for one plane. Returns none without a
    /// glow. `correct` converts an opacity per reference length to that of one step on the ray ([VAL-4]).
    #[inline]
    pub(crate) fn glow(&self, place: usize, correct: impl Fn(f64) -> f64) -> Option<[f64; 4]> {
        let mut front = Accumulator::empty(0.0);
        for (i, images) in self.halos.iter().enumerate() {
            if !images.is_due || images.halo.kind != HaloKind::Emissive {
                continue;
            }
            let Some((rgb, alpha)) = images.halo.profile.at(images.field.intensities()[place]) else { continue };
            let tint = self.tint_by(place, |occlusive| occlusive.tints.contains(&i));
            front.over(tint.map_or(rgb, |tint| tint.apply(rgb)), correct(alpha));
        }
        let [r, g, b] = front.rgb;
        (front.opacity > 0.0).then_some([r, g, b, front.opacity])
    }

    /// The intensities of the watched halos at a place of the images, in their order.
    pub(crate) fn watched(&self, place: usize) -> impl Iterator<Item = f64> {
        let watched = self.halos.iter().filter(|images| images.halo.is_watched);
        watched.map(move |images| if images.is_due { images.field.intensities()[place] } else { 0.0 })
    }

    /// Number of passes over the images so far.
    pub(crate) fn passes(&self) -> u64 {
        self.halos.iter().map(|images| images.field.passes_done()).sum()
    }

    /// Size in bytes.
    pub(crate) fn bytes(&self) -> u64 {
        let of = |images: &HaloImages<'_>| images.field.bytes() + size_of_val(images.occlusion.as_slice()) as u64;
        self.halos.iter().map(of).sum()
    }
}

/// Rows of the seed images of all halos.
#[derive(Default)]
pub(crate) struct SeedStrip<'a> {
    images: Vec<SeedImage<'a>>,
}

/// Rows of the seed image of one halo.
struct SeedImage<'a> {
    pixels: &'a mut [f64],
    /// M, if the seeds of a group are averaged.
    mean_of: Option<f64>,
    is_seeded: bool,
}

impl SeedStrip<'_> {
    /// Adds a seed s > 0 of a halo at a place of the strip.
    #[inline]
    pub(crate) fn add(&mut self, halo: usize, place: usize, s: f64) {
        let image = &mut self.images[halo];
        let pixel = &mut image.pixels[place];
        *pixel = match image.mean_of {
            None => pixel.max(s),
            Some(planes) => *pixel + s / planes,
        };
        image.is_seeded = true;
    }

    /// Which halos received seeds.
    pub(crate) fn seeded(&self) -> Vec<bool> {
        self.images.iter().map(|image| image.is_seeded).collect()
    }
}
