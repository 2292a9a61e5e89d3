//! Counts and seconds of one scene.

use super::effects::Settings;
use crate::labels::write_ball;
use drypoint::drawing::Drawing;
use drypoint::job::Job;
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse};
use std::collections::BTreeMap;
use std::time::Instant;
use tempfile::TempDir;

/// Every count but seconds, by its name: those of maps with the map's name before theirs.
pub(super) type Named = BTreeMap<String, u64>;

/// A folder of scenes, with a volume of labels in it: a ball is 1, what is around it 0.
pub(super) struct Folder(TempDir);

impl Folder {
    pub(super) fn new() -> Result<Self, String> {
        let folder = tempfile::tempdir().map_err(|e| e.to_string())?;
        write_ball(48, &folder.path().join("labels.nrrd"))?;
        Ok(Self(folder))
    }

    /// A scene with settings over it, loaded.
    pub(super) fn job(&self, base: &str, settings: &[Settings]) -> Result<Job, String> {
        let folder = self.0.path().display().to_string();
        let settings = settings.iter().flat_map(|s| s.iter());
        let overrides: Overrides = settings.map(|(key, value)| (*key, value.replace("{folder}", &folder))).collect();
        let scene = parse(base, "effect.toml".as_ref(), &overrides).map_err(|e| e.to_string())?;
        Job::load(scene).map_err(|e| e.to_string())
    }
}

/// What a scene's preparation and one frame did, and in how many seconds.
pub(super) fn run(job: &Job) -> Result<(Named, f64), String> {
    let start = Instant::now();
    let mut counts = Counts::default();
    let marking = Marking::new(job, &mut counts, &|_| ()).map_err(|e| e.to_string())?;
    let mut drawing = Drawing::new(job, &marking, &mut counts).map_err(|e| e.to_string())?;
    let (frame, own) = drawing.frame(0, &|_| ()).map_err(|e| e.to_string())?;
    counts.add(&own);
    let seconds = start.elapsed().as_secs_f64();
    std::hint::black_box(frame.marks());
    Ok((named(&counts)?, seconds))
}

/// Through the JSON of `--stats`, so that no count can be forgotten here.
fn named(counts: &Counts) -> Result<Named, String> {
    let json = serde_json::to_value(counts).map_err(|e| e.to_string())?;
    let mut named = Named::new();
    for (name, value) in json.as_object().into_iter().flatten() {
        if let Some(count) = value.as_u64() {
            named.insert(name.clone(), count);
        }
        for (key, value) in value.as_object().into_iter().flatten().filter(|_| name != "seconds") {
            named.insert(format!("{name}.{key}"), value.as_u64().unwrap_or(0));
        }
    }
    Ok(named)
}

/// The median.
pub(super) fn median(mut seconds: Vec<f64>) -> f64 {
    seconds.sort_by(f64::total_cmp);
    seconds[seconds.len() / 2]
}
