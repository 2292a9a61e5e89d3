//! The provenance of pictures ([IO-2]).

use super::Job;
use drypoint_scene::file::identity;
use drypoint_scene::picture::Provenance;
use drypoint_scene::plan::Plan;
use drypoint_scene::tables::Scene;
use sha2::{Digest, Sha256};

impl Job {
    /// Returns the provenance of this job's picture ([IO-2]). Two files of the same scene give the same provenance.
    pub fn provenance(&self) -> Provenance {
        self.provenance_of(0)
    }

    /// Returns the provenance of a frame. That of frame 0 equals the scene's without `[orbit]`, byte for byte.
    pub fn provenance_of(&self, frame: usize) -> Provenance {
        let plan = self.plan_of(&self.scene);
        if frame == 0 {
            return provenance(&Scene { orbit: None, ..self.scene.clone() }, &plan);
        }
        let mut provenance = provenance(&self.scene, &plan);
        provenance.plan.push_str(&format!("orbit: frame {frame}\n"));
        provenance
    }
}

/// Returns the provenance of a scene ([IO-2]).
pub(crate) fn provenance(scene: &Scene, plan: &Plan) -> Provenance {
    Provenance {
        software: concat!("drypoint ", env!("CARGO_PKG_VERSION")).into(),
        scene_hash: Sha256::digest(identity(scene)).iter().map(|byte| format!("{byte:02x}")).collect(),
        plan: plan.summary(),
    }
}
