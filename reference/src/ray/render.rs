//! A picture of a scene: what it is made of, and what can be wrong with that.

use super::cast::{self, Cast};
use super::draw::{CastAll, draw};
use super::lanes;
use super::lattice::MOST_SAMPLES;
use super::merged;
use super::prepare::{gradient_range, prepare, turn};
use super::prepared::Prepared;
use super::skip::Boxes;
use crate::field::{Exact, FieldError, Sampler};
use crate::number::Real;
use crate::transfer::NodesError;
use crate::with_sampler;
use drypoint_scene::color::Rgba;
use drypoint_scene::counts::Counts;
use drypoint_scene::fragments::Fragments;
use drypoint_scene::phantom::Phantom;
use drypoint_scene::picture::Picture;
use drypoint_scene::plan::Plan;
use drypoint_scene::style::Style;
use drypoint_scene::tables::{Number, Scene};
use drypoint_scene::transfer::Function;
use drypoint_scene::view::{View, ViewError};
use drypoint_scene::volume::Volume;
use drypoint_scene::volume::labels::LabelVolume;
use std::time::Instant;

/// Pixels along the side of a tile, the work of one thread at a time.
const TILE: usize = 8;

/// What a picture is made of.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// What it calls for.
    pub plan: &'a Plan,
    /// Its volume.
    pub volume: &'a Volume,
    /// Its transfer function, over the volume's values.
    pub function: &'a Function,
    /// The labels beside the volume, where the plan needs them ([STF-13]).
    pub labels: Option<&'a LabelVolume>,
    /// The further volumes that the function is over, one for each of its quantities that is one ([STF-4]).
    pub further: [Option<&'a Volume>; 2],
    /// The styles that the function names, in the order of [`Function::Style::names`].
    pub styles: &'a [Style],
    /// What lies behind.
    pub background: Backdrop<'a>,
}

/// What lies behind the volume, linear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Backdrop<'a> {
    /// Nothing.
    None,
    /// One straight colour.
    Color(Rgba),
    /// Premultiplied pixels of the picture's size, row by row from the top.
    Pixels(&'a [Rgba]),
}

/// A picture that cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RenderError {
    /// The field cannot be reconstructed as the scene asks.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// The camera sees nothing.
    #[error(transparent)]
    View(#[from] ViewError),
    /// A length of the scene has no size in the world.
    #[error("{key} is a length on the page, not in the volume")]
    Length {
        /// The scene key.
        key: &'static str,
    },
    /// Sample planes that fall together ([RAY-1]): k + ½ has no half from 2⁵² on.
    #[error("the volume reaches {planes:.1e} steps from the eye, where sample planes are not told apart any more")]
    TooManyPlanes {
        /// The largest distance from the eye, in steps.
        planes: f64,
    },
    /// More samples than can be evaluated in months.
    #[error("the rays have some {samples:.1e} samples, more than {:.0e}, which would take months", MOST_SAMPLES)]
    Endless {
        /// Samples of all rays, if none is skipped.
        samples: f64,
    },
    /// The nodes make no function.
    #[error(transparent)]
    Nodes(#[from] NodesError),
    /// A quantity of the function is a volume that was not handed over.
    #[error("the transfer function is over a further volume, and none was loaded")]
    NoFurtherVolume,
    /// A quantity of the function reads labels, and there are none.
    #[error("the transfer function reads labels, and there are none")]
    NoLabels,
    /// A distance to a label that no voxel has.
    #[error("no voxel has the label {id}")]
    NoSuchLabel {
        /// The label.
        id: u32,
    },
    /// The function's nodes and the styles do not fit.
    #[error("the transfer function names {named} styles, {given} were loaded")]
    Styles {
        /// Styles that the function names.
        named: usize,
        /// Styles that were handed over.
        given: usize,
    },
}

/// A scene that is ready to be rendered any number of times.
pub struct Renderer<'a> {
    ready: Ready<'a>,
    scene: &'a Scene,
    background: Backdrop<'a>,
    counts: Counts,
    tile: usize,
    /// Whether rays are cast side by side.
    lanes: bool,
}

enum Ready<'a> {
    F64(Box<Prepared<'a, f64>>),
    F32(Box<Prepared<'a, f32>>),
    Exact(Box<Prepared<'a, f64>>, &'a dyn Phantom),
}

impl<'a> Renderer<'a> {
    /// Prepares a scene: reconstruction, ranges, visible bricks.
    ///
    /// # Errors
    /// A reconstruction that does not exist, a camera without direction, a length without size.
    pub fn new(inputs: Inputs<'a>) -> Result<Self, RenderError> {
        let start = Instant::now();
        let mut counts = Counts::default();
        let ready = match inputs.scene.sampling.number {
            Number::F64 => Ready::F64(Box::new(prepare(&inputs, &mut counts)?)),
            Number::F32 => Ready::F32(Box::new(prepare(&inputs, &mut counts)?)),
        };
        Ok(Self::of(ready, &inputs, counts, start))
    }

    /// Prepares the picture that reconstructions converge to: of a phantom's own formula and its derivatives in place of
    /// the voxels, in f64, with every other key as the scene has it ([COST-2]). The volume says the grid, and is where
    /// labels and further quantities belong.
    ///
    /// # Errors
    /// As [`Renderer::new`].
    pub fn exact(inputs: Inputs<'a>, phantom: &'a dyn Phantom) -> Result<Self, RenderError> {
        let start = Instant::now();
        let mut counts = Counts::default();
        let mut prepared: Prepared<'a, f64> = prepare(&inputs, &mut counts)?;
        // Ranges of bricks are those of the voxels.
        prepared.skip = None;
        prepared.cells = None;
        if let Some(surface) = &mut prepared.surface {
            surface.look_everywhere();
        }
        let exact = Exact::new(phantom, inputs.volume.grid(), prepared.field.scale_exponent());
        if prepared.gradient_range.is_some() {
            prepared.gradient_range = Some(gradient_range(&exact, &prepared.field, &inputs, &mut counts));
        }
        Ok(Self::of(Ready::Exact(Box::new(prepared), phantom), &inputs, counts, start))
    }

    fn of(ready: Ready<'a>, inputs: &Inputs<'a>, mut counts: Counts, start: Instant) -> Self {
        counts.bytes.insert("volume".into(), inputs.volume.voxels().bytes() as u64);
        if let Some(mask) = inputs.volume.mask() {
            counts.bytes.insert("mask".into(), mask.bytes() as u64);
        }
        counts.seconds.insert("prepare".into(), start.elapsed().as_secs_f64());
        let lanes = matches!(&ready, Ready::F64(p) if lanes::serve(p));
        Self { ready, scene: inputs.scene, background: inputs.background, counts, tile: TILE, lanes }
    }

    /// The same with tiles of another side, from 1 to 1024 pixels; it shows nowhere ([RAY-3]).
    pub fn with_tiles(self, side: usize) -> Self {
        Self { tile: side.clamp(1, 1024), ..self }
    }

    /// The same with each ray cast alone, as where the processor has no wide registers; it shows nowhere, neither in the
    /// picture nor in the counts.
    pub fn ray_by_ray(self) -> Self {
        Self { lanes: false, ..self }
    }

    /// About how many samples a frame has, if none is skipped.
    pub fn samples(&self) -> f64 {
        fn of<R: Real>(p: &Prepared<'_, R>) -> f64 {
            p.lattice.samples(&p.view, p.volume.grid()) * (p.samples * p.samples) as f64
        }
        match &self.ready {
            Ready::F64(p) | Ready::Exact(p, _) => of(p),
            Ready::F32(p) => of(p),
        }
    }

    /// Whether rays are cast in lanes, eight at a time.
    pub fn in_lanes(&self) -> bool {
        self.lanes
    }

    /// Turns the camera for the frames that follow: of the lens and the picture of the scene's own, elsewhere. What was
    /// prepared stays.
    ///
    /// # Errors
    /// Sample planes that fall together, seen from there.
    pub fn turn(&mut self, view: View) -> Result<(), RenderError> {
        match &mut self.ready {
            Ready::F64(p) | Ready::Exact(p, _) => turn(p, self.scene, view),
            Ready::F32(p) => turn(p, self.scene, view),
        }
    }

    /// Puts lines inside the frames that follow, or takes them out: those of the camera that is there ([HATCH-14] d).
    pub fn merge(&mut self, lines: Option<Fragments>) {
        match &mut self.ready {
            Ready::F64(p) | Ready::Exact(p, _) => p.lines = lines,
            Ready::F32(p) => p.lines = lines,
        }
    }

    /// What preparing took and keeps; it is in the counts of each [`frame`](Self::frame).
    pub fn prepared(&self) -> &Counts {
        &self.counts
    }

    /// Renders one frame. `progress` hears the share of the picture that is done, from any thread.
    pub fn frame(&self, progress: &(dyn Fn(f64) + Sync)) -> (Picture, Counts) {
        let (picture, mut counts) = self.again(progress);
        counts.add(&self.counts);
        (picture, counts)
    }

    /// The same with what the frame itself took: a further one, prepared with the first.
    pub fn again(&self, progress: &(dyn Fn(f64) + Sync)) -> (Picture, Counts) {
        let start = Instant::now();
        let (picture, mut counts) = match &self.ready {
            Ready::F64(p) if self.lanes => {
                let together = |points: &[_], boxes: Option<&mut Boxes>, counts: &mut Counts, casts: &mut Vec<Cast>| {
                    lanes::cast_all(p, points, boxes, counts, casts);
                };
                if p.lines.is_none() {
                    draw(p, together, self.background, self.tile, progress)
                } else {
                    with_sampler!(p.field, |s| {
                        let alone = one_by_one(p, s);
                        let apart =
                            |points: &[_], boxes: Option<&mut Boxes>, counts: &mut Counts, casts: &mut Vec<_>| {
                                merged::cast_apart(p, [&alone, &together], points, boxes, counts, casts);
                            };
                        draw(p, apart, self.background, self.tile, progress)
                    })
                }
            }
            Ready::F64(p) => {
                with_sampler!(p.field, |s| draw(p, one_by_one(p, s), self.background, self.tile, progress))
            }
            Ready::F32(p) => {
                with_sampler!(p.field, |s| draw(p, one_by_one(p, s), self.background, self.tile, progress))
            }
            Ready::Exact(p, phantom) => {
                let exact = Exact::new(*phantom, p.volume.grid(), p.field.scale_exponent());
                draw(p, one_by_one(p, &exact), self.background, self.tile, progress)
            }
        };
        counts.seconds.insert("rays".into(), start.elapsed().as_secs_f64());
        let channels: usize = picture.layers.iter().map(|l| l.channels.len()).sum();
        counts.bytes.insert("picture".into(), (channels * picture.width * picture.height * 8) as u64);
        (picture, counts)
    }
}

/// Casts rays alone, each for itself.
fn one_by_one<R: Real, S: Sampler<R>>(prepared: &Prepared<'_, R>, sampler: &S) -> impl CastAll {
    move |points: &[[f64; 2]], boxes: Option<&mut Boxes>, counts: &mut Counts, casts: &mut Vec<Cast>| {
        cast::cast_all(prepared, sampler, points, boxes, counts, casts);
    }
}
