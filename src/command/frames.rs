//! The files of a scene's frames, and the frames drawn into them.

use super::empty::warn_of_nothing;
use super::input::{self, SceneOverrides};
use super::report::{Progress, note};
use super::stats::{FrameTimes, cpu_seconds};
use super::{Talk, output_path};
use crate::drawing::{Drawing, room_for_page, write_animation};
use crate::gpu::Gpu;
use crate::job::Job;
use crate::marking::Marking;
use crate::scene::counts::Counts;
use crate::scene::picture::Picture;
use crate::scene::tables::Scene;
use crate::{Failure, Failures, Format};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The files of a scene's frames.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum FrameFiles {
    /// One frame.
    One(PathBuf),
    /// All frames in one file.
    Animated(PathBuf),
    /// One file for each frame: the text before and after the frame's number, and the number's digits.
    Numbered(PathBuf, [String; 2], usize),
}

impl FrameFiles {
    /// Returns the files that a name stands for, and checks that each can be written. A run of `#` stands for the
    /// number of a frame.
    ///
    /// # Errors
    /// `#` without `[orbit]`, or `[orbit]` without `#` if the format has no frames. A format of frames without `[orbit]`,
    /// or with `#`. Fewer digits than the last frame needs, or more than one run. A file that the scene reads. A missing
    /// or read-only folder.
    pub(super) fn of(path: &Path, scene: &Scene) -> Result<Self, Failure> {
        let files = Self::named(path, scene)?;
        output_path::writable(&files.path(0))?;
        let frames = match files {
            Self::One(_) | Self::Animated(_) => 1,
            Self::Numbered(..) => scene.orbit.map_or(1, |orbit| orbit.frames),
        };
        (0..frames).try_for_each(|frame| output_path::check_not_read(&files.path(frame), scene.files()))?;
        Ok(files)
    }

    fn named(path: &Path, scene: &Scene) -> Result<Self, Failure> {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let runs: Vec<&str> = name.split(|c| c != '#').filter(|run| !run.is_empty()).collect();
        let refused = |what: String, remedy: String| Err(Failure::new(what, path.display(), remedy));
        let animation = Format::of(path).filter(|format| Format::ANIMATIONS.contains(format)).map(Format::suffix);
        if let (Some(suffix), false) = (animation, runs.is_empty()) {
            return refused(format!(".{suffix} has all frames in one file"), "give a name without #".into());
        }
        let Some(orbit) = scene.orbit else {
            if let Some(suffix) = animation {
                let what = format!(".{suffix} is for the frames of [orbit], and the scene has no such table");
                return refused(what, "add --set orbit.frames=36, or give a name that ends in .png".into());
            }
            if runs.is_empty() {
                return Ok(Self::One(path.into()));
            }
            let what = "a # stands for the number of a frame, and the scene has no [orbit]";
            return refused(what.into(), "add a table [orbit], or give a name without #".into());
        };
        let digits = (orbit.frames - 1).max(1).ilog10() as usize + 1;
        let stem = output_path::stem(path);
        let suffix = path.extension().unwrap_or_default().to_string_lossy();
        let example = || format!("write {stem}_{}.{suffix}", "#".repeat(digits.max(3)));
        match runs[..] {
            [] if animation.is_some() => Ok(Self::Animated(path.into())),
            [] if Format::of(path) == Some(Format::Svg) && scene.draws_on_page() => {
                if scene.page.as_ref().is_some_and(|page| page.plotter) {
                    let what = format!("a plotter draws one frame a page, and [orbit] has {}", orbit.frames);
                    return refused(what, example());
                }
                Ok(Self::Animated(path.into()))
            }
            [] => {
                let frames = orbit.frames;
                refused(format!("[orbit] has {frames} frames, and the name has no ### for their numbers"), example())
            }
            [run] if run.len() < digits => {
                let (n, last) = (run.len(), orbit.frames - 1);
                refused(format!("{run} has {n} of the {digits} digits of frame {last}"), "write more #".into())
            }
            [run] => {
                let (before, after) = name.split_once(run).unwrap_or_default();
                Ok(Self::Numbered(path.into(), [before, after].map(String::from), run.len()))
            }
            _ => refused("a name has one number of a frame, and this one has several runs of #".into(), example()),
        }
    }

    /// Returns the file of a frame.
    fn path(&self, frame: usize) -> PathBuf {
        match self {
            Self::One(path) | Self::Animated(path) => path.clone(),
            Self::Numbered(path, [before, after], digits) => {
                path.with_file_name(format!("{before}{frame:0digits$}{after}"))
            }
        }
    }

    /// Returns the written files in words.
    fn summary(&self, frames: usize) -> String {
        match self {
            Self::One(path) => path.display().to_string(),
            Self::Numbered(..) if frames == 1 => self.path(0).display().to_string(),
            Self::Animated(path) => format!("{}: {frames} frames", path.display()),
            Self::Numbered(..) => {
                format!("{} … {}: {frames} frames", self.path(0).display(), self.path(frames - 1).display())
            }
        }
    }
}

/// Counts and times of drawing all frames.
pub(super) struct DrawReport {
    /// Counts of all frames together. Work done once counts once. Of buffers, the largest counts.
    pub counts: Counts,
    /// Times of each frame.
    pub times: FrameTimes,
}

/// Draws the first frame of a job in pixels.
pub(super) fn first(job: &Job, progress: &(dyn Fn(f64) + Sync)) -> Result<Picture, Failure> {
    let mut counts = Counts::default();
    let marking = Marking::new(job, &mut counts, &|_| ())?;
    let (frame, _) = Drawing::new(job, &marking, &mut counts)?.frame(0, progress)?;
    frame.painted(job)
}

/// Loads a scene or a bare volume, and draws and writes every frame, `repeat` times each. `files` names the files, which are
/// checked before anything is loaded. The volume is drawn by `gpu`, if there is one.
pub(super) fn load_and_draw(
    input: Option<&Path>,
    over: &SceneOverrides,
    files: impl FnOnce(&Scene) -> Result<FrameFiles, Failure>,
    gpu: Option<&Gpu>,
    repeat: usize,
    talk: Talk,
) -> Result<DrawReport, Failures> {
    let start = Instant::now();
    let (job, files) = {
        let _loading = Progress::new(talk, "loading");
        let found = input::find(input, over)?;
        let files = files(&found.scene)?;
        (found.load(over.target)?, files)
    };
    let loaded = start.elapsed().as_secs_f64();
    input::tell(talk, &job);
    let mut drawn = draw(&job, &files, gpu, repeat, talk)?;
    drawn.counts.seconds.insert("load".into(), loaded);
    Ok(drawn)
}

/// Draws every frame of a job, `repeat` times each, and writes them.
fn draw(job: &Job, files: &FrameFiles, gpu: Option<&Gpu>, repeat: usize, talk: Talk) -> Result<DrawReport, Failure> {
    room_for_page(job, &files.path(0))?;
    let mut counts = job.counts.clone();
    // Points, lines and the renderer are made once for all frames.
    let marking = {
        let progress = Progress::new(talk, "points and lines");
        Marking::new(job, &mut counts, &|made| {
            progress.amount(|| format!("{:.1e} dots", made.points as f64));
            progress.hear(made.share);
        })?
    };
    let mut drawing = {
        let preparing = Progress::new(talk, "preparing");
        preparing.amount(|| format!("{:.1e} voxels", job.volume.grid().len() as f64));
        Drawing::on(job, &marking, gpu, &mut counts)?
    };
    let frames = drawing.frames();
    // Frames are drawn, timed and written one after another.
    let (mut cpu, mut wall) = (Some(0.0), Vec::new());
    let (mut notes, mut marks) = (Vec::new(), [0, 0]);
    let mut of_frames: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    let start = Instant::now();
    {
        let progress = Progress::new(talk, "rendering");
        // Rays on a coarse raster can all miss a small volume.
        if let Some(samples) = drawing.samples().filter(|&samples| samples > 0.0) {
            progress.amount(|| format!("up to {:.1e} samples", samples * repeat as f64));
        }
        // Draws a frame `repeat` times and times it, without the writing.
        let mut draw = |i: usize, counts: &Counts| {
            let before = cpu_seconds();
            let mut timed = || {
                let start = Instant::now();
                // Progress counts all repetitions of all frames.
                let before = wall.len() as f64;
                let all = (frames * repeat) as f64;
                let drawn = drawing.frame(i, &|share| progress.hear((before + share) / all));
                wall.push(start.elapsed().as_secs_f64());
                drawn
            };
            let (mut frame, own) = timed()?;
            for line in std::mem::take(&mut frame.notes) {
                of_frames.entry(line).or_default().push(i);
            }
            for _ in 1..repeat {
                timed()?;
            }
            progress.hear((i + 1) as f64 / frames as f64);
            cpu = cpu_seconds().zip(before).zip(cpu).map(|((after, before), sum)| sum + after - before);
            if i == 0 {
                warn_of_nothing(job, &frame, [counts, &own], talk);
            }
            Ok::<_, Failure>((frame, own))
        };
        match files {
            FrameFiles::Animated(path) => write_animation(job, frames, path, |i| {
                let (frame, own) = draw(i, &counts)?;
                counts.add_frame(&own);
                Ok(frame)
            })?,
            FrameFiles::One(_) | FrameFiles::Numbered(..) => {
                for i in 0..frames {
                    let (frame, own) = draw(i, &counts)?;
                    let written = frame.write(job, &files.path(i))?;
                    // A dot or line that a plotter leaves out is not drawn.
                    let [points, strokes] = written.marks.map(|n| n as u64);
                    counts.add_frame(&Counts { points, strokes, ..own });
                    if i == 0 {
                        (marks, notes) = (written.marks, written.notes);
                    }
                }
            }
        }
    }
    // Everything that was not drawing was writing.
    let writing = start.elapsed().as_secs_f64() - wall.iter().sum::<f64>();
    counts.seconds.insert("write".into(), writing);
    let [dots, lines] = marks;
    match files {
        FrameFiles::One(_) if !marking.is_empty() => {
            note(talk, format_args!("{}: {dots} dots, {lines} lines", files.summary(frames)));
        }
        _ => note(talk, files.summary(frames)),
    }
    notes.iter().for_each(|line| note(talk, line));
    for (line, of) in of_frames {
        match frames {
            1 => note(talk, line),
            _ => note(talk, format_args!("{}: {line}", numbers(&of))),
        }
    }
    Ok(DrawReport { counts, times: FrameTimes::new(wall, cpu) })
}

/// The numbers of some frames, in order, as text: "frame 3", or "frames 0 to 4, 7".
fn numbers(frames: &[usize]) -> String {
    let runs = frames.chunk_by(|a, b| a + 1 == *b).map(|run| match run {
        [first, .., last] => format!("{first} to {last}"),
        one => one.iter().map(usize::to_string).collect(),
    });
    let what = if frames.len() == 1 { "frame" } else { "frames" };
    format!("{what} {}", runs.collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::file::{Overrides, parse};

    fn files(name: &str, rest: &str) -> Result<FrameFiles, Failure> {
        let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n{rest}");
        FrameFiles::named(Path::new(name), &parse(&text, Path::new("a.toml"), &Overrides::default()).unwrap())
    }

    #[test]
    fn runs_of_frames_are_told_by_their_ends() {
        assert_eq!(numbers(&[3]), "frame 3");
        assert_eq!(numbers(&[0, 1, 2, 5, 7, 8]), "frames 0 to 2, 5, 7 to 8");
    }

    #[test]
    fn names_of_frames() {
        let orbit = "[orbit]\n";
        let numbered = files("a#/turn_###.png", orbit).unwrap();
        assert_eq!(numbered.path(7), Path::new("a#/turn_007.png"));
        assert_eq!(files("##.exr", orbit).unwrap().path(35), Path::new("35.exr"));
        assert_eq!(files("a.png", "").unwrap(), FrameFiles::One("a.png".into()));
        for (name, rest) in [("a.svg", "[stipples]\n[orbit]\n"), ("a.gif", orbit), ("a.APNG", orbit)] {
            assert_eq!(files(name, rest).unwrap(), FrameFiles::Animated(name.into()));
        }
        for (name, rest, what, remedy) in [
            ("a_#.png", "", "a # stands for", "add a table [orbit], or give a name without #"),
            (
                "a.gif",
                "",
                ".gif is for the frames of [orbit]",
                "add --set orbit.frames=36, or give a name that ends in .png",
            ),
            ("a_#.apng", orbit, ".apng has all frames in one file", "give a name without #"),
            ("a.png", orbit, "[orbit] has 36 frames, and the name has no ###", "write a_###.png"),
            ("a.svg", orbit, "[orbit] has 36 frames", "write a_###.svg"),
            ("a.pdf", "[stipples]\n[orbit]\n", "[orbit] has 36 frames", "write a_###.pdf"),
            ("a.svg", "[stipples]\n[orbit]\n[page]\nplotter = true\n", "a plotter draws one frame", "write a_###.svg"),
            ("a.png", "[orbit]\nframes = 10001\n", "[orbit] has 10001 frames", "write a_#####.png"),
            ("a_#.png", orbit, "# has 1 of the 2 digits of frame 35", "write more #"),
            ("#_#.png", orbit, "a name has one number", "write #_#_###.png"),
        ] {
            let failure = files(name, rest).unwrap_err();
            assert!(failure.what.starts_with(what) && failure.remedy == remedy, "{name}: {failure}");
        }
    }
}
