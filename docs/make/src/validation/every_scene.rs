//! Every scene of the project on a graphics card, small.

use crate::results::Results;
use drypoint::gpu::Gpu;
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, load};
use drypoint::validate::validate;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Pixels across and down.
const SIZE: [usize; 2] = [48, 36];

/// What a comparison can end with. The first cell of a result is one of these words, the second the row behind the name.
const KINDS: [&str; 4] = ["bounded", "without", "refused", "marks"];

/// A section about all scenes. Scenes without their data are left out.
///
/// # Errors
/// The system's failure to read the folder of scenes, and a scene that fails.
pub(super) fn section(gpu: &Gpu, results: &mut Results) -> Result<String, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/scenes");
    let mut files = Vec::new();
    scenes_below(&root, &mut files).map_err(|error| error.to_string())?;
    files.sort();
    let total = files.len();
    let mut rows: [Vec<String>; KINDS.len()] = Default::default();
    for file in files {
        let name = name_of(&root, &file);
        if let Some([kind, row]) = results.of(&name, &|| cells(&name, &file, gpu))?.as_deref()
            && let Some(of_kind) = KINDS.iter().position(|known| known == kind)
        {
            rows[of_kind].push(format!("| {name} | {row} |\n"));
        }
    }
    let [bounded, without, refused, marks] = rows.each_ref().map(Vec::len);
    let absent = total - bounded - without - refused - marks;
    let mut text = format!(
        "\n## Every scene\n\nEach scene of `data/scenes` at {} × {} pixels. {bounded} keep their bounds. {without} equal the \
         reference in f64 and have no bounds. {refused} are refused. {marks} draw no volume.",
        SIZE[0], SIZE[1],
    );
    if absent > 0 {
        let _ = write!(text, " The data of {absent} were not there.");
    }
    text.push_str(
        "\n\n| scene | largest difference in f32 | RMS | median bound | bound of 99 % | largest bound | slack | pixels at a \
         decision or without a bound |\n|---|---|---|---|---|---|---|---|\n",
    );
    text.extend(rows[..3].concat());
    Ok(text)
}

/// Draws a scene and compares it; none if its data are not there.
fn cells(name: &str, file: &Path, gpu: &Gpu) -> Result<Option<Vec<String>>, String> {
    let size = format!("[{}, {}]", SIZE[0], SIZE[1]);
    let over = [("picture.size", &*size)].into_iter().collect::<Overrides>();
    let Some(job) = load(file, &over).ok().and_then(|scene| Job::load(scene).ok()) else { return Ok(None) };
    let [kind_bounded, kind_without, kind_refused, kind_marks] = KINDS;
    let (kind, row) = if !job.draws_volume() {
        (kind_marks, String::new())
    } else {
        match validate(&job, gpu) {
            Err(failure) => (kind_refused, format!("refused: {} | | | | | |", failure.what)),
            Ok(found) if found.is_wrong() || found.bounded.is_none() && !found.has_double() => {
                return Err(format!("{name}: {found}"));
            }
            Ok(found) => {
                let single = found.stages.last().map_or(f64::NAN, |stage| stage.single);
                let measured = format!("{single:.1e} | {:.1e}", found.rms);
                match &found.bounded {
                    Some(bounded) => (
                        kind_bounded,
                        format!(
                            "{measured} | {:.1e} | {:.1e} | {:.1e} | {:.1} | {:.1} %",
                            bounded.median,
                            bounded.bound_of_99_percent,
                            bounded.bound,
                            1.0 / bounded.share.max(f64::MIN_POSITIVE),
                            100.0 * (bounded.endless + bounded.undecided)
                        ),
                    ),
                    None => {
                        let why = found.unbounded.as_deref().unwrap_or_default();
                        (kind_without, format!("{measured} | {why} | | | |"))
                    }
                }
            }
        }
    };
    Ok(Some(vec![kind.into(), row]))
}

/// The room and the stem of a scene.
fn name_of(root: &Path, file: &Path) -> String {
    file.strip_prefix(root).unwrap_or(file).with_extension("").display().to_string().replace('\\', "/")
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
