//! Transfer functions over two quantities, and labels.

use super::{errors, gpu, modules, random};
use drypoint::gpu::ShaderKernel;
use drypoint::reference::field::CellPosition;
use drypoint::reference::labels::Labels;
use drypoint::reference::number::Vec3;
use drypoint::reference::transfer::over::{AxisMeasure, OtherVolume, PointDistance, SampleQuantities};
use drypoint::reference::transfer::{Coordinate, TransferPlane};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::other_grid::OtherGrid;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Axis, LabelLookup};
use drypoint::scene::transfer::Rows;
use drypoint::scene::volume::labels::LabelVolume;
use drypoint::scene::volume::{Volume, Voxels};

/// Half a last place of 1 in f32: the error of one operation.
const U: f64 = 1.0 / (1u64 << 24) as f64;

/// Rows of three, one and two nodes; a step in the first one.
const AT: [f64; 7] = [0.5, 2.0, 2.0, 3.0, 1.0, 0.0, 4.0];
const OPACITY: [f64; 7] = [0.0, 0.25, 0.75, 1.0, 0.5, 0.125, 0.875];
const FIRST: [usize; 3] = [0, 4, 5];

/// Places in rows and between them: numbers along both axes, ids along one.
#[test]
fn places_in_the_plane() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(21);
    let ids = [3.0, 7.0, 4_000_000_000.0];
    let of_node = [1.0, 2.0, 9.0, 11.0, 2.0, 2.0, 4.0];
    for (over, at, rows_at) in [
        ([Axis::Value, Axis::GradientMagnitude], AT, [0.5, 1.5, 4.0]),
        ([Axis::Value, Axis::GradientMagnitude], AT, [0.5, 1.5, 1.5]),
        ([Axis::Value, Axis::Label], AT, ids),
        ([Axis::Label, Axis::Value], of_node, [0.5, 1.5, 4.0]),
    ] {
        let is_id = over.each_ref().map(Axis::is_id);
        let rows = Rows { over, at: rows_at.to_vec(), first: FIRST.to_vec(), normalized: false };
        let plane = TransferPlane::<f64>::new(&at, &OPACITY, &rows).unwrap();
        let numbers = [&at[..], &OPACITY, &rows_at].concat();
        let id = |is: bool, at: &[f64]| at.iter().filter(|_| is).map(|&id| id as u32).collect::<Vec<_>>();
        let words = [vec![0, 4, 5, 7], id(is_id[0], &at), id(is_id[1], &rows_at)].concat();
        let mut table: Vec<[f64; 2]> = Vec::new();
        for i in 0..2000 {
            // Ids that f32 holds; numbers about the stops and on them.
            let number = |next: &mut dyn FnMut() -> f64| match i % 4 {
                0 => (10.0 * next()).floor() / 2.0,
                _ => 5.0 * next() - 0.25,
            };
            let coordinate = |is: bool, ids: &[f64], next: &mut dyn FnMut() -> f64| match is {
                true if i % 3 == 0 => (12.0 * next()).floor(),
                true => ids[(next() * ids.len() as f64) as usize],
                false => number(next),
            };
            let x = coordinate(is_id[0], &of_node, &mut next);
            table.push([x, coordinate(is_id[1], &ids, &mut next)]);
        }
        let kernel = ShaderKernel {
            modules: format!(
                "struct NodePlace {{ node: i32, w: real, alpha_u: real, }}
                 struct Ray {{ k: i32, }}\nstruct Sample {{ x: real, y: real, }}\nstruct Attributes {{ k: i32, }}
                 const PLANE_NODES = 7;\nconst PLANE_ROWS = 3;\nconst ACROSS_IS_ID = {};\nconst DOWN_IS_ID = {};
                 fn across(ray: Ray, s: Sample, a: Attributes) -> Coordinate {{ return Coordinate(s.x, u32(s.x)); }}
                 fn down(ray: Ray, s: Sample, a: Attributes) -> Coordinate {{ return Coordinate(s.y, u32(s.y)); }}\n{}",
                is_id[0],
                is_id[1],
                modules(&["number/arithmetic", "transfer/over/plane"])
            ),
            lists: &[(13, &numbers)],
            words: &[(14, &words)],
            before: "let seen = is_in_plane(Ray(), Sample(x[0], x[1]), Attributes());
                if (!seen) { node_patch = NodePatch(); }
                let p = node_patch;",
            results: &[
                "real(p.below.node) + p.below.w",
                "p.below.alpha_u",
                "real(p.above.node) + p.above.w",
                "p.above.alpha_u",
                "p.w",
                "p.alpha_u",
            ],
            ..ShaderKernel::default()
        };
        let truth = |&[x, y]: &[f64; 2]| {
            let coordinate = |is: bool, x: f64| if is { Coordinate::Id(x as u32) } else { Coordinate::Number(x) };
            plane.locate(coordinate(is_id[0], x), coordinate(is_id[1], y)).map_or([0.0; 6], |patch| {
                let [a, b] = patch.rows;
                let i = |place: drypoint::reference::transfer::NodePlace<f64>| place.node as f64 + place.w;
                [i(a), a.alpha_u, i(b), b.alpha_u, patch.w, patch.alpha_u]
            })
        };
        // w is a quotient of differences of numbers up to 5 that are at least ½ apart; i is counted up to 7.
        let found = errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0);
        println!("plane: {found:?}");
        assert!(found[0] <= 1e-13 && found[1] <= 3.0 * (5.0 / 0.5 + 7.0) * U, "{found:?}");
    }
}

/// Ids at places that are far from every border between ids, as far as f32 moves them; on the data's grid and another.
#[test]
fn labels_at_positions() {
    let Some(gpu) = gpu() else { return };
    let data = Grid::with_spacing([9, 8, 7], [1.0; 3]).unwrap();
    let turned = DMat3::from_rotation_z(0.3) * DMat3::from_diagonal(DVec3::new(1.5, 1.25, 1.0));
    let other = Grid::new([6, 5, 1], turned, DVec3::new(1.0, -0.5, 3.0)).unwrap();
    for (grid, lookup) in [
        (&data, LabelLookup::Nearest),
        (&data, LabelLookup::Smooth),
        (&other, LabelLookup::Nearest),
        (&other, LabelLookup::Smooth),
    ] {
        let mut next = random(31);
        let ids: Vec<u16> = (0..grid.len()).map(|_| (4.0 * next()) as u16 * 300).collect();
        let volume = Volume::new(grid.clone(), Voxels::U16(ids.clone()), 1.0, 0.0).unwrap();
        let labels = LabelVolume::new(&volume).unwrap();
        let truth = Labels::new(&labels, &data, None, lookup);
        let at = |p: [f64; 3]| truth.id_at(Vec3::new(p[0], p[1], p[2]));
        let [_, end] = data.index_box();
        // A position with one id all around: within what rounding can move it.
        let same = |p: &[f64; 3]| {
            let e = 1e-4;
            (0..3).all(|a| {
                [-e, e].iter().all(|d| {
                    let mut moved = *p;
                    moved[a] = (moved[a] + d).clamp(0.0, end[a]);
                    at(moved) == at(*p)
                })
            })
        };
        let random = (0..4000).map(|_| [end.x * next(), end.y * next(), end.z * next()]).filter(|p| same(p));
        let corners = (0..8).map(|c| [0, 1, 2].map(|a: usize| if c >> a & 1 == 0 { 0.0 } else { end[a] }));
        let table: Vec<[f64; 3]> = random.chain(corners).collect();
        let words: Vec<u32> =
            ids.chunks(2).map(|pair| u32::from(pair[0]) | u32::from(*pair.get(1).unwrap_or(&0)) << 16).collect();
        let dims = grid.dims();
        let map = OtherGrid::new(&data, grid);
        let on = if lookup == LabelLookup::Nearest { "labels_nearest" } else { "labels_smooth" };
        let place = if map.is_some() { "labels_other_grid" } else { "labels_same_grid" };
        let mut vectors = vec![
            ("label_last_cell", dims.map(|n| (n.max(2) - 2) as f64)),
            ("label_long_axes", dims.map(|n| if n == 1 { 0.0 } else { 1.0 })),
        ];
        if let Some(map) = &map {
            let (linear, offset) = map.parts();
            let ([low, high], [from, to]) = (map.own_box(), map.reach());
            let names = ["to_labels_x", "to_labels_y", "to_labels_z"];
            vectors.extend(names.into_iter().zip(linear.to_cols_array_2d()));
            vectors.extend(
                [("to_labels", offset), ("label_box_low", low), ("label_box_high", high)]
                    .map(|(n, v)| (n, v.to_array())),
            );
            vectors.extend([("label_reach_low", from), ("label_reach_high", to)].map(|(n, v)| (n, v.to_array())));
        }
        let kernel = ShaderKernel {
            modules: format!(
                "struct Place {{ cell: vec3<i32>, w: vec3<real>, }}
                 const LABEL_BITS = 16;\nconst LABELS_X = {};\nconst LABELS_Y = {};\n{}",
                dims[0],
                dims[1],
                modules(&["transfer/over/labels", &format!("transfer/over/{on}"), &format!("transfer/over/{place}")])
            ),
            vectors: &vectors,
            words: &[(15, &words)],
            results: &["real(label_at(vec3<real>(x[0], x[1], x[2])))"],
            ..ShaderKernel::default()
        };
        let found = errors(&gpu, &kernel, &table, |&p| [f64::from(at(p))], |_, _, _| 1.0);
        assert_eq!(found, [0.0; 2], "{lookup:?} {place}");
    }
}

/// A sample at a position, with nothing else known.
fn sample([x, y, z]: [f64; 3]) -> SampleQuantities<f64> {
    SampleQuantities {
        position: Vec3::new(x, y, z),
        place: CellPosition { cell: [0; 3], w: [0.0; 3] },
        value: 0.0,
        gradient: 0.0,
        magnitude: 0.0,
        principal: [0.0; 2],
        kappa: 0.0,
    }
}

fn number(coordinate: Coordinate<f64>) -> f64 {
    if let Coordinate::Number(x) = coordinate { x } else { f64::NAN }
}

/// A skew grid, and positions in its box.
fn positions(count: usize) -> (Grid, Vec<[f64; 3]>) {
    let mut next = random(41);
    let axes = DMat3::from_cols(DVec3::new(1.5, 0.25, 0.0), DVec3::new(-0.5, 1.25, 0.125), DVec3::new(0.0, 0.5, 2.0));
    let grid = Grid::new([9, 8, 7], axes, DVec3::new(1.0, -2.0, 0.5)).unwrap();
    let [_, end] = grid.index_box();
    let random = (0..count).map(|_| [end.x * next(), end.y * next(), end.z * next()]);
    let corners = (0..8).map(|c| [0, 1, 2].map(|a: usize| if c >> a & 1 == 0 { 0.0 } else { end[a] }));
    (grid.clone(), random.chain(corners).collect())
}

/// Components up to 20 from 7 roundings each, and a norm; the distance itself is compared with their size.
#[test]
fn distances_from_points() {
    let Some(gpu) = gpu() else { return };
    let (grid, table) = positions(2000);
    let point = DVec3::new(3.25, 2.5, 4.75);
    let [x, y, z] = grid.axes().to_cols_array_2d();
    let offset = (grid.origin() - point).to_array();
    let kernel = ShaderKernel {
        modules: modules(&["transfer/over/point"]),
        vectors: &[("world_axis_x", x), ("world_axis_y", y), ("world_axis_z", z), ("offset", offset)],
        results: &["distance_from(vec3<real>(x[0], x[1], x[2]), offset())"],
        ..ShaderKernel::default()
    };
    let truth = PointDistance::<f64>::new(&grid, point);
    let found = errors(&gpu, &kernel, &table, |&p| [number(truth.at(&sample(p)))], |_, _, _| 20.0);
    println!("distances to points: {found:?}");
    assert!(found[0] <= 1e-13 && found[1] <= (3.0 * 7.0 + 3.0) * U, "{found:?}");
}

/// Values of [−1, 1] on another grid, a flat one and the data's own. Places up to 20 have 7 roundings, and values are at most
/// 2 apart along each axis. Samples on the border of the other box are left to f64: f32 finds some of them outside.
#[test]
fn values_of_further_volumes() {
    let Some(gpu) = gpu() else { return };
    let (data, table) = positions(3000);
    let axes = DMat3::from_rotation_z(0.4) * DMat3::from_diagonal(DVec3::new(1.75, 1.25, 2.25));
    let other = Grid::new([6, 7, 5], axes, DVec3::new(2.0, -0.5, 2.5)).unwrap();
    let flat = Grid::new([8, 9, 1], axes, DVec3::new(2.0, -0.5, 4.5)).unwrap();
    let mut next = random(43);
    let ground = Volume::new(data.clone(), Voxels::F64(vec![0.0; data.len()]), 1.0, 0.0).unwrap();
    for (grid, has_holes) in [&data, &other, &flat].into_iter().flat_map(|grid| [(grid, false), (grid, true)]) {
        let mut values: Vec<f64> = (0..grid.len()).map(|_| f64::from((2.0 * next() - 1.0) as f32)).collect();
        values[0] = -1.0;
        let stored = |(i, &value): (usize, &f64)| if has_holes && i % 37 == 5 { f64::NAN } else { value };
        let stored = values.iter().enumerate().map(stored).collect();
        let volume = Volume::new(grid.clone(), Voxels::F64(stored), 1.0, 0.0).unwrap();
        let [nx, ny, nz] = grid.dims();
        // Two words before the mask, as if another mask were there.
        let mut mask = vec![0u32; 2 + grid.len().div_ceil(32)];
        for i in 0..grid.len() {
            let touches = volume.mask().is_some_and(|mask| mask.touches_cell([i % nx, i / nx % ny, i / (nx * ny)]));
            mask[2 + i / 32] |= u32::from(touches) << (i % 32);
        }
        let truth = OtherVolume::<f64>::new(&volume, &ground).unwrap();
        let map = OtherGrid::new(&data, grid);
        let (linear, offset) = map.map_or((DMat3::IDENTITY, DVec3::ZERO), |map| map.parts());
        let mut list: Vec<f64> = Vec::new();
        for row in 0..3 {
            list.extend(linear.row(row).to_array());
            list.push(offset[row]);
        }
        list.extend(values.iter().map(|v| v + 1.0));
        let [lo, hi] = grid.index_box();
        let away = |p: &[f64; 3]| {
            let p = linear * DVec3::from_array(*p) + offset;
            let to_border = |border: DVec3| (p - border).abs().min_element();
            map.is_none() || to_border(lo - OtherGrid::SLACK).min(to_border(hi + OtherGrid::SLACK)) > 1e-4
        };
        let table: Vec<[f64; 3]> = table.iter().copied().filter(away).collect();
        let place = format!("0, vec3({nx}, {ny}, {nz})");
        let value = match has_holes {
            false => format!("further_value({place}, vec3<real>(x[0], x[1], x[2])) - 1.0"),
            true => format!("further_value_unmasked({place}, 2, vec3<real>(x[0], x[1], x[2])) - 1.0"),
        };
        let kernel = ShaderKernel {
            modules: format!(
                "struct Place {{ cell: vec3<i32>, w: vec3<real>, }}\n{}",
                modules(&[
                    "number/arithmetic",
                    "transfer/over/grid_numbers",
                    "transfer/over/other_volume",
                    "transfer/over/other_volume_masked"
                ])
            ),
            params: &[("grid_slack", OtherGrid::SLACK)],
            lists: &[(16, &list)],
            words: &[(17, &mask)],
            results: &[&value],
            ..ShaderKernel::default()
        };
        let found = errors(&gpu, &kernel, &table, |&p| [number(truth.at(&sample(p)))], |_, _, _| 1.0);
        println!("further volumes: {found:?}");
        assert!(found[0] <= 1e-13 && found[1] <= (3.0 * 2.0 * 20.0 * 7.0 + 20.0) * U, "{found:?}");
    }
}
