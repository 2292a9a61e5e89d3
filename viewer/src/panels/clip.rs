//! Clip planes: a slider through the volume for each, its direction, and a handle on the picture.

use super::handle::Handle;
use super::{Panel, PictureArea};
use crate::camera::{numbers, place};
use crate::document::Edit;
use crate::key::KeyPath;
use crate::session::Session;
use drypoint::scene::glam::DVec3;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Clip, ClipSpace};
use eframe::egui::{self, Color32, Slider, Ui};
use toml_edit::InlineTable;

/// The panel of clip planes.
pub(super) struct ClipPanel;

impl Panel for ClipPanel {
    fn title(&self) -> &'static str {
        "Clip planes"
    }

    fn ui(&mut self, ui: &mut Ui, session: &mut Session) {
        let (Some(scene), Some(data)) = (session.scene.clone(), session.data.clone()) else {
            ui.weak("The volume is being read.");
            return;
        };
        let grid = data.volume.grid();
        ui.label("A plane cuts away the side to which its normal points.");
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            for (i, clip) in scene.clips.iter().enumerate() {
                ui.separator();
                ui.horizontal(|ui| {
                    ui.strong(format!("Clip {i}"));
                    if ui.small_button("Remove").clicked() {
                        let key = KeyPath::from("clip").item(i);
                        session.edit(&format!("remove {key}"), vec![Edit::Remove(key)]);
                    }
                });
                match world_plane(clip, grid) {
                    Some(plane) => plane_ui(ui, session, i, clip, plane, grid),
                    None => drop(ui.weak("A box. Its sides are edited among all keys.")),
                }
            }
            ui.separator();
            ui.horizontal(|ui| {
                ui.label("Add a plane across");
                for (name, normal) in [("x", DVec3::X), ("y", DVec3::Y), ("z", DVec3::Z)] {
                    if ui.button(name).clicked() {
                        add(session, scene.clips.len(), normal, grid);
                    }
                }
                if ui.button("the view").clicked()
                    && let Some(pose) = session.pose()
                {
                    add(session, scene.clips.len(), -pose.view.forward, grid);
                }
            });
        });
    }

    fn over_picture(&mut self, ui: &mut Ui, picture: &PictureArea, session: &mut Session) -> bool {
        let (Some(scene), Some(data), Some(pose)) = (session.scene.clone(), session.data.clone(), session.pose())
        else {
            return false;
        };
        let grid = data.volume.grid();
        let mut is_taken = false;
        for (i, clip) in scene.clips.iter().enumerate() {
            let Some(Plane { point, normal }) = world_plane(clip, grid) else { continue };
            // The handle stands on the plane, nearest to the volume's middle, with an arrow to what is cut away.
            let foot = grid.centre() + normal * (point - grid.centre()).dot(normal);
            let tip = foot + normal * (0.15 * grid.radius());
            let handle = Handle { name: &format!("Clip plane {i}"), foot, tip, color: Color32::from_gray(210) };
            let grip = handle.show(ui, ui.scope_id().with(("clip", i)), picture, &pose.view);
            is_taken |= grip.is_taken;
            if let Some(by) = grip.by {
                set_point(session, i, clip, point + by, grid);
            }
        }
        is_taken
    }
}

/// A plane in the world, with a normal of length 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Plane {
    point: DVec3,
    normal: DVec3,
}

/// Returns the plane of a clip in the world; none for a box. A normal in index space is one of the planes that the
/// index has.
fn world_plane(clip: &Clip, grid: &Grid) -> Option<Plane> {
    let (point, normal) = (clip.point?, clip.normal?);
    let (point, normal) = match clip.space {
        ClipSpace::World => (point, normal),
        ClipSpace::Index => (grid.to_world(point), grid.inverse_axes().transpose() * normal),
    };
    Some(Plane { point, normal: normal.normalize_or(DVec3::Z) })
}

/// Shows the slider and the direction of a plane.
fn plane_ui(ui: &mut Ui, session: &mut Session, i: usize, clip: &Clip, plane: Plane, grid: &Grid) {
    let places = grid.world_corners().map(|corner| corner.dot(plane.normal));
    let [least, most] = [places.into_iter().fold(f64::MAX, f64::min), places.into_iter().fold(f64::MIN, f64::max)];
    let mut at = plane.point.dot(plane.normal);
    let slider = Slider::new(&mut at, least..=most).text("along the normal").max_decimals(3);
    if ui.add(slider).changed() {
        set_point(session, i, clip, plane.point + plane.normal * (at - plane.point.dot(plane.normal)), grid);
    }
    ui.horizontal(|ui| {
        let normal = KeyPath::from("clip").item(i).name("normal");
        if ui.button("Flip").clicked()
            && let Some(given) = clip.normal
        {
            session.set(&normal, numbers(-given, 6));
        }
        if ui.button("Across the view").clicked()
            && let (Some(pose), ClipSpace::World) = (session.pose(), clip.space)
        {
            session.set(&normal, numbers(-pose.view.forward, 6));
        }
    });
}

/// Moves the point of a clip to a place in the world.
fn set_point(session: &mut Session, i: usize, clip: &Clip, point: DVec3, grid: &Grid) {
    let point = match clip.space {
        ClipSpace::World => place(point, grid),
        // A thousandth of a voxel.
        ClipSpace::Index => numbers(grid.to_index(point), 3),
    };
    session.set(&KeyPath::from("clip").item(i).name("point"), point);
}

/// Adds a plane through the middle of the volume.
fn add(session: &mut Session, index: usize, normal: DVec3, grid: &Grid) {
    let table = InlineTable::from_iter([("normal", numbers(normal, 6)), ("point", place(grid.centre(), grid))]);
    session.edit("add a clip plane", vec![Edit::Insert("clip".into(), index, table)]);
}
