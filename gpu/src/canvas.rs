//! The target of the passes of a frame.

use crate::block::ParamBlock;
use crate::buffers::entry;
use crate::clock::Clock;
use crate::picture_buffers::PictureBuffers;
use crate::{Gpu, GpuError, Precision};
use std::cell::Cell;
use std::sync::atomic::{AtomicBool, Ordering};

/// A frame that is being drawn.
pub(crate) struct Canvas<'f> {
    pub(crate) gpu: &'f Gpu,
    /// The scalars of the shader.
    pub(crate) params: &'f wgpu::Buffer,
    /// Group 1: the data of the scene's effects.
    pub(crate) data: &'f wgpu::BindGroup,
    pub(crate) picture: &'f PictureBuffers,
    pub(crate) clock: Option<&'f Clock>,
    /// A listener, and a flag that stops the frame. After each submission the host waits, and the listener receives the
    /// share of the frame that is done. Without them the host does not wait.
    pub(crate) steps: Option<(&'f dyn Fn(f64), &'f AtomicBool)>,
    /// Whether the frame was stopped.
    pub(crate) stopped: &'f Cell<bool>,
}

impl Canvas<'_> {
    /// Group 0 of a pass over pixels. `further` are buffers with their bindings.
    pub(crate) fn group(
        &self,
        layout: &wgpu::BindGroupLayout,
        refines: bool,
        further: &[(u32, &wgpu::Buffer)],
    ) -> Result<wgpu::BindGroup, GpuError> {
        let mut entries = vec![entry(0, self.params), entry(1, &self.picture.out)];
        entries.extend(self.picture.before.iter().filter(|_| refines).map(|before| entry(2, before)));
        entries.extend(further.iter().map(|(binding, buffer)| entry(*binding, buffer)));
        let descriptor = wgpu::BindGroupDescriptor { label: Some("picture"), layout, entries: &entries };
        self.gpu.attempt("the picture", || self.gpu.device.create_bind_group(&descriptor))
    }

    /// Writes the scalars for the following submissions.
    pub(crate) fn write_params(&self, block: &ParamBlock, precision: Precision) -> Result<(), GpuError> {
        self.gpu.attempt("the parameters", || self.gpu.queue.write_buffer(self.params, 0, &block.bytes(precision)))
    }

    /// Submits a compute pass, and the copies that follow it. `begins` and `ends` tell whether it is the first and
    /// whether it is the last pass of the frame.
    pub(crate) fn submit(
        &self,
        [begins, ends]: [bool; 2],
        run: impl FnOnce(&mut wgpu::ComputePass<'_>),
        then: impl FnOnce(&PictureBuffers, &mut wgpu::CommandEncoder),
    ) -> Result<(), GpuError> {
        self.gpu.attempt("the picture", || {
            let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let timestamp_writes = self.clock.and_then(|clock| clock.stamps(begins, ends));
            run(&mut encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: None, timestamp_writes }));
            then(self.picture, &mut encoder);
            if let (true, Some(clock)) = (ends, self.clock) {
                clock.resolve(&mut encoder);
            }
            self.gpu.queue.submit([encoder.finish()]);
        })
    }

    /// Whether the frame has been stopped.
    pub(crate) fn is_stopped(&self) -> bool {
        let is_asked = self.steps.is_some_and(|(_, stop)| stop.load(Ordering::Relaxed));
        self.stopped.set(self.stopped.get() || is_asked);
        self.stopped.get()
    }

    /// If there is a listener, waits for the submissions and reports the share that is done.
    pub(crate) fn report(&self, share: f64) -> Result<(), GpuError> {
        if let Some((progress, _)) = self.steps {
            self.gpu.wait()?;
            progress(share);
        }
        Ok(())
    }
}
