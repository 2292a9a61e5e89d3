//! Which object a pixel shows: layers `part0`, `part1`, … ([IO-6], [VS-3]).

use super::{LIT, SHELLS, drawn, job_of, layer, scene_of};
use drypoint::scene::counts::Counts;
use drypoint::scene::fragments::{Fragment, Fragments};
use drypoint::scene::picture::{LayerKind, Picture};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// The coverage of so many objects of a picture, and its opacities. Their layers change no pixel and no count.
fn coverage(rest: &str, samples: &str, objects: usize) -> (Vec<Vec<f64>>, Vec<f64>) {
    let text = scene_of(SHELLS, rest);
    let with = |layers: String| text.replace("samples = 1\n", &format!("samples = {samples}\nlayers = [{layers}]\n"));
    let names = (0..objects).map(|i| format!(", \"part{i}\"")).collect::<String>();
    let (picture, counts) = drawn(&with(format!("\"beauty\"{names}")));
    let (alone, of_alone) = drawn(&with("\"beauty\"".into()));
    let beauty = |picture: &Picture| layer(picture, LayerKind::Beauty).to_vec();
    assert_eq!(beauty(&picture), beauty(&alone), "{rest}");
    let effects = |counts: &Counts| Counts { bytes: BTreeMap::new(), seconds: BTreeMap::new(), ..counts.clone() };
    assert_eq!(effects(&counts), effects(&of_alone), "{rest}");
    let parts = (0..objects).map(|i| layer(&picture, LayerKind::Part(i))[0].clone()).collect();
    (parts, beauty(&picture).swap_remove(3))
}

/// The largest difference between ΣpartN and A.
fn off(parts: &[Vec<f64>], opacities: &[f64]) -> f64 {
    let sum = |pixel: usize| parts.iter().map(|part| part[pixel]).sum::<f64>();
    opacities.iter().enumerate().map(|(pixel, a)| (sum(pixel) - a).abs()).fold(0.0, f64::max)
}

/// A scene without objects has one object, which covers what is seen; an iso-surface belongs to it.
#[test]
fn the_volume_alone_covers_what_is_seen() {
    for more in ["", "[surface]\niso = 110\n", "[[halo]]\n", "[sampling]\nnumber = \"f32\"\n"] {
        for samples in ["1", "2"] {
            let (parts, opacities) = coverage(&format!("{LIT}{more}"), samples, 1);
            let bound = if more.contains("f32") { 1e-6 } else { 1e-14 };
            assert!(off(&parts, &opacities) < bound, "{more}");
            assert!(opacities.iter().sum::<f64>() > 10.0);
        }
    }
}

/// The preset of an intersection, whether it swaps opacities, and whether it has a colour of its own.
type MeetingCase = (&'static str, bool, bool);
/// Two memberships of an object, its motion and its ghosting.
type ObjectCase = ([f64; 2], [f64; 3], f64);
/// Whether sets are combined by products, the rays of a pixel, and whether there is a halo.
type PictureCase = (bool, &'static str, bool);

/// ΣpartN.A is A, whatever combines the sets, and each part is in [0, 1].
#[test]
fn coverage_sums_to_the_opacity() {
    let membership = || 0.0..=0.7f64;
    let presets = prop::sample::select(vec!["max", "over", "in", "out", "atop", "xor", "plus"]);
    let of_meeting = (presets, any::<bool>(), any::<bool>());
    let of_object = ([membership(), membership()], prop::array::uniform3(1.0..=8.0f64), 0.0..=1.0f64);
    let of_picture = (any::<bool>(), prop::sample::select(vec!["1", "2", "\"auto\""]), any::<bool>());
    let seen = RefCell::new([0.0; 4]);
    let run = |(meeting, object, picture): (MeetingCase, ObjectCase, PictureCase)| {
        let ((preset, swap, has_color), ([low, high], moved, ghosting)) = (meeting, object);
        let (product, samples, has_halo) = picture;
        let fuzzy = if product { "product" } else { "zadeh" };
        let color = if has_color { "color = \"#ff401080\"\n" } else { "" };
        let halo = if has_halo { "[[halo]]\n" } else { "" };
        let rest = format!(
            "{LIT}[combine]\nfuzzy = \"{fuzzy}\"\n[[object]]\nname = \"a\"\nvalue = [[60, {low}], [130, {high}]]\n\
             move = {moved:?}\nghosting = {ghosting}\n[object.transfer]\nkind = \"regular\"\n\
             nodes = [{{ at = 20, color = \"red\", opacity = 0.1 }}, {{ at = 255, color = \"blue\", opacity = 0.7 }}]\n\
             [[object]]\nname = \"b\"\nvalue = [[90, 0], [130, 0.8], [200, 0.3]]\n\
             [[intersection]]\nobject = \"a\"\nopacity = \"{preset}\"\nswap = {swap}\n{color}\
             [[intersection]]\nobject = \"a\"\nwith = \"background\"\nopacity = \"over\"\n{halo}"
        );
        let (parts, opacities) = coverage(&rest, samples, 4);
        let off = off(&parts, &opacities);
        prop_assert!(off < 1e-12, "{rest}: {off:e}");
        prop_assert!(parts.iter().flatten().all(|part| (0.0..=1.0 + 1e-12).contains(part)), "{rest}");
        for (seen, part) in seen.borrow_mut().iter_mut().zip(&parts) {
            *seen += part.iter().sum::<f64>();
        }
        Ok(())
    };
    let config = Config { cases: 24, failure_persistence: None, ..Config::default() };
    TestRunner::new(config).run(&(of_meeting, of_object, of_picture), run).unwrap();
    let seen = seen.into_inner();
    assert!(seen.iter().all(|sum| *sum > 1.0), "{seen:?}");
}

/// Sets that meet in two rays of a pixel have the same coverage ray by ray and plane by plane.
#[test]
fn the_order_of_samples_shows_nowhere() {
    let rest = format!(
        "{LIT}[[object]]\nname = \"a\"\nvalue = [[60, 0], [120, 0.9]]\nmove = [3, -2, 1]\nghosting = 0.6\n\
         [[intersection]]\nobject = \"a\"\nopacity = \"plus\"\n[surface]\niso = 200\n"
    );
    let layers = "samples = 2\nlayers = [\"part2\", \"beauty\", \"part0\", \"part1\"]\n";
    let job = job_of(&scene_of(SHELLS, &rest).replace("samples = 1\n", layers));
    let renderer = || job.renderer().unwrap();
    let [rays, planes] = [renderer().ray_by_ray(), renderer().plane_by_plane()].map(|r| r.again(&|_| ()).0);
    assert_eq!(rays, planes);
    assert!(rays.layers.iter().all(|layer| layer.channels[0].iter().sum::<f64>() > 1.0));
}

/// An opaque selection beside the background covers its own pixels alone; antialiased pixels are in between.
#[test]
fn an_object_of_its_own_pixels_is_a_matte() {
    let opaque = "[transfer]\nkind = \"regular\"\nnodes = [{ at = 99.5, color = \"red\", opacity = 0 }, { at = 100, color = \"red\", opacity = 1 }]\n\
                  [camera]\nprojection = \"orthographic\"\ndirection = [0, 1, 0]\nheight = 90\n\
                  [[object]]\nname = \"a\"\nmove = [40, 0, 0]\n[object.ghost.transfer]\nkind = \"regular\"\n\
                  nodes = [{ at = 0, color = \"red\", opacity = 0 }]\n";
    let (parts, opacities) = coverage(opaque, "3", 3);
    let (of_ghost, of_selection) = (&parts[2], &parts[1]);
    assert!(of_ghost.iter().all(|part| *part == 0.0) && off(&parts, &opacities) < 1e-12);
    let count = |is: &dyn Fn(f64) -> bool| of_selection.iter().filter(|part| is(**part)).count();
    assert!(count(&|a| a > 0.999) > 4 && count(&|a| a > 0.01 && a < 0.99) > 4, "{of_selection:?}");
}

/// Objects are white here, meshes and lines black, so ΣpartN is the red of the picture: coverage is what a sample adds to
/// the picture, before and behind opaque and translucent lines and before a mesh. The rest of A is theirs.
#[test]
fn meshes_and_lines_hide_their_part() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = folder.path().join("square.obj");
    std::fs::write(&mesh, "v 2 14 2\nv 29 18 2\nv 29 18 20\nv 2 14 20\nf 1 2 3 4\n").unwrap();
    let white =
        "nodes = [{ at = 20, color = \"white\", opacity = 0 }, { at = 255, color = \"white\", opacity = 0.4 }]\n";
    let objects = format!(
        "[transfer]\nkind = \"regular\"\n{white}[shading]\nambient = 1\ndiffuse = 0\nspecular = 0\n[sampling]\nstop_below = 0\n\
         [[object]]\nname = \"a\"\nvalue = [[60, 0], [120, 0.9]]\nmove = [3, -2, 1]\nghosting = 0.6\n\
         [[intersection]]\nobject = \"a\"\nopacity = \"plus\"\n"
    );
    let square = format!("[[mesh]]\nfile = {:?}\ncolor = \"black\"\n", mesh.display().to_string());
    for (across, more, has_lines) in [(1, &square, false), (1, &String::new(), true), (2, &square, true)] {
        let layers = format!("samples = {across}\nlayers = [\"beauty\", \"part0\", \"part1\", \"part2\"]\n");
        let job = job_of(&scene_of(SHELLS, &(objects.clone() + more)).replace("samples = 1\n", &layers));
        let view = job.shot().unwrap().view;
        let depths = job.volume.grid().world_corners().map(|corner| -view.to_eye(corner).z);
        let [near, far] = depths.iter().fold([f64::INFINITY, 0.0f64], |[a, b], d| [a.min(*d), b.max(*d)]);
        // Of four rays one has no line; the others have one, two or three, of which every fifth is opaque.
        let rays = view.size[0] * view.size[1] * across * across;
        let line = |i: usize| {
            let depth = near + (far - near) * ((i * 37 % 101) as f64 / 101.0);
            (i * 7 % (rays / 4 * 3), Fragment { depth, rgb: [0.0; 3], opacity: [0.3, 0.6, 0.1, 0.8, 1.0][i % 5] })
        };
        let lines: Vec<_> = (0..rays * 3 / 2).map(line).collect();
        let lines = has_lines.then(|| Fragments::new(view.size, across, &lines));
        let drawn = [false, true].map(|by_planes| {
            let mut renderer = job.renderer().unwrap();
            renderer.merge(lines.clone());
            if by_planes { renderer.plane_by_plane() } else { renderer.ray_by_ray() }.again(&|_| ()).0
        });
        assert_eq!(drawn[0], drawn[1]);
        let beauty = layer(&drawn[0], LayerKind::Beauty);
        let parts: Vec<_> = (0..3).map(|i| layer(&drawn[0], LayerKind::Part(i))[0].clone()).collect();
        assert!(off(&parts, &beauty[0]) < 1e-12, "{more}: {:e}", off(&parts, &beauty[0]));
        let sum = |numbers: &[f64]| numbers.iter().sum::<f64>();
        let sums: Vec<f64> = parts.iter().map(|part| sum(part)).collect();
        let [red, opacity] = [0, 3].map(|channel| sum(&beauty[channel]));
        assert!(sums.iter().all(|part| *part > 0.5) && opacity > red + 1.0, "{sums:?} {red} {opacity}");
    }
}
