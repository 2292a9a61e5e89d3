//! Volumetric halos ([HALO-1] … [HALO-9]).

mod limits;
mod others;
mod scales;
mod seeds;
mod tubes;

use crate::common::{Shown, Stage, orthographic, volume};
use crate::stability::{Case, Theme};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{Halo, HaloKind, Number, ProfileNode, SeedBy};
use drypoint::scene::transfer::Function;
use drypoint::scene::volume::Volume;
use std::sync::Arc;

pub(crate) static THEME: Theme = Theme::new(
    "Volumetric halos",
    &[
        Case {
            name: "|g| of 10⁻¹² and 10⁻¹⁰, to the power 32",
            breaks: "|g|³² underflows: NaN, or a halo of nothing",
            done: "powers are repeated products that end at 0 [HALO-3]",
            of: "numbers with another bit than without the halo for 10⁻¹², and numbers outside [0, 1] for both",
            bound: 0.0,
            why: "10⁻³⁸⁴ is 0, and 10⁻³²⁰ is a number",
            measure: limits::underflow,
        },
        Case {
            name: "exponents 0 where there is no normal",
            breaks: "0⁰ = 1: constant regions seed, and offset data by their rounding",
            done: "a sample without a normal seeds nothing [PREC-3]",
            of: "numbers with another bit than without the halo, and passes; constant data, slopes of 64 ulps at 1000",
            bound: 0.0,
            why: "no sample seeds",
            measure: limits::no_normal,
        },
        Case {
            name: "δ = 1, and constant seeds",
            breaks: "intensities that grow beyond 1 with each pass",
            done: "H is a mix of H₀ and 1, with the share δF of 1 [HALO-5]",
            of: "|H − H₀ Σ (δ(1 − H₀))ʲ|, j up to N; and intensities outside [0, 1] or below those of a smaller δ",
            bound: 1e-14,
            why: "F of a constant is that constant; five roundings a pass",
            measure: limits::all_of_delta,
        },
        Case {
            name: "N = 0",
            breaks: "a guard band or a tap of no width",
            done: "H is H₀, in a guard band of two pixels",
            of: "numbers with another bit than for N = 4 and δ = 0",
            bound: 0.0,
            why: "both are H₀",
            measure: limits::no_passes,
        },
        Case {
            name: "a picture of 4 × 2 pixels and a reach of 31",
            breaks: "taps beyond the picture, halos along its frame",
            done: "seeds are sampled in a guard band of 2^N + 1 pixels [HALO-4]",
            of: "numbers with another bit than in a picture of 64 × 64; picture and both intensities",
            bound: 0.0,
            why: "a crop is the picture of the crop",
            measure: limits::smaller_than_the_reach,
        },
        Case {
            name: "all seeds 0",
            breaks: "passes over empty images",
            done: "a group without seeds has no passes",
            of: "numbers with another bit than without halos, and passes; bricks skipped and not",
            bound: 0.0,
            why: "H = 0",
            measure: limits::all_zero,
        },
        Case {
            name: "all seeds 1",
            breaks: "halos inside of what seeds evenly; intensities above 1",
            done: "the gradient of the seeds is spread [HALO-4]",
            of: "|α − α₀| without the gradient of n planes of H = 1, and bits that a halo of the gradient changes",
            bound: 1e-13,
            why: "a constant has no gradient; 46 corrections and as many sums",
            measure: limits::all_one,
        },
        Case {
            name: "opacity 0 on the shot",
            breaks: "a tint of weight 0 that rounds",
            done: "an opacity of 0 is no tint and no glow [RAY-1]",
            of: "numbers with another bit than without halos; both kinds, M = 1 and 3",
            bound: 0.0,
            why: "nothing is mixed",
            measure: limits::not_seen,
        },
        Case {
            name: "planes 1000 voxels apart",
            breaks: "a group that never ends, a halo before its seeds",
            done: "H of group g serves the planes of group g + 1, samples or not [HALO-8]",
            of: "error of 1 − (1 − α)(1 − a) where H ≠ 0; bits that an occlusive halo or a plane beside the box change",
            bound: 1e-14,
            why: "one plane has one glow behind it and nothing to tint; two roundings",
            measure: limits::far_apart,
        },
        Case {
            name: "an eye inside the volume",
            breaks: "seeds from behind the eye, or nearer than `near`",
            done: "seed rays have the planes of the picture's rays [RAY-1]",
            of: "numbers with another bit when all voxels up to 9 are others, the eye at 8 and `near` 3",
            bound: 0.0,
            why: "no sample and no gradient reads them",
            measure: seeds::eye_inside,
        },
        Case {
            name: "masked voxels under every seed",
            breaks: "a halo around a hole in the data",
            done: "a sample whose cell touches a masked voxel seeds nothing [PREC-2]",
            of: "numbers with another bit than without halos, passes, and numbers that are NaN",
            bound: 0.0,
            why: "every sample of h_v > 0 lies in such a cell",
            measure: seeds::masked,
        },
        Case {
            name: "seeds of one label of two",
            breaks: "h_l of another place than that of the value",
            done: "h_l of the sample's own label [HALO-2]",
            of: "intensities with another bit than in a volume of this tube alone; both lookups",
            bound: 0.0,
            why: "the other tube is out of reach",
            measure: seeds::labels,
        },
        Case {
            name: "a focus without falloff, as a point and as a polyline",
            breaks: "0/0 at the border; vertices twice the same",
            done: "a step at `inner`; a segment without length is a point",
            of: "intensities with another bit than in a volume of this tube alone, or between a point and it twice",
            bound: 0.0,
            why: "all seeds of the tube lie within, all of the other one beyond",
            measure: seeds::focus,
        },
        Case {
            name: "directions: the full circle, and two halves of it",
            breaks: "a gap or a seam at ±180°",
            done: "d is a distance on the circle; from 360° on there is no h_d [HALO-2]",
            of: "intensities with another bit: full circle and none, the larger of two halves and none",
            bound: 0.0,
            why: "halves include their borders",
            measure: seeds::directions,
        },
        Case {
            name: "a sphere on anisotropic and sheared grids",
            breaks: "gradients per voxel and not per length: seeds that are not round",
            done: "gradients are in world space [SPACE-3]",
            of: "largest |ΔH| from a grid of half the spacing; B-spline, whose sphere has no error",
            bound: 1e-10,
            why: "the spline reproduces the field: rounding alone, through a slope of 32 and two curvatures",
            measure: seeds::grids,
        },
        Case {
            name: "values and spacings of 2^±100",
            breaks: "|g|, τ and lengths that overflow or vanish",
            done: "derivatives are squared after scaling by a power of two [SPACE-4]",
            of: "numbers with another bit; power and curvature, focus and T with them",
            bound: 0.0,
            why: "a power of two changes no mantissa",
            measure: || scales::by_two(Number::F64),
        },
        Case {
            name: "the same in f32, by 2^±30",
            breaks: "as above",
            done: "as above",
            of: "numbers with another bit; power and curvature",
            bound: 0.0,
            why: "as above",
            measure: || scales::by_two(Number::F32),
        },
        Case {
            name: "values and spacings of 10^±6",
            breaks: "as above",
            done: "as above",
            of: "largest difference of a channel from 1",
            bound: 1e-11,
            why: "voxels, lengths and nodes round by ε, through a slope of 32, 80 planes",
            measure: scales::by_ten,
        },
        Case {
            name: "halos in f32",
            breaks: "1 − |n·v| loses its digits",
            done: "seeds are made in f64 of a normal in f32",
            of: "largest difference of a channel from f64; floor 0",
            bound: 3e-4,
            why: "a normal is off by some 4 u, through a slope of 32, on 40 planes",
            measure: scales::single,
        },
        Case {
            name: "seeds behind an opaque slab, beside its edge",
            breaks: "a ray that has ended takes its seeds with it",
            done: "termination stops compositing, never seeds [RAY-2]",
            of: "numbers with another bit beside the slab, opaque and of opacity 0.1; ε = 0 and 0.01",
            bound: 0.0,
            why: "seeds do not depend on what is visible in front",
            measure: others::behind_a_slab,
        },
        Case {
            name: "rays with halos that end at A ≥ 1 − ε, ε from 10⁻³ to 0.5",
            breaks: "glow that ends later or earlier than samples",
            done: "glow and tints weigh as samples do [RAY-2]",
            of: "largest difference of a channel in units of ε",
            bound: 1.0,
            why: "what is left out weighs at most ε, in colours of at most 1",
            measure: others::cut_off,
        },
        Case {
            name: "an opaque wall behind a rod along the view axis",
            breaks: "a tint that grows with the number of planes",
            done: "O = max(O, H), met once by a sample [HALO-7]",
            of: "largest difference of a channel from Δ = 1; Δ = ½ … 1/16, M = 1, 4 and 8",
            bound: 1e-3,
            why: "seeds are constant along depth, but for the ends of the rod",
            measure: others::wall,
        },
        Case {
            name: "an iso-surface without a function",
            breaks: "no α_u to seed by, no sample to tint",
            done: "its inside seeds, and it is tinted as a sample [HALO-7]",
            of: "error of (1 − m)·white + m·c, m by the layer of H; the number of pixels tinted before all",
            bound: 1e-14,
            why: "one opaque sample a ray; four roundings",
            measure: others::surface,
        },
        Case {
            name: "lines behind a rod",
            breaks: "lines are drawn over halos, or without their tint",
            done: "a line inside the volume is a sample [HALO-7]",
            of: "error of premultiplied C + (1 − A)·line under a glow, and of (1 − m)·line + m·c under a tint",
            bound: 1e-14,
            why: "one sample behind all others; four roundings",
            measure: others::lines,
        },
        Case {
            name: "frames of an orbit",
            breaks: "seeds or tints of the frame before",
            done: "images of a frame are made with it",
            of: "numbers with another bit than in a frame rendered alone, and counts",
            bound: 0.0,
            why: "nothing is kept",
            measure: others::orbit,
        },
        Case {
            name: "4 and 9 rays a pixel",
            breaks: "a reach that shrinks with the rays",
            done: "q is multiplied by the rays across a pixel [HALO-5]",
            of: "largest difference of a channel from the mean of a picture of as many pixels",
            bound: 1e-14,
            why: "the same rays; a mean of 9 numbers",
            measure: others::several_rays,
        },
        Case {
            name: "tubes of R = 1, 2, 4, 8 voxels, seeds by curvature",
            breaks: "a glow that flickers as planes pass a thin tube",
            done: "the band of seeds is 2R√(x(2 − x)) deep, x = T/R [HALO-3]",
            of: "largest deviation of the glow's opacity beside the tube from its mean, as a share; 16 phases, B-spline",
            bound: 0.1,
            why: "at least 4 planes are in the band",
            measure: tubes::by_curvature,
        },
        Case {
            name: "the same of R = 2, 4, 8 between voxels",
            breaks: "as above",
            done: "as above",
            of: "as above, of distances by trilinear interpolation; R = 1 is a prism then, and deviates by 0.15",
            bound: 0.1,
            why: "as above",
            measure: tubes::by_curvature_between_voxels,
        },
        Case {
            name: "a tube of R = 8 voxels, seeds by the power 32",
            breaks: "as above",
            done: "nothing: it is the paper's formula, and `seed.by = \"curvature\"` is there",
            of: "as above",
            bound: 0.51,
            why: "a band of 0.043 R is thinner than a step: few planes meet it",
            measure: tubes::by_power,
        },
        Case {
            name: "groups of 4 planes, tubes of R = 2, 4, 8 voxels",
            breaks: "a glow that depends on M",
            done: "an emissive halo has the mean of the seeds of its group [HALO-8]",
            of: "largest deviation of the mean opacity over 16 phases and 4 places in a group from that of M = 1, as a share",
            bound: 0.15,
            why: "the gradient of a mean is a mean of gradients where these have one direction",
            measure: tubes::groups_of_four,
        },
    ],
);

#[test]
fn volumetric_halos() {
    THEME.hold();
}

/// The layer of the first halo.
const H: LayerKind = LayerKind::Halo(0);

/// Crossing tubes in 24³ voxels, translucent, in 32 × 32 pixels.
fn crossing() -> Stage {
    let field = volume([24; 3], |p: DVec3| {
        let a = 3.0 - DVec3::new(p.x - 8.0, p.y - 7.0, 0.0).length();
        let b = 2.5 - DVec3::new(0.0, p.y - 15.0, p.z - 12.0).length();
        a.max(b)
    });
    Stage::regular(field, &[(-0.5, [0.7, 0.5, 0.3], 0.0), (0.5, [0.7, 0.5, 0.3], 0.6)]).with(|s| {
        s.camera = orthographic(Some(20.0));
        s.camera.direction = DVec3::new(0.1, 1.0, 0.2);
        s.picture.size = [32, 32];
    })
}

/// A dark rim.
fn dark() -> Halo {
    Halo { name: "dark".into(), ..Halo::default() }
}

/// A glow.
fn glow() -> Halo {
    let mut glow = Halo { name: "glow".into(), kind: HaloKind::Emissive, opacity: 0.3, ..Halo::default() };
    glow.accumulate = glow.kind.accumulation();
    glow.profile[0].rgb = [1.0, 0.8, 0.2];
    glow
}

/// A profile of one red and one opacity.
fn constant(opacity: f64) -> Vec<ProfileNode> {
    vec![ProfileNode { at: 0.0, rgb: [1.0, 0.0, 0.0], opacity }]
}

/// An opacity that is the intensity times a factor.
fn linear(opacity: f64) -> Vec<ProfileNode> {
    let node = |at, opacity| ProfileNode { at, rgb: [1.0, 0.0, 0.0], opacity };
    vec![node(0.0, 0.0), node(1.0, opacity)]
}

impl Stage {
    /// The same with these halos, and the layers of their intensities.
    fn halos(&self, halos: &[Halo]) -> Self {
        let layers: Vec<LayerKind> = (0..halos.len()).map(LayerKind::Halo).collect();
        self.with(|s| s.halos = halos.to_vec()).layers(&layers)
    }

    /// The picture without anything of the function.
    fn render_halos_alone(&self) -> Shown {
        let mut shot = self.resolved(self.view());
        shot.objects[0].function = Arc::new(Function::nothing());
        self.render_shot(&shot, |renderer| renderer)
    }
}

/// The bits of the beauty alone.
fn beauty(shown: &Shown) -> Vec<u64> {
    shown.layer_bits(LayerKind::Beauty)
}

/// The largest number of a list.
fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().copied().fold(0.0, f64::max)
}

/// The same by curvature.
fn by_curvature(mut halo: Halo) -> Halo {
    halo.seed.by = SeedBy::Curvature;
    halo
}

/// The same volume from other voxels.
fn other(stage: &Stage, volume: Volume) -> Stage {
    Stage { volume, ..stage.clone() }
}
