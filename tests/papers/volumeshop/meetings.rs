//! Places where looks of different kinds meet ([VS-4]), and selections between voxels ([VS-2]).

use super::{difference, drawn, pixels, scene_of, seen};

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
