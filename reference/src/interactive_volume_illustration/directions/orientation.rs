//! The sense in which a stroke's coordinate runs: the sign of its seed's direction ([HATCH-4]). Lines of curvature
//! have no global orientation; a reference field gives neighbours the same sense where it can.

use drypoint_scene::glam::DVec3;
use drypoint_scene::space::Grid;

/// |e·r| below which the reference decides nothing, and the size of a component of e that counts as 0.
const ACROSS: f64 = 1e-6;

/// A reference field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ReferenceField {
    /// a × (x − c).
    Cylindrical {
        /// The axis a, of any length.
        axis: DVec3,
        /// The centre c.
        center: DVec3,
    },
    /// a.
    Axial {
        /// The axis a, of any length.
        axis: DVec3,
    },
    /// x − c.
    Radial {
        /// The centre c.
        center: DVec3,
    },
}

impl ReferenceField {
    /// The field around the longest axis of a grid's box (the first of equals), through the box's centre.
    pub fn cylindrical(grid: &Grid) -> Self {
        Self::Cylindrical { axis: longest_axis(grid), center: grid.centre() }
    }

    /// Returns the direction at a place with the sign of the reference field. If the two are at right angles, the
    /// first nonzero component is made positive.
    pub fn signed(&self, direction: DVec3, x: DVec3) -> DVec3 {
        let reference = match *self {
            Self::Cylindrical { axis, center } => axis.normalize_or_zero().cross(x - center),
            Self::Axial { axis } => axis,
            Self::Radial { center } => x - center,
        };
        let along = direction.dot(reference.normalize_or_zero());
        let first = direction.to_array().into_iter().find(|c| c.abs() >= ACROSS).unwrap_or(1.0);
        let positive = if along.abs() < ACROSS { first > 0.0 } else { along > 0.0 };
        if positive { direction } else { -direction }
    }
}

/// The direction of the longest side of a grid's box, of length 1; the first of equals.
pub fn longest_axis(grid: &Grid) -> DVec3 {
    let axes = grid.axes();
    let sides = [0, 1, 2].map(|a| axes.col(a) * (grid.dims()[a] - 1) as f64);
    let longer = |a: DVec3, b: DVec3| if b.length() > a.length() { b } else { a };
    let longest = longer(longer(sides[0], sides[1]), sides[2]);
    // A single voxel has no side.
    longest.try_normalize().unwrap_or(DVec3::Z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn around_the_longest_axis() {
        let grid = Grid::with_spacing([11, 21, 6], [1.0, 1.0, 5.0]).unwrap();
        let around = ReferenceField::cylindrical(&grid);
        assert_eq!(around, ReferenceField::Cylindrical { axis: DVec3::Z, center: DVec3::new(5.0, 10.0, 12.5) });
        // Anticlockwise about z, in all four quadrants.
        for (x, want) in [(9.0, DVec3::Y), (1.0, DVec3::NEG_Y)] {
            let place = DVec3::new(x, 10.0, 3.0);
            assert_eq!([around.signed(DVec3::Y, place), around.signed(DVec3::NEG_Y, place)], [want; 2]);
        }
        // The other family is across it: its first component decides.
        let place = DVec3::new(9.0, 10.0, 3.0);
        assert_eq!(around.signed(DVec3::NEG_Z, place), DVec3::Z);
        // Rounding is no component.
        assert_eq!(around.signed(DVec3::new(-1e-9, 0.0, 1.0), place), DVec3::new(-1e-9, 0.0, 1.0));
        assert_eq!(around.signed(DVec3::NEG_X, grid.centre()), DVec3::X);
        let (axial, radial) =
            (ReferenceField::Axial { axis: DVec3::X * 7.0 }, ReferenceField::Radial { center: place });
        assert_eq!(axial.signed(DVec3::NEG_X, place), DVec3::X);
        assert_eq!(radial.signed(DVec3::X, DVec3::ZERO), DVec3::NEG_X);
    }
}
