//! `figure`: several scenes on one page.

use crate::folder::Folder;
use drypoint::output::read::{Image, read_image};

fn figure(folder: &Folder, keys: &str, panels: &str) {
    let text = format!("drypoint = 1\n[figure]\ndpi = 254\nletters = \"none\"\ngap = \"0.8 mm\"\n{keys}\n{panels}");
    folder.write("figure.toml", text);
}

/// Whether a part of a figure shows a picture, pixel by pixel.
fn shows(figure: &Image, [left, top]: [usize; 2], picture: &Image) -> bool {
    let [all, own] = [figure, picture].map(|image| image.colors().unwrap().rgb);
    (0..picture.width * picture.height).all(|i| {
        let at = (top + i / picture.width) * figure.width + left + i % picture.width;
        (0..3).all(|c| all[c][at] == own[c][i])
    })
}

/// Ten pixels are a millimetre. Panels of 48 px stand 8 px apart, and each is the picture of its scene in that size.
#[test]
fn panels_are_the_pictures_of_their_scenes() {
    let folder = Folder::new();
    folder.scene("");
    let panel = "[[panel]]\nscene = \"scene.toml\"\n";
    let turned = "set = [\"camera.direction=[1, 0, 0]\"]\n";
    let inset = "[[panel.inset]]\nscene = \"scene.toml\"\nshare = 0.5\ncorner = \"top-left\"\n";
    figure(&folder, "width = \"10.4 mm\"", &format!("{panel}{panel}{turned}{panel}columns = 2\n{inset}"));
    folder.good("figure figure.toml -o page.png");
    let render = |name: &str, size: &str, more: &str| {
        folder.good(&format!("render scene.toml --set picture.dpi=254 --size {size} {more} -o {name}.png"));
        read_image(&folder.path(&format!("{name}.png"))).unwrap()
    };
    let page = read_image(&folder.path("page.png")).unwrap();
    // The scene is 24×16: panels of 48×32, and one of 104×69 with an inset of 52×35, four pixels from its corner.
    assert_eq!([page.width, page.height], [104, 32 + 8 + 69]);
    assert!(shows(&page, [0, 0], &render("a", "48x32", "")));
    assert!(shows(&page, [56, 0], &render("b", "48x32", "--set camera.direction=[1,0,0]")));
    assert!(!shows(&page, [56, 0], &render("a", "48x32", "")));
    let inner = render("inset", "52x35", "");
    let [all, own] = [&page, &inner].map(|image| image.colors().unwrap().rgb[0]);
    // The frame of 0.2 mm covers a pixel on either side of the inset's edge.
    for y in 2..33 {
        for x in 2..50 {
            assert_eq!(all[(40 + 4 + y) * 104 + 4 + x], own[y * 52 + x], "{x} {y}");
        }
    }
    // With the first panel's camera the second one shows its picture.
    folder.good("figure figure.toml --set figure.camera=shared -o shared.png");
    assert!(shows(&read_image(&folder.path("shared.png")).unwrap(), [56, 0], &render("a", "48x32", "")));
    // Pictures as they are.
    figure(&folder, "width = \"4.8 mm\"\ncolumns = 1", "[[panel]]\npicture = \"a.png\"\n");
    folder.good("figure figure.toml -o copy.png");
    let copy = read_image(&folder.path("copy.png")).unwrap();
    assert_eq!([copy.width, copy.height], [48, 32]);
    assert!(shows(&copy, [0, 0], &render("a", "48x32", "")));
}

/// A width in mm is exact on the page, and everything is drawn with the same bytes again.
#[test]
fn a_page_has_its_width_in_every_format() {
    let folder = Folder::new();
    folder.scene("");
    let keys =
        "width = \"180 mm\"\ntitle = \"Two tori\"\ncaption = \"Seen from two sides.\"\n[page]\nmargin = \"10 mm\"";
    figure(&folder, keys, "[[panel]]\nscene = \"scene.toml\"\ncaption = \"front\"\n");
    for name in ["page.svg", "page.pdf", "page.png"] {
        folder.good(&format!("figure figure.toml --set figure.dpi=31 -o {name}"));
        let bytes = folder.read(name);
        folder.good(&format!("figure figure.toml --set figure.dpi=31 -o {name}"));
        assert!(folder.read(name) == bytes, "{name}");
    }
    let svg = String::from_utf8(folder.read("page.svg")).unwrap();
    assert!(svg.contains("width=\"200mm\""), "{}", &svg[..300]);
    for words in ["Two tori", "Seen from two sides.", "front"] {
        assert!(svg.contains(&format!(">{words}<")), "{words}");
    }
}

#[test]
fn faults_of_a_figure_are_told() {
    let folder = Folder::new();
    folder.scene("");
    figure(&folder, "columns = 2", "[[panel]]\n[[panel]]\nscene = \"gone.toml\"\ncolumns = 3\n");
    let said = folder.refused("figure figure.toml -o page.png");
    let wanted = [
        "error: panel[0].scene is missing\n  at: figure.toml:7:1, key panel[0].scene\n  try: write scene = \"head.toml\", or \
         picture = \"head.png\"\n",
        "error: gone.toml is not there\n  at: figure.toml:9:1, key panel[1].scene\n  try: write another path; \
         DRYPOINT_DATA lists no folder with it\n",
        "error: a panel takes 3 columns, and the figure has 2\n  at: figure.toml:10:1, key panel[1].columns\n  try: take \
         fewer, or raise figure.columns\n",
    ];
    assert_eq!(said, wanted.concat());
    // Keys of a scene have their place in the figure.
    figure(&folder, "", "[[panel]]\nscene = \"scene.toml\"\nset = [\"camera.fav=3\"]\n");
    let said = folder.refused("figure figure.toml -o page.png");
    assert!(
        said.starts_with("error: [camera] has no key \"fav\"\n  at: figure.toml:9:1, key panel[0].set, camera.fav=3"),
        "{said}"
    );
    // A figure is no scene, and no input is overwritten.
    let said = folder.refused("render figure.toml");
    assert!(said.starts_with("error: this is a figure of several scenes, and one scene is wanted\n"), "{said}");
    figure(&folder, "", "[[panel]]\npicture = \"a.png\"\n");
    folder.good("render scene.toml -o a.png");
    let said = folder.refused("figure figure.toml -o a.png");
    assert!(said.starts_with("error: this file is read too, and would be overwritten\n"), "{said}");
    let said = folder.refused("figure figure.toml --set figure.dpi=1e6 -o b.png");
    assert!(said.contains("key figure.dpi\n"), "{said}");
}

/// An inset that is higher than its panel is refused with the largest share that fits, in hundredths.
#[test]
fn insets_stay_in_their_panels() {
    let folder = Folder::new();
    folder.scene("");
    let panel = "[[panel]]\nscene = \"scene.toml\"\n";
    // The panel is 120×80 px, and the inset's distance from its edges is 4 px.
    let inset = "[[panel.inset]]\nscene = \"scene.toml\"\nset = [\"picture.size=[8, 16]\"]\nshare = 0.5\n";
    figure(&folder, "width = \"12 mm\"\ncolumns = 1", &format!("{panel}{inset}"));
    assert_eq!(
        folder.refused("figure figure.toml -o page.png"),
        "error: the inset is larger than its panel\n  at: figure.toml:13:1, key panel[0].inset[0].share\n  try: take a \
         share of at most 0.32\n"
    );
    let with = |share: &str| {
        figure(&folder, "width = \"12 mm\"\ncolumns = 1", &format!("{panel}{inset}").replace("0.5", share));
        "figure figure.toml -o page.png"
    };
    folder.good(with("0.32"));
    assert!(folder.refused(with("0.33")).contains("at most 0.32"));
    assert!(folder.refused(with("0")).contains("write a number above 0 and of at most 1"));
    assert!(folder.refused(with("1e-9")).starts_with("error: the inset has less than a pixel\n"));
    // A distance from the edges that leaves no room.
    with("0.32");
    let said = folder.run(["figure", "figure.toml", "-o", "page.png", "--set", "figure.gap=\"1e308 mm\""]);
    let remedy = "  try: take a smaller figure.gap, or a wider figure\n";
    assert!(said.code == Some(2) && said.err.ends_with(remedy), "{}", said.err);
}

/// A size that cannot be drawn is refused at the key that is given.
#[test]
fn a_page_without_columns_or_of_too_many_pixels_is_refused() {
    let folder = Folder::new();
    folder.scene("");
    let panels = "[[panel]]\nscene = \"scene.toml\"\n".repeat(2);
    folder.write("figure.toml", format!("drypoint = 1\n[figure]\ntitle = \"title\"\n{panels}"));
    let refused = |keys: &[&str]| {
        let set = keys.iter().flat_map(|key| ["--set", key]);
        let said = folder.run(["figure", "figure.toml", "-o", "page.png"].into_iter().chain(set));
        assert_eq!(said.code, Some(2), "{keys:?}: {}", said.err);
        said.err
    };
    // Without gaps of 47 px 60 columns of 2126 px have 35 px each.
    for (keys, key) in [
        (&["figure.gap=\"1e308 mm\""][..], "figure.gap"),
        (&["figure.gap=\"180 mm\""], "figure.gap"),
        (&["figure.columns=60", "figure.gap=\"4 mm\""], "figure.gap"),
        (&["figure.columns=60"], "figure.columns"),
        (&["figure.columns=60", "figure.width=\"12 px\""], "figure.width"),
        (&["figure.width=\"1e-300 mm\""], "figure.width"),
        (&["figure.dpi=1e-300"], "figure.dpi"),
    ] {
        let said = refused(keys);
        assert!(said.starts_with("error: a column has fewer than 16 pixels\n"), "{said}");
        assert!(said.contains(&format!(", key {key}\n")), "{keys:?}: {said}");
    }
    for (keys, key) in [
        (&["figure.width=\"1e308 mm\""][..], "figure.width"),
        (&["figure.width=\"200 mm\"", "figure.dpi=1e9"], "figure.dpi"),
        (&["figure.dpi=1e308"], "figure.dpi"),
        (&["figure.dpi=600", "figure.size=\"1e308 mm\""], "figure.size"),
        (&["page.margin=\"1e308 mm\""], "page.margin"),
        (&["figure.columns=1", "figure.gap=\"1e308 mm\""], "figure.gap"),
    ] {
        let said = refused(keys);
        assert!(said.contains(" pixels, and a picture has at most 1073741824\n"), "{said}");
        assert!(said.contains(&format!(", key {key}\n  try: make {key} smaller\n")), "{keys:?}: {said}");
    }
}

/// In a figure a template gets its volume from the panel.
#[test]
fn a_template_in_a_figure_asks_for_the_panels_volume() {
    let folder = Folder::new();
    folder.write("template.toml", "drypoint = 1\n");
    figure(&folder, "", "[[panel]]\nscene = \"template.toml\"\n");
    let said = folder.refused("figure figure.toml -o page.png");
    assert!(said.contains(" or by volume of a figure's panel, or write file = "), "{said}");
}

/// Letters that are missing are told, and a word that is wider than its panel is broken.
#[test]
fn texts_of_a_figure_are_whole_or_told() {
    let folder = Folder::new();
    folder.scene("");
    let panel = "[[panel]]\nscene = \"scene.toml\"\ncaption = \"Donaudampfschifffahrtsgesellschaft \u{732b}\"\n";
    figure(&folder, "width = \"20 mm\"\ncolumns = 1", panel);
    let said = folder.line("figure figure.toml -o page.svg");
    assert_eq!(said.code, Some(0), "{}", said.err);
    let note = "boxes stand for the characters \"\u{732b}\", which the letters lack\n";
    assert!(said.err.contains(note), "{}", said.err);
    let svg = String::from_utf8(folder.read("page.svg")).unwrap();
    let lines: Vec<&str> = svg.split("</text>").filter_map(|text| text.rsplit('>').next()).collect();
    assert!(lines.concat().contains("Donaudampfschifffahrtsgesellschaft"), "{lines:?}");
    assert!(lines.iter().all(|line| !line.contains("Donaudampfschifffahrtsgesellschaft")), "{lines:?}");
}
