//! Eq. 7: fewer and smaller points if the volume is farther away than at first ([STIP-9]).
//!
//! The printed fraction has the current distance in the numerator, which makes more points of a volume that is
//! farther away. The text and Fig. 4 show the contrary. So the fraction is inverted here.

use drypoint_scene::glam::DVec3;
use drypoint_scene::math::pow;
use drypoint_scene::shot::stipples::Resolution;
use drypoint_scene::view::View;

/// T_r = min(1, (D₀/D)^k_re).
pub(super) fn resolution(t: &Resolution, reference: f64, now: f64) -> f64 {
    if t.re == 0.0 { 1.0 } else { pow(t.reference.unwrap_or(reference) / now, t.re).min(1.0) }
}

/// D, the eye depth of the volume's centre, at least `near`. An orthographic view has no distance; D is then the
/// height of the picture in world units.
pub fn viewing_distance(view: &View, centre: DVec3, near: f64) -> f64 {
    if view.perspective { (-view.to_eye(centre).z).max(near) } else { view.pixel * view.size[1] as f64 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_worked() {
        let t = Resolution { re: 2.0, reference: None };
        assert_eq!([300.0, 600.0, 1200.0].map(|now| resolution(&t, 600.0, now)), [1.0, 1.0, 0.25]);
        let given = Resolution { reference: Some(300.0), ..t };
        assert_eq!(resolution(&given, 600.0, 1200.0), 0.0625);
        assert_eq!(resolution(&Resolution { re: 0.0, reference: None }, 600.0, 1200.0), 1.0);
        let fig4 = Resolution { re: 1.1, reference: None };
        assert!((resolution(&fig4, 1.0, 2.0) - 0.466_516_495_768_403_8).abs() < 1e-15);
    }
}
