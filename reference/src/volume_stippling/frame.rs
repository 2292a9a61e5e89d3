//! A frame: of each voxel's list as many points as the factors say, on the page (section 5, [STIP-5], [STIP-6]); with
//! `even = "page"` those of four times as many that lie evenly there ([STIP-19]).

use super::count::{candidates, dots, with_nib};
use super::elimination::{Candidate, eliminate};
use super::factors::{Moving, Still, Whole};
use super::hidden::Hidden;
use crate::surface::IsoSurface;
use drypoint_scene::glam::{DMat3, DVec2, DVec3};
use drypoint_scene::marks::{Dot, Page};
use drypoint_scene::points::Points;
use drypoint_scene::space::Grid;
use drypoint_scene::tables::{Even, LightDirection, Stipples};
use drypoint_scene::tone::Tone;
use drypoint_scene::view::View;
use rayon::prelude::*;
use std::sync::Arc;

pub use super::factors::viewing_distance;

/// Voxels that are drawn in one go.
const PART: usize = 2048;

/// What frames have in common.
#[derive(Clone, Debug)]
pub struct Frames<'a> {
    stipples: &'a Stipples,
    points: &'a Points,
    /// For each voxel what no camera changes.
    still: Vec<Still>,
    light: LightDirection,
    centre: DVec3,
    radius: f64,
    reference: f64,
    near: f64,
    size: f64,
    nib: Option<f64>,
    surface: Option<Arc<IsoSurface<'a, 'a>>>,
    tone: Option<PenTone<'a>>,
}

/// What a pen prints, and how much ink the points are ([STIP-17]).
#[derive(Clone, Copy, Debug)]
pub struct PenTone<'a> {
    /// What it prints.
    pub tone: &'a Tone,
    /// λa of dots of S_max in a face seen from the front, with T = 1.
    pub ink: f64,
    /// Voxels that lie over each other in it.
    pub layers: f64,
}

impl PenTone<'_> {
    /// The share of the ink that prints a share of the coverage that all of it prints.
    fn share(&self, share: f64) -> f64 {
        if self.ink <= 0.0 {
            return share;
        }
        let full = self.tone.coverage_of_layers(self.ink, self.layers);
        self.tone.ink_of_layers(full * share, self.layers) / self.ink
    }
}

/// What frames are made of.
#[derive(Clone, Debug)]
pub struct FrameInputs<'a> {
    /// `[stipples]`.
    pub stipples: &'a Stipples,
    /// The points, made once.
    pub points: &'a Points,
    /// The scene's light.
    pub light: LightDirection,
    /// The volume's own grid, whose centre and radius eqs. 7 and 8 have.
    pub grid: &'a Grid,
    /// The reference camera, the scene's first ([STIP-3]).
    pub reference: &'a View,
    /// `near` of a perspective camera, in world units.
    pub near: f64,
    /// S_max in mm.
    pub size: f64,
    /// The width of the pen's nib in mm, where a pen draws, which has one size ([STIP-6]).
    pub nib: Option<f64>,
    /// What hides points; none: they are transparent ([STIP-15]).
    pub surface: Option<Arc<IsoSurface<'a, 'a>>>,
    /// What the pen prints, where that was measured ([STIP-17]).
    pub tone: Option<PenTone<'a>>,
}

/// The dots of a frame, in the order of the voxels, in parts that keep their memory from frame to frame.
#[derive(Clone, Debug, Default)]
pub struct Drawn {
    parts: Vec<Part>,
    /// Of the pen, where one draws.
    nib: Option<f64>,
}

#[derive(Clone, Debug, Default)]
struct Part {
    dots: Vec<Dot>,
    hidden: u64,
}

impl Drawn {
    /// The dots.
    pub fn dots(&self) -> impl Iterator<Item = &Dot> {
        self.parts.iter().flat_map(|part| &part.dots)
    }

    /// Number of dots.
    pub fn len(&self) -> usize {
        self.parts.iter().map(|part| part.dots.len()).sum()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Dots that are larger than the nib, since their voxel's list has no more ([STIP-6]).
    pub fn larger_than_nib(&self) -> u64 {
        let is_larger = |dot: &&Dot| self.nib.is_some_and(|nib| dot.radius > 0.5 * nib);
        self.dots().filter(is_larger).count() as u64
    }

    /// Points that were looked at and are hidden ([STIP-15]).
    pub fn hidden(&self) -> u64 {
        self.parts.iter().map(|part| part.hidden).sum()
    }

    /// All in one list.
    pub fn to_vec(&self) -> Vec<Dot> {
        let mut all = Vec::with_capacity(self.len());
        self.parts.iter().for_each(|part| all.extend_from_slice(&part.dots));
        all
    }
}

impl<'a> Frames<'a> {
    /// Computes what no camera changes.
    pub fn new(inputs: FrameInputs<'a>) -> Self {
        let FrameInputs { stipples, points, light, grid, reference, near, size, nib, surface, tone } = inputs;
        let centre = grid.centre();
        Self {
            stipples,
            points,
            still: points.voxels.par_iter().map(|voxel| Still::new(stipples, voxel, &points.grid)).collect(),
            light,
            centre,
            radius: grid.radius(),
            reference: viewing_distance(reference, centre, near),
            near,
            size,
            nib,
            surface,
            tone,
        }
    }

    /// The dots that a camera sees, on a page, or with `even = "page"` the candidates for [`choose_on_page`]; dots whose centre the picture does not hold are left out, and in perspective
    /// those nearer than `near`.
    pub fn draw(&self, view: &View, page: &Page, drawn: &mut Drawn) {
        let whole = Whole { centre: self.centre, radius: self.radius, reference: self.reference, near: self.near };
        let moving = Moving::new(self.stipples, self.light, view, &whole);
        let place = Place::new(view, page, &self.points.grid);
        let surface = self.surface.as_deref();
        let hidden = surface.map(|surface| Hidden::new(surface, view, self.near, &self.points.grid));
        let parts = self.points.voxels.len().div_ceil(PART);
        drawn.parts.resize_with(parts, Part::default);
        drawn.nib = self.nib;
        drawn.parts.par_iter_mut().enumerate().for_each(|(p, part)| {
            part.hidden = 0;
            part.dots.clear();
            let range = p * PART..((p + 1) * PART).min(self.points.voxels.len());
            for i in range {
                self.voxel(i, &moving, &place, hidden.as_ref(), part);
            }
        });
    }

    fn voxel(&self, i: usize, moving: &Moving<'_>, place: &Place, hidden: Option<&Hidden<'_>>, part: &mut Part) {
        let (voxel, each) = (&self.points.voxels[i], self.points.each);
        let centre = voxel.centre();
        let at = place.eye(centre);
        let factors = moving.of(&self.still[i], voxel, at);
        if factors.count == 0.0 {
            return;
        }
        // Eq. 4, over S_max.
        let size = voxel.magnitude * factors.size;
        // T = 1 is the whole list, but for the part of a point by which it is too long.
        let whole_list = self.still[i].piece * (self.points.full / each as f64);
        let (share, size, unit) = match self.nib {
            None => (factors.count * whole_list, size, self.size),
            Some(nib) => {
                let ink = factors.count * (size * size);
                let ink = self.tone.map_or(ink, |tone| tone.share(ink));
                let (share, size) = with_nib(ink * whole_list, self.size / nib);
                (share, size, nib)
            }
        };
        let radius = 0.5 * unit * size;
        if radius <= 0.0 {
            return;
        }
        let (opacities, listed) = match self.stipples.even {
            Even::None => {
                let drawn = dots(each, share, size, self.stipples.ink, voxel.cell);
                ((drawn.whole, 1.0, drawn.fading), drawn.whole + usize::from(drawn.fading > 0.0))
            }
            Even::Page => {
                let (count, dots) = candidates(each, share, voxel.cell);
                ((count, dots, 0.0), count)
            }
        };
        let (whole, opacity, fading) = opacities;
        let list = &self.points.of(i)[..listed];
        for (k, offset) in list.iter().enumerate() {
            let o = DVec3::from_array(offset.map(f64::from));
            if let Some(on_page) = place.on_page(at + place.to_eye * o, self.near) {
                let world = place.world(centre + o);
                if hidden.is_some_and(|hidden| hidden.hides(world, voxel.normal)) {
                    part.hidden += 1;
                    continue;
                }
                let opacity = if k < whole { opacity } else { fading };
                part.dots.push(Dot { at: on_page, world, radius, opacity });
            }
        }
    }
}

/// Of the candidates of one frame those that are drawn, evenly on the page whatever pen draws them ([STIP-19]); a
/// candidate's opacity says how many dots it stands for.
pub fn choose_on_page(drawn: &mut [Drawn]) {
    let all = || drawn.iter().flat_map(Drawn::dots);
    let candidates: Vec<Candidate> = all().map(|dot| Candidate { at: dot.at, share: dot.opacity }).collect();
    let mut is_kept = vec![false; candidates.len()];
    for i in eliminate(&candidates) {
        is_kept[i] = true;
    }
    let mut is_kept = is_kept.into_iter();
    for dots in drawn.iter_mut().flat_map(|drawn| &mut drawn.parts).map(|part| &mut part.dots) {
        dots.retain(|_| is_kept.next() == Some(true));
        dots.iter_mut().for_each(|dot| dot.opacity = 1.0);
    }
}

/// From index space to the page.
pub(super) struct Place {
    /// From index to eye space: directions, and the place of index 0.
    to_eye: DMat3,
    origin: DVec3,
    to_world: DMat3,
    world_origin: DVec3,
    perspective: bool,
    /// mm of one unit of eye space, at depth 1 in perspective.
    scale: DVec2,
    /// The picture's middle and half its size, in mm.
    middle: DVec2,
    half: DVec2,
}

impl Place {
    pub(super) fn new(view: &View, page: &Page, grid: &Grid) -> Self {
        let rotation = DMat3::from_cols(view.right, view.up, -view.forward).transpose();
        let half = page.picture() / 2.0;
        let mm = page.picture() / DVec2::from(view.size.map(|n| n as f64));
        Self {
            to_eye: rotation * grid.axes(),
            origin: view.to_eye(grid.origin()),
            to_world: grid.axes(),
            world_origin: grid.origin(),
            perspective: view.perspective,
            // y is down on the page.
            scale: DVec2::new(mm.x, -mm.y) / view.pixel,
            middle: DVec2::splat(page.margin) + half,
            half,
        }
    }

    fn eye(&self, index: DVec3) -> DVec3 {
        self.to_eye * index + self.origin
    }

    fn world(&self, index: DVec3) -> DVec3 {
        self.to_world * index + self.world_origin
    }

    /// Where on the page a place in eye space is, if the picture holds it.
    fn on_page(&self, at: DVec3, near: f64) -> Option<DVec2> {
        let off = self.off(at, near)?;
        (self.beyond(off) == [0.0; 2]).then(|| self.at(off))
    }

    /// How far from the picture's middle, in mm, whether or not the picture holds it; none for what is nearer than `near` in
    /// perspective.
    pub(super) fn off(&self, at: DVec3, near: f64) -> Option<DVec2> {
        let flat = DVec2::new(at.x, at.y) * self.scale;
        match self.perspective {
            true if -at.z < near => None,
            true => Some(flat / -at.z),
            false => Some(flat),
        }
    }

    /// The place on the page that is so far from the picture's middle.
    pub(super) fn at(&self, off: DVec2) -> DVec2 {
        self.middle + off
    }

    /// Beyond which sides of the picture that is: −1, 0 or 1 along each axis.
    pub(super) fn beyond(&self, off: DVec2) -> [f64; 2] {
        [(off.x, self.half.x), (off.y, self.half.y)]
            .map(|(off, half)| if off.abs() <= half { 0.0 } else { off.signum() })
    }
}
