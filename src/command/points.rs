//! `points`: a page of stipples.

use super::input::{self, Flag, Over, Set};
use super::raw::Raw;
use super::report::{Progress, note, print};
use super::{Done, Outcome, Talk, stats};
use clap::Args;
use drypoint::output::{atomic, list};
use drypoint::scene::counts::Counts;
use drypoint::scene::marks::{Marks, Page, Pen};
use drypoint::scene::tables::Scene;
use drypoint::stippling::{MarksFormat, Stippling, write};
use drypoint::{Failure, Failures};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Stipple a scene or a bare volume onto a page, or write a saved list of dots in another format.
#[derive(Debug, Args)]
pub(super) struct Points {
    /// A scene (.toml) with [stipples], a volume, which is drawn 160 mm wide, or a list of dots (.csv), whose page --set says
    #[arg(value_name = "SCENE|VOLUME|LIST")]
    input: PathBuf,
    /// Where to write; the suffix chooses SVG, PDF, PNG, EXR or CSV
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
        MarksFormat::of(&self.output)?;
        atomic::check(&self.output).map_err(|error| Failure::picture(&error, self.output.display()))?;
        let mut counts = Counts::default();
        let (scene, marks) = if is_list(&self.input) { self.list(talk)? } else { self.stippled(&mut counts, talk)? };
        let dots: usize = marks.layers.iter().map(|layer| layer.dots.len()).sum();
        let lines: usize = marks.layers.iter().map(|layer| layer.lines.len()).sum();
        if dots + lines == 0 {
            note(talk, "warning: the page is empty");
        }
        let start = Instant::now();
        let said = write(&marks, &scene, &self.output)?;
        counts.seconds.insert("write".into(), start.elapsed().as_secs_f64());
        note(talk, format_args!("{}: {dots} dots, {lines} lines", self.output.display()));
        for line in said {
            note(talk, line);
        }
        if self.stats {
            return print(&stats::line(counts, None)?);
        }
        Ok(Done::Yes)
    }

    /// A saved list, on the page that the overrides say.
    fn list(&self, talk: Talk) -> Result<(Scene, Marks), Failures> {
        if let Some(preset) = &self.preset {
            let place = format!("--preset {preset}");
            return Err(Failure::new("a list of dots has no preset", place, "leave it out").into());
        }
        let scene = input::page(&self.set)?;
        let page = Page::of(&scene);
        let mut pens = Pen::of(&scene.pens, &page);
        if pens.is_empty() {
            pens.push(Pen { number: 1, name: "stipples".into(), width: 0.3, color: [0.0, 0.0, 0.0, 1.0] });
        }
        let layers = list::read_list(&self.input, &page, &pens)
            .map_err(|error| Failure::picture(&error, self.input.display()))?;
        let dots = |marks: &Marks| marks.layers.iter().map(|layer| layer.dots.len()).sum::<usize>();
        let mut marks = Marks { page, layers };
        let read = dots(&marks);
        marks.settle();
        if dots(&marks) < read {
            let (lost, [width, height]) = (read - dots(&marks), page.size.to_array());
            let says = "--set picture.width and picture.height say its size";
            note(talk, format_args!("warning: {lost} dots are not on a page of {width:.0} × {height:.0} mm; {says}"));
        }
        Ok((scene, marks))
    }

    fn stippled(&self, counts: &mut Counts, talk: Talk) -> Result<(Scene, Marks), Failures> {
        let mut flags: Vec<Flag> = self.raw.flag().into_iter().collect();
        if let Some(preset) = &self.preset {
            flags.push(Flag::name("preset", "--preset", preset));
        } else if !input::is_scene(&self.input) {
            flags.push(Flag::name("preset", "--preset", "stipple"));
        }
        let sizes = ["picture.size", "picture.width", "picture.height", "picture="];
        let sizes_page = |set: &String| sizes.iter().any(|key| set.trim_start().starts_with(key));
        if !input::is_scene(&self.input) && !self.set.set.iter().any(sizes_page) {
            // A page to print on, rather than the pixels of a rendered picture.
            flags.push(Flag::name("picture.width", "picture.width", "160 mm"));
            flags.push(Flag::name("picture.height", "picture.height", "160 mm"));
        }
        let over = Over::new(&self.set, flags)?;
        let stippling = {
            let _loading = Progress::new(talk, "loading");
            let found = input::find(Some(&self.input), &over)?;
            counts.add(&found.counts);
            match found.volume {
                Some(volume) => Stippling::with_volume(found.scene, volume),
                None => Stippling::load(found.scene),
            }?
        };
        let progress = Progress::new(talk, "stippling");
        let marks = stippling.marks(counts, &|share| progress.hear(share))?;
        Ok((stippling.scene, marks))
    }
}

/// Whether a path is taken for a list of dots.
fn is_list(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("csv"))
}
