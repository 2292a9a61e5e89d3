//! The halos on a ray: its tint, and the glow behind each plane ([HALO-7]).

use super::halos::{BandHalos, BoundedTint};
use crate::number::Bounded;

/// The halos on a ray, up to the next plane.
pub(super) struct RayHalos<'p> {
    band: &'p BandHalos<'p>,
    place: usize,
    steps: Bounded,
    /// The first plane whose glow is not laid yet.
    plane: i64,
    /// The group of that plane.
    group: usize,
    tint: BoundedTint,
    glow: Option<[Bounded; 4]>,
}

impl<'p> RayHalos<'p> {
    /// The halos before all planes of a ray of the picture, whose steps are `steps` reference lengths long.
    #[inline]
    pub(super) fn new(band: &'p BandHalos<'p>, ray: [usize; 2], steps: Bounded) -> Self {
        let place = band.place(ray);
        Self { band, place, steps, plane: i64::MIN, group: 0, tint: band.tint(0, place), glow: None }
    }

    /// Enters the next group.
    #[inline]
    fn enter_next(&mut self) {
        self.group += 1;
        self.tint = self.band.tint(self.group, self.place);
        self.glow = self.band.glow(self.group, self.place, self.steps);
    }

    /// Passes the planes before plane k. `lay` lays the glow of a plane and returns whether the ray is still open, as
    /// this function does.
    #[inline]
    pub(super) fn pass(&mut self, k: i64, lay: &mut dyn FnMut([Bounded; 4]) -> bool) -> bool {
        while self.plane < k {
            let last = self.band.last(self.group);
            let end = k.min(last.saturating_add(1));
            if let Some(glow) = self.glow {
                for _ in self.plane..end {
                    if !lay(glow) {
                        return false;
                    }
                }
            }
            self.plane = end;
            if end > last {
                self.enter_next();
            }
        }
        true
    }

    /// The plane behind all glows.
    pub(super) fn end(&self) -> i64 {
        self.band.last_glow().saturating_add(1)
    }

    /// A colour under the tint of the next plane.
    pub(super) fn tinted(&self, rgb: [Bounded; 3]) -> [Bounded; 3] {
        self.tint.apply(rgb)
    }
}
