//! Foci of halos that a scene gives in pixels ([HALO-12]).

use super::Job;
use crate::picking::point_of_pixel;
use crate::{Failure, Failures};
use drypoint_reference::ray::Renderer;
use drypoint_scene::glam::DVec3;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::plan::halos_in_effect;
use drypoint_scene::tables::Scene;

/// Points of the picked foci, each with the index of its halo.
type PickedFoci = Vec<(usize, Vec<DVec3>)>;

impl Job {
    /// Replaces the pixels of foci by the points that are visible there. The pixels are those of the scene's own
    /// camera, and halos themselves are invisible to picking. Halos without an effect keep their pixels.
    pub(super) fn pick_foci(&mut self) -> Result<(), Failures> {
        for (halo, points) in self.picked_foci()? {
            if let Some(focus) = &mut self.scene.halos[halo].seed.focus {
                focus.set_points(points);
            }
        }
        Ok(())
    }

    fn picked_foci(&self) -> Result<PickedFoci, Failures> {
        let foci: Vec<_> = halos_in_effect(&self.scene)
            .filter_map(|(i, halo)| Some((i, halo.seed.focus.as_ref()?.pixels()?)))
            .collect();
        if foci.is_empty() || !self.draws_volume() {
            return Ok(Vec::new());
        }
        // The renderer of the scene without halos, whose rays are the picture's.
        let mut scene = Scene { halos: Vec::new(), ..self.scene.clone() };
        scene.picture.layers = vec![LayerKind::Beauty];
        let plan = self.plan_of(&scene);
        let shot = self.resolve(&scene, &plan, self.assets.function.as_ref(), self.view()?)?;
        let renderer = self.made_ready(&scene, &plan, &shot, Renderer::new)?;
        let (mut picked, mut failures) = (PickedFoci::new(), Vec::new());
        for (halo, pixels) in foci {
            let mut points = Vec::new();
            for &pixel in pixels {
                match renderer.pick(point_of_pixel(pixel)) {
                    Some(found) => points.push(found.world),
                    None => {
                        let key = format!("halo[{halo}].seed.focus.pixels");
                        failures.push(nothing_seen(&self.scene, &key, "it gives the halo no focus", pixel));
                    }
                }
            }
            picked.push((halo, points));
        }
        Failures::check(failures).map(|()| picked)
    }
}

/// Returns the failure of a pixel without a visible structure, and its consequence in words.
pub(super) fn nothing_seen(scene: &Scene, key: &str, consequence: &str, pixel: [f64; 2]) -> Failure {
    let ([x, y], [width, height]) = (pixel, scene.picture.size);
    let [right, down] = point_of_pixel(pixel);
    let what = if right <= width as f64 && down <= height as f64 {
        format!("nothing is seen at the pixel [{x}, {y}], so {consequence}")
    } else {
        format!("the pixel [{x}, {y}] lies outside the picture of {width} × {height} pixels")
    };
    Failure::new(
        what,
        scene.given.position(key),
        "give a pixel that shows the volume; `drypoint pick` tells what is seen at one",
    )
}
