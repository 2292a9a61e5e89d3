//! A volume on a graphics card.

use crate::{Gpu, GpuError, Precision};
use drypoint_scene::math::{exponent, scale_by_power_of_two};
use drypoint_scene::measured::{Measured, PaddedNumbers};
use half::f16;
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
        let mut bytes = 0;
        let mut texture = |numbers: &Arc<PaddedNumbers>| {
            let texel = Texel::of(numbers, e, precision);
            bytes += numbers.data.len() as u64 * u64::from(texel.bytes());
            upload(gpu, numbers, e, texel)
        };
        Ok(Self {
            numbers: texture(&measured.numbers)?,
            voxels: measured.voxels.as_ref().map(&mut texture).transpose()?,
            smoothed: measured.smoothed.as_ref().map(&mut texture).transpose()?,
            precision,
            bytes,
        })
    }

    /// Bytes of the volume's numbers on the card.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }
}

/// A number in a texture. Shaders add the parts of a texel, and cannot tell which kind it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Texel {
    /// f16, where it holds all numbers exactly: those of 8 bits, and whole numbers over a range of 2¹¹.
    Half,
    /// f32.
    Single,
    /// The number in f32, and in f32 what is left of it.
    Double,
}

impl Texel {
    /// The smallest texel that holds the numbers times 2^−e to the precision.
    fn of(numbers: &PaddedNumbers, e: i32, precision: Precision) -> Self {
        let fits = |&c: &f64| {
            let c = scale_by_power_of_two(c, -e);
            f16::from_f64(c).to_f64() == c
        };
        match precision {
            _ if numbers.data.iter().all(fits) => Self::Half,
            Precision::Single => Self::Single,
            Precision::Double => Self::Double,
        }
    }

    fn format(self) -> wgpu::TextureFormat {
        match self {
            Self::Half => wgpu::TextureFormat::R16Float,
            Self::Single => wgpu::TextureFormat::R32Float,
            Self::Double => wgpu::TextureFormat::Rg32Float,
        }
    }

    fn bytes(self) -> u32 {
        match self {
            Self::Half => 2,
            Self::Single => 4,
            Self::Double => 8,
        }
    }

    /// Appends the bytes of a number.
    fn write(self, c: f64, bytes: &mut Vec<u8>) {
        let high = c as f32;
        match self {
            Self::Half => bytes.extend(f16::from_f64(c).to_le_bytes()),
            Self::Single => bytes.extend(high.to_le_bytes()),
            Self::Double => bytes.extend([high, (c - f64::from(high)) as f32].into_iter().flat_map(f32::to_le_bytes)),
        }
    }
}

/// The largest number of numbers in a volume. Indices in lists of cells have 31 bits.
const MOST_NUMBERS: usize = 1 << 31;

/// Number of planes that are uploaded together.
const PLANES_AT_ONCE: usize = 16;

/// A 3D texture of numbers times 2^−e.
fn upload(gpu: &Gpu, numbers: &PaddedNumbers, e: i32, texel: Texel) -> Result<wgpu::TextureView, GpuError> {
    let most = gpu.device.limits().max_texture_dimension_3d as usize;
    let dims = numbers.dims;
    if dims.iter().any(|&n| n > most) || dims.iter().product::<usize>() > MOST_NUMBERS {
        return Err(GpuError::TooLarge { dims, most, adapter: gpu.name().to_owned() });
    }
    let [x, y, z] = dims.map(|n| n as u32);
    let size = wgpu::Extent3d { width: x, height: y, depth_or_array_layers: z };
    let texture = gpu.attempt("the volume", || {
        gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("volume"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D3,
            format: texel.format(),
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        })
    })?;
    // A few planes at a time, so that the bytes are not all in memory at once.
    for (plane, numbers) in numbers.data.chunks_exact(dims[0] * dims[1]).enumerate() {
        let mut bytes = Vec::with_capacity(numbers.len() * texel.bytes() as usize);
        numbers.iter().for_each(|&c| texel.write(scale_by_power_of_two(c, -e), &mut bytes));
        gpu.attempt("the volume", || {
            gpu.queue.write_texture(
                wgpu::TexelCopyTextureInfo {
                    texture: &texture,
                    mip_level: 0,
                    origin: wgpu::Origin3d { x: 0, y: 0, z: plane as u32 },
                    aspect: wgpu::TextureAspect::All,
                },
                &bytes,
                wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(x * texel.bytes()),
                    rows_per_image: Some(y),
                },
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

#[cfg(test)]
mod tests {
    use super::*;

    fn texel(numbers: &[f64], precision: Precision) -> Texel {
        let numbers = PaddedNumbers::new(numbers.to_vec(), [numbers.len(), 1, 1], 0);
        Texel::of(&numbers, exponent(numbers.largest), precision)
    }

    #[test]
    fn a_texel_is_the_smallest_that_holds_all_numbers() {
        let bytes: Vec<f64> = (-255..=255).map(f64::from).collect();
        let words: Vec<f64> = (0..=2047).map(f64::from).collect();
        for precision in [Precision::Single, Precision::Double] {
            assert_eq!(texel(&bytes, precision), Texel::Half);
            assert_eq!(texel(&words, precision), Texel::Half);
        }
        assert_eq!(texel(&[0.0, 2049.0, 4000.0], Precision::Single), Texel::Single);
        assert_eq!(texel(&[0.0, 1.0 / 3.0], Precision::Double), Texel::Double);
    }

    #[test]
    fn parts_of_a_texel_add_up_to_the_number() {
        let sum = |texel: Texel, c: f64| {
            let mut bytes = Vec::new();
            texel.write(c, &mut bytes);
            assert_eq!(bytes.len(), texel.bytes() as usize);
            match texel {
                Texel::Half => f16::from_le_bytes([bytes[0], bytes[1]]).to_f64(),
                _ => bytes.chunks(4).map(|part| f64::from(f32::from_le_bytes(part.try_into().unwrap()))).sum(),
            }
        };
        for i in -255..=255 {
            let c = f64::from(i) / 256.0;
            assert_eq!([sum(Texel::Half, c), sum(Texel::Single, c)], [c, c]);
        }
        let third = 1.0 / 3.0;
        assert!((sum(Texel::Double, third) - third).abs() < 2f64.powi(-49));
    }
}
