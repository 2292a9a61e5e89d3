//! Which samples seed: parts of the volume, of the circle, of the grid.

use super::{H, beauty, crossing, dark, glow, largest, other};
use crate::common::{Stage, on, orthographic, perspective, volume};
use crate::stability::{differing, worst};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    Exponents, FocusPoints, GradientEstimator, Halo, HaloFocus, HaloSource, Kernel, LabelKey, LabelLookup, Length,
    SeedDirection, SeedValue,
};
use drypoint::scene::volume::labels::LabelVolume;
use drypoint::scene::volume::{Volume, Voxels};

pub(super) fn eye_inside() -> f64 {
    let field = |p: DVec3| {
        let tube = 2.5 - DVec3::new(p.x - 9.0, p.y - 16.0, 0.0).length();
        tube.max(2.0 - (p - DVec3::new(14.0, 21.0, 12.0)).length())
    };
    let stage = |before: f64| {
        let field = volume([24; 3], |p| if p.y < 9.5 { field(p) + before } else { field(p) });
        Stage::regular(field, &[(-0.5, [0.7, 0.5, 0.3], 0.0), (0.5, [0.7, 0.5, 0.3], 0.6)]).with(|s| {
            s.camera = perspective(60.0);
            s.camera.direction = DVec3::Y;
            s.camera.direction_given = true;
            s.camera.eye = Some(DVec3::new(11.5, 8.0, 11.5));
            s.camera.near = Some(Length::World(3.0));
            s.picture.size = [32, 32];
        })
    };
    let of = |before: f64| stage(before).halos(&[glow(), dark()]).render();
    let (alone, crowded) = (of(0.0), of(100.0));
    assert!(largest(&alone.one(H)) > 0.1);
    differing(&alone.bits(), &crowded.bits())
}

/// Seeds of values from −1 to 1, most at 0.
fn of_the_surface(mut halo: Halo) -> Halo {
    halo.seed.value = Some(SeedValue::Nodes(vec![[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0]]));
    halo
}

pub(super) fn masked() -> f64 {
    let whole = crossing();
    let values = |f: &dyn Fn(f64) -> f64| {
        let field = (0..whole.volume.voxels().len()).map(|i| f(whole.volume.voxels().get(i))).collect();
        Volume::new(whole.volume.grid().clone(), Voxels::F64(field), 1.0, 0.0).unwrap()
    };
    // Values change by at most √3 in a cell. So cells with values of both signs, and near them, have a masked corner.
    let holed = other(&whole, values(&|v| if v.abs() < 2.0 { f64::NAN } else { v }));
    let halos = [of_the_surface(glow()), of_the_surface(dark())];
    assert!(largest(&whole.halos(&halos).render().one(H)) > 0.1);
    let shown = holed.halos(&halos).render();
    let nans = shown.picture.layers.iter().flat_map(|l| l.channels.iter().flatten()).filter(|v| v.is_nan()).count();
    differing(&beauty(&shown), &beauty(&holed.render())) + shown.counts.halo_passes as f64 + nans as f64
}

/// A tube along z, and another one beside it.
fn two_tubes(second: bool) -> Stage {
    let field = volume([32, 15, 16], |p| {
        let tube = |x: f64| 3.0 - DVec3::new(p.x - x, p.y - 7.0, 0.0).length();
        if second { tube(8.0).max(tube(23.0)) } else { tube(8.0) }
    });
    Stage::regular(field, &[(0.0, [0.7, 0.5, 0.3], 0.0), (1.0, [0.7, 0.5, 0.3], 0.1)]).with(|s| {
        s.camera = orthographic(Some(20.0));
        s.camera.direction = DVec3::new(0.1, 1.0, 0.2);
        s.camera.target = Some(DVec3::new(15.5, 7.0, 7.5));
        s.picture.size = [64, 32];
    })
}

/// Bits of H that a factor of the seeds in a volume of two tubes makes other than those of the first tube alone.
fn differs_from_one(halo: &Halo, set: impl FnOnce(&mut Stage)) -> f64 {
    let plain = || [of_the_surface(Halo { name: "one".into(), ..dark() })];
    let alone = two_tubes(false).halos(&plain()).render();
    let both = two_tubes(true).halos(&plain()).render();
    assert!(differing(&alone.layer_bits(H), &both.layer_bits(H)) > 100.0);
    let mut stage = two_tubes(true).halos(std::slice::from_ref(halo));
    set(&mut stage);
    differing(&stage.render().layer_bits(H), &alone.layer_bits(H))
}

pub(super) fn labels() -> f64 {
    let mut halo = of_the_surface(dark());
    halo.seed.labels = Some(vec![LabelKey::Id(1), LabelKey::Id(7)]);
    let ids = volume([32, 15, 16], |p| if p.x < 15.5 { 1.0 } else { 2.0 });
    let differ = [LabelLookup::Nearest, LabelLookup::Smooth].map(|lookup| {
        differs_from_one(&halo, |stage| {
            stage.labels = Some(LabelVolume::new(&ids).unwrap());
            stage.scene.volume.labels = Some("labels".into());
            stage.scene.volume.label_lookup = lookup;
        })
    });
    differ.into_iter().sum()
}

pub(super) fn focus() -> f64 {
    let focused = |at: &[[f64; 3]], inner: f64, falloff: f64| {
        let points = FocusPoints::World(at.iter().copied().map(DVec3::from_array).collect());
        let mut halo = of_the_surface(dark());
        halo.seed.focus = Some(HaloFocus { points, inner: Length::World(inner), falloff: Length::World(falloff) });
        halo
    };
    // Of the seeds of the first tube none is 4 from its axis or 9 from its middle; those of the other one are 11 away.
    let of_one = |at: &[[f64; 3]], inner: f64| differs_from_one(&focused(at, inner, 0.0), |_| ());
    let mut differ = of_one(&[[8.0, 7.0, 7.5]], 10.0) + of_one(&[[8.0, 7.0, -2.0], [8.0, 7.0, 17.0]], 4.5);
    let bits = |at: &[[f64; 3]], falloff: f64| two_tubes(true).halos(&[focused(at, 3.0, falloff)]).render();
    for falloff in [0.0, 6.0] {
        let [once, twice] = [&[[9.0, 6.0, 8.0]][..], &[[9.0, 6.0, 8.0]; 3]].map(|at| bits(at, falloff));
        assert!(largest(&once.one(H)) > 0.05);
        differ += differing(&once.bits(), &twice.bits());
    }
    differ
}

pub(super) fn directions() -> f64 {
    let of = |direction: Option<SeedDirection>| {
        let mut halo = dark();
        halo.seed.value = Some(SeedValue::Opacity);
        halo.seed.direction = direction;
        (halo.spread.from, halo.spread.passes, halo.floor) = (HaloSource::Seeds, 0, 0.0);
        crossing().halos(&[halo]).render().one(H)
    };
    let toward = |toward: f64, width: f64| of(Some(SeedDirection { toward, width, softness: 0.0 }));
    let all = of(None);
    let mut differ = 0.0;
    for width in [360.0, 1000.0] {
        differ += differing(&toward(33.0, width), &all);
    }
    for angle in [0.0, 90.0, 135.0, -200.0] {
        let [one, other] = [angle, angle + 180.0].map(|angle| toward(angle, 180.0));
        assert!(one != all && other != all);
        let both: Vec<f64> = one.iter().zip(&other).map(|(a, b)| a.max(*b)).collect();
        differ += differing(&both, &all);
    }
    differ
}

pub(super) fn grids() -> f64 {
    let (centre, radius) = (DVec3::new(1.0, 2.0, 3.0), 6.0);
    let centred = |dims: [usize; 3], axes: DMat3| {
        let middle = DVec3::from_array(dims.map(|n| (n - 1) as f64 / 2.0));
        Grid::new(dims, axes, centre - axes * middle).unwrap()
    };
    let sheared = DMat3::from_cols(DVec3::new(1.0, 0.2, 0.0), DVec3::new(-0.3, 0.9, 0.1), DVec3::new(0.2, 0.1, 1.4));
    let of = |grid: Grid| {
        let field = on(grid, |p| (radius * radius - (p - centre).length_squared()) / (2.0 * radius));
        let mut halo = dark();
        halo.exponents = Exponents::Numbers([0.5, 32.0]);
        halo.floor = 0.0;
        halo.seed.value = Some(SeedValue::Nodes(vec![[-0.5, 0.0], [0.0, 1.0], [0.5, 0.0]]));
        let mut curved = super::by_curvature(halo.clone());
        curved.seed.thickness = Length::World(1.0);
        Stage::regular(field, &[(-1e3, [0.5; 3], 0.0), (1e3, [0.5; 3], 0.1)]).halos(&[halo, curved]).with(|s| {
            let direction = DVec3::new(0.3, 1.0, -0.4).normalize();
            s.camera = orthographic(Some(18.0));
            s.camera.direction = direction;
            s.camera.direction_given = true;
            s.camera.eye = Some(centre - direction * 20.0);
            s.picture.size = [36, 36];
            s.sampling.step = Length::World(0.5);
            s.sampling.kernel = Kernel::Bspline;
            s.sampling.gradient = GradientEstimator::Analytic;
        })
    };
    let fine = of(centred([31; 3], DMat3::from_diagonal(DVec3::splat(0.5)))).render();
    let grids = [
        centred([17; 3], DMat3::IDENTITY),
        centred([17, 29, 9], DMat3::from_diagonal(DVec3::new(0.9, 0.55, 1.9))),
        centred([25, 27, 17], sheared),
    ];
    worst(grids.into_iter().flat_map(|grid| {
        let shown = of(grid).render();
        [0, 1].map(|i| {
            let layer = drypoint::scene::picture::LayerKind::Halo(i);
            let (one, other) = (fine.one(layer), shown.one(layer));
            assert!(largest(&one) > 0.2, "{}", largest(&one));
            worst(one.iter().zip(&other).map(|(a, b)| (a - b).abs()))
        })
    }))
}
