//! `render` of a volume without a scene.

use crate::folder::Folder;
use drypoint::output::read::read_image;

/// Pixels with α > ½, and the box that they fill: left, right, top, bottom.
fn covered(folder: &Folder, name: &str) -> (usize, [usize; 4]) {
    let image = read_image(&folder.path(name)).unwrap();
    let alpha = image.channel("A").unwrap();
    let (mut n, mut ends) = (0, [usize::MAX, 0, usize::MAX, 0]);
    for (i, _) in alpha.iter().enumerate().filter(|(_, a)| **a > 0.5) {
        let (x, y) = (i % image.width, i / image.width);
        ends = [ends[0].min(x), ends[1].max(x), ends[2].min(y), ends[3].max(y)];
        n += 1;
    }
    (n, ends)
}

#[test]
fn the_content_is_framed_in_a_picture_of_any_shape() {
    let folder = Folder::new();
    folder.torus();
    for [w, h] in [[60, 60], [120, 40], [40, 120]] {
        folder.good(&format!("render torus.nrrd --size {w}x{h} --set picture.background=none -o a.png"));
        let (n, [left, right, top, bottom]) = covered(&folder, "a.png");
        let shorter = w.min(h) as f64;
        let share = ((right - left).max(bottom - top) as f64 + 1.0) / shorter;
        // What automatic pictures keep: 60 … 95 % of the shorter side.
        assert!((0.6..=0.95).contains(&share), "{w}x{h}: {share}");
        assert!(n > w * h / 20, "{w}x{h}: {n} pixels");
    }
}

#[test]
fn overrides_act_on_it_as_on_any_scene() {
    let folder = Folder::new();
    folder.torus();
    let small = "render torus.nrrd --size 24x24";
    folder.good(&format!("{small} -o a.png"));
    folder.good(&format!("{small} --set contours=off -o b.png"));
    assert_ne!(folder.read("a.png"), folder.read("b.png"));
    folder.good(&format!("{small} --preset style -o c.png"));
    assert_eq!(folder.read("a.png"), folder.read("c.png"));
    // Another volume in its place is the one that is drawn.
    folder.good("-q phantom sphere --size 24 --type f64 -o sphere.nrrd");
    folder.good(&format!("{small} --set volume.file=sphere.nrrd --set picture.background=none -o d.png"));
    folder.good(&format!("{small} --set picture.background=none -o e.png"));
    assert_ne!(covered(&folder, "d.png"), covered(&folder, "e.png"));
}

/// Presets in tones draw the outermost surface, framed as ever: opaque, and of few colours inside.
#[test]
fn a_volume_in_tones() {
    let folder = Folder::new();
    folder.torus();
    for (preset, tones) in [("toon", 4), ("hatch-fig2", 3)] {
        let flags = format!("--preset {preset} --size 48x48 --set picture.background=none --set picture.samples=1");
        let counts = folder.good(&format!("render torus.nrrd {flags} -q --stats -o a.png"));
        for none in ["\"hessians\":0", "\"style_lookups\":0", "\"samples\":0"] {
            assert!(counts.contains(none), "{none}: {counts}");
        }
        let (n, [left, right, ..]) = covered(&folder, "a.png");
        assert!(n > 48 * 48 / 10 && right - left > 24, "{n} {left} {right}");
        let image = read_image(&folder.path("a.png")).unwrap();
        let [r, a] = ["R", "A"].map(|name| image.channel(name).unwrap());
        let mut seen: Vec<u64> = r.iter().zip(a).filter(|(_, a)| **a > 0.0).map(|(r, _)| r.to_bits()).collect();
        seen.sort_unstable();
        seen.dedup();
        // Black and the tones, of which a torus shows each.
        assert_eq!(seen.len(), tones, "{preset}");
        let plan = folder.good(&format!("plan torus.nrrd --set preset={preset}"));
        assert!(plan.contains("surface.silhouette") && !plan.contains("without effect"), "{plan}");
    }
}

#[test]
fn another_kind_of_function_gets_nodes_of_its_own() {
    let folder = Folder::new();
    folder.torus();
    folder.good("render torus.nrrd --size 24x24 --set transfer.kind=regular --set picture.background=none -o a.png");
    let (n, _) = covered(&folder, "a.png");
    assert!(n > 24 * 24 / 20, "{n} pixels");
    let plan = folder.good("plan torus.nrrd --set transfer.kind=regular --set shading.ambient=0.2");
    assert!(plan.contains("\nshading ") && !plan.contains("styles"), "{plan}");
}

#[test]
fn faults_do_not_point_at_lines_that_nobody_wrote() {
    let folder = Folder::new();
    folder.torus();
    let plan = folder.good("plan torus.nrrd --set camera.near=1 --set volume.range=[0,1]");
    assert!(!plan.contains("line "), "{plan}");
    assert!(
        plan.ends_with(
            "without effect\n  volume.range (--set): only transfer.unit = \"normalized\" is measured in it\n"
        ),
        "{plan}"
    );
    assert_eq!(
        folder.refused("render torus.nrrd --set sampling.kernl=bspline"),
        "error: [sampling] has no key \"kernl\"\n  at: --set sampling.kernl=bspline, key sampling.kernl\n  try: write \"kernel\"; the keys here are step, step_along, kernel, gradient, hessian, scale, normal, number, skip_empty, stop_below, reference_length\n"
    );
}

#[test]
fn invalid_voxels_are_a_warning_and_a_picture() {
    let folder = Folder::new();
    // A ball of 12³ voxels; two of them NaN and one infinite.
    let mut voxels: Vec<f32> = (0..12 * 12 * 12)
        .map(|i| {
            let d = [i % 12, i / 12 % 12, i / 144].map(|c| (c as f32 - 5.5) * (c as f32 - 5.5));
            6.0 - (d[0] + d[1] + d[2]).sqrt()
        })
        .collect();
    (voxels[700], voxels[800], voxels[900]) = (f32::NAN, f32::INFINITY, f32::NAN);
    let bytes: Vec<u8> = voxels.iter().flat_map(|v| v.to_le_bytes()).collect();
    folder.write("ball.raw", bytes);
    folder.write("ball.raw.toml", "size = [12, 12, 12]\ntype = \"f32\"\n");
    let said = folder.line("render ball.raw --size 24x24 --stats");
    assert_eq!(said.err, "warning: 3 voxels are NaN or infinite: the cells around are transparent\nball.png\n");
    let stats: serde_json::Value = serde_json::from_str(&said.out).unwrap();
    assert!(stats["masked"].as_u64().unwrap() > 0 && stats["bytes"]["mask"].as_u64().unwrap() > 0, "{stats}");
    assert!(read_image(&folder.path("ball.png")).unwrap().channels.iter().flat_map(|c| &c.1).all(|v| v.is_finite()));
    assert!(folder.good("info ball.raw").contains("invalid    3 (NaN or infinite)"));
    assert_eq!(folder.line("-q render ball.raw --size 8x8").err, "", "-q says nothing but errors");
}

#[test]
fn the_plan_tells_what_was_chosen_from_defaults() {
    let folder = Folder::new();
    folder.torus();
    let plan = folder.good("plan torus.nrrd --set contours.fade=off");
    for reason in [
        "transfer (chosen for this volume)",
        "contours.kappa (chosen for this volume)",
        "sampling.hessian (chosen for this volume)",
        "transfer.transparency (default)",
        "picture.samples (default)",
    ] {
        assert!(plan.contains(reason), "{reason}: {plan}");
    }
    assert!(!plan.contains("without effect"), "{plan}");
}

#[test]
fn values_up_to_the_largest_number_give_a_picture() {
    let folder = Folder::new();
    let header = "NRRD0004\ntype: double\ndimension: 3\nsizes: 8 8 8\nendian: little\nencoding: raw\n\n";
    let is_inside = |i: usize| [i % 8, i / 8 % 8, i / 64].iter().all(|x| (2..6).contains(x));
    let values = (0..512).map(|i| if is_inside(i) { 1.7e308f64 } else { -1.7e308 });
    let data: Vec<u8> = header.bytes().chain(values.flat_map(f64::to_le_bytes)).collect();
    std::fs::write(folder.path("huge.nrrd"), data).unwrap();
    let said = folder.line("render huge.nrrd --size 40x40 --set picture.background=none -o huge.png");
    assert_eq!((said.code, said.err.as_str()), (Some(0), "huge.png\n"));
    let (n, _) = covered(&folder, "huge.png");
    assert!(n > 40 * 40 / 20, "{n} pixels");
}

#[test]
fn a_picture_of_nothing_is_told() {
    let folder = Folder::new();
    folder.torus();
    let nothing = |more: &str| folder.line(&format!("render torus.nrrd --size 8x8 {more} -o a.png")).err;
    for background in ["none", "white", "#8040c080"] {
        for space in ["linear", "srgb"] {
            let how = format!("--set picture.background={background:?} --set picture.blend_space={space}");
            let err = nothing(&format!("{how} --set camera.target=[1e6,0,0]"));
            assert!(err.starts_with("warning: nothing is seen: the camera looks past the volume; "), "{err}");
            assert_eq!(nothing(&how), "a.png\n");
        }
    }
    // Each cause by its name.
    let plane = |x: f64, normal: i32| format!("{{point=[{x},0,0],normal=[{normal},0,0]}}");
    for (set, why) in [
        ("transfer.nodes=[{at=1e6,style=\"wax\",opacity=0}]".into(), "no ray meets a value that transfer.nodes show; "),
        ("camera.near=1e6".into(), "all of the volume is nearer than camera.near; "),
        (format!("clip=[{}]", plane(-1.0, 1)), "clip[0] cuts away all that the camera sees of the volume; "),
        (
            format!("clip=[{},{}]", plane(4.0, 1), plane(5.0, -1)),
            "clip[0], clip[1] together cut away all that the camera sees of the volume\n",
        ),
    ] {
        let err = nothing(&format!("--set {set}"));
        assert!(err.starts_with(&format!("warning: nothing is seen: {why}")), "{set}: {err}");
    }
}
