//! `docs/validation.md`: graphics cards against the reference, effect by effect.

mod every_scene;
pub(crate) mod scenes;

use crate::results::Results;
use crate::{files, labels};
use drypoint::gpu::Gpu;
use drypoint::job::Job;
use drypoint::reference::number::Decision;
use drypoint::scene::file::{Overrides, parse};
use drypoint::validate::{SAME, Validation, Verdict, validate};
use std::fmt::Write;

/// Pixels across and down of the pictures.
const SIZE: [usize; 2] = [320, 240];

/// Compares every scene that has no result yet, or those whose names contain a word behind `validation`, and writes the
/// page once all have one. Each result is kept at once ([`Results`]), so that a run may be ended at any time.
///
/// # Errors
/// No adapter, a scene that does not load, and a comparison that fails.
pub(crate) fn write() -> Result<(), String> {
    let gpu = drypoint::gpu::open(drypoint::gpu::Interpolation::Exact).map_err(|failure| failure.to_string())?;
    let mut results = Results::open(&gpu, "validation")?;
    let (mut algorithm, mut bounds) = (String::new(), String::new());
    for (name, more) in scenes::SCENES {
        let compare = || {
            let validation = of_scene(name, more, &gpu).map_err(|why| format!("{name}: {why}"))?;
            match validation.verdict() {
                Verdict::Failed => Err(format!("{name}: {validation}")),
                _ => Ok(Some(vec![stage_cells(&validation), bound_cells(&validation)])),
            }
        };
        if let Some([stages, bound]) = results.of(name, &compare)?.as_deref() {
            let _ = writeln!(algorithm, "| {name} | {stages} |");
            let _ = writeln!(bounds, "| {name} | {bound} |");
        }
    }
    let every_scene = every_scene::section(&gpu, &mut results)?;
    if results.missing > 0 {
        println!("The page waits for {} scenes that were not compared.", results.missing);
        return Ok(());
    }
    files::write("validation.md", (page(&gpu, &algorithm, &bounds) + &every_scene).as_bytes())
}

fn of_scene(name: &str, more: &str, gpu: &Gpu) -> Result<Validation, String> {
    let text = scenes::scene(name, more, SIZE);
    let folder = tempfile::tempdir().map_err(|e| e.to_string())?;
    let mut over = Overrides::default();
    if name == scenes::OF_LABELS {
        let path = folder.path().join("labels.nrrd");
        labels::write_ball(24, &path)?;
        over = [("volume.labels", path.display().to_string())].into_iter().collect();
    }
    let scene = parse(&text, "scene.toml".as_ref(), &over).map_err(|faults| faults.to_string())?;
    let job = Job::load(scene).map_err(|failures| failures.to_string())?;
    validate(&job, gpu).map_err(|failure| failure.to_string())
}

/// The largest difference of each stage in f64, as a share of the stage's largest number.
fn stage_cells(validation: &Validation) -> String {
    let of = |stage: &str| {
        let stage = validation.stages.iter().find(|found| found.name == stage);
        let share = |double: f64, largest: f64| if largest > 0.0 { double / largest } else { double };
        let share = stage.and_then(|found| found.double.map(|double| share(double, found.largest)));
        share.map_or_else(String::new, |share| format!("{share:.1e}"))
    };
    ["value", "normal", "curvature", "opacity", "gradient", "colour"].map(of).join(" | ")
}

/// The bounds of pixels and what was measured, or the reason why there are none.
fn bound_cells(validation: &Validation) -> String {
    let Some(bounded) = &validation.bounded else {
        return format!("{} | | | | | | |", validation.unbounded.as_deref().unwrap_or_default());
    };
    format!(
        "{:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1} | {:.2} % | {:.2} % | {:.1e}",
        bounded.median,
        bounded.bound_of_99_percent,
        bounded.bound,
        bounded.measured,
        1.0 / bounded.share.max(f64::MIN_POSITIVE),
        100.0 * bounded.endless,
        100.0 * bounded.undecided,
        bounded.measured_at_decisions
    )
}

fn page(gpu: &Gpu, algorithm: &str, bounds: &str) -> String {
    let mut page = String::from(INTRODUCTION);
    let _ = write!(page, "The figures below are of {}, {} × {} pixels.\n\n", gpu.describe(), SIZE[0], SIZE[1]);
    page.push_str("## The same algorithm\n\n");
    let _ = write!(
        page,
        "The shaders run in f64, and every stage of a sample is compared with the reference. A stage parts where it differs \
         by more than {SAME:.0e} of its largest number. Value, normal \
         and κ are those of the first visible sample of each ray, on which no opacity has a part; opacity is compared by \
         depths.\n\n| effect | value | normal | κ | opacity | gradient | colour |\n\
         |---|---|---|---|---|---|---|\n{algorithm}\n## Bounds in f32\n\n{BOUNDS}{bounds}"
    );
    page.push_str("\n## Decisions\n\nNo bound holds where a picture jumps. A pixel is at a decision if errors leave one of these open:\n\n");
    for decision in Decision::ALL {
        let _ = writeln!(page, "- {}", decision.sentence());
    }
    page.push_str(REST);
    page
}

const INTRODUCTION: &str = "<!-- Written by `cargo run --release -p drypoint-docs -- validation`. -->
# Validation of graphics cards

`drypoint render SCENE --backend gpu` draws a picture on a graphics card, in f32.
`drypoint validate SCENE` compares it with the reference and ends with 1 if a bound is exceeded, if a stage parts in f64, or, where bounds are known, if more than a tenth of the pixels have none.
It ends with 3 and the verdict \"not proven\" if no bound is known for the scene: then nothing is known of f32, also where every stage agrees in f64.
Both need a build with `--features gpu`.

Three comparisons stand behind a picture:

1. **Formula by formula.** Functions of the shaders run over a table of inputs, random ones and hard cases, and are compared with the reference's (`tests/gpu/formulas`); a test lists those that have no table, which put others together or read the volume.
2. **The algorithm without rounding.** The same text runs with f64 for its numbers, where the adapter has them, and equals the reference.
3. **f32 within derived bounds.** The reference draws the picture on numbers that know how far an f32 evaluation may lie from them.

A fault of 1 % in each multiplication of the shaders was planted, one at a time, and a scene must notice it: [planted faults](planted-faults.md).

";

const BOUNDS: &str = "The bound of a pixel is the sum of what each operation of its rays may add, in the order of the reference's formulas. It is computed with the picture, not fitted to it. A bound above ½ says nothing, and its pixel counts as one without a bound.
The grants of operations and their sources are a table in `reference/src/number/bounded.rs`; the files of `reference/src/ray/bounds` have the error models of positions, rays of objects, iso-surfaces, lines, layers and rays at edges, `reference/src/mesh/possible.rs` that of hits of meshes, and `reference/src/volumetric_halos/possible_field.rs` that of the spreading of halos.
The layers of stages have bounds, too. `drypoint validate` tells each stage's largest difference as a share of its bound, and a share above 1 is a failure.
*Slack* is how many times smaller than its own bound the difference of the closest pixel is: below 1 the bound would be broken.

| effect | median bound | bound of 99 % | largest bound | largest difference | slack | pixels without a bound | pixels at a decision | largest difference there |
|---|---|---|---|---|---|---|---|---|
";

const REST: &str = "
## The texture unit

`--backend gpu-fast` interpolates between voxels by the texture unit, where the kernel is trilinear; gradients by central differences, too.
Hardware weighs voxels with 8 bits, so a value is off by up to 3·2⁻⁸ of the largest difference between neighbours, which a test holds it to. Software adapters filter in f32.
Everything else is as with `--backend gpu`. No bound of a pixel is derived for it.

## Not drawn by graphics cards yet

Lines inside a volume with halos. A scene that asks for them is refused, with the key that asks; the CPU draws it.
A layer of counts has the samples that the card evaluates, and they differ from the CPU's: f32 ends rays elsewhere, and other bricks are skipped. A sample that lines split counts once.
Bounds are known for colours over every transfer function, objects, meshes and halos, with rays at edges, iso-surfaces of every kernel, cuts, lines inside the volume and further layers.
They are not known for halos of objects, smooth cutaways, layers of counts and of principal curvatures, and for lines and further layers beside objects, meshes or halos.
";
