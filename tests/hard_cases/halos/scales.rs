//! Units of values and lengths, and number types.

use super::{beauty, by_curvature, crossing, dark, glow, linear};
use crate::common::{Stage, largest_difference, on, orthographic};
use crate::stability::{differing, worst};
use drypoint::scene::glam::DVec3;
use drypoint::scene::math::scale_by_power_of_two;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    FocusPoints, GradientRange, Halo, HaloFocus, Kernel, Length, Number, ProfileNode, SeedValue,
};

/// Two tubes of values times `value`, in a world whose lengths are times `length`; seeds by power and by curvature.
fn scene(value: f64, length: f64) -> Stage {
    let grid = Grid::with_spacing([20, 18, 16], [1.0, 0.9, 1.1].map(|s| s * length)).unwrap();
    let field = on(grid.clone(), |p| {
        let p = p / length;
        let a = 3.0 - DVec3::new(p.x - 7.0, p.y - 6.0, 0.0).length();
        let b = 2.5 - DVec3::new(0.0, p.y - 11.0, p.z - 9.0).length();
        value * a.max(b)
    });
    let smooth = |halo: Halo| Halo { floor: 0.0, profile: linear(0.6), ..halo };
    let mut light = smooth(glow());
    light.seed.value = Some(SeedValue::Nodes(vec![[-0.5 * value, 0.0], [0.5 * value, 1.0]]));
    light.seed.focus = Some(HaloFocus {
        points: FocusPoints::World(vec![grid.centre()]),
        inner: Length::World(2.0 * length),
        falloff: Length::World(9.0 * length),
    });
    let mut shade = smooth(by_curvature(dark()));
    shade.seed.thickness = Length::World(0.8 * length);
    shade.profile[1] = ProfileNode { rgb: [0.0, 0.2, 0.1], ..shade.profile[1] };
    let nodes = [(-0.5 * value, [0.7, 0.5, 0.3], 0.0), (0.5 * value, [0.7, 0.5, 0.3], 0.6)];
    Stage::regular(field, &nodes).with(|s| {
        s.halos = vec![light, shade];
        s.camera = orthographic(Some(16.0 * length));
        s.camera.direction = DVec3::new(0.1, 1.0, 0.2);
        s.camera.direction_given = true;
        s.camera.eye = Some(grid.centre() - DVec3::new(0.1, 1.0, 0.2) * 30.0 * length);
        s.picture.size = [24, 24];
        s.sampling.kernel = Kernel::Trilinear;
        s.sampling.step = Length::World(0.5 * length);
        s.sampling.reference_length = Length::World(length);
        s.volume.gradient_range = GradientRange::Quantile(0.99);
    })
}

pub(super) fn by_two(number: Number) -> f64 {
    let most = if number == Number::F32 { 30 } else { 100 };
    let here = scene(1.0, 1.0).in_number(number).render();
    assert!(beauty(&here) != beauty(&scene(1.0, 1.0).in_number(number).with(|s| s.halos.clear()).render()));
    let scales = [-most, -7, most].map(|k| scale_by_power_of_two(1.0, k));
    let other =
        |value: f64, length: f64| differing(&here.bits(), &scene(value, length).in_number(number).render().bits());
    scales.into_iter().map(|scale| other(scale, 1.0) + other(1.0, scale)).sum()
}

pub(super) fn by_ten() -> f64 {
    let here = scene(1.0, 1.0).render();
    let other = |value: f64, length: f64| largest_difference(&here, &scene(value, length).render());
    worst([1e6, 1e-6].into_iter().flat_map(|scale| [other(scale, 1.0), other(1.0, scale)]))
}

pub(super) fn single() -> f64 {
    let smooth = |halo: Halo| Halo { floor: 0.0, profile: linear(0.6), ..halo };
    let stage = crossing().halos(&[smooth(glow()), smooth(dark())]);
    let difference = largest_difference(&stage.render(), &stage.in_number(Number::F32).render());
    assert!(difference > 0.0);
    difference
}
