//! A picture for a volume of which nothing is said: which values to show, from where, in which style.
//!
//! Nothing here is a paper's. The choices are meant for a first look and stand in the scene that they make, so that they
//! can be changed.

mod boundary;
mod framing;

use boundary::Boundary;
use drypoint_scene::color;
use drypoint_scene::glam::DVec3;
use drypoint_scene::tables::{
    Camera, Contours, Length, Node, NodeColor, Outside, Projection, Scene, Transfer, TransferKind, Unit, VolumeSource,
};
use drypoint_scene::volume::{Anatomy, Volume};

/// Vertical field of view of a suggested camera, in degrees.
const FOV: f64 = 30.0;

/// A scene for a bare volume: an opaque surface where the data have their strongest boundary, denser material in a
/// second style, contours, and a camera that frames what is shown.
pub fn scene(source: VolumeSource, volume: &Volume, size: [usize; 2]) -> Scene {
    let mut scene = Scene::for_volume(source);
    let boundary = Boundary::find(volume);
    if let Some(transfer) = &mut scene.transfer {
        transfer.nodes = Some(nodes(&boundary, transfer.kind, Outside::Low));
    }
    let direction = direction(volume, &boundary);
    let up = up(volume, direction);
    let fit = framing::fit(volume, boundary.threshold, direction, up, FOV, size);
    scene.picture.size = size;
    scene.camera = Camera {
        projection: Projection::Perspective { fov: FOV },
        eye: Some(fit.eye),
        target: Some(fit.target),
        up,
        ..Camera::default()
    };
    scene.contours = Some(Contours { thickness: Length::Voxels(1.0), fade: Some([0.05, 0.2]), ..Contours::default() });
    scene
}

/// Gives a transfer function without nodes those of the volume's strongest boundary.
pub fn fill_function(transfer: &mut Transfer, volume: &Volume, outside: Outside) {
    transfer.unit = Unit::Value;
    transfer.nodes = Some(nodes(&Boundary::find(volume), transfer.kind, outside));
}

/// From transparent to opaque across the boundary, and on to a second look for denser material.
fn nodes(boundary: &Boundary, kind: TransferKind, outside: Outside) -> Vec<Node> {
    let look = |style: &str, srgb: [f64; 3]| match kind {
        TransferKind::Style => NodeColor::Style(style.into()),
        TransferKind::Regular => NodeColor::Color(srgb.map(color::srgb_to_linear)),
    };
    let (wax, bone) = (look("wax", [0.91, 0.75, 0.52]), look("bone", [0.93, 0.89, 0.80]));
    let node = |at, color: &NodeColor, opacity| Node { at, color: color.clone(), opacity };
    let [lo, hi] = boundary.ramp;
    let mut nodes = match outside {
        Outside::Low => vec![node(lo, &wax, 0.0), node(hi, &wax, 0.9)],
        Outside::High => vec![node(lo, &wax, 0.9), node(hi, &wax, 0.0)],
    };
    if let (Outside::Low, Some(denser)) = (outside, boundary.denser) {
        let half = (denser - hi) * 0.25;
        nodes.push(node(denser - half, &wax, 0.9));
        nodes.push(node(denser + half, &bone, 0.95));
    }
    nodes
}

/// The way the camera looks. A patient is seen from the front; a flat slab from its broad side; anything else over a
/// corner.
fn direction(volume: &Volume, boundary: &Boundary) -> DVec3 {
    match volume.anatomy() {
        Some(Anatomy::RightAnteriorSuperior) => return DVec3::new(-0.45, -1.0, -0.2),
        Some(Anatomy::LeftPosteriorSuperior) => return DVec3::new(0.45, 1.0, -0.2),
        Some(Anatomy::LeftAnteriorSuperior) => return DVec3::new(0.45, -1.0, -0.2),
        None => {}
    }
    let extent = framing::extent(volume, boundary.threshold);
    let (longest, shortest) = (extent.max_element(), extent.min_element());
    if shortest < 0.4 * longest && extent.z == shortest {
        return DVec3::new(-0.25, 0.5, -1.0);
    }
    DVec3::new(-0.6, 1.0, -0.45)
}

/// World z, unless the camera looks along it.
fn up(volume: &Volume, direction: DVec3) -> DVec3 {
    let along_z = direction.normalize().z.abs() > 0.8 && volume.anatomy().is_none();
    if along_z { DVec3::Y } else { DVec3::Z }
}
