//! The axes of an NRRD file: which of them are space, and where the voxels lie.

use super::super::error::{Fault, ReadError};
use super::super::grid_of;
use super::super::header::{Header, HeaderField};
use crate::space::Grid;
use crate::volume::Anatomy;
use glam::{DMat3, DVec3};

/// The most axes that the format allows.
const MOST_AXES: usize = 16;

/// The axes that a header describes.
pub(super) struct Axes {
    /// Samples along every axis, fastest first.
    pub(super) sizes: Vec<usize>,
    /// The anatomical space, where one is named.
    pub(super) anatomy: Option<Anatomy>,
    /// The three axes that are space.
    space: [usize; 3],
    /// One direction an axis; none: not an axis of space.
    directions: Option<Vec<Option<DVec3>>>,
    spacings: Option<Vec<f64>>,
    origin: DVec3,
}

/// Reads the fields about axes and finds the three that are space.
pub(super) fn read(header: &Header) -> Result<Axes, ReadError> {
    let field = header.need("dimension", "3")?;
    let dimension: usize = header.number(field, "a number of axes")?;
    if dimension > MOST_AXES {
        return Err(header.expected(field, "at most 16 axes"));
    }
    if dimension < 3 {
        let found = format!("data with {dimension} axes");
        return Err(header.error(field, Fault::Unsupported { found, supported: "volumes of three axes" }));
    }
    let sizes = header.need("sizes", "samples along each axis")?;
    let sizes: Vec<usize> = header.numbers(sizes, dimension, "whole numbers, one for each axis")?;
    let directions = match header.get("space directions") {
        Some(field) => Some(vectors(header, field, dimension)?),
        None => None,
    };
    let spacings = match header.get("spacings") {
        Some(field) => Some(header.numbers(field, dimension, "numbers, one for each axis")?),
        None => None,
    };
    let origin = match (header.get("space origin"), &directions) {
        (Some(field), Some(_)) => match vectors(header, field, 1)?.as_slice() {
            &[Some(origin)] => origin,
            _ => return Err(header.expected(field, "one vector (x,y,z)")),
        },
        _ => DVec3::ZERO,
    };
    let anatomy = anatomy(header, directions.is_some())?;
    let space = space_axes(header, &sizes, directions.as_deref())?;
    Ok(Axes { sizes, anatomy, space, directions, spacings, origin })
}

impl Axes {
    /// The grid of the three axes of space.
    pub(super) fn grid(&self, header: &Header) -> Result<Grid, ReadError> {
        let column = |axis: usize| {
            let along = self.space[axis];
            if let Some(directions) = &self.directions {
                // An axis of space always has a direction here: those without are left out.
                return directions[along].unwrap_or(DVec3::ZERO);
            }
            let spacing = self.spacings.as_ref().map_or(1.0, |s| s[along]);
            DVec3::AXES[axis] * if spacing.is_nan() { 1.0 } else { spacing }
        };
        let columns = DMat3::from_cols(column(0), column(1), column(2));
        let axes = if self.directions.is_some() { "space directions" } else { "spacings" };
        let dims = self.space.map(|axis| self.sizes[axis]);
        grid_of(&header.file, dims, columns, self.origin, ["sizes", axes, "space origin"])
            .map_err(|e| header.with_line(e))
    }
}

/// The anatomical space that the file names. A space of another number of axes than three is an error where directions
/// use it.
fn anatomy(header: &Header, used: bool) -> Result<Option<Anatomy>, ReadError> {
    if let Some(field) = header.get("space dimension")
        && used
        && header.number::<u32>(field, "3")? != 3
    {
        return Err(header.expected(field, "3"));
    }
    let Some(field) = header.get("space") else { return Ok(None) };
    let name = field.value.to_ascii_lowercase();
    if used && (name.ends_with("-time") || ["rast", "last", "lpst"].contains(&name.as_str())) {
        let found = format!("a space with time, {name}");
        return Err(header.error(field, Fault::Unsupported { found, supported: "a space of three axes" }));
    }
    Ok(Anatomy::ALL.into_iter().find(|a| name == a.name() || name == a.initials().to_ascii_lowercase()))
}

/// The three axes that are space. Others must have length 1, since a voxel has one value.
fn space_axes(header: &Header, sizes: &[usize], directions: Option<&[Option<DVec3>]>) -> Result<[usize; 3], ReadError> {
    let kinds: Option<(&HeaderField, Vec<&str>)> = match header.get("kinds") {
        Some(field) => {
            let words: Vec<&str> = field.value.split_whitespace().collect();
            if words.len() != sizes.len() {
                return Err(header.expected(field, &format!("{} kinds, one for each axis", sizes.len())));
            }
            Some((field, words))
        }
        None => None,
    };
    // An axis is spatial if it has a direction. Without directions its kind decides, and without kinds every axis is
    // spatial.
    let is_space = |axis: usize| match (directions, &kinds) {
        (Some(directions), _) => directions[axis].is_some(),
        (None, Some((_, kinds))) => {
            matches!(kinds[axis].to_ascii_lowercase().as_str(), "domain" | "space" | "none" | "???")
        }
        (None, None) => true,
    };
    let (mut space, other): (Vec<usize>, Vec<usize>) = (0..sizes.len()).partition(|&axis| is_space(axis));
    // The slowest axes of length 1 hold nothing that three axes do not.
    while space.len() > 3
        && let Some(extra) = space.iter().rposition(|&axis| sizes[axis] == 1)
    {
        space.remove(extra);
    }
    let unsupported = |field: &HeaderField, found: String| {
        Err(header.error(field, Fault::Unsupported { found, supported: "one number a voxel on three axes of space" }))
    };
    let sizes_field = header.need("sizes", "samples along each axis")?;
    if let Some(&axis) = other.iter().find(|&&axis| sizes[axis] != 1) {
        return match &kinds {
            Some((field, kinds)) => {
                unsupported(field, format!("axis {axis} with {} samples of kind {}", sizes[axis], kinds[axis]))
            }
            None => unsupported(sizes_field, format!("axis {axis} with {} components a voxel", sizes[axis])),
        };
    }
    match <[usize; 3]>::try_from(space) {
        Ok(space) => Ok(space),
        Err(space) if space.len() > 3 => {
            unsupported(sizes_field, format!("{} axes with more than one sample", space.len()))
        }
        Err(space) => unsupported(sizes_field, format!("{} axes of space", space.len())),
    }
}

/// `count` vectors such as `(1,0,0)`, or `none`.
fn vectors(header: &Header, field: &HeaderField, count: usize) -> Result<Vec<Option<DVec3>>, ReadError> {
    let wrong = || header.expected(field, &format!("{count} vectors (x,y,z), or none"));
    let mut vectors = Vec::new();
    let mut rest = field.value.trim_start();
    while !rest.is_empty() {
        if let Some(after) = rest.strip_prefix("none") {
            vectors.push(None);
            rest = after.trim_start();
            continue;
        }
        let (inside, after) = rest.strip_prefix('(').and_then(|r| r.split_once(')')).ok_or_else(wrong)?;
        let numbers: Vec<f64> =
            inside.split(',').map(|n| n.trim().parse()).collect::<Result<_, _>>().map_err(|_| wrong())?;
        vectors.push(Some(DVec3::from_array(numbers.try_into().map_err(|_| wrong())?)));
        rest = after.trim_start();
    }
    if vectors.len() == count { Ok(vectors) } else { Err(wrong()) }
}
