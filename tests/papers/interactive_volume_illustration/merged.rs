//! Lines inside a translucent volume ([HATCH-14] d): in a homogeneous slab the picture is known in closed form.

use crate::common::{Shown, Stage, on, orthographic, perspective, volume};
use drypoint::drawing::Drawing;
use drypoint::job::Job;
use drypoint::marking::Marking;
use drypoint::output::paint::fragments;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::fragments::{Fragment, Fragments};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{BlendSpace, Camera, Iso, Length, RaysPerPixel, StepAlong, Surface, SurfaceLook};
use drypoint::scene::volume::{Volume, Voxels};
use std::path::Path;

/// Opacity of one unit, and colour.
const ALPHA: f64 = 0.2;
const FOG: [f64; 3] = [0.9, 0.5, 0.2];
const INK: [f64; 3] = [0.1, 0.2, 0.7];

/// A slab of 16 units, seen along y from its middle, in steps of half a unit: it reaches from depth −8 to 8, both between
/// steps.
fn slab() -> Stage {
    fog(volume([17; 3], |_| 1.0))
}

fn fog(volume: Volume) -> Stage {
    Stage::regular(volume, &[(-1e3, FOG, ALPHA), (1e3, FOG, ALPHA)]).with(|s| {
        s.sampling.step = Length::World(0.5);
        s.sampling.reference_length = Length::World(1.0);
        s.sampling.stop_below = 0.0;
        // Every ray goes through all of it.
        s.camera = Camera { direction: DVec3::Y, ..orthographic(Some(8.0)) };
    })
}

/// The same lines on every ray of 16 × 16 pixels.
fn everywhere(lines: &[Fragment]) -> Fragments {
    let found: Vec<_> = (0..256).flat_map(|ray| lines.iter().map(move |line| (ray, *line))).collect();
    Fragments::new([16, 16], 1, &found)
}

fn line(depth: f64, opacity: f64) -> Fragment {
    Fragment { depth, rgb: INK, opacity }
}

/// Front to back: a way through fog, a line.
fn composite(parts: &[(f64, Option<Fragment>)]) -> [f64; 4] {
    let mut out = [0.0; 4];
    let mut over = |rgb: [f64; 3], alpha: f64| {
        let w = (1.0 - out[3]) * alpha;
        (0..3).for_each(|i| out[i] += w * rgb[i]);
        out[3] += w;
    };
    for (way, line) in parts {
        over(FOG, 1.0 - (1.0 - ALPHA).powf(*way));
        if let Some(line) = line {
            over(line.rgb, line.opacity);
        }
    }
    out
}

/// All pixels are that. Some 40 steps, each of a few roundings.
fn assert_all(shown: &Shown, wanted: [f64; 4]) {
    for pixel in shown.pixels() {
        assert!((0..4).all(|i| (pixel[i] - wanted[i]).abs() < 1e-13), "{pixel:?} {wanted:?}");
    }
}

/// A line at any depth, on a sample, between two steps and anywhere, has exactly the way before it before it.
#[test]
fn a_line_in_a_slab() {
    for depth in [-7.75, -7.99, -3.0, -0.123, 0.0, 0.25, 4.6, 7.999] {
        for opacity in [0.3, 1.0] {
            let line = line(depth, opacity);
            let wanted = composite(&[(depth + 8.0, Some(line)), (8.0 - depth, None)]);
            assert_all(&slab().render_among(&everywhere(&[line])), wanted);
        }
    }
}

/// Before the slab it lies over the picture, behind it under the picture, and samples are evaluated as often as without it.
#[test]
fn a_line_before_and_behind() {
    let plain = slab().render();
    let [r, g, b, a] = plain.pixels()[0];
    let part = |depth| slab().render_among(&everywhere(&[line(depth, 0.4)]));
    let (before, behind) = (part(-9.0), part(9.0));
    let over = |c: f64, ink: f64| 0.4 * ink + 0.6 * c;
    assert_all(&before, [over(r, INK[0]), over(g, INK[1]), over(b, INK[2]), over(a, 1.0)]);
    let under = |c: f64, ink: f64| c + (1.0 - a) * 0.4 * ink;
    assert_all(&behind, [under(r, INK[0]), under(g, INK[1]), under(b, INK[2]), under(a, 1.0)]);
    assert_eq!([before.counts.samples, behind.counts.samples], [plain.counts.samples; 2]);
    // Inside one more a ray: the sample that is split.
    let inside = part(0.1);
    assert_eq!(inside.counts.samples, plain.counts.samples + 256);
    // No ray is longer for a line that lies behind something opaque.
    assert_eq!(slab().render_among(&everywhere(&[line(-9.0, 1.0)])).counts.samples, 0);
}

/// Several lines by their depths, two of them in one step; of equal depths the first.
#[test]
fn several_lines() {
    let (near, far) = (line(-2.1, 0.5), Fragment { rgb: [0.0, 1.0, 0.0], ..line(-2.05, 0.25) });
    let last = Fragment { rgb: [1.0, 0.0, 0.0], ..line(5.0, 0.75) };
    let wanted = composite(&[(5.9, Some(near)), (0.05, Some(far)), (7.05, Some(last)), (3.0, None)]);
    assert_all(&slab().render_among(&everywhere(&[last, far, near])), wanted);
    let [a, b] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|rgb| Fragment { rgb, ..line(1.0, 1.0) });
    let first = |lines: &[Fragment]| slab().render_among(&everywhere(lines));
    assert_all(&first(&[a, b]), composite(&[(9.0, Some(a))]));
    assert_all(&first(&[b, a]), composite(&[(9.0, Some(b))]));
}

/// From inside the slab, in perspective: the way from the first plane, or shell, to the line is its depth over cos φ.
#[test]
fn a_line_in_perspective() {
    for along in [StepAlong::Plane, StepAlong::Ray] {
        let shot = slab().with(|s| {
            s.camera = Camera {
                eye: Some(DVec3::splat(8.0)),
                direction: DVec3::Y,
                direction_given: true,
                ..perspective(60.0)
            };
            s.sampling.step_along = along;
        });
        let found: Vec<_> = (0..256).map(|ray| (ray, line(3.3, 1.0))).collect();
        let shown = shot.render_among(&Fragments::new([16, 16], 1, &found));
        let view = shot.view();
        for (n, pixel) in shown.pixels().into_iter().enumerate() {
            let cos_phi = view.ray((n % 16) as f64 + 0.5, (n / 16) as f64 + 0.5).cos_phi;
            // The first plane beyond `near`, a step, stands for the way from one step on.
            let way = match along {
                StepAlong::Plane => (3.3 - 0.5) / cos_phi,
                StepAlong::Ray => 3.3 / cos_phi - 0.5,
            };
            let wanted = composite(&[(way, Some(line(3.3, 1.0)))]);
            assert!((0..4).all(|i| (pixel[i] - wanted[i]).abs() < 1e-13), "{n}: {pixel:?} {wanted:?}");
        }
    }
}

/// A surface at depth 3.4 hides what lies behind it, and the way to it is as long as without lines.
#[test]
fn a_line_before_a_surface() {
    let shot = fog(on(Grid::with_spacing([17; 3], [1.0; 3]).unwrap(), |p| 8.0 - p.y)).with(|s| {
        s.surface = Some(Surface { iso: Iso::Value(-3.4), look: SurfaceLook::White, ..Surface::default() });
    });
    let surface = Fragment { depth: 3.4, rgb: [1.0; 3], opacity: 1.0 };
    for depth in [-1.3, 3.1, 3.3, 3.39] {
        let line = line(depth, 0.6);
        let wanted = composite(&[(depth + 8.0, Some(line)), (3.4 - depth, Some(surface))]);
        assert_all(&shot.render_among(&everywhere(&[line])), wanted);
    }
    assert_all(&shot.render_among(&everywhere(&[line(3.5, 1.0)])), composite(&[(11.4, Some(surface))]));
    // A surface alone.
    let alone = shot.with(|s| s.transfer = None);
    let half = alone.render_among(&everywhere(&[line(0.0, 0.5), line(4.0, 1.0)]));
    assert_all(&half, [0.55, 0.6, 0.85, 1.0]);
}

/// Encoded compositing takes the ink's codes: half of it over white, nothing else there.
#[test]
fn encoded_codes_are_composited() {
    use drypoint::scene::color::{linear_to_srgb, srgb_to_linear};
    let shot = Stage::regular(volume([5; 3], |_| 0.0), &[(1.0, FOG, 0.0), (2.0, FOG, 1.0)]).with(|s| {
        s.picture.blend_space = BlendSpace::Srgb;
        s.picture.background = drypoint::scene::tables::Background::Color([1.0; 4]);
    });
    let [r, g, b] = INK.map(|c| srgb_to_linear(0.5 * linear_to_srgb(c) + 0.5));
    assert_all(&shot.render_among(&everywhere(&[line(0.0, 0.5)])), [r, g, b, 1.0]);
}

/// Layers count samples alone, whatever lines lie among them ([IO-6]); and a pixel's parts have their own lines.
#[test]
fn layers_and_parts_of_pixels() {
    let depths = |lines: &[Fragment]| slab().layers(&[LayerKind::Depth]).render_among(&everywhere(lines));
    let plain = depths(&[]).layer::<3>(LayerKind::Depth)[0];
    assert!(plain[0] == -7.75 && plain[0] < plain[2]);
    assert_eq!(depths(&[line(0.0, 0.9)]).layer::<3>(LayerKind::Depth)[0], plain);
    // Half the rays of each pixel end at a line before the slab.
    let shot = slab().with(|s| s.picture.samples = RaysPerPixel::Across(2));
    let rays: Vec<_> = (0..1024).step_by(2).map(|ray| (ray, line(-9.0, 1.0))).collect();
    let fog = composite(&[(16.0, None)]);
    let wanted = [0, 1, 2, 3].map(|i| 0.5 * fog[i] + 0.5 * [INK[0], INK[1], INK[2], 1.0][i]);
    assert_all(&shot.render_among(&Fragments::new([16, 16], 2, &rays)), wanted);
}

/// Tiles, lanes and threads change no bit, of a picture with bricks to skip and lines on every other pixel.
#[test]
fn nothing_shows_how_it_was_drawn() {
    let voxels = (0..40usize.pow(3)).map(|i| if i % 1600 < 600 { 0 } else { (i * 37 % 251) as u8 }).collect();
    let grid = Grid::with_spacing([40; 3], [1.0; 3]).unwrap();
    let volume = Volume::new(grid, Voxels::U8(voxels), 1.0, 0.0).unwrap();
    let shot = Stage::regular(volume, &[(0.0, FOG, 0.0), (10.0, FOG, 0.0), (255.0, INK, 0.4)])
        .with(|s| s.picture.size = [40, 30])
        .seen_along([0.3, 1.0, -0.2]);
    let found: Vec<_> = (0..1200)
        .step_by(2)
        .flat_map(|ray| [3, 7, 12].map(|k| (ray, line(f64::from(k * ray as i32 % 31) - 15.5, 0.3))))
        .collect();
    let lines = Fragments::new([40, 30], 1, &found);
    let by = |set: &dyn Fn(drypoint::reference::ray::Renderer<'_>) -> drypoint::reference::ray::Renderer<'_>| {
        shot.render_by(|mut renderer| {
            renderer.merge(Some(lines.clone()));
            set(renderer)
        })
    };
    let plain = shot.render_among(&lines);
    assert_ne!(plain.bits(), shot.render().bits());
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    let others =
        [by(&|r| r.with_tiles(1)), by(&|r| r.with_tiles(17)), by(&|r| r.ray_by_ray()), pool.install(|| by(&|r| r))];
    for other in others {
        assert_eq!(other.bits(), plain.bits());
        assert_eq!(other.counts.samples, plain.counts.samples);
    }
}

/// A scene: black strokes on a torus in white fog. A pixel whose nearest stroke covers it whole shows 1 − T of white, and T
/// is that of the way to the stroke, which lies as deep as the torus there: within a chord, the distance before the surface, and
/// the slope over half the stroke's width.
#[test]
fn strokes_of_a_scene_lie_where_their_surface_does() {
    const FAINT: f64 = 0.02;
    let scene = |hidden: &str| {
        format!(
            "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 49, type = \"f64\", param = {{ R = 14, r = 6 }} }}\n\
             [camera]\nprojection = \"orthographic\"\ndirection = [0.2, 0.5, -0.8]\nheight = 48\n\
             [picture]\nsize = [240, 240]\ndpi = 100\nsamples = 1\nbackground = \"none\"\n[sampling]\nreference_length = \"1 voxels\"\nstep = \"0.25 voxels\"\n\
             [transfer]\nkind = \"regular\"\nnodes = [{{ at = -100, color = \"white\", opacity = {FAINT} }}, {{ at = 100, color = \"white\", opacity = {FAINT} }}]\n\
             [hatching]\niso = 0\nseeds = \"dense\"\nwidth = \"0.6 mm\"\nhidden = \"{hidden}\"\n[hatching.stroke]\ntone = 0\ntaper = 0\n"
        )
    };
    let load =
        |hidden| Job::load(parse(&scene(hidden), Path::new("scene.toml"), &Overrides::default()).unwrap()).unwrap();
    let draw = |job: &Job| {
        let mut counts = Counts::default();
        let marking = Marking::new(job, &mut counts, &|_| ()).unwrap();
        let (frame, own) = Drawing::new(job, &marking, &mut counts).unwrap().frame(0, &|_| ()).unwrap();
        counts.add(&own);
        let [over, inside] = marking
            .frames(&mut Counts::default())
            .unwrap()
            .draw_apart(&job.view().unwrap(), &mut Counts::default())
            .unwrap();
        (frame.marks(), frame.painted(job).unwrap(), counts, [over, inside])
    };
    let job = load("merged");
    let ([_, lines], picture, counts, [over, inside]) = draw(&job);
    let (view, centre) = (job.view().unwrap(), job.volume.grid().centre());
    let found = fragments(&inside, &view, 1);
    assert!(over.layers.is_empty() && lines == inside.layers[0].lines.len() && lines > 500);
    assert_eq!(counts.preprocess["places of lines on rays"], found.len() as u64);
    assert_eq!(counts.preprocess["looks for what hides"], 0);
    let [red, alpha] = [0, 3].map(|c: usize| &picture.layers[0].channels[c]);
    let tube = |p: DVec3| 6.0 - (p.x.hypot(p.y) - 14.0).hypot(p.z);
    let (mut compared, mut worst) = (0, 0.0f64);
    for (n, (&white, &alpha)) in red.iter().zip(alpha).enumerate() {
        let at = [(n % 240) as f64 + 0.5, (n / 240) as f64 + 0.5];
        let ray = view.ray(at[0], at[1]);
        let [Fragment { depth, opacity: 1.0, .. }, ..] = *found.at(at) else { continue };
        let place = |s: f64| ray.origin + ray.along * s - centre;
        // Where the ray enters the box of half 24 voxels, and where the way of its first sample begins.
        let enters = (0..3).map(|i| (-24.0 * ray.along[i].signum() - (ray.origin - centre)[i]) / ray.along[i]);
        let first = (enters.fold(f64::NEG_INFINITY, f64::max) / 0.25 - 0.5).ceil() * 0.25;
        let wanted = 1.0 - (1.0 - FAINT).powf((depth - first).max(0.0));
        assert!((white - wanted).abs() < 1e-11 && alpha == 1.0, "{n}: {white} {wanted}");
        let depths = (0..960).map(|k| -48.0 + 0.1 * f64::from(k));
        let changes = depths.filter(|&s| (tube(place(s)) > 0.0) != (tube(place(s + 0.1)) > 0.0)).map(|s| s + 0.05);
        let cosine = |s: f64| {
            let step = |i: usize| DVec3::AXES[i] * 1e-5;
            let slope = |i| (tube(place(s) + step(i)) - tube(place(s) - step(i))) / 2e-5;
            (0..3).map(|i| slope(i) * view.forward[i]).sum::<f64>().abs()
        };
        let roots: Vec<[f64; 2]> = changes.map(|s| [s, cosine(s)]).collect();
        if roots.is_empty() || roots.iter().any(|root| root[1] < 0.7) {
            continue;
        }
        // Half of 0.6 mm is 1.2 pixels of 0.2 voxels, and a pixel's corner is 0.14 voxels from its middle.
        let off = |[root, cosine]: &[f64; 2]| {
            let bound = 0.05 + (0.15 + 0.1) / cosine + (0.24 + 0.14) * (1.0 - cosine * cosine).sqrt() / cosine;
            (root - depth).abs() / bound
        };
        worst = worst.max(roots.iter().map(off).fold(f64::INFINITY, f64::min));
        compared += 1;
    }
    assert!(compared > 500 && worst < 1.0, "{compared} {worst}");
    // Painted over, the same strokes are black.
    let ([_, as_many], drawn, counts, [over, inside]) = draw(&load("drawn"));
    assert!(as_many == lines && inside.layers.is_empty() && over.layers[0].lines.len() == lines);
    let channels = &drawn.layers[0].channels;
    assert!((0..240 * 240).filter(|&n| channels[0][n] == 0.0 && channels[3][n] == 1.0).count() > 2000);
    assert!(!counts.preprocess.contains_key("places of lines on rays"));
}
