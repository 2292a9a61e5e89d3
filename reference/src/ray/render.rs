//! A shot prepared for rendering any number of frames.

use super::composite::{plane_order, ray_order};
use super::draw::{Band, Casting, Drawn, draw, largest_band, rays_of_tiles};
use super::error::RenderError;
use super::lanes;
use super::lattice::samples_in;
use super::line_point::{LinePoint, line_point};
use super::merged;
use super::pick::{Picked, VISIBLE, pick};
use super::prepare::{prepare, turn};
use super::prepare_object::gradient_range;
use super::prepared::Prepared;
use super::progress::FrameProgress;
use super::refinement::{bytes_a_pixel, draw_refined};
use super::tile_work::TileWork;
use crate::field::Sampler;
use crate::labels::Labels;
use crate::number::Real;
use crate::with_sampler;
use drypoint_scene::backdrop::Backdrop;
use drypoint_scene::color::Rgb;
use drypoint_scene::counts::Counts;
use drypoint_scene::fragments::Fragments;
use drypoint_scene::inputs::Inputs;
use drypoint_scene::phantom::Phantom;
use drypoint_scene::picture::Picture;
use drypoint_scene::shot::{Number, Shot};
use std::sync::atomic::AtomicBool;

/// Pixels along the side of a tile. A thread works on one tile at a time.
const TILE: usize = 8;

/// Rays that wait for each other in plane order, so that not all states need be in memory. Each band has a guard band
/// of its own, so a small band is slow.
const BAND: usize = 1 << 20;

/// A shot that is prepared for rendering any number of times.
pub struct Renderer<'a> {
    ready: Ready<'a>,
    background: Backdrop<'a>,
    /// The labels at the volume's positions, for picking, if there are labels.
    labels: Option<Labels<'a>>,
    counts: Counts,
    tile: usize,
    band: usize,
    order: Order,
}

/// The order in which samples are visited. Without halos it changes neither the picture nor the counts. With halos the
/// order is always plane by plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Order {
    /// Ray by ray, eight rays side by side.
    Lanes,
    /// Ray by ray.
    Rays,
    /// Plane by plane.
    Planes,
}

enum Ready<'a> {
    F64(Box<Prepared<'a, f64>>),
    F32(Box<Prepared<'a, f32>>),
}

impl<'a> Renderer<'a> {
    /// Prepares a shot: reconstruction, ranges, visible bricks.
    ///
    /// # Errors
    /// The reconstruction does not exist, sample planes coincide, or data that the shot names are missing.
    pub fn new(shot: &Shot, inputs: Inputs<'a>) -> Result<Self, RenderError> {
        let mut counts = Counts::default();
        let ready = match shot.number {
            Number::F64 => Ready::F64(Box::new(prepare(shot, &inputs, &mut counts)?)),
            Number::F32 => Ready::F32(Box::new(prepare(shot, &inputs, &mut counts)?)),
        };
        Ok(Self::of(ready, shot, &inputs, counts))
    }

    /// Prepares the picture to which reconstructions converge ([COST-2]). A phantom's formula and its derivatives take
    /// the place of the voxels, in f64; all else is as in the shot. The volume gives the grid, labels and further
    /// quantities.
    ///
    /// # Errors
    /// See [`Renderer::new`]. Objects are errors too, because they are drawn from voxels.
    pub fn exact(shot: &Shot, inputs: Inputs<'a>, phantom: &'a dyn Phantom) -> Result<Self, RenderError> {
        let mut counts = Counts::default();
        if shot.combination.is_some() {
            return Err(RenderError::ExactObjects);
        }
        let mut prepared: Prepared<'a, f64> = prepare(shot, &inputs, &mut counts)?;
        // Ranges of bricks are those of the voxels.
        prepared.skip = None;
        prepared.cells = None;
        if let Some(surface) = &mut prepared.surface {
            surface.roots.look_everywhere();
        }
        if let Some(halos) = &mut prepared.halos {
            halos.skip = None;
        }
        prepared.object.field = prepared.object.field.with_formula(phantom);
        let object = shot.background();
        if let Some(range) = object.gradient_range {
            prepared.object.gradient_range = Some(gradient_range(&prepared.object.field, range, &mut counts));
        }
        Ok(Self::of(Ready::F64(Box::new(prepared)), shot, &inputs, counts))
    }

    fn of(ready: Ready<'a>, shot: &Shot, inputs: &Inputs<'a>, mut counts: Counts) -> Self {
        let (object, volume) = (shot.background(), inputs.main.volume);
        counts.bytes.insert("volume".into(), volume.voxels().bytes() as u64);
        if let Some(mask) = volume.mask() {
            counts.bytes.insert("mask".into(), mask.bytes() as u64);
        }
        let order = match &ready {
            Ready::F64(p) if p.halos.is_none() && lanes::serve(p) => Order::Lanes,
            _ => Order::Rays,
        };
        let labels = inputs.main.labels;
        let labels = labels.map(|labels| Labels::new(labels, volume.grid(), volume.anatomy(), object.label_lookup));
        Self { ready, background: inputs.background, labels, counts, tile: TILE, band: BAND, order }
    }

    /// Sets the side of tiles, from 1 to 1024 pixels. It does not change the result ([RAY-3]).
    pub fn with_tiles(self, side: usize) -> Self {
        Self { tile: side.clamp(1, 1024), ..self }
    }

    /// Sets about how many rays wait for each other with halos. At least a row of tiles does. It does not change the
    /// result.
    pub fn with_band(self, rays: usize) -> Self {
        Self { band: rays, ..self }
    }

    /// Casts each ray alone, as on a processor without wide registers, if there are no halos. This changes neither the
    /// picture nor the counts.
    pub fn ray_by_ray(self) -> Self {
        Self { order: Order::Rays, ..self }
    }

    /// Casts the rays of each tile together, plane by plane. This changes neither the picture nor the counts.
    pub fn plane_by_plane(self) -> Self {
        Self { order: Order::Planes, ..self }
    }

    /// Bytes for each pixel that adaptive refinement needs beside the picture; 0 without refinement.
    pub fn bytes_of_refinement(&self) -> usize {
        fn of<R>(p: &Prepared<'_, R>) -> usize {
            p.refine_above.map_or(0, |_| bytes_a_pixel(&p.layers))
        }
        match &self.ready {
            Ready::F64(p) => of(p),
            Ready::F32(p) => of(p),
        }
    }

    /// n of the n×n rays of a pixel that is not refined.
    pub fn rays_across(&self) -> usize {
        match &self.ready {
            Ready::F64(p) => p.rays_across,
            Ready::F32(p) => p.rays_across,
        }
    }

    /// About how many samples a frame has, if none is skipped and no pixel is refined.
    pub fn samples(&self) -> f64 {
        fn of<R: Real>(p: &Prepared<'_, R>) -> f64 {
            let of_objects = p.combination.as_ref().map_or(0.0, |objects| objects.samples(&p.lattice, &p.view));
            let of_ray = samples_in(&p.lattice, &p.view, p.object.volume.grid()) + of_objects;
            of_ray * (p.rays_across * p.rays_across) as f64
        }
        match &self.ready {
            Ready::F64(p) => of(p),
            Ready::F32(p) => of(p),
        }
    }

    /// Bytes that a frame with halos needs beside its picture; 0 without halos.
    pub fn bytes_of_halos(&self) -> u64 {
        fn of<R: Real>(p: &Prepared<'_, R>, [tile, band]: [usize; 2]) -> u64 {
            let Some(halos) = &p.halos else { return 0 };
            plane_order::bytes_with_halos(p, halos, largest_band(p, tile, band))
        }
        let sides = [self.tile, self.band];
        match &self.ready {
            Ready::F64(p) => of(p, sides),
            Ready::F32(p) => of(p, sides),
        }
    }

    /// Whether rays are cast in lanes, eight at a time.
    pub fn in_lanes(&self) -> bool {
        self.order == Order::Lanes
    }

    /// Takes the camera, the lights, the size and the rays a pixel of another shot for the following frames. Nothing else
    /// may differ between the shots, but for reaches of halos and of funnels in pixels. Lines inside the volume stay those
    /// of the camera before.
    ///
    /// # Errors
    /// Sample planes coincide as seen from the camera, or the size differs from that of the picture behind the volume.
    pub fn turn(&mut self, shot: &Shot) -> Result<(), RenderError> {
        let size = match &self.ready {
            Ready::F64(p) => p.view.size,
            Ready::F32(p) => p.view.size,
        };
        if matches!(self.background, Backdrop::Pixels(_)) && shot.view.size != size {
            return Err(RenderError::BackdropSize { size: shot.view.size });
        }
        match &mut self.ready {
            Ready::F64(p) => turn(p, shot),
            Ready::F32(p) => turn(p, shot),
        }
    }

    /// Puts lines for the current camera inside the following frames, or removes them ([HATCH-14] d).
    pub fn merge(&mut self, lines: Option<Fragments>) {
        match &mut self.ready {
            Ready::F64(p) => p.lines = lines,
            Ready::F32(p) => p.lines = lines,
        }
    }

    /// The counts of the preparation, which each [`frame`](Self::frame) includes.
    pub fn prepared(&self) -> &Counts {
        &self.counts
    }

    /// Renders one frame. `progress` receives the share of the picture that is done, on any thread.
    pub fn frame(&self, progress: &(dyn Fn(f64) + Sync)) -> (Picture, Counts) {
        let (picture, mut counts) = self.again(progress);
        counts.add(&self.counts);
        (picture, counts)
    }

    /// Renders a further frame. Its counts do not include the preparation.
    pub fn again(&self, progress: &(dyn Fn(f64) + Sync)) -> (Picture, Counts) {
        let [stop, stopped] = [false; 2].map(AtomicBool::new);
        self.drawn(FrameProgress { hear: progress, stop: &stop, stopped: &stopped, between: [0.0, 1.0] })
    }

    /// Renders a further frame. If `stop` becomes true before it is complete, drawing stops and the result is none.
    pub fn again_until(&self, progress: &(dyn Fn(f64) + Sync), stop: &AtomicBool) -> Option<(Picture, Counts)> {
        let stopped = AtomicBool::new(false);
        let drawn = self.drawn(FrameProgress { hear: progress, stop, stopped: &stopped, between: [0.0, 1.0] });
        (!stopped.into_inner()).then_some(drawn)
    }

    /// Draws a frame, or part of it if it is stopped.
    fn drawn(&self, progress: FrameProgress<'_>) -> (Picture, Counts) {
        let (picture, mut counts) = match &self.ready {
            Ready::F64(p) => with_sampler!(p.object.field, |s| self.draw(p, s, progress)),
            Ready::F32(p) => self.draw(p, &p.object.field, progress),
        };
        let channels: usize = picture.layers.iter().map(|l| l.channels.len()).sum();
        counts.bytes.insert("picture".into(), (channels * picture.width * picture.height * 8) as u64);
        (picture, counts)
    }

    /// Picks the first visible structure on the ray through a point of the picture, in pixels from the top left corner.
    /// The centre of pixel (i, j) is (i + ½, j + ½).
    ///
    /// It is the first sample at which the accumulated opacity reaches [`VISIBLE`], so haze and noise
    /// in front are ignored. If the ray stays below, it is the sample with the largest weight. The iso-surface and
    /// meshes count as samples at their own depths. Lines inside the picture are ignored. Returns none if nothing is
    /// visible, or outside the picture.
    pub fn pick(&self, point: [f64; 2]) -> Option<Picked> {
        self.pick_from(VISIBLE, point)
    }

    /// Picks what is seen at a point, as [`pick`](Self::pick) does, but from the accumulated opacity `visible` on. With
    /// ½ it is the structure behind a veil.
    pub fn pick_from(&self, visible: f64, point: [f64; 2]) -> Option<Picked> {
        let labels = self.labels.as_ref();
        match &self.ready {
            Ready::F64(p) => pick(p, labels, point, visible),
            Ready::F32(p) => pick(p, labels, point, visible),
        }
    }

    /// Returns the look of an opaque line's point at an eye depth, seen at a point of the picture in pixels from the top
    /// left corner ([VS-8]). Halos and other lines are ignored.
    pub fn line_point(&self, point: [f64; 2], depth: f64, rgb: Rgb) -> LinePoint {
        match &self.ready {
            Ready::F64(p) => line_point(p, point, depth, rgb),
            Ready::F32(p) => line_point(p, point, depth, rgb),
        }
    }

    /// Casts the rays of a frame in the renderer's order.
    fn draw<R: Real, S: Sampler<R>>(
        &self,
        prepared: &Prepared<'_, R>,
        sampler: &S,
        progress: FrameProgress<'_>,
    ) -> (Picture, Counts) {
        let alone = |work: TileWork<'_>| ray_order::cast_all(prepared, sampler, work);
        let draw = |casting: Casting<'_>| {
            if let (Some(contrast), Casting::ByTile(cast_all)) = (prepared.refine_above, &casting) {
                return draw_refined(prepared, contrast, *cast_all, self.background, self.tile, progress);
            }
            let drawn = Drawn { layers: &prepared.layers, keeps_sums: false };
            let (picture, _, counts) =
                draw(prepared, &drawn, &casting, self.background, [self.tile, self.band], progress);
            (picture, counts)
        };
        if let Some(halos) = &prepared.halos {
            return draw(Casting::ByBand(&|band: Band| {
                let progress = progress.part(band.share);
                let tiles = rays_of_tiles(prepared, self.tile, &band);
                plane_order::cast_with_halos((prepared, halos), tiles, band.region, progress)
            }));
        }
        match (&self.ready, self.order) {
            (Ready::F64(p), Order::Lanes)
                if p.lines.is_none() && p.object.clip.planes.is_empty() && p.combination.is_none() =>
            {
                draw(Casting::ByTile(&|work: TileWork<'_>| lanes::cast_all(p, work)))
            }
            (Ready::F64(p), Order::Lanes) => {
                let together = |work: TileWork<'_>| lanes::cast_all(p, work);
                draw(Casting::ByTile(&|work: TileWork<'_>| merged::cast_apart(p, [&alone, &together], work)))
            }
            (_, Order::Lanes | Order::Rays) => draw(Casting::ByTile(&alone)),
            (_, Order::Planes) => draw(Casting::ByTile(&|work: TileWork<'_>| plane_order::cast_all(prepared, work))),
        }
    }
}
