//! `strokes`: a page of outlines, and lists of strokes ([HATCH-18], [IO-7]).

use crate::folder::Folder;
use serde_json::Value;

const SCENE: &str = r##"drypoint = 1
[volume]
phantom = { name = "sphere", size = 32, type = "u8" }
[camera]
projection = "orthographic"
[picture]
width = "60 mm"
height = "40 mm"
dpi = 100
[outlines]
iso = 127.5
"##;

fn text(folder: &Folder, name: &str) -> String {
    String::from_utf8(folder.read(name)).unwrap()
}

fn counts(folder: &Folder, line: &str) -> Value {
    serde_json::from_str(&folder.good(line)).unwrap()
}

/// The vertices of a list of strokes in CSV: the stroke, then every other number.
fn rows(csv: &str) -> Vec<(usize, Vec<f64>)> {
    let row = |line: &str| {
        let mut cells = line.split(',');
        (cells.next().unwrap().parse().unwrap(), cells.map(|c| c.parse().unwrap()).collect())
    };
    csv.lines().skip(1).map(row).collect()
}

#[test]
fn one_circle_in_all_formats() {
    let folder = Folder::new();
    folder.write("ball.toml", SCENE);
    for name in ["ball.svg", "ball.pdf", "ball.png", "ball.exr", "ball.csv", "ball.jsonl"] {
        folder.good(&format!("strokes ball.toml -o {name} -q"));
    }
    let csv = text(&folder, "ball.csv");
    assert_eq!(csv.lines().next(), Some("stroke,t,x,y,wx,wy,wz,radius,opacity"));
    let rows = rows(&csv);
    assert!(rows.len() > 30 && rows.iter().all(|(stroke, _)| *stroke == 0), "{}", rows.len());
    // Closed: the first vertex comes again. The ball's radius is 0.3 of the box's side of 31, the box's diagonal fills the
    // height of 40 mm, and a place is on a step of 0.001 mm; the field of 8 bits is off by a hundredth of a voxel or so.
    assert_eq!(rows[0].1[1..], rows[rows.len() - 1].1[1..]);
    let mm = 0.3 * 40.0 / 3.0f64.sqrt();
    for (_, row) in &rows {
        let from = (row[1] - 30.0).hypot(row[2] - 20.0);
        assert!((from - mm).abs() < 0.02 * mm, "{from} {mm}");
        assert_eq!(row[6], 0.175);
    }
    // A list that was saved is the same page again, to the byte.
    let page = ["picture.width=\"60 mm\"", "picture.height=\"40 mm\"", "picture.dpi=100"];
    for (list, again) in [("ball.csv", "again.jsonl"), ("ball.jsonl", "again.csv"), ("ball.csv", "again.svg")] {
        let words = ["strokes", list, "-o", again].into_iter().chain(page.iter().flat_map(|p| ["--set", *p]));
        let said = folder.run(words);
        assert_eq!(said.code, Some(0), "{}", said.err);
        assert!(said.err.contains("0 dots, 1 lines"), "{}", said.err);
    }
    assert_eq!(text(&folder, "again.csv"), csv);
    assert_eq!(folder.read("again.jsonl"), folder.read("ball.jsonl"));
    assert!(text(&folder, "ball.svg").contains("inkscape:label=\"1-outlines 0.35\""));
}

/// [HATCH-10]: Béziers are SVG's and PDF's alone, of the same strokes, and outlines of the page are, too.
#[test]
fn beziers_of_a_page() {
    let folder = Folder::new();
    folder.write("ball.toml", format!("{SCENE}[hatching]\niso = 127.5\n"));
    for name in ["a.svg", "a.pdf", "a.png", "a.csv"] {
        folder.good(&format!("strokes ball.toml -o straight-{name} -q"));
        folder.good(&format!("strokes ball.toml -o {name} -q --set hatching.beziers=true"));
    }
    let curves =
        |name: &str| text(&folder, name).lines().filter(|line| line.starts_with("<path") && line.contains('c')).count();
    assert_eq!(curves("straight-a.svg"), 0);
    let page = text(&folder, "a.svg");
    assert_eq!(page.matches("<path").count(), text(&folder, "straight-a.svg").matches("<path").count());
    assert!(curves("a.svg") * 10 > page.matches("<path").count() * 9, "{page}");
    let outlines = &page[page.find("-outlines").unwrap()..];
    assert!(outlines.lines().nth(1).is_some_and(|line| line.contains('c')), "{outlines}");
    assert_eq!(folder.read("a.csv"), folder.read("straight-a.csv"));
    assert!(folder.read("a.pdf") != folder.read("straight-a.pdf"));
}

/// Only what is called for: no rays, no dots; and the count is that of the lines.
#[test]
fn counts_and_plan() {
    let folder = Folder::new();
    folder.write("ball.toml", SCENE);
    let stats = counts(&folder, "strokes ball.toml -o a.svg -q --stats");
    for name in ["rays", "samples", "gradients", "hessians", "points"] {
        assert_eq!(stats[name].as_u64(), Some(0), "{name}");
    }
    assert_eq!(stats["strokes"].as_u64(), Some(1));
    assert!(stats["preprocess"]["outline places"].as_u64().unwrap() > 50, "{stats}");
    let plan = folder.good("plan ball.toml");
    assert!(plan.contains("hidden strokes") && !plan.contains("rays"), "{plan}");
    // Threads change no byte.
    folder.good("render ball.toml -o one.svg -q --threads 1");
    folder.good("render ball.toml -o two.svg -q --threads 2");
    assert_eq!(folder.read("one.svg"), folder.read("two.svg"));
}

/// Dots and outlines on one page, each in its layer; `points` draws both, and `strokes` no dots.
#[test]
fn with_stipples_on_one_page() {
    let folder = Folder::new();
    folder.write("both.toml", format!("{SCENE}[stipples]\nk_max = 0.5\n"));
    folder.good("render both.toml -o both.svg -q");
    folder.good("points both.toml -o dots.svg -q");
    folder.good("strokes both.toml -o lines.svg -q");
    let labels = |name: &str| {
        let svg = text(&folder, name);
        let parts = svg.split("inkscape:label=\"").skip(1).filter(|part| !part.starts_with('%'));
        parts.map(|part| part.split('"').next().unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(labels("both.svg"), ["1-stipples 0.35", "2-outlines 0.35"]);
    assert_eq!(labels("dots.svg"), labels("both.svg"));
    assert_eq!(labels("lines.svg"), ["1-outlines 0.35"]);
    let stats = counts(&folder, "strokes both.toml -o a.csv -q --stats");
    assert_eq!(stats["points"].as_u64(), Some(0));
    assert!(!stats["seconds"].as_object().unwrap().contains_key("points"), "{stats}");
    // One pen for both is one layer.
    let pen = "[page]\nplotter = true\n[[pen]]\nname = \"ink\"\nwidth = \"0.3 mm\"\n";
    let one = SCENE.replace("[outlines]", "[outlines]\npen = \"ink\"");
    folder.write("pen.toml", format!("{one}[stipples]\nk_max = 0.5\npen = \"ink\"\n{pen}"));
    let told = folder.line("render pen.toml -o pen.svg").err;
    assert!(told.contains("1-ink 0.3: ") && told.contains("m drawn"), "{told}");
    assert_eq!(labels("pen.svg"), ["1-ink 0.3"]);
}

/// What `[surface]` says hides, drawn or not: a larger ball around hides all of the smaller.
#[test]
fn another_surface_hides() {
    let folder = Folder::new();
    for (look, lines) in [("none", 0), ("white", 0)] {
        folder.write("ball.toml", format!("{SCENE}[surface]\niso = 20\nlook = \"{look}\"\n"));
        let stats = counts(&folder, "strokes ball.toml -o a.svg -q --stats");
        assert_eq!(stats["strokes"].as_u64(), Some(lines), "{look}");
    }
    // A smaller one inside hides nothing that is on the rim.
    folder.write("ball.toml", format!("{SCENE}[surface]\niso = 200\n"));
    assert_eq!(counts(&folder, "strokes ball.toml -o a.svg -q --stats")["strokes"].as_u64(), Some(1));
    // Over the surface that is drawn.
    assert_eq!(counts(&folder, "render ball.toml -o a.png -q --stats")["strokes"].as_u64(), Some(1));
}

/// A bare volume in outline; a line that is too short is left out.
#[test]
fn a_bare_volume() {
    let folder = Folder::new();
    folder.good("phantom sphere --size 24 --type u8 -o ball.nrrd -q");
    let stats = counts(&folder, "strokes ball.nrrd --preset outline -o a.svg -q --stats");
    assert!(stats["strokes"].as_u64().unwrap() > 0, "{stats}");
    assert!(text(&folder, "a.svg").contains("width=\"160mm\""));
    let told = folder.line("strokes ball.nrrd --preset outline -o a.svg --set outlines.min_length=\"900mm\"").err;
    let why =
        "warning: the page is empty: all that is seen of outlines, 1 lines, is shorter than outlines.min_length\n";
    assert!(told.contains(why), "{told}");
    // A value that the volume does not have is named, with those that it has.
    let told = folder.line("strokes ball.nrrd --preset outline -o a.svg --set outlines.iso=999").err;
    let why = "the page is empty: outlines.iso = 999 is none of the volume's values, which go from 0 to 254";
    assert!(told.contains(why), "{told}");
}

/// What leaves a page of strokes empty is named with its key, as far as the counts tell.
#[test]
fn empty_pages_name_their_cause() {
    let folder = Folder::new();
    let torus = SCENE.replace("sphere", "torus");
    let hatching = "[hatching]\niso = 127.5\nseeds = \"dense\"\n";
    folder.write("lines.toml", &torus);
    folder.write("strokes.toml", torus.replace("[outlines]\niso = 127.5\n", hatching));
    folder.write("both.toml", format!("{torus}{hatching}"));
    let why = |words: &[&str]| {
        let told = folder.run(["strokes", "-o", "a.svg"].iter().chain(words)).err;
        let why = told.lines().find_map(|line| line.strip_prefix("warning: the page is empty: "));
        why.unwrap_or_else(|| panic!("{words:?}: {told}")).to_owned()
    };
    let cases: [(&str, &[&str], &str); 9] = [
        (
            "lines.toml",
            &["camera.eye=[500, 500, 500]", "camera.direction=[1, 0, 0]"],
            "all outlines are hidden, or outside of the frame ([camera])",
        ),
        ("lines.toml", &["outlines.iso=0"], "the surface of outlines.iso = 0 has no outline from this camera"),
        (
            "strokes.toml",
            &["hatching.iso=254"],
            "hatching.iso = 254 is none of the volume's values, which go from 0 to ",
        ),
        (
            "strokes.toml",
            &["hatching.directions.deviation=1e300"],
            "seeds have no direction of which the data are sure: hatching.directions.deviation says how noisy they are",
        ),
        (
            "strokes.toml",
            &["hatching.seeds=curvature", "hatching.min_curvature=1", "hatching.min_gradient=1"],
            "no seed is drawn: hatching.min_curvature and hatching.min_gradient leave cells little chance or none",
        ),
        (
            "strokes.toml",
            &["camera.eye=[500, 500, 500]", "camera.direction=[1, 0, 0]"],
            "seeds is seen: all are hidden (hatching.hidden = \"drawn\" draws them), or outside of the frame ([camera]), \
             or thinner than hatching.stroke.min_width",
        ),
        (
            "strokes.toml",
            &["hatching.stroke.min_width=\"9mm\"", "hatching.hidden=drawn"],
            "seeds is seen: all are outside of the frame ([camera]), or thinner than hatching.stroke.min_width",
        ),
        (
            "strokes.toml",
            &["hatching.spacing=\"900mm\"", "hatching.width=\"30mm\""],
            "or shorter than six widths of the pen",
        ),
        (
            "both.toml",
            &["camera.eye=[500, 500, 500]", "camera.direction=[1, 0, 0]"],
            "thinner than hatching.stroke.min_width; all outlines are hidden, or outside of the frame ([camera])",
        ),
    ];
    for (scene, set, said) in cases {
        let set = set.iter().flat_map(|set| ["--set", *set]);
        let found = why(&std::iter::once(scene).chain(set).collect::<Vec<&str>>());
        assert!(found.contains(said), "{scene}: {found}");
    }
}

/// Every cell of the surface with its p, as a table and as a picture, with or without the strokes.
#[test]
fn the_cells_that_strokes_begin_in() {
    let folder = Folder::new();
    let torus = SCENE.replace("sphere\"", "torus\"").replace("[outlines]", "[hatching]");
    folder.write("ring.toml", torus);
    let stats = counts(&folder, "strokes ring.toml --seeds p.csv -q --stats --set hatching.min_curvature=0");
    let csv = text(&folder, "p.csv");
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("x,y,z,p"));
    let rows: Vec<Vec<f64>> = lines.map(|line| line.split(',').map(|n| n.parse().unwrap()).collect()).collect();
    assert!(rows.len() > 1000 && rows.iter().all(|row| (0.0..=1.0).contains(&row[3])));
    assert!(rows.iter().any(|row| row[3] > 0.3) && stats["preprocess"]["measures of seeds"].as_u64() > Some(1000));
    assert!(rows.windows(2).all(|w| [w[0][2], w[0][1], w[0][0]] < [w[1][2], w[1][1], w[1][0]]));
    // Nothing is grown for it.
    assert_eq!((stats["strokes"].as_u64(), stats["directions"].as_u64()), (Some(0), Some(0)));
    for name in ["p.svg", "p.pdf", "p.png", "p.exr"] {
        folder.good(&format!("strokes ring.toml --seeds {name} -q"));
    }
    assert!(text(&folder, "p.svg").contains("-p 0."));
    let told = folder.line("strokes ring.toml --seeds again.csv -o a.svg --set hatching.seeds=dense").err;
    assert!(told.contains(&format!("again.csv: {0} cells, {0} strokes to be expected", rows.len())), "{told}");
    assert!(folder.read("a.svg").len() > 1000);
    folder.write("ball.toml", SCENE);
    assert!(folder.line("strokes ball.toml --seeds p.csv").err.contains("the scene has no hatching"));
}

/// What has one width is stroked; what is tapered is an outline, filled ([HATCH-21]).
#[test]
fn tapered_strokes_are_outlines() {
    let folder = Folder::new();
    let torus = SCENE.replace("sphere\"", "torus\"").replace("[outlines]", "[hatching]\nseeds = \"dense\"");
    folder.write("ring.toml", torus);
    let svg = |more: &str| {
        folder.good(&format!("strokes ring.toml -o a.svg -q {more}"));
        text(&folder, "a.svg")
    };
    let outlines = |svg: &str| svg.split("<path ").filter(|path| path.contains("z\"/>")).count();
    let tapered = svg("");
    assert!(tapered.contains("<g fill=\"#000000\" stroke=\"none\">") && outlines(&tapered) > 500);
    let even = svg("--set hatching.spacing=tone");
    assert!(!even.contains("stroke=\"none\"") && outlines(&even) == 0);
    let told = folder.line("strokes ring.toml -o a.svg --set page.plotter=true").err;
    assert!(told.contains("lines lose taper, colour or faintness"), "{told}");
    assert!(!text(&folder, "a.svg").contains("stroke=\"none\""));
}

/// Crossing strokes are a layer of their own, drawn by another pen where one is named.
#[test]
fn crossing_strokes_have_a_layer() {
    let folder = Folder::new();
    let torus = SCENE.replace("sphere\"", "torus\"").replace("[outlines]", "[hatching]\nseeds = \"dense\"\ncross = 30");
    let pens =
        "[[pen]]\nname = \"black\"\nwidth = \"0.2 mm\"\n[[pen]]\nname = \"red\"\nwidth = \"0.4 mm\"\ncolor = \"red\"\n";
    folder.write("ring.toml", format!("{torus}{pens}"));
    let labels = |more: &str| {
        folder.good(&format!("strokes ring.toml -o a.svg -q {more}"));
        let svg = text(&folder, "a.svg");
        let labels = svg.split("inkscape:label=\"").skip(1).map(|rest| rest.split('"').next().unwrap().to_owned());
        labels.collect::<Vec<_>>()
    };
    assert_eq!(labels("")[1..], ["1-hatching 0.25", "2-cross 0.25"]);
    assert_eq!(labels("--set hatching.pen=black")[1..], ["1-black 0.2"]);
    assert_eq!(labels("--set hatching.pen=black --set hatching.cross_pen=red")[1..], ["1-black 0.2", "2-red 0.4"]);
    assert_eq!(
        labels("--set hatching.cross_pen=red --set hatching.spacing=tone")[1..],
        ["1-hatching 0.25", "2-red 0.4"]
    );
    let refused = folder.line("strokes ring.toml -o a.svg --set hatching.cross_pen=blue").err;
    assert!(refused.contains("there is no pen \"blue\"") && refused.contains("hatching.cross_pen"), "{refused}");
}

#[test]
fn what_makes_no_page_is_refused() {
    let folder = Folder::new();
    folder.write("ball.toml", SCENE);
    folder.write("plain.toml", "drypoint = 1\n[volume]\nphantom = { name = \"sphere\", size = 8 }\n");
    folder.write("dots.csv", "x,y,wx,wy,wz,radius,opacity\n1,2,0,0,0,0.1,1\n");
    for (line, want) in [
        ("strokes ball.toml -o ball.tiff", ".tiff is the suffix of no picture format that is written"),
        ("strokes plain.toml -o a.svg", "the scene has no strokes"),
        ("points ball.toml -o a.svg", "the scene has no stipples"),
        ("strokes ball.toml -o a.svg --set outlines.pen=red", "there is no pen \"red\""),
        ("strokes ball.toml -o a.svg --set outlines.iso=high", "outlines.iso cannot be \"high\""),
        ("strokes ball.toml -o a.svg --set outlines.width=3", "outlines.width cannot be 3"),
        ("strokes ball.toml -o a.svg --set hatching.chord=1e-9", "hatching.chord is below 0.0001 voxels"),
        ("strokes ball.toml -o a.svg --set hatching.spacing=\"3voxels\"", "hatching.spacing cannot be \"3voxels\""),
        (
            "strokes ball.toml -o a.svg --set hatching.iso=transfer",
            "there is no transfer function that shows where strokes are",
        ),
        (
            "strokes ball.toml -o a.svg --set outlines.min_length=\"2voxels\"",
            "outlines.min_length cannot be \"2voxels\"",
        ),
        ("strokes dots.csv -o a.svg", "the list has dots and no strokes"),
        ("strokes dots.csv -o a.svg --preset outline", "a list of lines has no use for --preset"),
    ] {
        let told = folder.refused(line);
        assert!(told.starts_with(&format!("error: {want}")), "{line}: {told}");
        assert_eq!(told.lines().count(), 3, "{told}");
    }
}

/// [HATCH-14]: strokes that were to be inside a picture are cut off where they are hidden, if there is none: on a page of
/// strokes, for a plotter, and without a volume that is drawn.
#[test]
fn without_a_picture_to_be_inside_strokes_are_cut() {
    let folder = Folder::new();
    let transfer = "[transfer]\nkind = \"regular\"\nnodes = [{ at = -9, color = \"white\", opacity = 0 }, { at = 9, color = \"white\", opacity = 0.1 }]\n";
    let scene = "drypoint = 1\n[volume]\nphantom = { name = \"torus\", size = 28, type = \"f64\" }\n[picture]\nsize = [90, 90]\n\
                 [hatching]\niso = 0\nseeds = \"dense\"\n";
    folder.write("inside.toml", format!("{scene}{transfer}"));
    folder.write("alone.toml", scene);
    for (line, at) in
        [("strokes inside.toml", "a"), ("render inside.toml --set page.plotter=true", "b"), ("render alone.toml", "c")]
    {
        for hidden in ["merged", "cut", "drawn"] {
            folder.good(&format!("{line} --set hatching.hidden={hidden} -o {at}-{hidden}.svg -q"));
        }
        let body = |hidden: &str| {
            let svg = text(&folder, &format!("{at}-{hidden}.svg"));
            // What the file says of its scene, before its first layer with ink, is another.
            svg[svg.find("id=\"layer1\"").unwrap()..].to_owned()
        };
        assert_eq!(body("merged"), body("cut"), "{line}");
        assert!(body("drawn").len() > body("cut").len() * 5 / 4, "{line}");
    }
    let plan = folder.command(["plan", "alone.toml", "--set", "hatching.hidden=merged"]).output().unwrap();
    assert!(String::from_utf8(plan.stdout).unwrap().contains("what is hidden is cut off"));
}
