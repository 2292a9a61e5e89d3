//! Lines inside the volume, at their depths.

use crate::double::{agrees, agrees_among, load};
use crate::formulas::random;
use crate::gpu;
use drypoint::drawing::Drawing;
use drypoint::job::Job;
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;
use drypoint::scene::fragments::{Fragment, Fragments};

/// A torus with strokes inside it, `keys` in its picture and `more` tables.
pub(crate) fn scene(keys: &str, more: &str) -> String {
    format!(
        "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 24 }}\n[camera]\ndirection = [0.4, 1, -0.3]\n\
         [hatching]\niso = 128\nhidden = \"merged\"\n\
         [picture]\nsize = [40, 32]\nbackground = \"#203040\"\n{keys}\n\
         [transfer]\nkind = \"regular\"\nnodes = [{{ at = 90, color = \"#804020\", opacity = 0 }}, \
         {{ at = 128, color = \"#ffcc88\", opacity = 0.1 }}, {{ at = 140, color = \"#88ccff\", opacity = 0.4 }}]\n{more}"
    )
}

/// Lines before, in and behind the volume: some in the middle of a sample's way, some where two ways meet, several on one
/// ray, some at one depth, some opaque. A third of the rays has none.
pub(crate) fn lines(job: &Job) -> Option<Fragments> {
    let shot = job.shot().unwrap();
    let (view, n, step) = (&shot.view, shot.rays_across, shot.lattice.step);
    let depths = job.volume.grid().world_corners().map(|corner| -view.to_eye(corner).z);
    let [near, far] = depths.iter().fold([f64::INFINITY, 0.0f64], |[a, b], d| [a.min(*d), b.max(*d)]);
    let rays = view.size[0] * view.size[1] * n * n;
    let mut next = random(5);
    let found: Vec<(usize, Fragment)> = (0..rays)
        .map(|_| {
            let anywhere = near + (far - near) * (1.3 * next() - 0.15);
            let kind = (next() * 4.0) as usize;
            let depth = [anywhere, (anywhere / step).floor() * step, (near + far) * 0.5, anywhere][kind];
            let rgb = [next(), next(), next()];
            let opacity = [0.2, 0.6, next(), if next() < 0.2 { 1.0 } else { 0.3 }][(next() * 4.0) as usize];
            ((next() * rays as f64) as usize, Fragment { depth, rgb, opacity })
        })
        .collect();
    Some(Fragments::new(view.size, n, &found))
}

#[test]
fn lines_lie_at_their_depths() {
    let layers = "layers = [\"beauty\", \"Z\", \"depth\", \"first\", \"normal\", \"gradient\"]";
    let styles = "[contours]\nthickness = \"1 voxel\"\nkappa = \"ray\"\n";
    let surface = "[shading]\n[surface]\niso = 150\nlook = \"phong\"\ncolor = \"#d8b4cc\"\n";
    let clip = "[shading]\n[[clip]]\npoint = [11.3, 11.2, 11.1]\nnormal = [0.2, -1, 0.3]\nspace = \"index\"\ncap = \"#ff0000\"\n";
    let covering = "layers = [\"beauty\", \"part0\", \"part1\", \"part2\"]";
    let object = "[[object]]\nname = \"a\"\nvalue = [[90, 0], [140, 0.8]]\nmove = [2, 1, 0]\nghosting = 0.5\n";
    let parallel = scene("samples = 1", "").replace("[camera]\n", "[camera]\nprojection = \"orthographic\"\n");
    let in_styles = |text: String| {
        let text = text.replace("kind = \"regular\"\n", "");
        ["#804020", "#ffcc88", "#88ccff"]
            .iter()
            .fold(text, |text, color| text.replace(&format!("color = \"{color}\""), "style = \"wax\""))
    };
    for (name, text) in [
        ("lines", scene("samples = 1", "[shading]\n")),
        ("lines, parallel rays", parallel),
        ("lines, shells", scene("samples = 1", "[shading]\n[sampling]\nstep_along = \"ray\"\n")),
        ("lines, equal rays", scene("", "[shading]\n")),
        ("lines, nine rays", scene("samples = 3", "[shading]\n")),
        ("lines, encoded", scene("samples = 1\nblend_space = \"srgb\"", "[shading]\n")),
        ("lines, layers", scene(&format!("samples = 1\n{layers}"), "[shading]\n")),
        ("lines, to the end", scene("samples = 1", "[shading]\n[sampling]\nstop_below = 0\n")),
        ("lines, surface", scene("samples = 1", surface)),
        ("lines, surface, layers", scene(&format!("samples = 1\n{layers}"), surface)),
        ("lines, cut", scene("samples = 1", clip)),
        ("lines, coverage", scene(&format!("samples = 1\n{covering}"), object)),
        ("lines, contours", in_styles(scene("samples = 1", styles))),
    ] {
        agrees_among(name, &text, lines);
    }
}

/// A scene that can have lines, and whose frame has none.
#[test]
fn a_frame_may_have_no_line() {
    agrees("no line", &scene("samples = 1", "[shading]\n"));
}

/// Strokes of a scene inside its volume, from the camera of each frame.
#[test]
fn strokes_are_inside_every_frame() {
    let Some(gpu) = gpu() else { return };
    let job = load(&scene("", "[shading]\n[orbit]\nframes = 3\ndegrees = 90\n"));
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_| {}).unwrap_or_else(|failure| panic!("{failure}"));
    let mut frames = Drawing::new(&job, &marking, &mut counts).unwrap_or_else(|failure| panic!("{failure}"));
    let mut on_gpu = Drawing::on(&job, &marking, Some(&gpu), &mut counts).unwrap_or_else(|failure| panic!("{failure}"));
    for i in 0..3 {
        let [truth, drawn] = [&mut frames, &mut on_gpu].map(|frames| {
            let (frame, _) = frames.frame(i, &|_| {}).unwrap_or_else(|failure| panic!("{failure}"));
            assert!(frame.inside > 10, "{}", frame.inside);
            frame.picture.unwrap().layers[0].channels.concat()
        });
        let largest = truth.iter().zip(&drawn).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        println!("frame {i}: f32 {largest:.1e}");
        assert!(largest < 1e-5, "frame {i}: {largest:e}");
    }
}
