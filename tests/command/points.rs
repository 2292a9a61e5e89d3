//! `points`: a page of stipples, and lists of dots ([STIP-16], [IO-7]).

use crate::folder::Folder;

const SCENE: &str = r##"drypoint = 1
preset = "stipple"
[volume]
phantom = { name = "sphere", size = 32, type = "u8" }
[camera]
projection = "orthographic"
[picture]
width = "60 mm"
height = "40 mm"
dpi = 100
"##;

fn text(folder: &Folder, name: &str) -> String {
    String::from_utf8(folder.read(name)).unwrap()
}

#[test]
fn one_page_in_all_formats() {
    let folder = Folder::new();
    folder.write("ball.toml", SCENE);
    for name in ["ball.svg", "ball.pdf", "ball.png", "ball.exr", "ball.csv"] {
        folder.good(&format!("points ball.toml -o {name} -q"));
    }
    let csv = text(&folder, "ball.csv");
    let rows = csv.lines().count() - 1;
    assert!(rows > 200, "{rows}");
    assert_eq!(csv.lines().next(), Some("x,y,wx,wy,wz,radius,opacity"));
    let svg = text(&folder, "ball.svg");
    // Each dot is a stroke of no length.
    assert_eq!(svg.matches("h0").count(), rows);
    assert!(svg.contains("width=\"60mm\" height=\"40mm\" viewBox=\"0 0 60 40\""), "{}", &svg[..400]);
    // A list that was saved is the same page again, to the byte but for its scene.
    let page = ["picture.width=\"60 mm\"", "picture.height=\"40 mm\"", "picture.dpi=100"];
    let words = ["points", "ball.csv", "-o", "again.csv"].into_iter().chain(page.iter().flat_map(|p| ["--set", *p]));
    let said = folder.run(words);
    assert_eq!(said.code, Some(0), "{}", said.err);
    assert_eq!(text(&folder, "again.csv"), csv);
    // The dots are the ball's, and nothing stands outside its outline.
    for line in csv.lines().skip(1) {
        let cells: Vec<f64> = line.split(',').map(|c| c.parse().unwrap()).collect();
        assert!((0.0..=60.0).contains(&cells[0]) && (0.0..=40.0).contains(&cells[1]), "{line}");
    }
}

#[test]
fn the_same_page_twice_and_another_seed() {
    let folder = Folder::new();
    folder.write("ball.toml", SCENE);
    for (name, set) in [("a.csv", ""), ("b.csv", ""), ("c.csv", " --set stipples.seed=2")] {
        folder.good(&format!("points ball.toml -o {name} -q{set}"));
    }
    assert_eq!(folder.read("a.csv"), folder.read("b.csv"));
    assert_ne!(folder.read("a.csv"), folder.read("c.csv"));
}

#[test]
fn what_makes_no_page_is_refused() {
    let folder = Folder::new();
    folder.write("ball.toml", SCENE);
    folder.write("plain.toml", "drypoint = 1\n[volume]\nphantom = { name = \"sphere\", size = 8 }\n");
    for (line, want) in [
        ("points ball.toml -o ball.tiff", "the suffix is that of no format for points"),
        ("points plain.toml -o a.svg", "the scene has no stipples"),
        ("points ball.toml -o a.svg --set stipples.pen=red", "there is no pen \"red\""),
        ("render ball.toml -o a.png", "stipples are not drawn into a rendered picture yet"),
    ] {
        let told = folder.refused(line);
        assert!(told.starts_with(&format!("error: {want}")), "{line}: {told}");
        assert_eq!(told.lines().count(), 3, "{told}");
    }
}

#[test]
fn a_page_without_dots_says_so() {
    let folder = Folder::new();
    folder.write("flat.toml", SCENE.replace("name = \"sphere\", size = 32", "name = \"constant\", size = 8"));
    // However many points a voxel would have.
    assert_eq!(folder.line("points flat.toml -o flat.svg --set stipples.k_max=1e30").code, Some(0));
    let told = folder.line("points flat.toml -o flat.svg").err;
    assert!(told.contains("warning: the page is empty"), "{told}");
}

/// A plotter's page has fewer, opaque dots of the nib's size; the list of it has the same dots, however large, and says which
/// lines it leaves out.
#[test]
fn a_plotter_s_page() {
    let folder = Folder::new();
    let pens =
        "[page]\nmargin = \"5 mm\"\nplotter = true\n[[pen]]\nname = \"red\"\nwidth = \"0.3 mm\"\ncolor = \"red\"\n";
    folder.write("ball.toml", format!("{SCENE}{pens}[stipples]\npen = \"red\"\n[stipples.curves]\n"));
    let told = folder.line("points ball.toml -o ball.svg").err;
    assert!(told.contains("1-red 0.3: ") && told.contains(" touches, "), "{told}");
    let svg = text(&folder, "ball.svg");
    assert!(svg.contains("inkscape:label=\"1-red 0.3\"") && !svg.contains("opacity=\"0."));
    let told = folder.line("points ball.toml -o ball.csv").err;
    assert!(told.contains(" lines are left out: a list has dots alone"), "{told}");
    let csv = text(&folder, "ball.csv");
    assert!(csv.lines().count() > 200);
    assert!(csv.lines().skip(1).all(|line| line.split(',').nth(6) == Some("1")), "{}", &csv[..300]);
}
