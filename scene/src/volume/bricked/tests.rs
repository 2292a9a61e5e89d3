use super::*;
use crate::space::Grid;
use crate::volume::{Volume, Voxels};
use std::sync::Arc;

/// Values of a deterministic scatter in [0, 1), a good third of them 0.
fn scatter([x, y, z]: [usize; 3]) -> f64 {
    let n = (x * 7919 + y * 104_729 + z * 1_299_709 + 13) % 1009;
    if n % 3 == 0 { 0.0 } else { n as f64 / 1009.0 }
}

fn voxels(dims: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    (0..dims[2]).flat_map(move |z| (0..dims[1]).flat_map(move |y| (0..dims[0]).map(move |x| [x, y, z])))
}

#[test]
fn an_untouched_selection_costs_one_brick() {
    let volume = BrickedVolume::constant([512; 3], 0.0f64);
    assert_eq!((volume.distinct_bricks(), volume.table().len()), (1, 512usize.div_ceil(SIDE).pow(3)));
    assert_eq!(volume.bytes(), SIDE.pow(3) * 8 + volume.table().len() * 8);
    assert!(volume.bytes() < 512usize.pow(3) / 400);
    assert_eq!((volume.occupied(), volume.range()), (None, [0.0, 0.0]));
    // Ones on a grid whose last bricks are cut: the border repeats them, and the brick is still one.
    let ones = BrickedVolume::constant([70, 33, 1], 1.0f64);
    assert_eq!((ones.distinct_bricks(), ones.occupied()), (1, Some([[0; 3], [69, 32, 0]])));
    assert_eq!(BrickedVolume::from_fn([70, 33, 1], |_| 1.0f64).unwrap().distinct_bricks(), 1);
}

#[test]
fn bricks_hold_the_voxels_and_their_corners() {
    for dims in [[37, 18, 35], [16, 16, 16], [1, 1, 1], [17, 1, 2]] {
        let volume = BrickedVolume::from_fn(dims, scatter).unwrap();
        for [x, y, z] in voxels(dims) {
            assert_eq!(volume.value([x, y, z]), scatter([x, y, z]));
            let next = |i: usize, a: usize| (i + 1).min(dims[a] - 1);
            if (0..3).all(|a| dims[a] == 1 || [x, y, z][a] + 1 < dims[a]) {
                let pair = |y, z| [scatter([x, y, z]), scatter([next(x, 0), y, z])];
                let [y1, z1] = [next(y, 1), next(z, 2)];
                assert_eq!(volume.corners([x, y, z]), [pair(y, z), pair(y1, z), pair(y, z1), pair(y1, z1)]);
            }
        }
        let all: Vec<f64> = voxels(dims).map(scatter).collect();
        let ends = [f64::min, f64::max].map(|end| all.iter().copied().reduce(end).unwrap());
        assert_eq!(volume.range(), ends);
    }
}

/// Equal bricks are one, and writing to one of their places replaces that place alone.
#[test]
fn copy_on_write_after_deduplication_changes_exactly_one_brick() {
    let periodic = |voxel: [usize; 3]| scatter(voxel.map(|i| i % SIDE));
    let mut volume = BrickedVolume::from_fn([4 * SIDE; 3], periodic).unwrap();
    assert_eq!(volume.distinct_bricks(), 1);
    let before = volume.table().clone();
    let at = [SIDE + 3, 2 * SIDE, 0];
    assert_eq!(volume.modify(at, at.map(|i| i + 1), |_, v| v + 1.0).unwrap(), 1);
    let other: Vec<usize> = (0..64).filter(|&i| !Arc::ptr_eq(&before[i], &volume.table()[i])).collect();
    assert_eq!((other, volume.distinct_bricks()), (vec![9], 2));
    for voxel in voxels([4 * SIDE; 3]) {
        assert_eq!(volume.value(voxel), periodic(voxel) + f64::from(u8::from(voxel == at)));
    }
    // The old value makes the place equal to the others again, and there is one brick.
    assert_eq!(volume.modify(at, at.map(|i| i + 1), |_, _| periodic(at)).unwrap(), 1);
    assert_eq!(volume.distinct_bricks(), 1);
    assert!(Arc::ptr_eq(&before[0], &volume.table()[9]));
    // Nothing changes where the value is the one before.
    assert_eq!(volume.modify([0; 3], [4 * SIDE; 3], |_, v| v).unwrap(), 0);
}

#[test]
fn bricks_are_equal_bit_by_bit() {
    let signs = |[x, ..]: [usize; 3]| if x < SIDE { 0.0f64 } else { -0.0 };
    let volume = BrickedVolume::from_fn([2 * SIDE, 1, 1], signs).unwrap();
    assert_eq!((volume.distinct_bricks(), volume.occupied()), (2, None));
    // Integers that f64 takes for one.
    let large = |[x, ..]: [usize; 3]| (1u64 << 60) + u64::from(x < SIDE);
    assert_eq!(BrickedVolume::from_fn([2 * SIDE, 1, 1], large).unwrap().distinct_bricks(), 2);
}

/// Range and box follow random modifications, as measured over all voxels.
#[test]
fn range_and_box_are_kept_on_modification() {
    let dims = [40, 21, 33];
    let mut volume = BrickedVolume::constant(dims, 0.0f64);
    let mut dense = vec![0.0; dims.iter().product()];
    for step in 0..60usize {
        let first: [usize; 3] = std::array::from_fn(|a| (step * [31, 17, 23][a] + 5 * a) % dims[a]);
        let end: [usize; 3] = std::array::from_fn(|a| (first[a] + 1 + step * (a + 2) % 9).min(dims[a]));
        let change = |voxel: [usize; 3], v: f64| match step % 3 {
            0 => scatter(voxel),
            1 => 0.0,
            _ => v * 0.5 - 0.125,
        };
        volume.modify(first, end, change).unwrap();
        for (i, voxel) in voxels(dims).enumerate() {
            if (0..3).all(|a| (first[a]..end[a]).contains(&voxel[a])) {
                dense[i] = change(voxel, dense[i]);
            }
        }
        let set: Vec<[usize; 3]> =
            voxels(dims).zip(&dense).filter(|(_, v)| **v != 0.0).map(|(voxel, _)| voxel).collect();
        let end_of = |end: fn(usize, usize) -> usize| {
            set.iter().copied().reduce(|a, b| std::array::from_fn(|i| end(a[i], b[i])))
        };
        assert_eq!(volume.occupied(), end_of(usize::min).zip(end_of(usize::max)).map(|(lo, hi)| [lo, hi]));
        let ends = [f64::min, f64::max].map(|end| dense.iter().copied().reduce(end).unwrap());
        assert_eq!(volume.range(), ends);
        assert!(voxels(dims).zip(&dense).all(|(voxel, v)| volume.value(voxel) == *v));
    }
}

#[test]
fn undo_and_redo_go_through_the_tables() {
    let mut volume = BrickedVolume::constant([2 * SIDE; 3], 0.0f64);
    let mut history = History::new(&volume);
    let mut states = vec![volume.table().clone()];
    for step in 1..4 {
        volume.modify([0; 3], [step; 3], |_, v| v + 1.0).unwrap();
        history.record(&volume);
        states.push(volume.table().clone());
    }
    let is = |volume: &BrickedVolume<f64>, state: usize| {
        volume.table().iter().zip(&states[state]).all(|(a, b)| Arc::ptr_eq(a, b))
    };
    for state in [2, 1, 0] {
        assert!(history.undo(&mut volume) && is(&volume, state));
    }
    assert!(!history.undo(&mut volume) && is(&volume, 0));
    assert!(history.redo(&mut volume) && is(&volume, 1));
    // What is done now takes the place of what was undone.
    volume.modify([5; 3], [6; 3], |_, _| 7.0).unwrap();
    history.record(&volume);
    assert!(!history.redo(&mut volume));
    assert!(history.undo(&mut volume) && is(&volume, 1));
}

#[test]
fn the_census_counts_what_bricks_would_store() {
    let dims = [40, 33, 20];
    let value = |[x, y, z]: [usize; 3]| (scatter([x % SIDE, y, z]) * 200.0) as u8 * u8::from(z < SIDE);
    let data: Vec<u8> = voxels(dims).map(value).collect();
    let volume = Volume::new(Grid::with_spacing(dims, [1.0; 3]).unwrap(), Voxels::U8(data), 1.0, 0.0).unwrap();
    let census = BrickCensus::new(&volume);
    let bricked = BrickedVolume::from_fn(dims, value).unwrap();
    assert_eq!((census.count, census.distinct), (bricked.table().len(), bricked.distinct_bricks()));
    assert_eq!(census.bytes, bricked.bytes());
    assert!(census.distinct > 1 && census.distinct < census.count);
}
