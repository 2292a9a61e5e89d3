//! An adapter and its device.

use crate::GpuError;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Features that a device should have if its adapter does: f64, a clock, and a texture unit that interpolates f32.
pub const WANTED: wgpu::Features =
    wgpu::Features::SHADER_F64.union(wgpu::Features::TIMESTAMP_QUERY).union(wgpu::Features::FLOAT32_FILTERABLE);

/// The unit that interpolates between voxels ([GPU-2]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// The shader, in its own precision.
    #[default]
    Exact,
    /// The texture unit, if the kernel is trilinear. Its weights have 8 bits.
    Fast,
}

/// The precision in which a shader computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Precision {
    /// f32.
    #[default]
    Single,
    /// f64, which few adapters have. It compares algorithms without their rounding.
    Double,
}

impl Precision {
    /// Numbers as a buffer holds them.
    pub(crate) fn bytes(self, values: &[f64]) -> Vec<u8> {
        match self {
            Self::Single => values.iter().flat_map(|&x| (x as f32).to_le_bytes()).collect(),
            Self::Double => values.iter().flat_map(|x| x.to_le_bytes()).collect(),
        }
    }

    /// Numbers from a buffer.
    pub(crate) fn numbers(self, bytes: &[u8]) -> Vec<f64> {
        match self {
            Self::Single => bytes.as_chunks().0.iter().map(|&b| f64::from(f32::from_le_bytes(b))).collect(),
            Self::Double => bytes.as_chunks().0.iter().map(|&b| f64::from_le_bytes(b)).collect(),
        }
    }

    /// Bytes of a number.
    pub(crate) fn size(self) -> u64 {
        match self {
            Self::Single => 4,
            Self::Double => 8,
        }
    }
}

/// A graphics adapter, prepared for work.
#[derive(Clone)]
pub struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    info: wgpu::AdapterInfo,
    interpolation: Interpolation,
    /// Number of compiled pipelines.
    pipelines: Arc<AtomicUsize>,
    /// Number of recorded dispatches.
    dispatches: Arc<AtomicUsize>,
    /// The driver's reason for the loss of the device, if it was lost.
    lost: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    /// The fastest adapter, or a software one if there is no other.
    ///
    /// # Errors
    /// There is no adapter, or the adapter gives no device.
    pub fn new() -> Result<Self, GpuError> {
        Self::limited(WANTED, |limits| limits)
    }

    /// Opens that adapter's device as a weaker adapter's would be: with no features but these, and with the limits that a
    /// function makes of the adapter's.
    ///
    /// # Errors
    /// See [`Gpu::new`].
    pub fn limited(
        features: wgpu::Features,
        limits: impl FnOnce(wgpu::Limits) -> wgpu::Limits,
    ) -> Result<Self, GpuError> {
        // Other crates of a program may compile OpenGL, which lacks what shaders here need.
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
            backends: wgpu::Backends::PRIMARY,
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        });
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options)).map_err(|_| GpuError::NoAdapter)?;
        let info = adapter.get_info();
        let descriptor = wgpu::DeviceDescriptor {
            required_features: adapter.features() & features,
            required_limits: limits(adapter.limits()),
            ..Self::descriptor(&adapter)
        };
        let request = pollster::block_on(adapter.request_device(&descriptor));
        let (device, queue) =
            request.map_err(|error| GpuError::NoDevice { adapter: info.name.clone(), reason: error.to_string() })?;
        Ok(Self::of(info, device, queue))
    }

    /// Returns the description of the device that [`Gpu::new`] opens on an adapter: the [`WANTED`] features that it has,
    /// and all of its limits. A program opens its own device with it and shares the device by [`Gpu::of`].
    pub fn descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
        wgpu::DeviceDescriptor {
            label: Some("drypoint"),
            required_features: adapter.features() & WANTED,
            required_limits: adapter.limits(),
            ..Default::default()
        }
    }

    /// The adapter of a device that another program, such as a viewer, opened. [`WANTED`] features are used if the
    /// device has them. The callback for a lost device is replaced. See [`Gpu::descriptor`].
    pub fn of(info: wgpu::AdapterInfo, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        let lost = Arc::new(Mutex::new(None));
        let heard = Arc::clone(&lost);
        device.set_device_lost_callback(move |_, reason| {
            *heard.lock().unwrap_or_else(PoisonError::into_inner) = Some(reason);
        });
        Self {
            device,
            queue,
            info,
            interpolation: Interpolation::Exact,
            pipelines: Arc::default(),
            dispatches: Arc::default(),
            lost,
        }
    }

    /// The device, for making textures for [`CardRenderer::frame_into`](crate::CardRenderer::frame_into).
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// The queue of the device.
    pub fn queue(&self) -> &wgpu::Queue {
        &self.queue
    }

    /// Number of pipelines compiled since the device was opened.
    pub fn pipelines(&self) -> usize {
        self.pipelines.load(Ordering::Relaxed)
    }

    /// Counts a pipeline.
    pub(crate) fn count_pipeline(&self) {
        self.pipelines.fetch_add(1, Ordering::Relaxed);
    }

    /// Number of dispatches recorded since the device was opened. In a frame each waits for the one before it.
    pub fn dispatches(&self) -> usize {
        self.dispatches.load(Ordering::Relaxed)
    }

    /// Records workgroups of a pipeline, across, down and in depth.
    pub(crate) fn dispatch(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        pipeline: &wgpu::ComputePipeline,
        [x, y, z]: [u32; 3],
    ) {
        pass.set_pipeline(pipeline);
        pass.dispatch_workgroups(x, y, z);
        self.dispatches.fetch_add(1, Ordering::Relaxed);
    }

    /// The adapter's name and driver, and whether it is software, for display.
    pub fn describe(&self) -> String {
        let kind = if self.is_software() { ", software" } else { "" };
        format!("{} ({}, {}{kind})", self.info.name, self.info.driver_info, self.info.backend)
    }

    /// The adapter's name.
    pub fn name(&self) -> &str {
        &self.info.name
    }

    /// Whether the adapter is software.
    pub fn is_software(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// Whether shaders can compute in f64.
    pub fn has_double(&self) -> bool {
        self.device.features().contains(wgpu::Features::SHADER_F64)
    }

    /// Returns the device with another unit of interpolation between voxels, for renderers that are made with it.
    ///
    /// # Errors
    /// The texture unit does not interpolate f32.
    pub fn interpolating(&self, interpolation: Interpolation) -> Result<Self, GpuError> {
        let filters = self.device.features().contains(wgpu::Features::FLOAT32_FILTERABLE);
        if interpolation == Interpolation::Fast && !filters {
            return Err(GpuError::NoFilter { adapter: self.name().to_owned() });
        }
        Ok(Self { interpolation, ..self.clone() })
    }

    /// Makes a texture for the frames of a viewer ([`CardRenderer::frame_into`](crate::CardRenderer::frame_into)).
    ///
    /// # Errors
    /// The texture is too large, or there is no memory for it.
    pub fn viewer_texture(&self, [width, height]: [usize; 2]) -> Result<wgpu::Texture, GpuError> {
        let size = wgpu::Extent3d { width: width as u32, height: height as u32, depth_or_array_layers: 1 };
        self.attempt("a viewer's texture", || {
            self.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("viewer"),
                size,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::Rgba16Float,
                usage: wgpu::TextureUsages::STORAGE_BINDING
                    | wgpu::TextureUsages::TEXTURE_BINDING
                    | wgpu::TextureUsages::COPY_SRC,
                view_formats: &[],
            })
        })
    }

    /// The unit that interpolates between voxels.
    pub(crate) fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// Runs commands of the device and converts the driver's messages to an error. `what` names the data for which
    /// memory may be missing.
    pub(crate) fn attempt<T>(&self, what: &'static str, run: impl FnOnce() -> T) -> Result<T, GpuError> {
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let internal = self.device.push_error_scope(wgpu::ErrorFilter::Internal);
        let result = run();
        let fault = pollster::block_on(internal.pop());
        let (refused, full) = (pollster::block_on(validation.pop()), pollster::block_on(memory.pop()));
        let adapter = || self.info.name.clone();
        if full.is_some() {
            return Err(GpuError::OutOfMemory { what, adapter: adapter() });
        }
        if let Some(error) = refused.or(fault) {
            return Err(GpuError::Refused { adapter: adapter(), reason: error.to_string() });
        }
        self.is_there()?;
        Ok(result)
    }

    /// Waits until all commands are done.
    ///
    /// # Errors
    /// The device is lost.
    pub fn wait(&self) -> Result<(), GpuError> {
        let polled = self.device.poll(wgpu::PollType::wait_indefinitely());
        self.is_there()?;
        polled.map(|_| ()).map_err(|error| self.lost_for(error.to_string()))
    }

    fn is_there(&self) -> Result<(), GpuError> {
        let lost = self.lost.lock().unwrap_or_else(PoisonError::into_inner);
        lost.as_ref().map_or(Ok(()), |reason| Err(self.lost_for(reason.clone())))
    }

    pub(crate) fn lost_for(&self, reason: String) -> GpuError {
        GpuError::Lost { adapter: self.info.name.clone(), reason }
    }
}
