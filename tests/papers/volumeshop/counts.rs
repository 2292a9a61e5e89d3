//! Only what is called for: rays and samples that meet no object do the work of a scene without ([VS-2]).

use super::{LIT, SHELLS, drawn, job_of, layer, scene_of};
use drypoint::scene::picture::LayerKind;

fn counted(rest: &str) -> (Vec<f64>, u64) {
    let text = scene_of(SHELLS, &format!("{LIT}{rest}"))
        .replace("samples = 1\n", "samples = 1\nlayers = [\"beauty\", \"counts\"]\n");
    let (picture, counts) = drawn(&text);
    (layer(&picture, LayerKind::Counts)[0].clone(), counts.samples)
}

#[test]
fn rays_beside_an_object_do_the_same_work() {
    let (plain, _) = counted("");
    let (with, _) = counted("[[object]]\nvalue = [[190, 0], [200, 1]]\nmove = [0, 0, 3]\nghosting = 0.5\n");
    let same = plain.iter().zip(&with).filter(|(plain, with)| plain == with && **plain > 0.0).count();
    let more = plain.iter().zip(&with).filter(|(plain, with)| with > plain).count();
    assert!(same > 40 && more > 20, "{same} {more}");
}

/// A selection that is moved away from the background is looked up once a sample in its own box, and nothing else is. The
/// pieces of the background share one look-up.
#[test]
fn a_selection_beside_the_background_is_one_look_up() {
    let (_, plain) = counted("");
    let (_, still) = counted("[[object]]\nvalue = [[190, 0], [200, 1]]\n");
    assert_eq!(plain, still, "a selection that is not moved");
    let camera = "[camera]\nprojection = \"orthographic\"\nheight = 120\ndirection = [0, 0, 1]\nup = [0, 1, 0]\n";
    let (_, here) = counted(camera);
    let (_, beside) = counted(&format!("{camera}[[object]]\nmove = [40, 0, 0]\n"));
    // The same samples once at each place; the field between bricks is skipped at neither.
    assert!(beside > 2 * here - here / 4 && beside <= 2 * here + here / 4, "{here} {beside}");
}

/// Rays beside all objects are cast side by side, and every ray shows the bits that it shows alone: from afar, from between the
/// places of a moved selection, and from within one.
#[test]
fn rays_beside_objects_are_cast_as_if_alone() {
    const MOVED: &str = "[[object]]\nvalue = [[190, 0], [200, 1]]\nmove = [9, 0, 3]\n";
    const CUT: &str = "ghosting = 0.6\nfunnel = \"2 px\"\n";
    for camera in [
        "direction = [1, 0.3, 0.2]",
        "direction = [0, 1, 0]\nprojection = \"orthographic\"",
        "eye = [20, 16, 16]\ntarget = [0, 15, 14]\nfov = 60",
        "eye = [15.5, 15.5, 15.5]\ntarget = [40, 15, 20]\nfov = 90",
    ] {
        for more in ["", CUT] {
            let job = job_of(&scene_of(SHELLS, &format!("{LIT}[camera]\n{camera}\n{MOVED}{more}")));
            let renderer = || job.renderer().unwrap();
            assert!(renderer().in_lanes());
            let [together, alone] = [renderer(), renderer().ray_by_ray()].map(|renderer| renderer.again(&|_| ()));
            assert!(together.0 == alone.0, "{camera} {more}");
        }
    }
}
