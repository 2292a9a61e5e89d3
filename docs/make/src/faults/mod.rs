//! `docs/planted-faults.md`: a fault of 1 % in each multiplication of the shaders, one at a time, and whether a scene
//! notices it.

mod may_be_off;
mod planting;
mod scenes;
mod table;

use crate::files;
use crate::results::Results;
use drypoint::Failure;
use drypoint::gpu::{Gpu, GpuJob, Interpolation, Precision};
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::picture::LayerKind;
use drypoint::validate::Truth;
use planting::Multiplication;
use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

/// Pixels across and down of the pictures.
const SIZE: [usize; 2] = [24, 24];

/// Plants the faults that have no outcome yet, and writes the page once all have one. Each outcome is kept at once
/// ([`Results`]), so that a run may be ended at any time. Words after the command select faults that are planted anew, by a
/// part of `MODULE.wgsl:LINE:COLUMN: TEXT`.
///
/// # Errors
/// No adapter in f64, a scene that does not load or that notices what is no fault, a fault that no scene notices.
pub(crate) fn write() -> Result<(), String> {
    let gpu = drypoint::gpu::open(Interpolation::Exact).map_err(|failure| failure.to_string())?;
    let (jobs, mut results) = (jobs()?, Results::open(&gpu, "planted-faults")?);
    let scenes = scenes(&jobs, &gpu)?;
    let all = multiplications()?;
    let mut page = Page { wrong: may_be_off::unused(&all).collect(), ..Page::default() };
    for fault in &all {
        let place = format!("{}.wgsl:{}:{}: {}", fault.module, fault.line, fault.column + 1, fault.text);
        let find = || Ok(Some(outcome(fault, &scenes, &gpu)?.cells()));
        if let Some(outcome) = results.of(&place, &find)?.as_deref().and_then(Outcome::of) {
            page.add(fault, outcome, &place);
        }
    }
    if !page.wrong.is_empty() {
        return Err(page.wrong.join("\n"));
    }
    if results.missing > 0 {
        println!("The page waits for {} faults that were not planted.", results.missing);
        return Ok(());
    }
    files::write("planted-faults.md", page.text(jobs.len()).as_bytes())
}

fn multiplications() -> Result<Vec<Multiplication>, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gpu/src");
    planting::multiplications(&root).map_err(|error| error.to_string())
}

/// The outcome of a fault.
#[derive(Debug, PartialEq)]
enum Outcome {
    /// The numbers are integers, which take no factor.
    Integers,
    /// The scene that notices the fault.
    Noticed(String),
    /// No scene need notice it, and why.
    MayBeOff(String),
    /// No scene notices it.
    Unnoticed,
    /// No scene has the function.
    Absent,
}

impl Outcome {
    fn cells(self) -> Vec<String> {
        match self {
            Self::Integers => vec!["integers".into()],
            Self::Noticed(scene) => vec!["noticed".into(), scene],
            Self::MayBeOff(reason) => vec!["may be off".into(), reason],
            Self::Unnoticed => vec!["unnoticed".into()],
            Self::Absent => vec!["absent".into()],
        }
    }

    fn of(cells: &[String]) -> Option<Self> {
        let (kind, words) = cells.split_first()?;
        let words = words.concat();
        Some(match kind.as_str() {
            "integers" => Self::Integers,
            "noticed" => Self::Noticed(words),
            "may be off" => Self::MayBeOff(words),
            "unnoticed" => Self::Unnoticed,
            "absent" => Self::Absent,
            _ => return None,
        })
    }
}

/// Plants a fault of an elementary function in their table, and any other in one scene after another, until one notices it.
fn outcome(fault: &Multiplication, scenes: &[Scene<'_>], gpu: &Gpu) -> Result<Outcome, String> {
    if let Some(reason) = may_be_off::reason(fault) {
        return Ok(Outcome::MayBeOff(reason.into()));
    }
    if let Some(is_noticed) = table::notices(fault, gpu).map_err(|error| error.to_string())? {
        return Ok(if is_noticed { Outcome::Noticed(table::NAME.into()) } else { Outcome::Unnoticed });
    }
    let mut outcome = Outcome::Absent;
    for scene in scenes.iter().filter(|scene| fault.is_in(&scene.text)) {
        match scene.notices(fault) {
            Ok(true) => return Ok(Outcome::Noticed(scene.name.into())),
            Ok(false) => outcome = Outcome::Unnoticed,
            Err(failure) if is_about_types(&failure) => return Ok(Outcome::Integers),
            Err(failure) => return Err(format!("{}, {}: {failure}", scene.name, fault.text)),
        }
    }
    Ok(outcome)
}

/// Whether the text of a shader was refused. All that a fault can break are types: an integer has no real factor.
fn is_about_types(failure: &Failure) -> bool {
    failure.what.contains("create_shader_module")
}

/// A scene with all that faults are compared with.
struct Scene<'j> {
    name: &'static str,
    job: &'j Job,
    gpu: &'j Gpu,
    /// The text of its shader.
    text: String,
    prepared: OnceCell<(Truth<'j>, GpuJob<'j>)>,
}

impl<'j> Scene<'j> {
    fn new(name: &'static str, job: &'j Job, gpu: &'j Gpu) -> Result<Self, Failure> {
        let text = GpuJob::new(job, gpu, Precision::Single)?.text(Precision::Single)?;
        Ok(Self { name, job, gpu, text, prepared: OnceCell::new() })
    }

    fn notices(&self, fault: &Multiplication) -> Result<bool, Failure> {
        if self.prepared.get().is_none() {
            let further: Vec<LayerKind> =
                self.job.scene.picture.layers.iter().copied().filter(|layer| *layer != LayerKind::Beauty).collect();
            let truth = Truth::new(self.job, &further)?;
            let on_card = truth.on_card(self.gpu)?;
            let is_wrong = truth.notices(&on_card, &|text| text)?;
            assert!(!is_wrong, "{}: parts without a fault", self.name);
            let _ = self.prepared.set((truth, on_card));
        }
        let Some((truth, on_card)) = self.prepared.get() else { return Ok(false) };
        truth.notices(on_card, &|text| fault.planted(&text).unwrap_or(text))
    }
}

/// The jobs of all scenes with their names.
fn jobs() -> Result<Vec<(&'static str, Job)>, String> {
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let load = |(name, text, keys): scenes::SceneText| {
        let scene = parse(
            &text,
            &folder.path().join("scene.toml"),
            &Overrides::from_iter(keys.iter().map(|(key, value)| (*key, value.as_str()))),
        );
        let job = scene.map_err(|faults| faults.to_string());
        let job = job.and_then(|scene| Job::load(scene).map_err(|failures| failures.to_string()));
        job.map(|job| (name, job)).map_err(|why| format!("{name}: {why}"))
    };
    let scenes = scenes::all(folder.path(), SIZE).map_err(|error| error.to_string())?;
    scenes.into_iter().map(load).collect()
}

/// The scenes of jobs, short shaders first: compiling them takes most of the time.
fn scenes<'j>(jobs: &'j [(&'static str, Job)], gpu: &'j Gpu) -> Result<Vec<Scene<'j>>, String> {
    let scene =
        |(name, job): &'j (&'static str, Job)| Scene::new(name, job, gpu).map_err(|why| format!("{name}: {why}"));
    let mut scenes = jobs.iter().map(scene).collect::<Result<Vec<_>, String>>()?;
    scenes.sort_by_key(|scene| scene.text.len());
    Ok(scenes)
}

/// The page while faults are planted.
#[derive(Default)]
struct Page {
    /// Number of multiplications of integers.
    integers: usize,
    /// For each room, the number of faults and of those that a scene notices.
    rooms: BTreeMap<String, [usize; 2]>,
    /// Rows of faults that may be off.
    off: Vec<String>,
    /// Faults that must be noticed and are not, and entries of the list that stand for none.
    wrong: Vec<String>,
}

impl Page {
    fn add(&mut self, fault: &Multiplication, outcome: Outcome, place: &str) {
        if outcome == Outcome::Integers {
            self.integers += 1;
            return;
        }
        let room = fault.module.split('/').next().unwrap_or_default().to_owned();
        let [planted, noticed] = self.rooms.entry(room).or_default();
        *planted += 1;
        match outcome {
            Outcome::Noticed(_) => *noticed += 1,
            Outcome::MayBeOff(reason) => {
                self.off.push(format!("| {}.wgsl:{} | `{}` | {reason} |", fault.module, fault.line, fault.text));
            }
            other => self.wrong.push(format!("{place}\n    {other:?}")),
        }
    }

    fn text(&self, scenes: usize) -> String {
        let [planted, noticed] = self.rooms.values().fold([0, 0], |[a, b], [c, d]| [a + c, b + d]);
        let mut text = format!(
            "{INTRODUCTION}{scenes} scenes of {} × {} pixels were tried, those with the shortest shader first. {} multiplications \
             of integers, which find places in lists, are left out.\n\n| room of `gpu/src` | faults | noticed |\n|---|--:|--:|\n",
            SIZE[0], SIZE[1], self.integers
        );
        for (room, [planted, noticed]) in &self.rooms {
            let _ = writeln!(text, "| {room} | {planted} | {noticed} |");
        }
        let _ = writeln!(text, "| all | {planted} | {noticed} |");
        text.push_str(OFF);
        self.off.iter().for_each(|row| text.extend([row.as_str(), "\n"]));
        text
    }
}

const INTRODUCTION: &str = "<!-- Written by `cargo run --release -p drypoint-docs -- faults`. -->
# Planted faults

A comparison is worth what it notices.
`drypoint-docs faults` makes the result of one multiplication of the shaders 1 % too large, in every copy of its function, and draws small scenes with it.
A scene notices the fault if `drypoint validate` would: a pixel exceeds its bound in f32 or, where a scene has no bounds, a stage differs from the reference in f64 ([validation](validation.md)).
One scene is enough.

";

const OFF: &str = "
## What may be off

No scene need notice these.

| module | line | reason |
|---|---|---|
";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_is_read_and_the_list_has_no_old_entries() {
        jobs().unwrap();
        assert_eq!(may_be_off::unused(&multiplications().unwrap()).collect::<Vec<_>>(), [""; 0]);
    }

    /// The command plants all; here it is a few of them, drawn by lot.
    #[test]
    fn a_sample_of_faults_is_noticed() {
        const SAMPLE: usize = 4;
        let gpu = match drypoint::gpu::open(Interpolation::Exact) {
            Ok(gpu) if gpu.has_double() => gpu,
            _ => return println!("skipped: no adapter with f64"),
        };
        let (jobs, all) = (jobs().unwrap(), multiplications().unwrap());
        let scenes = scenes(&jobs, &gpu).unwrap();
        let mut seed = 51u64;
        let mut planted = 0;
        while planted < SAMPLE {
            // Knuth's MMIX generator.
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let fault = &all[(seed >> 33) as usize % all.len()];
            let place = format!("{}.wgsl:{}: {}", fault.module, fault.line, fault.text);
            match outcome(fault, &scenes, &gpu).unwrap() {
                Outcome::Integers | Outcome::MayBeOff(_) => {}
                Outcome::Noticed(scene) => {
                    println!("{place}: {scene}");
                    planted += 1;
                }
                other => panic!("{place}: {other:?}"),
            }
        }
    }
}
