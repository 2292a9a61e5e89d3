//! The shared part of `points` and `strokes`: a page of marks from a scene, a bare volume or a saved list.

use super::frames::{self, FrameFiles};
use super::input::{self, KeyFlag, SceneOverrides, SetArgs};
use super::raw::RawArgs;
use super::report::{Progress, note, print};
use super::{Done, Outcome, Talk, output_path, stats};
use crate::drawing::{WriteReport, write_page};
use crate::job::RenderTarget;
use crate::output::list;
use crate::scene::counts::Counts;
use crate::scene::marks::{Marks, Page, Pen, mark_counts};
use crate::scene::tables::Scene;
use crate::stroking::Stroking;
use crate::{Failure, Failures, Format};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A page to be written.
#[derive(Clone)]
pub(super) struct PageRequest {
    /// A scene, a volume or a list.
    pub input: PathBuf,
    /// The volume to draw by a scene.
    pub volume: Option<PathBuf>,
    /// Output file.
    pub output: PathBuf,
    /// Preset of a bare volume, if given.
    pub preset: Option<String>,
    /// Preset of a bare volume otherwise.
    pub default_preset: &'static str,
    /// Layout of voxels without a header.
    pub raw: RawArgs,
    /// `--set`.
    pub set: SetArgs,
    /// Whether counts are printed.
    pub stats: bool,
    /// Points or strokes.
    pub target: RenderTarget,
}

impl PageRequest {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        if list::ListFormat::of(&self.input).is_some() {
            return self.list(talk);
        }
        output_path::format(&self.output, &Format::ALL)?;
        let over = self.over()?;
        let files = |scene: &Scene| FrameFiles::of(&self.output, scene);
        self.done(frames::load_and_draw(Some(&self.input), &over, files, None, 1, talk)?.counts)
    }

    /// Writes the cells that strokes can begin in, as a table or as a picture ([HATCH-17]).
    pub(super) fn seeds(&self, path: &Path, talk: Talk) -> Outcome {
        const FORMATS: [Format; 5] = [Format::Csv, Format::Svg, Format::Pdf, Format::Png, Format::Exr];
        let format = output_path::picture(path, &FORMATS)?;
        let over = self.over()?;
        let job = {
            let _loading = Progress::new(talk, "loading");
            input::load(Some(&self.input), &over)?
        };
        output_path::check_not_read(path, job.scene.files())?;
        let mut counts = job.counts.clone();
        let stroking = Stroking::new(&job, &mut counts)?;
        let Some(map) = stroking.seeds(&mut counts) else {
            let place = job.scene.given.position("hatching");
            return Err(
                Failure::new("the scene has no hatching, and no cells of it", place, "add a table [hatching]").into()
            );
        };
        if format == Format::Csv {
            map.write(path)?;
        } else {
            let marks = stroking.seed_page(&map, &job.view()?, &mut counts);
            write_page(marks, &job.scene, self.target, path)?;
        }
        let (cells, expected) = map.sums();
        note(talk, format_args!("{}: {cells} cells, {expected:.0} strokes to be expected", path.display()));
        self.done(counts)
    }

    /// Returns the overrides from the command line.
    fn over(&self) -> Result<SceneOverrides, Failures> {
        let mut flags: Vec<KeyFlag> = self.raw.flag().into_iter().collect();
        let is_bare = !input::is_scene(&self.input);
        let preset = self.preset.as_deref().or(is_bare.then_some(self.default_preset));
        flags.extend(preset.map(|preset| KeyFlag::name("preset", "--preset", preset)));
        if is_bare {
            flags.extend(input::page_flags(&self.set));
        }
        let mut over = SceneOverrides::new(&self.set, flags)?;
        over.target = self.target;
        over.volume.clone_from(&self.volume);
        Ok(over)
    }

    fn done(&self, counts: Counts) -> Outcome {
        if self.stats { print(&stats::line(counts, None)?) } else { Ok(Done::Yes) }
    }

    /// Draws a saved list on the page that the overrides give.
    fn list(&self, talk: Talk) -> Outcome {
        let noun = if self.target == RenderTarget::Strokes { "lines" } else { "dots" };
        for (flag, said) in [("--preset", self.preset.is_some()), ("--raw", self.raw.flag().is_some())] {
            if said {
                let what = format!("a list of {noun} has no use for {flag}");
                return Err(Failure::new(what, flag, "leave it out").into());
            }
        }
        if let Some(volume) = &self.volume {
            let what = format!("a list of {noun} is drawn without a volume");
            return Err(Failure::new(what, volume.display(), "leave it out").into());
        }
        output_path::picture(&self.output, &Format::PAGES)?;
        let (mut counts, start) = (Counts::default(), Instant::now());
        let scene = input::settings(&self.set, Vec::new())?;
        output_path::check_not_read(&self.output, scene.files().into_iter().chain([&*self.input]))?;
        // The marks, checked against the verb.
        let page = Page::of(&scene);
        let pens = Pen::of(&scene.pens, &page);
        let layers = list::read_list(&self.input, &page, &pens)
            .map_err(|error| Failure::picture(&error, self.input.display()))?;
        let [dots, lines] = mark_counts(&layers);
        let strokes = self.target == RenderTarget::Strokes;
        if let (true, 1.., 0) = (strokes, dots, lines) {
            let remedy = "give it to `drypoint points`";
            return Err(Failure::new("the list has dots and no strokes", self.input.display(), remedy).into());
        }
        // Marks outside the page are dropped, with a warning.
        let mut marks = Marks { page, layers };
        let read = if strokes { ends(&marks) } else { dots };
        marks.settle();
        let [dots, _] = mark_counts(&marks.layers);
        let kept = if strokes { ends(&marks) } else { dots };
        if kept < read {
            let (lost, [width, height]) = (read - kept, page.size.to_array());
            let says = "--set picture.width and picture.height say its size";
            let what = if strokes { "vertices" } else { "dots" };
            note(talk, format_args!("warning: {lost} {what} are not on a page of {width:.0} × {height:.0} mm; {says}"));
        }
        counts.seconds.insert("load".into(), start.elapsed().as_secs_f64());
        let start = Instant::now();
        let WriteReport { marks: [dots, lines], notes } = write_page(marks, &scene, self.target, &self.output)?;
        counts.seconds.insert("write".into(), start.elapsed().as_secs_f64());
        (counts.points, counts.strokes) = (dots as u64, lines as u64);
        note(talk, format_args!("{}: {dots} dots, {lines} lines", self.output.display()));
        notes.iter().for_each(|line| note(talk, line));
        self.done(counts)
    }
}

/// Returns the number of vertices of all lines. A line that the frame cuts loses vertices, or gains ends.
fn ends(marks: &Marks) -> usize {
    marks.layers.iter().flat_map(|layer| &layer.lines).map(|line| line.vertices.len()).sum()
}
