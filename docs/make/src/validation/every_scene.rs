//! Every scene of the project on a graphics card, small.

use drypoint::gpu::Gpu;
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, load};
use drypoint::validate::{Validation, validate};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Pixels across and down.
const SIZE: [usize; 2] = [48, 36];

/// The outcome of a scene.
enum Outcome {
    /// Its volume is not drawn.
    MarksAlone,
    /// A card does not draw it, and why.
    Refused(String),
    /// It is drawn as by the reference in f64; within bounds in f32, or without any.
    Same(Validation),
    /// It is not.
    Fails(Validation),
}

/// A section about all scenes. Scenes without their data are left out.
///
/// # Errors
/// The system's failure to read the folder of scenes, and a scene that fails.
pub(super) fn section(gpu: &Gpu) -> Result<String, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/scenes");
    let mut files = Vec::new();
    scenes_below(&root, &mut files).map_err(|error| error.to_string())?;
    files.sort();
    let (mut marks, mut bounded, mut without, mut refused, mut absent) = (0, Vec::new(), Vec::new(), Vec::new(), 0);
    for file in files {
        let name = name_of(&root, &file);
        match outcome(&file, gpu) {
            None => absent += 1,
            Some(Outcome::MarksAlone) => marks += 1,
            Some(Outcome::Refused(why)) => refused.push((name, why)),
            Some(Outcome::Same(found)) if found.bounded.is_some() => bounded.push((name, found)),
            Some(Outcome::Same(found)) => without.push((name, found)),
            Some(Outcome::Fails(found)) => return Err(format!("{name}: {found}")),
        }
    }
    let mut text = format!(
        "\n## Every scene\n\nEach scene of `data/scenes` at {} × {} pixels. {} keep their bounds. {} equal the reference in f64 \
         and have no bounds. {} are refused. {marks} draw no volume.",
        SIZE[0],
        SIZE[1],
        bounded.len(),
        without.len(),
        refused.len()
    );
    if absent > 0 {
        let _ = write!(text, " The data of {absent} were not there.");
    }
    text.push_str("\n\n| scene | largest difference in f32 | RMS | largest bound | slack | pixels at a decision or without a bound |\n|---|---|---|---|---|---|\n");
    for (name, found) in bounded.iter().chain(&without) {
        let single = found.stages.last().map_or(f64::NAN, |stage| stage.single);
        let _ = write!(text, "| {name} | {single:.1e} | {:.1e} |", found.rms);
        let _ = match &found.bounded {
            Some(bounded) => writeln!(
                text,
                " {:.1e} | {:.1} | {:.1} % |",
                bounded.bound,
                1.0 / bounded.share.max(f64::MIN_POSITIVE),
                100.0 * (bounded.endless + bounded.undecided)
            ),
            None => writeln!(text, " {} | | |", found.unbounded.as_deref().unwrap_or_default()),
        };
    }
    for (name, why) in &refused {
        let _ = writeln!(text, "| {name} | refused: {why} | | | | |");
    }
    Ok(text)
}

/// The room and the stem of a scene.
fn name_of(root: &Path, file: &Path) -> String {
    file.strip_prefix(root).unwrap_or(file).with_extension("").display().to_string().replace('\\', "/")
}

/// Draws a scene and compares it; none if its data are not there.
fn outcome(file: &Path, gpu: &Gpu) -> Option<Outcome> {
    let size = format!("[{}, {}]", SIZE[0], SIZE[1]);
    let scene = load(file, &[("picture.size", &*size)].into_iter().collect::<Overrides>()).ok()?;
    let job = Job::load(scene).ok()?;
    if !job.draws_volume() {
        return Some(Outcome::MarksAlone);
    }
    Some(match validate(&job, gpu) {
        Ok(found) if found.is_wrong() || found.bounded.is_none() && !found.has_double() => Outcome::Fails(found),
        Ok(found) => Outcome::Same(found),
        Err(failure) => Outcome::Refused(failure.what),
    })
}

/// Lists the scenes of a folder and of those below it.
fn scenes_below(folder: &Path, found: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            scenes_below(&path, found)?;
        } else if path.extension().is_some_and(|e| e == "toml") {
            found.push(path);
        }
    }
    Ok(())
}
