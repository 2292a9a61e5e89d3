//! Selections painted by the strokes of a scene ([VS-6]).

use super::Job;
use super::focus::nothing_seen;
use crate::picking::point_of_pixel;
use crate::{Failure, Failures};
use drypoint_reference::ray::Renderer;
use drypoint_reference::volumeshop::painting::{Dab, Growth, PaintError, Painted, Painter, Seed};
use drypoint_scene::glam::DVec3;
use drypoint_scene::memory::NoRoom;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::tables::{PaintMode, PaintStroke, PaintTarget, Role, Scene};
use drypoint_scene::view::View;
use drypoint_scene::volume::{Anatomy, Selection};

/// A selection, and the extent of its strokes.
#[derive(Clone, Debug)]
pub struct Painting {
    /// The selection, on the grid of the object's data.
    pub selection: Selection,
    /// The extent of each stroke. Basins that were flooded together count for the first stroke.
    pub painted: Vec<Painted>,
}

/// The target of strokes: an object's data as a separate picture.
struct Canvas<'a> {
    job: &'a Job,
    scene: Scene,
    view: View,
    /// The keys of the strokes.
    key: String,
}

impl Job {
    /// Paints the strokes of an object onto its data. If the object has the data of `[volume]`, they are shown as in
    /// the picture without objects. If it has data of its own, they are shown as the object shows them.
    ///
    /// # Errors
    /// A seed lies outside the data or on a hidden voxel, nothing is visible at a pixel, data cannot be read, or the
    /// memory budget does not allow the memory.
    ///
    /// # Panics
    /// If there is no object with this index.
    pub fn paint(&self, object: usize) -> Result<Painting, Failures> {
        let table = &self.scene.objects[object];
        let strokes = table.strokes.as_deref().unwrap_or_default();
        let key = format!("object[{object}].strokes");
        let own = match table.volume {
            None => None,
            Some(_) => {
                let scene = self.scene.of_part(object, Role::Selection);
                Some(Self::load(Scene { halos: Vec::new(), ..scene })?)
            }
        };
        let job = own.as_ref().unwrap_or(self);
        // The picture as it is seen without objects and halos, whose rays are the picture's.
        let mut scene = Scene { halos: Vec::new(), ..job.scene.of_background() };
        scene.picture.layers = vec![LayerKind::Beauty];
        let canvas = Canvas { job, scene, view: self.view()?, key };
        let points = canvas.points(strokes, self.volume.anatomy())?;
        canvas.painted(strokes, &points, self.volume.grid().voxel())
    }
}

impl Canvas<'_> {
    /// The point of each stroke, in the world of the data's file. `world` is the anatomy of the picture's world.
    fn points(&self, strokes: &[PaintStroke], world: Option<Anatomy>) -> Result<Vec<DVec3>, Failures> {
        let volume = &self.job.volume;
        let in_picture = Anatomy::between(volume.grid(), volume.anatomy(), world);
        let is_turned = in_picture != *volume.grid();
        let to_own = |p: DVec3| if is_turned { volume.grid().to_world(in_picture.to_index(p)) } else { p };
        let picked = strokes.iter().any(|stroke| matches!(stroke.target, PaintTarget::Pixel(_)));
        if picked && is_turned {
            let what = "pixels are painted on data in the world of [volume], and the object's data are in another one";
            return Err(self.failure("", what, "paint it at = [x, y, z] in the world of [volume]").into());
        }
        let plan = self.job.plan_of(&self.scene);
        let shot = match picked {
            true => Some(self.job.resolve(&self.scene, &plan, self.job.assets.function.as_ref(), self.view.clone())?),
            false => None,
        };
        let renderer = match &shot {
            Some(shot) => Some(self.job.made_ready(&self.scene, &plan, shot, Renderer::new)?),
            None => None,
        };
        let mut failures = Vec::new();
        let points = strokes.iter().enumerate().map(|(i, stroke)| match stroke.target {
            PaintTarget::At(p) | PaintTarget::Grow(p) | PaintTarget::Watershed(p) => to_own(p),
            PaintTarget::Pixel(pixel) => {
                let picked = renderer.as_ref().and_then(|renderer| renderer.pick(point_of_pixel(pixel)));
                picked.map(|picked| picked.world).unwrap_or_else(|| {
                    let key = format!("{}[{i}].pixel", self.key);
                    failures.push(nothing_seen(&self.scene, &key, "nothing is painted there", pixel));
                    DVec3::ZERO
                })
            }
        });
        let points = points.collect();
        Failures::check(failures).map(|()| points)
    }

    /// Paints strokes at their points. `voxel` is the voxel of `[volume]`, the unit of lengths.
    fn painted(&self, strokes: &[PaintStroke], points: &[DVec3], voxel: f64) -> Result<Painting, Failures> {
        let volume = &self.job.volume;
        let Some(function) = self.job.assets.function.as_ref().filter(|_| self.scene.transfer.is_some()) else {
            let what = "nothing in the scene says which voxels are shown, and only these are painted";
            return Err(self.failure("", what, "add a [transfer] table").into());
        };
        let is_shown = |value: f64| function.can_be_visible([value; 2], None, |at| at);
        let painter = Painter::new(volume, &is_shown);
        let mut selection = Selection::nothing(volume);
        let mut painted = vec![Painted::default(); strokes.len()];
        let mut i = 0;
        while i < strokes.len() {
            let PaintStroke { target, mode, radius, brush, tolerance, connect } = strokes[i].clone();
            let at = points[i];
            let is_basin = |stroke: &PaintStroke| matches!(stroke.target, PaintTarget::Watershed(_));
            // Basins that stand one after the other are flooded together.
            let together = strokes[i..].iter().take_while(|stroke| is_basin(stroke)).count().max(1);
            let result = match target {
                PaintTarget::Pixel(_) | PaintTarget::At(_) => {
                    let radius = radius.of_voxel(voxel).unwrap_or(0.0);
                    painter.dab(&mut selection, &Dab { at, radius, brush, mode }).map_err(PaintError::from)
                }
                PaintTarget::Grow(_) => painter.grow(&mut selection, &Growth { at, tolerance, connect, mode }),
                PaintTarget::Watershed(_) => {
                    let modes: Vec<PaintMode> = strokes[i..i + together].iter().map(|stroke| stroke.mode).collect();
                    let seeds: Vec<Seed> = points[i..].iter().zip(modes).map(|(&at, mode)| Seed { at, mode }).collect();
                    painter.watershed(&mut selection, &seeds)
                }
            };
            painted[i] = result.map_err(|error| self.refused(i, &strokes[i], &error))?;
            i += together;
        }
        Ok(Painting { selection, painted })
    }

    /// The failure of the stroke with index `first`, or of a later one that is flooded with it.
    fn refused(&self, first: usize, stroke: &PaintStroke, error: &PaintError) -> Failure {
        let key = if matches!(stroke.target, PaintTarget::Grow(_)) { "grow" } else { "watershed" };
        match error {
            PaintError::Outside(later) | PaintError::Hidden(later) => {
                let remedy = "give a point on what is shown: `drypoint pick` tells some";
                self.failure(&format!("[{}].{key}", first + later), error, remedy)
            }
            PaintError::NoRoom(no_room) => self.no_room(no_room),
            PaintError::Field(_) => self.failure(&format!("[{first}]"), error, "paint with a brush"),
        }
    }

    fn no_room(&self, no_room: &NoRoom) -> Failure {
        let what = format!("painting needs {no_room}");
        self.failure("", what, "read less with volume.box or volume.stride")
    }

    fn failure(&self, end: &str, what: impl std::fmt::Display, remedy: &str) -> Failure {
        Failure::new(what, self.scene.given.position(&format!("{}{end}", self.key)), remedy)
    }
}
