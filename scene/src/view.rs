//! The camera in numbers: eye space, pixels and sample planes ([SPACE-3], [RAY-1], [RAY-5], [RAY-6]).

mod interaction;
mod orbit;

use crate::math;
use crate::space::Grid;
use crate::tables::{Camera, LightDirection, Projection};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A camera with every default of [RAY-5] filled in.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct View {
    /// World position of the origin of eye space.
    pub eye: DVec3,
    /// Eye space x in the world, a unit vector.
    pub right: DVec3,
    /// Eye space y in the world, a unit vector.
    pub up: DVec3,
    /// The way the camera looks, a unit vector in the world: minus eye space z.
    pub forward: DVec3,
    /// Whether rays meet in the eye.
    pub perspective: bool,
    /// p: the side of a pixel, in world units (orthographic) or at depth 1 (perspective).
    pub pixel: f64,
    /// Width and height of the picture in pixels.
    pub size: [usize; 2],
}

/// A fault of a camera that can see nothing.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ViewError {
    /// Eye and target are one point, or a direction has no length.
    #[error("the camera has no direction to look in")]
    NoDirection,
    /// `camera.height` is a length on the page ([SCN-2]); a scene file cannot say one.
    #[error("camera.height is a length on the page, not in the volume")]
    HeightOnPage,
}

/// One ray: p(s) = origin + s · along, s the eye depth of a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// World position at depth 0.
    pub origin: DVec3,
    /// World displacement for one unit of depth.
    pub along: DVec3,
    /// The cosine of the angle to the view axis.
    pub cos_phi: f64,
    /// v: the unit vector towards the eye, in eye space.
    pub v: DVec3,
}

impl View {
    /// Resolves a camera for a volume and a picture of `size` pixels.
    ///
    /// # Errors
    /// Eye and target at one point, a direction without length, or a height on the page.
    pub fn new(camera: &Camera, grid: &Grid, size: [usize; 2]) -> Result<Self, ViewError> {
        let [width, height] = size.map(|n| n as f64);
        let (target, r) = (camera.target.unwrap_or_else(|| grid.centre()), grid.radius());
        let looking = match camera.eye {
            Some(eye) if !camera.direction_given => target - eye,
            _ => camera.direction,
        };
        let forward = unit(looking).ok_or(ViewError::NoDirection)?;
        let (perspective, pixel, distance) = match camera.projection {
            Projection::Perspective { fov } => {
                let half = math::tan(fov.to_radians() / 2.0);
                // sin(½·min(vertical, horizontal field of view)) from the smaller tangent.
                let t = half * (width / height).min(1.0);
                (true, 2.0 * half / height, r * (1.0 + t * t).sqrt() / t)
            }
            Projection::Orthographic { height: given } => {
                let whole = 2.0 * r * (height / width).max(1.0);
                let world = given.map_or(Some(whole), |given| given.world(grid)).ok_or(ViewError::HeightOnPage)?;
                (false, world / height, 0.0)
            }
        };
        let eye = camera.eye.unwrap_or(target - forward * distance);
        let wanted_up = unit(camera.up).filter(|up| forward.cross(*up).length() >= 1e-6);
        let right = forward.cross(wanted_up.unwrap_or_else(|| least_axis(forward))).normalize();
        Ok(Self { eye, right, up: right.cross(forward), forward, perspective, pixel, size })
    }

    /// The ray through a point of the picture, in pixels from the top left corner: the centre of pixel (i, j) is
    /// (i + ½, j + ½).
    #[inline]
    pub fn ray(&self, i: f64, j: f64) -> Ray {
        let x = (i - self.size[0] as f64 / 2.0) * self.pixel;
        let y = (self.size[1] as f64 / 2.0 - j) * self.pixel;
        if self.perspective {
            let length = (1.0 + x * x + y * y).sqrt();
            let along = self.forward + self.right * x + self.up * y;
            Ray { origin: self.eye, along, cos_phi: 1.0 / length, v: DVec3::new(-x, -y, 1.0) / length }
        } else {
            let origin = self.eye + self.right * x + self.up * y;
            Ray { origin, along: self.forward, cos_phi: 1.0, v: DVec3::Z }
        }
    }

    /// The point of the picture at which a world position is seen, in the coordinates of [`ray`](Self::ray). None if
    /// the position is not in front of the eye.
    #[inline]
    pub fn point_of(&self, p: DVec3) -> Option<[f64; 2]> {
        let p = self.to_eye(p);
        let depth = if self.perspective { -p.z } else { 1.0 };
        let from_middle = [p.x, -p.y].map(|x| x / depth / self.pixel);
        (depth > 0.0).then(|| std::array::from_fn(|a| self.size[a] as f64 / 2.0 + from_middle[a]))
    }

    /// World to eye space, for directions.
    #[inline]
    pub fn direction_to_eye(&self, d: DVec3) -> DVec3 {
        DVec3::new(d.dot(self.right), d.dot(self.up), -d.dot(self.forward))
    }

    /// Eye to world space, for directions.
    pub fn direction_to_world(&self, d: DVec3) -> DVec3 {
        self.right * d.x + self.up * d.y - self.forward * d.z
    }

    /// World position to eye space.
    #[inline]
    pub fn to_eye(&self, p: DVec3) -> DVec3 {
        self.direction_to_eye(p - self.eye)
    }

    /// The unit vector towards a light, in world space. The head light is eye space's (0, 0, 1) at every sample, also in
    /// perspective.
    pub fn towards(&self, light: LightDirection) -> DVec3 {
        match light {
            LightDirection::Head => -self.forward,
            LightDirection::Eye(d) => self.direction_to_world(d.normalize()),
            LightDirection::World(d) => d.normalize(),
        }
    }

    /// The largest Δ_ray / Δ of the picture: 1/cosφ in its corner, 1 for orthographic views ([VAL-4]).
    pub fn largest_stretch(&self) -> f64 {
        1.0 / self.ray(0.0, 0.0).cos_phi
    }
}

/// A vector of length 1, from one of any finite length; none for the zero vector.
fn unit(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    (largest > 0.0 && largest.is_finite()).then(|| (v / largest).normalize())
}

/// The world axis with the smallest |component| in u, the first of equals ([RAY-6]).
fn least_axis(u: DVec3) -> DVec3 {
    let a = u.abs();
    if a.x <= a.y && a.x <= a.z {
        DVec3::X
    } else if a.y <= a.z {
        DVec3::Y
    } else {
        DVec3::Z
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::Length;

    fn grid() -> Grid {
        Grid::with_spacing([11, 11, 11], [1.0; 3]).unwrap()
    }

    #[test]
    fn the_default_perspective_sphere_touches_the_frame() {
        // The bounding sphere of the box is inscribed in the smaller field of view.
        let camera = Camera { direction: DVec3::new(0.0, 1.0, 0.0), ..Camera::default() };
        for size in [[100, 100], [200, 100], [100, 200]] {
            let view = View::new(&camera, &grid(), size).unwrap();
            let d = (view.eye - DVec3::splat(5.0)).length();
            let half = view.pixel * size[1].min(size[0]) as f64 / 2.0;
            let sine = half / (1.0 + half * half).sqrt();
            assert!((d * sine - grid().radius()).abs() < 1e-12, "{size:?}");
        }
    }

    #[test]
    fn pixels_of_an_orthographic_view() {
        let camera = Camera {
            projection: Projection::Orthographic { height: Some(Length::World(8.0)) },
            direction: DVec3::new(0.0, 1.0, 0.0),
            ..Camera::default()
        };
        let view = View::new(&camera, &grid(), [4, 4]).unwrap();
        // Looking along +y with z up, x runs to the right; a pixel is 2 units.
        let ray = view.ray(0.5, 0.5);
        assert_eq!(ray.origin, DVec3::new(5.0 - 3.0, 5.0, 5.0 + 3.0));
        assert_eq!(ray.along, DVec3::Y);
        assert_eq!(ray.v, DVec3::Z);
        assert_eq!(view.to_eye(DVec3::new(5.0, 6.0, 5.0)), DVec3::new(0.0, 0.0, -1.0));
    }

    /// Every point of a ray before the eye is seen where the ray goes through the picture.
    #[test]
    fn points_of_a_ray_are_seen_at_one_place() {
        for projection in [Projection::Perspective { fov: 40.0 }, Projection::Orthographic { height: None }] {
            let camera = Camera { projection, direction: DVec3::new(0.3, 1.0, -0.2), ..Camera::default() };
            let view = View::new(&camera, &grid(), [30, 20]).unwrap();
            for at in [[0.0, 0.0], [29.5, 3.25], [-7.0, 24.0]] {
                let ray = view.ray(at[0], at[1]);
                for depth in [0.125, 1.0, 90.0] {
                    let seen = view.point_of(ray.origin + ray.along * depth).unwrap();
                    assert!((0..2).all(|a| (seen[a] - at[a]).abs() < 1e-10), "{seen:?} {at:?}");
                }
            }
            let behind = view.point_of(view.eye - view.forward);
            assert_eq!(behind.is_some(), !view.perspective);
        }
    }

    #[test]
    fn a_height_in_voxels_is_one_in_world_units() {
        // Spacings of 2, 3 and ½: a voxel is the smallest of them ([SPACE-5]).
        let grid = Grid::with_spacing([5, 5, 5], [2.0, 3.0, 0.5]).unwrap();
        let view = |height| {
            let camera = Camera { projection: Projection::Orthographic { height: Some(height) }, ..Camera::default() };
            View::new(&camera, &grid, [7, 10])
        };
        assert_eq!(view(Length::Voxels(300.0)), view(Length::World(150.0)));
        assert_eq!(view(Length::Voxels(300.0)).unwrap().pixel, 15.0);
        for page in [Length::Millimetres(80.0), Length::Pixels(80.0), Length::Percent(80.0)] {
            assert_eq!(view(page), Err(ViewError::HeightOnPage));
        }
    }

    #[test]
    fn eye_and_direction_together_leave_the_target_unused() {
        let camera = Camera {
            eye: Some(DVec3::new(1.0, 2.0, 3.0)),
            direction: DVec3::X,
            direction_given: true,
            target: Some(DVec3::ZERO),
            ..Camera::default()
        };
        let view = View::new(&camera, &grid(), [2, 2]).unwrap();
        assert_eq!((view.eye, view.forward), (DVec3::new(1.0, 2.0, 3.0), DVec3::X));
        let towards = View::new(&Camera { direction_given: false, ..camera.clone() }, &grid(), [2, 2]).unwrap();
        assert!((towards.forward + camera.eye.unwrap().normalize()).length() < 1e-15);
    }

    #[test]
    fn looking_along_up_takes_the_axis_least_in_the_view() {
        let camera = Camera { direction: DVec3::new(0.0, 0.0, -2.0), ..Camera::default() };
        let view = View::new(&camera, &grid(), [2, 2]).unwrap();
        assert_eq!(view.up, DVec3::X);
        assert_eq!(view.right, DVec3::NEG_Z.cross(DVec3::X));
    }

    #[test]
    fn the_corner_of_a_wide_view() {
        // At 120° the corner of a square picture has Δ_ray = √(1 + 3 + 3)Δ.
        let camera = Camera { projection: Projection::Perspective { fov: 120.0 }, ..Camera::default() };
        let view = View::new(&camera, &grid(), [64, 64]).unwrap();
        assert!((view.largest_stretch() - 7f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn eye_on_the_target_is_an_error() {
        let camera = Camera { eye: Some(grid().centre()), ..Camera::default() };
        assert_eq!(View::new(&camera, &grid(), [2, 2]), Err(ViewError::NoDirection));
    }
}
