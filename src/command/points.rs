//! `points`: a page of stipples.

use super::frames::{self, Drawn, Files};
use super::input::{self, Flag, Over, Set};
use super::raw::Raw;
use super::report::{Progress, note, print};
use super::{Done, Outcome, Talk, stats, target};
use clap::Args;
use drypoint::drawing::write_page;
use drypoint::job::Wanted;
use drypoint::output::list;
use drypoint::scene::counts::Counts;
use drypoint::scene::marks::{Marks, Page, Pen};
use drypoint::{Failure, Format};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Stipple a scene or a bare volume onto a page, or write a saved list of dots in another format.
#[derive(Debug, Args)]
pub(super) struct Points {
    /// A scene (.toml) with [stipples], a volume, which is drawn 160 mm wide, or a list of dots (.csv, .jsonl), whose page --set says
    #[arg(value_name = "SCENE|VOLUME|LIST")]
    input: PathBuf,
    /// Where to write; the suffix chooses SVG, PDF, PNG, EXR, CSV or JSON lines; ### is the number of a frame of [orbit],
    /// all of which an SVG without it shows in turn
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The preset of a bare volume: stipple, or stipple-fig1, stipple-fig4 … stipple-fig9 [default: stipple]
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    #[command(flatten)]
    raw: Raw,
    #[command(flatten)]
    set: Set,
    /// Print the counts as one JSON object, alone on standard output
    #[arg(long)]
    stats: bool,
}

impl Points {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        if is_list(&self.input) {
            return self.list(talk);
        }
        target::format(&self.output, &Format::ALL)?;
        let mut flags: Vec<Flag> = self.raw.flag().into_iter().collect();
        let is_bare = !input::is_scene(&self.input);
        if let Some(preset) = &self.preset {
            flags.push(Flag::name("preset", "--preset", preset));
        } else if is_bare {
            flags.push(Flag::name("preset", "--preset", "stipple"));
        }
        if is_bare {
            flags.extend(input::page_flags(&self.set));
        }
        let mut over = Over::new(&self.set, flags)?;
        over.wanted = Wanted::Marks;
        let start = Instant::now();
        let (job, files) = {
            let _loading = Progress::new(talk, "loading");
            let found = input::find(Some(&self.input), &over)?;
            let files = Files::of(&self.output, &found.scene)?;
            (found.load(over.wanted)?, files)
        };
        let loaded = start.elapsed().as_secs_f64();
        input::tell(talk, &job);
        let Drawn { mut counts, .. } = frames::draw(&job, &files, 1, talk)?;
        counts.seconds.insert("load".into(), loaded);
        self.done(counts)
    }

    fn done(&self, counts: Counts) -> Outcome {
        if self.stats { print(&stats::line(counts, None)?) } else { Ok(Done::Yes) }
    }

    /// A saved list, on the page that the overrides say.
    fn list(&self, talk: Talk) -> Outcome {
        for (flag, said) in [("--preset", self.preset.is_some()), ("--raw", self.raw.flag().is_some())] {
            if said {
                let what = format!("a list of dots has no use for {flag}");
                return Err(Failure::new(what, flag, "leave it out").into());
            }
        }
        target::picture(&self.output, &Format::ALL)?;
        let (mut counts, start) = (Counts::default(), Instant::now());
        let scene = input::page(&self.set)?;
        let page = Page::of(&scene);
        let pens = Pen::of(&scene.pens, &page);
        let layers = list::read_list(&self.input, &page, &pens)
            .map_err(|error| Failure::picture(&error, self.input.display()))?;
        let dots = |marks: &Marks| marks.layers.iter().map(|layer| layer.dots.len()).sum::<usize>();
        let mut marks = Marks { page, layers };
        let read = dots(&marks);
        marks.settle();
        let kept = dots(&marks);
        if kept < read {
            let (lost, [width, height]) = (read - kept, page.size.to_array());
            let says = "--set picture.width and picture.height say its size";
            note(talk, format_args!("warning: {lost} dots are not on a page of {width:.0} × {height:.0} mm; {says}"));
        }
        counts.seconds.insert("load".into(), start.elapsed().as_secs_f64());
        let start = Instant::now();
        let said = write_page(marks, &scene, &self.output)?;
        counts.seconds.insert("write".into(), start.elapsed().as_secs_f64());
        counts.points = kept as u64;
        note(talk, format_args!("{}: {kept} dots, 0 lines", self.output.display()));
        said.iter().for_each(|line| note(talk, line));
        self.done(counts)
    }
}

/// Whether a path is taken for a list of dots.
fn is_list(path: &Path) -> bool {
    list::Form::of(path).is_some()
}
