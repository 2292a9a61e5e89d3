//! Moves of the camera, as closed forms of what was dragged, and the keys that they change.
//!
//! A pose keeps the point that the camera turns about, its focus, on the axis of the view at the depth of
//! `camera.target`. A drag of n pixels is one of the picture's pixels, whatever size it has on the screen.

use crate::document::Edit;
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Camera, Projection};
use drypoint::scene::view::{View, ViewError};
use drypoint::scene::volume::Anatomy;
use toml_edit::{Array, Value};

/// Decimals of a direction in a scene file: an angle of 10⁻⁶.
const DECIMALS: i32 = 6;

/// A camera with the point that it turns about.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    /// The camera in numbers.
    pub view: View,
    /// The point that stays in the middle of the picture when the camera turns, in the world.
    pub focus: DVec3,
    /// The key `camera.up`.
    pub up: DVec3,
}

/// A view from a side of the volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// From the front, the anterior side: the viewer faces the patient.
    Front,
    /// From the back, the posterior side.
    Back,
    /// From the patient's left.
    Left,
    /// From the patient's right.
    Right,
    /// From above, the superior side, with the front at the top of the picture.
    Top,
    /// From below, the inferior side, with the front at the top of the picture.
    Bottom,
}

impl Side {
    /// All sides.
    pub const ALL: [Self; 6] = [Self::Front, Self::Back, Self::Left, Self::Right, Self::Top, Self::Bottom];

    /// Returns the direction in which the camera looks and its up. A world without a name is taken as
    /// right-anterior-superior.
    pub fn directions(self, anatomy: Option<Anatomy>) -> [DVec3; 2] {
        let initials = anatomy.unwrap_or(Anatomy::RightAnteriorSuperior).initials();
        let right = if initials.starts_with('R') { DVec3::X } else { -DVec3::X };
        let anterior = if initials[1..].starts_with('A') { DVec3::Y } else { -DVec3::Y };
        match self {
            Self::Front => [-anterior, DVec3::Z],
            Self::Back => [anterior, DVec3::Z],
            Self::Left => [right, DVec3::Z],
            Self::Right => [-right, DVec3::Z],
            Self::Top => [-DVec3::Z, anterior],
            Self::Bottom => [DVec3::Z, anterior],
        }
    }
}

impl Pose {
    /// The pose of a scene's camera over a volume, for a picture of `size` pixels.
    ///
    /// # Errors
    /// The errors of [`View::new`].
    pub fn new(camera: &Camera, grid: &Grid, size: [usize; 2]) -> Result<Self, ViewError> {
        let view = View::new(camera, grid, size)?;
        // With a direction beside an eye the target is unused.
        let target = camera.target.filter(|_| !camera.direction_given).unwrap_or_else(|| grid.centre());
        let depth = (target - view.eye).dot(view.forward);
        let least = if view.perspective { grid.voxel() } else { 0.0 };
        let focus = view.eye + view.forward * depth.max(least);
        // An up along the view is replaced by an axis.
        let is_along = camera.up.normalize_or_zero().cross(view.forward).length() < 1e-6;
        let up = if is_along { view.up } else { camera.up };
        Ok(Self { view, focus, up })
    }

    /// Returns the distance from the eye to the focus along the view.
    pub fn depth(&self) -> f64 {
        (self.focus - self.view.eye).dot(self.view.forward)
    }

    /// Returns the world units of a pixel at the focus.
    pub fn pixel(&self) -> f64 {
        self.view.pixel * if self.view.perspective { self.depth() } else { 1.0 }
    }

    /// Turns the camera about its focus: by `yaw` radians about `up`, after `pitch` about the picture's right.
    /// Past a pole `up` points the other way, so that a turn by 2π about either axis changes nothing.
    pub fn orbit(&self, yaw: f64, pitch: f64) -> Self {
        let turn = DMat3::from_axis_angle(self.up.normalize(), yaw) * DMat3::from_axis_angle(self.view.right, pitch);
        let view = View {
            eye: self.focus + turn * (self.view.eye - self.focus),
            right: turn * self.view.right,
            up: turn * self.view.up,
            forward: turn * self.view.forward,
            ..self.view.clone()
        };
        let up = if view.up.dot(self.up) < 0.0 { -self.up } else { self.up };
        Self { view, focus: self.focus, up }
    }

    /// Moves the camera in the picture's plane, so that points at the focus's depth move by pixels to the right and down.
    pub fn pan(&self, [x, y]: [f64; 2]) -> Self {
        let by = (self.view.up * y - self.view.right * x) * self.pixel();
        Self { view: View { eye: self.view.eye + by, ..self.view.clone() }, focus: self.focus + by, ..self.clone() }
    }

    /// Multiplies the distance to the focus by `factor`, or in an orthographic view the picture's height. The point at
    /// the focus's depth that is seen at a point of the picture, in pixels from its corner, stays there.
    pub fn dolly(&self, factor: f64, [x, y]: [f64; 2]) -> Self {
        let ray = self.view.ray(x, y);
        let fixed = ray.origin + ray.along * self.depth();
        if self.view.perspective {
            let toward = |p: DVec3| fixed + (p - fixed) * factor;
            let view = View { eye: toward(self.view.eye), ..self.view.clone() };
            Self { view, focus: toward(self.focus), ..self.clone() }
        } else {
            let by = (fixed - self.focus) * (1.0 - factor);
            let view = View { eye: self.view.eye + by, pixel: self.view.pixel * factor, ..self.view.clone() };
            Self { view, focus: self.focus + by, ..self.clone() }
        }
    }

    /// Turns the camera about its focus until it looks along `forward`.
    pub fn look(&self, [forward, up]: [DVec3; 2]) -> Self {
        let right = forward.cross(up).normalize();
        let eye = self.focus - forward * self.depth();
        Self {
            view: View { eye, forward, right, up: right.cross(forward), ..self.view.clone() },
            focus: self.focus,
            up,
        }
    }

    /// Returns the edits of `[camera]` that lead from a scene's camera to this pose. A camera that was only turned, and
    /// whose eye the scene does not give, keeps the distance at which the whole volume is seen.
    pub fn edits(&self, camera: &Camera, from: &Self) -> Vec<Edit> {
        let mut edits = Vec::new();
        let direction = || Edit::set("camera.direction", numbers(self.view.forward, DECIMALS));
        // A thousandth of a pixel.
        let decimals = 3 + (-self.pixel().log10()).ceil().clamp(-3.0, 12.0) as i32;
        let point = |key, p| Edit::set(key, numbers(p, decimals));
        let is_moved = self.focus != from.focus || self.depth() != from.depth();
        match camera.eye {
            None if !is_moved && self.view.pixel == from.view.pixel => edits.push(direction()),
            // Without an eye an orthographic camera stands at its target.
            None if !self.view.perspective => edits.extend([point("camera.target", self.focus), direction()]),
            _ => {
                edits.extend([point("camera.eye", self.view.eye), point("camera.target", self.focus)]);
                edits.push(Edit::remove("camera.direction"));
            }
        }
        if let Projection::Orthographic { .. } = camera.projection
            && self.view.pixel != from.view.pixel
        {
            let height = self.view.pixel * self.view.size[1] as f64;
            edits.push(Edit::set("camera.height", rounded(height, decimals)));
        }
        if self.up != camera.up {
            edits.push(Edit::set("camera.up", numbers(self.up, DECIMALS)));
        }
        edits
    }
}

/// A number with at most so many decimals.
pub fn rounded(x: f64, decimals: i32) -> f64 {
    let unit = 10f64.powi(decimals);
    let rounded = (x * unit).round() / unit;
    // Without a minus before 0, and as it is where it is too large to be rounded.
    if rounded.is_finite() { rounded + 0.0 } else { x }
}

/// Decimals of a length, to a thousandth of a voxel.
pub(crate) fn decimals(grid: &Grid) -> i32 {
    3 - grid.voxel().log10().floor() as i32
}

/// A point of the world, to a thousandth of a voxel.
pub(crate) fn place(p: DVec3, grid: &Grid) -> Value {
    numbers(p, decimals(grid))
}

/// A list of three numbers, whole ones without a point.
pub(crate) fn numbers(v: DVec3, decimals: i32) -> Value {
    Value::Array(v.to_array().into_iter().map(|x| number(rounded(x, decimals))).collect::<Array>())
}

/// A number as a scene file writes it: a whole one without a point.
pub fn number(x: f64) -> Value {
    if x.fract() == 0.0 && x.abs() < 1e15 { (x as i64).into() } else { x.into() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    fn grid() -> Grid {
        Grid::with_spacing([11, 21, 31], [1.0, 0.5, 2.0]).unwrap()
    }

    fn poses() -> Vec<Pose> {
        let eye =
            |direction_given| Camera { eye: Some(DVec3::new(70.0, -30.0, 50.0)), direction_given, ..Camera::default() };
        let orthographic = Projection::Orthographic { height: None };
        let cameras = [
            Camera::default(),
            Camera { target: Some(DVec3::new(1.0, 2.0, 3.0)), up: DVec3::new(0.2, 1.0, 0.3), ..eye(false) },
            eye(true),
            Camera { projection: orthographic, ..Camera::default() },
            Camera { projection: orthographic, ..eye(false) },
        ];
        cameras.into_iter().map(|camera| Pose::new(&camera, &grid(), [90, 60]).unwrap()).collect()
    }

    fn near(a: DVec3, b: DVec3) -> bool {
        (a - b).length() < 1e-9
    }

    fn same(a: &Pose, b: &Pose) -> bool {
        let pairs = [
            (a.view.eye, b.view.eye),
            (a.view.right, b.view.right),
            (a.view.up, b.view.up),
            (a.view.forward, b.view.forward),
            (a.focus, b.focus),
            (a.up, b.up),
        ];
        pairs.into_iter().all(|(a, b)| near(a, b)) && (a.view.pixel - b.view.pixel).abs() < 1e-12
    }

    #[test]
    fn a_whole_turn_changes_nothing_and_half_a_turn_shows_the_back() {
        for pose in poses() {
            for [yaw, pitch] in [[TAU, 0.0], [0.0, TAU], [-TAU, TAU]] {
                assert!(same(&pose.orbit(yaw, pitch), &pose), "{yaw} {pitch}: {pose:?}");
            }
            let steps = (0..90).fold(pose.clone(), |pose, _| pose.orbit(0.0, TAU / 90.0));
            assert!(same(&steps, &pose), "{pose:?}");
            let back = pose.orbit(PI, 0.0);
            let axis = pose.up.normalize();
            let flat = |v: DVec3| v - axis * v.dot(axis);
            assert!(near(flat(back.view.forward), -flat(pose.view.forward)));
            assert_eq!(pose.view.point_of(pose.focus).map(|p| p.map(f64::round)), Some([45.0, 30.0]));
        }
    }

    /// The camera of a turned pose's keys is the turned view.
    #[test]
    fn keys_give_the_view() {
        for pose in poses() {
            for [yaw, pitch] in [[0.3, 0.2], [2.0, -3.0], [-1.0, 1.5]] {
                let turned = pose.orbit(yaw, pitch);
                let camera = Camera {
                    eye: Some(turned.view.eye),
                    target: Some(turned.focus + turned.view.forward),
                    up: turned.up,
                    projection: match turned.view.perspective {
                        true => Projection::Perspective { fov: 30.0 },
                        false => Projection::Orthographic { height: None },
                    },
                    ..Camera::default()
                };
                let view = View::new(&camera, &grid(), [90, 60]).unwrap();
                assert!(near(view.right, turned.view.right) && near(view.up, turned.view.up), "{yaw} {pitch}");
            }
        }
    }

    #[test]
    fn a_pan_moves_the_focus_by_what_was_dragged() {
        for pose in poses() {
            let panned = pose.pan([7.0, -4.5]);
            let seen = panned.view.point_of(pose.focus).unwrap();
            assert!((seen[0] - 52.0).abs() < 1e-9 && (seen[1] - 25.5).abs() < 1e-9, "{seen:?}");
            assert!((panned.depth() - pose.depth()).abs() < 1e-9);
        }
    }

    #[test]
    fn a_dolly_keeps_what_is_under_the_pointer() {
        for pose in poses() {
            let at = [80.0, 11.0];
            let ray = pose.view.ray(at[0], at[1]);
            let fixed = ray.origin + ray.along * pose.depth();
            let nearer = pose.dolly(0.7, at);
            let seen = nearer.view.point_of(fixed).unwrap();
            assert!((0..2).all(|i| (seen[i] - at[i]).abs() < 1e-9), "{seen:?}");
            assert!((nearer.pixel() / pose.pixel() - 0.7).abs() < 1e-12);
            assert!(same(&nearer.dolly(1.0 / 0.7, at), &pose));
        }
    }

    #[test]
    fn sides_of_a_patient() {
        use Anatomy::{LeftAnteriorSuperior, LeftPosteriorSuperior, RightAnteriorSuperior};
        // The viewer who faces the patient looks to posterior and sees the patient's left on the right.
        for (anatomy, posterior, left) in [
            (RightAnteriorSuperior, -DVec3::Y, -DVec3::X),
            (LeftPosteriorSuperior, DVec3::Y, DVec3::X),
            (LeftAnteriorSuperior, -DVec3::Y, DVec3::X),
        ] {
            let [forward, up] = Side::Front.directions(Some(anatomy));
            assert_eq!(forward, posterior);
            if anatomy != LeftAnteriorSuperior {
                assert_eq!(forward.cross(up), left);
            }
            assert_eq!(Side::Left.directions(Some(anatomy))[0], -left);
        }
        let pose = &poses()[0];
        for side in Side::ALL {
            let looked = pose.look(side.directions(None));
            assert_eq!(looked.view.forward, side.directions(None)[0]);
            assert!(near(looked.focus, pose.focus) && (looked.depth() - pose.depth()).abs() < 1e-9);
        }
    }
}
