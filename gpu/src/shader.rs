//! A shader composed from modules.

mod attach;
mod declarations;
mod function;
mod halo_stages;

use crate::block::ParamBlock;
use crate::module::Module;
use crate::{Interpolation, Precision, number};
pub(crate) use function::write_function;
pub(crate) use halo_stages::{HaloStages, Kept};
use std::fmt::Write;

/// Data that a binding of group 1 reads.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Data {
    /// The numbers of a volume's kernel, by the index of the volume.
    Numbers(usize),
    /// A volume's voxels.
    Voxels(usize),
    /// The smoothed coefficients of a volume.
    Smoothed(usize),
    /// The cells of a lighting table. For light from the world they depend on the camera.
    Lighting(Vec<f64>),
    /// The texture unit's interpolation.
    Sampler,
    /// Numbers.
    Reals(Vec<f64>),
    /// Integers or bits.
    Words(Vec<u32>),
    /// Texels in f32.
    Texels(Vec<[f32; 4]>),
}

impl Data {
    /// Whether a shader reads the data as a list.
    pub(crate) fn is_list(&self) -> bool {
        matches!(self, Self::Lighting(_) | Self::Reals(_) | Self::Words(_) | Self::Texels(_))
    }

    /// Whether the data are the same in every frame.
    pub(crate) fn is_constant(&self) -> bool {
        !matches!(self, Self::Lighting(_))
    }
}

/// Values of an `override` of the shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Constant {
    Bool(bool),
    Int(i64),
}

/// The functions that are called at each step, in their order. Each list becomes one function of the shader, with one
/// line for each entry.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Stages {
    /// Before a ray of a pixel begins.
    pub(crate) begin_part: Vec<&'static str>,
    /// When a ray begins.
    pub(crate) begin_ray: Vec<&'static str>,
    /// Maps the run of samples in the box to the remaining ones.
    pub(crate) samples_left: Vec<&'static str>,
    /// Maps the run of all samples, among objects, to the remaining ones.
    pub(crate) all_left: Vec<&'static str>,
    /// Maps a sample to the next plane that can show something.
    pub(crate) next_plane: Vec<&'static str>,
    /// Maps a sample to the next plane that is not masked, among objects.
    pub(crate) next_number: Vec<&'static str>,
    /// When a sample's value is evaluated.
    pub(crate) visited: Vec<&'static str>,
    /// Maps the place of a value to the place between nodes.
    pub(crate) nodes: Vec<&'static str>,
    /// Attributes that decide whether a sample is visible.
    pub(crate) measured_first: Vec<&'static str>,
    /// Whether a sample with those attributes is visible.
    pub(crate) is_seen: Vec<&'static str>,
    /// Attributes of a visible sample.
    pub(crate) measured: Vec<&'static str>,
    /// Expressions for the coordinates of a function over two quantities: the first along a row, the second from row to row.
    pub(crate) coordinates: Vec<String>,
    /// The colour and opacity of a visible sample before light falls on them.
    pub(crate) unlit: Vec<&'static str>,
    /// The light of a visible sample.
    pub(crate) lit: Vec<&'static str>,
    /// The cut that a visible sample lies on.
    pub(crate) cut: Vec<&'static str>,
    /// The number of steps for which a sample stands.
    pub(crate) steps: Vec<&'static str>,
    /// Maps a cell to the side of the surrounding block without an iso-surface; 0 if the cell must be searched.
    pub(crate) passed: Vec<&'static str>,
    /// The colour of an iso-surface.
    pub(crate) on_surface: Vec<&'static str>,
    /// The ends of a ray behind its samples.
    pub(crate) ends: Vec<&'static str>,
    /// Functions that add a sample to layers.
    pub(crate) collect: Vec<&'static str>,
    /// The number of objects whose coverage layers need, the background first.
    pub(crate) covering: usize,
    /// When a ray has ended.
    pub(crate) end_ray: Vec<&'static str>,
    /// Expressions for the channels of a pixel, in their order. `mean` is the beauty. Channels of one ray are kept when
    /// the pixel is refined.
    pub(crate) channels: Vec<Channel>,
    /// Stages of halos, if the scene has any.
    pub(crate) halos: Option<HaloStages>,
    /// Functions of objects, if the scene has objects or is a part of one.
    pub(crate) objects: Option<String>,
}

/// A channel of a pixel.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Channel {
    pub(crate) expression: String,
    /// Whether it belongs to one ray and is not a mean.
    pub(crate) is_of_one_ray: bool,
}

/// A shader and the data that it reads.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shader {
    pub(crate) modules: Vec<Module>,
    pub(crate) interpolation: Interpolation,
    pub(crate) block: ParamBlock,
    pub(crate) constants: Vec<(&'static str, Constant)>,
    /// Bindings of group 1.
    pub(crate) data: Vec<(u32, &'static str, Data)>,
    pub(crate) stages: Stages,
    /// Texts of attached shaders.
    pub(crate) attached: Vec<String>,
}

impl Shader {
    /// Adds modules that are not there yet.
    pub(crate) fn add(&mut self, modules: &[Module]) {
        for &module in modules {
            if !self.modules.contains(&module) {
                self.modules.push(module);
            }
        }
    }

    /// Adds a constant.
    pub(crate) fn constant(&mut self, name: &'static str, value: Constant) {
        self.constants.push((name, value));
    }

    /// Adds data that a module binds. `what` names them in messages.
    pub(crate) fn bind(&mut self, binding: u32, what: &'static str, data: Data) {
        self.data.push((binding, what, data));
    }

    /// Whether another shader binds data of the same kinds at the same bindings.
    pub(crate) fn binds_as(&self, other: &Self) -> bool {
        let kinds = |shader: &Self| {
            let kind = |(binding, _, data): &(u32, &str, Data)| (*binding, std::mem::discriminant(data));
            shader.data.iter().map(kind).collect::<Vec<_>>()
        };
        kinds(self) == kinds(other)
    }

    /// The text of a shader that draws pictures.
    pub(crate) fn text(&self, precision: Precision) -> String {
        let mut text = self.modules_text(precision) + &self.stages.wgsl();
        text.extend(self.stages.halos.as_ref().map(HaloStages::wgsl));
        text.extend(self.attached.iter().map(String::as_str));
        text.extend(self.stages.objects.as_deref());
        text
    }

    /// The text of a shader that searches for an iso-surface and draws nothing.
    pub(crate) fn text_of_search(&self, precision: Precision) -> String {
        let mut text = self.modules_text(precision);
        self.stages.passed_wgsl(&mut text);
        text
    }

    /// The text up to the stages.
    fn modules_text(&self, precision: Precision) -> String {
        let number = number::of(precision);
        let mut text = format!("// number/{}\n{}\n{}\n", number.name, number.text, self.block.wgsl());
        for (name, value) in &self.constants {
            let _ = match value {
                Constant::Bool(value) => writeln!(text, "override {name}: bool = {value};"),
                Constant::Int(value) => writeln!(text, "override {name}: i32 = {value};"),
            };
        }
        for module in &self.modules {
            let _ = write!(text, "\n{}", module.text);
        }
        text
    }
}

impl Stages {
    /// Appends the stage of cells that a search skips.
    fn passed_wgsl(&self, text: &mut String) {
        let calls = self.passed.iter().map(|s| format!("side = max(side, {s}(cell));"));
        let lines = std::iter::once("var side = 0;".to_owned()).chain(calls);
        write_function(text, "cells_passed(cell: vec3<i32>) -> i32", lines, Some("side"));
    }

    fn wgsl(&self) -> String {
        let mut text = String::new();
        if self.covering > 0 {
            let _ = writeln!(text, "\nconst COVERING = {};", self.covering);
        }
        self.passed_wgsl(&mut text);
        let mut function =
            |head: &str, lines: &[String], result| write_function(&mut text, head, lines.iter().cloned(), result);
        let calls = |stages: &[&str], call: &dyn Fn(&str) -> String| stages.iter().map(|s| call(s)).collect::<Vec<_>>();
        let with = |first: &str, lines: Vec<String>| [vec![first.to_owned()], lines].concat();
        let lines = calls(&self.begin_part, &|s| format!("{s}(pixel, part, across);"));
        function("begin_part(pixel: vec2<i32>, part: i32, across: i32)", &lines, None);
        function("begin_ray(ray: Ray)", &calls(&self.begin_ray, &|s| format!("{s}(ray);")), None);
        let lines = calls(&self.samples_left, &|s| format!("left = {s}(ray, left);"));
        let lines = with("var left = run;", lines);
        function("samples_left(ray: Ray, run: vec2<i32>) -> vec2<i32>", &lines, Some("left"));
        let lines =
            with("var next = sample.k;", calls(&self.next_plane, &|s| format!("next = max(next, {s}(ray, sample));")));
        function("next_plane(ray: Ray, sample: Sample) -> i32", &lines, Some("next"));
        function("visited(sample: Sample)", &calls(&self.visited, &|s| format!("{s}(sample);")), None);
        let lines = with("var place = located;", calls(&self.nodes, &|s| format!("place = {s}(place);")));
        function("node_place(located: NodePlace) -> NodePlace", &lines, Some("place"));
        let lines =
            with("var a = Attributes();", calls(&self.measured_first, &|s| format!("a = {s}(ray, sample, a);")));
        function("measured_first(ray: Ray, sample: Sample) -> Attributes", &lines, Some("a"));
        let lines = calls(&self.is_seen, &|s| format!("if (!{s}(ray, sample, a)) {{ return false; }}"));
        function("is_seen(ray: Ray, sample: Sample, a: Attributes) -> bool", &lines, Some("true"));
        let lines = with("var a = known;", calls(&self.measured, &|s| format!("a = {s}(ray, sample, a);")));
        function("measured_rest(ray: Ray, sample: Sample, known: Attributes) -> Attributes", &lines, Some("a"));
        for (name, expression) in ["across", "down"].into_iter().zip(&self.coordinates) {
            let head = format!("{name}(ray: Ray, sample: Sample, a: Attributes) -> Coordinate");
            function(&head, &[], Some(expression));
        }
        let shade = |stages: &[&str]| calls(stages, &|s| format!("shaded = {s}(ray, sample, a, shaded);"));
        let lines = [&self.unlit, &self.lit, &self.cut].into_iter().flat_map(|stages| shade(stages)).collect();
        let lines = with("var shaded = Shaded();", lines);
        function("shown(ray: Ray, sample: Sample, a: Attributes) -> Shaded", &lines, Some("shaded"));
        if self.objects.is_some() {
            let lines = with("var shaded = Shaded();", shade(&self.unlit));
            function("unlit(ray: Ray, sample: Sample, a: Attributes) -> Shaded", &lines, Some("shaded"));
            let lines = with("var shaded = plain;", shade(&self.lit));
            let head = "lit(ray: Ray, sample: Sample, a: Attributes, plain: Shaded) -> Shaded";
            function(head, &lines, Some("shaded"));
            let numbers = calls(&self.next_number, &|s| format!("next = max(next, {s}(ray, sample));"));
            let lines = with("var next = sample.k;", numbers);
            function("next_number(ray: Ray, sample: Sample) -> i32", &lines, Some("next"));
            let lines = with("var left = run;", calls(&self.all_left, &|s| format!("left = {s}(ray, left);")));
            function("all_left(ray: Ray, run: vec2<i32>) -> vec2<i32>", &lines, Some("left"));
        }
        let lines = with("var steps = real(1.0);", calls(&self.steps, &|s| format!("steps = {s}(k, steps);")));
        function("steps_of(k: i32) -> real", &lines, Some("steps"));
        let lines =
            with("var shaded = plain;", calls(&self.on_surface, &|s| format!("shaded = {s}(ray, sample, a, shaded);")));
        function(
            "on_surface(ray: Ray, sample: Sample, a: Attributes, plain: Shaded) -> Shaded",
            &lines,
            Some("shaded"),
        );
        let lines = with("var front = seen;", calls(&self.ends, &|s| format!("front = {s}(ray, front);")));
        function("ended(ray: Ray, seen: Front) -> Front", &lines, Some("front"));
        let lines = calls(&self.collect, &|s| format!("{s}(ray, sample, a, alpha);"));
        function("collect(ray: Ray, sample: Sample, a: Attributes, alpha: real)", &lines, None);
        function("end_ray(part: i32)", &calls(&self.end_ray, &|s| format!("{s}(part);")), None);
        let write = |(i, channel): (usize, &Channel)| {
            let line = format!("picture[out + {i}] = {};", channel.expression);
            if channel.is_of_one_ray { format!("if (!is_refined) {{ {line} }}") } else { line }
        };
        let lines: Vec<String> = self.channels.iter().enumerate().map(write).collect();
        function("write_channels(out: i32, mean: vec4<real>)", &lines, None);
        text
    }
}
