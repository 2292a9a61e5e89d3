//! The functions that rays and seeds of halos call at each step.

use super::function::write_function;
use std::borrow::Cow;
use std::fmt::Write;

/// A number that a ray keeps from one group of planes to the next: a private variable of the shader.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Kept {
    name: Cow<'static, str>,
    is_whole: bool,
}

impl Kept {
    /// A number.
    pub(crate) fn real(name: impl Into<Cow<'static, str>>) -> Self {
        Self { name: name.into(), is_whole: false }
    }

    /// A whole number.
    pub(crate) fn whole(name: impl Into<Cow<'static, str>>) -> Self {
        Self { name: name.into(), is_whole: true }
    }
}

/// Functions by their names, called in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct HaloStages {
    /// Numbers that rays of the picture keep.
    pub(crate) kept: Vec<Kept>,
    /// Numbers that rays of seeds keep.
    pub(crate) seed_kept: Vec<Kept>,
    /// When any ray is resumed.
    pub(crate) resume: Vec<&'static str>,
    /// When a ray of the picture has been resumed.
    pub(crate) after_resume: Vec<&'static str>,
    /// Maps the run of samples in the box to those that can seed.
    pub(crate) left: Vec<&'static str>,
    /// Maps a sample to the next plane that can seed.
    pub(crate) next: Vec<&'static str>,
    /// The factors of h that need no gradient.
    pub(crate) height: Vec<&'static str>,
    /// Attributes of a sample that can seed.
    pub(crate) measured: Vec<&'static str>,
    /// Attributes of such a sample on a cut.
    pub(crate) on_cut: Vec<&'static str>,
    /// The halos whose intensities layers show.
    pub(crate) watched: Vec<usize>,
}

impl HaloStages {
    /// The number of values that a ray of the picture keeps, beside its colour and its planes.
    pub(crate) fn kept_numbers(&self) -> usize {
        self.kept.len() + self.watched.len()
    }

    /// An expression for the intensity of a halo at a pixel: the mean over its rays.
    pub(crate) fn intensity(halo: usize) -> String {
        format!("halo_sum_{halo} / real(rays_across() * rays_across())")
    }

    /// The text of the functions.
    pub(crate) fn wgsl(&self) -> String {
        let mut text = String::new();
        for (of, kept) in [("ray", &self.kept), ("seed", &self.seed_kept)] {
            let numbers = if of == "ray" { "ray_numbers" } else { "seed_ray_numbers" };
            let at = |i: usize| format!("{numbers}[{of}_place({}_KEPT + {i}, number)]", of.to_uppercase());
            let resume = kept.iter().enumerate().map(|(i, kept)| match kept.is_whole {
                true => format!("{} = i32({});", kept.name, at(i)),
                false => format!("{} = {};", kept.name, at(i)),
            });
            let again = self.resume.iter().map(|stage| format!("{stage}(ray);"));
            let after = self.after_resume.iter().filter(|_| of == "ray").map(|stage| format!("{stage}();"));
            write_function(
                &mut text,
                &format!("resume_{of}(number: i32, ray: Ray)"),
                resume.chain(again).chain(after),
                None,
            );
            let keep = kept.iter().enumerate().map(|(i, kept)| format!("{} = real({});", at(i), kept.name));
            write_function(&mut text, &format!("keep_{of}(number: i32)"), keep, None);
        }
        let left = self.left.iter().map(|stage| format!("left = {stage}(ray, left);"));
        let left = std::iter::once("var left = run;".to_owned()).chain(left);
        write_function(&mut text, "seeds_left(ray: Ray, run: vec2<i32>) -> vec2<i32>", left, Some("left"));
        let next = self.next.iter().map(|stage| format!("next = max(next, {stage}(ray, sample));"));
        let next = std::iter::once("var next = sample.k;".to_owned()).chain(next);
        write_function(&mut text, "next_seed_plane(ray: Ray, sample: Sample) -> i32", next, Some("next"));
        let height = self.height.iter().map(|stage| format!("h = {stage}(halo, sample, h);"));
        let height = std::iter::once("var h = real(1.0);".to_owned()).chain(height);
        write_function(&mut text, "seed_height(halo: i32, sample: Sample) -> real", height, Some("h"));
        for (name, stages) in [("seed_rest", &self.measured), ("seed_on_cut", &self.on_cut)] {
            let lines = stages.iter().map(|stage| format!("a = {stage}(ray, sample, a);"));
            let lines = std::iter::once("var a = known;".to_owned()).chain(lines);
            let head = format!("{name}(ray: Ray, sample: Sample, known: Attributes) -> Attributes");
            write_function(&mut text, &head, lines, Some("a"));
        }
        // The largest intensities of a ray, and their sums over a pixel.
        for halo in &self.watched {
            let _ = writeln!(text, "\nvar<private> halo_sum_{halo}: real;");
        }
        let at = |i: usize| format!("ray_numbers[ray_place(RAY_KEPT + {}, number)]", self.kept.len() + i);
        let lines = (0..self.watched.len()).map(|i| format!("{} = 0.0;", at(i)));
        write_function(&mut text, "begin_watch(number: i32)", lines, None);
        let largest = |(i, halo): (usize, &usize)| format!("{} = max({}, intensity_of({halo}, place));", at(i), at(i));
        write_function(&mut text, "watch(number: i32, place: i32)", self.watched.iter().enumerate().map(largest), None);
        let sum = |(i, halo): (usize, &usize)| format!("halo_sum_{halo} += {};", at(i));
        write_function(&mut text, "sum_intensities(number: i32)", self.watched.iter().enumerate().map(sum), None);
        text
    }
}
