//! What a wrong scene is told: the wording of each kind of fault, and all of them at once.

use super::*;

#[test]
fn an_unknown_key_names_the_nearest() {
    assert_eq!(
        faults("[camera]\nfvo = 40\n"),
        "[camera] has no key \"fvo\"\n  at scene.toml:5:1, key camera.fvo\n  write \"fov\"; the keys here are projection, \
         fov, height, eye, direction, target, up, near"
    );
    assert_eq!(
        faults("[contour]\n").lines().next(),
        Some("a scene has no key \"contour\""),
        "a table at the top is a key of the scene"
    );
    assert!(faults("[contour]\n").contains("  at scene.toml:4:2, key contour\n  write \"contours\"; "));
    assert!(faults("[sampling]\nzebra = 1\n").contains("\n  the keys here are step, "), "nothing is near");
}

#[test]
fn a_part_that_is_not_built_says_so() {
    assert_eq!(
        faults("[conventions]\nprofile = \"anari\"\n"),
        "[conventions] is not built yet\n  at scene.toml:4:2, key conventions\n  remove it: this version cannot draw it, \
         and would not ignore it"
    );
}

#[test]
fn a_wrong_value_says_what_may_stand_there() {
    for (rest, what, remedy) in [
        ("[camera]\nfov = 180\n", "camera.fov cannot be 180", "write a number above 0 and below 180, in degrees"),
        (
            "[camera]\nfov = \"wide\"\n",
            "camera.fov cannot be \"wide\"",
            "write a number above 0 and below 180, in degrees",
        ),
        ("[camera]\nup = [0, 0, 0]\n", "camera.up cannot be [0, 0, 0]", "write a direction [x, y, z], not all 0"),
        ("[camera]\nup = [0, 1]\n", "camera.up cannot be [0, 1]", "write a direction [x, y, z], not all 0"),
        ("[camera]\neye = [0, inf, 1]\n", "camera.eye[1] cannot be inf", "write a finite number"),
        (
            "[camera]\nnear = 0\n",
            "camera.near cannot be 0",
            "write a length above 0: a number in world units, or such as \"2 voxels\"",
        ),
        (
            "[camera]\nprojection = \"orthographic\"\nheight = \"180 mm\"\n",
            "camera.height cannot be \"180 mm\"",
            "write a length above 0: a number in world units, or such as \"2 voxels\"",
        ),
        (
            "[sampling]\nstep = 0\n",
            "sampling.step cannot be 0",
            "write a length above 0: a number in world units, or such as \"2 voxels\"",
        ),
        (
            "[sampling]\nstep = \"0.5 voxles\"\n",
            "sampling.step cannot be \"0.5 voxles\"",
            "write \"0.5 voxels\"; expected is a length above 0: a number in world units, or such as \"2 voxels\"",
        ),
        (
            "[sampling]\nstep = \"2 px\"\n",
            "sampling.step cannot be \"2 px\"",
            "write a length above 0: a number in world units, or such as \"2 voxels\"",
        ),
        ("[sampling]\nstop_below = 1\n", "sampling.stop_below cannot be 1", "write a number of at least 0 and below 1"),
        (
            "[sampling]\nstop_below = nan\n",
            "sampling.stop_below cannot be NaN",
            "write a number of at least 0 and below 1",
        ),
        ("[sampling]\nskip_empty = 1\n", "sampling.skip_empty cannot be 1", "write true or false"),
        (
            "[sampling]\nkernel = \"trilinaer\"\n",
            "sampling.kernel cannot be \"trilinaer\"",
            "write \"trilinear\"; expected is \"trilinear\", \"bspline\", \"bspline-smooth\", \"bspline5\" or \"catmull-rom\"",
        ),
        ("[sampling]\nnumber = 64\n", "sampling.number cannot be 64", "write \"f64\" or \"f32\""),
        ("[picture]\nbits = 12\n", "picture.bits cannot be 12", "write 8 or 16"),
        ("[picture]\nsamples = 0\n", "picture.samples cannot be 0", "write a whole number from 1 to 1024, or \"auto\""),
        (
            "[picture]\nsamples = 1.5\n",
            "picture.samples cannot be 1.5",
            "write a whole number from 1 to 1024, or \"auto\"",
        ),
        ("[picture]\ndpi = 0\n", "picture.dpi cannot be 0", "write a number above 0"),
        (
            "[picture]\nsize = [100000, 100000]\n",
            "picture.size cannot be [100000, 100000]",
            "write a size [width, height], each a whole number from 1 to 1048576, at most 1073741824 pixels in all",
        ),
        (
            "[picture]\nbackground = \"wite\"\n",
            "picture.background cannot be \"wite\"",
            "write \"white\"; expected is a colour: \"#rrggbb\", \"#rrggbbaa\" or a CSS name such as \"white\", \"none\", \
             or the path of a picture",
        ),
        (
            "[contours]\nfade = [0.5, 0.2]\n",
            "contours.fade cannot be [0.5, 0.2]",
            "write a range [lo, hi], the lower one first",
        ),
        (
            "[contours]\nthickness = -1\n",
            "contours.thickness cannot be -1",
            "write a length of at least 0: a number in world units, or such as \"2 voxels\"",
        ),
        ("[shading]\nshininess = -1\n", "shading.shininess cannot be -1", "write a number of at least 0"),
        (
            "[shading]\ndivisor_floor = 0\n",
            "shading.divisor_floor cannot be 0",
            "write a number above 0 and of at most 1",
        ),
        (
            "[shading]\nmodel = \"lighting-function\"\npreset = \"blinn-fong\"\n",
            "shading.preset cannot be \"blinn-fong\"",
            "write \"blinn-phong\"; expected is \"blinn-phong\", \"blinn-phong-contours\", \
             \"cartoon-contours\", \"metal-contours\", \"gradient\" or \"tone\"",
        ),
        (
            "[shading]\nmodel = \"lighting-function\"\npreset = \"tone\"\ntable = \"t.png\"\n",
            "shading has both preset and table",
            "keep one of them: a preset's table is generated",
        ),
        (
            "[transfer]\ntable = 1\n",
            "transfer.table cannot be 1",
            "write \"exact\" or a whole number from 2 to 16777216",
        ),
        (
            "[transfer]\nnodes = []\n",
            "transfer.nodes cannot be []",
            "write a list of nodes with at least one and at most 100000, each a table with the keys at, style, opacity, color",
        ),
        ("[styles]\nwax = \"\"\n", "styles.wax cannot be \"\"", "write the path of a square picture in quotes"),
        (
            "[styles]\nwax = 3\n",
            "styles.wax cannot be 3",
            "write the path of a square picture in quotes, or { file = \"…\", linear = true }",
        ),
        (
            "[shading]\nlight = \"heda\"\n",
            "shading.light cannot be \"heda\"",
            "write \"head\", a direction [x, y, z] in eye space that is not all 0, or { world = [x, y, z] }",
        ),
        (
            "[[contours]]\n",
            "contours cannot be a list of 1",
            "write a table with the keys thickness, kappa, threshold, sign_flip, fade",
        ),
    ] {
        let text = faults(rest);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 3, "{text}");
        assert_eq!((lines[0], lines[2].trim()), (what, remedy));
        assert!(lines[1].starts_with("  at scene.toml:"), "{text}");
    }
}

#[test]
fn values_of_the_volume() {
    for (line, what) in [
        ("gradient_range = \"q1.5\"", "volume.gradient_range cannot be \"q1.5\""),
        ("gradient_range = [2, 1]", "volume.gradient_range cannot be [2, 1]"),
        ("gradient_range = [nan, 1]", "volume.gradient_range[0] cannot be NaN"),
        ("range = [1, 0]", "volume.range cannot be [1, 0]"),
        ("outside = \"left\"", "volume.outside cannot be \"left\""),
        ("raw = { size = [0, 1, 1], type = \"u8\" }", "volume.raw.size cannot be [0, 1, 1]"),
        ("raw = { size = [1, 1, 1] }", "volume.raw.type is missing"),
        ("raw = { size = [1, 1, 1], type = \"u7\" }", "volume.raw.type cannot be \"u7\""),
        ("raw = { size = [1, 1, 1], type = \"u8\", skip = -1 }", "volume.raw.skip cannot be -1"),
        ("raw = { size = [1, 1, 1], type = \"u8\", spacing = [1, 1, 0] }", "volume.raw.spacing cannot be [1, 1, 0]"),
    ] {
        let text = faults(&format!("{line}\n"));
        assert_eq!(text.lines().next(), Some(what));
        assert!(text.contains("scene.toml:4:"), "{text}");
    }
    for (phantom, what, remedy) in [
        ("{}", "volume.phantom.name is missing", "name = the name of a phantom: sphere, "),
        ("{ name = \"tours\" }", "volume.phantom.name cannot be \"tours\"", "write \"torus\"; "),
        ("{ name = \"torus\", param = { Q = 3 } }", "the phantom \"torus\" has no key \"Q\"", "the keys here are R, r"),
        ("{ name = \"torus\", param = { R = -3 } }", "volume.phantom.param.R cannot be -3", "write a number above 0"),
        ("{ name = \"torus\", param = { R = \"3\" } }", "volume.phantom.param.R cannot be \"3\"", "write a number"),
        ("{ name = \"torus\", param = { R = 3, r = 4 } }", "phantom `torus`: ", "change the parameters: "),
        ("{ name = \"torus\", size = 0 }", "volume.phantom.size cannot be 0", "write a size, a whole number or "),
        ("{ name = \"torus\", size = [4096, 4096, 4096] }", "volume.phantom.size cannot be [4096, ", "write a size, "),
        ("\"torus\"", "volume.phantom cannot be \"torus\"", "write a table with the keys name, size, "),
    ] {
        let text = format!("drypoint = 1\n[volume]\nphantom = {phantom}\n");
        let text = parse(&text, Path::new("s"), &Overrides::default()).unwrap_err().to_string();
        assert!(text.starts_with(what) && text.contains(remedy) && text.lines().count() == 3, "{phantom}\n{text}");
    }
}

#[test]
fn what_must_be_there() {
    let text = |text: &str| parse(text, Path::new("s.toml"), &Overrides::default()).unwrap_err().to_string();
    assert_eq!(
        text(""),
        "drypoint is missing\n  at s.toml:1:1, key drypoint\n  write drypoint = 1, the version of the format that this \
         program reads\nthe scene is a template: it names no volume\n  at s.toml:1:1, key volume\n  name a volume after \
         the scene on the command line or by volume of a figure's panel, or write file = \"…\" or phantom = { name = \"…\" } in [volume]"
    );
    assert_eq!(
        text("drypoint = 2\n[volume]\n"),
        "drypoint cannot be 2\n  at s.toml:1:12, key drypoint\n  write 1, the version of the format that this program \
         reads\nthe scene is a template: it names no volume\n  at s.toml:2:2, key volume.file\n  name a volume after \
         the scene on the command line or by volume of a figure's panel, or write file = \"…\" or phantom = { name = \"…\" } in [volume]"
    );
    assert_eq!(
        faults("[transfer]\nnodes = [{ style = \"wax\" }, { at = 3 }]\n"),
        "transfer.nodes[0].at is missing\n  at scene.toml:5:10, key transfer.nodes[0].at\n  write at = a \
         number, or two numbers [x, y] in a function over two quantities\ntransfer.nodes[1].style is missing\n  at \
         scene.toml:5:29, key transfer.nodes[1].style\n  write style = \"…\", or color = \"#rrggbb\" in a regular \
         function"
    );
}

#[test]
fn a_phantom_that_has_no_grid_names_its_spacing() {
    let text = "drypoint = 1\n[volume]\nphantom = { name = \"torus\", spacing = [1, 1, 1e-20] }\n";
    let faults = parse(text, Path::new("s"), &Overrides::default()).unwrap_err();
    assert_eq!(
        faults.to_string(),
        "voxels of a spacing of [1, 1, 1e-20] are flat, or too small\n  at s:3:29, key volume.phantom.spacing\n  write \
         numbers of which none is 10¹² times another, such as [1, 1, 2]"
    );
}

#[test]
fn what_does_not_go_together() {
    for (rest, what, remedy) in [
        (
            "[camera]\neye = [1, 2, 3]\ntarget = [1, 2, 3.0]\n",
            "camera.eye and camera.target are one point",
            "move one of them, or give camera.direction",
        ),
        (
            "[sampling]\nhessian = \"analytic\"\n",
            "sampling.hessian = \"analytic\" needs a kernel with second derivatives",
            "write kernel = \"bspline\", or hessian = \"central\" or \"gaussian\"",
        ),
        (
            "[picture]\nsize = [8, 8]\nwidth = \"10 mm\"\nheight = \"10 mm\"\n",
            "[picture] has both size and width and height",
            "keep size, or width and height",
        ),
        (
            "[picture]\nwidth = \"9000 mm\"\nheight = \"9000 mm\"\n",
            "picture.width and picture.height make 106299 × 106299 pixels",
            "change width, height or dpi: expected is a size [width, height], each a whole number from 1 to 1048576, at \
             most 1073741824 pixels in all",
        ),
        ("[picture]\nlayers = [\"Z\", \"Z\"]\n", "picture.layers has \"Z\" twice", "leave one of them out"),
        (
            "[picture]\nlayers = [\"curvature.KV\", \"curvature\"]\n",
            "the layers \"curvature.KV\" and \"curvature\" share a channel",
            "leave one of them out",
        ),
        (
            "[transfer]\nkind = \"regular\"\nnodes = [{ at = 1, style = \"wax\" }]\n",
            "a node of a regular function has a style",
            "give it a color, or write kind = \"style\"",
        ),
        (
            "[transfer]\nnodes = [{ at = 1, color = \"red\" }]\n",
            "a node of a style function has a color",
            "give it a style, or write kind = \"regular\"",
        ),
        (
            "[transfer]\nnodes = [{ at = 1, color = \"red\", style = \"wax\" }]\n",
            "a node has both style and color",
            "keep the style in a style function, the color in a regular one",
        ),
        (
            "[transfer]\nnodes = [{ at = 2, style = \"wax\" }, { at = 1, style = \"wax\" }]\n",
            "node 1 at 1 stands after node 0 at 2",
            "put the nodes in non-decreasing order of `at`",
        ),
    ] {
        let text = faults(rest);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!((lines[0], lines[2].trim(), lines.len()), (what, remedy, 3), "{text}");
    }
    let both = "drypoint = 1\n[volume]\nfile = \"a\"\nphantom = { name = \"torus\" }\n";
    let text = parse(both, Path::new("s"), &Overrides::default()).unwrap_err().to_string();
    assert_eq!(text, "[volume] has both phantom and file\n  at s:4:1, key volume.phantom\n  keep phantom or file");
    // Equal values of `at` are a step, and eye = target is none with a direction.
    scene("[transfer]\nnodes = [{ at = 2, style = \"wax\" }, { at = 2, style = \"metal\" }]\n");
    scene("[camera]\neye = [1, 2, 3]\ntarget = [1, 2, 3]\ndirection = [0, 0, 1]\n");
}

#[test]
fn a_style_that_is_not_there_names_the_nearest() {
    let text = faults("[transfer]\nnodes = [{ at = 1, style = \"metall\" }]\n[styles]\nmine = \"m.png\"\n");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[..2], ["there is no style \"metall\"", "  at scene.toml:5:28, key transfer.nodes[0].style"]);
    assert!(lines[2].starts_with("  write \"metal\"; there is ") && lines[2].contains("mine, "), "{text}");
    scene("[transfer]\nnodes = [{ at = 1, style = \"mine\" }]\n[styles]\nmine = \"m.png\"\n");
}

#[test]
fn what_is_no_toml_is_told_with_its_places() {
    let text = faults("[camera]\nfov = \nup = [0, 0, 1\n\n");
    assert!(text.starts_with("not TOML: "), "{text}");
    assert!(text.contains("\n  at scene.toml:5:7\n  correct this line: "), "{text}");
    let twice = faults("[camera]\nfov = 3\nfov = 4\n");
    assert!(twice.contains("duplicate key\n  at scene.toml:6:1\n"), "{twice}");
}

#[test]
fn all_faults_come_at_once_in_the_order_of_the_file() {
    let text = r#"drypoint = 2
presett = "style"
[volume]
file = "a.nrrd"
outside = "hihg"
[camera]
fov = 400
upp = [0, 0, 1]
[[halo]]
every = 0
[transfer]
nodes = [
  { at = 60, style = "wx" },
  { at = 50, stile = "wax", opacity = 1.1 },
  3,
]
[sampling]
step = "2 furlongs"
"#;
    let faults = parse(text, Path::new("s.toml"), &[("picture.bits", "9")].into_iter().collect()).unwrap_err();
    let found: Vec<(Option<usize>, &str)> = faults.iter().map(|f| (f.place.line(), f.key.as_str())).collect();
    assert_eq!(
        found,
        [
            (Some(1), "drypoint"),
            (Some(2), "presett"),
            (Some(5), "volume.outside"),
            (Some(7), "camera.fov"),
            (Some(8), "camera.upp"),
            (Some(10), "halo[0].every"),
            (Some(13), "transfer.nodes[0].style"),
            (Some(14), "transfer.nodes[1].style"),
            (Some(14), "transfer.nodes[1].at"),
            (Some(14), "transfer.nodes[1].stile"),
            (Some(14), "transfer.nodes[1].opacity"),
            (Some(15), "transfer.nodes[2]"),
            (Some(18), "sampling.step"),
            (None, "picture.bits"),
        ]
    );
}
