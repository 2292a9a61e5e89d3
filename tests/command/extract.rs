//! `styles extract`.

use crate::folder::Folder;
use drypoint::output::png::encode_png;
use drypoint::output::read::read_image;
use drypoint::scene::picture::{Layer, LayerKind, Picture, Provenance};
use drypoint::scene::style::Style;

/// A picture of `width` × `height` linear premultiplied pixels.
fn picture(width: usize, height: usize, pixel: impl Fn(usize, usize) -> [f64; 4]) -> Vec<u8> {
    let pixels: Vec<[f64; 4]> = (0..width * height).map(|t| pixel(t % width, t / width)).collect();
    let channels = (0..4).map(|c| pixels.iter().map(|p| p[c]).collect()).collect();
    let picture = Picture { width, height, layers: vec![Layer { kind: LayerKind::Beauty, channels }] };
    encode_png(&picture, 8, &Provenance::default()).unwrap()
}

/// A red disk of radius 20 about (40, 30) on white.
fn disk() -> Vec<u8> {
    picture(80, 60, |x, y| {
        let inside = (x as f64 + 0.5 - 40.0).hypot(y as f64 + 0.5 - 30.0) <= 20.0;
        if inside { [1.0, 0.0, 0.0, 1.0] } else { [1.0; 4] }
    })
}

fn style(folder: &Folder, name: &str) -> Style {
    Style::decode(name, &folder.read(name), false).unwrap()
}

/// The three regions about one disk take the disk, and nothing of what is around it.
#[test]
fn a_disk_is_one_colour_by_every_region() {
    let folder = Folder::new();
    folder.write("art.png", disk());
    let octagon = "60,30 54.1,44.1 40,50 25.9,44.1 20,30 25.9,15.9 40,10 54.1,15.9";
    folder.write("points.csv", format!("x,y\n# round\n{}\n\n", octagon.replace(' ', "\n")));
    for (k, region) in [
        ["--circle", "40,30,20"],
        ["--ellipse", "40,30,20,10,-90"],
        ["--outline", octagon],
        ["--outline", "points.csv"],
    ]
    .into_iter()
    .enumerate()
    {
        let name = format!("{k}.png");
        let said = folder.run(["styles", "extract", "art.png", region[0], region[1], "-o", &name, "--size", "32"]);
        assert_eq!((said.code, said.out.as_str()), (Some(0), ""), "{}", said.err);
        assert!(said.err.starts_with(&format!("{name}\n")), "{}", said.err);
        let style = style(&folder, &name);
        assert_eq!(style.side, 32);
        assert!(style.texels.iter().all(|texel| *texel == [1.0, 0.0, 0.0, 1.0]), "{region:?}");
    }
    assert_eq!(folder.read("2.png"), folder.read("3.png"));
}

/// A scene takes what was extracted, and any square picture as it is, corners and all.
#[test]
fn scenes_take_extracted_styles_and_square_pictures() {
    let folder = Folder::new();
    folder.write("art.png", disk());
    folder.good("-q styles extract art.png --circle 40,30,20 -o ball.png");
    folder.write("matcap.png", picture(50, 50, |_, _| [1.0, 0.0, 0.0, 1.0]));
    let mut seen = Vec::new();
    for file in ["ball.png", "matcap.png"] {
        folder.scene(&format!("[styles]\nwax = \"{file}\"\n"));
        folder.good("-q render scene.toml -o seen.png");
        seen.push(read_image(&folder.path("seen.png")).unwrap());
    }
    assert_eq!(seen[0], seen[1]);
}

#[test]
fn what_the_picture_does_not_show_is_said() {
    let folder = Folder::new();
    folder.write("art.png", disk());
    // A disk whose left half is beyond the edge.
    let said = folder.line("styles extract art.png --circle 0,30,20 -o half.png");
    assert_eq!(said.code, Some(0));
    let line = said.err.lines().nth(1).unwrap();
    assert!(line.starts_with("the picture shows ") && line.ends_with("the others continue what it shows"), "{line}");
    let percent: f64 = line.split(' ').nth(3).unwrap().parse().unwrap();
    assert!((49.0..=51.0).contains(&percent), "{line}");
    assert_eq!(folder.line("-q styles extract art.png --circle 0,30,20 -o half.png").err, "");
}

/// Opacity is kept, and --linear takes numbers as they are.
#[test]
fn opacity_and_linear_light() {
    let folder = Folder::new();
    folder.write("glass.png", picture(40, 40, |_, _| [0.2, 0.1, 0.05, 0.4]));
    folder.good("-q styles extract glass.png --circle 20,20,15 -o glass-style.png --size 16");
    let texel = style(&folder, "glass-style.png").texel(8, 8);
    assert_eq!(texel[3], 102.0 / 255.0);
    // 188 is the code of ½; as linear light it is 188/255 = 0.737, whose code is 1.055 · 0.737^(1/2.4) − 0.055 = 0.874, 223.
    folder.write("grey.png", picture(40, 40, |_, _| [0.5, 0.5, 0.5, 1.0]));
    for (option, code) in [("", 188.0), ("--linear", 223.0)] {
        folder.good(&format!("-q styles extract grey.png --circle 20,20,15 -o g.png --size 16 {option}"));
        let linear = Style::decode("g", &folder.read("g.png"), true).unwrap();
        assert_eq!(linear.texel(8, 8)[0], code / 255.0);
    }
}

#[test]
fn what_cannot_be_is_refused() {
    let folder = Folder::new();
    folder.write("art.png", disk());
    folder.write("text.png", "no picture");
    folder.write("bad.csv", "x,y\n1,2\n3;4\n");
    let extract = |words: &str| folder.refused(&format!("styles extract {words}"));
    for (words, expected) in [
        (
            "art.png --circle 1,2 -o s.png",
            "error: \"1,2\" is no circle\n  at: --circle 1,2\n  try: write x,y,r in pixels, such as 512,340,120\n",
        ),
        (
            "art.png --circle 1,2,nan -o s.png",
            "error: the radius is NaN: it must be a number between -1e7 and 1e7\n  at: --circle 1,2,nan in art.png\n  try: give pixels of the picture, counted from its upper left corner\n",
        ),
        (
            "art.png --circle 1,2,0 -o s.png",
            "error: the radius is 0: it must be above 0\n  at: --circle 1,2,0 in art.png\n  try: give it in pixels of the picture\n",
        ),
        (
            "art.png --circle 200,2,20 -o s.png",
            "error: the region lies outside the picture of 80 × 60 pixels\n  at: --circle 200,2,20 in art.png\n  try: x is counted from the left, y from the top, both in pixels\n",
        ),
        (
            "art.png --circle 40,30,0.2 -o s.png",
            "error: the region holds no pixel of the picture\n  at: --circle 40,30,0.2 in art.png\n  try: give a larger region, or scale the picture up\n",
        ),
        (
            "art.png --ellipse 1,2,3,4 -o s.png",
            "error: \"1,2,3,4\" is no ellipse\n  at: --ellipse 1,2,3,4\n  try: write x,y,a,b in pixels and an angle in degrees, such as 512,340,120,80,30\n",
        ),
        (
            "art.png --ellipse 40,30,3,4,0 --depth -1 -o s.png",
            "error: the depth is -1: it must be above 0\n  at: --ellipse 40,30,3,4,0 in art.png\n  try: give it in pixels of the picture\n",
        ),
        (
            "art.png --outline gone.csv -o s.png",
            "error: the outline cannot be read: No such file or directory (os error 2)\n  at: gone.csv\n  try: write x,y on each line, in pixels, or all points as \"x,y x,y …\"\n",
        ),
        (
            "art.png --outline bad.csv -o s.png",
            "error: \"3;4\" is no point\n  at: bad.csv:3\n  try: write x,y on each line, in pixels, or all points as \"x,y x,y …\"\n",
        ),
        (
            "art.png --outline 1,2 -o s.png",
            "error: an outline of 1 different points encloses nothing\n  at: --outline 1,2 in art.png\n  try: give the points of the outline in their order; 30 make a smooth one\n",
        ),
        (
            "gone.png --circle 1,2,3 -o s.png",
            "error: the picture cannot be read: No such file or directory (os error 2)\n  at: gone.png\n  try: check that the file exists and may be read\n",
        ),
        (
            "art.png --circle 1,2,3 -o s.jpg",
            "error: .jpg is the suffix of no picture format that is written\n  at: s.jpg\n  try: give a name that ends in .png\n",
        ),
    ] {
        assert_eq!(extract(words), expected, "{words}");
    }
    let crossing = folder.run(["styles", "extract", "art.png", "--outline", "0,0 9,9 9,0 0,9", "-o", "s.png"]);
    assert_eq!(crossing.code, Some(2));
    assert!(crossing.err.starts_with(
        "error: the outline crosses itself: the line from point 1 meets the one from point 3\n  at: --outline 0,0 9,9 9,0 0,9 in art.png\n"
    ));
    assert!(extract("text.png --circle 1,2,3 -o s.png").starts_with("error: not a readable PNG, JPEG or OpenEXR: "));
    for words in [
        "art.png -o s.png",
        "art.png --circle 1,2,3 --ellipse 1,2,3,4,5 -o s.png",
        "art.png --circle 40,30,9",
        "art.png --circle 40,30,9 --depth 3 -o s.png",
        "art.png --circle 40,30,9 -o s.png --size 5000",
    ] {
        assert!(extract(words).contains("\n  at: drypoint styles\n"), "{words}");
    }
}
