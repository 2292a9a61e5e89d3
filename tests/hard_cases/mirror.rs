//! f and −f, and f·2^k: the same thing in other numbers ([NORM-1], [SPACE-4]).

use crate::common::strip::ramp;
use crate::common::{LAYERS, Stage, largest_difference, perspective};
use crate::stability::{Case, Theme, differing, worse};
use drypoint::scene::math::scale_by_power_of_two;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    Contours, GradientEstimator, GradientRange, Kappa, Kernel, NormalSide, Number, Outside, Shading, Unit,
};
use drypoint::scene::volume::{Volume, Voxels};

pub(crate) static THEME: Theme = Theme::new(
    "The same field in other numbers",
    &[
        Case {
            name: "f and −f, `outside` and nodes mirrored: pictures",
            breaks: "light from behind, contours on the wrong side",
            done: "one rule says where outside is [NORM-1]",
            of: "largest difference of a channel; 5 kernels, 3 gradients, 2 kinds of normal, shaded and styled",
            bound: 1e-12,
            why: "w and 1 − w are exchanged between nodes: some 10 ε a sample, some hundred samples a ray",
            measure: negative_pictures,
        },
        Case {
            name: "f and −f, `outside` and nodes mirrored: normals",
            breaks: "normals that depend on a sign by rounding",
            done: "derivatives are sums of differences [REC-2]",
            of: "numbers of normals with another bit; 5 kernels",
            bound: 0.0,
            why: "rounding is symmetric about 0",
            measure: negative_normals,
        },
        Case {
            name: "f·2^k, ranges and nodes with it, k = ±100",
            breaks: "squares of derivatives overflow, above all in f32",
            done: "derivatives are squared only after scaling by a power of two [SPACE-4]",
            of: "numbers with another bit in picture, depths, normals, curvatures; in values and gradients after 2^−k",
            bound: 0.0,
            why: "a power of two changes no mantissa",
            measure: powers_of_two,
        },
    ],
);

#[test]
fn the_same_field_in_other_numbers() {
    THEME.hold();
}

const KERNELS: [Kernel; 5] =
    [Kernel::Trilinear, Kernel::Bspline, Kernel::BsplineSmooth, Kernel::Bspline5, Kernel::CatmullRom];

/// A bumpy thing of u8 voxels.
fn voxels(grid: &Grid) -> Vec<u8> {
    crate::common::positions(grid)
        .map(|p| {
            (90.0 + 40.0 * (0.7 * p.x).sin() + 50.0 * (0.5 * p.y + 0.3 * p.z).cos() + 30.0 * (0.9 * p.z).sin()) as u8
        })
        .collect()
}

fn grid() -> Grid {
    Grid::with_spacing([13, 11, 12], [1.0, 1.5, 0.8]).unwrap()
}

fn seen(shot: Stage) -> Stage {
    shot.with(|s| {
        let direction = drypoint::scene::glam::DVec3::new(0.4, 0.8, -0.5);
        s.camera = perspective(35.0);
        s.camera.direction = direction;
    })
}

/// The same scene over −f: nodes negated and in reverse order, `outside` exchanged.
fn mirrored(shot: &Stage) -> Stage {
    let v = &shot.volume;
    let volume = Volume::new(v.grid().clone(), v.voxels().clone(), -v.slope(), -v.intercept()).unwrap();
    let other = Stage { volume, ..shot.clone() }.with_transfer(|t| {
        let nodes = t.nodes.as_mut().unwrap();
        nodes.reverse();
        nodes.iter_mut().for_each(|n| n.at = -n.at);
    });
    other.with(|s| {
        s.volume.outside = match s.volume.outside {
            Outside::Low => Outside::High,
            Outside::High => Outside::Low,
        }
    })
}

/// Shading and styles, kernels, estimators, kinds of normal: pictures agree to 10⁻¹². Node and fraction of a place are
/// exchanged, w for 1 − w, which is why not every bit is the same.
fn negative_pictures() -> f64 {
    let mut largest = 0.0;
    let volume = Volume::new(grid(), Voxels::U8(voxels(&grid())), 0.5, -20.0).unwrap();
    let regular = Stage::regular(
        volume.clone(),
        &[(10.0, [0.9, 0.3, 0.2], 0.0), (35.3, [0.2, 0.9, 0.2], 0.2), (61.0, [0.1, 0.4, 0.9], 0.5)],
    )
    .with(|s| s.shading = Some(Shading::default()));
    let styled = Stage::styled(volume, vec![ramp()], &[(10.0, "ramp", 0.0), (35.3, "ramp", 0.1), (61.0, "ramp", 0.6)])
        .with(|s| {
            s.contours = Some(Contours { kappa: Kappa::Exact, fade: Some([0.05, 0.3]), ..Contours::default() });
            s.volume.gradient_range = GradientRange::Quantile(0.99);
        });
    for kernel in KERNELS {
        for gradient in [GradientEstimator::Central, GradientEstimator::Analytic, GradientEstimator::Regression] {
            for normal in [NormalSide::Outward, NormalSide::Facing] {
                for shot in [&regular, &styled] {
                    let shot = seen(shot.with(|s| {
                        (s.sampling.kernel, s.sampling.gradient, s.sampling.normal) = (kernel, gradient, normal);
                    }));
                    largest = worse(largest, largest_difference(&shot.render(), &mirrored(&shot).render()));
                }
            }
        }
    }
    largest
}

/// Opaque, so that the layer of normals is that of one sample: N has the same bits.
fn negative_normals() -> f64 {
    let mut differ = 0.0;
    let volume = Volume::new(grid(), Voxels::U8(voxels(&grid())), 1.0, 0.0).unwrap();
    for kernel in KERNELS {
        for outside in [Outside::Low, Outside::High] {
            // No sample has the value at the step itself, where the later node holds on both sides.
            let shot = Stage::regular(volume.clone(), &[(110.123_456, [1.0; 3], 0.0), (110.123_456, [1.0; 3], 1.0)]);
            let shot = seen(shot.layers(&[LayerKind::Normal])).with(|s| {
                s.sampling.kernel = kernel;
                s.volume.outside = outside;
            });
            let (here, there) = (shot.render(), mirrored(&shot).render());
            assert!(here.covered() > 50);
            differ += differing(&here.layer_bits(LayerKind::Normal), &there.layer_bits(LayerKind::Normal));
            differ += differing(&here.pixels(), &there.pixels());
        }
    }
    differ
}

/// The literal gradient ([NORM-1]) is −f's outward normal: with `normal = "gradient"` exchanging `outside` changes nothing.
#[test]
fn the_literal_gradient_knows_no_outside() {
    let volume = Volume::new(grid(), Voxels::U8(voxels(&grid())), 1.0, 0.0).unwrap();
    let shot = seen(Stage::styled(volume, vec![ramp()], &[(60.0, "ramp", 0.0), (150.0, "ramp", 0.8)]))
        .with(|s| s.sampling.normal = NormalSide::Gradient);
    assert_eq!(shot.render().bits(), shot.with(|s| s.volume.outside = Outside::High).render().bits());
}

/// f·2^k with ranges and nodes moved along: the same bits, k = ±100, by slope and by stored values, in both number types;
/// gradients and values are 2^k times theirs, exactly.
fn powers_of_two() -> f64 {
    let mut differ = 0.0;
    let bytes = voxels(&grid());
    let stored = |k: i32| Voxels::F64(bytes.iter().map(|&v| scale_by_power_of_two(f64::from(v), k)).collect());
    let single = |k: i32| Voxels::F32(bytes.iter().map(|&v| scale_by_power_of_two(f64::from(v), k) as f32).collect());
    let nodes = [(60.0, "ramp", 0.0), (101.5, "ramp", 0.2), (150.0, "ramp", 0.7)];
    let at = |volume: Volume, k: i32, unit: Unit| {
        let nodes = nodes.map(|(at, name, opacity)| {
            let at = if unit == Unit::Normalized { at / 200.0 } else { scale_by_power_of_two(at, k) };
            (at, name, opacity)
        });
        seen(Stage::styled(volume, vec![ramp()], &nodes).layers(&LAYERS))
            .with(|s| {
                s.contours = Some(Contours { kappa: Kappa::Exact, fade: Some([0.05, 0.3]), ..Contours::default() });
                s.volume.gradient_range = GradientRange::Quantile(0.99);
            })
            .with_transfer(|t| t.unit = unit)
    };
    for number in [Number::F64, Number::F32] {
        for kernel in KERNELS {
            for range in [GradientRange::Quantile(0.99), GradientRange::Fixed([2.0, 17.0])] {
                let shown = |volume: Volume, k: i32, unit| {
                    at(volume, k, unit)
                        .with(|s| {
                            (s.sampling.number, s.sampling.kernel) = (number, kernel);
                            s.volume.gradient_range = match range {
                                GradientRange::Fixed(ends) => {
                                    GradientRange::Fixed(ends.map(|g| scale_by_power_of_two(g, k)))
                                }
                                quantile => quantile,
                            };
                        })
                        .render()
                };
                let made = |voxels, k| Volume::new(grid(), voxels, scale_by_power_of_two(1.0, k), 0.0).unwrap();
                for unit in [Unit::Value, Unit::Normalized] {
                    // Bytes have a Hessian of their own: floats are compared with floats.
                    for (one, other) in [
                        ((Voxels::U8(bytes.clone()), 0), (Voxels::U8(bytes.clone()), 100)),
                        ((stored(0), 0), (stored(-100), 0)),
                        ((single(0), 0), (single(100), 0)),
                        ((stored(0), 0), (stored(100), -200)),
                    ] {
                        let k = other.1
                            + match &other.0 {
                                Voxels::U8(_) => 0,
                                Voxels::F32(_) => 100,
                                _ if other.1 == 0 => -100,
                                _ => 100,
                            };
                        let a = shown(made(one.0, one.1), 0, unit);
                        let b = shown(made(other.0, other.1), k, unit);
                        assert!(a.covered() > 50);
                        for kind in [LayerKind::Beauty, LayerKind::Depth, LayerKind::Normal, LayerKind::Curvature] {
                            differ += differing(&a.layer_bits(kind), &b.layer_bits(kind));
                        }
                        for kind in [LayerKind::First, LayerKind::Gradient] {
                            let values = |s: &crate::common::Shown, k: i32| {
                                let channels = &s.picture.layer(kind).unwrap().channels;
                                channels.iter().flatten().map(|&v| scale_by_power_of_two(v, k)).collect::<Vec<_>>()
                            };
                            differ += differing(&values(&a, k), &values(&b, 0));
                        }
                        assert_eq!(a.counts.samples, b.counts.samples);
                    }
                    if number == Number::F32 || kernel != Kernel::Trilinear {
                        break;
                    }
                }
            }
        }
    }
    differ
}
