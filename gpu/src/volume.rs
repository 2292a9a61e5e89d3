//! A volume on a graphics card.

use crate::{Gpu, GpuError, Precision};
use drypoint_scene::math::{exponent, scale_by_power_of_two};
use drypoint_scene::measured::{Measured, PaddedNumbers};
use std::sync::Arc;

/// A volume as textures of numbers, uploaded once for any number of renderers.
pub struct UploadedVolume {
    pub(crate) numbers: wgpu::TextureView,
    pub(crate) voxels: Option<wgpu::TextureView>,
    pub(crate) smoothed: Option<wgpu::TextureView>,
    pub(crate) precision: Precision,
    bytes: u64,
}

/// The power of two e for which numbers · 2^−e lie in [−1, 1] ([GPU-1]).
pub(crate) fn scale_exponent(measured: &Measured) -> i32 {
    exponent(measured.numbers.largest)
}

impl UploadedVolume {
    /// Uploads the numbers of a volume.
    ///
    /// # Errors
    /// Numbers do not fit in a texture or in the adapter's memory, or the adapter has no f64.
    pub fn new(gpu: &Gpu, measured: &Measured, precision: Precision) -> Result<Self, GpuError> {
        if precision == Precision::Double && !gpu.has_double() {
            return Err(GpuError::NoDouble { adapter: gpu.name().to_owned() });
        }
        let e = scale_exponent(measured);
        let lists = [Some(&measured.numbers), measured.voxels.as_ref(), measured.smoothed.as_ref()];
        let numbers = lists.into_iter().flatten().map(|numbers| numbers.data.len() as u64).sum::<u64>();
        let texture = |numbers: &Arc<PaddedNumbers>| upload(gpu, numbers, e, precision);
        Ok(Self {
            numbers: texture(&measured.numbers)?,
            voxels: measured.voxels.as_ref().map(texture).transpose()?,
            smoothed: measured.smoothed.as_ref().map(texture).transpose()?,
            precision,
            bytes: numbers * precision.size(),
        })
    }

    /// Bytes of the volume's numbers on the card.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }
}

/// The largest number of numbers in a volume. Indices in lists of cells have 31 bits.
const MOST_NUMBERS: usize = 1 << 31;

/// Number of planes that are uploaded together.
const PLANES_AT_ONCE: usize = 16;

/// A 3D texture of numbers times 2^−e. In f64 a texel has two parts.
fn upload(gpu: &Gpu, numbers: &PaddedNumbers, e: i32, precision: Precision) -> Result<wgpu::TextureView, GpuError> {
    let most = gpu.device.limits().max_texture_dimension_3d as usize;
    let dims = numbers.dims;
    if dims.iter().any(|&n| n > most) || dims.iter().product::<usize>() > MOST_NUMBERS {
        return Err(GpuError::TooLarge { dims, most, adapter: gpu.name().to_owned() });
    }
    let [x, y, z] = dims.map(|n| n as u32);
    let size = wgpu::Extent3d { width: x, height: y, depth_or_array_layers: z };
    let (format, texel) = match precision {
        Precision::Single => (wgpu::TextureFormat::R32Float, 4),
        Precision::Double => (wgpu::TextureFormat::Rg32Float, 8),
    };
    let texture = gpu.attempt("the volume", || {
        gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("volume"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D3,
            format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        })
    })?;
    // A few planes at a time, so that the bytes are not all in memory at once.
    for (plane, numbers) in numbers.data.chunks_exact(dims[0] * dims[1]).enumerate() {
        let scaled = numbers.iter().map(|&c| scale_by_power_of_two(c, -e));
        let bytes: Vec<u8> = match precision {
            Precision::Single => scaled.flat_map(|c| (c as f32).to_le_bytes()).collect(),
            Precision::Double => scaled
                .flat_map(|c| {
                    let high = c as f32;
                    [high, (c - f64::from(high)) as f32]
                })
                .flat_map(f32::to_le_bytes)
                .collect(),
        };
        gpu.attempt("the volume", || {
            gpu.queue.write_texture(
                wgpu::TexelCopyTextureInfo {
                    texture: &texture,
                    mip_level: 0,
                    origin: wgpu::Origin3d { x: 0, y: 0, z: plane as u32 },
                    aspect: wgpu::TextureAspect::All,
                },
                &bytes,
                wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(x * texel), rows_per_image: Some(y) },
                wgpu::Extent3d { depth_or_array_layers: 1, ..size },
            );
        })?;
        if plane % PLANES_AT_ONCE == PLANES_AT_ONCE - 1 {
            gpu.queue.submit([]);
            gpu.wait()?;
        }
    }
    Ok(texture.create_view(&wgpu::TextureViewDescriptor::default()))
}
