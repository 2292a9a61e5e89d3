//! The upright direction of an object and the direction from which it is viewed.

use super::content::VolumeContent;
use drypoint_scene::glam::DVec3;
use drypoint_scene::volume::{Anatomy, Volume};

/// The orientation of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stance {
    /// The viewing direction.
    pub direction: DVec3,
    /// The direction that is up in the picture.
    pub up: DVec3,
}

/// Ratio of cuts by which an object stands on a face of its box: it continues beyond this face this many times more
/// than beyond any other.
const FOOT: f64 = 1.5;
/// Least share of the face that such a cut covers.
const SIZE: f64 = 0.02;
/// Ratio of the neck to the widest slice up to which an object is a bust. A bust that the last slices cut is upside
/// down in the file.
const NECK: f64 = 0.6;
/// Ratio of the shortest to the longest extent up to which an object is flat.
const FLAT: f64 = 0.4;

impl Stance {
    /// Chooses the stance. A patient stands upright and is seen from the front, half from the side. Any other object
    /// stands on the face of the box that cuts it, or else the last axis is up. It is seen over a corner, a flat
    /// object from its broad side.
    pub(super) fn of(volume: &Volume, body: &VolumeContent) -> Self {
        let front = match volume.anatomy() {
            Some(Anatomy::RightAnteriorSuperior) => DVec3::new(-0.7, -1.0, -0.25),
            Some(Anatomy::LeftPosteriorSuperior) => DVec3::new(0.7, 1.0, -0.25),
            Some(Anatomy::LeftAnteriorSuperior) => DVec3::new(0.7, -1.0, -0.25),
            None => return Self::of_a_thing(volume, body),
        };
        Self { direction: front, up: DVec3::Z }
    }

    fn of_a_thing(volume: &Volume, body: &VolumeContent) -> Self {
        let grid = volume.grid();
        let axes = [0, 1, 2].map(|a| grid.axes().col(a).normalize());
        let extent = extent(volume, body);
        let cuts = cuts(volume, body);
        let (up, upwards) = standing(body, &cuts);
        let longest = extent.into_iter().fold(0.0, f64::max);
        let flat = |a: usize| extent[a] < FLAT * longest;
        // The view is along y if z is up and along z if y is up: the picture is that of a slice, turned.
        let (mut along, mut across) = if up == 2 {
            (1, 0)
        } else if up == 1 {
            (2, 0)
        } else {
            (1, 2)
        };
        if flat(across) && !flat(along) {
            (along, across) = (across, along);
        }
        // The view comes from the side that is cut less. Between equals it follows the axis if z is up, and runs against
        // the axis otherwise.
        let [near, far] = cuts[along];
        let forwards = if near > FOOT * far && near > SIZE {
            false
        } else if far > FOOT * near && far > SIZE {
            true
        } else {
            up == 2
        };
        let signed = |a: usize, positive: bool| if positive { axes[a] } else { -axes[a] };
        let (up, ahead, aside) = (signed(up, upwards), signed(along, forwards), axes[across]);
        let lies_flat = |v: DVec3| axes.iter().zip(extent).any(|(a, e)| a.dot(v).abs() > 0.99 && e < FLAT * longest);
        if lies_flat(up) {
            return Self { direction: ahead * 0.5 - aside * 0.25 - up, up: ahead };
        }
        let turn = if lies_flat(ahead) { 0.3 } else { 0.6 };
        Self { direction: ahead - aside * turn - up * 0.45, up }
    }
}

/// The axis that is up, and whether its end is the upper side.
fn standing(body: &VolumeContent, cuts: &[[f64; 2]; 3]) -> (usize, bool) {
    let faces = (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]);
    let (axis, side) =
        faces.clone().fold((2, 0), |best, face| if cuts[face.0][face.1] > cuts[best.0][best.1] { face } else { best });
    let foot = cuts[axis][side];
    let others = faces.filter(|face| *face != (axis, side)).map(|(a, s)| cuts[a][s]).fold(0.0, f64::max);
    if foot < SIZE || foot < FOOT * others {
        return (2, true);
    }
    if side == 0 {
        return (axis, true);
    }
    let slices = body.slices(axis);
    let widest = slices.iter().copied().fold(0.0, f64::max);
    if slices[slices.len() - 1] < NECK * widest { (axis, false) } else { (2, true) }
}

/// Share of each of the box's faces that content covers: first and last face of each axis.
fn cuts(volume: &Volume, body: &VolumeContent) -> [[f64; 2]; 3] {
    let dims = volume.dims();
    [0, 1, 2].map(|axis| {
        let slices = body.slices(axis);
        let face = dims.iter().product::<usize>() as f64 / dims[axis] as f64;
        [slices[0] / face, slices[slices.len() - 1] / face]
    })
}

/// Lengths of the content along the axes, in world units.
fn extent(volume: &Volume, body: &VolumeContent) -> [f64; 3] {
    let spacing = volume.grid().spacing();
    [0, 1, 2].map(|axis| {
        let slices = body.slices(axis);
        let first = slices.iter().position(|n| *n > 0.0).unwrap_or(0);
        let last = slices.iter().rposition(|n| *n > 0.0).unwrap_or(0);
        (last - first + 1) as f64 * spacing[axis]
    })
}

#[cfg(test)]
mod tests {
    use super::super::content::ContentRange;
    use super::super::tests::volume;
    use super::*;
    use drypoint_scene::shot::Outside;

    const INSIDE: ContentRange = ContentRange { value: 0.5, outside: Outside::Low };

    /// The stance of an object in 32³ voxels.
    fn stance(inside: impl Fn([f64; 3]) -> bool) -> Stance {
        let v = volume(|p| if inside(p.map(|i| i as f64)) { 1.0 } else { 0.0 });
        Stance::of(&v, &VolumeContent::of(&v, INSIDE).unwrap())
    }

    fn ball([x, y, z]: [f64; 3], centre: [f64; 3], r: f64) -> bool {
        (x - centre[0]).powi(2) + (y - centre[1]).powi(2) + (z - centre[2]).powi(2) < r * r
    }

    #[test]
    fn a_ball_has_z_up() {
        let s = stance(|p| ball(p, [16.0; 3], 9.0));
        assert_eq!(s.up, DVec3::Z);
        assert!(s.direction.y > 0.0 && s.direction.z < 0.0);
    }

    #[test]
    fn a_bust_stands_on_its_neck() {
        // A head whose crown is the first slice, and whose neck continues beyond the last.
        let s =
            stance(|p| ball(p, [16.0, 16.0, 12.0], 10.0) || ((p[0] - 16.0).hypot(p[1] - 16.0) < 4.0 && p[2] > 12.0));
        assert_eq!(s.up, -DVec3::Z);
        assert!(s.direction.z > 0.0, "seen from above its crown");
        // A leg that widens to its cut is not a bust: it stands on its foot, the narrow end.
        let leg = stance(|p| (p[0] - 16.0).hypot(p[1] - 16.0) < 3.0 + 0.2 * p[2] && p[2] > 2.0);
        assert_eq!(leg.up, DVec3::Z);
    }

    #[test]
    fn a_tree_stands_on_its_pot_and_turns_its_cut_side_away() {
        let s = stance(|p| {
            let pot = p[1] < 8.0 && (p[0] - 16.0).hypot(p[2] - 22.0) < 12.0;
            pot || ((p[0] - 16.0).hypot(p[2] - 20.0) < 2.0 && p[1] < 28.0)
        });
        assert_eq!(s.up, DVec3::Y);
        assert!(s.direction.z > 0.0 && s.direction.y < 0.0, "{s:?}");
    }

    #[test]
    fn a_plate_is_seen_from_its_broad_side() {
        let lying = stance(|p| (p[2] - 16.0).abs() < 3.0 && p[0] > 2.0 && p[1] > 2.0 && p[0] < 30.0 && p[1] < 30.0);
        assert!(lying.direction.normalize().z < -0.8 && lying.up == DVec3::Y, "{lying:?}");
        let standing = stance(|p| (p[0] - 16.0).abs() < 3.0 && p[1] > 2.0 && p[2] > 2.0 && p[1] < 30.0 && p[2] < 30.0);
        assert!(standing.direction.normalize().x.abs() > 0.8 && standing.up == DVec3::Z, "{standing:?}");
    }

    #[test]
    fn patients_stand_upright_and_look_at_us() {
        for (anatomy, front) in [
            (Anatomy::RightAnteriorSuperior, -DVec3::Y),
            (Anatomy::LeftPosteriorSuperior, DVec3::Y),
            (Anatomy::LeftAnteriorSuperior, -DVec3::Y),
        ] {
            let v = volume(|_| 1.0).with_anatomy(Some(anatomy));
            let s = Stance::of(&v, &VolumeContent::of(&v, INSIDE).unwrap());
            assert!(s.up == DVec3::Z && s.direction.normalize().dot(front) > 0.7, "{anatomy:?}");
        }
    }
}
