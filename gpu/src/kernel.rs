//! Functions of shaders over tables of inputs, for comparing single formulas.

use crate::block::ParamBlock;
use crate::buffers::{buffer, entry, list_entry, pipeline, read, shader_module};
use crate::{Gpu, GpuError, Precision, number};
use drypoint_scene::glam::DVec3;
use std::fmt::Write;

/// The largest number of rows of a table.
const MOST_ROWS: usize = 1 << 20;

/// Expressions in WGSL over the rows of a table.
#[derive(Clone, Debug, Default)]
pub struct ShaderKernel<'k> {
    /// The concatenated text of the modules that the expressions call. The number type is prepended.
    pub modules: String,
    /// Numbers that the modules read as `params.name`.
    pub params: &'k [(&'k str, f64)],
    /// Vectors that the modules read as `name()`.
    pub vectors: &'k [(&'static str, [f64; 3])],
    /// Lists of numbers, with their bindings in group 1.
    pub lists: &'k [(u32, &'k [f64])],
    /// Lists of integers, with their bindings in group 1.
    pub words: &'k [(u32, &'k [u32])],
    /// Lists of texels, with their bindings in group 1.
    pub texels: &'k [(u32, &'k [[f32; 4]])],
    /// Statements before the expressions. `x[0]`, `x[1]`, … are the numbers of a row.
    pub before: &'k str,
    /// An expression for each number of a result row.
    pub results: &'k [&'k str],
}

impl ShaderKernel<'_> {
    /// Evaluates the expressions for the rows of a table with `columns` numbers each.
    ///
    /// # Errors
    /// The device lacks the number type or memory, or refuses the text.
    ///
    /// # Panics
    /// If the table has more than 2²⁰ rows.
    pub fn run(&self, gpu: &Gpu, precision: Precision, columns: usize, table: &[f64]) -> Result<Vec<f64>, GpuError> {
        if precision == Precision::Double && !gpu.has_double() {
            return Err(GpuError::NoDouble { adapter: gpu.name().to_owned() });
        }
        let rows = table.len() / columns;
        assert!(rows <= MOST_ROWS, "{rows} rows");
        // Group 0: parameters, results and the table. Group 1: lists.
        let mut block = ParamBlock::default();
        block.number("rows", rows as f64);
        self.params.iter().for_each(|&(name, value)| block.number(name, value));
        self.vectors.iter().for_each(|&(name, value)| block.vector(name, DVec3::from_array(value)));
        let storage = wgpu::BufferUsages::STORAGE;
        let params = buffer(gpu, "the parameters", &block.bytes(precision), storage)?;
        let input = buffer(gpu, "the table", &precision.bytes(table), storage)?;
        let bytes = (rows * self.results.len()) as u64 * precision.size();
        let zeros = vec![0; bytes as usize];
        let output = buffer(gpu, "the results", &zeros, storage | wgpu::BufferUsages::COPY_SRC)?;
        let back = gpu.attempt("the results", || {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("results"),
                size: bytes,
                usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        })?;
        let lists = self.lists.iter().map(|(binding, list)| (*binding, precision.bytes(list)));
        let words = self.words.iter().map(|(binding, list)| (*binding, bytemuck::cast_slice(list).to_vec()));
        let texels = self.texels.iter().map(|(binding, list)| (*binding, bytemuck::cast_slice(list).to_vec()));
        let lists = lists
            .chain(words)
            .chain(texels)
            .map(|(binding, bytes)| Ok((binding, buffer(gpu, "a list", &bytes, storage)?)));
        let lists = lists.collect::<Result<Vec<_>, GpuError>>()?;
        let layout = |entries: &[wgpu::BindGroupLayoutEntry]| {
            gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("kernel"), entries })
        };
        let first = layout(&[list_entry(0, true), list_entry(1, false), list_entry(2, true)]);
        let second = layout(&lists.iter().map(|(binding, _)| list_entry(*binding, true)).collect::<Vec<_>>());
        let module = shader_module(gpu, &self.text(&block, precision, columns))?;
        let pipeline = pipeline(gpu, &module, "kernel", &[&first, &second])?;
        let group = |layout, entries: &[wgpu::BindGroupEntry<'_>]| {
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("kernel"), layout, entries })
        };
        gpu.attempt("the results", || {
            let first = group(&first, &[entry(0, &params), entry(1, &output), entry(2, &input)]);
            let second = group(&second, &lists.iter().map(|(binding, list)| entry(*binding, list)).collect::<Vec<_>>());
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                pass.set_bind_group(0, &first, &[]);
                pass.set_bind_group(1, &second, &[]);
                gpu.dispatch(&mut pass, &pipeline, [(rows as u32).div_ceil(64), 1, 1]);
            }
            encoder.copy_buffer_to_buffer(&output, 0, &back, 0, bytes);
            gpu.queue.submit([encoder.finish()]);
        })?;
        Ok(precision.numbers(&read(gpu, &back, bytes)?))
    }

    fn text(&self, block: &ParamBlock, precision: Precision, columns: usize) -> String {
        let number = number::of(precision);
        let Self { modules, before, results, .. } = self;
        let mut text = format!("{}\n{}\n{modules}\n", number.text, block.wgsl());
        let m = results.len();
        let _ = write!(
            text,
            "
@group(0) @binding(1) var<storage, read_write> kernel_results: array<real>;
@group(0) @binding(2) var<storage, read> kernel_table: array<real>;

@compute @workgroup_size(64)
fn kernel(@builtin(global_invocation_id) id: vec3<u32>) {{
    let row = i32(id.x);
    if (row >= i32(params.rows)) {{
        return;
    }}
    var x: array<real, {columns}>;
    for (var i = 0; i < {columns}; i++) {{
        x[i] = kernel_table[row * {columns} + i];
    }}
    {before}
"
        );
        for (i, result) in results.iter().enumerate() {
            let _ = writeln!(text, "    kernel_results[row * {m} + {i}] = {result};");
        }
        text.push_str("}\n");
        text
    }
}
