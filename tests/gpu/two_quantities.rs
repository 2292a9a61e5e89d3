//! Transfer functions over two quantities ([STF-4]) and labels ([STF-13]): shaders in f64 equal the reference to 10⁻⁹.

use crate::double::agrees;
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::space::Grid;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

/// A torus over two quantities, of colours or of styles.
pub(crate) fn torus(volume: &str, transfer: &str, tables: &str) -> String {
    format!(
        "drypoint = 1
[volume]
phantom = {{ name = \"torus\", size = 32 }}
{volume}
[picture]
size = [64, 48]
samples = 1
background = \"#203040\"
[camera]
eye = [71.3, 52.1, 33.7]
target = [15.6, 15.4, 15.3]
[transfer]
{transfer}
{tables}"
    )
}

/// Rows of styles: two or three nodes over values, at three places of the second quantity.
pub(crate) fn styles(places: [f64; 3]) -> String {
    let [a, b, c] = places;
    format!(
        "rows = [
  {{ at = {a}, nodes = [{{ at = 100, style = \"wax\", opacity = 0 }}, {{ at = 128, style = \"glass\", opacity = 0.4 }}] }},
  {{ at = {b}, nodes = [{{ at = 90, style = \"bone\", opacity = 0 }}, {{ at = 120, style = \"wax\", opacity = 0.5 }},
                        {{ at = 140, style = \"ink\", opacity = 0.9 }}] }},
  {{ at = {c}, nodes = [{{ at = 110, style = \"metal\", opacity = 0.2 }}] }},
]"
    )
}

/// Rows of colours.
fn colors(places: [f64; 3]) -> String {
    let [a, b, c] = places;
    format!(
        "kind = \"regular\"
rows = [
  {{ at = {a}, nodes = [{{ at = 100, color = \"#804020\", opacity = 0 }}, {{ at = 128, color = \"#ffcc88\", opacity = 0.4 }}] }},
  {{ at = {b}, nodes = [{{ at = 90, color = \"#3366cc\", opacity = 0 }}, {{ at = 120, color = \"#88ccff\", opacity = 0.5 }}] }},
  {{ at = {c}, nodes = [{{ at = 110, color = \"#ffffff\", opacity = 0.2 }}] }},
]"
    )
}

const CUT: &str = "[contours]\n[[clip]]\npoint = [20, 18, 16]\nnormal = [1, 0.7, 0.4]\nspace = \"index\"\n";

#[test]
fn gradients_and_curvatures() {
    for (name, over, transfer, tables) in [
        ("gradients", "\"gradient-magnitude\"", styles([2.0, 10.0, 20.0]), ""),
        ("printed", "\"gradient-magnitude\"", format!("mix = \"printed\"\n{}", styles([2.0, 10.0, 20.0])), ""),
        ("colours", "\"gradient-magnitude\"", colors([2.0, 10.0, 20.0]), ""),
        ("phong", "\"gradient-magnitude\"", colors([2.0, 10.0, 20.0]), "[shading]\n"),
        ("along the view", "\"kv\"", styles([0.02, 0.1, 0.3]), "[contours]\n"),
        // On a cut there is no curvature.
        ("a cut", "\"kv\"", styles([0.0, 0.1, 0.3]), CUT),
        ("mip-maps", "\"kv\"", styles([0.02, 0.1, 0.3]), "[style_mipmaps]\n"),
    ] {
        agrees(name, &torus("", &format!("over = [\"value\", {over}]\n{transfer}"), tables));
    }
}

/// |g|, whose unit holds for values too.
#[test]
fn normalized_magnitudes() {
    let rows = "unit = \"normalized\"
rows = [
  { at = 0.1, nodes = [{ at = 0.4, style = \"wax\", opacity = 0 }, { at = 0.6, style = \"glass\", opacity = 0.4 }] },
  { at = 0.8, nodes = [{ at = 0.5, style = \"bone\", opacity = 0.3 }] },
]";
    agrees("|g|", &torus("", &format!("over = [\"value\", \"gradient-magnitude\"]\n{rows}"), ""));
}

#[test]
fn distances_to_points() {
    let rows = styles([4.0, 11.0, 17.0]);
    let over = "over = [\"value\", { distance = [20.5, 9.25, 14.75] }]";
    agrees("a point", &torus("", &format!("{over}\n{rows}"), ""));
    // From row to row the value; along a row the distance.
    let rows = "rows = [
  { at = 110, nodes = [{ at = 3, style = \"wax\", opacity = 0 }, { at = 9, style = \"glass\", opacity = 0.4 }] },
  { at = 130, nodes = [{ at = 6, style = \"bone\", opacity = 0.6 }] },
]";
    let over = "over = [{ distance = [20.5, 9.25, 14.75] }, \"value\"]";
    agrees("values from row to row", &torus("", &format!("{over}\n{rows}"), ""));
    let over = "over = [{ distance = [20.5, 9.25, 14.75] }, { distance = [3.5, 20.25, 12.75] }]";
    let rows = rows.replace("at = 110", "at = 4").replace("at = 130", "at = 15");
    agrees("two points", &torus("", &format!("{over}\n{rows}"), ""));
}

/// Ids in blocks on a grid, as a file; ids up to `most`.
pub(crate) fn labels(name: &str, grid: &Grid, voxel_type: &str, most: u32) -> PathBuf {
    let [nx, ny, nz] = grid.dims();
    let (axes, origin) = (grid.axes(), grid.origin());
    let vector = |v: DVec3| format!("({},{},{})", v.x, v.y, v.z);
    let mut text = format!(
        "NRRD0005\ntype: {voxel_type}\ndimension: 3\nspace dimension: 3\nsizes: {nx} {ny} {nz}\nencoding: ascii\n\
         space directions: {} {} {}\nspace origin: {}\n\n",
        vector(axes.x_axis),
        vector(axes.y_axis),
        vector(axes.z_axis),
        vector(origin)
    );
    for i in 0..grid.len() {
        let [x, y, z] = [i % nx, i / nx % ny, i / nx / ny];
        let id = [1, 2, most, 5][(x / 5 + y / 7 + 2 * (z / 3)) % 4];
        let _ = writeln!(text, "{id}");
    }
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("gpu-labels-{name}.nrrd"));
    fs::write(&path, text).unwrap();
    path
}

/// Labels along rows of values; a row without a label, and labels without a row.
pub(crate) const ALONG: &str = "rows = [
  { at = 105, nodes = [{ at = 1, style = \"wax\", opacity = 0.05 }, { at = 5, style = \"glass\", opacity = 0.4 }] },
  { at = 135, nodes = [{ at = 2, style = \"bone\", opacity = 0.3 }, { at = 5, style = \"ink\", opacity = 0.9 }] },
]";

#[test]
fn labels_of_samples() {
    let same = Grid::with_spacing([32; 3], [1.0; 3]).unwrap();
    let turned = DMat3::from_rotation_z(0.3) * DMat3::from_diagonal(DVec3::new(1.7, 1.3, 1.9));
    let other = Grid::new([17, 21, 14], turned, DVec3::new(8.3, 0.4, 2.1)).unwrap();
    for (name, grid, voxel_type, most, lookup) in [
        ("nearest", &same, "uint8", 200, "nearest"),
        ("smooth", &same, "uint16", 60_000, "smooth"),
        ("other-nearest", &other, "uint32", 4_000_000_000, "nearest"),
        ("other-smooth", &other, "uint8", 77, "smooth"),
    ] {
        let path = labels(name, grid, voxel_type, most);
        let volume = format!("labels = {path:?}\nlabel_lookup = \"{lookup}\"");
        for (kind, rows) in
            [("styles", styles([1.0, 2.0, f64::from(most)])), ("colours", colors([1.0, 5.0, f64::from(most)]))]
        {
            let transfer = format!("over = [\"value\", \"label\"]\n{rows}");
            agrees(&format!("{name}, {kind}"), &torus(&volume, &transfer, ""));
        }
        agrees(&format!("{name}, along rows"), &torus(&volume, &format!("over = [\"label\", \"value\"]\n{ALONG}"), ""));
    }
}

#[test]
fn distances_to_labels() {
    let grid = Grid::with_spacing([32; 3], [1.0; 3]).unwrap();
    let path = labels("distance", &grid, "uint8", 9);
    let volume = format!("labels = {path:?}");
    for (name, over, rows) in [
        ("a label", "[\"value\", { distance_to_label = 9 }]", styles([0.3, 2.5, 4.0])),
        ("two labels", "[{ distance_to_label = 2 }, { distance_to_label = 9 }]", LOW.into()),
    ] {
        agrees(name, &torus(&volume, &format!("over = {over}\n{rows}"), ""));
    }
}

/// Rows of small numbers along both axes.
pub(crate) const LOW: &str = "rows = [
  { at = 0.5, nodes = [{ at = 0.2, style = \"wax\", opacity = 0.05 }, { at = 3, style = \"glass\", opacity = 0.4 }] },
  { at = 2.5, nodes = [{ at = 1, style = \"bone\", opacity = 0.1 }] },
]";

#[test]
fn further_volumes() {
    let same = Grid::with_spacing([32; 3], [1.0; 3]).unwrap();
    let turned = DMat3::from_rotation_x(0.4) * DMat3::from_diagonal(DVec3::new(1.7, 1.3, 1.9));
    let other = Grid::new([12, 15, 11], turned, DVec3::new(5.3, 6.4, 2.1)).unwrap();
    let flat =
        Grid::new([40, 40, 1], DMat3::from_diagonal(DVec3::new(0.7, 0.7, 9.0)), DVec3::new(1.0, 2.0, 15.0)).unwrap();
    for (name, grid) in [("same", &same), ("other", &other), ("flat", &flat)] {
        let path = labels(&format!("further-{name}"), grid, "int16", 120);
        let over = format!("over = [\"value\", {{ volume = {path:?} }}]");
        agrees(name, &torus("", &format!("{over}\n{}", styles([1.5, 4.0, 60.0])), ""));
    }
    let paths = ["same", "other"]
        .map(|name| labels(&format!("further-{name}"), if name == "same" { &same } else { &other }, "int16", 120));
    let over = format!("over = [{{ volume = {:?} }}, {{ volume = {:?} }}]", paths[0], paths[1]);
    agrees("two volumes", &torus("", &format!("{over}\n{LOW}"), ""));
}

/// Numbers on a grid as a file, some of which are not numbers, from one of the first 53 on.
pub(crate) fn holes(name: &str, first: usize, grid: &Grid) -> PathBuf {
    let [nx, ny, nz] = grid.dims();
    let (axes, origin) = (grid.axes(), grid.origin());
    let vector = |v: DVec3| format!("({},{},{})", v.x, v.y, v.z);
    let header = format!(
        "NRRD0005\ntype: float\nendian: little\ndimension: 3\nspace dimension: 3\nsizes: {nx} {ny} {nz}\nencoding: raw\n\
         space directions: {} {} {}\nspace origin: {}\n\n",
        vector(axes.x_axis),
        vector(axes.y_axis),
        vector(axes.z_axis),
        vector(origin)
    );
    let number = |i: usize| if i % 53 == first { f32::NAN } else { (i * 29 % 17) as f32 };
    let bytes: Vec<u8> =
        header.into_bytes().into_iter().chain((0..grid.len()).flat_map(|i| number(i).to_le_bytes())).collect();
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("gpu-holes-{name}.nrrd"));
    fs::write(&path, bytes).unwrap();
    path
}

/// Cells that touch a voxel without a number have the lowest value.
#[test]
fn further_volumes_with_holes() {
    let same = Grid::with_spacing([32; 3], [1.0; 3]).unwrap();
    let turned = DMat3::from_rotation_x(0.4) * DMat3::from_diagonal(DVec3::new(1.7, 1.3, 1.9));
    let other = Grid::new([12, 15, 11], turned, DVec3::new(5.3, 6.4, 2.1)).unwrap();
    let [a, b] = [("same", 7, &same), ("other", 20, &other)].map(|(name, first, grid)| holes(name, first, grid));
    for (name, path) in [("holes, same grid", &a), ("holes, other grid", &b)] {
        let over = format!("over = [\"value\", {{ volume = {path:?} }}]");
        agrees(name, &torus("", &format!("{over}\n{}", styles([1.5, 4.0, 12.0])), ""));
    }
    let over = format!("over = [{{ volume = {a:?} }}, {{ volume = {b:?} }}]");
    agrees("two volumes with holes", &torus("", &format!("{over}\n{LOW}"), ""));
}
