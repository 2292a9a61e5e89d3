//! The views of the frames of `[orbit]` ([STIP-4]).

use super::View;
use crate::math;
use crate::space::Grid;
use crate::tables::{Camera, Orbit};
use glam::{DMat3, DVec3};

impl Orbit {
    /// The camera of a frame: `first`, the view that `camera` makes of a volume, turned as a whole about `camera.up` by
    /// `degrees`·frame/`frames`. The axis passes through the camera's target, or, without a target, through the centre
    /// of the volume's box. Frame 0 is `first` itself. Turns by multiples of 90° have an exact sine and cosine.
    pub fn view(&self, first: &View, camera: &Camera, grid: &Grid, frame: usize) -> View {
        let [cos, sin] = turn(self.degrees * frame as f64 / self.frames as f64);
        if [cos, sin] == [1.0, 0.0] {
            return first.clone();
        }
        let largest = camera.up.abs().max_element();
        let axis = if largest > 0.0 { (camera.up / largest).normalize() } else { first.up };
        let target = camera.target.unwrap_or_else(|| grid.centre());
        let turned = rotation(axis, cos, sin);
        View {
            eye: target + turned * (first.eye - target),
            right: turned * first.right,
            up: turned * first.up,
            forward: turned * first.forward,
            ..*first
        }
    }
}

/// Cosine and sine of an angle in degrees. Quarter turns are subtracted first, so that multiples of 90° are exact.
fn turn(degrees: f64) -> [f64; 2] {
    // Both are exact: a remainder, and a difference of numbers less than a factor of 2 apart or else of a small multiple
    // of 90.
    let rest = degrees % 360.0;
    let quarters = (rest / 90.0).round_ties_even();
    let rest = (rest - 90.0 * quarters).to_radians();
    let (cos, sin) = (math::cos(rest), math::sin(rest));
    match (quarters as i64).rem_euclid(4) {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

/// The rotation about an axis of length 1 (Rodrigues), anticlockwise where the axis points at the viewer.
fn rotation(k: DVec3, cos: f64, sin: f64) -> DMat3 {
    let column = |v: DVec3| v * cos + k.cross(v) * sin + k * (k.dot(v) * (1.0 - cos));
    DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::Projection;

    fn first(camera: &Camera) -> (View, Grid) {
        let grid = Grid::with_spacing([11, 21, 31], [1.0; 3]).unwrap();
        (View::new(camera, &grid, [40, 30]).unwrap(), grid)
    }

    #[test]
    fn quarters_of_a_turn_are_exact() {
        for (degrees, wanted) in [
            (0.0, [1.0, 0.0]),
            (90.0, [0.0, 1.0]),
            (180.0, [-1.0, 0.0]),
            (270.0, [0.0, -1.0]),
            (-90.0, [0.0, -1.0]),
            (720.0, [1.0, 0.0]),
            (-450.0, [0.0, -1.0]),
        ] {
            assert_eq!(turn(degrees).map(|x| x + 0.0), wanted, "{degrees}");
        }
        // Others to what the conversion to radians loses, an ulp of an angle of at most 45°, and one of the result.
        for i in -100..100 {
            let degrees = 7.3 * f64::from(i);
            let wanted = [degrees.to_radians().cos(), degrees.to_radians().sin()];
            // The reduced angle is exact here, that of the comparison is not: 730° have an ulp of 2⁻⁴³ degrees.
            assert!(turn(degrees).iter().zip(wanted).all(|(a, b)| (a - b).abs() < 4e-15), "{degrees}");
        }
    }

    #[test]
    fn frame_0_is_the_camera_of_the_scene_and_so_is_a_full_turn() {
        let camera = Camera { direction: DVec3::new(0.2, 1.0, -0.3), ..Camera::default() };
        let (view, grid) = first(&camera);
        let orbit = Orbit { frames: 4, degrees: 360.0, ..Orbit::default() };
        assert_eq!(orbit.view(&view, &camera, &grid, 0), view);
        assert_eq!(orbit.view(&view, &camera, &grid, 4), view);
    }

    /// About z by 90°, (x, y) goes to (−y, x), to the bit: nothing is added but zeros.
    #[test]
    fn a_quarter_by_hand() {
        let target = DVec3::new(5.0, 10.0, 15.0);
        let camera = Camera { eye: Some(DVec3::new(5.0, -20.0, 15.0)), target: Some(target), ..Camera::default() };
        let (view, grid) = first(&camera);
        let turned = Orbit { frames: 4, degrees: 360.0, ..Orbit::default() }.view(&view, &camera, &grid, 1);
        assert_eq!(turned.eye, DVec3::new(35.0, 10.0, 15.0));
        assert_eq!((turned.forward, turned.right, turned.up), (DVec3::NEG_X, DVec3::Y, DVec3::Z));
    }

    /// The target stays where it is on the picture, all distances to it stay, and the frame stays right-handed.
    #[test]
    fn the_camera_turns_as_a_whole() {
        let orthographic = Projection::Orthographic { height: None };
        for projection in [Projection::Perspective { fov: 40.0 }, orthographic] {
            let target = DVec3::new(3.0, 1.0, 7.0);
            let up = DVec3::new(0.1, -2.0, 5.0);
            let camera = Camera { projection, target: Some(target), up, ..Camera::default() };
            let (view, grid) = first(&camera);
            let orbit = Orbit { frames: 7, degrees: -200.0, ..Orbit::default() };
            for frame in 1..7 {
                let turned = orbit.view(&view, &camera, &grid, frame);
                // A handful of roundings of numbers below 100.
                let near = |a: DVec3, b: DVec3| (a - b).length() < 1e-12;
                assert!(near(turned.to_eye(target), view.to_eye(target)));
                assert!(near(turned.right.cross(turned.up), -turned.forward));
                assert!((turned.forward.dot(up) - view.forward.dot(up)).abs() < 1e-12);
                assert!(!near(turned.forward, view.forward));
                // The same again as a camera with that eye and that up, in a volume that is turned too.
                let back =
                    rotation(up.normalize(), turn(200.0 * frame as f64 / 7.0)[0], turn(200.0 * frame as f64 / 7.0)[1]);
                assert!(near(back * turned.forward, view.forward) && near(back * turned.up, view.up));
            }
        }
    }
}
