//! The verb `wedge`: a page to print and measure, and a plot of the measured table ([STIP-17]).

use super::input::{self, SetArgs};
use super::report::{Progress, note};
use super::{Done, Outcome, Talk, output_path};
use crate::drawing::write_page;
use crate::format::Format;
use crate::job::RenderTarget;
use crate::scene::marks::{Page, Pen};
use crate::scene::memory;
use crate::scene::source::Disk;
use crate::scene::tables::Scene;
use crate::scene::tone::Tone;
use crate::stippling::tone;
use crate::wedge::{template, wedge};
use crate::{Failure, Failures, tone_plot};
use clap::Args;
use std::path::{Path, PathBuf};

/// Write a step wedge to calibrate a pen, with a table for its measured tones, or plot such a table.
#[derive(Debug, Args)]
pub(super) struct WedgeArgs {
    /// Output file. The suffix chooses SVG, PDF, PNG or EXR; plots are SVG or PNG
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Name of a pen given by --set [default: a black pen of 0.3 mm]
    #[arg(long, value_name = "NAME", required_unless_present = "measured")]
    pen: Option<String>,
    /// Plot this measured table (.csv) and its inverse instead of a page
    #[arg(long, value_name = "FILE", conflicts_with = "pen")]
    measured: Option<PathBuf>,
    #[command(flatten)]
    set: SetArgs,
}

impl WedgeArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        if let Some(measured) = &self.measured {
            return self.plot(measured, talk);
        }
        if Format::of(&self.output) == Some(Format::Csv) {
            let what = "the suffix is that of the table, which is written beside the page";
            return Err(
                Failure::new(what, self.output.display(), "give a name that ends in .svg, .pdf, .png or .exr").into()
            );
        }
        Format::among(&self.output, &Format::SHEETS)?;
        let (table, template) = (self.output.with_extension("csv"), template());
        // A table that is filled in stays, and may be read-only.
        let stays = memory::read_to_string(&Disk, &table).is_ok_and(|there| there != template);
        for path in std::iter::once(&self.output).chain((!stays).then_some(&table)) {
            output_path::writable(path)?;
        }
        let scene = input::settings(&self.set, Vec::new())?;
        output_path::check_not_read(&self.output, scene.files())?;
        let (pen, tone) = pen(&scene, self.pen.as_deref().unwrap_or_default())?;
        let drawing = Progress::new(talk, "step wedge");
        drawing.amount(|| format!("a nib of {} mm", pen.width));
        let page = wedge(&pen, &tone, &Page::of(&scene), 1)?;
        let [width, height] = page.marks.page.size.to_array();
        let notes = write_page(page.marks, &scene, RenderTarget::Marks, &self.output)?.notes;
        drop(drawing);
        note(talk, format_args!("{}: {width:.0} × {height:.0} mm", self.output.display()));
        for line in notes {
            note(talk, line);
        }
        if stays {
            note(talk, format_args!("{}: is there and stays as it is", table.display()));
            return Ok(Done::Yes);
        }
        output_path::write(&table, template.as_bytes())?;
        note(talk, format_args!("{}: to be filled in, and given to [[pen]] as tone", table.display()));
        Ok(Done::Yes)
    }

    fn plot(&self, measured: &Path, talk: Talk) -> Outcome {
        let format = Format::among(&self.output, &[Format::Svg, Format::Png])?;
        output_path::writable(&self.output)?;
        output_path::check_not_read(&self.output, [measured])?;
        let (tone, name) = (tone(&Disk, measured)?, output_path::stem(measured));
        let bytes = if format == Format::Svg {
            tone_plot::svg(&tone, &name).into_bytes()
        } else {
            tone_plot::png(&tone, &name).map_err(|fault| Failure::new(fault, self.output.display(), "write an .svg"))?
        };
        output_path::write(&self.output, &bytes)?;
        note(talk, self.output.display());
        Ok(Done::Yes)
    }
}

/// Returns the pen of a name and its tone: a pen of `--set`, or an ordinary one if there are none.
fn pen(scene: &Scene, name: &str) -> Result<(Pen, Tone), Failures> {
    let pens = Pen::of(&scene.pens, &Page::of(scene));
    if pens.is_empty() {
        let pen = Pen { number: 1, name: name.into(), width: 0.3, color: [0.0, 0.0, 0.0, 1.0] };
        return Ok((pen, Tone::ideal()));
    }
    let Some(i) = pens.iter().position(|pen| pen.name == name) else {
        let names: Vec<&str> = pens.iter().map(|pen| pen.name.as_str()).collect();
        let remedy = format!("write one of {}", names.join(", "));
        return Err(Failure::new(format!("there is no pen {name:?}"), "--pen", remedy).into());
    };
    let tone = scene.pens[i].tone.as_deref().map_or(Ok(Tone::ideal()), |path| tone(&Disk, path))?;
    Ok((pens[i].clone(), tone))
}
