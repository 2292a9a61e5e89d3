//! Volumetric halos of a picture (Bruckner and Gröller 2007), with nothing left to decide.

use super::{
    HaloAccumulation, HaloKind, HaloSource, Outside, ProfileNode, SampleQuery, SeedDirection, SeedValue, ShotError,
    iso_value, query,
};
use crate::plan::{Plan, halos_in_effect};
use crate::space::Grid;
use crate::tables::{
    FocusPoints, Halo, LabelKey, Length, PartName, PictureSettings, Scene, SeedBy, Seeding, Spreading,
};
use crate::transfer::Function;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The halos of a picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Halos {
    /// The halos, in the scene's order: of emissive ones the first lies in front, of occlusive ones the first is mixed
    /// last ([HALO-7]). All of the scene if one has an effect, so that layers find them by their places; else none. One without an
    /// effect beside others has no seeds.
    pub list: Vec<HaloParams>,
    /// The query of every sample of the background that is asked for its seeds.
    pub query: SampleQuery,
}

/// The seeds of halos among the samples of a selection or a ghost, by its own function and labels ([VS-2]).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PartSeeds {
    /// The seeds of each of [`Halos::list`]; 0 everywhere for a halo that takes other parts.
    pub list: Vec<HaloSeed>,
    /// The query of every sample that is asked for its seeds.
    pub query: SampleQuery,
}

/// One halo.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HaloParams {
    /// Its name.
    pub name: String,
    /// Emissive or occlusive ([HALO-7]).
    pub kind: HaloKind,
    /// Which samples of the background are seeds, and how strong ones ([HALO-2], [HALO-3]).
    pub seed: HaloSeed,
    /// From seeds to intensities on a plane ([HALO-4], [HALO-5]).
    pub spread: HaloSpread,
    /// Colour and opacity over the intensity, in ascending order of `at`; constant beyond both ends ([HALO-6]).
    pub profile: Vec<ProfileNode>,
    /// The factor of the profile's opacities, in [0, 1].
    pub opacity: f64,
    /// Seeds and intensities below it are 0 ([HALO-6]).
    pub floor: f64,
    /// M: the planes of a group ([HALO-8]).
    pub every: i64,
    /// How the seeds of a group's planes come together.
    pub accumulate: HaloAccumulation,
    /// The emissive halos that an occlusive one tints, as their places in the list.
    pub tints: Vec<usize>,
}

/// The halo transfer function h = h_v·h_d·h_p·h_l, and the exponents of s ([HALO-2], [HALO-3]).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HaloSeed {
    /// h_v; none: 1.
    pub value: Option<SeedValue>,
    /// h_d; none: 1.
    pub direction: Option<SeedDirection>,
    /// h_p; none: 1.
    pub focus: Option<SeedFocus>,
    /// h_l: 1 for samples of these labels, else 0; none: 1.
    pub labels: Option<Vec<u32>>,
    /// a of |g|^a.
    pub gradient_exponent: f64,
    /// The factor that is large where the surface is seen from the side.
    pub side: SeedSide,
}

/// h_p = clamp₀₁(1 − (dist − inner)/falloff), of the distance to a point or a polyline.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeedFocus {
    /// A point or the vertices of a polyline, in world space; at least one.
    pub at: Vec<DVec3>,
    /// The distance up to which h_p = 1, in world units.
    pub inner: f64,
    /// The length over which it falls to 0, in world units; 0: a step.
    pub falloff: f64,
}

/// The factor of a seed that is large where a surface is seen from the side ([HALO-3]).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SeedSide {
    /// (1 − |n·v|)^b.
    Power {
        /// b.
        exponent: f64,
    },
    /// clamp₀₁(1 − |n·v|/τ), τ of [STF-7].
    Curvature {
        /// T in world units.
        thickness: f64,
    },
}

/// From seeds to intensities on a plane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HaloSpread {
    /// Whether the gradient of the seeds is spread, or the seeds themselves ([HALO-4]).
    pub from: HaloSource,
    /// N.
    pub passes: u32,
    /// δ, in [0, 1].
    pub delta: f64,
    /// q: the distance of the taps of the last pass, in rays; at least 1 ([HALO-5]).
    pub stretch: f64,
    /// Whether a 3×3 median is taken of the seeds before.
    pub median: bool,
}

impl Halos {
    /// The halos of a scene.
    pub(super) fn new(scene: &Scene, plan: &Plan, grid: &Grid, function: &Function) -> Result<Self, ShotError> {
        if halos_in_effect(scene).next().is_none() {
            return Ok(Self { list: Vec::new(), query: SampleQuery::VALUE });
        }
        let list = scene.halos.iter().enumerate().map(|(i, halo)| HaloParams::new(i, halo, scene, grid));
        Ok(Self { list: list.collect::<Result<_, _>>()?, query: query::of_seeds(scene, plan, function) })
    }
}

impl PartSeeds {
    /// The seeds of a part, by its scene; none where no halo takes it. Lengths are measured by the grid of `[volume]`.
    pub(super) fn new(scene: &Scene, plan: &Plan, grid: &Grid, function: &Function) -> Result<Option<Self>, ShotError> {
        if halos_in_effect(scene).next().is_none() {
            return Ok(None);
        }
        let list = scene.halos.iter().enumerate().map(|(i, halo)| HaloSeed::in_effect(i, halo, scene, grid));
        let list: Vec<HaloSeed> = list.collect::<Result<_, _>>()?;
        Ok(Some(Self { list, query: query::of_seeds(scene, plan, function) }))
    }
}

impl HaloParams {
    /// Halo `place` of a scene.
    fn new(place: usize, halo: &Halo, scene: &Scene, grid: &Grid) -> Result<Self, ShotError> {
        let seed = match halo.takes(&PartName::Background) {
            true => HaloSeed::in_effect(place, halo, scene, grid)?,
            false => HaloSeed::none(),
        };
        let is_tinted = |(j, other): (usize, &Halo)| {
            (other.kind == HaloKind::Emissive && halo.tints.contains(&other.name)).then_some(j)
        };
        let tints = match halo.kind {
            HaloKind::Emissive => Vec::new(),
            HaloKind::Occlusive => scene.halos.iter().enumerate().filter_map(is_tinted).collect(),
        };
        Ok(Self {
            name: halo.name.clone(),
            kind: halo.kind,
            seed,
            spread: HaloSpread::new(&halo.spread, &scene.picture),
            profile: halo.profile.clone(),
            opacity: halo.opacity,
            floor: halo.floor,
            // At most 1024.
            every: halo.every as i64,
            accumulate: halo.accumulate,
            tints,
        })
    }
}

impl HaloSeed {
    /// Whether a sample can be a seed for some value.
    pub fn can_seed(&self) -> bool {
        let is_zero = |nodes: &Vec<[f64; 2]>| nodes.iter().all(|node| node[1] <= 0.0);
        !matches!(&self.value, Some(SeedValue::Nodes(nodes)) if is_zero(nodes))
    }

    /// The seeds of a halo without an effect: 0 at every value.
    fn none() -> Self {
        Self {
            value: Some(SeedValue::Nodes(vec![[0.0, 0.0]])),
            direction: None,
            focus: None,
            labels: None,
            gradient_exponent: 0.0,
            side: SeedSide::Power { exponent: 0.0 },
        }
    }

    /// The seeds of halo `place` of a scene, if it has an effect.
    fn in_effect(place: usize, halo: &Halo, scene: &Scene, grid: &Grid) -> Result<Self, ShotError> {
        if halos_in_effect(scene).any(|(i, _)| i == place) {
            Self::new(place, halo, scene, grid)
        } else {
            Ok(Self::none())
        }
    }

    /// The seeds of halo `place` of a scene.
    fn new(place: usize, halo: &Halo, scene: &Scene, grid: &Grid) -> Result<Self, ShotError> {
        let [gradient_exponent, exponent] = halo.exponents.numbers();
        let side = match halo.seed.by {
            SeedBy::Power => SeedSide::Power { exponent },
            SeedBy::Curvature => {
                SeedSide::Curvature { thickness: world(halo.seed.thickness, grid, "halo.seed.thickness")? }
            }
        };
        let focus = halo.seed.focus.as_ref().map(|focus| {
            let FocusPoints::World(at) = &focus.points else { return Err(ShotError::FocusInPixels { halo: place }) };
            Ok(SeedFocus {
                at: at.clone(),
                inner: world(focus.inner, grid, "halo.seed.focus.inner")?,
                falloff: world(focus.falloff, grid, "halo.seed.focus.falloff")?,
            })
        });
        Ok(Self {
            value: seed_value(&halo.seed, scene)?,
            direction: halo.seed.direction,
            focus: focus.transpose()?,
            labels: halo.seed.labels.as_deref().map(|labels| ids(labels, place)).transpose()?,
            gradient_exponent,
            side,
        })
    }
}

/// A length of a halo in world units.
fn world(length: Length, grid: &Grid, key: &'static str) -> Result<f64, ShotError> {
    length.world(grid).ok_or(ShotError::Length { key })
}

/// The ids of labels.
fn ids(labels: &[LabelKey], halo: usize) -> Result<Vec<u32>, ShotError> {
    let id = |(label, key): (usize, &LabelKey)| match key {
        LabelKey::Id(id) => Ok(*id),
        LabelKey::Name(_) => Err(ShotError::LabelName { halo, label }),
    };
    labels.iter().enumerate().map(id).collect()
}

/// h_v. The opacity of a scene without `[transfer]` is that of its iso-surface: 1 inside, 0 outside.
fn seed_value(seed: &Seeding, scene: &Scene) -> Result<Option<SeedValue>, ShotError> {
    if !seed.is_by_opacity() {
        return Ok(seed.value.clone());
    }
    let Some(surface) = scene.surface.as_ref().filter(|_| scene.transfer.is_none()) else {
        return Ok(Some(SeedValue::Opacity));
    };
    let iso = iso_value(surface.iso, "surface.iso")?;
    // The later of two nodes at one value holds there. The iso-value itself is inside.
    Ok(Some(SeedValue::Nodes(match scene.volume.outside {
        Outside::Low => vec![[iso, 0.0], [iso, 1.0]],
        Outside::High => vec![[iso, 1.0], [iso.next_up(), 0.0]],
    })))
}

impl HaloSpread {
    /// Returns the guard band of [`guard`].
    pub fn guard(&self) -> usize {
        guard(self.passes, self.stretch, self.median)
    }

    /// N and q of a picture ([HALO-5]). With `reach` N falls until taps are at least a pixel apart.
    fn new(spread: &Spreading, picture: &PictureSettings) -> Self {
        let reached = |passes: u32| f64::from((1_u32 << passes) - 1);
        // A scene has at most 12 passes.
        let most = u32::try_from(spread.passes).unwrap_or(u32::MAX).min(MOST_PASSES);
        let (passes, stretch) = match spread.reach.and_then(|reach| picture.in_pixels(reach)) {
            None => (most, 1.0),
            Some(reach) => {
                let reach = reach.min(FARTHEST);
                let fits = (1..=most).rev().find(|&passes| reach >= reached(passes));
                fits.map_or((0, 1.0), |passes| (passes, reach / reached(passes)))
            }
        };
        let stretch = stretch * picture.samples.across(true) as f64;
        Self { from: spread.from, passes, delta: spread.delta, stretch, median: spread.median }
    }
}

/// Returns the distance q·2^exponent of taps, in rays; q ≥ 1. Pass i of N has the exponent N − i ([HALO-5]).
pub fn tap_distance(stretch: f64, exponent: u32) -> f64 {
    stretch.max(1.0) * (1u64 << exponent.min(63)) as f64
}

/// Returns the rays of the guard band: all that H at a ray depends on lies within it. For q = 1 these are 2^N + 1 rays, and
/// one more with the median ([HALO-4]).
pub fn guard(passes: u32, stretch: f64, median: bool) -> usize {
    let reach = |exponent: u32| tap_distance(stretch, exponent).ceil() as usize;
    let taps = (0..passes).map(reach).fold(reach(0), usize::saturating_add);
    taps.saturating_add(1 + usize::from(median))
}

/// Splits a distance t ≥ 0 of taps into whole rays and a fraction. A distance beyond `side`, the longer side of the image,
/// is `side`: both read what is beyond the border.
pub fn split_distance(t: f64, side: usize) -> (usize, f64) {
    if t < side as f64 { (t as usize, t - t.floor()) } else { (side, 0.0) }
}

/// The largest N.
const MOST_PASSES: u32 = 12;

/// A reach in pixels beyond any picture.
const FARTHEST: f64 = (1_u64 << 21) as f64;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::{Overrides, parse};
    use crate::quantity::Quantity;
    use crate::shot::{KappaSource, Shot, VolumeFacts};
    use crate::tables::SeedValue;
    use crate::view::View;
    use crate::volume::{Volume, Voxels};
    use std::path::Path;
    use std::sync::Arc;

    const REGULAR: &str = "[transfer]\nkind = \"regular\"\nnodes = [{ at = 1, color = \"red\" }]\n";

    /// The halos of a picture of 200 × 100 pixels at 254 dpi, of a volume whose smallest spacing is ½.
    fn halos(rest: &str) -> Result<Halos, ShotError> {
        let (volume, rest) = match rest.strip_prefix("[volume]\n") {
            Some(rest) => rest.split_once('\n').unwrap(),
            None => ("", rest),
        };
        let files = "file = \"a.nrrd\"\nlabels = \"l.nrrd\"\nlabel_names = \"l.csv\"\n";
        let samples = if rest.starts_with("samples") { "" } else { "samples = 1\n" };
        let picture = format!("[picture]\nsize = [200, 100]\ndpi = 254\n{samples}");
        let text = format!("drypoint = 1\n[volume]\n{files}{volume}\n{picture}{rest}");
        let mut scene = parse(&text, Path::new("s"), &Overrides::default()).unwrap_or_else(|f| panic!("{f}"));
        for halo in &mut scene.halos {
            // "liver" is label 5; no other has a name.
            let _ = halo.seed.resolve_labels(|name| (name == "liver").then_some(5));
        }
        let grid = Grid::with_spacing([9, 9, 9], [0.5, 1.0, 1.0]).unwrap();
        let view = View::new(&scene.camera, &grid, scene.picture.size).unwrap();
        let volume = Volume::new(grid.clone(), Voxels::U8(vec![0; 729]), 1.0, 0.0).unwrap();
        let transfer = scene.transfer.as_ref();
        let function = transfer.and_then(|t| Function::new(t, [0.0, 1.0], &volume, &|_| None).unwrap());
        let function = Arc::new(function.unwrap_or_else(Function::nothing));
        let facts = VolumeFacts { grid: &grid, is_integer: true };
        Shot::resolve(&scene, &Plan::new(&scene), facts, function, view).map(|shot| shot.halos)
    }

    fn regular(rest: &str) -> Halos {
        halos(&format!("{REGULAR}[[halo]]\n{rest}")).unwrap()
    }

    #[test]
    fn a_halo_that_says_nothing_has_every_default() {
        let node = |at, opacity| ProfileNode { at, rgb: [0.0; 3], opacity };
        let expected = HaloParams {
            name: "halo 0".into(),
            kind: HaloKind::Occlusive,
            seed: HaloSeed {
                value: Some(SeedValue::Opacity),
                direction: None,
                focus: None,
                labels: None,
                gradient_exponent: 0.125,
                side: SeedSide::Power { exponent: 32.0 },
            },
            spread: HaloSpread { from: HaloSource::Gradient, passes: 4, delta: 0.8, stretch: 1.0, median: false },
            profile: vec![node(0.2, 0.0), node(0.6, 0.8)],
            opacity: 1.0,
            floor: 1.0 / 255.0,
            every: 1,
            accumulate: HaloAccumulation::Max,
            tints: vec![],
        };
        assert_eq!(regular(""), Halos { list: vec![expected], query: SampleQuery::NORMAL });
        assert_eq!(halos(REGULAR).unwrap(), Halos { list: vec![], query: SampleQuery::VALUE });
    }

    /// A halo of another part has no seeds in the background, and in a part those of the part's function.
    #[test]
    fn each_part_has_the_seeds_of_its_halos() {
        let objects = "[[object]]\nname = \"a\"\nmove = [1, 0, 0]\n";
        let table = |part: &str| format!("[[halo]]\nname = \"{part}\"\nobject = \"{part}\"\nopacity = 0.5\n");
        let tables = ["a", "a ghost", "background"].map(table).concat();
        let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n{REGULAR}{tables}[[halo]]\n{objects}");
        let scene = parse(&text, Path::new("s"), &Overrides::default()).unwrap_or_else(|f| panic!("{f}"));
        let grid = Grid::with_spacing([9; 3], [1.0; 3]).unwrap();
        let can_seed = |list: &[HaloSeed]| list.iter().map(HaloSeed::can_seed).collect::<Vec<_>>();
        let function = Function::nothing();
        let main = Halos::new(&scene, &Plan::new(&scene), &grid, &function).unwrap();
        let of_background: Vec<HaloSeed> = main.list.iter().map(|halo| halo.seed.clone()).collect();
        assert_eq!(can_seed(&of_background), [false, false, true, true]);
        for ((object, role), expected) in scene.parts().zip([[true, false, false, true], [false, true, false, true]]) {
            let part = scene.of_part(object, role);
            let plan = Plan::new(&part);
            let seeds = PartSeeds::new(&part, &plan, &grid, &function).unwrap().unwrap();
            assert_eq!((can_seed(&seeds.list), seeds.query), (expected.to_vec(), SampleQuery::NORMAL));
            assert!(plan.needs_anywhere(Quantity::GradientMagnitudeRange));
        }
        let parsed = |text: &str| parse(text, Path::new("s"), &Overrides::default()).unwrap_or_else(|f| panic!("{f}"));
        let other = parsed(&text.replace("[[halo]]\n[[object]]", "[[object]]")).of_part(0, crate::tables::Role::Ghost);
        let none = parsed(&text.replace(&tables, &table("background")).replace("[[halo]]\n[[object]]", "[[object]]"));
        let none = none.of_part(0, crate::tables::Role::Ghost);
        let seeds = |part: &Scene| PartSeeds::new(part, &Plan::new(part), &grid, &function).unwrap();
        assert_eq!(
            (seeds(&other).map(|seeds| can_seed(&seeds.list)), seeds(&none)),
            (Some(vec![false, true, false]), None)
        );
    }

    /// 8 + 4 + 2 + 1 rays of taps, one of the gradient and one more; with q = 2.5 each distance is rounded up.
    #[test]
    fn guard_bands_by_hand() {
        assert_eq!([guard(4, 1.0, false), guard(4, 1.0, true), guard(0, 1.0, false)], [17, 18, 2]);
        assert_eq!(guard(3, 2.5, false), 10 + 5 + 3 + 3 + 1);
        assert_eq!([tap_distance(2.5, 2), tap_distance(0.5, 3)], [10.0, 8.0]);
        assert_eq!([split_distance(2.25, 9), split_distance(9.5, 9)], [(2, 0.25), (9, 0.0)]);
    }

    #[test]
    fn lengths_are_in_the_world_and_labels_are_ids() {
        let focus = "seed.focus = { at = [[1, 2, 3]], inner = 4, falloff = \"6 voxels\" }\n";
        let seed = regular(&format!(
            "{focus}seed.labels = [\"liver\", 7]\nseed.by = \"curvature\"\nseed.thickness = \"3 voxels\"\n"
        ));
        let HaloSeed { value, focus, labels, side, .. } = seed.list[0].seed.clone();
        assert_eq!((value, labels), (None, Some(vec![5, 7])));
        assert_eq!(focus, Some(SeedFocus { at: vec![DVec3::new(1.0, 2.0, 3.0)], inner: 4.0, falloff: 3.0 }));
        assert_eq!(side, SeedSide::Curvature { thickness: 1.5 });
        assert_eq!(seed.query, SampleQuery { kappa: KappaSource::AlongRay, ..SampleQuery::NORMAL });
        let error = |rest: &str| halos(&format!("{REGULAR}[[halo]]\n[[halo]]\n{rest}")).unwrap_err();
        assert_eq!(error("seed.labels = [1, \"lver\"]\n"), ShotError::LabelName { halo: 1, label: 1 });
        assert_eq!(error("seed.focus.pixels = [[1, 2]]\n"), ShotError::FocusInPixels { halo: 1 });
        assert_eq!(
            error("seed.focus.pixels = [[1, 2]]\n").to_string(),
            "the focus of halo 1 is given in pixels, and was not picked"
        );
    }

    /// κ is that of [contours], and along the ray without it or without κ.
    #[test]
    fn seeds_have_the_curvature_of_contours() {
        let query = |contours: &str| regular(&format!("seed.by = \"curvature\"\n{contours}")).query;
        let along = SampleQuery { kappa: KappaSource::AlongRay, ..SampleQuery::NORMAL };
        let exact = SampleQuery { hessian: true, kappa: KappaSource::Exact, ..SampleQuery::NORMAL };
        for (kappa, expected) in [("ray", along), ("exact", exact), ("none", along)] {
            assert_eq!(query(&format!("[contours]\nkappa = \"{kappa}\"\n")), expected, "{kappa}");
        }
    }

    /// By hand, of 100 rows at 10 px/mm: 30 px are 15·2, 12 px are 7·12/7, 0.5 px are none.
    #[test]
    fn a_reach_makes_the_taps_wider_and_the_passes_fewer() {
        let spread = |rest: &str| {
            let HaloSpread { passes, stretch, .. } = regular(rest).list[0].spread;
            (passes, stretch)
        };
        assert_eq!(spread("spread.reach = \"30 px\"\n"), (4, 2.0));
        assert_eq!(spread("spread.reach = \"3 mm\"\n"), (4, 2.0));
        assert_eq!(spread("spread.reach = \"30 %\"\n"), (4, 2.0));
        assert_eq!(spread("spread.reach = \"15 px\"\n"), (4, 1.0));
        assert_eq!(spread("spread.reach = \"12 px\"\n"), (3, 12.0 / 7.0));
        assert_eq!(spread("spread.reach = \"1 px\"\n"), (1, 1.0));
        assert_eq!(spread("spread.reach = \"0.5 px\"\n"), (0, 1.0));
        assert_eq!(spread("spread = { passes = 0, reach = \"9 px\" }\n"), (0, 1.0));
        assert_eq!(spread("spread.passes = 12\n"), (12, 1.0));
        let finer = |samples: &str, rest: &str| {
            let text = format!("samples = {samples}\n{REGULAR}[[halo]]\n{rest}");
            let HaloSpread { passes, stretch, .. } = halos(&text).unwrap().list[0].spread;
            (passes, stretch)
        };
        assert_eq!(finer("3", ""), (4, 3.0));
        assert_eq!(finer("3", "spread.reach = \"30 px\"\n"), (4, 6.0));
        assert_eq!(finer("3", "spread.reach = \"0.5 px\"\n"), (0, 3.0));
        assert_eq!(finer("\"auto\"", "spread.reach = \"30 px\"\n"), (4, 4.0));
    }

    /// Without [transfer] the inside of the iso-surface seeds, the iso-value included.
    #[test]
    fn a_surface_alone_seeds_by_its_inside() {
        let value =
            |rest: &str| halos(&format!("{rest}[surface]\niso = 12\n[[halo]]\n")).unwrap().list[0].seed.value.clone();
        assert_eq!(value(""), Some(SeedValue::Nodes(vec![[12.0, 0.0], [12.0, 1.0]])));
        let high = vec![[12.0, 1.0], [12f64.next_up(), 0.0]];
        assert_eq!(value("[volume]\noutside = \"high\"\n"), Some(SeedValue::Nodes(high)));
        assert_eq!(value(REGULAR), Some(SeedValue::Opacity));
        assert_eq!(halos("[surface]\n[[halo]]\n"), Err(ShotError::NoIso { key: "surface.iso" }));
    }

    #[test]
    fn tints_are_places_and_halos_without_effect_have_no_seeds() {
        let glow =
            "kind = \"emissive\"\nname = \"glow\"\n[[halo]]\ntints = [\"glow\"]\nopacity = 0\nseed.labels = [\"?\"]\n";
        let both = regular(glow);
        assert_eq!((both.list[0].accumulate, &both.list[1].tints[..]), (HaloAccumulation::Mean, &[0][..]));
        assert_eq!(both.list[1].seed, HaloSeed::none());
        assert_eq!(regular("opacity = 0\n").list, []);
        assert_eq!(halos(&format!("layers = [\"halo0\"]\n{REGULAR}[[halo]]\nopacity = 0\n")).unwrap().list.len(), 1);
    }
}
