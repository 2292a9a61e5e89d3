//! Counts of the work of a render ([PLAN-2]). A count of work that was not done is 0, never left out.

use serde::Serialize;
use std::collections::BTreeMap;

/// Counts of one render. Serialized, it is the JSON object of `--stats`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Counts {
    /// Values reconstructed at samples of the ray loop.
    pub samples: u64,
    /// Gradients at samples.
    pub gradients: u64,
    /// Hessians at samples.
    pub hessians: u64,
    /// Lookups of one style's picture.
    pub style_lookups: u64,
    /// Values reconstructed at samples that are asked for the seeds of halos.
    pub halo_samples: u64,
    /// Passes over a halo buffer.
    pub halo_passes: u64,
    /// Rays cast.
    pub rays: u64,
    /// Pixels that got five or nine rays in place of one ([RAY-7]).
    pub refined_pixels: u64,
    /// Rays that evaluated no sample.
    pub rays_skipped: u64,
    /// Visible samples without a normal ([PREC-3]).
    pub without_normal: u64,
    /// Samples that were transparent because their cell touches a masked voxel ([PREC-2]).
    pub masked: u64,
    /// Stipple points.
    pub points: u64,
    /// Connected parts of the volume ([VOL-2]).
    pub parts: u64,
    /// Connected parts that are kept.
    pub parts_kept: u64,
    /// Voxels of each of at most a hundred parts, the largest first.
    pub part_sizes: Vec<u64>,
    /// Strokes.
    pub strokes: u64,
    /// Principal directions.
    pub directions: u64,
    /// Ends of strokes, by cause.
    pub stops: BTreeMap<String, u64>,
    /// Voxels evaluated once before the rays, by quantity.
    pub preprocess: BTreeMap<String, u64>,
    /// Size of each buffer.
    pub bytes: BTreeMap<String, u64>,
    /// Wall-clock seconds of passes. Renderers leave it empty.
    pub seconds: BTreeMap<String, f64>,
}

impl Counts {
    /// Adds the counts of another part of the same picture. Sums of integers do not depend on their order, so counts do
    /// not depend on threads or tiles.
    pub fn add(&mut self, other: &Self) {
        self.samples += other.samples;
        self.gradients += other.gradients;
        self.hessians += other.hessians;
        self.style_lookups += other.style_lookups;
        self.halo_samples += other.halo_samples;
        self.halo_passes += other.halo_passes;
        self.rays += other.rays;
        self.refined_pixels += other.refined_pixels;
        self.rays_skipped += other.rays_skipped;
        self.without_normal += other.without_normal;
        self.masked += other.masked;
        self.points += other.points;
        self.parts += other.parts;
        self.parts_kept += other.parts_kept;
        self.part_sizes.extend(&other.part_sizes);
        self.strokes += other.strokes;
        self.directions += other.directions;
        for (mine, theirs) in [
            (&mut self.stops, &other.stops),
            (&mut self.preprocess, &other.preprocess),
            (&mut self.bytes, &other.bytes),
        ] {
            for (key, n) in theirs {
                *mine.entry(key.clone()).or_default() += n;
            }
        }
        for (key, s) in &other.seconds {
            *self.seconds.entry(key.clone()).or_default() += s;
        }
    }

    /// Adds the counts of a further frame. Frames share their buffers, so that the larger size of each buffer is kept.
    pub fn add_frame(&mut self, frame: &Self) {
        let mut bytes = std::mem::take(&mut self.bytes);
        for (key, n) in &frame.bytes {
            let most = bytes.entry(key.clone()).or_default();
            *most = (*most).max(*n);
        }
        self.add(frame);
        self.bytes = bytes;
    }
}
