use super::*;
use LabelLookup::{Nearest, Smooth};
use drypoint_scene::glam::DMat3;
use drypoint_scene::volume::{Volume, Voxels};

/// Ids by voxel on a grid.
fn on(grid: Grid, id: impl Fn([usize; 3]) -> u32) -> LabelVolume {
    let [nx, ny, _] = grid.dims();
    let ids = (0..grid.len()).map(|i| id([i % nx, i / nx % ny, i / nx / ny])).collect();
    LabelVolume::new(&Volume::new(grid, Voxels::U32(ids), 1.0, 0.0).unwrap()).unwrap()
}

fn unit(dims: [usize; 3]) -> Grid {
    Grid::with_spacing(dims, [1.0; 3]).unwrap()
}

/// Ids at positions of the labels' own grid.
fn own(volume: &LabelVolume, lookup: LabelLookup) -> impl Fn([f64; 3]) -> u32 {
    let labels = Labels::new(volume, volume.grid(), None, lookup);
    assert!(labels.on_same_grid());
    move |[x, y, z]| labels.id_at(Vec3::new(x, y, z))
}

/// Ids without a pattern, sparse and above 255, like those of atlases.
fn scattered([x, y, z]: [usize; 3]) -> u32 {
    [0, 5, 1605, 70_000, 3][(x * 7 + y * 5 + z * 3 + x * y * z) % 5]
}

/// Positions all over a box, multiples of the roots of primes, so that none lies midway between voxels.
fn positions([lo, hi]: [DVec3; 2]) -> impl Iterator<Item = Vec3<f64>> {
    let share = |i: usize, root: f64| (i as f64 * root).fract();
    let shares = (1..6000).map(move |i| [2f64, 3.0, 5.0].map(|n| share(i, n.sqrt())));
    shares.map(move |s| Vec3::from_glam(lo + (hi - lo) * DVec3::from_array(s)))
}

#[test]
fn nearest_by_hand() {
    let volume = on(unit([3, 2, 2]), |[x, y, z]| (x + 10 * y + 100 * z) as u32);
    let id = own(&volume, Nearest);
    assert_eq!(id([0.0, 0.0, 0.0]), 0);
    assert_eq!(id([1.49, 0.51, 0.0]), 11);
    assert_eq!(id([2.0, 1.0, 1.0]), 112);
    // The lower index holds for two voxels at equal distance.
    assert_eq!(id([0.5, 0.5, 0.5]), 0);
    assert_eq!(id([1.5, 0.5f64.next_up(), 0.5]), 11);
}

#[test]
fn smooth_by_hand() {
    // A constant along z. At (0.4, 0.4): 7 weighs 0.36, 3 twice 0.24, 9 weighs 0.16.
    let volume = on(unit([2, 2, 2]), |[x, y, _]| [[7, 3], [3, 9]][y][x]);
    let id = own(&volume, Smooth);
    assert_eq!(id([0.4, 0.4, 0.3]), 3);
    assert_eq!(own(&volume, Nearest)([0.4, 0.4, 0.3]), 7);
    // At (0.25, 0.25): 9/16, 6/16, 1/16.
    assert_eq!(id([0.25, 0.25, 1.0]), 7);
    assert_eq!(id([0.8, 0.9, 0.0]), 9);
    // Halfway the weights are equal to the last bit: the smaller id holds.
    let wall = |ids: [u32; 2]| own(&on(unit([2, 2, 2]), |[x, ..]| ids[x]), Smooth)([0.5, 0.3, 0.7]);
    assert_eq!([wall([9, 4]), wall([4, 9])], [4, 4]);
    let wall = on(unit([2, 2, 2]), |[x, ..]| [9, 4][x]);
    assert_eq!([0.499, 0.501].map(|x| own(&wall, Smooth)([x, 0.3, 0.7])), [9, 4]);
    // Eight ids of one weight.
    assert_eq!(own(&on(unit([2, 2, 2]), |[x, y, z]| 9 - (x + 2 * y + 4 * z) as u32), Smooth)([0.5; 3]), 2);
}

#[test]
fn both_are_the_voxels_own_at_their_centres() {
    let dims = [5, 4, 3];
    let volume = on(unit(dims), scattered);
    for lookup in [Nearest, Smooth] {
        let id = own(&volume, lookup);
        for p in (0..60).map(|i| [i % 5, i / 5 % 4, i / 20]) {
            assert_eq!(id(p.map(|x| x as f64)), scattered(p), "{lookup:?} {p:?}");
        }
    }
}

/// The part x + y ≤ c of a grid has one corner inside or one outside in each cell that its border crosses. Let u and
/// v be the distances from that corner along the axes. The border of `smooth` is then (1 − u)(1 − v) = ½: a hyperbola
/// through (½, 0), (1 − √½, 1 − √½) and (0, ½). Its distance from the plane through its ends is at most (3/2 − √2)/√2
/// = 0.061. The steps of `nearest` reach ½/√2 = 0.354 to both sides of this plane.
#[test]
fn a_slanted_border_is_flat_under_smooth_and_a_stair_under_nearest() {
    let volume = on(unit([24, 24, 2]), |[x, y, _]| u32::from(x + y <= 20));
    // The distance of the border from the plane x + y = 20.5, along lines that cross it at right angles.
    let farthest = |lookup| {
        let id = own(&volume, lookup);
        let offsets = (0..200).map(|i| {
            let along = i as f64 / 50.0;
            let at = |s: f64| id([10.25 + along + s, 10.25 - along + s, 0.375]);
            let (mut lo, mut hi) = (-1.0, 1.0);
            assert_eq!([at(lo), at(hi)], [1, 0]);
            for _ in 0..50 {
                let middle = 0.5 * (lo + hi);
                if at(middle) == 1 { lo = middle } else { hi = middle }
            }
            (hi * 2f64.sqrt()).abs()
        });
        offsets.fold(0.0, f64::max)
    };
    let (smooth, nearest) = ((1.5 - 2f64.sqrt()) / 2f64.sqrt(), 0.5 / 2f64.sqrt());
    // The 200 lines are 0.02 apart along each axis, so they miss the tip of a step by at most that.
    let [s, n] = [Smooth, Nearest].map(farthest);
    assert!(s <= smooth + 1e-12 && s > smooth - 0.002, "{s}");
    assert!(n <= nearest + 1e-12 && n > nearest - 0.03, "{n}");
}

/// The place at which a ray from the centre leaves a sphere of voxels. Under `nearest` it is uniform over the depth
/// of a voxel, with a deviation of 1/√12 = 0.289. `smooth` reduces this by two fifths (0.173 … 0.179 at these radii).
#[test]
fn the_border_of_a_sphere_is_nearer_under_smooth() {
    for radius in [6.0, 10.0, 15.0] {
        let centre = DVec3::splat(17.3);
        let volume = on(unit([36; 3]), |p| {
            let p = DVec3::from_array(p.map(|x| x as f64));
            u32::from((p - centre).length() <= radius)
        });
        let deviation = |lookup| {
            let id = own(&volume, lookup);
            let (n, mut sum) = (2000, 0.0);
            for i in 0..n {
                // Fibonacci's spiral.
                let z = 1.0 - (2 * i + 1) as f64 / n as f64;
                let (sin, cos) = (2.399_963_229_728_653 * i as f64).sin_cos();
                let u = DVec3::new(cos * (1.0 - z * z).sqrt(), sin * (1.0 - z * z).sqrt(), z);
                let inside = |r: &f64| id((centre + u * *r).to_array()) == 1;
                let r = (0..400).map(|i| radius - 2.0 + i as f64 * 0.01).rfind(inside).unwrap();
                sum += (r - radius).powi(2);
            }
            (sum / n as f64).sqrt()
        };
        let [nearest, smooth] = [Nearest, Smooth].map(deviation);
        assert!((nearest - 1.0 / 12f64.sqrt()).abs() < 0.01, "R = {radius}: {nearest}");
        assert!(smooth < 0.65 * nearest, "R = {radius}: {smooth} of {nearest}");
    }
}

/// Equal places on different grids give equal ids, under both lookups.
#[test]
fn grids_that_hold_the_same_voxels_give_the_same_ids() {
    let dims = [9, 7, 5];
    let axes = DMat3::from_diagonal(DVec3::new(3.0, 2.0, 1.5));
    let grid = Grid::new(dims, axes, DVec3::new(-10.0, 20.0, 5.0)).unwrap();
    let volume = on(grid.clone(), scattered);
    let [lo, hi] = grid.index_box();
    // Rotated by 90° about z: x of the turned grid runs along −y of the first.
    let last = DVec3::new(0.0, (dims[1] - 1) as f64, 0.0);
    let turned_axes = DMat3::from_cols(-axes.y_axis, axes.x_axis, axes.z_axis);
    let turned = Grid::new([dims[1], dims[0], dims[2]], turned_axes, grid.to_world(last)).unwrap();
    let turned = on(turned, |[x, y, z]| scattered([y, dims[1] - 1 - x, z]));
    for lookup in [Nearest, Smooth] {
        let same = Labels::new(&volume, &grid, None, lookup);
        let other = Labels::new(&turned, &grid, None, lookup);
        assert!(same.on_same_grid() && !other.on_same_grid());
        let mut seen = std::collections::BTreeSet::new();
        for p in positions([lo, hi]) {
            assert_eq!(other.id_at(p), same.id_at(p), "{lookup:?} {p:?}");
            seen.insert(same.id_at(p));
        }
        assert!(seen.into_iter().eq([0, 3, 5, 1605, 70_000]));
    }
}

/// A file in LPS beside data in RAS, and the other way round.
#[test]
fn another_anatomy_is_flipped() {
    let [lps, las, ras] = Anatomy::ALL.map(Some);
    let grid =
        Grid::new([6, 5, 4], DMat3::from_diagonal(DVec3::new(2.0, 1.0, 0.5)), DVec3::new(7.0, -3.0, 1.0)).unwrap();
    let labels = |from: Option<Anatomy>| {
        let grid = Anatomy::between(&grid, ras, from);
        let ids = (0..grid.len()).map(|i| scattered([i % 6, i / 6 % 5, i / 30])).collect();
        let volume = Volume::new(grid, Voxels::U32(ids), 1.0, 0.0).unwrap().with_anatomy(from);
        LabelVolume::new(&volume).unwrap()
    };
    let want = labels(ras);
    let want = Labels::new(&want, &grid, ras, Smooth);
    for from in [lps, las] {
        let volume = labels(from);
        let flipped = Labels::new(&volume, &grid, ras, Smooth);
        assert!(flipped.on_same_grid(), "{from:?}");
        assert!(positions(grid.index_box()).all(|p| flipped.id_at(p) == want.id_at(p)), "{from:?}");
        // Without the flip the labels lie elsewhere.
        let as_it_is = Labels::new(&volume, &grid, None, Smooth);
        assert!(!as_it_is.on_same_grid());
        assert!(positions(grid.index_box()).any(|p| as_it_is.id_at(p) != want.id_at(p)), "{from:?}");
    }
}

/// Labels of half the resolution: a voxel for every second one of the data, its centre on the first of them.
#[test]
fn a_coarser_grid_has_the_nearest_of_its_own_voxels() {
    let data = unit([9, 9, 9]);
    let coarse = on(Grid::with_spacing([5; 3], [2.0; 3]).unwrap(), scattered);
    let labels = Labels::new(&coarse, &data, None, Nearest);
    for p in positions(data.index_box()) {
        let voxel = [p.x, p.y, p.z].map(|x| (x / 2.0).round() as usize);
        assert_eq!(labels.id_at(p), scattered(voxel), "{p:?}");
    }
    // Each voxel lies in the middle of the 2 × 2 × 2 data voxels that have its id.
    let fine = unit([8; 3]);
    let half = Grid::new([4; 3], DMat3::from_diagonal(DVec3::splat(2.0)), DVec3::splat(0.5)).unwrap();
    let half = on(half, scattered);
    let labels = Labels::new(&half, &fine, None, Nearest);
    for p in (0..216).map(|i| [1 + i % 6, 1 + i / 6 % 6, 1 + i / 36]) {
        let [x, y, z] = p.map(|x| x as f64);
        assert_eq!(labels.id_at(Vec3::new(x, y, z)), scattered(p.map(|x| x / 2)), "{p:?}");
    }
}

#[test]
fn outside_of_its_box_there_is_no_label() {
    let small = Grid::new([3, 3, 3], DMat3::IDENTITY, DVec3::splat(2.0)).unwrap();
    let volume = on(small, |_| 4);
    for lookup in [Nearest, Smooth] {
        let labels = Labels::new(&volume, &unit([8; 3]), None, lookup);
        for (x, id) in [(0.0, 0), (1.9, 0), (2.0, 4), (3.3, 4), (4.0, 4), (4.1, 0), (7.0, 0)] {
            assert_eq!(labels.id_at(Vec3::new(x, 3.0, 3.0)), id, "{x}");
            assert_eq!(labels.id_at(Vec3::new(3.0, 3.0, x)), id, "{x}");
        }
    }
}

/// One file gives the origin in single precision, another one in a quaternion's rounding.
#[test]
fn grids_that_differ_by_rounding_are_one() {
    let grid = |origin: f64, spacing: f64| {
        Grid::new([100, 4, 4], DMat3::from_diagonal(DVec3::splat(spacing)), DVec3::splat(origin)).unwrap()
    };
    let volume = on(grid(-173.3, 0.7), scattered);
    let labels = Labels::new(&volume, &grid(f64::from(-173.3f32), f64::from(0.7f32)), None, Smooth);
    assert!(labels.on_same_grid());
    // A grid of the same dims, a hundredth of a voxel away, is another grid. Its first voxels lie outside by that
    // much.
    let labels = Labels::new(&volume, &grid(-173.307, 0.7), None, Smooth);
    assert!(!labels.on_same_grid());
    assert_eq!(labels.id_at(Vec3::new(0.0, 1.0, 1.0)), 0);
}

#[test]
fn axes_of_one_voxel_have_no_neighbours() {
    let flat = on(unit([4, 1, 3]), scattered);
    for lookup in [Nearest, Smooth] {
        let id = own(&flat, lookup);
        for y in [-0.5, 0.0, 0.5] {
            assert_eq!(id([2.2, y, 1.1]), scattered([2, 0, 1]));
        }
    }
    assert_eq!(own(&on(unit([1; 3]), |_| 9), Smooth)([0.5, -0.5, 0.2]), 9);
    // A slice of labels half a voxel thick to both sides, in a deeper volume.
    let slice = Grid::new([4, 4, 1], DMat3::IDENTITY, DVec3::new(0.0, 0.0, 2.0)).unwrap();
    let slice = on(slice, |_| 6);
    let labels = Labels::new(&slice, &unit([4; 3]), None, Smooth);
    assert_eq!([1.4, 1.6, 2.4, 2.6].map(|z| labels.id_at(Vec3::new(1.0, 1.0, z))), [0, 6, 6, 0]);
    // A slice of data through deeper labels: positions lie to both sides of its plane.
    let deep = on(unit([4; 3]), |[.., z]| z as u32);
    let plane = Grid::new([4, 4, 1], DMat3::IDENTITY, DVec3::new(0.0, 0.0, 1.5)).unwrap();
    let labels = Labels::new(&deep, &plane, None, Nearest);
    assert_eq!([-0.4, 0.4].map(|z| labels.id_at(Vec3::new(1.0, 1.0, z))), [1, 2]);
    assert_eq!(labels.ids_in([0, 0, 0], [3, 3, 1]), [0, 1, 2, 3]);
}

#[test]
fn single_precision_has_the_same_ids() {
    let volume = on(unit([9, 7, 5]), scattered);
    let labels = Labels::new(&volume, volume.grid(), None, Smooth);
    for p in positions(volume.grid().index_box()) {
        let single = Vec3::<f32>::from_glam(p.to_glam());
        let double = Vec3::<f64>::from_glam(single.to_glam());
        assert_eq!(labels.id_at(single), labels.id_at(double));
    }
}

/// Every id at a position is listed for its cell. If the grids are one, the lists are those of the voxels.
#[test]
fn cells_list_all_their_ids() {
    let shear = DMat3::from_cols(DVec3::new(0.8, 0.3, 0.0), DVec3::new(-0.2, 0.9, 0.1), DVec3::new(0.0, 0.2, 1.7));
    let placed = |origin: [f64; 3]| Grid::new([9, 7, 5], shear, DVec3::from_array(origin)).unwrap();
    let data = unit([10, 8, 6]);
    for grid in [data.clone(), placed([0.3, 0.1, -0.4]), placed([4.0, -2.0, 1.0]), placed([50.0, 0.0, 0.0])] {
        let volume = on(grid, scattered);
        for lookup in [Nearest, Smooth] {
            let labels = Labels::new(&volume, &data, None, lookup);
            for p in positions(data.index_box()) {
                let first = [p.x, p.y, p.z].map(|x| x.floor() as usize / 3 * 3);
                let ids = labels.ids_in(first, first.map(|x| x + 3));
                assert!(ids.contains(&labels.id_at(p)), "{p:?} {ids:?}");
                assert!(ids.is_sorted_by(|a, b| a < b));
            }
        }
    }
    let far = on(placed([50.0, 0.0, 0.0]), |_| 3);
    assert_eq!(Labels::new(&far, &data, None, Nearest).ids_in([0; 3], [4; 3]), [0]);
    let volume = on(unit([10, 8, 6]), |[x, ..]| 300 + x as u32);
    let labels = Labels::new(&volume, &data, None, Smooth);
    assert_eq!(labels.ids_in([2, 0, 0], [4, 2, 2]), [302, 303, 304]);
    assert_eq!(labels.ids_in([8, 0, 0], [12, 4, 4]), [308, 309]);
}
