//! Functions over two quantities (4.2; [STF-4]).

use super::{one_sample, planes, smooth};
use crate::common::{Shown, Stage, on, orthographic, plain, positions, volume};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    Axis, Camera, GradientRange, LabelKey, Mix, Node, NodeColor, Number, Over, RaysPerPixel, Row, RowAt, Shading,
    Transfer, TransferKind, Transparency, Unit,
};
use drypoint::scene::volume::labels::LabelVolume;
use drypoint::scene::volume::{Volume, Voxels};

/// A row by hand: where it stands, and its nodes as (at, style or colour, α_u).
type ByHand<'a, C> = (f64, &'a [(f64, C, f64)]);

/// Rows of styles.
fn styled(rows: &[ByHand<'_, &str>]) -> Vec<Row> {
    rows_of(rows, |name| NodeColor::Style((*name).into()))
}

/// Rows of colours.
fn colored(rows: &[ByHand<'_, [f64; 3]>]) -> Vec<Row> {
    rows_of(rows, |c| NodeColor::Color(*c))
}

fn rows_of<C>(rows: &[ByHand<'_, C>], color: impl Fn(&C) -> NodeColor) -> Vec<Row> {
    let node = |(at, c, opacity): &(f64, C, f64)| Node { at: *at, color: color(c), opacity: *opacity };
    let row = |(y, nodes): &ByHand<'_, C>| Row { at: RowAt::Number(*y), nodes: nodes.iter().map(node).collect() };
    rows.iter().map(row).collect()
}

/// The same picture with a function over two quantities.
fn over(shot: &Stage, axes: [Axis; 2], rows: Vec<Row>) -> Stage {
    let kind = match rows[0].nodes[0].color {
        NodeColor::Style(_) => TransferKind::Style,
        NodeColor::Color(_) => TransferKind::Regular,
    };
    shot.with_transfer(|t| {
        *t = Transfer { kind, over: Over::Two(axes), nodes: None, rows: Some(rows), ..t.clone() };
    })
}

const RED: [f64; 3] = [1.0, 0.0, 0.0];
const BLUE: [f64; 3] = [0.0, 0.0, 1.0];

/// One sample with the value 15 at the distance 5 from (3, 4, 0) off it.
fn sample(rows: Vec<Row>, mix: Mix) -> [f64; 4] {
    let styles = vec![
        plain("red", [1.0, 0.0, 0.0, 1.0]),
        plain("half", [0.0, 1.0, 0.0, 0.5]),
        plain("blue", [0.0, 0.0, 1.0, 1.0]),
        plain("clear", [1.0, 1.0, 0.0, 0.0]),
    ];
    let shot = Stage::styled(volume([5; 3], |_| 15.0), styles, &[]);
    let shot = over(&shot, [Axis::Value, Axis::Distance(DVec3::new(5.0, 6.0, 2.0))], rows).with_transfer(|t| {
        t.mix = mix;
        t.transparency = Transparency::Plain;
    });
    one_sample(&shot, [0.0, 1.0, 0.0], 2.0).with(|s| s.picture.size = [1, 1]).render().pixels()[0]
}

fn is(found: [f64; 4], expected: [f64; 4]) {
    // α loses 2 ε on its way through logarithm and exponential; the mix of four has two roundings more.
    let near = |c: usize| (found[c] - expected[c]).abs() <= 4.0 * f64::EPSILON;
    assert!((0..4).all(near), "{found:?} {expected:?}");
}

#[test]
fn four_styles_mix_as_printed() {
    // Half way along the rows, a quarter from the one at 0 to the one at 20.
    let rows = || {
        styled(&[
            (0.0, &[(10.0, "red", 0.2), (20.0, "half", 0.4)]),
            (20.0, &[(10.0, "blue", 0.6), (20.0, "clear", 0.8)]),
        ])
    };
    // Shares 3/8, 3/8, 1/8, 1/8: α_u = 0.4, α_d = 3/8 + 3/16 + 1/8 = 11/16.
    let [alpha_u, alpha_d] = [0.4, 0.6875];
    is(sample(rows(), Mix::Premultiplied), [0.375, 0.1875, 0.125, alpha_d].map(|c| c * alpha_u));
    // Printed: RGB (3/8, 3/8, 1/8) by themselves, times α_d; what has no opacity has no colour either.
    let printed = [0.375 * alpha_d, 0.375 * alpha_d, 0.125 * alpha_d, alpha_d];
    is(sample(rows(), Mix::Printed), printed.map(|c| c * alpha_u));
}

#[test]
fn four_colors_mix_straight() {
    let rows = colored(&[
        (0.0, &[(10.0, RED, 0.0), (20.0, [0.0, 1.0, 0.0], 0.4)]),
        (20.0, &[(10.0, BLUE, 1.0), (20.0, [1.0, 1.0, 1.0], 0.8)]),
    ]);
    // α_u = ¾·0.2 + ¼·0.9; a node of opacity 0 keeps its colour.
    let a = 0.75 * 0.2 + 0.25 * 0.9;
    is(sample(rows, Mix::Premultiplied), [0.5 * a, 0.5 * a, 0.25 * a, a]);
}

#[test]
fn rows_may_have_nodes_of_their_own() {
    // In the upper row 15 lies a quarter from 10 to 30; in the lower one beyond its only node.
    let rows = styled(&[(0.0, &[(10.0, "red", 0.2), (30.0, "blue", 1.0)]), (10.0, &[(5.0, "red", 0.8)])]);
    // Row 0: ¾ red, ¼ blue, α_u = 0.4. Half and half with red: 7/8 red, α_u = 0.6.
    is(sample(rows, Mix::Premultiplied), [0.875 * 0.6, 0.0, 0.125 * 0.6, 0.6]);
}

/// A logistic boundary of width s about a sphere: f = 100/(1 + e^((ρ − R)/s)), ‖g‖ = f(100 − f)/100s, at most 25/s.
const RADIUS: f64 = 16.0;
const WIDTH: f64 = 2.0;

fn logistic() -> Stage {
    let centre = DVec3::splat(27.5);
    let field = volume([56; 3], |p| 100.0 / (1.0 + (((p - centre).length() - RADIUS) / WIDTH).exp()));
    smooth(&Stage::regular(field, &[]))
}

/// ‖g‖ ≥ g₀ is the shell |ρ − R| ≤ 2s·acosh √(25/s g₀): where the ray meets it first, and what values it has.
#[test]
fn gradient_magnitude_selects_the_boundary() {
    let (g0, step) = (8.0, 1.0 / 64.0);
    let half = 2.0 * WIDTH * (25.0 / (WIDTH * g0)).sqrt().acosh();
    let rows = |at: f64| colored(&[(0.0, &[(0.0, RED, 0.0)]), (at, &[(0.0, RED, 0.0)]), (at, &[(0.0, RED, 1.0)])]);
    let shot = planes(&over(&logistic(), [Axis::Value, Axis::GradientMagnitude], rows(g0)), step);
    let shot = shot.layers(&[LayerKind::Depth, LayerKind::First]).with(|s| {
        s.camera = Camera { direction: DVec3::Y, ..orthographic(Some(8.0)) };
        s.picture.size = [8, 8];
    });
    let shown = shot.render();
    let first: Vec<f64> = shown.layer::<3>(LayerKind::Depth).iter().map(|d| d[0]).collect();
    let values = shown.one(LayerKind::First);
    for (i, (depth, value)) in first.iter().zip(values).enumerate() {
        let [x, z] = [i % 8, i / 8].map(|p| p as f64 + 0.5 - 4.0);
        let outer = RADIUS + half;
        let want = -(outer * outer - x * x - z * z).sqrt();
        // The quintic's gradient is off by 10⁻⁴ of g₀ here, which moves the shell by less than a hundredth of a step.
        assert!(*depth >= want - 0.01 * step && *depth <= want + 1.01 * step, "{depth} {want}");
        let edge = 100.0 / (1.0 + (half / WIDTH).exp());
        assert!((value - edge).abs() < 25.0 / WIDTH * step, "{value} {edge}");
    }
    // The same in |g| of a given range: 8 of [4, 20] is a quarter; and f32 sees the same.
    let normalized = |number| {
        over(&shot, [Axis::Value, Axis::GradientMagnitude], rows(0.25))
            .with_transfer(|t| t.unit = Unit::Normalized)
            .with(|s| {
                s.volume.gradient_range = GradientRange::Fixed([4.0, 20.0]);
                s.sampling.number = number;
            })
            .render()
    };
    assert_eq!(normalized(Number::F64).bits(), shown.bits());
    let depth = |d: &Shown| d.layer::<3>(LayerKind::Depth).iter().map(|d| d[0]).collect::<Vec<f64>>();
    let narrow = normalized(Number::F32);
    assert!(depth(&narrow).iter().zip(&first).all(|(a, b)| (a - b).abs() <= 1.01 * step));
    // Values far from the boundary are empty there, but the gate knows the value alone: each sample has a gradient.
    assert_eq!(shown.counts.gradients, shown.counts.samples);
    assert_eq!((shown.counts.hessians, shown.counts.style_lookups), (0, 0));
}

/// Everything at most r from a point of a homogeneous box is a ball of that radius.
#[test]
fn a_distance_cuts_a_ball() {
    let (radius, point) = (7.3, DVec3::new(13.0, 11.0, 14.0));
    let step = 1.0 / 32.0;
    let rows = colored(&[(0.0, &[(0.0, RED, 1.0)]), (radius, &[(0.0, RED, 1.0)]), (radius, &[(0.0, RED, 0.0)])]);
    let shot = over(&Stage::regular(volume([28; 3], |_| 1.0), &[]), [Axis::Value, Axis::Distance(point)], rows);
    let shot = planes(&shot, step).layers(&[LayerKind::Depth]).with(|s| {
        s.camera = Camera { direction: DVec3::Y, target: Some(point), ..orthographic(Some(20.0)) };
        s.picture.size = [40, 40];
    });
    let shown = shot.render();
    let mut covered = 0;
    for (i, depth) in shown.layer::<3>(LayerKind::Depth).iter().map(|d| d[0]).enumerate() {
        let [x, z] = [i % 40, i / 40].map(|p| (p as f64 + 0.5) * 0.5 - 10.0);
        let squared = radius * radius - x * x - z * z;
        // A chord shorter than a step may lie between two planes.
        if squared <= 0.0 {
            assert_eq!(depth, f64::INFINITY);
        } else if 2.0 * squared.sqrt() > step {
            let want = -squared.sqrt();
            assert!(depth >= want - 1e-12 && depth <= want + step, "{depth} {want}");
            covered += 1;
        }
    }
    assert!(covered > 600);
    // Nothing of it needs a gradient; with styles those that are seen do, and no others.
    assert_eq!(shown.counts.gradients, 0);
    let styles = styled(&[(0.0, &[(0.0, "red", 1.0)]), (radius, &[(0.0, "red", 1.0)]), (radius, &[(0.0, "red", 0.0)])]);
    let mut shot = over(&shot, [Axis::Value, Axis::Distance(point)], styles);
    shot.styles = vec![plain("red", [1.0, 0.0, 0.0, 0.5])];
    let seen = shot.render().counts;
    assert_eq!(seen.gradients, seen.style_lookups);
    assert_eq!(seen.without_normal, seen.gradients, "a constant has no normal");
    assert!(seen.gradients > 0 && seen.gradients < seen.samples / 2, "{seen:?}");
}

/// On a torus κ₁κ₂ is above 0 on the outer half and below it on the inner one.
#[test]
fn curvature_parts_the_inside_of_a_torus_from_its_outside() {
    let (big, small, centre) = (14.0, 5.0, DVec3::splat(23.5));
    let torus = volume([48; 3], |p| {
        let q = p - centre;
        let ring = q.truncate().length() - big;
        (small * small - ring * ring - q.z * q.z) / (2.0 * small)
    });
    for from_above in [true, false] {
        let zero = [(0.0, [0.0; 3], 0.0), (0.0, [0.0; 3], 1.0)];
        let line = |c: [f64; 3]| zero.map(|(at, _, opacity)| (at, c, opacity));
        let rows = colored(&[(0.0, &line(RED)), (0.0, &line(BLUE))]);
        let shot = smooth(&Stage::regular(torus.clone(), &[]));
        let shot = over(&shot, [Axis::Value, Axis::Gaussian], rows);
        let shot = planes(&shot, 1.0 / 16.0).with(|s| {
            s.camera = Camera {
                direction: if from_above { -DVec3::Z } else { DVec3::Z },
                up: DVec3::Y,
                ..orthographic(Some(40.0))
            };
            s.picture.size = [80, 80];
        });
        let shown = shot.render();
        let mut each = [0, 0];
        for (i, p) in shown.pixels().iter().enumerate() {
            let [x, y] = [i % 80, i / 80].map(|k| (k as f64 + 0.5) * 0.5 - 20.0);
            let ring = x.hypot(y) - big;
            // The sample is up to a step below the surface, which moves nothing along the ring.
            if ring.abs() < 0.99 * small && ring.abs() > 0.05 {
                assert_eq!(*p, if ring < 0.0 { [1.0, 0.0, 0.0, 1.0] } else { [0.0, 0.0, 1.0, 1.0] }, "{x} {y}");
                each[usize::from(ring > 0.0)] += 1;
            }
        }
        assert!(each[0] > 800 && each[1] > 1500, "{each:?}");
        assert!(shown.counts.hessians > 0 && shown.counts.hessians == shown.counts.gradients);
    }
}

/// A further volume on a coarser grid of its own, linear along x: one half is shown.
#[test]
fn a_further_volume_selects_by_its_own_grid() {
    let grid = Grid::with_spacing([8, 8, 8], [4.0; 3]).unwrap();
    let mut shot = Stage::regular(volume([24; 3], |_| 1.0), &[]);
    shot.further[1] = Some(on(grid, |p| p.x));
    let rows = colored(&[(0.0, &[(0.0, RED, 0.0)]), (11.25, &[(0.0, RED, 0.0)]), (11.25, &[(0.0, RED, 1.0)])]);
    let shot = over(&shot, [Axis::Value, Axis::Volume("x.nrrd".into())], rows).with(|s| {
        s.camera = Camera { direction: DVec3::Y, ..orthographic(Some(23.0)) };
        s.picture.size = [46, 1];
    });
    let shown = shot.render();
    let covered: Vec<bool> = shown.pixels().iter().map(|p| p[3] > 0.0).collect();
    // Pixel i is seen at x = 11.5 + (i + ½ − 23)·23, of which one pixel high is the whole box.
    let at = |i: usize| 11.5 + (i as f64 + 0.5 - 23.0) * 23.0;
    for (i, covered) in covered.iter().enumerate() {
        assert_eq!(*covered, (11.25..=23.0).contains(&at(i)), "{i}");
    }
    assert!(shown.counts.bytes["further volume"] == 8 * 512);
}

/// Shading and colours of a regular function over two quantities: Blinn's light acts on the mixed colour.
#[test]
fn a_regular_function_is_shaded() {
    let rows =
        colored(&[(0.0, &[(50.0, RED, 0.0), (50.0, RED, 1.0)]), (12.0, &[(50.0, BLUE, 0.0), (50.0, BLUE, 1.0)])]);
    let plain = planes(&over(&logistic(), [Axis::Value, Axis::GradientMagnitude], rows), 0.25)
        .with(|s| s.picture.size = [15, 15]);
    let lit = plain.with(|s| s.shading = Some(Shading { specular: 0.0, ..Shading::default() })).render();
    let middle = |shown: &Shown| shown.pixels()[7 * 15 + 7];
    // On the surface ‖g‖ is 25/2 = 12.5, and a step below it still above the second row.
    assert_eq!(middle(&plain.render()), [0.0, 0.0, 1.0, 1.0]);
    // N·L is 1 in the middle: 0.3 + 0.6.
    assert!((middle(&lit)[2] - 0.9).abs() < 1e-12, "{:?}", middle(&lit));
}

/// Fig. 9 in small: each part in its own style, an id without a row nothing, and bricks of such parts left out.
#[test]
fn each_label_has_a_function_of_its_own() {
    let n = 32;
    let data = volume([n; 3], |_| 40.0);
    let id = |x: f64| {
        if x < 8.0 {
            3
        } else if x < 16.0 {
            7
        } else {
            9
        }
    };
    let ids = (0..n * n * n).map(|i| id((i % n) as f64)).collect();
    let labels = Volume::new(data.grid().clone(), Voxels::U8(ids), 1.0, 0.0).unwrap();
    // Seven begins to be seen at 50: its voxels are too low. Nine has no row.
    let nodes: [&[(f64, &str, f64)]; 2] =
        [&[(30.0, "red", 0.0), (35.0, "red", 1.0)], &[(50.0, "blue", 0.0), (60.0, "blue", 1.0)]];
    let rows = |low: f64| {
        let mut rows = styled(&[(7.0, nodes[1]), (3.0, nodes[0])]);
        rows[0].nodes.iter_mut().for_each(|node| node.at -= low);
        rows
    };
    let styles = vec![plain("red", [1.0, 0.0, 0.0, 1.0]), plain("blue", [0.0, 0.0, 1.0, 1.0])];
    let mut shot = Stage::styled(data, styles, &[]);
    shot.labels = Some(LabelVolume::new(&labels).unwrap());
    let shot = planes(&shot, 0.25).with(|s| {
        s.camera = Camera { direction: DVec3::Y, ..orthographic(Some(31.0)) };
        s.picture.size = [62, 62];
        s.picture.samples = RaysPerPixel::Across(1);
    });
    let seen = |low: f64, color: fn(f64) -> [f64; 4]| {
        let shown = over(&shot, [Axis::Value, Axis::Label], rows(low)).render();
        for (i, p) in shown.pixels().iter().enumerate() {
            let x = ((i % 62) as f64 + 0.5) * 0.5;
            assert_eq!(*p, color(x), "{x}");
        }
        shown.counts
    };
    // Nearest: borders half way between voxels.
    let one = seen(0.0, |x| if x < 7.5 { [1.0, 0.0, 0.0, 1.0] } else { [0.0; 4] });
    let both = seen(20.0, |x| match x {
        x if x < 7.5 => [1.0, 0.0, 0.0, 1.0],
        x if x < 15.5 => [0.0, 0.0, 1.0, 1.0],
        _ => [0.0; 4],
    });
    // Rays end at the first opaque sample. Bricks of four cells: those of label 3 alone, and one more at the border.
    assert!(one.rays_skipped > 62 * 40 && both.rays_skipped > 62 * 25, "{one:?} {both:?}");
    assert_eq!((one.gradients, one.style_lookups), (15 * 62, 15 * 62), "{one:?}");
    assert_eq!((one.bytes["labels"], one.preprocess.len()), (32_768, 0));
}

/// Up to a distance from a part: the part and a shell about it, on a grid whose voxels are twice as high as wide.
#[test]
fn the_neighbourhood_of_a_label() {
    let grid = Grid::with_spacing([33, 33, 17], [1.0, 1.0, 2.0]).unwrap();
    let centre = DVec3::splat(16.0);
    let ids = positions(&grid).map(|p| u8::from((p - centre).length() <= 6.0) * 4).collect();
    let labels = Volume::new(grid.clone(), Voxels::U8(ids), 1.0, 0.0).unwrap();
    let mut shot = Stage::regular(on(grid, |_| 1.0), &[]);
    shot.labels = Some(LabelVolume::new(&labels).unwrap());
    let near = 5.0;
    let rows = colored(&[(0.0, &[(0.0, RED, 1.0)]), (near, &[(0.0, RED, 1.0)]), (near, &[(0.0, RED, 0.0)])]);
    let shot = over(&shot, [Axis::Value, Axis::DistanceToLabel(LabelKey::Id(4))], rows).with(|s| {
        s.camera = Camera { direction: DVec3::Y, ..orthographic(Some(32.0)) };
        s.picture.size = [64, 64];
    });
    let shown = shot.render();
    for (i, p) in shown.pixels().iter().enumerate() {
        let [x, z] = [i % 64, i / 64].map(|k| (k as f64 + 0.5) * 0.5 - 16.0);
        let radius = x.hypot(z);
        // Voxel centres of the ball reach at least 6 less the half diagonal of a voxel, √1.5; trilinear distances, which
        // are convex between voxels, are too large by less than that too.
        if radius < 6.0 + near - 2.0 * 1.5f64.sqrt() {
            assert!(p[3] > 0.99, "{x} {z}: {p:?}");
        } else if radius > 6.0 + near + 1.5f64.sqrt() {
            assert_eq!(*p, [0.0; 4], "{x} {z}");
        }
    }
    let counts = shown.counts;
    assert_eq!(
        (counts.preprocess["label distances"], counts.bytes["label distance"]),
        (33 * 33 * 17, 33 * 33 * 17 * 8)
    );
}
