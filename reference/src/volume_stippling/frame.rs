//! A frame: the prefix of each voxel's list that the factors select, on the page (section 5, [STIP-5], [STIP-6]).
//! With `even = "page"` four times as many candidates are thinned evenly on the page ([STIP-19]).

use super::dot_counts::{candidates, dots, with_nib};
use super::elimination::{DotCandidate, eliminate};
use super::factors::{CameraFactors, FixedFactors, VolumeExtent};
use super::hidden::{self, HiddenPoints};
use crate::surface::IsoSurface;
use drypoint_scene::glam::{DMat3, DVec2, DVec3};
use drypoint_scene::marks::{Dot, Page};
use drypoint_scene::parallel;
use drypoint_scene::points::{Points, SurfacePoint};
use drypoint_scene::shot::StippleParams;
use drypoint_scene::shot::stipples::Even;
use drypoint_scene::space::Grid;
use drypoint_scene::tone::Tone;
use drypoint_scene::view::View;
use std::sync::Arc;

pub use super::factors::viewing_distance;

/// Number of voxels in one unit of parallel work.
const PART: usize = 2048;

/// Data that all frames share.
#[derive(Clone, Debug)]
pub struct Frames<'a> {
    stipples: StippleParams,
    points: &'a Points,
    /// The camera-independent factors of each voxel.
    still: Vec<FixedFactors>,
    centre: DVec3,
    radius: f64,
    reference: f64,
    nib: Option<f64>,
    surface: Option<Arc<IsoSurface<'a, 'a>>>,
    tone: Option<PenTone<'a>>,
}

/// The tone curve of a pen, and the ink of the points ([STIP-17]).
#[derive(Clone, Copy, Debug)]
pub struct PenTone<'a> {
    /// The tone curve.
    pub tone: &'a Tone,
    /// λa of dots of S_max in a face seen from the front, at T = 1.
    pub ink: f64,
    /// Mean number of overlapping voxels in such a face.
    pub layers: f64,
}

impl PenTone<'_> {
    /// Converts a share of the largest coverage to the share of ink that prints it.
    fn share(&self, share: f64) -> f64 {
        if self.ink <= 0.0 {
            return share;
        }
        let full = self.tone.coverage_of_layers(self.ink, self.layers);
        self.tone.ink_of_layers(full * share, self.layers) / self.ink
    }
}

/// The inputs of frames.
#[derive(Clone, Debug)]
pub struct FrameInputs<'a> {
    /// How dots are drawn.
    pub stipples: StippleParams,
    /// The points from the preprocess.
    pub points: &'a Points,
    /// The volume's own grid; eqs. 7 and 8 use its centre and radius.
    pub grid: &'a Grid,
    /// Width of the pen's nib in mm, if a pen draws. A pen has one size ([STIP-6]).
    pub nib: Option<f64>,
    /// The surface that hides points; none if points are transparent ([STIP-15]).
    pub surface: Option<Arc<IsoSurface<'a, 'a>>>,
    /// The pen's tone curve, if it was measured ([STIP-17]).
    pub tone: Option<PenTone<'a>>,
}

/// The dots of a frame in the order of the voxels. Its buffers are reused from frame to frame.
#[derive(Clone, Debug, Default)]
pub struct FrameDots {
    parts: Vec<FramePart>,
    /// Width of the nib, if a pen draws.
    nib: Option<f64>,
}

#[derive(Clone, Debug, Default)]
struct FramePart {
    dots: Vec<Dot>,
    /// The points of the dots, where a surface may hide them.
    points: Vec<SurfacePoint>,
    hidden: u64,
}

impl FramePart {
    /// Leaves out the dots that the surface hides. `hides` is asked once for each, in their order.
    fn leave_out(&mut self, mut hides: impl FnMut(&SurfacePoint) -> bool) {
        let before = self.dots.len();
        let mut points = self.points.iter();
        self.dots.retain(|_| points.next().is_none_or(|point| !hides(point)));
        self.points.clear();
        self.hidden += (before - self.dots.len()) as u64;
    }
}

impl FrameDots {
    /// The dots.
    pub fn dots(&self) -> impl Iterator<Item = &Dot> {
        self.parts.iter().flat_map(|part| &part.dots)
    }

    /// Number of dots.
    pub fn len(&self) -> usize {
        self.parts.iter().map(|part| part.dots.len()).sum()
    }

    /// Whether there are no dots.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of dots larger than the nib, because the voxel's list is too short ([STIP-6]).
    pub fn larger_than_nib(&self) -> u64 {
        let is_larger = |dot: &&Dot| self.nib.is_some_and(|nib| dot.radius > 0.5 * nib);
        self.dots().filter(is_larger).count() as u64
    }

    /// The points of candidates that a surface may hide, in their order.
    pub fn points(&self) -> Vec<SurfacePoint> {
        self.parts.iter().flat_map(|part| &part.points).copied().collect()
    }

    /// Leaves out the candidates that a surface hides, by a flag for each of [`points`](Self::points).
    pub fn leave_out(&mut self, hidden: &[bool]) {
        let mut hidden = hidden.iter();
        self.parts.iter_mut().for_each(|part| part.leave_out(|_| hidden.next() == Some(&true)));
    }

    /// Number of points that were tested and are hidden ([STIP-15]).
    pub fn hidden(&self) -> u64 {
        self.parts.iter().map(|part| part.hidden).sum()
    }

    /// All dots in one list.
    pub fn to_vec(&self) -> Vec<Dot> {
        let mut all = Vec::with_capacity(self.len());
        self.parts.iter().for_each(|part| all.extend_from_slice(&part.dots));
        all
    }
}

impl<'a> Frames<'a> {
    /// Computes the camera-independent factors.
    pub fn new(inputs: FrameInputs<'a>) -> Self {
        let FrameInputs { stipples, points, grid, nib, surface, tone } = inputs;
        let centre = grid.centre();
        let still = parallel::gather(points.voxels.len(), 64, &|run, still| {
            still.extend(points.voxels[run].iter().map(|voxel| FixedFactors::new(&stipples, voxel, &points.grid)));
        });
        Self {
            still,
            points,
            centre,
            radius: grid.radius(),
            reference: viewing_distance(&stipples.view, centre, stipples.near),
            stipples,
            nib,
            surface,
            tone,
        }
    }

    /// Draws the dots that a camera sees on a page; with `even = "page"`, the candidates for [`choose_on_page`]. Dots
    /// whose centre lies outside the picture are left out, as are dots nearer than `near` in perspective.
    pub fn draw(&self, view: &View, page: &Page, drawn: &mut FrameDots) {
        self.candidates(view, page, drawn);
        if let Some(surface) = self.surface.as_deref() {
            let hidden = HiddenPoints::new(surface, view, self.stipples.near);
            parallel::chunks_mut(&mut drawn.parts, 1, &|_, parts| {
                parts.iter_mut().for_each(|part| part.leave_out(|point| hidden.hides(point)));
            });
        }
    }

    /// Distance in world units in front of the surface at which its points are tested, signed towards the side of the
    /// eye; none if no surface hides them.
    pub fn in_front(&self, view: &View) -> Option<f64> {
        self.surface.as_deref().map(|surface| hidden::in_front(surface, view))
    }

    /// Draws dots like [`draw`](Self::draw), with those that the surface hides.
    pub fn candidates(&self, view: &View, page: &Page, drawn: &mut FrameDots) {
        let &Self { ref stipples, centre, radius, reference, .. } = self;
        let whole = VolumeExtent { centre, radius, reference, near: stipples.near };
        let moving = CameraFactors::new(stipples, view, &whole);
        let place = IndexToPage::new(view, page, &self.points.grid);
        let parts = self.points.voxels.len().div_ceil(PART);
        drawn.parts.resize_with(parts, FramePart::default);
        drawn.nib = self.nib;
        parallel::each_of(drawn.parts.iter_mut().collect(), &|p, part: &mut FramePart| {
            part.hidden = 0;
            part.dots.clear();
            part.points.clear();
            let range = p * PART..((p + 1) * PART).min(self.points.voxels.len());
            for i in range {
                self.voxel(i, &moving, &place, part);
            }
        });
    }

    fn voxel(&self, i: usize, moving: &CameraFactors<'_>, place: &IndexToPage, part: &mut FramePart) {
        let (voxel, each) = (&self.points.voxels[i], self.points.each);
        let centre = voxel.centre();
        let at = place.eye(centre);
        let factors = moving.of(&self.still[i], voxel, at);
        if factors.count == 0.0 {
            return;
        }
        // Eq. 4, over S_max.
        let size = voxel.magnitude * factors.size;
        // T = 1 draws the whole list, except for the fraction of a point by which it is too long.
        let whole_list = self.still[i].piece * (self.points.full / each as f64);
        // Eq. 2: the share T of the list. A pen has one size, so its ink N_i·S_i² decides the number of dots instead.
        let (share, size, unit) = match self.nib {
            None => (factors.count * whole_list, size, self.stipples.size),
            Some(nib) => {
                let ink = factors.count * (size * size);
                let ink = self.tone.map_or(ink, |tone| tone.share(ink));
                let (share, size) = with_nib(ink * whole_list, self.stipples.size / nib);
                (share, size, nib)
            }
        };
        let radius = 0.5 * unit * size;
        if radius <= 0.0 {
            return;
        }
        // The prefix of the list: dots to draw, or candidates that are thinned on the page later.
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
        // Each point is projected.
        let reach = self.surface.is_some().then(|| hidden::reach(&self.points.grid, voxel.normal));
        let list = &self.points.of(i)[..listed];
        for (k, offset) in list.iter().enumerate() {
            let o = DVec3::from_array(offset.map(f64::from));
            if let Some(on_page) = place.on_page(at + place.to_eye * o, self.stipples.near) {
                let world = place.world(centre + o);
                if self.stipples.clip.cut_in_world(world) {
                    continue;
                }
                if let Some(reach) = reach {
                    part.points.push(SurfacePoint { at: world, normal: voxel.normal, reach });
                }
                let opacity = if k < whole { opacity } else { fading };
                part.dots.push(Dot { at: on_page, world, radius, opacity });
            }
        }
    }
}

/// Selects the dots of one frame from its candidates, evenly on the page across all pens ([STIP-19]). A candidate's
/// opacity is the number of dots it stands for.
pub fn choose_on_page(drawn: &mut [FrameDots]) {
    let all = || drawn.iter().flat_map(FrameDots::dots);
    let candidates: Vec<DotCandidate> = all().map(|dot| DotCandidate { at: dot.at, share: dot.opacity }).collect();
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

/// The map from index space to the page.
pub(super) struct IndexToPage {
    /// The map from index to eye space: the linear part, and the image of index 0.
    to_eye: DMat3,
    origin: DVec3,
    to_world: DMat3,
    world_origin: DVec3,
    perspective: bool,
    /// Millimetres per unit of eye space, at depth 1 in perspective.
    scale: DVec2,
    /// The picture's middle and half its size, in mm.
    middle: DVec2,
    half: DVec2,
}

impl IndexToPage {
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

    /// The place on the page of a place in eye space. Returns none outside the picture.
    fn on_page(&self, at: DVec3, near: f64) -> Option<DVec2> {
        let off = self.off(at, near)?;
        (self.beyond(off) == [0.0; 2]).then(|| self.at(off))
    }

    /// Offset from the picture's middle in mm, inside or outside the picture. Returns none nearer than `near` in
    /// perspective.
    pub(super) fn off(&self, at: DVec3, near: f64) -> Option<DVec2> {
        let flat = DVec2::new(at.x, at.y) * self.scale;
        match self.perspective {
            true if -at.z < near => None,
            true => Some(flat / -at.z),
            false => Some(flat),
        }
    }

    /// The place on the page at an offset from the picture's middle.
    pub(super) fn at(&self, off: DVec2) -> DVec2 {
        self.middle + off
    }

    /// The side of the picture beyond which an offset lies: −1, 0 or 1 along each axis.
    pub(super) fn beyond(&self, off: DVec2) -> [f64; 2] {
        [(off.x, self.half.x), (off.y, self.half.y)]
            .map(|(off, half)| if off.abs() <= half { 0.0 } else { off.signum() })
    }
}
