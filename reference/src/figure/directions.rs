//! The directions of the data in a picture.

use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::view::View;
use drypoint_scene::volume::Anatomy;

/// The least share of a direction that a letter stands for: sin 22.5°, so that a direction has a second letter where it is
/// nearer to the diagonal than to the axis.
const SHARE: f64 = 0.382_683_432_365_089_8;

/// An axis of world space in a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisOnPage {
    /// Its letter.
    pub letter: String,
    /// Its direction on the page, y down; as long as it is seen, at most 1.
    pub way: DVec2,
    /// Its part towards the eye, from −1 to 1.
    pub towards: f64,
}

/// Returns the letter of a direction along an axis: of the body where the data are anatomical, else x, y, z.
fn letter(axis: usize, is_positive: bool, anatomy: Option<Anatomy>) -> String {
    let Some(anatomy) = anatomy else {
        return format!("{}{}", if is_positive { "" } else { "−" }, ["x", "y", "z"][axis]);
    };
    let positive = anatomy.initials().as_bytes()[axis] as char;
    let opposite = |letter| match letter {
        'L' => 'R',
        'R' => 'L',
        'A' => 'P',
        'P' => 'A',
        'S' => 'I',
        _ => 'S',
    };
    String::from(if is_positive { positive } else { opposite(positive) })
}

/// Returns the letters of the directions to the right, the left, the top and the bottom of a picture. A direction is named
/// by its largest part, and by its second one if it is nearer to the diagonal of both than to the first.
pub fn edge_letters(view: &View, anatomy: Option<Anatomy>) -> [String; 4] {
    [view.right, -view.right, view.up, -view.up].map(|direction| {
        let mut axes = [0, 1, 2];
        axes.sort_by(|&a, &b| direction[b].abs().total_cmp(&direction[a].abs()));
        let named = axes[..2].iter().enumerate().filter(|&(i, &axis)| i == 0 || direction[axis].abs() > SHARE);
        let letters: Vec<String> = named.map(|(_, &axis)| letter(axis, direction[axis] > 0.0, anatomy)).collect();
        letters.join(if anatomy.is_some() { "" } else { " " })
    })
}

/// Returns the axes of world space in a picture, as an orthographic view along its axis shows them.
pub fn axes_on_page(view: &View, anatomy: Option<Anatomy>) -> [AxisOnPage; 3] {
    [0, 1, 2].map(|axis| {
        let direction = view.direction_to_eye(DVec3::AXES[axis]);
        let way = DVec2::new(direction.x, -direction.y);
        AxisOnPage { letter: letter(axis, true, anatomy), way, towards: direction.z }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::space::Grid;
    use drypoint_scene::tables::{Camera, Projection};

    fn view(direction: DVec3, up: DVec3) -> View {
        let grid = Grid::with_spacing([11; 3], [1.0; 3]).unwrap();
        let projection = Projection::Orthographic { height: None };
        let camera = Camera { projection, direction, direction_given: true, up, ..Camera::default() };
        View::new(&camera, &grid, [80, 60]).unwrap()
    }

    /// From the front: a patient's right is on the left of the picture.
    #[test]
    fn a_patient_from_the_front() {
        let from_front = view(DVec3::Y, DVec3::Z);
        assert_eq!(edge_letters(&from_front, Some(Anatomy::LeftPosteriorSuperior)), ["L", "R", "S", "I"]);
        let from_front = view(DVec3::NEG_Y, DVec3::Z);
        assert_eq!(edge_letters(&from_front, Some(Anatomy::RightAnteriorSuperior)), ["L", "R", "S", "I"]);
        assert_eq!(edge_letters(&view(DVec3::Y, DVec3::Z), None), ["x", "−x", "z", "−z"]);
        // Half from the left.
        let oblique = view(DVec3::new(-1.0, 1.0, 0.0), DVec3::Z);
        assert_eq!(edge_letters(&oblique, Some(Anatomy::LeftPosteriorSuperior))[0].len(), 2);
    }

    #[test]
    fn axes_are_orthonormal_before_the_eye() {
        let axes = axes_on_page(&view(DVec3::new(0.3, 1.0, -0.4), DVec3::Z), None);
        for (i, a) in axes.iter().enumerate() {
            for (j, b) in axes.iter().enumerate() {
                let dot = a.way.dot(b.way) + a.towards * b.towards;
                assert!((dot - f64::from(u8::from(i == j))).abs() < 1e-12);
            }
        }
    }
}
