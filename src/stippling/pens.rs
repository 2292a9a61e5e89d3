//! Assignment of points to pens ([STIP-16]).

use super::PenDots;
use crate::Failure;
use crate::job::{Job, pen_named};
use drypoint_output::encode::hex;
use drypoint_reference::dot_colors::{VoxelColors, nearest, palette, split};
use drypoint_reference::labels::Labels;
use drypoint_scene::color::{Rgb, Rgba};
use drypoint_scene::marks::{Page, Pen};
use drypoint_scene::points::Points;
use drypoint_scene::tables::{DotColor, Mix, Scene};

/// Most layers of dots if no pens draw the colours of a transfer function.
const LAYERS: usize = 16;

/// Pens of points and lines.
pub(super) enum Pens {
    /// One pen for all, with the width of its nib if it is of `[[pen]]`.
    One(Pen, Option<f64>),
    /// The pen of `[[pen]]` with the nearest colour.
    Nearest(Vec<Pen>),
    /// A palette of the points' colours, in dots of at most that size, in mm.
    Few(f64),
}

impl Pens {
    /// Chooses the pens of a scene's dots, the largest of which are `width` mm wide.
    ///
    /// # Errors
    /// An unknown pen.
    pub(super) fn new(scene: &Scene, width: f64, page: &Page) -> Result<Self, Failure> {
        let stipples = scene.stipples.as_ref();
        let Some(name) = stipples.and_then(|stipples| stipples.pen.as_ref()) else {
            let pens = Pen::of(&scene.pens, page);
            return Ok(match stipples.map_or(DotColor::Transfer, |stipples| stipples.color) {
                DotColor::Fixed(color) => Self::One(Pen { number: 1, name: "stipples".into(), width, color }, None),
                DotColor::Transfer | DotColor::Label if pens.is_empty() => Self::Few(width),
                DotColor::Transfer | DotColor::Label => Self::Nearest(pens),
            });
        };
        pen_named(scene, page, name, "stipples.pen").map(|pen| Self::One(pen.clone(), Some(pen.width)))
    }

    /// Deals the points to the pens. Also returns the pen of lines: the only one, the darkest of `[[pen]]`, or a black
    /// one of its own.
    pub(super) fn deal(self, job: &Job, points: Points) -> Result<(Vec<PenDots>, Pen), Failure> {
        let (pens, nibs, of) = match self {
            Self::One(pen, nib) => return Ok((vec![PenDots { pen: pen.clone(), nib, points }], pen)),
            Self::Nearest(pens) => {
                let inks: Vec<Rgb> = pens.iter().map(|pen| rgb(pen.color)).collect();
                let of = nearest(&colors(job, &points)?, &inks);
                (pens, true, of)
            }
            Self::Few(width) => {
                let colors = colors(job, &points)?;
                let inks = palette(&colors, LAYERS);
                let of = nearest(&colors, &inks);
                let pen = |(i, &[r, g, b]): (usize, &Rgb)| {
                    let color = [r, g, b, 1.0];
                    Pen { number: i + 1, name: hex(color), width, color }
                };
                let mut pens: Vec<Pen> = inks.iter().enumerate().map(pen).collect();
                // A layer for lines alone.
                pens.push(Pen { number: pens.len() + 1, name: "curves".into(), width, color: [0.0, 0.0, 0.0, 1.0] });
                (pens, false, of)
            }
        };
        let line_pen = if nibs { Pen::darkest(&pens) } else { pens.last() };
        // Both have at least one pen.
        let line_pen = line_pen.cloned().unwrap_or(Pen { number: 1, name: String::new(), width: 0.0, color: [0.0; 4] });
        let layers = split(&points, &of, pens.len());
        let dots =
            pens.into_iter().zip(layers).map(|(pen, points)| PenDots { nib: nibs.then_some(pen.width), pen, points });
        Ok((dots.filter(|dots| nibs || !dots.points.is_empty()).collect(), line_pen))
    }
}

fn rgb([r, g, b, _]: Rgba) -> Rgb {
    [r, g, b]
}

/// Returns the colour of each voxel's points in the scene's transfer function.
fn colors(job: &Job, points: &Points) -> Result<Vec<Rgb>, Failure> {
    let Job { scene, volume, .. } = job;
    let at = |key: &str| scene.given.position(key);
    let Some(function) = job.function() else {
        let what = "dots take their colours from [transfer], and there is none";
        return Err(Failure::new(what, at("stipples.color"), "add a table [transfer], or give a colour"));
    };
    let grid = volume.grid();
    let labels =
        job.assets.labels.as_ref().map(|labels| Labels::new(labels, grid, volume.anatomy(), scene.volume.label_lookup));
    let colors = VoxelColors {
        function,
        styles: &job.assets.styles,
        mix: scene.transfer.as_ref().map_or(Mix::Premultiplied, |transfer| transfer.mix),
        labels: labels.as_ref(),
        by_label: scene.stipples.as_ref().is_some_and(|stipples| stipples.color == DotColor::Label),
        range: scene.volume.range.unwrap_or_else(|| volume.range()),
    };
    let remedy = "give them in ascending order";
    colors.of(points, grid).map_err(|error| Failure::new(error, at("transfer.nodes"), remedy))
}
