//! Places where looks of different kinds meet ([VS-4]), and selections between voxels ([VS-2]).

use super::{difference, drawn, pixels, scene_of, seen};
use drypoint::scene::color::linear_to_srgb;

/// Shells as a style with contours; an object of plain colours that is moved into them, and meets them.
fn scene(layers: &str, look: &str) -> String {
    scene_of(
        "phantom = { name = \"shells\", size = 24 }",
        &format!(
            "layers = [{layers}]\n[transfer]\nnodes = [{{ at = 20, style = \"wax\", opacity = 0 }}, \
             {{ at = 255, style = \"skin\", opacity = 0.1 }}]\n[contours]\nthickness = \"2 voxels\"\n\
             [[object]]\nname = \"a\"\nvalue = [[60, 0], [120, 0.9]]\nmove = [3, -2, 1]\n\
             [object.transfer]\nkind = \"regular\"\nnodes = [{{ at = 20, color = \"#ff8040\", opacity = 0.1 }}, \
             {{ at = 255, color = \"#40c0ff\", opacity = 0.7 }}]\n{look}\
             [[intersection]]\nobject = \"a\"\nwith = \"background\"\n"
        ),
    )
}

/// The set with the larger μ is asked for what the other's look needs, whether or not a layer asks for it, too.
#[test]
fn a_layer_does_not_change_the_beauty() {
    for look in ["", "[object.shading]\n", "[object.shading]\nmodel = \"lighting-function\"\npreset = \"tone\"\n"] {
        let (alone, counts) = drawn(&scene("\"beauty\"", look));
        let (with_layers, _) = drawn(&scene("\"beauty\", \"normal\", \"curvature.KV\", \"gradient\"", look));
        assert_eq!(difference(&alone, &with_layers), 0.0, "{look}");
        assert!(seen(&alone) > 10.0 && counts.gradients > 0);
        // An unshaded object is asked for normals where it meets the style alone.
        let (without, fewer) = drawn(scene("\"beauty\"", look).split("[[intersection]]").next().unwrap());
        assert!(difference(&alone, &without) > 1e-3 && counts.gradients >= fewer.gradients, "{look}");
    }
}

/// A band of values that no voxel has is a shell between voxels.
#[test]
fn values_between_voxels_are_selected() {
    let of = |value: &str| {
        scene_of(
            "phantom = { name = \"shells\", size = 24, type = \"u8\" }",
            &format!(
                "[transfer]\nkind = \"regular\"\nnodes = [{{ at = 0, color = \"#4080c0\", opacity = 0 }}]\n\
                 [[object]]\nname = \"a\"\nvalue = {value}\nmove = [2, 0, 0]\n[object.transfer]\nkind = \"regular\"\n\
                 nodes = [{{ at = 0, color = \"#ff8040\", opacity = 1 }}]\n[object.ghost.transfer]\nkind = \"regular\"\n\
                 nodes = [{{ at = 0, color = \"#ff8040\", opacity = 0 }}]\n"
            ),
        )
    };
    let (between, _) = drawn(&of("[[100.1, 0], [100.2, 1], [100.8, 1], [100.9, 0]]"));
    assert!(seen(&between) > 1.0, "{}", seen(&between));
    let (none, _) = drawn(&of("[[300, 0], [301, 1]]"));
    assert!(pixels(&none).iter().all(|pixel| *pixel == [0.0; 4]));
}

/// An object may be lit by the table of a picture whose own look reads none.
#[test]
fn a_lighting_table_is_read_for_whoever_it_lights() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("table.png");
    let mut encoder = png::Encoder::new(std::fs::File::create(&table).unwrap(), 2, 1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&[40, 0, 0, 40, 200, 0]).unwrap();
    let lit = |path: &str| format!("[shading]\nmodel = \"lighting-function\"\ntable = {path:?}\n");
    let text = scene("\"beauty\"", "");
    let [outer, inner] = ["[[object]]", "[object.transfer]"].map(|before| {
        let shading = lit(&table.display().to_string());
        let shading = if before == "[[object]]" { shading } else { shading.replace("[shading]", "[object.shading]") };
        drawn(&text.replacen(before, &format!("{shading}{before}"), 1)).0
    });
    assert_eq!(difference(&outer, &inner), 0.0);
    assert!(difference(&outer, &drawn(&text).0) > 1e-3);
}

/// Dabs draw what a picture with the same dabs draws: columns are the value at p, rows that at T p.
#[test]
fn dabs_are_painted_on_the_picture_of_both_values() {
    const N: usize = 129;
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, size: usize, pixel: &dyn Fn([f64; 2]) -> [f64; 4]| {
        let path = folder.path().join(name);
        let mut encoder = png::Encoder::new(std::fs::File::create(&path).unwrap(), size as u32, size as u32);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Sixteen);
        let step = 256.0 / (size.max(2) - 1) as f64;
        let numbers = (0..size * size).flat_map(|i| {
            let [r, g, b, a] = pixel([(i % size) as f64 * step, 256.0 - (i / size) as f64 * step]);
            [linear_to_srgb(r), linear_to_srgb(g), linear_to_srgb(b), a].map(|c| (c * 65535.0).round() as u16)
        });
        let bytes: Vec<u8> = numbers.flat_map(u16::to_be_bytes).collect();
        encoder.write_header().unwrap().write_image_data(&bytes).unwrap();
        path.display().to_string()
    };
    let paper = [1.0, 0.0, 0.0, 0.25];
    let plain = write("plain.png", 1, &|_| paper);
    // A green dab of opacity 1 about (60, 120), over paper of opacity ¼.
    let painted = write("painted.png", N, &|[x, y]| {
        let w = (-0.5 * (((x - 60.0) / 30.0).powi(2) + ((y - 120.0) / 50.0).powi(2))).exp();
        let alpha = w + 0.25 * (1.0 - w);
        [0.25 * (1.0 - w) / alpha, w / alpha, 0.0, alpha]
    });
    let of = |color: &str, dabs: &str| {
        let meets = format!("[[intersection]]\nobject = \"a\"\ncolor = {color:?}\n{dabs}");
        let (picture, _) = drawn(&scene_of(
            "phantom = { name = \"shells\", size = 24 }\nrange = [0, 256]",
            &format!(
                "[transfer]\nkind = \"regular\"\nnodes = [{{ at = 0, color = \"#4080c0\", opacity = 0.1 }}]\n\
                 [[object]]\nname = \"a\"\nmove = [3, -2, 1]\n{meets}"
            ),
        ));
        picture
    };
    let dab = |at: &str, width: &str| format!("dabs = [{{ at = {at}, width = {width}, color = \"lime\" }}]\n");
    let expected = of(&painted, "");
    let by_dab = of(&plain, &dab("[60, 120]", "[30, 50]"));
    // Bilinear: h²/8·(1/30² + 1/50²), h = 2, of functions whose curvature is at most 4 times that of the Gaussian.
    let off = difference(&by_dab, &expected);
    println!("{off:e}");
    assert!(off < 0.003, "{off:e}");
    for other in ["", &dab("[120, 60]", "[50, 30]")] {
        assert!(difference(&of(&plain, other), &expected) > 0.03, "{other}");
    }
}
