//! Scenes at random: every effect, kernel, camera and odd volume that the caster knows, small enough for hundreds.

use super::clips::clips;
use super::over_two::over_two;
use crate::common::random::Random;
use crate::common::{LAYERS, Stage, perspective, plain, style};
use drypoint::scene::color::Rgba;
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::lighting::{ContourRule, LightingPreset};
use drypoint::scene::phantom::{self, Allowed};
use drypoint::scene::picture::LayerKind;
use drypoint::scene::source::Disk;
use drypoint::scene::space::Grid;
use drypoint::scene::style::{self as styles_of, Style, Theme};
use drypoint::scene::tables::{
    Background, BlendSpace, Camera, Contours, GradientEstimator, GradientRange, HessianEstimator, Ids, Iso, Kappa,
    Kernel, Length, LightDirection, Mix, NormalSide, Number, Orbit, Outside, PageSettings, PageText, PenSettings,
    PhantomSource, Projection, RaysPerPixel, Scene, Shading, ShadingModel, SignFlip, SilhouetteShading, SphereFrame,
    StepAlong, StyleMipmaps, StyleSource, Styles, Surface, SurfaceLook, Table, Tone, ToonShading, Transparency, Unit,
    VolumeSource,
};
use drypoint::scene::volume::{Volume, VoxelType, Voxels};

pub(crate) const KERNELS: [Kernel; 5] =
    [Kernel::Trilinear, Kernel::Bspline, Kernel::BsplineSmooth, Kernel::Bspline5, Kernel::CatmullRom];

/// Voxels along each axis: odd ones, and some with several bricks.
pub(crate) fn dims(r: &mut Random) -> [usize; 3] {
    match r.below(8) {
        0 => [1, 1, 1],
        1 => [1, 2 + r.below(20), 1],
        2 => [2, 2, 2],
        3 => [2 + r.below(20), 1, 2 + r.below(12)],
        4 => [3, 2, 9 + r.below(12)],
        _ => [0; 3].map(|_| 2 + r.below(20)),
    }
}

/// A grid of those dims: cubic, anisotropic or sheared.
pub(crate) fn grid(r: &mut Random, dims: [usize; 3]) -> Grid {
    let spacing = [0; 3].map(|_| if r.once_in(2) { 1.0 } else { r.between(0.3, 3.0) });
    let mut axes = DMat3::from_diagonal(spacing.into());
    if r.once_in(3) {
        axes.y_axis += DVec3::new(r.between(-0.4, 0.4), 0.0, r.between(-0.4, 0.4));
        axes.z_axis.x += r.between(-0.4, 0.4);
    }
    let origin = if r.once_in(2) { DVec3::ZERO } else { DVec3::from_array(r.direction()) * 100.0 };
    Grid::new(dims, axes, origin).unwrap()
}

/// Values on a grid: waves, noise of few levels with flat parts, a spike in nothing.
fn values(r: &mut Random, grid: &Grid) -> Vec<f64> {
    let levels = 1 + r.below(5);
    let (a, b, c) = (r.between(0.2, 1.2), r.between(0.2, 1.2), r.between(0.2, 1.2));
    let kind = r.below(4);
    let spike = r.below(grid.len());
    crate::common::positions(grid)
        .enumerate()
        .map(|(i, p)| match kind {
            0 => 50.0 + 40.0 * ((a * p.x).sin() + (b * p.y).cos() * (c * p.z).sin()),
            1 => (r.below(levels + 1) as f64 / levels as f64) * 100.0,
            2 => {
                if i == spike {
                    100.0
                } else {
                    0.0
                }
            }
            _ => {
                if (a * p.x).sin() + (b * p.y).sin() + (c * p.z).sin() > 0.5 {
                    100.0
                } else {
                    10.0
                }
            }
        })
        .collect()
}

/// A volume of a random stored type, with slope and intercept, and holes if it can have them.
pub(crate) fn volume(r: &mut Random, grid: Grid) -> Volume {
    let mut values = values(r, &grid);
    let stored = r.pick(&[VoxelType::U8, VoxelType::I16, VoxelType::F32, VoxelType::F64]);
    if !stored.is_integer() && grid.len() > 8 && r.once_in(3) {
        for _ in 0..1 + r.below(6) {
            let i = r.below(values.len());
            values[i] = r.pick(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY]);
        }
        values[0] = 3.0;
    }
    let [slope, intercept] = r.pick(&[[1.0, 0.0], [1.0, 0.0], [-0.37, 12.5], [0.001, 1000.0], [2.0, -1024.0]]);
    Volume::new(grid, Voxels::from_f64(&values, stored), slope, intercept).unwrap()
}

/// Every stored type.
const TYPES: [VoxelType; 10] = [
    VoxelType::U8,
    VoxelType::I8,
    VoxelType::U16,
    VoxelType::I16,
    VoxelType::U32,
    VoxelType::I32,
    VoxelType::U64,
    VoxelType::I64,
    VoxelType::F32,
    VoxelType::F64,
];

/// A phantom by name, of a few voxels, now and then with a parameter of its own.
fn phantom(r: &mut Random) -> (PhantomSource, Volume) {
    loop {
        let about = &phantom::describe()[r.below(phantom::describe().len())];
        let param = &about.params[r.below(about.params.len())];
        let value = match param.allowed {
            Allowed::Whole(lo, hi) => r.between(lo, hi.min(lo + 6.0)).floor(),
            Allowed::Positive => r.between(0.5, 4.0),
            Allowed::NonNegative => r.between(0.0, 2.0),
            Allowed::Any => r.between(20.0, 100.0),
        };
        let size = if r.once_in(3) { dims(r) } else { [4 + r.below(12); 3] };
        let source = PhantomSource {
            name: about.name.into(),
            size,
            spacing: if r.once_in(2) { [1.0; 3] } else { [0; 3].map(|_| r.between(0.5, 2.0)) },
            voxel_type: r.pick(&TYPES),
            params: if r.once_in(2) { vec![(param.name.into(), value)] } else { Vec::new() },
        };
        // Parameters that do not go together, and boxes too small for some, make none.
        if let Ok(volume) = phantom::generate(&source) {
            return (source, volume);
        }
    }
}

/// Values of nodes in ascending order: voxels' own, between and beyond them, some twice.
pub(crate) fn at(r: &mut Random, volume: &Volume, n: usize) -> Vec<f64> {
    let [lo, hi] = volume.range();
    let reach = (hi - lo).max(1.0);
    let mut at: Vec<f64> = (0..n)
        .map(|_| match r.below(5) {
            0 | 1 => volume.value(volume.dims().map(|n| r.below(n))),
            2 => hi + reach * r.between(0.0, 0.5),
            _ => r.between(lo - 0.1 * reach, hi + 0.1 * reach),
        })
        .collect();
    at.sort_by(f64::total_cmp);
    if n > 1 && r.once_in(2) {
        at[n - 1] = at[n - 2];
    }
    at
}

pub(crate) fn opacity(r: &mut Random) -> f64 {
    match r.below(5) {
        0 | 1 => 0.0,
        2 => 1.0,
        _ => r.unit(),
    }
}

pub(super) fn styles() -> Vec<Style> {
    vec![
        plain("grey", [0.4, 0.5, 0.6, 1.0]),
        plain("clear", [1.0, 0.0, 0.0, 0.0]),
        style("ramp", 9, |x, y| [0.5 + 0.5 * x, 0.5 + 0.5 * y, 0.3, 0.2 + 0.8 * (x * x + y * y).min(1.0)]),
        style("tiny", 2, |x, y| [x.abs(), y.abs(), 1.0, 0.9]),
    ]
}

/// Two styles of a theme of the program.
fn themed(r: &mut Random, table: &mut Styles) -> Vec<Style> {
    let themes: Vec<&str> = Theme::embedded_names().collect();
    table.theme = StyleSource::Embedded(r.pick(&themes).into());
    let names: Vec<String> = Theme::open(&Disk, &table.theme).unwrap().names().map(Into::into).collect();
    let used = [r.pick(&names), r.pick(&names)];
    styles_of::load(&Disk, table, used.iter().map(String::as_str)).unwrap()
}

/// A background of any size: a picture is stretched to its frame.
fn behind([width, height]: [usize; 2]) -> Vec<Rgba> {
    let share = |i: usize, n: usize| i as f64 / n as f64;
    let pixel = |t: usize| {
        let (x, y) = (share(t % width, width), share(t / width, height));
        let alpha = 1.0 - x * y;
        [0.9 * x * alpha, 0.5 * y * alpha, 0.3 * alpha, alpha]
    };
    (0..width * height).map(pixel).collect()
}

/// The same scene in another size.
pub(crate) fn resized(shot: &Stage, size: [usize; 2]) -> Stage {
    let mut other = shot.with(|s| s.picture.size = size);
    other.behind = shot.behind.as_ref().map(|_| behind(size));
    other
}

fn function(r: &mut Random, volume: Volume) -> Stage {
    let n = 1 + r.below(4);
    let at = at(r, &volume, n);
    let mut shot = if r.once_in(3) {
        let nodes: Vec<_> = at.iter().map(|&a| (a, [r.unit(), r.unit(), r.unit()], opacity(r))).collect();
        Stage::regular(volume, &nodes)
    } else {
        let mut table = Styles::default();
        let styles = if r.once_in(8) { themed(r, &mut table) } else { styles() };
        let names: Vec<&str> = styles.iter().map(|style| style.name.as_str()).collect();
        let nodes: Vec<_> = at.iter().map(|&a| (a, r.pick(&names), opacity(r))).collect();
        Stage::styled(volume, styles.clone(), &nodes).with(|s| s.styles = table)
    };
    let t = shot.scene.transfer.as_mut().unwrap();
    t.mix = r.pick(&[Mix::Premultiplied, Mix::Printed]);
    t.transparency = r.pick(&[Transparency::Illustrative, Transparency::Illustrative, Transparency::Plain]);
    t.sphere_frame = r.pick(&[SphereFrame::Eye, SphereFrame::View]);
    if r.once_in(4) {
        t.unit = Unit::Percentile;
        let nodes = t.nodes.as_mut().unwrap();
        let last = nodes.len().max(2) - 1;
        nodes.iter_mut().enumerate().for_each(|(i, node)| node.at = 100.0 * i as f64 / last as f64);
    } else if r.once_in(4) {
        t.unit = Unit::Normalized;
        let nodes = t.nodes.as_mut().unwrap();
        let ends = [0.0, 0.5, 1.0, r.between(-0.1, 1.1), r.between(-0.1, 1.1)];
        let mut at: Vec<f64> = nodes.iter().map(|_| r.pick(&ends)).collect();
        at.sort_by(f64::total_cmp);
        nodes.iter_mut().zip(at).for_each(|(node, at)| node.at = at);
    }
    if r.once_in(4) {
        t.table = Table::Entries(r.pick(&[2, 3, 16, 257]));
    }
    shot
}

/// A camera, with the eye inside at times.
pub(crate) fn camera(r: &mut Random, grid: &Grid) -> Camera {
    let mut camera = if r.once_in(2) {
        perspective(r.pick(&[5.0, 30.0, 70.0, 120.0, 160.0]))
    } else {
        let height = match r.below(4) {
            0 | 1 => None,
            2 => Some(Length::World(grid.radius() * r.between(0.5, 3.0))),
            _ => Some(Length::Voxels(r.between(2.0, 60.0))),
        };
        Camera { projection: Projection::Orthographic { height }, ..Camera::default() }
    };
    let axes = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]];
    camera.direction = if r.once_in(3) { r.pick(&axes) } else { r.direction() }.into();
    if r.once_in(3) {
        camera.eye = Some(grid.centre() + DVec3::from_array(r.direction()) * grid.radius() * r.between(0.0, 3.0));
        camera.direction_given = true;
    }
    if r.once_in(4) {
        camera.near = Some(Length::Voxels(r.between(0.1, 3.0)));
    }
    if r.once_in(4) {
        camera.up = DVec3::from_array(r.direction());
    }
    if r.once_in(4) {
        camera.target = Some(grid.centre() + DVec3::from_array(r.direction()) * grid.radius() * r.between(0.0, 0.7));
    }
    camera
}

/// The paper and the pens of points and lines.
fn paper(r: &mut Random, scene: &mut Scene) {
    let margin = r.pick(&[Length::Millimetres(0.0), Length::Millimetres(12.5), Length::Pixels(3.0)]);
    scene.page = r.pick(&[
        None,
        Some(PageSettings { margin, ..PageSettings::default() }),
        Some(PageSettings { margin, plotter: true, text: PageText::Outlines }),
    ]);
    let pen = |name: &str, r: &mut Random| PenSettings {
        name: name.into(),
        width: r.pick(&[Length::Millimetres(0.3), Length::Pixels(2.0)]),
        color: r.pick(&[[0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 0.2]]),
        tone: r.pick(&[None, Some("wedge.csv".into())]),
    };
    scene.pens = ["fine", "broad"].into_iter().take(r.below(3)).map(|name| pen(name, r)).collect();
}

/// What the picture is drawn on.
fn picture(r: &mut Random, shot: &mut Stage) {
    let p = &mut shot.scene.picture;
    p.size = r.pick(&[[9, 7], [7, 9], [8, 8], [1, 1], [17, 2]]);
    // With a number of rays the contrast has no effect.
    (p.samples, p.contrast) = r.pick(&[
        (RaysPerPixel::Across(1), 0.0625),
        (RaysPerPixel::Across(1), 0.0625),
        (RaysPerPixel::Auto, 0.03),
        (RaysPerPixel::Across(2), 0.0625),
    ]);
    p.blend_space = r.pick(&[BlendSpace::Linear, BlendSpace::Linear, BlendSpace::Srgb]);
    p.background = r.pick(&[
        Background::None,
        Background::Color([1.0; 4]),
        Background::Color([0.2, 0.5, 0.9, 0.4]),
        Background::Picture("behind.png".into()),
    ]);
    shot.behind = matches!(p.background, Background::Picture(_)).then(|| behind(p.size));
    // Of two layers that share a channel either can be in a file.
    p.layers = [&[LayerKind::Beauty], LAYERS.as_slice()].concat();
    if r.once_in(4) {
        for layer in &mut p.layers {
            match layer {
                LayerKind::Curvature => *layer = LayerKind::CurvatureAlongView,
                LayerKind::FirstCurvature => *layer = LayerKind::FirstCurvatureAlongView,
                _ => {}
            }
        }
    }
    // How it is written changes nothing of it.
    p.bits = r.pick(&[8, 16]);
    p.dpi = r.pick(&[72.0, 300.0]);
    paper(r, &mut shot.scene);
}

/// Light on a regular function.
fn shading(r: &mut Random, scene: &mut Scene) {
    let directions = [
        LightDirection::Head,
        LightDirection::Eye(DVec3::from_array(r.direction())),
        LightDirection::World(DVec3::from_array(r.direction())),
    ];
    scene.light = r.pick(&directions);
    if r.once_in(2) {
        scene.shading = Some(Shading {
            ambient: r.pick(&[0.0, 0.3, 1.0]),
            diffuse: r.pick(&[0.0, 0.6, 1.0]),
            specular: r.pick(&[0.0, 0.3, 2.0]),
            shininess: r.pick(&[0.0, 1.0, 17.3]),
            light: if r.once_in(2) { None } else { Some(r.pick(&directions)) },
            model: r.pick(&[ShadingModel::Phong, ShadingModel::Phong, ShadingModel::Toon, ShadingModel::Function]),
            preset: r.pick(&LightingPreset::ALL.map(Some)),
            table: None,
            contour: r.pick(&[ContourRule::Exact, ContourRule::Printed]),
            divisor_floor: r.pick(&[1.0 / 64.0, 1e-3, 1.0]),
            toon: if r.once_in(2) { Some(toon(r)) } else { None },
            silhouette: silhouette(r),
            view_opacity: r.pick(&[0.0, 0.0, 0.7, 30.0]),
        });
    }
}

/// One tone or several, whose steps some normals of a box lie on.
fn toon(r: &mut Random) -> ToonShading {
    let n = 1 + r.below(4);
    let first = r.pick(&[-2.0, -0.5, 0.0]);
    let tone = |i: usize| Tone { at: first + 0.5 * i as f64, color: [i as f64 / 4.0, 0.5, 1.0, 1.0] };
    ToonShading { offset: r.pick(&[0.0, 0.5, -0.3]), tones: (0..n).map(tone).collect() }
}

fn silhouette(r: &mut Random) -> Option<SilhouetteShading> {
    r.pick(&[None, None, Some(SilhouetteShading { offset: 0.45 }), Some(SilhouetteShading { offset: -0.2 })])
}

/// An opaque iso-surface at some value of the volume, or at its lowest, or at one that is found.
fn iso_surface(r: &mut Random, shot: &mut Stage) {
    let [lo, hi] = shot.volume.range();
    let some = lo + r.between(0.0, 1.0) * (hi - lo);
    shot.scene.surface = Some(Surface {
        iso: r.pick(&[Iso::Value(some), Iso::Value(some), Iso::Value(lo), Iso::Auto]),
        look: r.pick(&[SurfaceLook::White, SurfaceLook::Phong, SurfaceLook::Toon, SurfaceLook::None]),
        color: r.pick(&[[1.0; 4], [0.6, 0.2, 0.1, 1.0]]),
        toon: if r.once_in(2) { Some(toon(r)) } else { None },
        silhouette: silhouette(r),
        view_opacity: r.pick(&[0.0, 2.0]),
    });
}

/// The scene of a seed.
pub(crate) fn scene(seed: u64) -> Stage {
    let r = &mut Random(seed);
    let dims = dims(r);
    let grid = grid(r, dims);
    let (source, volume) = if r.once_in(4) {
        let (source, volume) = phantom(r);
        (VolumeSource::Phantom(source), volume)
    } else {
        (VolumeSource::File { path: "volume.nrrd".into(), raw: None }, volume(r, grid))
    };
    let ids = r.pick(&[Ids::Values, Ids::Values, Ids::Values, Ids::Values, Ids::Values, Ids::Mask]);
    let volume = if ids == Ids::Mask { volume.present() } else { volume };
    let grid = volume.grid().clone();
    let mut shot = function(r, volume);
    picture(r, &mut shot);
    shading(r, &mut shot.scene);
    let s = &mut shot.scene;
    (s.volume.source, s.volume.ids) = (source, ids);
    s.camera = camera(r, &grid);
    if r.once_in(4) {
        let [lo, hi] = shot.volume.range();
        s.volume.range = Some([lo + r.between(-0.3, 0.4) * (hi - lo), hi + r.between(-0.4, 0.3) * (hi - lo) + 1.0]);
    }
    s.volume.outside = r.pick(&[Outside::Low, Outside::High]);
    s.volume.gradient_range = r.pick(&[
        GradientRange::Quantile(0.999),
        GradientRange::Quantile(0.5),
        GradientRange::Quantile(1.0),
        GradientRange::Fixed([0.0, 30.0]),
        GradientRange::Fixed([4.0, 4.0]),
    ]);
    let sampling = &mut s.sampling;
    sampling.step = Length::Voxels(r.pick(&[0.1, 0.5, 0.5, 1.0, 3.0]));
    sampling.reference_length = Length::Voxels(r.pick(&[0.2, 1.0, 1.0, 7.0]));
    sampling.step_along = r.pick(&[StepAlong::Plane, StepAlong::Plane, StepAlong::Ray]);
    sampling.kernel = r.pick(&KERNELS);
    sampling.gradient = r.pick(&[
        GradientEstimator::Central,
        GradientEstimator::Analytic,
        GradientEstimator::Sobel,
        GradientEstimator::Regression,
    ]);
    sampling.hessian = match sampling.kernel {
        Kernel::Trilinear | Kernel::CatmullRom => {
            r.pick(&[HessianEstimator::Auto, HessianEstimator::Central, HessianEstimator::Gaussian])
        }
        _ => r.pick(&[HessianEstimator::Auto, HessianEstimator::Analytic, HessianEstimator::Gaussian]),
    };
    sampling.scale = Length::Voxels(r.pick(&[0.1, 1.0, 2.0]));
    sampling.normal = r.pick(&[NormalSide::Outward, NormalSide::Outward, NormalSide::Facing, NormalSide::Gradient]);
    sampling.number = r.pick(&[Number::F64, Number::F64, Number::F32]);
    sampling.stop_below = r.pick(&[0.0, 0.0, 0.01, 0.5]);
    sampling.skip_empty = !r.once_in(8);
    let threshold = r.pick(&[0.0, 0.4, 1.0]);
    if r.once_in(2) {
        s.contours = Some(Contours {
            thickness: Length::Voxels(r.pick(&[0.0, 1.0, 2.0, 50.0])),
            kappa: r.pick(&[Kappa::Ray, Kappa::Ray, Kappa::Exact, Kappa::None { threshold }]),
            sign_flip: r.pick(&[SignFlip::TwoSided, SignFlip::Literal]),
            fade: r.pick(&[None, None, Some([0.1, 0.4]), Some([0.2, 0.2])]),
        });
    }
    if r.once_in(3) {
        s.style_mipmaps = Some(StyleMipmaps {
            curvature_bias: r.pick(&[0.0, 1.0, 3.0]),
            gradient_bias: r.pick(&[0.0, 1.0, 2.5]),
            turn: r.pick(&[0.0, 2.0 / 256.0, 0.3]),
        });
    }
    if r.once_in(3) {
        over_two(r, &mut shot);
    }
    if r.once_in(4) {
        iso_surface(r, &mut shot);
    }
    if r.once_in(4) {
        clips(r, &mut shot);
    }
    // Of an orbit the first frame is drawn.
    shot.scene.orbit = r.pick(&[None, None, None, Some(Orbit { frames: 7, degrees: -90.0, ..Orbit::default() })]);
    if let Some(orbit) = &mut shot.scene.orbit {
        (orbit.frames, orbit.degrees) = (1 + r.below(40), r.pick(&[360.0, 90.0, -30.5]));
    }
    shot
}
