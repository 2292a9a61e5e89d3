//! Which pen draws which points ([STIP-16]).

use super::Dots;
use crate::Failure;
use crate::job::Job;
use drypoint_reference::dot_colors::{VoxelColors, nearest, palette, split};
use drypoint_reference::labels::Labels;
use drypoint_scene::color::{Rgb, Rgba, linear_to_oklab, linear_to_srgb};
use drypoint_scene::marks::{Page, Pen};
use drypoint_scene::points::Points;
use drypoint_scene::tables::{DotColor, Mix, Scene, Stipples};

/// The most layers of dots where no pens draw the colours of a transfer function.
const LAYERS: usize = 16;

/// What draws points and lines.
pub(super) enum Pens {
    /// One for all, with the width of its nib where it is of `[[pen]]`.
    One(Pen, Option<f64>),
    /// The nearest colour of `[[pen]]`.
    Nearest(Vec<Pen>),
    /// A few colours of that many as the points have, in dots of that size at the most.
    Few(f64),
}

impl Pens {
    /// # Errors
    /// A pen that there is not.
    pub(super) fn new(scene: &Scene, stipples: &Stipples, page: &Page) -> Result<Self, Failure> {
        let width = page.length(stipples.size).unwrap_or_default();
        let pens = Pen::of(&scene.pens, page);
        let Some(name) = &stipples.pen else {
            return Ok(match stipples.color {
                DotColor::Fixed(color) => Self::One(Pen { number: 1, name: "stipples".into(), width, color }, None),
                DotColor::Transfer | DotColor::Label if pens.is_empty() => Self::Few(width),
                DotColor::Transfer | DotColor::Label => Self::Nearest(pens),
            });
        };
        let names: Vec<&str> = scene.pens.iter().map(|pen| pen.name.as_str()).collect();
        let remedy = if names.is_empty() {
            "add a table [[pen]] with that name".into()
        } else {
            format!("write one of {}", names.join(", "))
        };
        let found = pens.into_iter().find(|pen| pen.name == *name);
        found.map(|pen| Self::One(pen.clone(), Some(pen.width))).ok_or_else(|| {
            Failure::new(format!("there is no pen {name:?}"), scene.given.position("stipples.pen"), remedy)
        })
    }

    /// Deals the points to the pens, and says which one draws lines: the only one, the darkest of `[[pen]]`, or a black one
    /// of its own.
    pub(super) fn deal(self, job: &Job, points: Points) -> Result<(Vec<Dots>, Pen), Failure> {
        let (pens, nibs, of) = match self {
            Self::One(pen, nib) => return Ok((vec![Dots { pen: pen.clone(), nib, points }], pen)),
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
                    let byte = |c: f64| (linear_to_srgb(c) * 255.0).round_ties_even() as u8;
                    let name = format!("#{:02x}{:02x}{:02x}", byte(r), byte(g), byte(b));
                    Pen { number: i + 1, name, width, color: [r, g, b, 1.0] }
                };
                let mut pens: Vec<Pen> = inks.iter().enumerate().map(pen).collect();
                // A layer that only lines are in.
                pens.push(Pen { number: pens.len() + 1, name: "curves".into(), width, color: [0.0, 0.0, 0.0, 1.0] });
                (pens, false, of)
            }
        };
        let lightness = |pen: &Pen| linear_to_oklab(rgb(pen.color))[0];
        let darkest = pens.iter().min_by(|a, b| lightness(a).total_cmp(&lightness(b)));
        let line_pen = if nibs { darkest } else { pens.last() };
        // Both have at least one pen.
        let line_pen = line_pen.cloned().unwrap_or(Pen { number: 1, name: String::new(), width: 0.0, color: [0.0; 4] });
        let layers = split(&points, &of, pens.len());
        let dots =
            pens.into_iter().zip(layers).map(|(pen, points)| Dots { nib: nibs.then_some(pen.width), pen, points });
        Ok((dots.filter(|dots| nibs || !dots.points.is_empty()).collect(), line_pen))
    }
}

fn rgb([r, g, b, _]: Rgba) -> Rgb {
    [r, g, b]
}

/// The colour of each voxel's points in the scene's transfer function.
fn colors(job: &Job, points: &Points) -> Result<Vec<Rgb>, Failure> {
    let Job { scene, volume, .. } = job;
    let at = |key: &str| scene.given.position(key);
    let Some(function) = job.function() else {
        let what = "dots take their colours from [transfer], and there is none";
        return Err(Failure::new(what, at("stipples.color"), "add a table [transfer], or give a colour"));
    };
    let grid = volume.grid();
    let labels = job.labels().map(|labels| Labels::new(labels, grid, volume.anatomy(), scene.volume.label_lookup));
    let colors = VoxelColors {
        function,
        styles: job.styles(),
        mix: scene.transfer.as_ref().map_or(Mix::Premultiplied, |transfer| transfer.mix),
        labels: labels.as_ref(),
        by_label: scene.stipples.as_ref().is_some_and(|stipples| stipples.color == DotColor::Label),
        range: scene.volume.range.unwrap_or_else(|| volume.range()),
    };
    let remedy = "give them in ascending order";
    colors.of(points, grid).map_err(|error| Failure::new(error, at("transfer.nodes"), remedy))
}
