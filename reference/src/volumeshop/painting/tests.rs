use super::*;
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::space::Grid;
use drypoint_scene::tables::{Brush, Connectivity, PaintMode};
use drypoint_scene::volume::bricked::SIDE;
use drypoint_scene::volume::{Selection, Volume, Voxels};
use std::collections::BTreeSet;
use std::sync::Arc;

const BRUSHES: [Brush; 3] = [Brush::Gaussian, Brush::Ball, Brush::Box];

fn all_voxels(dims: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    (0..dims[2]).flat_map(move |z| (0..dims[1]).flat_map(move |y| (0..dims[0]).map(move |x| [x, y, z])))
}

/// Values in 0 … 99 of a deterministic scatter.
fn scatter([x, y, z]: [usize; 3]) -> u8 {
    ((x * 7919 + y * 104_729 + z * 1_299_709 + x * y * z * 31 + 13) % 1009 % 100) as u8
}

/// A volume on a sheared grid with three spacings.
fn volume(dims: [usize; 3], value: impl Fn([usize; 3]) -> u8) -> Volume {
    let axes = DMat3::from_cols(DVec3::new(1.0, 0.1, 0.0), DVec3::new(0.0, 1.5, -0.2), DVec3::new(0.3, 0.0, 2.0));
    let grid = Grid::new(dims, axes, DVec3::new(-3.0, 40.0, 7.0)).unwrap();
    Volume::new(grid, Voxels::U8(all_voxels(dims).map(value).collect()), 1.0, 0.0).unwrap()
}

fn world(volume: &Volume, voxel: [usize; 3]) -> DVec3 {
    volume.grid().to_world(DVec3::from_array(voxel.map(|i| i as f64)))
}

/// A dab at a voxel.
fn dab(volume: &Volume, voxel: [usize; 3], brush: Brush, radius: f64, mode: PaintMode) -> Dab {
    Dab { at: world(volume, voxel), radius, brush, mode }
}

#[test]
fn a_dab_has_the_brushes_membership_at_every_voxel() {
    let dims = [23, 19, 17];
    let volume = volume(dims, |_| 1);
    let painter = Painter::new(&volume, &|_| true);
    let centre = [9, 8, 10];
    for (brush, radius) in BRUSHES.into_iter().flat_map(|brush| [0.0, 0.93, 3.63, 9.13, 500.0].map(|r| (brush, r))) {
        let mut selection = Selection::nothing(&volume);
        let painted = painter.dab(&mut selection, &dab(&volume, centre, brush, radius, PaintMode::Add)).unwrap();
        let mut covered = 0;
        for voxel in all_voxels(dims) {
            // Written out from the definition, over the distance in the world.
            let offset = world(&volume, voxel) - world(&volume, centre);
            let (distance, side) = (offset.length(), offset.abs().max_element());
            let (b, margin) = match brush {
                _ if voxel == centre => (1.0, 1.0),
                Brush::Gaussian if distance <= radius => {
                    let sigma = radius / 3.0;
                    ((-0.5 * (distance / sigma).powi(2)).exp(), radius - distance)
                }
                Brush::Ball if distance <= radius => (1.0, radius - distance),
                Brush::Box if side <= radius => (1.0, radius - side),
                Brush::Box => (0.0, side - radius),
                _ => (0.0, distance - radius),
            };
            assert!(margin > 1e-9, "no voxel lies on the border of {brush:?} {radius}");
            let found = selection.memberships.value(voxel);
            assert!((found - b).abs() < 1e-12, "{brush:?} {radius} at {voxel:?}: {found}, not {b}");
            covered += usize::from(b > 0.0);
        }
        assert_eq!(painted.voxels, covered);
        assert!(radius != 0.0 || covered == 1);
        assert!(radius != 500.0 || covered == volume.grid().len());
    }
}

/// A dab is symmetric about its voxel, bit by bit, wherever in the voxel it was asked for.
#[test]
fn dabs_are_symmetric_about_the_nearest_voxel() {
    let dims = [21; 3];
    let volume = volume(dims, |_| 1);
    let painter = Painter::new(&volume, &|_| true);
    for brush in BRUSHES {
        let mut selection = Selection::nothing(&volume);
        let at = volume.grid().to_world(DVec3::new(10.3, 9.6, 10.5));
        painter.dab(&mut selection, &Dab { at, radius: 6.0, brush, mode: PaintMode::Add }).unwrap();
        for voxel in all_voxels(dims) {
            let opposite = voxel.map(|i| 20 - i);
            assert_eq!(selection.memberships.value(voxel), selection.memberships.value(opposite));
        }
        assert_eq!(selection.memberships.value([10; 3]), 1.0);
    }
}

#[test]
fn dabs_outside_reach_in_or_do_nothing() {
    let volume = volume([8; 3], |_| 1);
    let painter = Painter::new(&volume, &|_| true);
    let mut selection = Selection::nothing(&volume);
    let outside = volume.grid().to_world(DVec3::new(-2.0, 4.0, 4.0));
    let at = |at, radius| Dab { at, radius, brush: Brush::Ball, mode: PaintMode::Add };
    assert_eq!(painter.dab(&mut selection, &at(outside, 1.5)).unwrap(), Painted::default());
    assert_eq!(painter.dab(&mut selection, &at(DVec3::splat(1e300), 10.0)).unwrap(), Painted::default());
    assert_eq!(painter.dab(&mut selection, &at(DVec3::splat(-1e300), 0.0)).unwrap(), Painted::default());
    assert_eq!(painter.dab(&mut selection, &at(outside, 2.1)).unwrap(), Painted { voxels: 1, bricks: 1 });
    assert_eq!(selection.memberships.occupied(), Some([[0, 4, 4]; 2]));
    assert_eq!(painter.dab(&mut selection, &at(outside, 1e300)).unwrap(), Painted { voxels: 512, bricks: 1 });
}

#[test]
fn modes_compose_dab_on_dab() {
    let volume = volume([9; 3], |_| 1);
    let painter = Painter::new(&volume, &|_| true);
    let mut selection = Selection::nothing(&volume);
    let b = membership(Brush::Gaussian, volume.grid().axes().x_axis, 4.0).unwrap();
    let mut value = 0.0;
    let modes =
        [PaintMode::Add, PaintMode::Add, PaintMode::Add, PaintMode::Subtract, PaintMode::Maximum, PaintMode::Replace];
    for mode in [modes, modes].concat() {
        painter.dab(&mut selection, &dab(&volume, [4; 3], Brush::Gaussian, 4.0, mode)).unwrap();
        value = match mode {
            PaintMode::Add => f64::min(value + b, 1.0),
            PaintMode::Subtract => f64::max(value - b, 0.0),
            PaintMode::Maximum => f64::max(value, b),
            PaintMode::Replace => b,
        };
        assert_eq!(selection.memberships.value([5, 4, 4]), value);
        assert_eq!(selection.memberships.value([4; 3]), if mode == PaintMode::Subtract { 0.0 } else { 1.0 });
    }
}

/// No stroke changes a voxel that is not shown, whatever its membership.
#[test]
fn hidden_voxels_stay() {
    let dims = [18, 17, 16];
    let volume = volume(dims, scatter);
    let is_shown = |value: f64| value >= 40.0;
    let painter = Painter::new(&volume, &is_shown);
    let half = Volume::new(volume.grid().clone(), Voxels::F64(vec![0.5; volume.grid().len()]), 1.0, 0.0).unwrap();
    let mut selection = Selection::from_volume(&half).unwrap();
    let seed = all_voxels(dims).find(|&voxel| scatter(voxel) == 70).unwrap();
    let at = world(&volume, seed);
    painter.dab(&mut selection, &dab(&volume, [9; 3], Brush::Box, 500.0, PaintMode::Replace)).unwrap();
    let growth = Growth { at, tolerance: 1000.0, connect: Connectivity::Corners, mode: PaintMode::Subtract };
    painter.grow(&mut selection, &growth).unwrap();
    painter.watershed(&mut selection, &[Seed { at, mode: PaintMode::Add }]).unwrap();
    let hidden = all_voxels(dims).filter(|&voxel| !is_shown(f64::from(scatter(voxel))));
    assert!(hidden.into_iter().all(|voxel| selection.memberships.value(voxel) == 0.5));
    assert_eq!(selection.memberships.value(seed), 1.0);
}

#[test]
fn voxels_that_are_not_finite_stay() {
    let grid = Grid::with_spacing([3, 1, 1], [1.0; 3]).unwrap();
    let volume = Volume::new(grid, Voxels::F32(vec![1.0, f32::NAN, 1.0]), 1.0, 0.0).unwrap();
    let painter = Painter::new(&volume, &|_| true);
    let mut selection = Selection::nothing(&volume);
    let dab = Dab { at: DVec3::X, radius: 9.0, brush: Brush::Ball, mode: PaintMode::Add };
    assert_eq!(painter.dab(&mut selection, &dab).unwrap().voxels, 2);
    assert_eq!([0, 1, 2].map(|x| selection.memberships.value([x, 0, 0])), [1.0, 0.0, 1.0]);
}

/// The region as the least set that has the seed and with a voxel its accepted neighbours: sweeps until nothing changes.
fn flooded(
    dims: [usize; 3],
    seed: [usize; 3],
    most: usize,
    accepts: &dyn Fn([usize; 3]) -> bool,
) -> BTreeSet<[usize; 3]> {
    let mut region = BTreeSet::from([seed]);
    loop {
        let is_next = |voxel: &[usize; 3]| {
            let near = |other: &&[usize; 3]| {
                let apart: [usize; 3] = std::array::from_fn(|a| voxel[a].abs_diff(other[a]));
                apart.iter().all(|&d| d <= 1) && apart.iter().sum::<usize>() <= most
            };
            !region.contains(voxel) && accepts(*voxel) && region.iter().find(near).is_some()
        };
        let next: Vec<[usize; 3]> = all_voxels(dims).filter(is_next).collect();
        if next.is_empty() {
            return region;
        }
        region.extend(next);
    }
}

#[test]
fn a_grown_region_is_the_connected_part_of_similar_values() {
    let dims = [9, 8, 7];
    let volume = volume(dims, scatter);
    let is_shown = |value: f64| value >= 10.0;
    let painter = Painter::new(&volume, &is_shown);
    let mut sizes = BTreeSet::new();
    for (connect, most) in [(Connectivity::Faces, 1), (Connectivity::Edges, 2), (Connectivity::Corners, 3)] {
        for (i, tolerance) in [0.0, 12.0, 25.0, 40.0, 100.0].into_iter().enumerate() {
            let seed = all_voxels(dims).filter(|&voxel| scatter(voxel) >= 10).nth(37 * i + most).unwrap();
            let accepts = |voxel| {
                let value = f64::from(scatter(voxel));
                is_shown(value) && (value - f64::from(scatter(seed))).abs() <= tolerance
            };
            let want = flooded(dims, seed, most, &accepts);
            let mut selection = Selection::nothing(&volume);
            let growth = Growth { at: world(&volume, seed), tolerance, connect, mode: PaintMode::Add };
            let painted = painter.grow(&mut selection, &growth).unwrap();
            assert_eq!(painted.voxels, want.len());
            for voxel in all_voxels(dims) {
                assert_eq!(selection.memberships.value(voxel), f64::from(u8::from(want.contains(&voxel))));
            }
            sizes.insert(want.len());
        }
    }
    assert!(sizes.len() > 5, "{sizes:?}");
}

#[test]
fn seeds_outside_and_hidden_seeds_are_errors() {
    let volume = volume([4; 3], |[x, ..]| x as u8);
    let painter = Painter::new(&volume, &|value| value > 0.0);
    let mut selection = Selection::nothing(&volume);
    let mut seeds = |at: [f64; 3]| {
        let at = volume.grid().to_world(DVec3::from_array(at));
        let growth = Growth { at, tolerance: 0.0, connect: Connectivity::Faces, mode: PaintMode::Add };
        let seeds = [Seed { at: world(&volume, [2; 3]), mode: PaintMode::Add }, Seed { at, mode: PaintMode::Add }];
        let watershed = painter.watershed(&mut selection, &seeds).map(|painted| painted.voxels);
        (painter.grow(&mut selection, &growth).map(|painted| painted.voxels), watershed)
    };
    assert_eq!(seeds([0.0, 1.0, 1.0]), (Err(PaintError::Hidden(0)), Err(PaintError::Hidden(1))));
    assert_eq!(seeds([3.6, 1.0, 1.0]), (Err(PaintError::Outside(0)), Err(PaintError::Outside(1))));
    assert_eq!(seeds([3.4, 1.0, 1.0]), (Ok(16), Ok(48)));
}

/// A voxel's basin has a path to it whose highest point is as low as that of the best path from any marker: floods rise
/// through the lowest passes.
#[test]
fn floods_come_through_the_lowest_pass() {
    let dims = [8, 7, 6];
    let (nx, ny) = (dims[0], dims[1]);
    let relief = |voxel| f64::from(scatter(voxel));
    let passes = |voxel: [usize; 3]| !scatter(voxel).is_multiple_of(7);
    let markers: Vec<Marker> = all_voxels(dims)
        .filter(|&voxel| passes(voxel))
        .step_by(61)
        .take(4)
        .enumerate()
        .map(|(i, voxel)| Marker { voxel, basin: i as u32 + 1 })
        .collect();
    let found = basins(dims, &markers, &passes, &mut |voxel| relief(voxel)).unwrap();
    // The lowest highest point of paths from each marker, by relaxation over all pairs of neighbours.
    let pass_heights: Vec<Vec<f64>> = markers
        .iter()
        .map(|marker| {
            let mut heights = vec![f64::INFINITY; found.len()];
            let index = |[x, y, z]: [usize; 3]| (z * ny + y) * nx + x;
            heights[index(marker.voxel)] = relief(marker.voxel);
            loop {
                let mut changed = false;
                for voxel in all_voxels(dims).filter(|&voxel| passes(voxel)) {
                    for other in all_voxels(dims) {
                        let apart: usize = (0..3).map(|a| voxel[a].abs_diff(other[a])).sum();
                        let height = heights[index(other)].max(relief(voxel));
                        if apart == 1 && height < heights[index(voxel)] {
                            heights[index(voxel)] = height;
                            changed = true;
                        }
                    }
                }
                if !changed {
                    return heights;
                }
            }
        })
        .collect();
    for (i, &basin) in found.iter().enumerate() {
        let lowest = pass_heights.iter().map(|heights| heights[i]).fold(f64::INFINITY, f64::min);
        match basin {
            0 => assert_eq!(lowest, f64::INFINITY),
            basin => assert_eq!(pass_heights[basin as usize - 1][i], lowest),
        }
    }
    assert!((1..=4).all(|basin| found.contains(&basin)));
}

/// Two plateaus with a ramp between them: basins part at the steepest slope, and each takes its own mode.
#[test]
fn basins_part_at_the_steepest_slope() {
    let steps = [10, 10, 12, 16, 40, 64, 68, 70, 70];
    let volume = volume([9, 5, 5], |[x, ..]| steps[x]);
    let painter = Painter::new(&volume, &|_| true);
    let mut selection = Selection::nothing(&volume);
    let seed = |x, mode| Seed { at: world(&volume, [x, 2, 2]), mode };
    let seeds = [seed(0, PaintMode::Subtract), seed(8, PaintMode::Add)];
    assert_eq!(painter.watershed(&mut selection, &seeds).unwrap().voxels, 225);
    let line: Vec<f64> = (0..9).map(|x| selection.memberships.value([x, 2, 2])).collect();
    assert_eq!((line[..4].to_vec(), line[5..].to_vec()), (vec![0.0; 4], vec![1.0; 4]));
}

/// A dab replaces the bricks in which it changes a voxel, and no other.
#[test]
fn dabs_touch_only_their_bricks() {
    let dims = [6 * SIDE; 3];
    let grid = Grid::with_spacing(dims, [1.0; 3]).unwrap();
    let volume = Volume::new(grid, Voxels::U8(vec![1; dims.iter().product()]), 1.0, 0.0).unwrap();
    let painter = Painter::new(&volume, &|_| true);
    let mut selection = Selection::nothing(&volume);
    for i in 0..40usize {
        let at: [usize; 3] = std::array::from_fn(|a| (i * [37, 53, 71][a] + 11 * a) % dims[a]);
        let radius = 1 + i % 7;
        let before = selection.memberships.table().clone();
        let dab = dab(&volume, at, BRUSHES[i % 3], radius as f64, PaintMode::Add);
        let painted = painter.dab(&mut selection, &dab).unwrap();
        let after = selection.memberships.table();
        let replaced: BTreeSet<usize> = (0..before.len()).filter(|&k| !Arc::ptr_eq(&before[k], &after[k])).collect();
        // Voxels about the centre that were not full before.
        let near = |a: usize| at[a].saturating_sub(radius)..=(at[a] + radius).min(dims[a] - 1);
        let mut want = BTreeSet::new();
        for (z, y) in near(2).flat_map(|z| near(1).map(move |y| (z, y))) {
            for x in near(0) {
                let offset = DVec3::from_array(std::array::from_fn(|a| [x, y, z][a] as f64 - at[a] as f64));
                let brick = (z / SIDE * 6 + y / SIDE) * 6 + x / SIDE;
                let old = before[brick].voxels()[(z % SIDE * SIDE + y % SIDE) * SIDE + x % SIDE];
                if membership(dab.brush, offset, dab.radius).is_some() && old < 1.0 {
                    want.insert(brick);
                }
            }
        }
        assert_eq!(replaced, want, "dab {i}");
        assert_eq!(painted.bricks, want.len());
    }
}
