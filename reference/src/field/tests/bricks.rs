//! No sample leaves the range of its brick, nor that of its cell ([RAY-2]).

use super::*;
use drypoint_scene::volume::BRICK;
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Every kernel is tested on volumes of few values with jumps between them, where cubic kernels overshoot.
    /// Positions crowd at the faces of cells and in their middles, where the overshoot is largest.
    #[test]
    fn samples_stay_in_their_brick_and_their_cell(
        dims in prop::array::uniform3(prop_oneof![1usize..4, 8usize..20]),
        seed in any::<u64>(),
        levels in 1u64..5,
        slope in prop_oneof![Just(1.0), Just(-0.37)],
        kernel in prop::sample::select(&KERNELS[..]),
        narrow in any::<bool>(),
    ) {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            state >> 33
        };
        let voxels = (0..dims.iter().product()).map(|_| (next() % levels) as f64 * 77.7 - 100.1).collect();
        let grid = Grid::with_spacing(dims, [1.0; 3]).unwrap();
        let volume = Volume::new(grid, Voxels::F64(voxels), slope, 12.3).unwrap();
        let how = Reconstruction { kernel, ..Default::default() };
        let mut at = |n: usize| match (next() % 4, (n - 1) as f64) {
            (0, end) => (next() % n as u64) as f64 * f64::from(u8::from(end > 0.0)),
            (1, end) => ((next() % n as u64) as f64 + 0.5).min(end),
            (_, end) => (next() as f64 / (1u64 << 31) as f64) * end,
        };
        let positions: Vec<DVec3> = (0..400).map(|_| DVec3::new(at(dims[0]), at(dims[1]), at(dims[2]))).collect();
        if narrow {
            stays::<f32>(&volume, how, &positions)?;
        } else {
            stays::<f64>(&volume, how, &positions)?;
        }
    }
}

fn stays<R: Real>(volume: &Volume, how: Reconstruction, positions: &[DVec3]) -> Result<(), TestCaseError> {
    let field = Field::<R>::new(volume, how, Rung::Value).unwrap();
    let bricks = field.bricks();
    for &p in positions {
        let q = Vec3::from_glam(p);
        let (cell, value) = with_sampler!(field, |s| (s.cell(q), s.value(q).to_f64()));
        let [lo, hi] = bricks.ranges[bricks.of_cell(cell)];
        prop_assert!(lo <= value && value <= hi, "{:?} at {p}: {value} outside [{lo}, {hi}]", how.kernel);
        let [x, y, z] = cell.map(|i| i % BRICK);
        let [a, b] = field.cell_ranges(cell.map(|i| i / BRICK))[(z * BRICK + y) * BRICK + x];
        prop_assert!(a <= value && value <= b, "{:?} at {p}: {value} outside [{a}, {b}] of its cell", how.kernel);
        // Both are rounded outwards, in different orders.
        let rounding = 4.0 * R::EPSILON.to_f64() * lo.abs().max(hi.abs());
        let within = lo - rounding <= a && b <= hi + rounding;
        prop_assert!(within, "{:?}: [{a}, {b}] of cell {cell:?} outside [{lo}, {hi}]", how.kernel);
    }
    Ok(())
}

/// Cells read their own taps and no more: a jump between two planes is in the ranges of exactly the cells with taps on
/// both sides.
#[test]
fn ranges_of_cells_are_tight() {
    let grid = Grid::with_spacing([20, 9, 9], [1.0; 3]).unwrap();
    let voxels: Vec<f64> = indices([20, 9, 9]).map(|i| if i.x < 6.0 { 4.0 } else { 8.0 }).collect();
    let volume = Volume::new(grid, Voxels::F64(voxels), 1.0, 0.0).unwrap();
    for (kernel, before) in [(Kernel::Trilinear, 0), (Kernel::BsplineSmooth, 1), (Kernel::CatmullRom, 1)] {
        let how = Reconstruction { kernel, ..Default::default() };
        let field = Field::<f64>::new(&volume, how, Rung::Value).unwrap();
        let ranges = [[0, 0, 0], [1, 1, 1]].map(|brick| field.cell_ranges(brick));
        for x in 0..2 * BRICK {
            let [lo, hi] = ranges[x / BRICK][x % BRICK];
            // Taps from x − before to x + 1 + before.
            let jumps = x < 6 + before && x + 1 + before >= 6;
            assert_eq!(hi - lo > 1.0, jumps, "{kernel:?}, cell {x}: [{lo}, {hi}]");
        }
    }
}

/// Signs that go with the signs of Catmull–Rom's weights: the spline reaches 1.25³ of its samples' half-range.
#[test]
fn the_largest_overshoot_there_is() {
    let sign = |x: f64| if matches!(x as i32 % 4, 1 | 2) { 1.0 } else { -1.0 };
    let grid = Grid::with_spacing([8; 3], [1.0; 3]).unwrap();
    let voxels = indices([8; 3]).map(|i| sign(i.x) * sign(i.y) * sign(i.z)).collect();
    let volume = Volume::new(grid, Voxels::F64(voxels), 1.0, 0.0).unwrap();
    let how = Reconstruction { kernel: Kernel::CatmullRom, ..Default::default() };
    let field = Field::<f64>::new(&volume, how, Rung::Value).unwrap();
    let [lo, hi] = field.bricks().ranges[0];
    for (x, want) in [(1.5, 1.953125), (3.5, -1.953125)] {
        let value = with_sampler!(field, |s| s.value(Vec3::new(x, x, x)));
        assert_eq!(value, want);
        assert!(lo <= value && value <= hi);
    }
}

/// Ranges are not so wide that nothing is ever skipped: of a constant the range is the constant to a few places, and
/// trilinear ranges are those of the voxels.
#[test]
fn ranges_are_tight() {
    let grid = Grid::with_spacing([20, 9, 9], [1.0; 3]).unwrap();
    let voxels: Vec<f64> = indices([20, 9, 9]).map(|i| if i.x < 12.0 { 4.0 } else { 8.0 }).collect();
    let volume = Volume::new(grid, Voxels::F64(voxels), 1.0, 0.0).unwrap();
    let of = |kernel| {
        let how = Reconstruction { kernel, ..Default::default() };
        Field::<f64>::new(&volume, how, Rung::Value).unwrap().bricks()
    };
    let close = |[a, b]: [f64; 2], [c, d]: [f64; 2]| (a - c).abs() < 1e-6 && (b - d).abs() < 1e-6;
    let trilinear = of(Kernel::Trilinear);
    assert_eq!(trilinear.dims, [19, 8, 8].map(|cells: usize| cells.div_ceil(BRICK)));
    // The jump is in cell 11.
    for (brick, range) in trilinear.ranges[..trilinear.dims[0]].iter().enumerate() {
        let want = [if brick * BRICK <= 11 { 4.0 } else { 8.0 }, if (brick + 1) * BRICK > 11 { 8.0 } else { 4.0 }];
        assert!(close(*range, want), "{brick}: {range:?}");
    }
    assert!(close(of(Kernel::BsplineSmooth).ranges[0], [4.0, 4.0]));
    let catmull_rom = of(Kernel::CatmullRom);
    assert!(close(catmull_rom.ranges[0], [4.0, 4.0]));
    assert!(close(catmull_rom.ranges[11 / BRICK], [6.0 - 2.0 * 1.954, 6.0 + 2.0 * 1.954]));
}

/// a + 1·(b − a) is not b where b − a is rounded: at the last voxel, whose cell is the one before, samples leave the range
/// of the voxels on either side, and not that of the brick.
#[test]
fn what_rounding_adds_is_in_the_range() {
    fn beyond<R: Real>() -> [usize; 2] {
        let mut beyond = [0; 2];
        for i in 1..400 {
            let (a, b) = (R::from_f64(-0.37 * f64::from(i)).to_f64(), R::from_f64(1.0 / f64::from(i)).to_f64());
            for (a, b) in [(a, b), (-a, -b)] {
                let voxels = Voxels::F64([[a, b]; 4].concat());
                let volume = Volume::new(Grid::with_spacing([2; 3], [1.0; 3]).unwrap(), voxels, 1.0, 0.0).unwrap();
                let field = Field::<R>::new(&volume, Reconstruction::default(), Rung::Value).unwrap();
                let [lo, hi] = field.bricks().ranges[0];
                let value = with_sampler!(field, |s| s.value(Vec3::new(R::ONE, R::ZERO, R::ZERO)).to_f64());
                assert!(lo <= value && value <= hi, "{a} {b}: {value} outside [{lo}, {hi}]");
                beyond[0] += usize::from(value < a.min(b));
                beyond[1] += usize::from(value > a.max(b));
            }
        }
        beyond
    }
    for [below, above] in [beyond::<f64>(), beyond::<f32>()] {
        assert!(below > 20 && above > 20, "{below} {above}");
    }
}
