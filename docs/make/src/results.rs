//! Results that a page is made of, found one by one: a run that ends early is continued by the next.

use crate::files::in_docs;
use drypoint::gpu::Gpu;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

/// The cells of each result, of one adapter and one build of this program.
pub(crate) struct Results {
    place: PathBuf,
    /// The adapter and a hash of this program.
    made_by: String,
    cells: BTreeMap<String, Vec<String>>,
    /// Words of names that are found anew; none: those that have no cells.
    asked: Vec<String>,
    /// How many were not asked for and have no cells.
    pub(crate) missing: usize,
}

impl Results {
    /// Reads what earlier runs found for a page. Results of another adapter or another build do not count.
    ///
    /// # Errors
    /// The system's failure to read this program.
    pub(crate) fn open(gpu: &Gpu, page: &str) -> Result<Self, String> {
        let program = std::env::current_exe().and_then(std::fs::read).map_err(|e| e.to_string())?;
        let hash: String = Sha256::digest(&program).iter().take(8).map(|byte| format!("{byte:02x}")).collect();
        let made_by = format!("{}, {hash}", gpu.describe());
        let place = in_docs(&format!("../target/{page}.txt"));
        let before = std::fs::read_to_string(&place).unwrap_or_default();
        let kept = before.strip_prefix(&*made_by).unwrap_or_default();
        let cells = kept.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
        let asked = std::env::args().skip(2).collect();
        Ok(Self { place, made_by, cells, asked, missing: 0 })
    }

    /// Returns the cells of a name: those of an earlier run, or those that `find` finds, which are kept at once. None if it
    /// finds none, or if the name was neither asked for nor found before.
    ///
    /// # Errors
    /// Those of `find`, and the system's failure to write.
    pub(crate) fn of(
        &mut self,
        name: &str,
        find: &dyn Fn() -> Result<Option<Vec<String>>, String>,
    ) -> Result<Option<Vec<String>>, String> {
        let kept = self.cells.get(name);
        let due = if self.asked.is_empty() {
            kept.is_none()
        } else {
            self.asked.iter().any(|word| name.contains(word.as_str()))
        };
        if !due {
            self.missing += usize::from(kept.is_none());
            return Ok(kept.cloned());
        }
        let begin = Instant::now();
        let found = find()?;
        if let Some(cells) = &found {
            println!("{:>8.1} s {name}: {}", begin.elapsed().as_secs_f64(), cells.join(" | "));
            self.cells.insert(name.into(), cells.clone());
            self.write()?;
        }
        Ok(found)
    }

    fn write(&self) -> Result<(), String> {
        let mut text = format!("{}\n", self.made_by);
        for line in &self.cells {
            text += &serde_json::to_string(&line).map_err(|e| e.to_string())?;
            text.push('\n');
        }
        if let Some(folder) = self.place.parent() {
            std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        }
        std::fs::write(&self.place, text).map_err(|e| format!("{}: {e}", self.place.display()))
    }
}
