//! Counts of a volume's voxels over the two quantities of a transfer function ([STF-4]).

use crate::background::{Background, Desk};
use drypoint::picking::room_to_probe;
use drypoint::reference::field::probe::at_index;
use drypoint::reference::field::{Field, Reconstruction, Rung, Sampler};
use drypoint::reference::number::Vec3;
use drypoint::scene::glam::DVec3;
use drypoint::scene::math;
use drypoint::scene::tables::{Axis, Scene};
use drypoint::scene::volume::Volume;
use eframe::egui::{Color32, ColorImage};
use std::sync::Arc;

/// Bins along each quantity.
const BINS: [usize; 2] = [96, 64];

/// Most voxels along an axis of the grid that are counted. Along longer ones it is every ⌈n/48⌉-th voxel.
const ALONG: usize = 48;

/// Share of the voxels that lies beyond each end. Curvatures of few voxels are thousands of times those of most.
const BEYOND: f64 = 0.005;

/// A question: how are the voxels of a volume spread over two quantities?
#[derive(Clone)]
pub struct PlaneQuery {
    /// The scene, whose `[sampling]` tells how derivatives are found.
    pub scene: Arc<Scene>,
    /// The scene's volume.
    pub volume: Arc<Volume>,
    /// The two quantities.
    pub over: [Axis; 2],
}

impl PlaneQuery {
    /// Whether another question has the same answer.
    pub fn is_same(&self, other: &Self) -> bool {
        let is_same_scene = Arc::ptr_eq(&self.scene, &other.scene) || self.scene.sampling == other.scene.sampling;
        self.over == other.over && Arc::ptr_eq(&self.volume, &other.volume) && is_same_scene
    }
}

/// Counts of voxels over two quantities, in equal bins.
#[derive(Clone, Debug, PartialEq)]
pub struct JointHistogram {
    /// The ends of the bins along each quantity.
    pub ends: [[f64; 2]; 2],
    /// Number of bins along each quantity.
    pub bins: [usize; 2],
    /// The counts, the first quantity fastest. Voxels beyond an end are in the last bin there.
    pub counts: Vec<u32>,
}

impl JointHistogram {
    /// Counts the voxels of a volume. Returns none if a quantity is not one of the value and its derivatives, or if there
    /// is no memory for them.
    pub fn new(query: &PlaneQuery) -> Option<Self> {
        let volume = &*query.volume;
        let has_curvature = query.over.iter().any(Axis::is_principal);
        let is_known = |axis: &Axis| axis.is_principal() || matches!(axis, Axis::Value | Axis::GradientMagnitude);
        if !query.over.iter().all(is_known) {
            return None;
        }
        let how = Reconstruction::of(&query.scene, volume.grid()).ok()?;
        if has_curvature {
            room_to_probe(volume, &how).ok()?;
        }
        let field = Field::new(volume, how, if has_curvature { Rung::Hessian } else { Rung::Gradient }).ok()?;
        let pairs: Vec<[f64; 2]> =
            voxels(volume).map(|index| measured(&field, index, &query.over)).collect::<Option<_>>()?;
        Some(Self::of(&pairs))
    }

    /// Counts pairs of numbers.
    fn of(pairs: &[[f64; 2]]) -> Self {
        let ends = [0, 1].map(|which| {
            let mut numbers: Vec<f64> = pairs.iter().map(|pair| pair[which]).collect();
            numbers.sort_by(f64::total_cmp);
            let at = |share: f64| numbers.get((share * numbers.len().saturating_sub(1) as f64) as usize).copied();
            [BEYOND, 1.0 - BEYOND].map(|share| at(share).unwrap_or_default())
        });
        let bin = |which: usize, x: f64| {
            let [lo, hi] = ends[which];
            // `as` saturates, and makes 0 of the NaN of a constant quantity.
            ((x - lo) / (hi - lo) * BINS[which] as f64) as usize
        };
        let mut counts = vec![0; BINS[0] * BINS[1]];
        for pair in pairs {
            let [x, y] = [0, 1].map(|which| bin(which, pair[which]).min(BINS[which] - 1));
            counts[y * BINS[0] + x] += 1;
        }
        Self { ends, bins: BINS, counts }
    }

    /// Returns the counts as a picture with the second quantity upwards: a colour whose opacity is the root of
    /// ln(1 + count), of which the largest is 1. Edges between materials are arcs of few voxels beside those of the air.
    pub fn picture(&self, color: Color32) -> ColorImage {
        let log = |count: u32| (1.0 + f64::from(count)).ln();
        let most = self.counts.iter().map(|&count| log(count)).fold(1e-9, f64::max);
        let rows = self.counts.chunks(self.bins[0]).rev().flatten();
        let pixels = rows.map(|&count| color.gamma_multiply((log(count) / most).sqrt() as f32)).collect();
        ColorImage::new(self.bins, pixels)
    }
}

/// The voxels that are counted, without masked ones.
fn voxels(volume: &Volume) -> impl Iterator<Item = [usize; 3]> {
    let dims = volume.dims();
    let [nx, ny, nz] = dims.map(|n| n.div_ceil(n.div_ceil(ALONG)));
    let step = dims.map(|n| n.div_ceil(ALONG));
    let all = (0..nz).flat_map(move |z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])));
    let all = all.map(move |at| [at[0] * step[0], at[1] * step[1], at[2] * step[2]]);
    all.filter(|&at| volume.mask().is_none_or(|mask| !mask.voxel(at)))
}

/// The two quantities at a voxel.
fn measured(field: &Field<'_, f64>, voxel: [usize; 3], over: &[Axis; 2]) -> Option<[f64; 2]> {
    let p = Vec3::from_glam(DVec3::from_array(voxel.map(|n| n as f64)));
    let probed = if over.iter().any(Axis::is_principal) { Some(at_index(field, p.to_glam(), None)?) } else { None };
    let one = |axis: &Axis| match axis {
        Axis::Value => Some(field.value(p)),
        Axis::GradientMagnitude => {
            // 0 without a normal ([PREC-3]).
            let scaled = field.voxel_gradient(voxel).to_glam().length();
            let has_normal = scaled > field.no_normal_below();
            Some(if has_normal { math::scale_by_power_of_two(scaled, field.scale_exponent()) } else { 0.0 })
        }
        Axis::K1 => Some(probed?.k1),
        Axis::K2 => Some(probed?.k2),
        Axis::Mean => Some(probed?.mean),
        Axis::Gaussian => Some(probed?.gaussian),
        _ => None,
    };
    Some([one(&over[0])?, one(&over[1])?])
}

/// A handle of the thread that counts, which ends when it is dropped.
pub(crate) type PlaneCounter = Background<PlaneQuery, (PlaneQuery, Option<JointHistogram>)>;

/// Starts the thread. `wake` is called after each answer, on the thread.
pub(crate) fn counter(wake: Box<dyn Fn() + Send>) -> PlaneCounter {
    Background::new("plane", wake, |desk: Desk<PlaneQuery, (PlaneQuery, Option<JointHistogram>)>| {
        while let Some(query) = desk.wait() {
            let counted = JointHistogram::new(&query);
            desk.answer((query, counted));
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint::scene::file::{Overrides, parse};
    use drypoint::scene::source::Disk;

    fn query(phantom: &str, over: [Axis; 2]) -> PlaneQuery {
        let text = format!("drypoint = 1\n[volume]\nphantom = {phantom}\n");
        let scene = parse(&text, "a.toml".as_ref(), &Overrides::default()).unwrap();
        let volume = Arc::new(drypoint::job::read_volume(&scene, &Disk).unwrap());
        PlaneQuery { scene: Arc::new(scene), volume, over }
    }

    /// A ramp has one gradient, and as many voxels of each value.
    #[test]
    fn a_ramp_is_a_line() {
        let counted = JointHistogram::new(&query(
            "{ name = \"plane\", size = 16, type = \"f64\" }",
            [Axis::Value, Axis::GradientMagnitude],
        ))
        .unwrap();
        assert_eq!(counted.ends, [[-7.5, 7.5], [1.0, 1.0]]);
        let (line, above) = counted.counts.split_at(counted.bins[0]);
        let found: Vec<u32> = line.iter().copied().filter(|&count| count > 0).collect();
        assert_eq!((found, above.iter().sum()), (vec![256; 16], 0_u32));
        let picture = counted.picture(Color32::WHITE);
        assert_eq!(picture.size, counted.bins);
    }

    /// Level sets of the distance to the middle are spheres: κ1 = κ2 = 1/r.
    #[test]
    fn curvatures_of_spheres_lie_on_the_diagonal() {
        let counted =
            JointHistogram::new(&query("{ name = \"sphere\", size = 32, type = \"f64\" }", [Axis::K1, Axis::K2]))
                .unwrap();
        let total: u32 = counted.counts.iter().sum();
        assert_eq!(total, 32 * 32 * 32);
        let [k1, k2] = counted.ends;
        let middle = |ends: [f64; 2], i: usize, n: usize| ends[0] + (ends[1] - ends[0]) * (i as f64 + 0.5) / n as f64;
        let mut near = 0;
        for (i, count) in counted.counts.iter().enumerate() {
            let [x, y] = [i % counted.bins[0], i / counted.bins[0]];
            let apart = middle(k1, x, counted.bins[0]) - middle(k2, y, counted.bins[1]);
            near += if apart.abs() < 0.1 * (k1[1] - k1[0]) { *count } else { 0 };
        }
        assert!(f64::from(near) > 0.9 * f64::from(total), "{near} of {total}");
    }

    #[test]
    fn labels_have_no_counts() {
        assert_eq!(JointHistogram::new(&query("{ name = \"sphere\", size = 8 }", [Axis::Value, Axis::Label])), None);
    }
}
