//! Scenes of later frames: selections where their interaction states put them (VolumeShop 6.3; [VS-9]).

use super::{Job, SceneVariant};
use crate::Failure;
use drypoint_scene::view::View;

impl Job {
    /// Whether frames of `[orbit]` have scenes of their own, since selections do not stay in the world.
    pub(crate) fn moves_selections(&self) -> bool {
        self.draws_volume() && (0..self.scene.objects.len()).any(|i| self.scene.follows_camera(i))
    }

    /// Returns the scene as a frame of `[orbit]` sees it: selections are moved by M' of this camera. From the scene's own
    /// camera, M' = M.
    ///
    /// # Errors
    /// The errors of [`Job::view`].
    pub fn seen_from(&self, view: View) -> Result<SceneVariant, Failure> {
        let (first, mut scene) = (self.view()?, self.scene.clone());
        if view != first {
            let followers = (0..scene.objects.len()).filter(|&i| self.scene.follows_camera(i));
            followers.for_each(|i| self.objects.follow(i, &mut scene.objects[i], [&first, &view]));
        }
        let plan = self.plan_of(&scene);
        Ok(SceneVariant { scene, plan, function: self.assets.function.clone(), view: Some(view) })
    }
}
