//! The contour ring of an opaque sphere, as the renderer draws it ([STF-7]).

use drypoint::job::Job;
use drypoint::reference::style_transfer_functions::Contour;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::math::{cos, sin};
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::Kappa;
use std::path::Path;

/// T in voxels.
pub(crate) const THICKNESS: f64 = 2.0;

/// Directions in which a ring's width is taken.
const DIRECTIONS: usize = 720;

/// How a sphere is stored.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Stored {
    /// The distance field in f64, reconstructed by the prefiltered cubic B-spline.
    Distance,
    /// An edge of one voxel in u8, reconstructed by default: trilinear, and for κ the Gaussian of one voxel.
    EightBits,
}

/// Which sphere is drawn, and how.
#[derive(Clone, Copy)]
pub(crate) struct Ball {
    /// R in voxels.
    pub(crate) radius: f64,
    /// Which κ makes the contour.
    pub(crate) kappa: Kappa,
    /// How it is stored.
    pub(crate) stored: Stored,
    /// Δ in voxels.
    pub(crate) step: f64,
    /// Pixels a voxel.
    pub(crate) pixels: f64,
}

/// What a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Seen {
    /// Nothing.
    Nothing,
    /// The sphere off its contour, with |N·v|.
    Sphere(f64),
    /// The contour.
    Contour,
}

/// A square picture of a sphere in its middle.
pub(crate) struct Drawn {
    pub(crate) side: usize,
    pub(crate) pixels: Vec<Seen>,
    /// Pixels a voxel.
    scale: f64,
}

impl Ball {
    /// Draws it: orthographic, opaque from the surface on, askew to the grid.
    pub(crate) fn draw(&self) -> Result<Drawn, String> {
        let kappa = match self.kappa {
            Kappa::Exact => "exact",
            Kappa::Ray | Kappa::None { .. } => "ray",
        };
        let (voxel_type, w, at, kernel, gradient) = match self.stored {
            Stored::Distance => ("f64", 0, 0.0, "bspline", "analytic"),
            Stored::EightBits => ("u8", 1, 127.5, "trilinear", "central"),
        };
        let voxels = (2.0 * self.radius).ceil() as usize + 14;
        let side = ((2.0 * self.radius + 2.0) * self.pixels).ceil() as usize;
        let text = format!(
            "drypoint = 1\n\
             [volume]\nphantom = {{ name = \"sphere\", size = {voxels}, type = \"{voxel_type}\", param = {{ R = {}, w = {w} }} }}\n\
             [camera]\nprojection = \"orthographic\"\ndirection = [-0.5, 0.7, -0.4]\nheight = {}\n\
             [picture]\nsize = [{side}, {side}]\nsamples = 1\nbackground = \"none\"\nlayers = [\"beauty\", \"normal\", \"curvature.KV\"]\n\
             [sampling]\nstep = {}\nkernel = \"{kernel}\"\ngradient = \"{gradient}\"\n\
             [transfer]\nkind = \"style\"\nnodes = [{{ at = {at}, style = \"ink\", opacity = 0 }}, {{ at = {at}, style = \"ink\" }}]\n\
             [contours]\nthickness = {THICKNESS}\nkappa = \"{kappa}\"\n",
            self.radius,
            side as f64 / self.pixels,
            self.step,
        );
        let scene = parse(&text, Path::new("ring.toml"), &Overrides::default()).map_err(|e| e.to_string())?;
        let job = Job::load(scene).map_err(|e| e.to_string())?;
        let (picture, _) = job.renderer().map_err(|e| e.to_string())?.frame(&|_| ());
        let channel = |kind, i: usize| {
            let layer = picture.layer(kind).ok_or_else(|| format!("the picture has no layer {kind}"))?;
            Ok::<_, String>(&layer.channels[i])
        };
        let (alpha, nz) = (channel(LayerKind::Beauty, 3)?, channel(LayerKind::Normal, 2)?);
        let kappa_v = channel(LayerKind::CurvatureAlongView, 0)?;
        let contour = Contour::<f64>::new(THICKNESS, self.kappa, None);
        let seen = |i: usize| match nz[i].abs() {
            _ if alpha[i] == 0.0 => Seen::Nothing,
            d if d <= contour.tau(kappa_v[i], 1.0) => Seen::Contour,
            d => Seen::Sphere(d),
        };
        Ok(Drawn { side, pixels: (0..side * side).map(seen).collect(), scale: self.pixels })
    }
}

impl Drawn {
    /// The width of the ring in voxels: the median over all directions of how far the contour reaches inwards from the
    /// sphere's edge.
    pub(crate) fn ring(&self) -> f64 {
        let middle = self.side as f64 / 2.0;
        // Steps of a twentieth of a pixel along a radius, from the edge of the picture inwards.
        let parts = 20.0;
        let width = |k: usize| {
            let angle = std::f64::consts::TAU * (k as f64 + 0.5) / DIRECTIONS as f64;
            let (x, y) = (cos(angle), sin(angle));
            let at = |i: usize| {
                let r = i as f64 / parts;
                let [column, row] = [middle + r * x, middle + r * y].map(|c| (c as usize).min(self.side - 1));
                self.pixels[row * self.side + column]
            };
            let inwards = (0..(middle * parts) as usize).rev().map(at).skip_while(|&seen| seen == Seen::Nothing);
            inwards.take_while(|&seen| seen == Seen::Contour).count() as f64 / parts
        };
        let mut widths: Vec<f64> = (0..DIRECTIONS).map(width).collect();
        widths.sort_by(f64::total_cmp);
        widths[DIRECTIONS / 2] / self.scale
    }
}
