//! Phantoms with known truth ([IO-4]): volumes made by formulas, each with its exact derivatives beside it.
//!
//! A phantom is centred on its grid's box, and its axes are the world's. Its parameters have the letters of its
//! formula, and defaults that fit the box. In the parameters' descriptions, L is the box's smallest side.
//!
//! - **Distance phantoms** have as value the distance to the surface, positive inside, in world units. With an edge
//!   width w > 0 the value is high / (1 + e^(−d/w)) instead, as a scanner would see it; derivatives follow by the
//!   chain rule. Integer voxel types have w = 1 voxel unless it is given, so that 0…255 is used well.
//! - **All others** have a natural range, which the parameter `high` (default 255) sets.
//!
//! At a kink of a field (the medial surface of a box, the centre of a sphere), gradient and Hessian are those of one
//! side, or 0.
//!
//! ```
//! use drypoint_scene::{phantom, space::Grid};
//! let grid = Grid::with_spacing([64; 3], [1.0; 3])?;
//! let torus = phantom::by_name("torus", &grid, &[("R".into(), 20.0), ("r".into(), 8.0)])?;
//! let outermost = grid.centre() + 28.0 * drypoint_scene::glam::DVec3::X;
//! assert!(torus.value(outermost).abs() < 1e-12);
//! let [k1, k2] = torus.curvatures(outermost).unwrap();
//! assert!((k1 - 1.0 / 8.0).abs() < 1e-12 && (k2 - 1.0 / 28.0).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod constant;
mod curvature;
mod cylinder;
mod ellipsoid;
mod error;
mod hydrogen;
mod jet;
mod machined_part;
mod marschner_lobb;
mod monkey_saddle;
mod noise;
mod params;
mod placed;
mod plane;
mod saddle;
mod sample;
mod shells;
mod shepp_logan;
mod source;
mod specimen;
mod sphere;
#[cfg(test)]
mod tests;
mod torus;
mod tube_tree;
mod white_noise;

pub use curvature::curvatures;
pub use error::PhantomError;
pub use jet::Jet;
pub use params::{About, Allowed, Param, Preset};
pub use sample::{from_fn, generate, generate_part, sample, sample_labels};
pub use source::PhantomSource;

use crate::space::Grid;
use crate::volume::VoxelType;
use glam::{DMat3, DVec3};

/// A field that is known at every point of the world, with its derivatives.
pub trait Phantom: Send + Sync {
    /// The value at a point in world space.
    fn value(&self, p: DVec3) -> f64;

    /// Value, gradient and Hessian at a point. Derivatives are in value per world unit and per square of a world unit.
    fn jet(&self, p: DVec3) -> Jet;

    /// The label at a point; 0 is none.
    fn label(&self, p: DVec3) -> u16;

    /// The gradient at a point, in value per world unit.
    fn gradient(&self, p: DVec3) -> DVec3 {
        self.jet(p).gradient
    }

    /// The Hessian at a point, in value per square of the world unit.
    fn hessian(&self, p: DVec3) -> DMat3 {
        self.jet(p).hessian
    }

    /// κ₁ ≥ κ₂ of the iso-surface through the point ([CUR-1]); none where the gradient is 0.
    fn curvatures(&self, p: DVec3) -> Option<[f64; 2]> {
        let jet = self.jet(p);
        curvatures(jet.gradient, jet.hessian)
    }
}

/// Every phantom.
const ALL: &[About] = &[
    sphere::SPHERE,
    ellipsoid::ELLIPSOID,
    torus::TORUS,
    cylinder::CYLINDER,
    plane::PLANE,
    saddle::SADDLE,
    monkey_saddle::MONKEY_SADDLE,
    marschner_lobb::MARSCHNER_LOBB,
    hydrogen::HYDROGEN,
    shepp_logan::SHEPP_LOGAN,
    shells::SHELLS,
    tube_tree::TUBE_TREE,
    machined_part::MACHINED_PART,
    noise::NOISE,
    white_noise::WHITE_NOISE,
    constant::CONSTANT,
    specimen::SPECIMEN,
];

/// Every phantom: name, one line of description, parameters.
pub fn describe() -> &'static [About] {
    ALL
}

/// The names of all phantoms.
pub fn names() -> Vec<&'static str> {
    ALL.iter().map(|about| about.name).collect()
}

/// The phantom of that name on a grid, with the defaults of floating-point voxels.
///
/// # Errors
/// An unknown name or parameter, or a value that is not allowed; the error says what is allowed.
pub fn by_name(name: &str, grid: &Grid, params: &[(String, f64)]) -> Result<Box<dyn Phantom>, PhantomError> {
    for_type(name, grid, VoxelType::F64, params)
}

/// Like [`by_name`], with the defaults of a voxel type.
///
/// # Errors
/// See [`by_name`].
pub fn for_type(
    name: &str,
    grid: &Grid,
    voxel_type: VoxelType,
    params: &[(String, f64)],
) -> Result<Box<dyn Phantom>, PhantomError> {
    let about = ALL.iter().find(|about| about.name == name).ok_or_else(|| {
        let known = names();
        PhantomError::UnknownName {
            name: name.to_owned(),
            nearest: crate::nearest::nearest(name, known.iter().copied()),
            known,
        }
    })?;
    let args = params::Args::new(about, grid, voxel_type, params)?;
    (about.build)(&args).map_err(|fault| PhantomError::Together { phantom: about.name, fault })
}

/// The phantom that a scene names, and its grid, whose voxel (0, 0, 0) lies at the world's origin.
///
/// # Errors
/// The errors of [`by_name`], and a grid that is not possible.
pub fn of_source(source: &PhantomSource) -> Result<(Box<dyn Phantom>, Grid), PhantomError> {
    let grid = Grid::with_spacing(source.size, source.spacing)?;
    Ok((for_type(&source.name, &grid, source.voxel_type, &source.params)?, grid))
}
