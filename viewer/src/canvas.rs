//! Frames of a volume for the window, and how coarse they are while the camera moves.

use crate::present::Presenter;
use drypoint::Failure;
use drypoint::frames::{Frames, ReferenceFrames};
use drypoint::gpu::{GpuFrames, wgpu};
use drypoint::output::png::rgba_codes;
use drypoint::scene::picture::Picture;
use drypoint::scene::shot::Shot;
use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// The pixels of a frame.
pub enum Pixels {
    /// A texture on the window's device, of sRGB codes of premultiplied colours.
    Texture(wgpu::Texture),
    /// Bytes in straight sRGB, red, green, blue and opacity, row by row from the top.
    Bytes(Vec<u8>),
}

/// A frame of the volume.
pub(crate) struct Drawn {
    pub(crate) size: [usize; 2],
    pub(crate) pixels: Pixels,
    pub(crate) seconds: f64,
}

/// The frames of a job's volume.
pub(crate) enum Canvas<'j> {
    /// On a card.
    Card(Box<GpuFrames>),
    /// In memory, by the reference.
    Memory(Box<ReferenceFrames<'j>>),
}

impl Canvas<'_> {
    /// Takes the camera and the size of a shot.
    pub(crate) fn turn(&mut self, shot: &Shot) -> Result<(), Failure> {
        match self {
            Self::Card(frames) => frames.turn(shot),
            Self::Memory(frames) => frames.turn(shot),
        }
    }

    /// Whether a first frame is taken to be slow.
    pub(crate) fn is_slow(&self, card: Option<&Presenter>) -> bool {
        !matches!(self, Self::Card(_)) || card.is_none_or(|card| card.gpu().is_software())
    }

    /// Draws a frame. The reference returns none if it is stopped.
    pub(crate) fn draw(&mut self, card: Option<&Presenter>, stop: &AtomicBool) -> Result<Option<Drawn>, Failure> {
        let start = Instant::now();
        let (size, pixels) = match (self, card) {
            (Self::Card(frames), Some(card)) => {
                frames.show()?;
                let Some(shown) = frames.shown() else { return Ok(None) };
                let size = [shown.width() as usize, shown.height() as usize];
                (size, Pixels::Texture(card.present(shown)?))
            }
            (Self::Card(frames), None) => match frames.frame_until(&|_| (), stop)? {
                Some((picture, _)) => codes(&picture)?,
                None => return Ok(None),
            },
            (Self::Memory(frames), _) => match frames.frame_until(&|_| (), stop)? {
                Some((picture, _)) => codes(&picture)?,
                None => return Ok(None),
            },
        };
        Ok(Some(Drawn { size, pixels, seconds: start.elapsed().as_secs_f64() }))
    }
}

/// Returns the size of a picture and its bytes, those of its PNG.
pub(crate) fn codes(picture: &Picture) -> Result<([usize; 2], Pixels), Failure> {
    let bytes = rgba_codes(picture, 8).map_err(|error| Failure::picture(&error, "the window"))?;
    Ok(([picture.width, picture.height], Pixels::Bytes(bytes)))
}

/// Seconds of a frame while the camera moves.
const QUICK: f64 = 0.1;

/// The divisor of sides of the first frame of what is slow.
const FIRST: usize = 4;

/// The largest divisor of sides.
const COARSEST: usize = 8;

/// Seconds of frames, which tell how coarse they are while the camera moves.
#[derive(Debug, Default)]
pub(crate) struct Pace {
    exact: Option<f64>,
    /// Seconds of a coarse frame, times the square of its divisor: those of a frame with one ray a pixel.
    one_ray: Option<f64>,
}

impl Pace {
    /// Returns the divisors of the sides of frames after a move, the coarsest first. The last one is 1, the exact frame.
    pub(crate) fn divisors(&self, is_slow: bool) -> Vec<NonZeroUsize> {
        let coarse = match (self.exact, self.one_ray) {
            (Some(exact), _) if exact <= QUICK => 1,
            (exact, one_ray) => match one_ray.or(exact) {
                Some(seconds) => (seconds / QUICK).sqrt().ceil().clamp(2.0, COARSEST as f64) as usize,
                None if is_slow => FIRST,
                None => 1,
            },
        };
        // Each frame has about four times the pixels of the one before it.
        let halves = std::iter::successors(Some(coarse), |divisor| Some(divisor / 2).filter(|half| *half > 1));
        let coarse = halves.filter(|divisor| *divisor > 1).filter_map(NonZeroUsize::new);
        coarse.chain([NonZeroUsize::MIN]).collect()
    }

    /// Takes the seconds of a frame with sides divided by `divisor`.
    pub(crate) fn learn(&mut self, divisor: NonZeroUsize, seconds: f64) {
        match divisor.get() {
            1 => self.exact = Some(seconds),
            n => self.one_ray = Some(seconds * (n * n) as f64),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_coarse_if_exact_ones_take_long() {
        let mut pace = Pace::default();
        let divisors =
            |pace: &Pace, is_slow| pace.divisors(is_slow).into_iter().map(NonZeroUsize::get).collect::<Vec<_>>();
        assert_eq!([true, false].map(|is_slow| divisors(&pace, is_slow)), [vec![4, 2, 1], vec![1]]);
        for (exact, expected) in [(0.5 * QUICK, vec![1]), (9.0 * QUICK, vec![3, 1]), (1e9, vec![8, 4, 2, 1])] {
            pace.learn(NonZeroUsize::MIN, exact);
            assert_eq!(divisors(&pace, true), expected);
        }
        // A coarse frame tells better how long others take.
        pace.learn(NonZeroUsize::new(4).unwrap(), QUICK);
        assert_eq!(divisors(&pace, true), [4, 2, 1]);
    }
}
