//! Objects within the shader of their picture ([VS-2]). Each part is a shader of its own, attached to the picture's.

use super::{camera as camera_of, of_volume};
use crate::block::ParamBlock;
use crate::field::Scales;
use crate::place::GridPlacement;
use crate::shader::{Data, Shader};
use crate::volumeshop::objects::{self, DrawnPart};
use crate::{CardInputs, GpuError, Precision, ray, volumeshop};
use drypoint_scene::glam::DVec3;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::shot::{Combination, Cut, HaloSeed, Membership, Object, Part, Role, Shot, placed};
use drypoint_scene::space::Grid;
use drypoint_scene::volume::Anatomy;

/// Places of the parts of a shot. Parts whose selection has no members are left out.
#[derive(Default)]
pub(crate) struct PlacesOfObjects(Vec<PlacedPart>);

struct PlacedPart {
    /// Index of the part in the shot.
    part: usize,
    /// Place of the part's data.
    place: GridPlacement,
    /// Place of the memberships of the part's selection. Its box is the one in which there can be members.
    selection: GridPlacement,
}

impl PlacesOfObjects {
    /// The corners of the boxes of their data.
    pub(crate) fn corners(&self) -> impl Iterator<Item = DVec3> {
        self.0.iter().flat_map(|placed| placed.place.grid.world_corners())
    }

    /// The objects of a shot that are drawn, the background first.
    pub(crate) fn drawn<'s>(&'s self, shot: &'s Shot) -> impl Iterator<Item = &'s Object> {
        std::iter::once(shot.background()).chain(self.0.iter().map(|placed| &shot.objects[placed.part + 1]))
    }

    pub(crate) fn new(shot: &Shot, inputs: &CardInputs<'_>) -> Result<Self, GpuError> {
        let (Some(combination), given) = (&shot.combination, inputs.data) else { return Ok(Self::default()) };
        if given.parts.len() != combination.parts.len()
            || given.selections.len() != combination.selections.len()
            || given.pictures.len() != combination.intersections.len()
        {
            return Err(GpuError::Material);
        }
        let own = GridPlacement::own(shot, given.main.volume.grid());
        let placed = combination.parts.iter().enumerate().filter_map(|(i, part)| {
            let has_members = volumeshop::has_members(&combination.selections[part.object]);
            has_members.then(|| PlacedPart::new((i, part), combination, inputs, &own))
        });
        Ok(Self(placed.collect::<Result<_, _>>()?))
    }
}

impl PlacedPart {
    fn new(
        (i, part): (usize, &Part),
        combination: &Combination,
        inputs: &CardInputs<'_>,
        own: &GridPlacement,
    ) -> Result<Self, GpuError> {
        let of_part = inputs.object(i + 1)?;
        let (world, data) = (inputs.data.main.volume.anatomy(), of_part.data.volume);
        let selection = &combination.selections[part.object];
        let motion = selection.motion.filter(|_| part.role == Role::Selection);
        let moved = |grid: &Grid| placed(grid, motion).map_err(|_| GpuError::Material);
        let of_data = Anatomy::between(data.grid(), data.anatomy(), world);
        let memberships = match (&selection.membership, inputs.data.selections[part.object]) {
            (Membership::Voxels, None) => return Err(GpuError::Material),
            (Membership::Voxels, Some(selection)) => moved(&selection.grid_in(world))?,
            (Membership::Everything | Membership::Value(_), _) => moved(&of_data)?,
        };
        let axes = memberships.axes();
        let in_data = own.beside(memberships, axes);
        let bricks = of_part.measured.bricks.as_ref();
        let index_box = selection.members(&in_data.grid, bricks).unwrap_or(in_data.index_box);
        Ok(Self {
            part: i,
            place: own.beside(moved(&of_data)?, data.grid().axes()),
            selection: GridPlacement { index_box, ..in_data },
        })
    }

    /// The suffix of a part's names in the picture's shader.
    fn suffix(&self) -> String {
        objects::suffix(self.part)
    }
}

/// The suffix of a selection's names in the shader of a part.
const OF_SELECTION: &str = "_of_selection";

/// Adds the objects of a shot, after everything else.
pub(super) fn add(
    shader: &mut Shader,
    shot: &Shot,
    inputs: &CardInputs<'_>,
    scales: &Scales,
    precision: Precision,
) -> Result<(), GpuError> {
    let Some(combination) = &shot.combination else { return Ok(()) };
    let places = PlacesOfObjects::new(shot, inputs)?;
    let (mut drawn, mut shaders) = (Vec::new(), Vec::new());
    for placed in &places.0 {
        let (part, which) = (&combination.parts[placed.part], placed.part + 1);
        let of_part = inputs.object(which)?;
        let selection = &combination.selections[part.object];
        let is_moved = selection.motion.is_some() && part.role == Role::Selection;
        let takes = !selection.has_own_volume && !is_moved;
        let part_shot = shot_of(shot, placed.part, part);
        let seeds = !part_shot.halos.list.is_empty();
        let (mut of_this, scales_of_part) = of_volume(
            (&part_shot, &[LayerKind::Beauty], true),
            (inputs, which),
            &placed.place,
            precision,
            shader.interpolation,
        )?;
        let has_last_member =
            combination.cutaways.iter().any(|cutaway| cutaway.part == placed.part && cutaway.cut == Cut::Object);
        // The selection's rays, box and memberships.
        let mut of_selection = Shader { interpolation: shader.interpolation, ..Shader::default() };
        ray::add_lattice(&mut of_selection, &part_shot, &placed.selection)?;
        volumeshop::selection::add(&mut of_selection, selection, inputs.data.selections[part.object], &scales_of_part);
        let is_of_volume = std::ptr::eq(of_part.data.volume, inputs.data.main.volume) && !is_moved;
        // On a cut of one alone their samples differ.
        let is_of_volume = is_of_volume && part.clipping.planes == shot.clipping.planes;
        volumeshop::part::add(
            &mut of_this,
            selection,
            is_of_volume,
            takes,
            (has_last_member, seeds),
            [&scales_of_part, scales],
        );
        of_this.attach(of_selection, precision, OF_SELECTION, volumeshop::selection::NAMES, true);
        for (_, _, data) in &mut of_this.data {
            if let Data::Numbers(place) | Data::Voxels(place) | Data::Smoothed(place) = data {
                *place = of_part.place;
            }
        }
        drawn.push(DrawnPart {
            part: placed.part,
            takes,
            seeds,
            is_ghost: part.role == Role::Ghost,
            scales: scales_of_part,
        });
        shaders.push((of_this, placed.suffix()));
    }
    objects::add(shader, combination, &inputs.data.pictures, &drawn, (shot, scales), precision);
    for (of_this, suffix) in shaders {
        shader.attach(of_this, precision, &suffix, volumeshop::part::NAMES, false);
    }
    Ok(())
}

/// The numbers of objects that depend on the camera. `own` is the place of the picture's volume.
pub(crate) fn camera(shot: &Shot, places: &PlacesOfObjects, own: &GridPlacement) -> Result<ParamBlock, GpuError> {
    let mut block = ParamBlock::default();
    let Some(combination) = &shot.combination else { return Ok(block) };
    for placed in &places.0 {
        let part_shot = shot_of(shot, placed.part, &combination.parts[placed.part]);
        let mut of_selection = ParamBlock::default();
        // Planes are counted from the volume as this camera sees it.
        let seen = |place: &GridPlacement| GridPlacement { anchor: own.anchor, ..place.clone() };
        ray::add_view(&mut of_selection, &part_shot, &seen(&placed.selection))?;
        let mut of_part = camera_of(&part_shot, &seen(&placed.place))?;
        of_part.append(&of_selection, OF_SELECTION);
        block.append(&of_part, &placed.suffix());
    }
    Ok(block)
}

/// A part as a separate shot.
fn shot_of(shot: &Shot, place: usize, part: &Part) -> Shot {
    let mut of_part = Shot {
        objects: vec![shot.objects[place + 1].clone()],
        clipping: part.clipping.clone(),
        combination: None,
        surface: None,
        meshes: Vec::new(),
        refine_above: None,
        layers: vec![LayerKind::Beauty],
        view: shot.view.clone(),
        lattice: shot.lattice,
        rays_across: shot.rays_across,
        number: shot.number,
        halos: shot.halos.clone(),
        blend_space: shot.blend_space,
        background: shot.background.clone(),
        stop_at: shot.stop_at,
    };
    // Its seeds are its own; a part of which no halo takes any has no halo.
    match part.seeds.as_ref().filter(|own| own.list.iter().any(HaloSeed::can_seed)) {
        Some(own) => {
            of_part.halos.query = own.query;
            for (halo, seed) in of_part.halos.list.iter_mut().zip(&own.list) {
                halo.seed = seed.clone();
            }
        }
        None => of_part.halos.list.clear(),
    }
    of_part
}
