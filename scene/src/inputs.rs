//! The data that a shot names, loaded and handed to a renderer.

use crate::backdrop::Backdrop;
use crate::intersection_picture::IntersectionPicture;
use crate::mesh::TriangleMesh;
use crate::style::Style;
use crate::volume::labels::LabelVolume;
use crate::volume::{Selection, Volume};

/// The data that a shot names.
#[derive(Clone, Debug)]
pub struct Inputs<'a> {
    /// The data of `[volume]`, the first of [`Shot::objects`](crate::shot::Shot::objects).
    pub main: ObjectData<'a>,
    /// The data of the other objects, in their order.
    pub parts: Vec<ObjectData<'a>>,
    /// The memberships of each of [`Combination::selections`](crate::shot::Combination::selections) that is
    /// [`Voxels`](crate::shot::Membership::Voxels); none for the others.
    pub selections: Vec<Option<&'a Selection>>,
    /// The picture of each of [`Combination::intersections`](crate::shot::Combination::intersections); none if the
    /// intersection has no picture.
    pub pictures: Vec<Option<&'a IntersectionPicture>>,
    /// The meshes, in the order of the shot's, in the world ([VS-12]).
    pub meshes: &'a [TriangleMesh],
    /// The background.
    pub background: Backdrop<'a>,
}

/// The data of one object of a shot.
#[derive(Clone, Copy, Debug)]
pub struct ObjectData<'a> {
    /// The volume.
    pub volume: &'a Volume,
    /// The labels beside the volume, if the shot reads them ([STF-13]).
    pub labels: Option<&'a LabelVolume>,
    /// The further volume for each of the function's two quantities; none if that quantity is no further volume
    /// ([STF-4]).
    pub further: [Option<&'a Volume>; 2],
    /// The styles that the function names, in the order of [`Function::Style::names`](crate::transfer::Function::Style::names),
    /// then those that caps name, in the order of [`Clipping::styles`](crate::shot::Clipping::styles).
    pub styles: &'a [Style],
}

impl<'a> Inputs<'a> {
    /// The data of a shot without objects and meshes, before a background.
    pub fn of(main: ObjectData<'a>, background: Backdrop<'a>) -> Self {
        Self { main, parts: Vec::new(), selections: Vec::new(), pictures: Vec::new(), meshes: &[], background }
    }
}

impl<'a> ObjectData<'a> {
    /// A volume whose function and material name no further data.
    pub fn of(volume: &'a Volume) -> Self {
        Self { volume, labels: None, further: [None, None], styles: &[] }
    }
}
