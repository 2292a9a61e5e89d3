//! The images of one halo on the planes of a picture, from seeds to halo intensities ([HALO-4], [HALO-5]).

use super::gradient_image::gradient_magnitude;
use super::median::median;
use super::spans::SpanImage;
use super::spreading::{copy, pass};
use super::taps::{Border, Taps};
use drypoint_scene::parallel;
use drypoint_scene::shot::halo;
use std::mem::swap;

/// The parameters of the spreading process.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpreadParams {
    /// Whether the gradient magnitude of the seeds is spread, or the seeds themselves.
    pub from_gradient: bool,
    /// N, the number of passes.
    pub passes: u32,
    /// δ in [0, 1], the amount of spreading.
    pub delta: f64,
    /// q ≥ 1: the ratio of distances in pixels to those of the paper.
    pub stretch: f64,
    /// Whether a 3×3 median of the seeds comes first.
    pub median: bool,
    /// Least halo intensity: values of H below are 0. H₀ keeps them.
    pub floor: f64,
}

impl SpreadParams {
    /// Returns the distance k of the taps of pass i, 1 … N: q·2^(N − i) pixels.
    fn distance(&self, i: u32) -> f64 {
        halo::tap_distance(self.stretch, self.passes - i)
    }

    /// Returns the distance q of the taps of the gradient.
    pub(super) fn tap(&self) -> f64 {
        halo::tap_distance(self.stretch, 0)
    }

    /// Returns the width of the guard band in pixels. H at a pixel depends only on pixels within it. For q = 1 the
    /// width is 2^N + 1, plus one with the median.
    pub fn guard(&self) -> usize {
        halo::guard(self.passes, self.stretch, self.median)
    }
}

/// A stage of the process whose image [`HaloField`] computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Process {
    /// H₀ itself.
    Source,
    /// N passes of the filter F alone: H_i = F_i.
    LowPass,
    /// N passes that mix F with H₀.
    Spread,
}

/// The images of one halo on the planes: seeds S, intensities H.
#[derive(Clone, Debug)]
pub struct HaloField {
    size: [usize; 2],
    spread: SpreadParams,
    border: Border,
    /// S.
    seeds: SpanImage,
    /// H₀.
    source: SpanImage,
    /// H, and H_{i−1} between passes.
    field: SpanImage,
    /// H_i while it is written.
    next: SpanImage,
    /// A row of zeros.
    zeros: Vec<f64>,
    /// Whether the caller may have written seeds since they were last zero.
    seeded: bool,
    passes_done: u64,
}

impl HaloField {
    /// The number of buffers of the images' size.
    pub const BUFFERS: u64 = 4;

    /// Makes zero images with a zero border. `size` is width and height with the guard band.
    pub fn new(size: [usize; 2], spread: SpreadParams) -> Self {
        Self::with_border(size, spread, Border::Zero)
    }

    /// Makes zero images with a given border.
    pub fn with_border(size: [usize; 2], spread: SpreadParams, border: Border) -> Self {
        let image = || SpanImage::new(size);
        let [seeds, source, field, next] = [image(), image(), image(), image()];
        let zeros = vec![0.0; size[0]];
        Self { size, spread, border, seeds, source, field, next, zeros, seeded: false, passes_done: 0 }
    }

    /// Returns the number of bytes of images of a size. The number saturates for huge sizes.
    pub fn bytes_of([width, height]: [usize; 2]) -> u64 {
        let pixels = (width as u64).saturating_mul(height as u64).saturating_mul(8);
        // Each row has a range of two numbers, and there is a row of zeros.
        let rows = (height as u64).saturating_mul(16);
        let images = Self::BUFFERS.saturating_mul(pixels.saturating_add(rows));
        images.saturating_add((width as u64).saturating_mul(8))
    }

    /// Returns the bytes of the images.
    pub fn bytes(&self) -> u64 {
        Self::bytes_of(self.size)
    }

    /// Width and height with the guard band.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Returns S, row by row. S is zero after [`new`](Self::new) and after [`generate`](Self::generate). Seeds must be
    /// in [0, 1].
    ///
    /// After a call, the next generation searches the image for seeds. Otherwise it costs nothing.
    pub fn seeds_mut(&mut self) -> &mut [f64] {
        self.seeded = true;
        self.seeds.values_mut()
    }

    /// Returns H, row by row.
    pub fn intensities(&self) -> &[f64] {
        self.field.values()
    }

    /// Returns the range of a row outside which H is zero. The range may be empty.
    pub fn intensity_range(&self, y: usize) -> std::ops::Range<usize> {
        let span = self.field.row(y).1;
        span.start..span.end
    }

    /// Sets H to zero. The cost is proportional to the pixels that are not zero.
    pub fn clear(&mut self) {
        self.field.clear();
    }

    /// Returns the number of passes over a buffer so far: medians, gradients, and passes of the filter.
    pub fn passes_done(&self) -> u64 {
        self.passes_done
    }

    /// Computes H from the seeds, and sets the seeds to zero. Returns whether any H is not zero.
    pub fn generate(&mut self) -> bool {
        self.generate_as(Process::Spread)
    }

    /// Like [`generate`](Self::generate), but H is the result of a stage of the process.
    pub fn generate_as(&mut self, process: Process) -> bool {
        if std::mem::take(&mut self.seeded) {
            self.seeds.find_spans();
        }
        if self.seeds.rows().is_empty() {
            self.clear();
            return false;
        }
        // The pool of threads is entered once for all passes.
        if self.seeds.is_large() {
            parallel::in_pool(&mut || self.make(process));
        } else {
            self.make(process);
        }
        !self.field.rows().is_empty()
    }

    fn make(&mut self, process: Process) {
        let Self { spread, border, ref zeros, .. } = *self;
        let side = self.size[0].max(self.size[1]);
        // S, filtered.
        if spread.median {
            median(&self.seeds, border, zeros, &mut self.next);
            swap(&mut self.seeds, &mut self.next);
            self.passes_done += 1;
        }
        // H₀.
        if spread.from_gradient {
            gradient_magnitude(&self.seeds, Taps::new(spread.tap(), side), border, zeros, &mut self.source);
            self.passes_done += 1;
        } else {
            swap(&mut self.seeds, &mut self.source);
        }
        self.seeds.clear();
        // H_1 … H_N, each from the one before and H₀.
        let mix = (process == Process::Spread).then_some((spread.delta, &self.source));
        let passes = if process == Process::Source { 0 } else { spread.passes };
        for i in 1..=passes {
            let before = if i == 1 { &self.source } else { &self.field };
            let (k, floor) = (Taps::new(spread.distance(i), side), (i == passes).then_some(spread.floor));
            pass(before, mix, k, floor, border, zeros, &mut self.next);
            swap(&mut self.field, &mut self.next);
        }
        if passes == 0 {
            copy(&self.source, spread.floor, &mut self.field);
        }
        self.passes_done += u64::from(passes);
    }
}

#[cfg(test)]
mod tests;
