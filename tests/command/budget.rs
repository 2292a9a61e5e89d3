//! The memory budget, threads, and long work: what would end or never end the process is refused, with what would fit.

use crate::folder::Folder;
use drypoint::output::png::write_png;
use drypoint::scene::picture::{Layer, LayerKind, Picture, Provenance};
use std::io::{BufRead, BufReader};
use std::process::Stdio;

/// A white picture of so many pixels a side, whose file is small.
fn white(folder: &Folder, name: &str, side: usize) {
    let picture = Picture {
        width: side,
        height: side,
        layers: vec![Layer { kind: LayerKind::Beauty, channels: vec![vec![1.0; side * side]; 4] }],
    };
    write_png(&picture, 8, &Provenance::default(), &folder.path(name)).unwrap();
}

#[test]
fn decoded_pictures() {
    let folder = Folder::new();
    white(&folder, "white.png", 1000);
    folder.scene("");
    let needs = "a picture of 1000 × 1000 pixels needs 0.05 GiB of memory, and 0.0";
    for line in ["compare white.png white.png", "sheet white.png -o sheet.png"] {
        let said = folder.refused(&format!("{line} --memory 40MiB"));
        assert!(said.starts_with(&format!("error: {needs}")) && said.contains("  at: white.png\n"), "{said}");
        assert!(said.contains(" pixels would fit\n"), "{said}");
    }
    let said = folder.refused("render scene.toml --set picture.background=\"white.png\" --memory 40MiB");
    assert!(said.contains(&format!("white.png: {needs}")), "{said}");
    assert!(said.contains("  at: --set picture.background=\"white.png\", key picture.background\n"), "{said}");
    // What fits is read; comparing it takes more.
    let said = folder.refused("compare white.png white.png --memory 200MiB");
    assert!(said.starts_with("error: a picture of 1000 × 1000 pixels needs 0.38 GiB of memory"), "{said}");
    assert!(folder.good("compare white.png white.png --memory 4GiB").contains("flip"));
}

#[test]
fn pages_in_pixels() {
    let folder = Folder::new();
    folder.torus();
    let said = folder.refused("points torus.nrrd --set picture.dpi=2000 -o a.png --memory 1GiB");
    assert!(said.starts_with("error: a picture of 12598 × 12598 pixels needs 7.10 GiB of memory, and 0.9"), "{said}");
    assert!(said.contains("key picture.dpi\n"), "{said}");
    let dpi: f64 = said.split("try: picture.dpi = ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!((600.0..750.0).contains(&dpi), "{said}");
    // A vector file has no pixels.
    folder.good("points torus.nrrd --set picture.dpi=2000 -o a.svg --memory 1GiB");
}

/// A guard band of 4097 pixels on each side of a picture of 12 × 8.
#[test]
fn images_of_halos() {
    let folder = Folder::new();
    folder.scene("[[halo]]\nspread.passes = 12\n");
    let line = "render scene.toml --set picture.size=[12,8] -o a.png";
    let said = folder.refused(&format!("{line} --memory 1GiB"));
    assert!(said.starts_with("error: the rays and images of halos need "), "{said}");
    assert!(said.contains("key halo\n  try: make the picture narrower"), "{said}");
    folder.good(&format!("{line} --memory 1GiB --set halo.0.spread.passes=5"));
}

#[test]
fn dashes_and_step_wedges() {
    let folder = Folder::new();
    folder.torus();
    let dashes = "hatching.stroke.dash=[\"0.0001mm\",\"0.0001mm\"]";
    let page = "--set picture.width=\"30mm\"";
    let said = folder.refused(&format!("strokes torus.nrrd {page} --set {dashes} -o a.svg --memory 300MiB"));
    assert!(said.starts_with("error: dashes with ") && said.contains(" ends and bends need "), "{said}");
    assert!(said.contains(&format!("  at: --set {dashes}, key hatching.stroke.dash\n")), "{said}");
    assert!(said.contains("  try: make a dash and its gap longer: together 0.00"), "{said}");

    let said = folder.run(["wedge", "--pen", "a", "--set", "pen=[{name=\"a\",width=\"0.001 mm\"}]", "-o", "a.svg"]);
    assert_eq!(said.code, Some(2));
    assert!(
        said.err.starts_with("error: a step wedge of a nib of 0.001 mm needs 520.50 GiB of memory"),
        "{}",
        said.err
    );
    assert!(said.err.contains("  at: pen.width\n  try: take a wider pen: one of "), "{}", said.err);
}

/// Neither a long thin volume nor many rays a pixel take memory of their own.
#[test]
fn what_fits_is_drawn() {
    let folder = Folder::new();
    folder.good("phantom sphere --size 1,1,40000 -o thin.nrrd -q");
    folder.good("strokes thin.nrrd -o thin.svg --memory 1GiB");
    folder.scene("");
    folder.good("render scene.toml --size 1x1 --set picture.samples=1024 --memory 200MiB -o many.exr");
    folder.good("render scene.toml --size 1x1 --set picture.samples=64 -o some.exr");
    // A mean over 256 times as many rays.
    folder.good("compare many.exr some.exr --max 0.001");
}

#[test]
fn volumes_and_phantoms() {
    let folder = Folder::new();
    let said = folder.refused("phantom sphere --size 2000,2000,1000 -o a.nrrd --memory 1GiB");
    assert!(said.starts_with("error: 2000 × 2000 × 1000 voxels need 3.73 GiB of memory, and 0.9"), "{said}");
    folder.good("phantom sphere --size 300 -o a.nrrd -q");
    let said = folder.refused("info a.nrrd --memory 20MiB");
    assert!(said.starts_with("error: 27000000 voxels need 0.03 GiB of memory, and 0.0"), "{said}");
}

#[test]
fn lines_and_lists_without_end() {
    let folder = Folder::new();
    folder.torus();
    let said = folder.line_with("probe torus.nrrd", &"1".repeat(5000));
    let expected =
        "error: the line has 4096 bytes or more, and a point is three numbers\n  at: standard input, line 1\n";
    assert!(said.code == Some(2) && said.err.starts_with(expected), "{}", said.err);
    let said = folder.line_with("probe torus.nrrd", &"word\n".repeat(1000));
    assert_eq!((said.code, said.err.matches("error: \"word\" is no point").count()), (Some(2), 20));
    let said = folder.line_with("probe torus.nrrd --memory 20MiB", &"1,1,1\n".repeat(400_000));
    assert!(said.code == Some(2) && said.err.starts_with("error: its content needs 0."), "{}", said.err);
    folder.write("list.csv", "x,y,wx,wy,wz,radius,opacity\n".to_owned() + &"1,1,0,0,0,1,1\n".repeat(1_000_000));
    let said = folder.refused("points list.csv -o list.svg --memory 20MiB");
    assert!(said.starts_with("error: the picture cannot be read: its content needs 0.0"), "{said}");
    assert!(said.contains("  at: list.csv\n  try: give a smaller file, or allow more with --memory\n"), "{said}");
}

#[test]
fn sizes_of_memory() {
    let folder = Folder::new();
    let said = folder.refused("plan --memory 4");
    assert!(said.contains("a size is a number with MiB or GiB, such as 4GiB"), "{said}");
    folder.good("--memory 4GiB plan");
    folder.good("plan --threads 2");
}

/// Runs a line of words without blanks in a shell that gives so many KiB of address space, and returns exit code and errors.
#[cfg(target_os = "linux")]
fn under(kibibytes: u64, folder: &Folder, line: &str) -> (Option<i32>, String) {
    let words = line.split(' ').map(|word| format!("'{word}'")).collect::<Vec<_>>().join(" ");
    let line = format!("ulimit -v {kibibytes}; exec {} {words}", env!("CARGO_BIN_EXE_drypoint"));
    let said = std::process::Command::new("sh").args(["-c", &line]).current_dir(folder.path("")).output().unwrap();
    (said.status.code(), String::from_utf8(said.stderr).unwrap())
}

/// What does not fit into 4 GB of address space, whatever the system has, is refused and does not abort.
#[cfg(target_os = "linux")]
#[test]
fn four_gigabytes() {
    let folder = Folder::new();
    folder.torus();
    let page = "--set picture.width=\"30mm\" -o a.svg";
    let pen = "--set pen=[{name=\"a\",width=\"0.001mm\"}] --set page.plotter=true --set stipples.pen=\"a\"";
    for (line, begins) in [
        (
            "points torus.nrrd --set picture.dpi=2000 -o a.png".into(),
            "a picture of 12598 × 12598 pixels needs 7.10 GiB",
        ),
        (format!("strokes torus.nrrd --set hatching.stroke.dash=[\"1e-5mm\",\"1e-5mm\"] {page}"), "dashes with "),
        (
            format!(
                "points torus.nrrd --set stipples.k_max=10 {pen} --set picture.dpi=100 --set picture.width=\"80mm\" -o a.svg"
            ),
            "strokes of ",
        ),
        ("phantom sphere --size 3000,2000,1000 -o a.nrrd".into(), "3000 × 2000 × 1000 voxels need 5.59 GiB"),
        ("compare /dev/zero /dev/zero".into(), "the picture cannot be read: its content needs "),
    ] {
        let (code, said) = under(4_000_000, &folder, &line);
        // A slow machine is told of long work first.
        let is_refused = said.lines().any(|line| line.starts_with(&format!("error: {begins}")));
        assert!(code == Some(2) && is_refused, "{line}: {code:?} {said}");
    }
}

/// Threads need memory for their stacks, which a shell can deny.
#[cfg(target_os = "linux")]
#[test]
fn threads_that_cannot_be_started() {
    let folder = Folder::new();
    let (code, err) = under(800_000, &folder, "phantom sphere --size 2000,2000,1000 -o a.nrrd --threads 1000");
    assert_eq!(code, Some(2), "{err}");
    assert!(
        err.starts_with("error: the threads cannot be started: ") && err.contains("  at: --threads 1000\n"),
        "{err}"
    );
}

#[test]
fn what_never_ends() {
    let folder = Folder::new();
    folder.torus();
    let said = folder.run(["render", "torus.nrrd", "--set", "sampling.step=\"1e-9 voxels\"", "-o", "a.png"]);
    assert_eq!(said.code, Some(2));
    assert!(said.err.starts_with("error: the rays have about "), "{}", said.err);
    assert!(said.err.contains("e15 samples, more than 1e14; the picture would take months\n"), "{}", said.err);
    assert!(said.err.contains("  at: --set sampling.step=\"1e-9 voxels\", key sampling.step\n"), "{}", said.err);
    // Each ray alone is too long to be interrupted.
    let said = folder.refused("render torus.nrrd --size 2x2 --set sampling.step=1e-7 -o a.png");
    assert!(said.starts_with("error: the volume is about "), "{said}");
    assert!(said.contains("e8 steps across, and at most 1e7 are drawn\n"), "{said}");
    assert!(said.contains("  at: --set sampling.step=1e-7, key sampling.step\n  try: make it longer\n"), "{said}");
    let said = folder.refused("strokes torus.nrrd --set hatching.min_step=1e-300 -o a.svg");
    assert!(said.starts_with("error: hatching.min_step is below 0.000001 voxels, and a stroke could take "), "{said}");
    assert!(said.contains("key hatching.min_step\n  try: write \"0.000001 voxels\" or more\n"), "{said}");
}

/// The number of strokes follows from their distance, and is told before any is grown.
#[test]
fn lines_as_dense_as_no_pen_draws() {
    let folder = Folder::new();
    folder.torus();
    for (set, key) in [
        ("hatching.spacing=\"1e-4px\"", "spacing"),
        ("hatching.spacing=\"1e-308px\"", "spacing"),
        ("hatching.width=\"1e-4px\"", "width"),
    ] {
        let tone = "strokes torus.nrrd --set hatching.spacing=\"tone\"";
        let line = format!("{tone} --set {set} -o a.svg");
        let said = folder.refused(&line);
        assert!(said.starts_with(&format!("error: hatching.{key} puts lines 8.5e-")), "{said}");
        assert!(said.contains(" strokes on the page, and at most 1e6 are drawn\n"), "{said}");
        assert!(said.contains(&format!("  at: --set {set}, key hatching.{key}\n  try: make the distance ")), "{said}");
        // What the message says is drawn; without seeds in no time.
        let distance = said.split("make the distance ").nth(1).unwrap().split(" mm").next().unwrap();
        let seeds = "--set hatching.seeds=\"curvature\" --set hatching.min_curvature=1 --set hatching.min_gradient=1";
        let set = format!("hatching.{key}=\"{distance}mm\"");
        folder.good(&format!("{tone} --set {set} {seeds} -o a.svg"));
        std::fs::remove_file(folder.path("a.svg")).unwrap();
    }
}

/// A length of which millimetres or pixels are infinite.
#[test]
fn lengths_beyond_every_page() {
    let folder = Folder::new();
    folder.torus();
    for set in ["stipples.size=\"1e308px\"", "outlines.width=\"1e308mm\"", "page.margin=\"1e308px\""] {
        for file in ["a.svg", "a.pdf", "a.csv", "a.png"] {
            let said = folder.refused(&format!("points torus.nrrd --set {set} -o {file}"));
            let key = set.split('=').next().unwrap();
            assert!(said.starts_with(&format!("error: {key} is ")), "{said}");
            assert!(said.contains(&format!("  at: --set {set}, key {key}\n  try: give at most ")), "{said}");
        }
    }
}

/// Every sample in the box of an object is asked.
#[test]
fn objects_without_end() {
    let folder = Folder::new();
    folder.scene("[[object]]\nname = \"big\"\nvalue = [[90, 0], [160, 1]]\nscale = 1e4\n");
    for set in ["object.0.scale=1e4", "object.0.scale=[1,1e5,1]"] {
        let said = folder.refused(&format!("render scene.toml --set {set} -o a.png"));
        assert!(said.starts_with("error: object 0 is about "), "{said}");
        assert!(said.contains(" steps across, and at most 1e5 are drawn\n"), "{said}");
        assert!(said.contains(&format!("  at: --set {set}, key object[0].scale\n  try: scale it less, ")), "{said}");
    }
    folder.good("render scene.toml --size 1x1 --set picture.samples=1 --set object.0.scale=20 -o a.png");
    // An object that no key of its own makes large.
    folder.scene("[[object]]\nname = \"part\"\nvalue = [[90, 0], [160, 1]]\n");
    let said = folder.refused("render scene.toml --size 2x2 --set sampling.step=1e-5 -o b.png");
    assert!(said.starts_with("error: object 0 is about "), "{said}");
    assert!(said.contains("key sampling.step\n  try: make it longer\n"), "{said}");
}

/// The runs of voxels of noise are many.
#[test]
fn the_search_for_content() {
    let folder = Folder::new();
    folder.good("phantom white-noise --size 200 --type u8 -o noise.nrrd -q");
    let said = folder.refused("render noise.nrrd --size 16x16 -o a.png --memory 100MiB");
    assert!(said.starts_with("error: the search for the content of 200 × 200 × 200 voxels needs 0."), "{said}");
    assert!(
        said.contains("  at: noise.nrrd\n  try: read less of the volume with volume.box or volume.stride, "),
        "{said}"
    );
    folder.good("render noise.nrrd --size 16x16 -o a.png --memory 100MiB --set volume.stride=4");
}

/// A picture over two values is in memory as decoded and as colours: 64 bytes a pixel.
#[test]
fn pictures_of_intersections() {
    let folder = Folder::new();
    white(&folder, "meeting.png", 2000);
    folder.scene(
        "[[object]]\nname = \"part\"\nvalue = [[90, 0], [160, 1]]\nmove = [1, 0, 0]\n[[intersection]]\nobject = \
         \"part\"\ncolor = \"meeting.png\"\n",
    );
    let said = folder.refused("render scene.toml -o a.png --memory 250MiB");
    assert!(said.starts_with("error: meeting.png: a picture of 2000 × 2000 pixels needs 0.24 GiB of memory"), "{said}");
    folder.good("render scene.toml -o a.png --memory 2GiB");
}

#[test]
fn long_work_says_how_long() {
    let folder = Folder::new();
    folder.torus();
    let line = ["render", "torus.nrrd", "--size", "2000x2000", "--set", "sampling.step=0.001", "-o", "a.png"];
    let mut child = folder.command(line).stderr(Stdio::piped()).spawn().unwrap();
    let mut lines = BufReader::new(child.stderr.take().unwrap()).lines();
    let said = lines.find(|line| line.as_ref().unwrap().starts_with("rendering: ")).unwrap().unwrap();
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(said.starts_with("rendering: up to ") && said.contains("e10 samples, about "), "{said}");
    assert!(said.ends_with(" in all"), "{said}");
}
