//! The provenance of pictures ([IO-2]).

use super::Job;
use drypoint_scene::file::{figure_identity, identity};
use drypoint_scene::picture::Provenance;
use drypoint_scene::plan::Plan;
use drypoint_scene::tables::{Figure, Scene};
use sha2::{Digest, Sha256};

impl Job {
    /// Returns the provenance of this job's picture ([IO-2]). Two files of the same scene give the same provenance.
    pub fn provenance(&self) -> Provenance {
        self.provenance_of(0)
    }

    /// Returns the provenance of a frame. That of frame 0 equals the scene's without `[orbit]`, byte for byte.
    pub fn provenance_of(&self, frame: usize) -> Provenance {
        if frame == 0 {
            let still = Scene { orbit: None, ..self.scene.clone() };
            return provenance(&still, &self.plan_of(&still));
        }
        let mut provenance = provenance(&self.scene, &self.plan_of(&self.scene));
        provenance.plan.push_str(&format!("orbit: frame {frame}\n"));
        provenance
    }
}

/// Returns the provenance of a scene ([IO-2]).
pub(crate) fn provenance(scene: &Scene, plan: &Plan) -> Provenance {
    Provenance { software: SOFTWARE.into(), scene_hash: hash(&identity(scene)), plan: plan.summary() }
}

/// Returns the provenance of a figure: its hash is that of its keys and of the hashes of its scenes.
pub(crate) fn figure_provenance(figure: &Figure, panels: &[Provenance]) -> Provenance {
    let hashes: Vec<&str> = panels.iter().map(|panel| panel.scene_hash.as_str()).collect();
    let plans: Vec<String> = panels.iter().enumerate().map(|(i, p)| format!("scene {i}:\n{}", p.plan)).collect();
    Provenance {
        software: SOFTWARE.into(),
        scene_hash: hash(&format!("{}{}", figure_identity(figure), hashes.concat())),
        plan: plans.concat(),
    }
}

/// The program with its version.
const SOFTWARE: &str = concat!("drypoint ", env!("CARGO_PKG_VERSION"));

/// SHA-256 of a text, in hexadecimal.
fn hash(text: &str) -> String {
    Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect()
}
