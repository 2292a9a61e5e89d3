//! Focus of halos at a place of the volume.

use crate::camera::{self, number};
use crate::document::Edit;
use crate::key::KeyPath;
use drypoint::picking::focus_lengths;
use drypoint::scene::glam::DVec3;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::Scene;
use toml_edit::{Array, InlineTable};

/// Returns the edits that focus halos on a place in the world: those halos that have a focus, or all if none has one. A new
/// focus has the lengths that `drypoint pick` suggests. A halo that is seeded by the opacity stays so.
pub fn focus(scene: &Scene, grid: &Grid, at: DVec3) -> Vec<Edit> {
    let has_focus = scene.halos.iter().any(|halo| halo.seed.focus.is_some());
    let place = Array::from_iter([camera::place(at, grid)]);
    let mut edits = Vec::new();
    for (i, halo) in scene.halos.iter().enumerate() {
        let seed = KeyPath::from("halo").item(i).name("seed");
        let key = seed.name("focus");
        if halo.seed.focus.is_some() {
            edits.push(Edit::Remove(key.name("pixels")));
            edits.push(Edit::set(key.name("at"), place.clone()));
        } else if !has_focus {
            if halo.seed.is_by_opacity() && halo.seed.value.is_none() {
                edits.push(Edit::set(seed.name("value"), "opacity"));
            }
            let [inner, falloff] = focus_lengths(grid);
            let mut table = InlineTable::new();
            table.insert("at", place.clone().into());
            table.insert("inner", number(inner));
            table.insert("falloff", number(falloff));
            edits.push(Edit::set(key, table));
        }
    }
    edits
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;

    const SCENE: &str = "drypoint = 1\n[volume]\nphantom.name = \"torus\"\n[transfer]\n";

    fn focused(halos: &str) -> (String, Scene) {
        let mut document = Document::untitled(format!("{SCENE}{halos}"), "ring.toml".into());
        let grid = Grid::with_spacing([101, 101, 101], [2.0, 2.0, 1.0]).unwrap();
        let scene = document.scene().unwrap();
        document.apply("focus", focus(&scene, &grid, DVec3::new(10.0001, 20.5, 30.0))).unwrap();
        (document.text().strip_prefix(SCENE).unwrap().to_owned(), document.scene().unwrap())
    }

    /// The radius is 150, so the focus is full to 18.75 and falls over 37.5.
    #[test]
    fn halos_without_a_focus_get_one_and_stay_seeded_by_opacity() {
        let (text, scene) = focused("[[halo]]\nfloor = 0.1 # low\n[[halo]]\nseed.direction.toward = 90\n");
        let focus = "focus = { at = [[10, 20.5, 30]], inner = 19, falloff = 38 }\n";
        assert!(text.contains("floor = 0.1 # low") && text.matches(focus).count() == 2, "{text}");
        let by_opacity: Vec<bool> = scene.halos.iter().map(|halo| halo.seed.is_by_opacity()).collect();
        assert_eq!(by_opacity, [true, false]);
    }

    #[test]
    fn a_focus_is_moved_and_keeps_its_lengths() {
        let (text, _) = focused("[[halo]]\n[[halo]]\nseed.focus = { pixels = [[3, 4]], inner = 5 } # here\n");
        assert_eq!(text, "[[halo]]\n[[halo]]\nseed.focus = { inner = 5, at = [[10, 20.5, 30]] } # here\n");
        let (text, _) = focused("[[halo]]\nseed.focus = { at = [[1, 2, 3], [4, 5, 6]], inner = 5 }\n");
        assert_eq!(text, "[[halo]]\nseed.focus = { at = [[10, 20.5, 30]], inner = 5 }\n");
    }
}
