//! The states of a selection while the camera moves (VolumeShop 6.3; [VS-9]).

use super::View;
use crate::tables::InteractionState;
use glam::{DAffine3, DMat3, DVec3};

impl InteractionState {
    /// Returns M' for a camera V' in place of V. `motion` is M, and `centre` is the selection's centre before it is moved, in
    /// world space. V and V' map the world to eye space ([SPACE-2]). A pixel is counted from the middle of the picture, so
    /// that pictures of other sizes and other lenses have one, too.
    ///
    /// In perspective a centre has no pixel at the eye's depth or behind the eye. A change that involves such a centre and
    /// a perspective view keeps its place in eye space.
    pub fn motion(self, motion: DAffine3, centre: DVec3, [before, now]: [&View; 2]) -> DAffine3 {
        match self {
            Self::Integrated => motion,
            Self::Decoupled => to_world(now) * to_world(before).inverse() * motion,
            Self::Pinned => {
                let moved = motion.transform_point3(centre);
                let at = before.to_eye(moved);
                // World units of a pixel at the centre's depth. None where perspective shows nothing.
                let depth = -at.z;
                let pixel = |view: &View| match view.perspective {
                    true => (depth > 0.0).then_some(view.pixel * depth),
                    false => Some(view.pixel),
                };
                let grown = pixel(now).zip(pixel(before)).map_or(1.0, |(now, before)| now / before);
                let pinned = to_world(now).transform_point3(DVec3::new(at.x * grown, at.y * grown, at.z));
                DAffine3::from_translation(pinned - moved) * motion
            }
        }
    }
}

/// V⁻¹, from eye space to the world.
fn to_world(view: &View) -> DAffine3 {
    DAffine3 { matrix3: DMat3::from_cols(view.right, view.up, -view.forward), translation: view.eye }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Grid;
    use crate::tables::{Camera, Projection};

    const CENTRE: DVec3 = DVec3::new(3.0, 8.0, 5.0);

    fn view(direction: DVec3, fov: Option<f64>, size: [usize; 2]) -> View {
        let grid = Grid::with_spacing([11, 21, 31], [1.0; 3]).unwrap();
        let projection = match fov {
            Some(fov) => Projection::Perspective { fov },
            None => Projection::Orthographic { height: None },
        };
        View::new(&Camera { projection, direction, direction_given: true, ..Camera::default() }, &grid, size).unwrap()
    }

    fn motion() -> DAffine3 {
        let matrix3 =
            DMat3::from_cols(DVec3::new(0.0, 2.0, 0.0), DVec3::new(-1.0, 0.0, 0.5), DVec3::new(0.0, 0.0, 1.5));
        DAffine3 { matrix3, translation: DVec3::new(4.0, -1.0, 2.0) }
    }

    /// Pairs of views: turned, with another lens, of another size, and of the other projection.
    fn changes() -> Vec<[View; 2]> {
        let (first, size) = (DVec3::new(0.3, 1.0, -0.4), [90, 60]);
        let others = [
            view(DVec3::new(-1.0, 0.2, 0.1), Some(30.0), size),
            view(DVec3::new(1.0, 2.0, 3.0), Some(50.0), size),
            view(first, Some(30.0), [300, 300]),
            view(DVec3::NEG_Z, None, size),
        ];
        others.into_iter().map(|other| [view(first, Some(30.0), size), other]).collect()
    }

    #[test]
    fn an_integrated_selection_stays_in_the_world() {
        for [before, now] in changes() {
            assert_eq!(InteractionState::Integrated.motion(motion(), CENTRE, [&before, &now]), motion());
        }
    }

    /// V'·M' = V·M at every point: the selection looks the same before the eye.
    #[test]
    fn a_decoupled_selection_stays_before_the_eye() {
        for [before, now] in changes() {
            let moved = InteractionState::Decoupled.motion(motion(), CENTRE, [&before, &now]);
            for p in [DVec3::ZERO, CENTRE, DVec3::new(-7.0, 40.0, 11.0)] {
                let [a, b] = [before.to_eye(motion().transform_point3(p)), now.to_eye(moved.transform_point3(p))];
                assert!((a - b).length() <= 1e-12 * (1.0 + a.length()), "{a} {b}");
            }
        }
    }

    /// The centre has its pixel and depth as before; directions of the selection are those of the world.
    #[test]
    fn a_pinned_selection_turns_at_its_place() {
        for [before, now] in changes() {
            let moved = InteractionState::Pinned.motion(motion(), CENTRE, [&before, &now]);
            assert_eq!(moved.matrix3, motion().matrix3);
            let [a, b] = [(&before, motion()), (&now, moved)].map(|(view, m)| {
                let p = m.transform_point3(CENTRE);
                let middle = view.size.map(|n| n as f64 / 2.0);
                let pixel = view.point_of(p).unwrap();
                [pixel[0] - middle[0], pixel[1] - middle[1], view.to_eye(p).z]
            });
            for (a, b) in a.into_iter().zip(b) {
                assert!((a - b).abs() < 1e-10, "{a} {b}");
            }
        }
    }

    /// At the eye's depth an orthographic view has a pixel. A picture of twice the height in world units shows the centre at
    /// twice the distance from the view's axis.
    #[test]
    fn an_orthographic_centre_at_the_eye_keeps_its_pixel() {
        let before = view(DVec3::NEG_Z, None, [90, 60]);
        let now = View { pixel: 2.0 * before.pixel, ..before };
        for depth in [0.0, 3.0, -3.0] {
            let centre = before.eye + before.right * 2.0 - before.up * 5.0 + before.forward * depth;
            let moved = InteractionState::Pinned.motion(DAffine3::IDENTITY, centre, [&before, &now]);
            let wanted = before.right * 2.0 - before.up * 5.0;
            assert!((moved.translation - wanted).length() < 1e-12, "{depth}: {moved}");
        }
    }

    /// A centre behind the eye has no pixel in perspective. It keeps its place in eye space, and is not mirrored.
    #[test]
    fn a_centre_behind_the_eye_is_not_mirrored() {
        let size = [90, 60];
        let [flat, deep] = [None, Some(30.0)].map(|fov| view(DVec3::NEG_Z, fov, size));
        let wide = view(DVec3::new(-1.0, 0.2, 0.1), Some(50.0), size);
        for [before, now] in [[&flat, &deep], [&deep, &flat], [&deep, &wide]] {
            for depth in [0.0, -4.0] {
                let centre = before.eye + before.right * 2.0 - before.up * 5.0 + before.forward * depth;
                let moved = InteractionState::Pinned.motion(DAffine3::IDENTITY, centre, [before, now]);
                let at = now.to_eye(moved.transform_point3(centre));
                assert!((at - DVec3::new(2.0, -5.0, -depth)).length() < 1e-10, "{at}");
            }
        }
    }

    /// Without a change of the camera no state moves anything. A decoupled selection is off by the rounding of V'⁻¹·V.
    #[test]
    fn a_camera_that_stays_moves_nothing() {
        let [view, _] = &changes()[0];
        for state in [InteractionState::Integrated, InteractionState::Decoupled, InteractionState::Pinned] {
            let moved = state.motion(motion(), CENTRE, [view, view]);
            assert!(moved.abs_diff_eq(motion(), 1e-12), "{state:?}: {moved}");
        }
    }
}
