//! `[orbit]`: a file a frame, and all frames in one.

use crate::folder::{Folder, SCENE};
use std::collections::BTreeMap;

const DOTS: &str = r##"drypoint = 1
[volume]
phantom = { name = "torus", size = 24, type = "u8" }
[orbit]
frames = 4
degrees = 40
[picture]
width = "60 mm"
height = "40 mm"
dpi = 100
[stipples]
k_max = 2.0
[stipples.silhouette]
"##;

fn text(folder: &Folder, name: &str) -> String {
    String::from_utf8(folder.read(name)).unwrap()
}

/// Frame 0 is the picture of the scene without orbit, to the byte; another frame is
/// that of a camera which stands where the orbit says.
#[test]
fn a_volume_goes_round() {
    let folder = Folder::new();
    folder.scene("[contours]\n[camera]\neye = [-30, 9.5, 9.5]\ntarget = [9.5, 9.5, 9.5]\nup = [0, 1, 0]\n");
    folder.good("render scene.toml -o still.exr -q");
    let orbit = "--set orbit.frames=4 --set orbit.degrees=360";
    let told = folder.line(&format!("render scene.toml {orbit} -o turn_##.exr"));
    assert_eq!((told.code, told.err.as_str()), (Some(0), "turn_00.exr … turn_03.exr: 4 frames\n"));
    assert_eq!(folder.read("turn_00.exr"), folder.read("still.exr"));
    // A quarter of a turn to the right, by hand: from the torus's rim to its face.
    folder.good("render scene.toml -o quarter.exr -q --set camera.eye=[9.5,9.5,49]");
    folder.good("compare quarter.exr turn_01.exr --max 1e-9");
    assert_eq!(folder.line("compare turn_00.exr turn_01.exr --max 0.01").code, Some(1));
    // A name that nobody gave gets numbers.
    folder.good(&format!("render scene.toml {orbit} -q"));
    assert!(folder.path("scene_003.png").exists());
}

#[test]
fn stats_are_those_of_all_frames() {
    let folder = Folder::new();
    folder.scene("");
    let counts = |line: &str| -> serde_json::Value { serde_json::from_str(&folder.good(line)).unwrap() };
    let one = counts("render scene.toml -o a.png -q --stats");
    // A full turn each: every frame is the same.
    let all = counts("render scene.toml -o a_#.png -q --stats --set orbit.frames=3 --set orbit.degrees=1080");
    for key in ["samples", "rays", "gradients"] {
        assert_eq!(all[key].as_u64(), one[key].as_u64().map(|n| 3 * n), "{key}");
    }
    assert_eq!((&all["bytes"], &all["preprocess"]), (&one["bytes"], &one["preprocess"]));
}

/// No point moves in object space: those that two frames draw are the same numbers, with other places on the page.
#[test]
fn dots_go_round() {
    let folder = Folder::new();
    folder.write("torus.toml", DOTS);
    folder.good("points torus.toml -o turn_#.csv -q");
    folder.good("points torus.toml -o still.csv -q --set orbit=off");
    assert_eq!(folder.read("turn_0.csv"), folder.read("still.csv"));
    let frames: Vec<BTreeMap<String, String>> = (0..4)
        .map(|i| {
            let csv = text(&folder, &format!("turn_{i}.csv"));
            let row = |line: &str| {
                let cells: Vec<&str> = line.split(',').collect();
                (cells[2..5].join(","), cells[..2].join(","))
            };
            csv.lines().skip(1).map(row).collect()
        })
        .collect();
    for pair in frames.windows(2) {
        let both: Vec<_> = pair[0].iter().filter_map(|(point, at)| Some((at, pair[1].get(point)?))).collect();
        assert!(both.len() > pair[0].len() / 2, "{} of {}", both.len(), pair[0].len());
        assert!(both.iter().filter(|(a, b)| a != b).count() > both.len() / 2);
    }
    let keys = |i: usize| frames[i].keys().collect::<Vec<_>>();
    assert_ne!(keys(0), keys(3));
}

/// One SVG with all frames: what does not move shows the first.
#[test]
fn an_animated_svg() {
    let folder = Folder::new();
    folder.write("torus.toml", DOTS);
    folder.good("points torus.toml -o all.svg -q");
    folder.good("points torus.toml -o turn_#.svg -q");
    let all = text(&folder, "all.svg");
    let dots = |svg: &str| svg.matches("h0").count();
    assert_eq!(dots(&all), (0..4).map(|i| dots(&text(&folder, &format!("turn_{i}.svg")))).sum::<usize>());
    assert_eq!((all.matches(" display=\"none\">").count(), all.matches("<animate ").count()), (3, 4));
    let shown = |name: &str| {
        let mut command = std::process::Command::new("rsvg-convert");
        let made = command.args(["-b", "white", "-o", &format!("{name}.png"), &format!("{name}.svg")]);
        made.current_dir(folder.path("")).status().is_ok_and(|status| status.success())
    };
    if !shown("all") || !shown("turn_0") {
        println!("skipped: no rsvg-convert (Debian package librsvg2-bin)");
        return;
    }
    assert_eq!(folder.read("all.png"), folder.read("turn_0.png"));
}

/// Frames of an APNG file: delay, and RGBA codes.
fn apng_frames(bytes: &[u8]) -> Vec<([u16; 2], Vec<u8>)> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let frames = reader.info().animation_control.map_or(1, |control| control.num_frames);
    (0..frames)
        .map(|_| {
            let mut data = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut data).unwrap();
            let delay = reader.info().frame_control.map_or([0; 2], |control| [control.delay_num, control.delay_den]);
            (delay, data)
        })
        .collect()
}

/// Frames of a GIF file: delay in hundredths of a second, and RGBA codes.
fn gif_frames(bytes: &[u8]) -> Vec<(u16, Vec<u8>)> {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(bytes).unwrap();
    std::iter::from_fn(|| decoder.read_next_frame().unwrap().map(|frame| (frame.delay, frame.buffer.to_vec())))
        .collect()
}

/// An APNG has the pixels of the frames' own PNG, and a GIF colours near them.
#[test]
fn all_frames_in_one_file() {
    let folder = Folder::new();
    folder.scene("[orbit]\nframes = 3\nfps = 25\n");
    let told = folder.line("render scene.toml -o turn.apng");
    assert_eq!((told.code, told.err.as_str()), (Some(0), "turn.apng: 3 frames\n"));
    folder.good("render scene.toml -o turn.gif -q");
    folder.good("render scene.toml -o turn_#.png -q");
    let apng = apng_frames(&folder.read("turn.apng"));
    let gif = gif_frames(&folder.read("turn.gif"));
    assert_eq!((apng.len(), gif.len()), (3, 3));
    for i in 0..3 {
        let png = apng_frames(&folder.read(&format!("turn_{i}.png"))).remove(0).1;
        assert_eq!(apng[i], ([1, 25], png.clone()));
        assert_eq!(gif[i].0, 4);
        let largest = gif[i].1.iter().zip(&png).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(largest <= Some(24), "{largest:?}");
    }
    assert_ne!(apng[0].1, apng[1].1);
    // A still picture of programs without animation.
    folder.good("compare turn_0.png turn.apng --max 0");
    // 16 bits and transparency stay in an APNG.
    let settings = "--set picture.bits=16 --set picture.background=none";
    folder.good(&format!("render scene.toml {settings} -o deep.apng -q"));
    folder.good(&format!("render scene.toml {settings} -o deep_#.png -q"));
    let deep = apng_frames(&folder.read("deep.apng"));
    assert_eq!(deep[2].1, apng_frames(&folder.read("deep_2.png")).remove(0).1);
}

/// Dots on a page, with its margin, and dots over a volume.
#[test]
fn dots_in_one_file() {
    let folder = Folder::new();
    folder.write("torus.toml", DOTS);
    for (verb, more) in [("points", ""), ("render", "--set transfer.kind=regular")] {
        folder.good(&format!("{verb} torus.toml -o all.apng -q {more}"));
        folder.good(&format!("{verb} torus.toml -o one_#.png -q {more}"));
        let frames = apng_frames(&folder.read("all.apng"));
        assert_eq!(frames.len(), 4);
        for (i, (_, codes)) in frames.iter().enumerate() {
            assert_eq!(*codes, apng_frames(&folder.read(&format!("one_{i}.png"))).remove(0).1, "{verb} {i}");
        }
    }
    // The time of an SVG is that of the same key.
    folder.good("points torus.toml -o all.svg -q --set orbit.fps=20");
    assert!(text(&folder, "all.svg").contains("dur=\"0.2s\""));
}

#[test]
fn names_that_do_not_fit_are_refused_before_anything_is_drawn() {
    let folder = Folder::new();
    folder.write("torus.toml", DOTS);
    folder.write("scene.toml", SCENE);
    for (line, wanted) in [
        (
            "points torus.toml -o turn.png",
            "error: [orbit] has 4 frames, and the name has no ### for their numbers\n  at: turn.png\n  try: write turn_###.png\n",
        ),
        (
            "render torus.toml -o turn_#.png --set orbit.frames=11",
            "error: # has 1 of the 2 digits of frame 10\n  at: turn_#.png\n  try: write more #\n",
        ),
        (
            "render scene.toml -o turn.svg --set orbit.frames=4",
            "error: .svg is for points, lines and annotations, and the scene has none\n  at: turn.svg\n  try: give a name that ends in .png or .exr\n",
        ),
        (
            "render scene.toml -o turn.gif",
            "error: .gif is for the frames of [orbit], and the scene has no such table\n  at: turn.gif\n  try: add --set orbit.frames=36, or give a name that ends in .png\n",
        ),
        (
            "points torus.toml -o turn_#.apng",
            "error: .apng has all frames in one file\n  at: turn_#.apng\n  try: give a name without #\n",
        ),
        (
            "sheet scene.toml -o sheet.gif",
            "error: .gif is for the frames of [orbit], and this is one picture\n  at: sheet.gif\n  try: give a name that ends in .png\n",
        ),
        (
            "sheet scene.toml -o sheet_#.png",
            "error: a # stands for the number of a frame, and this picture has one\n  at: sheet_#.png\n  try: give a name without #\n",
        ),
    ] {
        assert_eq!(folder.refused(line), wanted);
    }
}

/// Frames and scenes of dots are shown on a sheet.
#[test]
fn a_contact_sheet_of_frames() {
    let folder = Folder::new();
    folder.write("torus.toml", DOTS);
    folder.good("points torus.toml -o turn_#.png -q");
    folder.good("sheet turn_0.png turn_1.png turn_2.png turn_3.png -o frames.png -q");
    folder.good("sheet torus.toml -o one.png -q");
    assert!(folder.read("one.png").len() > 2000);
}
