//! The objects of a picture prepared for its samples ([VS-2] … [VS-4], [VS-7]).

use super::error::RenderError;
use super::lattice::{IndexRay, samples_in_box};
use super::prepare_object::{Fields, MovedGrid, prepare_object};
use super::prepared_seeds::{PreparedSeeds, can_seed_at};
use super::sample::{Camera, PreparedObject};
use crate::field::Field;
use crate::number::{Mat3, Real};
use crate::transfer::Piecewise;
use crate::volumeshop::far_side::through_box;
use crate::volumeshop::{FunnelMap, Memberships};
use drypoint_scene::clip::ClipPlanes;
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::{DAffine3, DVec3};
use drypoint_scene::inputs::{Inputs, ObjectData};
use drypoint_scene::intersection_picture::IntersectionPicture;
use drypoint_scene::shot::{
    Combination, Cutaway, Fuzzy, HaloParams, HaloSeed, Halos, Intersection, LabelLookup, Lattice, Membership, Object,
    Part, Role, SampleQuery, SelectionParams, Shot, placed,
};
use drypoint_scene::space::Grid;
use drypoint_scene::view::View;
use drypoint_scene::volume::{Anatomy, Bricks, Volume};

/// Objects ready for samples.
pub(super) struct PreparedCombination<'v, R> {
    pub(super) fuzzy: Fuzzy,
    pub(super) selections: Vec<PreparedSelection<'v, R>>,
    /// In the order of the shot's parts.
    pub(super) parts: Vec<PreparedPart<'v, R>>,
    pub(super) cutaways: Vec<PreparedCutaway>,
    pub(super) intersections: Vec<PreparedIntersection<'v>>,
    /// The part of the picture in which rays can meet the box of a selection, from the top left corner to the bottom
    /// right corner. None stands for the whole picture.
    reach: Option<[[f64; 2]; 2]>,
}

/// A selection ready for look-ups.
pub(super) struct PreparedSelection<'v, R> {
    pub(super) membership: PreparedMembership<'v, R>,
    /// The box of [VS-2], in the index space of the memberships' grid; none if nothing is selected.
    pub(super) index_box: Option<[DVec3; 2]>,
    /// The box in which there can be members.
    pub(super) members: Option<[DVec3; 2]>,
    /// The grid of the memberships at the original place.
    pub(super) here: Grid,
    /// The grid of the memberships where M moves it; none if the object is not moved.
    pub(super) there: Option<Grid>,
    /// Whether the selection is a piece of the background's volume, from which it is then removed.
    pub(super) takes: bool,
}

/// f_S ready for look-ups.
pub(super) enum PreparedMembership<'v, R> {
    /// 1 in the data's box.
    Everything,
    /// A function of the data's value.
    Value(Piecewise<R>),
    /// A selection volume.
    Voxels(Memberships<'v, R>),
}

/// A selection or a ghost ready for samples.
pub(super) struct PreparedPart<'v, R> {
    pub(super) object: PreparedObject<'v, R>,
    /// Index of its selection.
    pub(super) selection: usize,
    /// Whether the part is drawn where M moves the object.
    pub(super) is_moved: bool,
    /// Whether the part's samples are those of the background: the same volume at the same place under the same planes.
    pub(super) is_of_background: bool,
    /// The seeds of halos among the part's samples; none if no halo takes the part.
    pub(super) seeds: Option<PreparedSeeds<'v>>,
    /// The bricks of the part's volume; none if nothing is skipped.
    bricks: Option<PartBricks>,
}

/// The bricks of a part's volume in which samples are evaluated.
struct PartBricks {
    bricks: Bricks,
    /// For each brick, whether the part's function can show something in it.
    show: Vec<bool>,
    /// For each brick, whether h_v of some halo can be above 0 in it.
    seed: Vec<bool>,
}

/// A cutaway with what depends on the camera.
pub(super) struct PreparedCutaway {
    pub(super) params: Cutaway,
    /// The map of the cutaway's funnel; none for a hard cut.
    pub(super) funnel: Option<PreparedFunnel>,
}

/// The map of a funnel over the picture and the guard band of its halos. Seeds in the guard band are cut as in a larger
/// picture.
pub(super) struct PreparedFunnel {
    pub(super) map: FunnelMap,
    /// Pixels of the map across and down.
    pub(super) size: [usize; 2],
    /// Pixels of the guard band.
    pub(super) margin: usize,
}

/// An intersection ready for samples.
pub(super) struct PreparedIntersection<'v> {
    pub(super) params: Intersection,
    pub(super) picture: Option<&'v IntersectionPicture>,
}

impl<'v, R: Real> PreparedCombination<'v, R> {
    /// Prepares the objects of a shot.
    ///
    /// # Errors
    /// Data were not handed over, or a part's function or material is invalid.
    pub(super) fn new(
        (shot, combination): (&Shot, &Combination),
        inputs: &Inputs<'v>,
        camera: &Camera<'_>,
        fields: &mut Fields<'v, R>,
        counts: &mut Counts,
    ) -> Result<Self, RenderError> {
        let main = inputs.main.volume;
        if inputs.parts.len() != combination.parts.len()
            || inputs.selections.len() != combination.selections.len()
            || inputs.pictures.len() != combination.intersections.len()
        {
            return Err(RenderError::NoObjects);
        }
        let world = main.anatomy();
        let parts = shot.parts().zip(&inputs.parts).map(|((part, object), data)| {
            let motion = combination.selections[part.object].motion.filter(|_| part.role == Role::Selection);
            let data = (main, &shot.clipping.planes, data);
            PreparedPart::new((part, object, motion), &shot.halos, data, camera, fields, counts)
        });
        let parts: Result<Vec<_>, RenderError> = parts.collect();
        let parts = parts?;
        let selections = combination.selections.iter().zip(&inputs.selections).enumerate();
        let selections: Result<Vec<_>, RenderError> = selections
            .map(|(i, (params, memberships))| {
                let data = combination.parts.iter().position(|part| part.object == i);
                let data = data.map_or(main, |part| inputs.parts[part].volume);
                let (grid, membership) = match (&params.membership, memberships) {
                    (Membership::Voxels, None) => return Err(RenderError::NoObjects),
                    (Membership::Voxels, Some(selection)) => {
                        *counts.bytes.entry("selections".into()).or_default() += selection.memberships.bytes() as u64;
                        let memberships = Memberships::new(&selection.memberships);
                        (selection.grid_in(world), PreparedMembership::Voxels(memberships))
                    }
                    (Membership::Everything, _) => (grid_in(data, world), PreparedMembership::Everything),
                    (Membership::Value(pairs), _) => {
                        let [at, f] = [0, 1].map(|i| pairs.iter().map(|pair| pair[i]).collect::<Vec<_>>());
                        (grid_in(data, world), PreparedMembership::Value(Piecewise::new(&at, &f)?))
                    }
                };
                // Ranges of bricks tell where a selection by value can have members between voxels.
                let field = parts.iter().find(|part| part.selection == i).map(|part| &part.object.field);
                let by_value = matches!(params.membership, Membership::Value(_));
                let bricks = field.filter(|_| by_value).map(Field::bricks);
                let members = params.members(&grid, bricks.as_ref());
                PreparedSelection::new(params, grid, members, membership)
            })
            .collect();
        let pictures = combination.intersections.iter().zip(&inputs.pictures);
        let selections = selections?;
        Ok(Self {
            fuzzy: combination.fuzzy,
            reach: reach(&selections, camera.view),
            selections,
            parts,
            cutaways: combination.cutaways.iter().map(|&params| PreparedCutaway { params, funnel: None }).collect(),
            intersections: pictures
                .map(|(params, &picture)| PreparedIntersection { params: params.clone(), picture })
                .collect(),
        })
    }

    /// Whether the ray through a point of the picture can meet an object or a cutaway.
    pub(super) fn meets(&self, view: &View, lattice: &Lattice, point: [f64; 2]) -> bool {
        let in_funnel = |cutaway: &PreparedCutaway| cutaway.funnel.as_ref().is_some_and(|funnel| funnel.cuts(point));
        if self.cutaways.iter().any(in_funnel) {
            return true;
        }
        if self.reach.is_some_and(|[lo, hi]| (0..2).any(|a| point[a] < lo[a] || hi[a] < point[a])) {
            return false;
        }
        let pixel = view.ray(point[0], point[1]);
        let through = |grid: &Grid, ends: Option<[DVec3; 2]>| {
            let line = IndexRay::<f64>::new(&pixel, view, lattice, grid).line();
            ends.is_some_and(|ends| through_box(line, ends).is_some())
        };
        self.selections
            .iter()
            .any(|s| through(&s.here, s.members) || s.there.as_ref().is_some_and(|grid| through(grid, s.members)))
    }

    /// About how many samples the rays have in the boxes of objects, except for pieces of the background at their own
    /// place.
    pub(super) fn samples(&self, lattice: &Lattice, view: &View) -> f64 {
        let apart = self.selections.iter().filter(|selection| selection.there.is_some() || !selection.takes);
        let of = |selection: &PreparedSelection<'_, R>| {
            let grid = selection.there.as_ref().unwrap_or(&selection.here);
            selection.members.map_or(0.0, |ends| samples_in_box(lattice, view, grid, ends))
        };
        apart.map(of).sum()
    }

    /// Whether a cutaway is smooth.
    pub(super) fn has_funnel(&self) -> bool {
        self.cutaways.iter().any(|cutaway| cutaway.funnel.is_some())
    }

    /// Evaluates samples also in bricks that show and seed nothing.
    pub(super) fn skip_nothing(&mut self) {
        self.parts.iter_mut().for_each(|part| part.bricks = None);
    }

    /// Takes over the camera's data from another shot, with lengths that follow from the picture's size.
    pub(super) fn turn(&mut self, shot: &Shot, camera: &Camera<'_>) {
        for (prepared, (_, object)) in self.parts.iter_mut().zip(shot.parts()) {
            prepared.object.shader.turn(object, camera);
        }
        let cutaways = shot.combination.iter().flat_map(|combination| &combination.cutaways);
        for (prepared, &params) in self.cutaways.iter_mut().zip(cutaways) {
            prepared.params = params;
        }
        self.reach = reach(&self.selections, &shot.view);
    }
}

/// The part of a picture in which rays can meet the box of a selection. Returns none if a box reaches behind the eye.
fn reach<R>(selections: &[PreparedSelection<'_, R>], view: &View) -> Option<[[f64; 2]; 2]> {
    // Rounding stays below a pixel.
    const MARGIN: f64 = 1.0;
    let mut reach = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for selection in selections {
        let Some(ends) = selection.members else { continue };
        for grid in [Some(&selection.here), selection.there.as_ref()].into_iter().flatten() {
            for corner in 0..8 {
                let corner = DVec3::from_array(std::array::from_fn(|axis| ends[corner >> axis & 1][axis]));
                let point = view.point_of(grid.to_world(corner))?;
                reach[0] = std::array::from_fn(|a| reach[0][a].min(point[a] - MARGIN));
                reach[1] = std::array::from_fn(|a| reach[1][a].max(point[a] + MARGIN));
            }
        }
    }
    Some(reach)
}

impl PreparedFunnel {
    /// d̃ on the ray through a point of the picture. See [`FunnelMap::depth`].
    pub(super) fn depth(&self, point: [f64; 2], z_in: f64, d: f64) -> f64 {
        self.map.depth(self.pixel(point), z_in, d)
    }

    /// Whether the pixel of a point is cut.
    fn cuts(&self, point: [f64; 2]) -> bool {
        self.map.cuts(self.pixel(point))
    }

    /// The pixel of the map at a point of the picture. A point beyond the border gets the nearest pixel.
    fn pixel(&self, point: [f64; 2]) -> [usize; 2] {
        let pixel = |a: usize| (point[a].floor() as i64).saturating_add(self.margin as i64).max(0) as usize;
        [0, 1].map(|a| pixel(a).min(self.size[a] - 1))
    }
}

impl<'v, R: Real> PreparedSelection<'v, R> {
    fn new(
        params: &SelectionParams,
        here: Grid,
        members: Option<[DVec3; 2]>,
        membership: PreparedMembership<'v, R>,
    ) -> Result<Self, RenderError> {
        let there = params.motion.map(|motion| placed(&here, Some(motion)).map_err(|_| RenderError::Motion));
        Ok(Self {
            membership,
            index_box: params.index_box,
            members,
            there: there.transpose()?,
            here,
            takes: !params.has_own_volume,
        })
    }
}

impl<'v, R: Real> PreparedPart<'v, R> {
    fn new(
        (part, object, motion): (&Part, &Object, Option<DAffine3>),
        halos: &Halos,
        (main, planes, data): (&Volume, &ClipPlanes, &ObjectData<'v>),
        camera: &Camera<'_>,
        fields: &mut Fields<'v, R>,
        counts: &mut Counts,
    ) -> Result<Self, RenderError> {
        let volume = data.volume;
        let is_of_background = std::ptr::eq(volume, main) && motion.is_none() && part.clipping.planes == *planes;
        let grid = placed(&grid_in(volume, main.anatomy()), motion).map_err(|_| RenderError::Motion)?;
        // L_T maps vectors of the picture's world to those of the data's.
        let to_data = volume.grid().axes() * grid.inverse_axes();
        let moved = (grid.axes() != volume.grid().axes()).then(|| Mat3::from_glam(to_data.transpose()));
        let field = fields.of(volume, object)?;
        let bricks = object.skip_empty.then(|| PartBricks::new(&field, (part, object)));
        let place = MovedGrid { grid, moved };
        let prepared = prepare_object((object, &part.clipping), data, place, field, camera, fields, counts)?;
        let is_moved = motion.is_some();
        let of_alpha = prepared.over_two.as_ref().map(|over_two| over_two.first);
        let seeds = seeds_of(part, halos, data, (object.label_lookup, of_alpha))?;
        Ok(Self { object: prepared, selection: part.object, is_moved, is_of_background, seeds, bricks })
    }

    /// Whether a sample in a cell of the part's volume can show something.
    #[inline]
    pub(super) fn can_show(&self, cell: [usize; 3]) -> bool {
        self.bricks.as_ref().is_none_or(|own| own.show[own.bricks.of_cell(cell)])
    }

    /// Whether a sample in a cell of the part's volume can seed a halo.
    #[inline]
    pub(super) fn can_seed(&self, cell: [usize; 3]) -> bool {
        self.bricks.as_ref().is_none_or(|own| own.seed[own.bricks.of_cell(cell)])
    }
}

impl PartBricks {
    /// Tests the bricks of a part's field.
    fn new<R: Real>(field: &Field<'_, R>, (part, object): (&Part, &Object)) -> Self {
        let (bricks, function) = (field.bricks(), &object.function);
        let rounded = |at| R::from_f64(at).to_f64();
        let can_show = |&range| function.can_be_visible(range, None, rounded);
        let seeds = part.seeds.as_ref().map_or(&[][..], |seeds| &seeds.list);
        let can_seed = |&range| seeds.iter().any(|seed| can_seed_at(seed, function, range, rounded));
        let show = bricks.ranges.iter().map(can_show).collect();
        let seed = bricks.ranges.iter().map(can_seed).collect();
        Self { bricks, show, seed }
    }
}

/// The seeds of halos among the samples of a part. Returns none if no halo takes the part.
fn seeds_of<'v>(
    part: &Part,
    halos: &Halos,
    data: &ObjectData<'v>,
    (label_lookup, of_alpha): (LabelLookup, Option<SampleQuery>),
) -> Result<Option<PreparedSeeds<'v>>, RenderError> {
    let Some(own) = part.seeds.as_ref().filter(|own| own.list.iter().any(HaloSeed::can_seed)) else { return Ok(None) };
    let with = |(halo, seed): (&HaloParams, &HaloSeed)| HaloParams { seed: seed.clone(), ..halo.clone() };
    let list: Vec<HaloParams> = halos.list.iter().zip(&own.list).map(with).collect();
    PreparedSeeds::new((&list, own.query), data, label_lookup, of_alpha).map(Some)
}

/// The grid of a volume in a world of the anatomical directions `world` ([SPACE-2]).
fn grid_in(volume: &Volume, world: Option<Anatomy>) -> Grid {
    Anatomy::between(volume.grid(), volume.anatomy(), world)
}
