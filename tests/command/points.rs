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
    for name in ["ball.svg", "ball.pdf", "ball.png", "ball.exr", "ball.csv", "ball.jsonl"] {
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
    for (list, again) in [("ball.csv", "again.jsonl"), ("ball.jsonl", "again.csv")] {
        let words = ["points", list, "-o", again].into_iter().chain(page.iter().flat_map(|p| ["--set", *p]));
        let said = folder.run(words);
        assert_eq!(said.code, Some(0), "{}", said.err);
    }
    assert_eq!(text(&folder, "again.csv"), csv);
    assert_eq!(folder.read("again.jsonl"), folder.read("ball.jsonl"));
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

/// A bare volume's page is as high as it is wide where one of the two is said.
#[test]
fn one_length_of_a_page_is_enough_for_a_bare_volume() {
    let folder = Folder::new();
    folder.good("phantom sphere --size 16 -o ball.nrrd -q");
    for (set, [width, height]) in [
        ("", [160, 160]),
        (" --set picture.width=80mm", [80, 80]),
        (" --set picture.height=\"60mm\"", [60, 60]),
        (" --set picture.width=80mm --set picture.height=60mm", [80, 60]),
    ] {
        folder.good(&format!("points ball.nrrd -o ball.svg -q --set stipples.k_max=1e-6{set}"));
        let svg = text(&folder, "ball.svg");
        let size = format!("width=\"{width}mm\" height=\"{height}mm\"");
        assert!(svg.contains(&size), "{set}: {}", &svg[..svg.len().min(400)]);
    }
}

#[test]
fn what_makes_no_page_is_refused() {
    let folder = Folder::new();
    folder.write("ball.toml", SCENE);
    folder.write("plain.toml", "drypoint = 1\n[volume]\nphantom = { name = \"sphere\", size = 8 }\n");
    for (line, want) in [
        ("points ball.toml -o ball.tiff", ".tiff is the suffix of no picture format that is written"),
        ("points plain.toml -o a.svg", "the scene has no stipples"),
        ("points ball.toml -o a.svg --set stipples.pen=red", "there is no pen \"red\""),
        ("points ball.toml -o a.svg --set stipples.color=transfer", "dots take their colours from [transfer]"),
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
    folder.write(
        "ball.toml",
        format!(
            "{SCENE}{pens}[stipples]\npen = \"red\"\nsize = \"0.5 mm\"\n[stipples.curves]\n[outlines]\npen = \"red\"\n"
        ),
    );
    let said = folder.line("points ball.toml -o ball.svg --stats");
    let told = &said.err;
    assert!(told.contains("1-red 0.3: ") && told.contains(" touches, "), "{told}");
    // What is counted is what the plotter draws: dots that it leaves out, and those that it draws as lines, are told.
    let stats: serde_json::Value = serde_json::from_str(&said.out).unwrap();
    let number = |before: &str, after: &str| -> u64 {
        told.split_once(after).unwrap().0.rsplit_once(before).unwrap().1.parse().unwrap()
    };
    let larger = stats["preprocess"]["dots larger than the nib"].as_u64().unwrap();
    let [dots, lines] = [number("ball.svg: ", " dots,"), number(" dots, ", " lines")];
    assert_eq!([&stats["points"], &stats["strokes"]], [dots, lines], "{told}");
    assert!(lines > 0 && number("\n", " dots are left out") > 0 && larger > 0, "{told}");
    assert_eq!(number("0.3: ", " touches"), dots + lines, "{told}");
    let svg = text(&folder, "ball.svg");
    assert!(svg.contains("inkscape:label=\"1-red 0.3\"") && !svg.contains("opacity=\"0."));
    // Nothing but what the pen draws: a background would be a line round the page.
    assert!(!svg.contains("<rect") && !svg.contains("label=\"%"));
    let told = folder.line("points ball.toml -o ball.csv").err;
    assert!(told.contains(" lines are left out: a list has dots alone"), "{told}");
    let csv = text(&folder, "ball.csv");
    assert!(csv.lines().count() > 200);
    assert!(csv.lines().skip(1).all(|line| line.split(',').nth(6) == Some("1")), "{}", &csv[..300]);
}

/// Errors of lists say where, and what a list has no use for is refused.
#[test]
fn lists_that_are_none() {
    let folder = Folder::new();
    folder.write("a.jsonl", "{\"x\": 1, \"y\": 2}\n");
    assert_eq!(
        folder.refused("points a.jsonl -o a.svg"),
        "error: wx is missing, expected a number\n  at: a.jsonl, line 1, column wx\n  try: correct the line, or write the list again\n"
    );
    folder.write("a.csv", "x,y,wx,wy,wz,opacity\n1,2,0,0,0,1\n");
    for verb in ["points", "strokes"] {
        assert_eq!(
            folder.refused(&format!("{verb} a.csv -o a.svg")),
            "error: the column radius is missing\n  at: a.csv, line 1, column radius\n  try: correct the line, or write the list again\n"
        );
    }
    for flag in ["--raw {size=[1,1,1],type=\"u8\"}", "--preset stipple"] {
        let told = folder.refused(&format!("points a.jsonl -o a.svg {flag}"));
        assert!(told.starts_with("error: a list of dots has no use for --"), "{told}");
    }
}

const VOLUME: &str = "[transfer]\nkind = \"regular\"\nnodes = [{ at = 100, color = \"#2040c0\", opacity = 0 }, \
                      { at = 140, color = \"#c04020\", opacity = 0.2 }]\n";

fn counts(folder: &Folder, line: &str) -> serde_json::Value {
    serde_json::from_str(&folder.good(line)).unwrap()
}

/// `render` draws the volume where [transfer] is, and dots over it; `points` draws the dots alone, the same ones, and casts
/// no ray.
#[test]
fn dots_over_the_volume() {
    let folder = Folder::new();
    folder.write("ball.toml", SCENE);
    folder.write("both.toml", format!("{SCENE}{VOLUME}"));
    for name in ["both.svg", "both.pdf", "both.png", "both.exr"] {
        folder.good(&format!("render both.toml -o {name} -q"));
    }
    let both = counts(&folder, "render both.toml -o again.png -q --stats");
    assert!(both["rays"].as_u64() > Some(0) && both["points"].as_u64() > Some(200));
    assert_eq!(folder.read("again.png"), folder.read("both.png"));
    let alone = counts(&folder, "points both.toml -o alone.svg -q --stats");
    assert_eq!(
        (&alone["points"], alone["rays"].as_u64(), alone["samples"].as_u64()),
        (&both["points"], Some(0), Some(0))
    );
    let svg = text(&folder, "both.svg");
    assert!(svg.contains("inkscape:label=\"%picture\"") && svg.find("%picture") < svg.find("1-stipples"));
    // The dots are the same to the byte.
    let dots = |svg: &str| svg[svg.find("id=\"layer1\"").unwrap()..].to_owned();
    assert_eq!(dots(&svg), dots(&text(&folder, "alone.svg")));
    // Without the table the volume is not drawn ([SCN-3]).
    folder.good("render ball.toml -o dots.svg -q");
    assert!(!text(&folder, "dots.svg").contains("%picture"));
    assert_eq!(counts(&folder, "render ball.toml -o dots.png -q --stats")["rays"].as_u64(), Some(0));
    // Where no beauty is asked for there is nothing to draw dots over.
    let depth = counts(&folder, "render both.toml --layers Z -o z.exr -q --stats");
    assert_eq!((depth["points"].as_u64(), depth["preprocess"].get("stipple points")), (Some(0), None));
}

/// A bare volume: what draws dots alone looks for no transfer function beyond what frames the picture.
#[test]
fn a_bare_volume_in_dots() {
    let folder = Folder::new();
    folder.good("phantom sphere --size 24 --type u8 -o ball.nrrd -q");
    let drawn = counts(&folder, "render ball.nrrd --preset stipple -o dots.png -q --stats --size 200x200");
    assert_eq!((drawn["rays"].as_u64(), drawn["gradients"].as_u64()), (Some(0), Some(0)));
    assert!(drawn["points"].as_u64() > Some(100));
    let plan = folder.good("plan ball.nrrd --set preset=stipple --set picture.size=[60,60]");
    assert!(!plan.contains("transfer function") && !plan.contains("contours"), "{plan}");
    assert!(plan.contains("stipple points") && plan.contains("\npoints\n"), "{plan}");
    // A table over the style is an effect beside it.
    let plan = folder.good("plan ball.nrrd --set stipples.k_max=2 --set picture.size=[60,60]");
    assert!(plan.contains("transfer function") && plan.contains("stipple points"), "{plan}");
}

#[test]
fn the_plan_of_stipples_has_what_is_called_for() {
    let folder = Folder::new();
    folder.write(
        "ball.toml",
        SCENE.replace("dpi = 100", "dpi = 100\nsamples = 2").replace("preset = \"stipple\"", "")
            + "[sampling]\nkernel = \"bspline\"\n[stipples]\nk_max = 2.0\n[stipples.boundary]\n",
    );
    let plan = folder.good("plan ball.toml");
    let row = |words: &str| plan.lines().any(|line| line.split_whitespace().collect::<Vec<_>>().join(" ") == words);
    assert!(row("stipples stipple points one order a voxel with points stipples.k_max (line 15)"), "{plan}");
    assert!(row("boundary factor, once one number a voxel with points stipples.boundary (line 16)"), "{plan}");
    for absent in ["rays", "silhouette", "curves", "colours", "coefficients", "brick"] {
        assert!(!plan.contains(absent), "{absent}\n{plan}");
    }
    for idle in ["picture.samples (line 11)", "sampling.kernel (line 13)"] {
        assert!(plan.contains(&format!("  {idle}: the volume itself is not drawn")), "{plan}");
    }
    // The number of points is that of the list.
    let said = plan.lines().skip_while(|line| *line != "points").nth(1).unwrap();
    let stats = counts(&folder, "points ball.toml -o a.svg -q --stats");
    assert!(said.contains(&format!(": {} points, ", stats["preprocess"]["stipple points"])), "{said} {stats}");
}

/// Dots in the colours of a function: with pens a layer a pen, without a layer a colour; the dots are the same.
#[test]
fn colours_of_the_transfer_function() {
    let folder = Folder::new();
    let stipples = "[stipples]\nk_max = 4.0\nink = \"opaque\"\ncolor = \"transfer\"\n";
    let scene = SCENE.replace("preset = \"stipple\"", "");
    let pens = "[[pen]]\nname = \"warm\"\ncolor = \"#b04030\"\n[[pen]]\nname = \"cold\"\ncolor = \"#3040b0\"\n";
    folder.write("plain.toml", format!("{scene}{}", stipples.replace("transfer", "black")));
    folder.write("few.toml", format!("{scene}{VOLUME}{stipples}"));
    folder.write("pens.toml", format!("{scene}{VOLUME}{stipples}{pens}"));
    for name in ["plain", "few", "pens"] {
        folder.good(&format!("points {name}.toml -o {name}.csv -q"));
        folder.good(&format!("points {name}.toml -o {name}.svg -q"));
    }
    let dots = |name: &str| {
        let text = text(&folder, name);
        let place = |row: &str| row.split(',').take(5).collect::<Vec<_>>().join(",");
        let mut rows: Vec<String> = text.lines().skip(1).map(place).collect();
        rows.sort();
        rows
    };
    assert_eq!(dots("few.csv"), dots("plain.csv"));
    let labels = |name: &str| {
        let text = text(&folder, name);
        let parts = text.split("inkscape:label=\"").skip(1).filter(|part| !part.starts_with('%'));
        parts.map(|part| part.split('"').next().unwrap().to_owned()).collect::<Vec<_>>()
    };
    let few = labels("few.svg");
    assert!((2..=16).contains(&few.len()) && few[0].starts_with("1-#"), "{few:?}");
    assert_eq!(labels("pens.svg"), ["1-warm 0.3", "2-cold 0.3"]);
    // Both pens draw: values go from the one colour to the other.
    let pens = text(&folder, "pens.csv");
    assert!(pens.contains(",\"warm\"\n") && pens.contains(",\"cold\"\n"));
    let plan = folder.good("plan few.toml");
    assert!(plan.contains("colours of dots"), "{plan}");
    // Borrowed by dots alone, the function casts no ray.
    assert_eq!(counts(&folder, "points few.toml -o a.svg -q --stats")["rays"].as_u64(), Some(0));
}

/// A row of the function for each label: its dots have its colour, whatever their values.
#[test]
fn colours_of_labels() {
    let folder = Folder::new();
    folder.good("phantom sphere --size 24 --type u8 -o ball.nrrd -q");
    let raw = |r: &str| format!("{{ at = {r}, color = \"{}\", opacity = 0.5 }}", if r == "1" { "red" } else { "blue" });
    // Two labels, left and right of the middle.
    let labels: Vec<u8> = (0..24 * 24 * 24).map(|i| if i % 24 < 12 { 1 } else { 2 }).collect();
    let head = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 24 24 24\nencoding: raw\n\n";
    folder.write("labels.nrrd", [head.as_bytes(), &labels].concat());
    let scene = format!(
        "drypoint = 1\n[volume]\nfile = \"ball.nrrd\"\nlabels = \"labels.nrrd\"\n[picture]\nwidth = \"60 mm\"\nheight = \"40 mm\"\n\
         [camera]\ndirection = [0, 1, 0]\n[transfer]\nkind = \"regular\"\nover = [\"value\", \"label\"]\n\
         rows = [{{ at = 1, nodes = [{}] }}, {{ at = 2, nodes = [{}] }}]\n[stipples]\ncolor = \"label\"\n",
        raw("1"),
        raw("2")
    );
    folder.write("scene.toml", scene);
    folder.good("points scene.toml -o a.csv -q");
    let csv = text(&folder, "a.csv");
    let mut seen = [0, 0];
    for line in csv.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [blue, red] = ["\"#0000ff\"", "\"#ff0000\""].map(|color| cells[7] == color);
        assert!(blue || red, "{line}");
        // A voxel's points stay within it.
        let x: f64 = cells[2].parse().unwrap();
        if (x - 11.5).abs() > 1.0 {
            assert_eq!(red, x < 11.5, "{line}");
        }
        seen[usize::from(red)] += 1;
    }
    assert!(seen.iter().all(|&n| n > 20), "{seen:?}");
}
