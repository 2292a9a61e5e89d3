//! What the tests of the ray caster share: volumes by formula, scenes by hand, and pictures to be asked.

// Each binary uses its own part.
#![allow(dead_code)]

pub(crate) mod lattice;
pub(crate) mod random;
pub(crate) mod rod;
pub(crate) mod strip;

use drypoint::reference::ray::Renderer;
use drypoint::reference::ray::bounds::{Bounds, BoundsError, RayOrigin};
use drypoint::reference::suggest;
use drypoint::scene::backdrop::Backdrop;
use drypoint::scene::color::Rgba;
use drypoint::scene::counts::Counts;
use drypoint::scene::fragments::Fragments;
use drypoint::scene::glam::DVec3;
use drypoint::scene::inputs::{Inputs, ObjectData};
use drypoint::scene::mesh::TriangleMesh;
use drypoint::scene::picture::{LayerKind, Picture};
use drypoint::scene::plan::Plan;
use drypoint::scene::shot::{Shot, VolumeFacts};
use drypoint::scene::space::Grid;
use drypoint::scene::style::Style;
use drypoint::scene::tables::{
    Background, Camera, GradientRange, Iso, Length, Node, NodeColor, Number, Projection, RaysPerPixel, Scene, Transfer,
    TransferKind, VolumeSource,
};
use drypoint::scene::transfer::Function;
use drypoint::scene::view::View;
use drypoint::scene::volume::labels::LabelVolume;
use drypoint::scene::volume::{Volume, Voxels};
use std::sync::Arc;

/// A volume of f64 voxels on a cubic grid at the world's origin.
pub(crate) fn volume(dims: [usize; 3], f: impl Fn(DVec3) -> f64) -> Volume {
    on(Grid::with_spacing(dims, [1.0; 3]).unwrap(), f)
}

/// A volume of f64 voxels: f of the world position of each.
pub(crate) fn on(grid: Grid, f: impl Fn(DVec3) -> f64) -> Volume {
    let voxels = positions(&grid).map(f).collect();
    Volume::new(grid, Voxels::F64(voxels), 1.0, 0.0).unwrap()
}

/// The world position of each voxel, x fastest.
pub(crate) fn positions(grid: &Grid) -> impl Iterator<Item = DVec3> + use<> {
    let (grid, [nx, ny, _]) = (grid.clone(), grid.dims());
    (0..grid.len()).map(move |i| grid.to_world(DVec3::new((i % nx) as f64, (i / nx % ny) as f64, (i / nx / ny) as f64)))
}

/// The distance to a sphere about the centre of a grid of n³ unit voxels, positive inside.
pub(crate) fn ball(n: usize, radius: f64) -> Volume {
    let centre = DVec3::splat((n - 1) as f64 / 2.0);
    volume([n; 3], |p| radius - (p - centre).length())
}

/// A field whose iso-surfaces are spheres and that every spline reproduces: (R² − ρ²)/2R about the centre of a grid of n³
/// unit voxels. The surface at ρ = R has value 0 and ‖g‖ = 1; at value f it is ρ = √(R² − 2Rf), with curvatures 1/ρ.
pub(crate) fn quadratic_ball(n: usize, radius: f64) -> Volume {
    let centre = DVec3::splat((n - 1) as f64 / 2.0);
    volume([n; 3], |p| (radius * radius - (p - centre).length_squared()) / (2.0 * radius))
}

/// A style of straight linear texels, from the normal (N_x, N_y) at the centre of each.
pub(crate) fn style(name: &str, side: usize, texel: impl Fn(f64, f64) -> Rgba) -> Style {
    let at = |k: usize| (2 * k + 1) as f64 / side as f64 - 1.0;
    let texels: Vec<Rgba> = (0..side * side).map(|t| texel(at(t % side), -at(t / side))).collect();
    Style::from_straight(name, side, &texels, true).unwrap()
}

/// What a style's texel keeps of a colour.
pub(crate) fn in_a_texture(color: Rgba) -> Rgba {
    color.map(|c| f64::from(c as f32))
}

/// One colour everywhere.
pub(crate) fn plain(name: &str, color: Rgba) -> Style {
    style(name, 1, |_, _| color)
}

/// A scene with everything that it names.
#[derive(Clone)]
pub(crate) struct Stage {
    pub(crate) scene: Scene,
    pub(crate) volume: Volume,
    /// Every style that a node may name.
    pub(crate) styles: Vec<Style>,
    /// Labels beside the volume.
    pub(crate) labels: Option<LabelVolume>,
    /// Further volumes that the function is over.
    pub(crate) further: [Option<Volume>; 2],
    /// Meshes, one for each of the scene.
    pub(crate) meshes: Vec<TriangleMesh>,
    /// A background picture, linear premultiplied.
    pub(crate) behind: Option<Vec<Rgba>>,
}

impl Stage {
    /// A regular function of linear colours: (value, colour, α_u).
    pub(crate) fn regular(volume: Volume, nodes: &[(f64, [f64; 3], f64)]) -> Self {
        let nodes = nodes.iter().map(|&(at, c, opacity)| Node { at, color: NodeColor::Color(c), opacity }).collect();
        Self::new(volume, TransferKind::Regular, nodes, Vec::new())
    }

    /// A style function: (value, name, α_u).
    pub(crate) fn styled(volume: Volume, styles: Vec<Style>, nodes: &[(f64, &str, f64)]) -> Self {
        let node = |&(at, name, opacity): &(f64, &str, f64)| Node { at, color: NodeColor::Style(name.into()), opacity };
        Self::new(volume, TransferKind::Style, nodes.iter().map(node).collect(), styles)
    }

    /// An orthographic view of 16 × 16 pixels along +y, one ray each, before nothing.
    fn new(volume: Volume, kind: TransferKind, nodes: Vec<Node>, styles: Vec<Style>) -> Self {
        let mut scene = Scene::for_volume(VolumeSource::File { path: "test".into(), raw: None });
        scene.transfer = Some(Transfer { nodes: Some(nodes), ..Transfer::automatic(kind) });
        scene.camera = Camera { direction: DVec3::Y, ..orthographic(None) };
        scene.picture.size = [16, 16];
        scene.picture.samples = RaysPerPixel::Across(1);
        scene.picture.background = Background::None;
        scene.volume.gradient_range = GradientRange::Fixed([0.0, 1.0]);
        Self { scene, volume, styles, labels: None, further: [None, None], meshes: Vec::new(), behind: None }
    }

    /// The same with changes to the scene.
    pub(crate) fn with(&self, change: impl FnOnce(&mut Scene)) -> Self {
        let mut other = self.clone();
        change(&mut other.scene);
        other
    }

    /// The same with changes to the transfer function's table.
    pub(crate) fn with_transfer(&self, change: impl FnOnce(&mut Transfer)) -> Self {
        self.with(|s| change(s.transfer.as_mut().unwrap()))
    }

    /// The same in a number type.
    pub(crate) fn in_number(&self, number: Number) -> Self {
        self.with(|s| s.sampling.number = number)
    }

    /// The same from another direction.
    pub(crate) fn seen_along(&self, direction: [f64; 3]) -> Self {
        self.with(|s| s.camera.direction = direction.into())
    }

    /// The same with these layers, the beauty first.
    pub(crate) fn layers(&self, layers: &[LayerKind]) -> Self {
        self.with(|s| s.picture.layers = [&[LayerKind::Beauty], layers].concat())
    }

    /// The same with a step in world units that is also the reference length: opacities are those of one sample.
    pub(crate) fn step(&self, step: f64) -> Self {
        self.with(|s| {
            s.sampling.step = Length::World(step);
            s.sampling.reference_length = Length::World(step);
        })
    }

    /// The camera in numbers.
    pub(crate) fn view(&self) -> View {
        View::new(&self.scene.camera, self.volume.grid(), self.scene.picture.size).unwrap()
    }

    /// The transfer function over the volume's values; label n is named `part n`.
    pub(crate) fn function(&self) -> Function {
        let range = self.scene.volume.range.unwrap_or_else(|| self.volume.range());
        let id_of = |name: &str| name.strip_prefix("part ")?.parse().ok();
        match &self.scene.transfer {
            Some(transfer) => Function::new(transfer, range, &self.volume, &id_of).unwrap().unwrap(),
            None => Function::nothing(),
        }
    }

    /// The scene with nothing left to decide, seen by a camera.
    pub(crate) fn resolved(&self, view: View) -> Shot {
        let facts = VolumeFacts { grid: self.volume.grid(), is_integer: self.volume.is_integer() };
        let mut scene = self.scene.clone();
        if let Some(iso) = scene.surface.as_mut().map(|surface| &mut surface.iso).filter(|iso| **iso == Iso::Auto) {
            *iso = Iso::Value(suggest::iso(&self.volume, &self.scene.volume, &mut Counts::default()));
        }
        Shot::resolve(&scene, &Plan::new(&scene), facts, Arc::new(self.function()), view).unwrap()
    }

    /// The picture.
    pub(crate) fn render(&self) -> Shown {
        self.render_by(|renderer| renderer)
    }

    /// The picture, drawn in tiles of that side.
    pub(crate) fn render_in_tiles(&self, side: usize) -> Shown {
        self.render_by(|renderer| renderer.with_tiles(side))
    }

    /// The picture with lines inside it.
    pub(crate) fn render_among(&self, lines: &Fragments) -> Shown {
        self.render_by(|mut renderer| {
            renderer.merge(Some(lines.clone()));
            renderer
        })
    }

    /// The picture with each ray cast alone, and whether rays would have been cast in lanes.
    pub(crate) fn render_ray_by_ray(&self) -> (Shown, bool) {
        let mut in_lanes = false;
        let shown = self.render_by(|renderer| {
            in_lanes = renderer.in_lanes();
            renderer.ray_by_ray()
        });
        (shown, in_lanes)
    }

    /// The pictures of several shots, one after another, by one renderer that is turned.
    pub(crate) fn render_turned(&self, shots: &[Shot]) -> Vec<Shown> {
        let mut all = Vec::new();
        self.render_by(|mut renderer| {
            for shot in shots {
                renderer.turn(shot).unwrap();
                let (picture, counts) = renderer.frame(&|_| {});
                all.push(Shown { picture, counts });
            }
            renderer
        });
        all
    }

    pub(crate) fn render_by(&self, set: impl FnOnce(Renderer<'_>) -> Renderer<'_>) -> Shown {
        self.render_shot(&self.resolved(self.view()), set)
    }

    /// The picture of a shot of this scene that may have been changed.
    pub(crate) fn render_shot(&self, shot: &Shot, set: impl FnOnce(Renderer<'_>) -> Renderer<'_>) -> Shown {
        self.with_inputs(shot, |inputs| {
            let (picture, counts) = set(Renderer::new(shot, inputs).unwrap()).frame(&|_| {});
            Shown { picture, counts }
        })
    }

    /// The picture with the bounds of an f32 renderer.
    pub(crate) fn bounds(&self, origin: RayOrigin) -> Result<Bounds, BoundsError> {
        self.bounds_among(None, origin)
    }

    /// The picture with lines inside it, with the bounds of an f32 renderer.
    pub(crate) fn bounds_among(&self, lines: Option<Fragments>, origin: RayOrigin) -> Result<Bounds, BoundsError> {
        let shot = self.resolved(self.view());
        self.with_inputs(&shot, |inputs| Renderer::bounds(&shot, inputs, lines, origin))
    }

    /// Hands over the data that a shot of this scene names.
    fn with_inputs<T>(&self, shot: &Shot, take: impl FnOnce(Inputs<'_>) -> T) -> T {
        let function = self.function();
        let find = |name: &String| self.styles.iter().find(|s| &s.name == name).unwrap().clone();
        let names: &[String] = match &function {
            Function::Regular(_) => &[],
            Function::Style { names, .. } => names,
        };
        let named: Vec<Style> = names.iter().chain(&shot.clipping.styles).map(find).collect();
        let background = match (&self.behind, &self.scene.picture.background) {
            (Some(pixels), _) => Backdrop::Pixels(pixels),
            (None, Background::Color(c)) => Backdrop::Color(*c),
            (None, _) => Backdrop::None,
        };
        let data = ObjectData {
            volume: &self.volume,
            labels: self.labels.as_ref(),
            further: self.further.each_ref().map(Option::as_ref),
            styles: &named,
        };
        take(Inputs { meshes: &self.meshes, ..Inputs::of(data, background) })
    }
}

/// A picture and what was done for it.
pub(crate) struct Shown {
    pub(crate) picture: Picture,
    pub(crate) counts: Counts,
}

impl Shown {
    /// Premultiplied pixels, row by row from the top.
    pub(crate) fn pixels(&self) -> Vec<Rgba> {
        let channels = &self.picture.layer(LayerKind::Beauty).unwrap().channels;
        (0..channels[0].len()).map(|i| [0, 1, 2, 3].map(|c: usize| channels[c][i])).collect()
    }

    /// A layer pixel by pixel.
    pub(crate) fn layer<const N: usize>(&self, kind: LayerKind) -> Vec<[f64; N]> {
        let channels = &self.picture.layer(kind).unwrap().channels;
        assert_eq!(channels.len(), N);
        (0..channels[0].len()).map(|i| std::array::from_fn(|c| channels[c][i])).collect()
    }

    /// A layer of one channel.
    pub(crate) fn one(&self, kind: LayerKind) -> Vec<f64> {
        self.layer::<1>(kind).into_iter().map(|[v]| v).collect()
    }

    /// Every number of a layer, as bits.
    pub(crate) fn layer_bits(&self, kind: LayerKind) -> Vec<u64> {
        self.picture.layer(kind).unwrap().channels.iter().flatten().map(|v| v.to_bits()).collect()
    }

    /// Every number of the picture but the counts of samples, as bits.
    pub(crate) fn bits(&self) -> Vec<u64> {
        let shown = self.picture.layers.iter().filter(|l| l.kind != LayerKind::Counts);
        shown.flat_map(|l| l.channels.iter().flatten()).map(|v| v.to_bits()).collect()
    }

    /// How many pixels show something.
    pub(crate) fn covered(&self) -> usize {
        self.pixels().iter().filter(|p| p[3] > 0.0).count()
    }
}

/// An orthographic camera of that height in world units.
pub(crate) fn orthographic(height: Option<f64>) -> Camera {
    Camera { projection: Projection::Orthographic { height: height.map(Length::World) }, ..Camera::default() }
}

/// A perspective camera.
pub(crate) fn perspective(fov: f64) -> Camera {
    Camera { projection: Projection::Perspective { fov }, ..Camera::default() }
}

/// 1 − (1 − α)^(Δ/Δ₀) ([VAL-4]), as it is written.
pub(crate) fn corrected(alpha: f64, ratio: f64) -> f64 {
    1.0 - (1.0 - alpha).powf(ratio)
}

/// The largest difference of two pictures' pixels in any channel.
pub(crate) fn largest_difference(a: &Shown, b: &Shown) -> f64 {
    let pairs = a.pixels().into_iter().zip(b.pixels());
    pairs.flat_map(|(a, b)| [0, 1, 2, 3].map(|c: usize| (a[c] - b[c]).abs())).fold(0.0, f64::max)
}

/// Every layer beside the beauty that can stand with the others in one file.
pub(crate) const LAYERS: [LayerKind; 10] = [
    LayerKind::Z,
    LayerKind::Depth,
    LayerKind::Normal,
    LayerKind::Gradient,
    LayerKind::Curvature,
    LayerKind::First,
    LayerKind::FirstNormal,
    LayerKind::FirstCurvature,
    LayerKind::Counts,
    LayerKind::Part(0),
];
