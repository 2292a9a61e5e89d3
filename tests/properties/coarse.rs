//! Coarse frames of a renderer: those of the scene in that size, with nothing left of them in the frames that follow.

use super::generator::scene;
use drypoint::frames::{Frames, ReferenceFrames};
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::tables::{Background, RaysPerPixel};
use std::num::NonZeroUsize;

const STYLES: &str =
    "nodes = [{ at = 90, style = \"wax\", opacity = 0 }, { at = 150, style = \"bone\", opacity = 0.6 }]";
const COLORS: &str = "kind = \"regular\"\n\
                      nodes = [{ at = 90, color = \"red\", opacity = 0 }, { at = 150, color = \"white\", opacity = 0.6 }]\n\
                      [shading]\nlight = [1, 2, 3]";

fn job(picture: &str, camera: &str, tables: &str) -> Job {
    let text = format!(
        "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 24 }}\n[picture]\nlayers = [\"beauty\", \"first\"]\n\
         {picture}\n[camera]\ndirection = [1, 2, 0.7]\n{camera}\n[transfer]\n{tables}"
    );
    let scene = parse(&text, "coarse.toml".as_ref(), &Overrides::default()).unwrap_or_else(|faults| panic!("{faults}"));
    Job::load(scene).unwrap_or_else(|failures| panic!("{failures}"))
}

/// A coarse frame is that of the scene with `picture.size` and `picture.samples` of its own, bit for bit. The exact frames
/// before and after it are equal.
#[test]
fn a_coarse_frame_is_the_scene_in_its_size() {
    let contours = "[contours]\nkappa = \"exact\"\n";
    let halos = "[[halo]]\nseed.value = [[100, 0], [150, 1]]\nspread.reach = \"15 %\"\n\
                 [[halo]]\nname = \"glow\"\nkind = \"emissive\"\nspread.reach = \"9 px\"\n";
    let object = "[[object]]\nname = \"part\"\nvalue = [[150, 0], [180, 1]]\n";
    let moved = &format!("{object}move = [0, 9, 2]\n[object.ghost]\n");
    let cutaway = &format!("{object}move = [0, 9, 2]\nghosting = 0.9\nfunnel = \"4 %\"\ncut = \"object\"\n");
    let clip = "[[clip]]\nnormal = [-1, 0, 0]\npoint = [2, 0, 0]\n";
    let surface = "[surface]\niso = \"auto\"\nlook = \"phong\"\n";
    let cases = [
        ("\"auto\"", vec![contours]),
        ("\"auto\"", vec![STYLES, contours]),
        ("2", vec![STYLES, contours, clip]),
        ("\"auto\"", vec![STYLES, "[style_mipmaps]", moved]),
        ("\"auto\"", vec![STYLES, contours, halos, moved]),
        ("\"auto\"", vec![COLORS]),
        ("1", vec![COLORS, halos, cutaway, clip]),
        ("2", vec![COLORS, cutaway]),
        ("3", vec![COLORS, surface, "[sampling]\nnumber = \"f32\"\nstep_along = \"ray\""]),
    ];
    for (samples, tables) in &cases {
        for camera in ["", "projection = \"perspective\"\nfov = 40"] {
            let tables = tables.join("\n");
            let exact = job(&format!("size = [61, 50]\nsamples = {samples}"), camera, &tables);
            let small = job("size = [16, 13]\nsamples = 1", camera, &tables);
            let (shot, coarse) = (exact.shot().unwrap(), exact.coarse_shot(NonZeroUsize::new(4).unwrap()).unwrap());
            assert_eq!(coarse, small.shot().unwrap(), "{tables}");
            let mut frames = ReferenceFrames::new(exact.renderer().unwrap(), &exact.scene);
            let before = frames.frame(&|_| ()).unwrap().0;
            frames.turn(&coarse).unwrap();
            assert!(frames.frame(&|_| ()).unwrap().0 == small.renderer().unwrap().frame(&|_| ()).0, "{tables}");
            frames.turn(&shot).unwrap();
            assert!(frames.frame(&|_| ()).unwrap().0 == before, "{tables}");
        }
    }
}

/// A picture behind the volume is stretched to one size: a frame of another size is refused.
#[test]
fn a_picture_behind_has_no_coarse_frame() {
    let file = format!("{}/data/pictures/three-spheres.png", env!("CARGO_MANIFEST_DIR"));
    let job = job(&format!("size = [20, 10]\nbackground = {file:?}"), "", COLORS);
    let mut frames = ReferenceFrames::new(job.renderer().unwrap(), &job.scene);
    let before = frames.frame(&|_| ()).unwrap().0;
    let failure = frames.turn(&job.coarse_shot(NonZeroUsize::new(2).unwrap()).unwrap()).unwrap_err().to_string();
    assert!(failure.contains("was not stretched to 10 × 5 pixels"), "{failure}");
    assert!(frames.frame(&|_| ()).unwrap().0 == before);
}

/// The same of random scenes without a picture behind them.
#[test]
fn coarse_frames_of_random_scenes() {
    for seed in 0..120 {
        let mut exact = scene(seed);
        if exact.behind.take().is_some() {
            exact.scene.picture.background = Background::None;
        }
        let coarse = exact.with(|scene| {
            scene.picture.size = scene.picture.size.map(|side| side.div_ceil(2));
            scene.picture.samples = RaysPerPixel::Across(1);
        });
        let shots = [&coarse, &exact].map(|stage| stage.resolved(stage.view()));
        for (turned, fresh) in exact.render_turned(&shots).iter().zip([&coarse, &exact]) {
            assert!(turned.bits() == fresh.render().bits(), "{seed}");
        }
    }
}
