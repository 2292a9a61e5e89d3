//! Drypoint's pictures on graphics cards, by wgpu.
//!
//! A [`Gpu`] is an adapter with its device. A volume is uploaded once ([`UploadedVolume`]), and a [`CardRenderer`]
//! draws any number of frames of it, as the [`Shot`](drypoint_scene::shot::Shot) says. The crate decides no meaning:
//! planes, formulas and every `auto` are those of the shot. Facts that only voxels can tell come measured, in a
//! [`Measured`](drypoint_scene::measured::Measured).
//!
//! Shaders are composed from modules, `.wgsl` files. Each names its Rust twin, whose stem it has, or says that it is
//! glue. The list of modules follows from the shot, so a shader has no line, binding or pass of effects that the scene
//! lacks ([GPU-4]). One text runs with `real = f32` and, if the adapter has it, `real = f64`.

mod block;
mod buffers;
mod canvas;
mod clock;
mod compose;
mod device;
mod error;
mod field;
mod inputs;
mod interactive_volume_illustration;
mod kernel;
mod mesh;
mod module;
mod number;
mod picture_buffers;
mod place;
mod ray;
mod renderer;
mod shader;
mod shading;
mod style_transfer_functions;
mod surface;
mod transfer;
mod volume;
mod volume_stippling;
mod volumeshop;
mod volumetric_halos;

pub use device::{Gpu, Interpolation, Precision, WANTED};
pub use error::GpuError;
pub use inputs::CardInputs;
pub use kernel::ShaderKernel;
pub use renderer::CardRenderer;
pub use volume::UploadedVolume;
pub use volume_stippling::{HiddenPoints, Hiding};
pub use wgpu;
