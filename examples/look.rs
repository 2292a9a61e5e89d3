//! x
use drypoint::reference::volume_stippling::*;
use drypoint::scene::{counts::Counts, glam::*, marks::*, tables::*, view::View, volume::read};
use std::time::Instant;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let toml = std::fs::read_to_string(&a[1]).unwrap();
    let scene = drypoint::scene::file::parse(
        &toml,
        std::path::Path::new(&a[1]),
        &a[3..].iter().filter_map(|s| s.split_once('=')).collect(),
    )
    .unwrap_or_else(|e| panic!("{e}"));
    let VolumeSource::File { path, .. } = &scene.volume.source else { panic!() };
    let path = if path.exists() {
        path.clone()
    } else {
        std::path::Path::new("/work/shared/data").join(path.file_name().unwrap())
    };
    let volume = read::read(&path, None).unwrap();
    let stipples = scene.stipples.clone().unwrap();
    let view = View::new(&scene.camera, volume.grid(), scene.picture.size).unwrap();
    let near = 0.5;
    let page = Page::in_pixels(scene.picture.size, 0.0, 254.0);
    let size = page.length(stipples.size).unwrap();
    let t = Instant::now();
    let pre = Preprocess::new(Inputs {
        stipples: &stipples,
        table: &scene.volume,
        volume: &volume,
        view: &view,
        near,
        square: 1.0,
    })
    .unwrap();
    println!(
        "area {:.0} m {} each {} points {} in {:.3}s",
        pre.area,
        pre.box_side,
        pre.each,
        pre.len(),
        t.elapsed().as_secs_f64()
    );
    let t = Instant::now();
    let points = pre.points(&mut Counts::default(), &|_| {}).unwrap();
    println!("points {:.3}s", t.elapsed().as_secs_f64());
    let frames = Frames::new(&FrameInputs {
        stipples: &stipples,
        points: &points,
        light: scene.light,
        grid: volume.grid(),
        reference: &view,
        near,
        size,
        nib: None,
    });
    let mut drawn = Drawn::default();
    for _ in 0..3 {
        let t = Instant::now();
        frames.draw(&view, &page, &mut drawn);
        println!("frame {:.1}ms {} dots", 1e3 * t.elapsed().as_secs_f64(), drawn.len());
    }
    let pen = Pen { number: 1, name: "black".into(), width: 0.3, color: [0., 0., 0., 1.] };
    let mut layer = Layer::new(pen);
    layer.dots = drawn.to_vec();
    let mut marks = Marks { page, layers: vec![layer] };
    marks.round();
    let _ = DVec3::ZERO;
    finish(&marks, scene.picture.size, &a[2]);
}
fn finish(m: &Marks, _size: [usize; 2], out: &str) {
    use drypoint::output::{paint, png};
    let mut p = paint::blank(&m.page, Some([1.0; 4])).unwrap();
    paint::paint(m, &paint::Window::page(&m.page), BlendSpace::Srgb, &mut p).unwrap();
    png::write_png(&p, 8, &Default::default(), std::path::Path::new(out)).unwrap();
}
