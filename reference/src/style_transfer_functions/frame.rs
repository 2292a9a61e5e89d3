//! The frame in which a normal is looked up on the lit sphere ([STF-1]).

use crate::number::{Arithmetic, Real, Vec3};
use drypoint_scene::shot::SphereFrame;

/// N in the frame of the lit sphere. Its x and y are the coordinates of the lookup.
///
/// `eye` is the paper's frame: the eye-space normal itself. `view` first turns v onto +z by the smallest rotation, `R =
/// I + [w]ₓ + [w]ₓ²/(1 + v_z)` with `w = v × z`. N·v then is the z of the result, and silhouettes lie on the rim
/// anywhere in a perspective picture. If v = z, as in every orthographic view, both give the same bits.
///
/// `n` and `v` are unit vectors in eye space. v_z > −1 holds for everything in front of the eye.
#[inline]
pub fn on_sphere<R: Real>(frame: SphereFrame, n: Vec3<R>, v: Vec3<R>) -> Vec3<R> {
    match frame {
        SphereFrame::Eye => n,
        SphereFrame::View => {
            let (w, scale) = rotation(v);
            turned(n, w, scale)
        }
    }
}

/// w and 1/(1 + v_z) of the rotation for `view`.
#[inline(always)]
pub(crate) fn rotation<R: Real>(v: Vec3<R>) -> (Vec3<R>, R) {
    (Vec3::new(v.y, -v.x, R::ZERO), R::ONE / (R::ONE + v.z))
}

/// Applies the rotation to a normal.
#[inline(always)]
pub(crate) fn turned<A: Arithmetic>(n: Vec3<A>, w: Vec3<A>, scale: A) -> Vec3<A> {
    let turned = w.cross(n);
    n + turned + w.cross(turned) * scale
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const Z: Vec3<f64> = Vec3 { x: 0.0, y: 0.0, z: 1.0 };

    fn unit(x: f64, y: f64, z: f64) -> Vec3<f64> {
        let v = Vec3::new(x, y, z);
        v * (1.0 / v.length())
    }

    #[test]
    fn by_hand() {
        // v = (0, 0.6, 0.8) turns about x: (x, y, z) becomes (x, 0.8y − 0.6z, 0.6y + 0.8z).
        let v = Vec3::new(0.0, 0.6, 0.8);
        let expected = [
            (Vec3::new(1.0, 0.0, 0.0), [1.0, 0.0, 0.0]),
            (Vec3::new(0.0, 1.0, 0.0), [0.0, 0.8, 0.6]),
            (Z, [0.0, -0.6, 0.8]),
        ];
        for (n, [x, y, z]) in expected {
            assert!((on_sphere(SphereFrame::View, n, v) - Vec3::new(x, y, z)).length() < 1e-15);
        }
    }

    #[test]
    fn both_frames_are_the_same_bits_where_the_view_is_straight() {
        for n in [unit(0.3, -0.4, 0.1), unit(1.0, 0.0, 0.0), unit(-0.2, 0.9, -0.7), Z] {
            assert_eq!(on_sphere(SphereFrame::View, n, Z), on_sphere(SphereFrame::Eye, n, Z));
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]
        /// A rotation that takes v to z: lengths and angles stay, N·v is the z of the result, and what is normal to
        /// both v and z does not move.
        #[test]
        fn it_is_the_smallest_rotation_of_v_onto_z(
            x in -3.0..3.0f64, y in -3.0..3.0f64, n in prop::array::uniform3(-1.0..1.0f64),
        ) {
            prop_assume!(n[0].abs() + n[1].abs() + n[2].abs() > 1e-3);
            let (v, n) = (unit(x, y, 1.0), unit(n[0], n[1], n[2]));
            let turn = |a| on_sphere(SphereFrame::View, a, v);
            prop_assert!((turn(v) - Z).length() < 1e-15);
            prop_assert!((turn(n).length() - 1.0).abs() < 1e-15);
            prop_assert!((turn(n).z - n.dot(v)).abs() < 1e-15);
            let axis = Vec3::new(v.y, -v.x, 0.0);
            prop_assert!((turn(axis) - axis).length() < 1e-15);
            // Silhouettes lie on the rim.
            let tangent = n - v * n.dot(v);
            prop_assume!(tangent.length() > 1e-3);
            let edge = turn(tangent * (1.0 / tangent.length()));
            prop_assert!((edge.x.hypot(edge.y) - 1.0).abs() < 1e-14);
        }
    }
}
