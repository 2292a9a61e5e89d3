//! The motion of a selection ([VS-2]).

use crate::document::check::Check;
use crate::document::declare::table;
use crate::document::describe::{Kind, Shape, Table};
use crate::document::fault::Problem;
use crate::document::item::Item;
use crate::document::kind::{Bounds, Number, Numbers, Rule};
use crate::document::out::Out;
use crate::math;
use crate::space::singular_values;
use glam::{DAffine3, DMat3, DVec3};
use serde_json::{Value as Json, json};

table! {
    /// The table `rotate` of an object.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Rotation {
        /// The axis, in world space, of any length.
        axis: DVec3 = DVec3::Z,
            key("VS-2", Numbers { what: "a direction [x, y, z]", bounds: Bounds::ANY, rule: Rule::Direction });
        /// The angle, right-handed about the axis.
        angle: f64 = 0.0, key("VS-2", Number { bounds: Bounds::ANY, unit: ", in degrees" });
    }
}

/// The description of `rotate`.
pub(crate) static ROTATION: Table<Rotation> =
    Rotation::description("rotate of an object", "A rotation about an axis through `center`.");

/// The affine motion M of a selection: M x = c + t + R·S·(x − c), or a matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// t: the way of the centre, in world units.
    pub shift: DVec3,
    /// The diagonal of S, on world axes. A negative factor reflects.
    pub scale: DVec3,
    /// R; none: no rotation.
    pub rotation: Option<Rotation>,
    /// c, in world space; none: the centre of the selection's box.
    pub center: Option<DVec3>,
    /// M itself by rows, in place of the others.
    pub matrix: Option<[[f64; 4]; 4]>,
}

impl Motion {
    /// No motion.
    pub const NONE: Self = Self { shift: DVec3::ZERO, scale: DVec3::ONE, rotation: None, center: None, matrix: None };

    /// Whether the scene gives the selection a motion. A rotation by 360° is a motion, too.
    pub fn is_moved(&self) -> bool {
        self.shift != DVec3::ZERO
            || self.scale != DVec3::ONE
            || self.rotation.is_some_and(|rotation| rotation.angle != 0.0)
            || self.matrix.is_some_and(|rows| rows != IDENTITY)
    }

    /// The linear part of M: R·S, or that of the matrix.
    pub fn linear(&self) -> DMat3 {
        if let Some(rows) = self.matrix {
            let row = |i: usize| DVec3::new(rows[i][0], rows[i][1], rows[i][2]);
            return DMat3::from_cols(row(0), row(1), row(2)).transpose();
        }
        self.rotation.map_or(DMat3::IDENTITY, |rotation| rotation.matrix()) * DMat3::from_diagonal(self.scale)
    }

    /// M for a selection whose box has this centre, in world space.
    pub fn map(&self, center: DVec3) -> DAffine3 {
        let linear = self.linear();
        let c = self.center.unwrap_or(center);
        let translation = match self.matrix {
            Some(rows) => DVec3::new(rows[0][3], rows[1][3], rows[2][3]),
            None => c + self.shift - linear * c,
        };
        DAffine3 { matrix3: linear, translation }
    }

    /// The motion that is an affine map.
    pub fn of(map: DAffine3) -> Self {
        let row = |i: usize| {
            let DVec3 { x, y, z } = map.matrix3.row(i);
            [x, y, z, map.translation[i]]
        };
        Self { matrix: Some([row(0), row(1), row(2), IDENTITY[3]]), ..Self::NONE }
    }

    /// Whether M has no inverse: M flattens space, or is not finite.
    pub fn is_singular(&self) -> bool {
        let linear = self.linear();
        let [largest, _, smallest] = singular_values(linear);
        !linear.is_finite() || smallest <= largest * 1e-12 || !linear.inverse().is_finite()
    }

    /// Reports a motion that is singular, of `moved`: an object or a mesh.
    pub(crate) fn check(&self, moved: &str, check: &mut Check) {
        if check.sound(&["scale", "rotate", "matrix"]) && self.is_singular() {
            let key = if self.matrix.is_some() { "matrix" } else { "scale" };
            let what = format!("the motion of {moved} is singular: it flattens space, or leaves the range of numbers");
            let remedy =
                "give it an inverse: no factor may be 0, 10¹² times smaller than another, or too large for its inverse"
                    .into();
            check.fault_in(key, Problem::Contradiction { what, remedy });
        }
    }
}

const IDENTITY: [[f64; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

impl Rotation {
    /// R = I + sin θ·K + (1 − cos θ)·K², K the cross product with the unit axis (Rodrigues).
    pub fn matrix(&self) -> DMat3 {
        // The axis may be so short or long that its square leaves f64.
        let n = (self.axis / self.axis.abs().max_element()).normalize();
        let (sin, cos) = (math::sin(self.angle.to_radians()), math::cos(self.angle.to_radians()));
        let k = DMat3::from_cols(DVec3::new(0.0, n.z, -n.y), DVec3::new(-n.z, 0.0, n.x), DVec3::new(n.y, -n.x, 0.0));
        DMat3::IDENTITY + k * sin + k * k * (1.0 - cos)
    }
}

/// A factor other than 0 for all axes, or one for each.
pub(crate) struct Factors;

const FACTOR: Number = Number { bounds: Bounds::ANY, unit: "" };
const FACTORS: Numbers<3> = Numbers { what: "three factors [x, y, z]", bounds: Bounds::ANY, rule: Rule::Free };

impl Shape for Factors {
    fn expected(&self) -> String {
        "a factor, or three [x, y, z]; none is 0".into()
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [FACTOR.schema(), FACTORS.schema()] })
    }
}

impl Kind for Factors {
    type Of = [f64; 3];

    fn read(&self, item: &Item, check: &mut Check) -> Option<[f64; 3]> {
        let one = item.number().filter(|x| x.is_finite()).map(|x| [x; 3]);
        let factors = one.or_else(|| FACTORS.of(item)).filter(|factors| factors.iter().all(|x| *x != 0.0));
        factors.or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &[f64; 3]) -> Out {
        if value[0] == value[1] && value[1] == value[2] { Out::Number(value[0]) } else { FACTORS.write(value) }
    }
}

/// Four rows of four numbers, the last 0 0 0 1.
pub(crate) struct Matrix;

const ROW: Numbers<4> = Numbers { what: "a row of four numbers", bounds: Bounds::ANY, rule: Rule::Free };

impl Shape for Matrix {
    fn expected(&self) -> String {
        "four rows of four numbers, the last [0, 0, 0, 1]".into()
    }

    fn schema(&self) -> Json {
        json!({ "type": "array", "items": ROW.schema(), "minItems": 4, "maxItems": 4 })
    }
}

impl Kind for Matrix {
    type Of = [[f64; 4]; 4];

    fn read(&self, item: &Item, check: &mut Check) -> Option<[[f64; 4]; 4]> {
        let rows: Option<Vec<[f64; 4]>> = item.list().and_then(|rows| rows.iter().map(|row| ROW.of(row)).collect());
        let rows: Option<[[f64; 4]; 4]> = rows.and_then(|rows| rows.try_into().ok());
        rows.filter(|rows| rows[3] == IDENTITY[3]).or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &[[f64; 4]; 4]) -> Out {
        Out::List(value.iter().map(|row| ROW.write(row)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moved(motion: Motion, center: DVec3, at: DVec3) -> DVec3 {
        motion.map(center).transform_point3(at)
    }

    /// By hand: scaled by 2 about (1, 1, 1), turned by 90° about z, moved by (0, 0, 5).
    #[test]
    fn scale_comes_before_rotation_and_shift() {
        let motion = Motion {
            shift: DVec3::new(0.0, 0.0, 5.0),
            scale: DVec3::splat(2.0),
            rotation: Some(Rotation { axis: DVec3::new(0.0, 0.0, 7.0), angle: 90.0 }),
            ..Motion::NONE
        };
        let c = DVec3::ONE;
        for (from, to) in [
            (c, DVec3::new(1.0, 1.0, 6.0)),
            (DVec3::new(2.0, 1.0, 1.0), DVec3::new(1.0, 3.0, 6.0)),
            (DVec3::new(1.0, 3.0, 1.0), DVec3::new(-3.0, 1.0, 6.0)),
        ] {
            assert!((moved(motion, c, from) - to).length() < 1e-15, "{from}");
        }
        // Another centre wins over the box's.
        let about = Motion { center: Some(DVec3::ZERO), shift: DVec3::ZERO, rotation: None, ..motion };
        assert_eq!(moved(about, c, c), DVec3::splat(2.0));
    }

    #[test]
    fn a_full_turn_is_a_motion_and_no_keys_are_none() {
        let turn = |angle| Motion { rotation: Some(Rotation { axis: DVec3::X, angle }), ..Motion::NONE };
        assert_eq!([0.0, 360.0, 1e-9].map(|angle| turn(angle).is_moved()), [false, true, true]);
        assert!(!Motion::NONE.is_moved());
        assert!(!Motion { matrix: Some(IDENTITY), ..Motion::NONE }.is_moved());
        assert!(Motion { scale: DVec3::new(1.0, 1.0, -1.0), ..Motion::NONE }.is_moved());
    }

    #[test]
    fn a_rotation_keeps_its_axis_and_lengths() {
        let rotation = Rotation { axis: DVec3::new(1e-200, 2e-200, -1e-200), angle: 37.0 };
        let (r, n) = (rotation.matrix(), DVec3::new(1.0, 2.0, -1.0).normalize());
        assert!((r * n - n).length() < 1e-15);
        assert!((r.determinant() - 1.0).abs() < 1e-15);
        let x = n.any_orthonormal_vector();
        let (along, across) = ((r * x).dot(x), (r * x).dot(n.cross(x)));
        assert!((along - 37f64.to_radians().cos()).abs() < 1e-15 && (across - 37f64.to_radians().sin()).abs() < 1e-15);
    }

    #[test]
    fn flat_and_endless_motions_are_singular() {
        let scaled = |x, y, z| Motion { scale: DVec3::new(x, y, z), ..Motion::NONE }.is_singular();
        assert!(!scaled(1.0, -1.0, 1.0) && !scaled(1e6, 1e6, 1e6) && !scaled(1e6, 1.0, 1e-3));
        assert!(scaled(1.0, 1e-13, 1.0) && scaled(f64::INFINITY, 1.0, 1.0));
        let flat = [[1.0, 2.0, 0.0, 5.0], [2.0, 4.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], IDENTITY[3]];
        assert!(Motion { matrix: Some(flat), ..Motion::NONE }.is_singular());
    }
}
