//! Parts of small volumes, counted by hand or by definition.

use super::*;
use crate::space::Grid;
use crate::volume::{VoxelType, Voxels};

/// A volume of values at voxels.
fn volume(dims: [usize; 3], to: VoxelType, value: impl Fn([usize; 3]) -> f64) -> Volume {
    let [nx, ny, nz] = dims;
    let values: Vec<f64> = (0..nx * ny * nz).map(|i| value([i % nx, i / nx % ny, i / (nx * ny)])).collect();
    Volume::new(Grid::with_spacing(dims, [1.0; 3]).unwrap(), Voxels::from_f64(&values, to), 1.0, 0.0).unwrap()
}

fn find(volume: &Volume) -> Parts {
    Parts::find(volume, &|value| value > 5.0).unwrap()
}

fn sizes(parts: &Parts) -> Vec<usize> {
    parts.all().iter().map(|part| part.size).collect()
}

fn inside(p: [usize; 3], lo: [usize; 3], hi: [usize; 3]) -> bool {
    (0..3).all(|a| (lo[a]..=hi[a]).contains(&p[a]))
}

/// Three boxes of 4·3·2, 5·5·1 and 2·3·4 voxels on 12 × 11 × 10.
fn boxes(p: [usize; 3]) -> f64 {
    let [a, b, c] = [([0, 0, 0], [3, 2, 1]), ([6, 5, 8], [10, 9, 8]), ([0, 7, 2], [1, 9, 5])];
    if [a, b, c].iter().any(|(lo, hi)| inside(p, *lo, *hi)) { 9.0 } else { 2.0 }
}

#[test]
fn boxes_have_their_voxels_and_ties_go_by_the_first() {
    for to in [VoxelType::U8, VoxelType::I32, VoxelType::F32] {
        let parts = find(&volume([12, 11, 10], to, boxes));
        let first = |x: usize, y: usize, z: usize| (z * 11 + y) * 12 + x;
        let expected = [(25, first(6, 5, 8)), (24, first(0, 0, 0)), (24, first(0, 7, 2))];
        assert_eq!(parts.all(), expected.map(|(size, first)| Part { size, first }), "{to:?}");
    }
}

#[test]
fn edges_and_corners_do_not_connect() {
    // Two cubes of 2³ that share a corner, and two that share an edge.
    let corner = |p| inside(p, [0; 3], [1; 3]) || inside(p, [2; 3], [3; 3]);
    let edge = |p| inside(p, [0; 3], [1; 3]) || inside(p, [2, 2, 0], [3, 3, 1]);
    for shown in [&corner as &dyn Fn([usize; 3]) -> bool, &edge] {
        let parts = find(&volume([4; 3], VoxelType::U8, |p| if shown(p) { 9.0 } else { 0.0 }));
        assert_eq!(sizes(&parts), [8, 8]);
    }
    // A staircase of faces is one part, whichever way it rises.
    for at in [|x: usize, y: usize| y + 3 - x, |x, y| x + y] {
        let stairs = |[x, y, z]: [usize; 3]| if z == 2 && (3..5).contains(&at(x, y)) { 9.0 } else { 0.0 };
        assert_eq!(sizes(&find(&volume([4; 3], VoxelType::U8, stairs))), [7]);
    }
}

/// The part of each voxel by definition: flooding from every voxel, in the order of storage.
fn flooded(dims: [usize; 3], shown: &dyn Fn(usize) -> bool) -> Vec<Part> {
    let n = dims.iter().product();
    let strides = [1, dims[0], dims[0] * dims[1]];
    let mut seen = vec![false; n];
    let mut parts = Vec::new();
    for first in 0..n {
        let (mut stack, mut size) = (vec![first], 0);
        while let Some(i) = stack.pop() {
            if !shown(i) || std::mem::replace(&mut seen[i], true) {
                continue;
            }
            size += 1;
            for axis in 0..3 {
                let at = i / strides[axis] % dims[axis];
                stack.extend((at > 0).then(|| i - strides[axis]));
                stack.extend((at + 1 < dims[axis]).then(|| i + strides[axis]));
            }
        }
        parts.extend((size > 0).then_some(Part { size, first }));
    }
    parts.sort_by_key(|part| std::cmp::Reverse(part.size));
    parts
}

#[test]
fn parts_are_those_of_a_flood() {
    let scatter = |i: usize, of: u64| (i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40 & 0xff < of;
    for dims in [[9, 7, 8], [1, 9, 9], [9, 1, 7], [8, 9, 1], [1, 1, 30], [40, 1, 1], [1, 1, 1]] {
        for share in [30, 80, 130, 200, 256] {
            let value = |[x, y, z]: [usize; 3]| {
                if scatter((z * dims[1] + y) * dims[0] + x, share) { 9.0 } else { 0.0 }
            };
            let parts = find(&volume(dims, VoxelType::U8, value));
            assert_eq!(parts.all(), flooded(dims, &|i| scatter(i, share)), "{dims:?} {share}");
        }
    }
}

#[test]
fn masked_voxels_belong_to_no_part() {
    // A bar that a NaN cuts in two.
    let bar = volume([9, 1, 1], VoxelType::F64, |[x, ..]| if x == 5 { f64::NAN } else { 9.0 });
    assert_eq!(sizes(&find(&bar)), [5, 3]);
}

fn isolated(mut volume: Volume, keep: Keep, outside_is_high: bool) -> Volume {
    let parts = find(&volume);
    let kept = parts.kept(keep, &volume).unwrap();
    parts.isolate(&kept, &mut volume, outside_is_high).unwrap();
    volume
}

#[test]
fn all_parts_kept_change_nothing() {
    let all = volume([12, 11, 10], VoxelType::F32, boxes);
    for keep in [Keep::Share(0.0), Keep::Largest(3), Keep::Share(0.96)] {
        assert_eq!(isolated(all.clone(), keep, false).voxels(), all.voxels());
    }
    let none = volume([3; 3], VoxelType::U8, |_| 1.0);
    assert_eq!(isolated(none.clone(), Keep::Largest(1), false).voxels(), none.voxels());
    assert_eq!(find(&none).kept(Keep::At(DVec3::ONE), &none), None);
}

/// Voxels 0 to 13 of a row hold 3 and the shown ones 9; 1 is the lowest value, at the end.
fn row(shown: &[usize]) -> Volume {
    volume([14, 1, 1], VoxelType::I16, |[x, ..]| match x {
        13 => 1.0,
        _ if shown.contains(&x) => 9.0,
        _ => 3.0,
    })
}

#[test]
fn the_layer_around_a_part_goes_unless_it_touches_a_kept_one() {
    let values = |volume: Volume| (0..14).map(|x| volume.value([x, 0, 0]) as i32).collect::<Vec<_>>();
    let kept = |shown: &[usize]| values(isolated(row(shown), Keep::Largest(1), false));
    // Two voxels between: the kept part's own neighbour stays.
    assert_eq!(kept(&[2, 3, 6]), [3, 3, 9, 9, 3, 1, 1, 1, 3, 3, 3, 3, 3, 1]);
    // One voxel between, which touches both.
    assert_eq!(kept(&[2, 3, 5]), [3, 3, 9, 9, 3, 1, 1, 3, 3, 3, 3, 3, 3, 1]);
    // At the border.
    assert_eq!(kept(&[0, 4, 5]), [1, 1, 3, 3, 9, 9, 3, 3, 3, 3, 3, 3, 3, 1]);
    // Dark content, by the mirrored test of what is shown, takes the highest value.
    let dark = volume([14, 1, 1], VoxelType::I16, |p| 12.0 - row(&[2, 3, 6]).value(p));
    let parts = Parts::find(&dark, &|value| value < 7.0).unwrap();
    let mut flat = dark.clone();
    parts.isolate(&[true, false], &mut flat, true).unwrap();
    assert_eq!(values(flat), [9, 9, 3, 3, 9, 11, 11, 11, 9, 9, 9, 9, 9, 11]);
}

#[test]
fn a_part_that_touches_with_a_corner_goes() {
    let corner = volume([5; 3], VoxelType::U8, |p| {
        if inside(p, [0; 3], [1; 3]) || p == [2; 3] { 9.0 } else { 3.0 + (p[0] + p[1] + p[2] == 12) as u8 as f64 }
    });
    let kept = isolated(corner, Keep::Largest(1), false);
    assert_eq!(kept.value([2; 3]), 3.0);
    assert_eq!((kept.value([1; 3]), kept.value([3; 3]), kept.value([4; 3])), (9.0, 3.0, 4.0));
}

#[test]
fn a_negative_slope_turns_low_and_high_round() {
    let grid = Grid::with_spacing([8, 1, 1], [1.0; 3]).unwrap();
    // Values −stored: 0, −9, −2.
    let stored = Voxels::I16(vec![-9, -9, 2, 2, 2, -9, 2, 7]);
    let volume = isolated(Volume::new(grid, stored, -1.0, 0.0).unwrap(), Keep::Largest(1), false);
    assert_eq!(volume.voxels(), &Voxels::I16(vec![-9, -9, 2, 2, 7, 7, 7, 7]));
    assert_eq!(volume.range(), [-7.0, 9.0]);
}

#[test]
fn mirrored_and_permuted_volumes_keep_the_same_voxels() {
    let value = |p: [usize; 3]| {
        let h = (p[0] * 31 + p[1] * 57 + p[2] * 101) * 7919 % 251;
        boxes(p).max(if h < 60 { 8.0 } else { 0.0 })
    };
    let plain = isolated(volume([12, 11, 10], VoxelType::U8, value), Keep::Share(0.5), false);
    let mirrored = volume([12, 11, 10], VoxelType::U8, |[x, y, z]| value([11 - x, y, 9 - z]));
    let mirrored = isolated(mirrored, Keep::Share(0.5), false);
    let turned = isolated(volume([10, 12, 11], VoxelType::U8, |[z, x, y]| value([x, y, z])), Keep::Share(0.5), false);
    let mut flat = 0;
    for (x, y, z) in (0..12 * 11 * 10).map(|i| (i % 12, i / 12 % 11, i / 132)) {
        let kept = plain.value([x, y, z]);
        assert_eq!(kept, mirrored.value([11 - x, y, 9 - z]));
        assert_eq!(kept, turned.value([z, x, y]));
        flat += usize::from(kept != value([x, y, z]));
    }
    assert!(flat > 20, "{flat}");
}

#[test]
fn a_point_chooses_the_part_of_the_nearest_voxel() {
    let all = volume([12, 11, 10], VoxelType::U8, boxes);
    let parts = find(&all);
    let at = |x, y, z| parts.kept(Keep::At(DVec3::new(x, y, z)), &all);
    assert_eq!(at(8.0, 7.0, 8.0), Some(vec![true, false, false]));
    assert_eq!(at(3.4, 1.0, 1.9), Some(vec![false, true, false]));
    assert_eq!(at(0.0, 6.5, 4.0), Some(vec![false, false, true]));
    for nothing in [at(5.0, 5.0, 5.0), at(-0.1, 0.0, 0.0), at(f64::NAN, 0.0, 0.0), at(1e300, 0.0, 0.0)] {
        assert_eq!(nothing, None);
    }
    // An axis of one voxel goes half a voxel to either side.
    let flat = volume([4, 1, 1], VoxelType::U8, |[x, ..]| x as f64 * 3.0);
    let kept = |y, z| find(&flat).kept(Keep::At(DVec3::new(3.0, y, z)), &flat);
    assert_eq!((kept(0.5, -0.5), kept(0.6, 0.0)), (Some(vec![true]), None));
}
