//! The scenes that come with the program.

use crate::data;
use crate::measure::measure;
use drypoint::drawing::Drawing;
use drypoint::frames::ReferenceFrames;
use drypoint::job::{Job, RenderTarget};
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, load};
use drypoint::scene::picture::{LayerKind, Picture};
use drypoint::scene::plan::Quantity;
use drypoint::scene::shot::Shot;
use drypoint::scene::source::Disk;
use drypoint::scene::style::Theme;
use drypoint::scene::tables::{StyleSource, TransferKind, VolumeSource};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Every scene file in a folder and the folders in it.
fn scenes(folder: &Path) -> Vec<PathBuf> {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    let found = entries.into_iter().flat_map(|path| if path.is_dir() { scenes(&path) } else { vec![path] });
    found.filter(|path| path.extension().is_some_and(|suffix| suffix == "toml")).collect()
}

fn all() -> Vec<PathBuf> {
    scenes(&Path::new(env!("CARGO_MANIFEST_DIR")).join("data/scenes"))
}

/// Whether a scene needs no file.
fn is_of_a_phantom(path: &Path) -> bool {
    std::fs::read_to_string(path).unwrap().contains("\nphantom = ")
}

/// Dots and lines of a scene on a small page, and how much of it they cover.
fn drawn(path: &Path) -> ([usize; 2], f64) {
    let in_mm = std::fs::read_to_string(path).unwrap().contains("\nwidth = ");
    let mut small = vec![("picture.background", "none")];
    if in_mm {
        // Fewer lines and dots than on a whole sheet.
        small.extend([("picture.width", "60 mm"), ("picture.height", "60 mm"), ("picture.dpi", "60")]);
    } else {
        small.push(("picture.size", "[96, 96]"));
    }
    let scene = load(path, &small.into_iter().collect()).unwrap();
    let job = Job::load_for(scene, RenderTarget::Marks, Arc::new(Disk))
        .unwrap_or_else(|failure| panic!("{}: {failure}", path.display()));
    // Keys of what is not drawn here have their effect in the whole picture.
    let idle: Vec<_> = job.plan.idle_keys.iter().filter(|idle| idle.why != "the volume itself is not drawn").collect();
    assert!(idle.is_empty(), "{}: keys without effect: {idle:?}", path.display());
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_| ()).unwrap();
    let (frame, _) = Drawing::new(&job, &marking, &mut counts).unwrap().frame(0, &|_| ()).unwrap();
    let marks = frame.marks();
    let page = frame.painted(&job).unwrap();
    let coverage = &page.layers[0].channels[3];
    (marks, coverage.iter().sum::<f64>() / coverage.len() as f64)
}

#[test]
fn every_scene_gives_a_picture_and_one_of_each_volume_in_every_theme() {
    let here = data().is_some();
    let (mut seen, mut themed) = (0, BTreeSet::new());
    for path in all() {
        if !here && !is_of_a_phantom(&path) {
            println!("skipped: no data for {}", path.display());
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let has = |table: &str| text.contains(&format!("\n[{table}]"));
        let (has_dots, has_lines) =
            (has("stipples"), has("outlines") || has("hatching") || text.contains("\npreset = \"hatch"));
        if has_dots || has_lines {
            let ([dots, lines], ink) = drawn(&path);
            // A leg from afar is a few faint dots on so small a page.
            assert!(ink > 0.0 && ink < 0.9 && (dots > 20 || !has_dots), "{}: {dots} dots, {ink}", path.display());
            assert!(lines > 10 || !has_lines, "{}: {lines} lines", path.display());
            seen += 1;
            continue;
        }
        let small = [("picture.size", "[64, 64]"), ("picture.background", "none")];
        let scene = load(&path, &small.into_iter().collect()).unwrap_or_else(|faults| panic!("{faults}"));
        let job = Job::load(scene).unwrap_or_else(|failure| panic!("{}: {failure}", path.display()));
        assert_eq!(job.plan.idle_keys, [], "{}: keys without effect", path.display());
        let picture = job.renderer().unwrap().frame(&|_| ()).0;
        let m = measure(&picture);
        assert!(m.finite && (0.05..=0.90).contains(&m.covered), "{}: {m:?}", path.display());
        reads_back(&job, &path);
        if has_a_theme(&job) && themed.insert(format!("{:?}", job.scene.volume.source)) {
            draws_in_every_theme(job, &picture, &path);
        }
        seen += 1;
    }
    assert!(if here { seen > 100 && themed.len() > 3 } else { seen > 0 }, "{seen} scenes, {} volumes", themed.len());
}

/// The JSON of a scene's shot is read as the same shot, and as the same text: zeros keep their signs.
fn reads_back(job: &Job, path: &Path) {
    if !job.draws_volume() {
        return;
    }
    let shot = job.shot().unwrap();
    let text = shot.to_json().unwrap();
    let again = serde_json::from_str::<Shot>(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    assert!(again == shot && again.to_json().unwrap() == text, "{}", path.display());
}

/// Whether a scene has styles of an embedded theme. A theme of a scene's own has names of its own.
fn has_a_theme(job: &Job) -> bool {
    let scene = &job.scene;
    let is_own = matches!(scene.styles.theme, StyleSource::Folder(_)) || !scene.styles.files.is_empty();
    !is_own && scene.transfer.as_ref().is_some_and(|transfer| transfer.kind != TransferKind::Regular)
}

/// A scene of styles in every theme but its own: exchanging the theme changes no other line ([STF-12]).
fn draws_in_every_theme(mut job: Job, own: &Picture, path: &Path) {
    let scene = job.scene.clone();
    let m = measure(own);
    for theme in Theme::embedded_names().filter(|name| scene.styles.theme != StyleSource::Embedded((*name).into())) {
        let mut scene = scene.clone();
        scene.styles.theme = StyleSource::Embedded(theme.into());
        job = Job::with_volume(scene, job.volume).unwrap_or_else(|failure| panic!("{theme}: {failure}"));
        let other = job.renderer().unwrap().frame(&|_| ()).0;
        let n = measure(&other);
        assert!(n.finite && *own != other, "{theme}, {}", path.display());
        // Opacities are the scene's; only α_d of what is clear differs a little from theme to theme.
        assert!((m.covered - n.covered).abs() < 0.05, "{theme}, {}: {m:?} and {n:?}", path.display());
    }
}

#[test]
fn the_unshaded_scene_needs_only_values() {
    if data().is_none() {
        println!("skipped: no data");
        return;
    }
    let path = all().into_iter().find(|path| path.ends_with("engine-unshaded.toml")).unwrap();
    let job = Job::load(load(&path, &Overrides::default()).unwrap()).unwrap();
    let needs: Vec<Quantity> = job.plan.needs.iter().map(|need| need.quantity).collect();
    assert_eq!(needs, [Quantity::Value]);
}

#[test]
fn the_regular_twin_differs_in_its_colours_alone() {
    if data().is_none() {
        println!("skipped: no data");
        return;
    }
    let scene = |name: &str| {
        let path = all().into_iter().find(|path| path.ends_with(name)).unwrap();
        load(&path, &Overrides::default()).unwrap()
    };
    let (styled, regular) = (scene("engine.toml"), scene("engine-regular.toml"));
    let opacities = |scene: &drypoint::scene::tables::Scene| -> Vec<[f64; 2]> {
        scene.transfer.as_ref().unwrap().nodes.iter().flatten().map(|node| [node.at, node.opacity]).collect()
    };
    assert_eq!(opacities(&styled), opacities(&regular));
    assert_eq!((styled.camera, styled.picture), (regular.camera, regular.picture));
    assert_eq!((styled.sampling, styled.volume), (regular.sampling, regular.volume));
    assert!(regular.shading.is_some() && regular.contours.is_none());
}

#[test]
fn the_embedded_scene_needs_no_file() {
    let embedded = all().into_iter().find(|path| path.ends_with("default.toml")).unwrap();
    let scene = load(&embedded, &Overrides::default()).unwrap();
    assert!(matches!(scene.volume.source, VolumeSource::Phantom(_)));
}

/// Root mean square difference of two pictures over R, G, B and A, in linear premultiplied light.
fn rms(a: &Picture, b: &Picture) -> f64 {
    let [a, b] = [a, b].map(|picture| picture.layer(LayerKind::Beauty).unwrap().channels.concat());
    (a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64).sqrt()
}

/// Edges that are refined bring a picture at least as near to 36 rays a pixel as four rays everywhere ([RAY-7]), on every
/// scene without lines and halos that needs no file, and on some of real data.
#[test]
fn rays_at_edges_are_no_worse_than_four_rays_everywhere() {
    let real = ["engine.toml", "head.toml", "skull.toml"];
    let mut seen = 0;
    for path in all() {
        let is_real = real.iter().any(|name| path.ends_with(name)) && data().is_some();
        if !is_of_a_phantom(&path) && !is_real {
            continue;
        }
        let with = |samples| {
            let small = [("picture.size", "[96, 80]"), ("picture.samples", samples)];
            Job::load(load(&path, &small.into_iter().collect()).unwrap()).unwrap()
        };
        let job = with("\"auto\"");
        if !job.scene.halos.is_empty() || !job.draws_volume() {
            continue;
        }
        let drawn = |job: &Job| job.renderer().unwrap().frame(&|_| ());
        let (auto, counts) = drawn(&job);
        let [four, truth] = ["2", "6"].map(|samples| drawn(&with(samples)).0);
        let [auto, four] = [auto, four].map(|picture| rms(&picture, &truth));
        let rays = counts.rays as f64 / (96.0 * 80.0);
        println!("{}: {auto:.5} with {rays:.2} rays a pixel, {four:.5} with four", path.display());
        assert!(auto <= four, "{}: {auto} and {four}", path.display());
        seen += 1;
    }
    assert!(seen >= if data().is_some() { 11 } else { 8 }, "{seen}");
}

/// A third of the scenes and those with lines inside: plane by plane to the bits and the counts of ray by ray.
#[test]
fn scenes_are_the_same_plane_by_plane() {
    let (mut compared, mut merged, mut surfaces) = (0, 0, 0);
    for (i, path) in all().into_iter().enumerate() {
        let text = std::fs::read_to_string(&path).unwrap();
        if i % 3 > 0 && !text.contains("\"merged\"") {
            continue;
        }
        if data().is_none() && !is_of_a_phantom(&path) {
            println!("skipped: no data for {}", path.display());
            continue;
        }
        let mut small = vec![("picture.samples", "1")];
        if text.contains("\nwidth = ") {
            small.extend([("picture.width", "40 mm"), ("picture.height", "40 mm"), ("picture.dpi", "30")]);
        } else {
            small.push(("picture.size", "[48, 40]"));
        }
        let job = Job::load(load(&path, &small.into_iter().collect()).unwrap()).unwrap();
        if !job.draws_volume() {
            continue;
        }
        // Only lines inside the volume change what rays meet.
        let marking = text.contains("\"merged\"").then(|| Marking::new(&job, &mut Counts::default(), &|_| ()).unwrap());
        let draw = |planes: bool| match &marking {
            Some(marking) => {
                let renderer = job.renderer().unwrap();
                let renderer = if planes { renderer.plane_by_plane() } else { renderer };
                let frames = Box::new(ReferenceFrames::new(renderer, &job.scene));
                let mut drawing = Drawing::with_frames(&job, marking, Some(frames), &mut Counts::default()).unwrap();
                let (frame, counts) = drawing.frame(0, &|_| ()).unwrap();
                (frame.picture.unwrap(), counts, frame.inside)
            }
            None => {
                let renderer = job.renderer().unwrap();
                let renderer = if planes { renderer.plane_by_plane() } else { renderer };
                let (picture, counts) = renderer.again(&|_| ());
                (picture, counts, 0)
            }
        };
        let [(rays, by_rays, inside), (planes, by_planes, _)] = [false, true].map(draw);
        let bits = |picture: &Picture| {
            let channels = picture.layers.iter().flat_map(|layer| layer.channels.iter().flatten());
            channels.map(|v| v.to_bits()).collect::<Vec<_>>()
        };
        assert!(bits(&rays) == bits(&planes), "{}", path.display());
        let work = |c: &Counts| {
            [c.samples, c.gradients, c.hessians, c.style_lookups, c.without_normal, c.rays, c.rays_skipped]
        };
        assert_eq!(work(&by_rays), work(&by_planes), "{}", path.display());
        compared += 1;
        merged += usize::from(inside > 0);
        surfaces += usize::from(job.scene.surface.is_some());
    }
    println!("{compared} scenes, {merged} with lines inside, {surfaces} with surfaces");
    assert!(data().is_none() || (compared > 25 && merged > 0 && surfaces > 3));
}
