//! Warnings of an empty page or picture, with the cause and the key responsible.

use super::Talk;
use super::report::note;
use crate::drawing::Frame;
use crate::job::Job;
use crate::scene::counts::Counts;
use crate::scene::shot::OutOfSight;
use crate::scene::tables::{HatchIso, Hatching, Hidden, Iso, Outlines, Spacing};

/// Warns if the first frame shows nothing. `made` holds the counts of the preparation and of the frame.
pub(super) fn warn_of_nothing(job: &Job, frame: &Frame, made: [&Counts; 2], talk: Talk) {
    let [dots, lines] = frame.marks();
    if frame.marks.is_some() && !job.draws_volume() && dots + lines == 0 {
        let why = absent(job).map_or_else(|| causes(job, made), |why| vec![why]);
        let colon = if why.is_empty() { "" } else { ": " };
        note(talk, format_args!("warning: the page is empty{colon}{}", why.join("; ")));
    }
    if job.draws_volume() && frame.picture.as_ref().is_some_and(|picture| job.shows_nothing(picture)) {
        note(talk, format_args!("warning: nothing is seen: {}", unmet(job)));
    }
}

/// Returns the reason why a picture of the volume is empty.
fn unmet(job: &Job) -> String {
    // Objects may be moved out of the volume's box, and meshes are beside it.
    let is_volume_alone = job.scene.objects.is_empty() && job.scene.meshes.is_empty();
    let shot = job.shot().ok().filter(|_| is_volume_alone);
    match shot.and_then(|shot| OutOfSight::of(&job.scene, job.volume.grid(), &shot.view, shot.lattice)) {
        Some(OutOfSight::Camera) => "the camera looks past the volume; [camera] says where it is, and --set \
                                     camera=off shows the whole"
            .into(),
        Some(OutOfSight::Near) => {
            "all of the volume is nearer than camera.near; make it smaller, or leave it out".into()
        }
        Some(OutOfSight::Clips(clips)) => {
            let names: Vec<String> = clips.iter().map(|i| format!("clip[{i}]")).collect();
            match &names[..] {
                [name] => {
                    format!("{name} cuts away all that the camera sees of the volume; turn its normal, or leave it out")
                }
                _ => format!("{} together cut away all that the camera sees of the volume", names.join(", ")),
            }
        }
        None => {
            "no ray meets a value that transfer.nodes show; `drypoint info` tells the range of a volume, `drypoint \
                 plan --full` the nodes and the camera"
                .into()
        }
    }
}

/// Returns the reason if an iso-value of strokes lies outside the volume's range.
fn absent(job: &Job) -> Option<String> {
    let hatching = job.scene.hatching.as_ref().and_then(|hatching| match hatching.iso {
        HatchIso::Surface(iso) => Some(("hatching.iso", iso)),
        HatchIso::Transfer => None,
    });
    let outlines = job.scene.outlines.as_ref().map(|outlines| ("outlines.iso", outlines.iso));
    let [lo, hi] = job.volume.range();
    hatching.into_iter().chain(outlines).find_map(|(key, iso)| match iso {
        Iso::Value(value) if value < lo || value > hi => {
            Some(format!("{key} = {value} is none of the volume's values, which go from {lo} to {hi}"))
        }
        _ => None,
    })
}

/// Returns the reason for each table of strokes that was drawn and shows nothing.
fn causes(job: &Job, made: [&Counts; 2]) -> Vec<String> {
    let there = |name: &str| made.iter().any(|counts| counts.preprocess.contains_key(name));
    let number = |name: &str| made.iter().filter_map(|counts| counts.preprocess.get(name)).sum();
    let has_grown = made.iter().any(|counts| counts.stops.values().any(|&ends| ends > 0));
    let hatching = job.scene.hatching.as_ref().filter(|_| there("seeds"));
    let outlines = job.scene.outlines.as_ref().filter(|_| there("outline places"));
    let hatching = hatching.map(|table| no_strokes(table, &number, has_grown));
    hatching.into_iter().chain(outlines.map(|table| no_outlines(table, &number))).collect()
}

/// Returns the reason why no stroke of hatching is on the page.
fn no_strokes(table: &Hatching, number: &dyn Fn(&str) -> u64, has_grown: bool) -> String {
    let seeds = number("seeds");
    if seeds == 0 {
        return match (number("measures of seeds"), table.iso) {
            (1.., _) => {
                "no seed is drawn: hatching.min_curvature and hatching.min_gradient leave cells little chance or \
                         none, and hatching.seeds = \"dense\" draws all"
                    .into()
            }
            (_, HatchIso::Transfer) => "no cell of the volume has a value that transfer.nodes show".into(),
            (_, HatchIso::Surface(iso)) => {
                format!("no cell of the volume has hatching.iso{} between its corners", iso_text(iso))
            }
        };
    }
    if number("seeds at values that nothing shows") == seeds {
        return format!("all {seeds} seeds are at values that transfer.nodes do not show");
    }
    // The most frequent cause of rejected seeds, if no stroke has grown.
    let rejected = ["seeds without a direction", "seeds beside the surface", "seeds of strokes without length"];
    let [no_direction, no_surface, short] = rejected.map(number);
    let tried = no_direction + no_surface + short;
    if has_grown || tried == 0 {
        return format!("no stroke of {seeds} seeds is seen: all are {}", unseen(table));
    }
    if no_direction >= no_surface.max(short) {
        return format!(
            "{no_direction} of {tried} seeds have no direction of which the data are sure: hatching.directions.deviation \
             says how noisy they are, and rule = \"raw\" takes every direction"
        );
    }
    if no_surface >= short {
        return format!("the surface of hatching.iso was not found beside {no_surface} of {tried} seeds");
    }
    format!("strokes of {short} of {tried} seeds have no length: hatching.length, hatching.min_step")
}

/// Returns the possible reasons why grown strokes are not on the page.
fn unseen(table: &Hatching) -> String {
    let can_be = [
        (table.hidden != Hidden::Drawn, "hidden (hatching.hidden = \"drawn\" draws them)"),
        (true, "outside of the frame ([camera])"),
        (!table.has_one_width(), "thinner than hatching.stroke.min_width"),
        (table.spacing != Spacing::Random, "shorter than six widths of the pen"),
    ];
    let all: Vec<&str> = can_be.into_iter().filter(|(can_be, _)| *can_be).map(|(_, text)| text).collect();
    all.join(", or ")
}

/// Returns the reason why no outline is on the page.
fn no_outlines(table: &Outlines, number: &dyn Fn(&str) -> u64) -> String {
    match (number("outline places"), number("short strokes")) {
        (0, _) => format!("the surface of outlines.iso{} has no outline from this camera", iso_text(table.iso)),
        (_, 0) => "all outlines are hidden, or outside of the frame ([camera])".into(),
        (_, short) => format!("all that is seen of outlines, {short} lines, is shorter than outlines.min_length"),
    }
}

/// Returns " = value" for a message, or nothing for an automatic one.
fn iso_text(iso: Iso) -> String {
    match iso {
        Iso::Value(value) => format!(" = {value}"),
        Iso::Auto => String::new(),
    }
}
