//! Clip planes and boxes: a slider through the volume for each plane, its direction, and handles on the picture.

use super::handle::Handle;
use super::{Panel, PictureArea};
use crate::camera::{decimals, number, numbers, place, rounded};
use crate::document::Edit;
use crate::key::KeyPath;
use crate::session::Session;
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Clip, ClipSpace};
use drypoint::scene::view::View;
use eframe::egui::{self, Color32, Slider, SliderClamping, Ui};
use toml_edit::{Array, InlineTable, Value};

/// The panel of clip planes.
pub(super) struct ClipPanel;

impl Panel for ClipPanel {
    fn title(&self) -> &'static str {
        "Cuts"
    }

    fn ui(&mut self, ui: &mut Ui, session: &mut Session) {
        let (Some(scene), Some(data)) = (session.scene.clone(), session.data().cloned()) else {
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
                    None => drop(ui.weak("A box is kept. Its sides have handles on the picture.")),
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
                if ui.button("or a box").clicked() {
                    add_box(session, scene.clips.len(), grid);
                }
            });
        });
    }

    fn over_picture(&mut self, ui: &mut Ui, picture: &PictureArea, session: &mut Session) -> bool {
        let (Some(scene), Some(data), Some(pose)) = (session.scene.clone(), session.data().cloned(), session.pose())
        else {
            return false;
        };
        let grid = data.volume.grid();
        let mut is_taken = false;
        for (i, clip) in scene.clips.iter().enumerate() {
            let Some(Plane { point, normal }) = world_plane(clip, grid) else {
                is_taken |= sides(ui, picture, session, (i, clip), (grid, &pose.view));
                continue;
            };
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
    let slider = Slider::new(&mut at, least..=most).text("along the normal");
    // A plane outside the box stays there until it is moved.
    let slider = slider.clamping(SliderClamping::Edits).max_decimals(decimals(grid).max(0) as usize);
    if ui.add(slider).changed() {
        set_point(session, i, clip, plane.point + plane.normal * (at - plane.point.dot(plane.normal)), grid);
    }
    ui.horizontal(|ui| {
        let normal = KeyPath::from("clip").item(i).name("normal");
        if ui.button("Flip").clicked()
            && let Some(given) = clip.normal
        {
            session.set(&normal, Value::from_iter((-given).to_array().map(number)));
        }
        if ui.button("Across the view").clicked()
            && let Some(pose) = session.pose()
        {
            let towards_eye = match clip.space {
                ClipSpace::World => -pose.view.forward,
                ClipSpace::Index => grid.axes().transpose() * -pose.view.forward,
            };
            session.set(&normal, numbers(towards_eye.normalize_or(DVec3::Z), 6));
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

/// Shows a handle on each side of a box, and moves the side. Returns whether the pointer is on a handle.
fn sides(
    ui: &Ui,
    picture: &PictureArea,
    session: &mut Session,
    (i, clip): (usize, &Clip),
    (grid, view): (&Grid, &View),
) -> bool {
    let Some(extent) = clip.extent else { return false };
    let (axes, to_world): (DMat3, &dyn Fn(DVec3) -> DVec3) = match clip.space {
        ClipSpace::World => (DMat3::IDENTITY, &|p| p),
        ClipSpace::Index => (grid.axes(), &|p| grid.to_world(p)),
    };
    let middle = DVec3::from_array(extent.map(|[lo, hi]| (lo + hi) / 2.0));
    let mut is_taken = false;
    for (axis, side) in (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]) {
        let mut at = middle;
        at[axis] = extent[axis][side];
        let (foot, unit) = (to_world(at), axes.col(axis));
        let outward = unit.normalize_or_zero() * if side == 0 { -1.0 } else { 1.0 };
        let tip = foot + outward * (0.15 * grid.radius());
        let name = format!("Clip box {i}, {} {}", ["x", "y", "z"][axis], ["from", "to"][side]);
        let handle = Handle { name: &name, foot, tip, color: Color32::from_gray(210) };
        let grip = handle.show(ui, ui.scope_id().with(("box", i, axis, side)), picture, view);
        is_taken |= grip.is_taken;
        if let Some(by) = grip.by {
            let to = extent[axis][side] + by.dot(unit) / unit.length_squared();
            // A thousandth of a voxel, and never beyond the other side.
            let decimals = if clip.space == ClipSpace::Index { 3 } else { decimals(grid) };
            let other = extent[axis][1 - side];
            let to = rounded(to, decimals);
            if (to < other) == (side == 0) && to != other {
                let key = KeyPath::from("clip").item(i).name("box").item(axis).item(side);
                session.set(&key, number(to));
            }
        }
    }
    is_taken
}

/// Adds the box of the volume.
fn add_box(session: &mut Session, index: usize, grid: &Grid) {
    let corners = grid.world_corners();
    let ends = [corners.into_iter().fold(DVec3::MAX, DVec3::min), corners.into_iter().fold(DVec3::MIN, DVec3::max)];
    let range = |axis: usize| ends.iter().map(|end| number(rounded(end[axis], decimals(grid)))).collect::<Array>();
    let table = InlineTable::from_iter([("box", Value::from([0, 1, 2].map(range).into_iter().collect::<Array>()))]);
    session.edit("add a clip box", vec![Edit::Insert("clip".into(), index, table)]);
}
