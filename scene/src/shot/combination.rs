//! The combination of objects in a picture: selections, ghosts, cutaways and intersections ([VS-2] … [VS-4], [VS-7]).

use super::{Clipping, Object, PartSeeds, Shot, ShotError, VolumeFacts};
use crate::plan::Plan;
use crate::space::Grid;
use crate::tables::{
    Cut, Dab, Fuzzy, IntersectionColor, IntersectionOpacity, IntersectionTable, ObjectTable, Opposite, Role, Scene,
};
use crate::transfer::Function;
use crate::volume::{BRICK, Bricks};
use glam::{DAffine3, DVec3};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The most steps across an object, whose samples are all asked: more than ten of the largest volumes have at the default
/// step. A ray through so many takes about a hundredth of a second.
pub const MOST_STEPS: f64 = 1e5;

/// Objects that are drawn with the background, which is the shot's own object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Combination {
    /// The operators of fuzzy sets ([VS-3]).
    pub fuzzy: Fuzzy,
    /// The selections of the objects, in their order.
    pub selections: Vec<SelectionParams>,
    /// Selections and ghosts, in the order of the objects; a selection stands before its ghost.
    pub parts: Vec<Part>,
    /// Cutaways of the background ([VS-7]).
    pub cutaways: Vec<Cutaway>,
    /// The looks of places where a selection meets something ([VS-4]).
    pub intersections: Vec<Intersection>,
}

/// The selection of an object: f_S, and where M moves it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SelectionParams {
    /// f_S.
    pub membership: Membership,
    /// The box of [VS-2] in the index space of the memberships' grid; none: nothing is selected.
    pub index_box: Option<[DVec3; 2]>,
    /// M, from the original place to the selection's; none: the object is not moved.
    pub motion: Option<DAffine3>,
    /// Whether the object has data of its own. Then it takes nothing from the background.
    pub has_own_volume: bool,
}

/// f_S of an object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Membership {
    /// 1 in the box of the object's data.
    Everything,
    /// A piecewise-linear function of the data's value, as pairs; 0 outside the data's box.
    Value(Vec<[f64; 2]>),
    /// A selection volume, which the renderer is handed: trilinear, 0 outside its box.
    Voxels,
}

/// A selection or a ghost as it is drawn. The part at place i of [`Combination::parts`] is at place i + 1 of
/// [`Shot::objects`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// The place of its `[[object]]` in the scene, and of its selection in [`Combination::selections`].
    pub object: usize,
    /// The name of its `[[object]]`.
    pub name: String,
    /// Whether it is the selection or the ghost.
    pub role: Role,
    /// The planes that cut it, in the index space of its data where it is drawn.
    pub clipping: Clipping,
    /// The seeds of halos among its samples; none: no halo takes any.
    pub seeds: Option<PartSeeds>,
}

/// A cutaway: the background before a part fades ([VS-7]).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cutaway {
    /// The place of the part among [`Combination::parts`].
    pub part: usize,
    /// γ, above 0.
    pub ghosting: f64,
    /// How d is found.
    pub cut: Cut,
    /// σ of the funnel in pixels; 0: a hard cut.
    pub funnel: f64,
}

/// The look of a place where a selection meets its ghost or the background.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Intersection {
    /// The place of its table in the scene.
    pub table: usize,
    /// The place of the selection among [`Combination::parts`].
    pub selection: usize,
    /// The place of the ghost; none: the background.
    pub ghost: Option<usize>,
    /// Its colour.
    pub color: IntersectionPaint,
    /// Its opacity of both opacities.
    pub opacity: IntersectionOpacity,
    /// Whether both opacities are exchanged.
    pub swap: bool,
    /// Dabs over this colour and opacity, in their order.
    pub dabs: Vec<Dab>,
}

/// The colour of an intersection.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum IntersectionPaint {
    /// The mean of both colours by their opacities.
    Mean,
    /// A linear straight colour, and the factor of the opacity.
    Color([f64; 3], f64),
    /// A picture, which the renderer is handed, over the value at p and that at T p: the ranges that its columns and its rows
    /// stand for ([VAL-1]).
    Picture([[f64; 2]; 2]),
}

/// Facts that a part's shot depends on.
#[derive(Clone, Debug)]
pub struct PartFacts<'a> {
    /// The scene of the part ([`Scene::of_part`]).
    pub scene: &'a Scene,
    /// Its plan.
    pub plan: &'a Plan,
    /// Its transfer function.
    pub function: Arc<Function>,
    /// The grid of its data in the picture's world.
    pub grid: &'a Grid,
    /// Whether its file holds integers.
    pub is_integer: bool,
    /// The range of its values ([VAL-1]).
    pub range: [f64; 2],
}

/// Facts of a selection that only data can tell.
#[derive(Clone, Debug)]
pub struct SelectionFacts {
    /// The grid of its memberships in the picture's world.
    pub grid: Grid,
    /// The box of [VS-2] in its index space; none: nothing is selected.
    pub index_box: Option<[DVec3; 2]>,
}

impl SelectionFacts {
    /// The centre of the box, or of the grid if nothing is selected, in world space.
    pub fn centre(&self) -> DVec3 {
        let [lo, hi] = self.index_box.unwrap_or_else(|| self.grid.index_box());
        self.grid.to_world((lo + hi) * 0.5)
    }

    /// The corners of the box, or of the grid if nothing is selected, in world space, x fastest.
    pub fn corners(&self) -> [DVec3; 8] {
        self.grid.corners_of(self.index_box.unwrap_or_else(|| self.grid.index_box()))
    }
}

impl Shot {
    /// Adds the objects of a scene: the facts of their selections, in their order, and of their parts, in that of
    /// [`Scene::parts`]. `range` is that of `[volume]` ([VAL-1]).
    ///
    /// # Errors
    /// See [`Shot::resolve`], of a part; an object of more than [`MOST_STEPS`] steps across.
    pub fn with_objects(
        mut self,
        scene: &Scene,
        main: VolumeFacts<'_>,
        range: [f64; 2],
        selections: &[SelectionFacts],
        facts: &[PartFacts<'_>],
    ) -> Result<Self, ShotError> {
        let described: Vec<SelectionParams> =
            scene.objects.iter().zip(selections).map(|(table, facts)| SelectionParams::new(table, facts)).collect();
        // Every sample in the box of a selection is asked, so that the number of steps across it is bounded.
        for (object, (params, facts)) in described.iter().zip(selections).enumerate() {
            let steps = params.steps_across(facts, self.lattice.step)?;
            if steps > MOST_STEPS {
                return Err(ShotError::ObjectTooLarge { object, steps });
            }
        }
        let places: Vec<(usize, Role)> = scene.parts().collect();
        let mut parts = Vec::new();
        for (&(object, role), facts) in places.iter().zip(facts) {
            let of_data = VolumeFacts { grid: main.grid, is_integer: facts.is_integer };
            let drawn = Object::resolve(facts.scene, facts.plan, of_data, facts.function.clone(), &self.view)?;
            let motion = described[object].motion.filter(|_| role == Role::Selection);
            let clipping = Clipping::of_part(facts.scene, main.grid, &placed(facts.grid, motion)?);
            let seeds = PartSeeds::new(facts.scene, facts.plan, main.grid, &drawn.function)?;
            let name = scene.objects[object].name.clone();
            parts.push(Part { object, name, role, clipping, seeds });
            self.objects.push(drawn);
        }
        let place = |object: usize, role: Role| places.iter().position(|&part| part == (object, role));
        let cutaways = scene.objects.iter().enumerate().flat_map(|(i, table)| {
            let sigma = table.funnel.map_or(0.0, |length| scene.picture.in_pixels(length).unwrap_or(0.0));
            let of = move |role, ghosting| (i, role, ghosting, table.cut, sigma);
            [of(Role::Selection, table.ghosting), of(Role::Ghost, table.ghosting_of_ghost)]
        });
        let cutaways = cutaways.filter_map(|(object, role, ghosting, cut, funnel)| {
            let part = place(object, role).filter(|_| ghosting > 0.0)?;
            Some(Cutaway { part, ghosting, cut, funnel })
        });
        let cutaways = cutaways.collect();
        let intersection = |(place_of_table, table): (usize, &IntersectionTable)| {
            let object = scene.objects.iter().position(|object| object.name == table.object)?;
            let (selection, params) = (place(object, Role::Selection)?, &described[object]);
            let ghost = match table.with {
                Opposite::Ghost => Some(place(object, Role::Ghost)?),
                // The selection of an object that is not moved is a piece of the background.
                Opposite::Background if params.motion.is_none() && !params.has_own_volume => return None,
                Opposite::Background => None,
            };
            let here = if ghost.is_some() { facts[selection].range } else { range };
            let color = match table.color {
                IntersectionColor::Mean => IntersectionPaint::Mean,
                IntersectionColor::Color([r, g, b, opacity]) => IntersectionPaint::Color([r, g, b], opacity),
                IntersectionColor::Picture(_) => IntersectionPaint::Picture([here, facts[selection].range]),
            };
            Some(Intersection {
                table: place_of_table,
                selection,
                ghost,
                color,
                opacity: table.opacity,
                swap: table.swap,
                dabs: table.dabs.clone(),
            })
        };
        let combination = Combination {
            fuzzy: scene.combine.map_or(Fuzzy::Zadeh, |table| table.fuzzy),
            parts,
            cutaways,
            intersections: scene.intersections.iter().enumerate().filter_map(intersection).collect(),
            selections: described,
        };
        self.combination = Some(combination);
        Ok(self)
    }
}

impl SelectionParams {
    fn new(table: &ObjectTable, facts: &SelectionFacts) -> Self {
        Self {
            membership: match &table.value {
                Some(pairs) => Membership::Value(pairs.clone()),
                None if table.selection.is_none() && table.label.is_none() && table.strokes.is_none() => {
                    Membership::Everything
                }
                None => Membership::Voxels,
            },
            index_box: facts.index_box,
            motion: table.motion.is_moved().then(|| table.motion.map(facts.centre())),
            has_own_volume: table.volume.is_some(),
        }
    }
}

impl SelectionParams {
    /// Returns the diagonal of the box of the selection, or of its data, where M moves it, in steps.
    fn steps_across(&self, facts: &SelectionFacts, step: f64) -> Result<f64, ShotError> {
        let placed = placed(&facts.grid, self.motion)?;
        let [lo, hi] = self.index_box.unwrap_or_else(|| placed.index_box());
        let sides = (hi - lo).to_array();
        let columns = [placed.axes().x_axis, placed.axes().y_axis, placed.axes().z_axis];
        // A sheared box has diagonals of four lengths.
        let diagonals = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]]
            .map(|[y, z]| (columns[0] * sides[0] + columns[1] * (y * sides[1]) + columns[2] * (z * sides[2])).length());
        Ok(diagonals.into_iter().fold(0.0, f64::max) / step)
    }
}

impl SelectionParams {
    /// The box in which there can be members, in the index space of the memberships' grid; none: nowhere. Of a selection by
    /// value that is a box about the bricks whose range has members, as values between voxels count, too; without `bricks`,
    /// which are those of the data's cells, it is the grid's.
    pub fn members(&self, grid: &Grid, bricks: Option<&Bricks>) -> Option<[DVec3; 2]> {
        let Membership::Value(pairs) = &self.membership else { return self.index_box };
        let [low, high] = grid.index_box();
        let Some(bricks) = bricks else { return Some([low, high]) };
        let [nx, ny, _] = bricks.dims;
        let among = bricks.ranges.iter().enumerate().filter(|(_, range)| has_members(pairs, **range));
        let corners = among.map(|(i, _)| {
            let first = DVec3::from_array([i % nx, i / nx % ny, i / (nx * ny)].map(|n| (n * BRICK) as f64));
            [first, first + BRICK as f64]
        });
        let around = corners.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
        // An axis of one voxel reaches half a voxel each way.
        let flat = (high - low).cmpeq(DVec3::ONE) & low.cmplt(DVec3::ZERO);
        let inside = around.map(|corner| corner.clamp(low, high));
        Some([DVec3::select(flat, low, inside[0]), DVec3::select(flat, high, inside[1])])
    }
}

/// Whether a piecewise-linear function is above 0 at a value of a range, or at its border.
fn has_members(pairs: &[[f64; 2]], [lo, hi]: [f64; 2]) -> bool {
    pairs.iter().enumerate().filter(|(_, pair)| pair[1] > 0.0).any(|(i, _)| {
        let before = i.checked_sub(1).map_or(f64::NEG_INFINITY, |i| pairs[i][0]);
        let after = pairs.get(i + 1).map_or(f64::INFINITY, |pair| pair[0]);
        before <= hi && lo <= after
    })
}

/// A grid where a motion puts it.
///
/// # Errors
/// A motion that moves it out of the range of numbers.
pub fn placed(grid: &Grid, motion: Option<DAffine3>) -> Result<Grid, ShotError> {
    let Some(motion) = motion else { return Ok(grid.clone()) };
    let (axes, origin) = (motion.matrix3 * grid.axes(), motion.transform_point3(grid.origin()));
    Grid::new(grid.dims(), axes, origin).map_err(|_| ShotError::Motion)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Members between voxels are in the box of the bricks that have such values; a function that is 0 has none.
    #[test]
    fn members_by_value_are_where_bricks_have_them() {
        let grid = Grid::with_spacing([9, 5, 1], [1.0; 3]).unwrap();
        let bricks = Bricks::new([9, 5, 1], &|_| vec![[0.0, 10.0], [10.0, 20.0]]);
        let members = |pairs: &[[f64; 2]], bricks| {
            let membership = Membership::Value(pairs.to_vec());
            let params = SelectionParams { membership, index_box: None, motion: None, has_own_volume: false };
            params.members(&grid, bricks)
        };
        let high = [[12.3, 0.0], [12.4, 1.0], [12.5, 0.0]];
        assert_eq!(members(&high, Some(&bricks)), Some([DVec3::new(4.0, 0.0, -0.5), DVec3::new(8.0, 4.0, 0.5)]));
        assert_eq!(members(&[[11.0, 1.0], [30.0, 0.0]], Some(&bricks)), Some(grid.index_box()));
        assert_eq!(members(&[[0.0, 0.0], [9.0, 0.0]], Some(&bricks)), None);
        assert_eq!(members(&high, None), Some(grid.index_box()));
    }

    /// A box of 4 × 2 × 0 voxels has a diagonal of √20, ten steps a unit.
    #[test]
    fn steps_across_a_selection_by_hand() {
        let grid = Grid::with_spacing([9, 5, 3], [1.0; 3]).unwrap();
        let index_box = Some([DVec3::new(1.0, 1.0, 2.0), DVec3::new(5.0, 3.0, 2.0)]);
        let facts = SelectionFacts { grid, index_box };
        let of = |motion, index_box| {
            let membership = Membership::Voxels;
            SelectionParams { membership, index_box, motion, has_own_volume: false }.steps_across(&facts, 0.1).unwrap()
        };
        let twice = Some(DAffine3::from_scale(DVec3::splat(2.0)));
        assert!((of(None, index_box) - 10.0 * 20f64.sqrt()).abs() < 1e-12);
        assert!((of(twice, index_box) - 20.0 * 20f64.sqrt()).abs() < 1e-12);
        // Without a box it is that of the grid: 8 × 4 × 2.
        assert!((of(None, None) - 10.0 * 84f64.sqrt()).abs() < 1e-12);
        // Sheared by as much as x is long, one diagonal grows to (12, 4, 2).
        let mut sheared = DAffine3::IDENTITY;
        sheared.matrix3.y_axis.x = 1.0;
        assert!((of(Some(sheared), None) - 10.0 * (144.0f64 + 16.0 + 4.0).sqrt()).abs() < 1e-12);
    }
}
