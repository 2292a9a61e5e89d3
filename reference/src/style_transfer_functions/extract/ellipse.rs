//! Circles and ellipses: pictures of spheres and ellipsoids ([STF-2]).
//!
//! An ellipsoid with half axes a, b in the picture and c across it has its outward normal n at the place
//!
//! p = A n / √(nᵀ A n), A = diag(a², b², c²).
//!
//! The outline, n_z = 0, therefore has its own normals. A picture does not show the depth of the body. Unless c is
//! given, it is the smaller of a and b, which is the radius of the largest circle inside.

use super::ExtractError;
use super::check::{number, positive};
use drypoint_scene::math;

/// An ellipse in pixels of the picture, y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ellipse {
    centre: [f64; 2],
    a: f64,
    b: f64,
    c: f64,
    /// The first half axis as a unit vector, x to the right and y up.
    axis: [f64; 2],
}

impl Ellipse {
    /// A circle.
    ///
    /// # Errors
    /// A number is invalid, or the radius is not positive.
    pub(super) fn circle(x: f64, y: f64, r: f64) -> Result<Self, ExtractError> {
        let centre = [number("x", x)?, number("y", y)?];
        let r = positive("the radius", r)?;
        Ok(Self { centre, a: r, b: r, c: r, axis: [1.0, 0.0] })
    }

    /// An ellipsoid with half axes a and b. a is turned by an angle in degrees from the line to the right,
    /// anticlockwise as seen. c is the half axis across the picture, if it is known.
    ///
    /// # Errors
    /// A number is invalid, or a half axis is not positive.
    pub(super) fn new(
        [x, y]: [f64; 2],
        [a, b]: [f64; 2],
        angle: f64,
        depth: Option<f64>,
    ) -> Result<Self, ExtractError> {
        let centre = [number("x", x)?, number("y", y)?];
        let [a, b] = [positive("the half axis a", a)?, positive("the half axis b", b)?];
        let turn = number("the angle", angle)?.to_radians();
        let c = depth.map_or(Ok(a.min(b)), |c| positive("the depth", c))?;
        Ok(Self { centre, a, b, c, axis: [math::cos(turn), math::sin(turn)] })
    }

    /// Components of a vector (x right, y up) along the half axes.
    fn to_axes(self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [cos, sin] = self.axis;
        [cos * x + sin * y, cos * y - sin * x]
    }

    /// The place whose normal is (N_x, N_y, √(1 − N_x² − N_y²)).
    pub(super) fn place(self, nx: f64, ny: f64) -> [f64; 2] {
        let square = nx * nx + ny * ny;
        let [u, v] = self.to_axes([nx, ny]);
        let [au, bv] = [self.a * u, self.b * v];
        let support = (au * au + bv * bv + self.c * self.c * (1.0 - square).max(0.0)).sqrt();
        let [u, v] = [self.a * au / support, self.b * bv / support];
        let [cos, sin] = self.axis;
        [self.centre[0] + (cos * u - sin * v), self.centre[1] - (sin * u + cos * v)]
    }

    /// Whether a place of the picture lies in the closed ellipse.
    pub(super) fn contains(self, x: f64, y: f64) -> bool {
        let [u, v] = self.to_axes([x - self.centre[0], self.centre[1] - y]);
        (u / self.a) * (u / self.a) + (v / self.b) * (v / self.b) <= 1.0
    }

    /// The lowest and the highest corner of the box around the ellipse.
    pub(super) fn bounds(self) -> [[f64; 2]; 2] {
        let [cos, sin] = self.axis;
        let reach = [math::hypot(self.a * cos, self.b * sin), math::hypot(self.a * sin, self.b * cos)];
        [[0, 1].map(|c| self.centre[c] - reach[c]), [0, 1].map(|c| self.centre[c] + reach[c])]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_is_a_sphere() {
        let circle = Ellipse::circle(10.0, 20.0, 5.0).unwrap();
        for (nx, ny) in [(0.0, 0.0), (0.6, 0.3), (-0.28, 0.96), (0.0, -1.0)] {
            let [x, y] = circle.place(nx, ny);
            assert!((x - (10.0 + 5.0 * nx)).abs() < 1e-14 && (y - (20.0 - 5.0 * ny)).abs() < 1e-14);
        }
        assert!(circle.contains(15.0, 20.0) && !circle.contains(15.0, 20.1));
        assert_eq!(circle.bounds(), [[5.0, 15.0], [15.0, 25.0]]);
    }

    /// The gradient of (x/a)² + (y/b)² + (z/c)² at the place of a normal points along the normal.
    #[test]
    fn places_have_their_normals() {
        let [a, b, c] = [7.0f64, 3.0, 5.0];
        for angle in [0.0, 30.0, 200.0] {
            let ellipse = Ellipse::new([1.0, -2.0], [a, b], angle, Some(c)).unwrap();
            let (cos, sin) = (f64::to_radians(angle).cos(), f64::to_radians(angle).sin());
            for (nx, ny) in [(0.1f64, 0.2f64), (-0.7, 0.5), (0.6, -0.8), (0.0, 0.999)] {
                let nz = (1.0 - nx * nx - ny * ny).max(0.0).sqrt();
                let [x, y] = ellipse.place(nx, ny);
                let (dx, dy) = (x - 1.0, -2.0 - y);
                let (u, v) = (cos * dx + sin * dy, cos * dy - sin * dx);
                let z = c * (1.0 - (u / a).powi(2) - (v / b).powi(2)).max(0.0).sqrt();
                let [gu, gv, gz] = [u / (a * a), v / (b * b), z / (c * c)];
                let (gx, gy) = (cos * gu - sin * gv, sin * gu + cos * gv);
                let length = (gx * gx + gy * gy + gz * gz).sqrt();
                for (g, n) in [(gx, nx), (gy, ny), (gz, nz)] {
                    // On the rim z is the root of a difference that rounding alone makes.
                    assert!((g / length - n).abs() < 1e-7, "{angle} ({nx}, {ny}): {g} {n}");
                }
            }
        }
    }

    #[test]
    fn a_quarter_turn_exchanges_the_axes() {
        let (turned, plain) =
            (Ellipse::new([0.0; 2], [4.0, 9.0], 90.0, None), Ellipse::new([0.0; 2], [9.0, 4.0], 0.0, None));
        let (turned, plain) = (turned.unwrap(), plain.unwrap());
        for (nx, ny) in [(0.3, 0.4), (-0.9, 0.1), (0.0, 1.0)] {
            let ([x, y], [u, v]) = (turned.place(nx, ny), plain.place(nx, ny));
            assert!((x - u).abs() < 1e-14 && (y - v).abs() < 1e-14);
        }
        // A positive angle is anticlockwise as one sees it: the long axis at 45° points to the upper right, where y is small.
        let tilted = Ellipse::new([0.0; 2], [9.0, 1.0], 45.0, None).unwrap();
        assert!(tilted.contains(5.0, -5.0) && !tilted.contains(5.0, 5.0));
    }

    #[test]
    fn what_is_no_ellipse_is_refused() {
        assert!(matches!(Ellipse::circle(f64::NAN, 0.0, 1.0), Err(ExtractError::Number { .. })));
        assert!(matches!(Ellipse::circle(0.0, 1e8, 1.0), Err(ExtractError::Number { .. })));
        for r in [0.0, -1.0] {
            assert_eq!(Ellipse::circle(0.0, 0.0, r), Err(ExtractError::NotPositive { name: "the radius", value: r }));
        }
        assert!(Ellipse::new([0.0; 2], [1.0, f64::INFINITY], 0.0, None).is_err());
        assert!(Ellipse::new([0.0; 2], [1.0, 0.0], 0.0, None).is_err());
        assert!(Ellipse::new([0.0; 2], [1.0, 1.0], 0.0, Some(-1.0)).is_err());
    }
}
