// Rays in index space, and the box of the volume.
// Glue: A type.

// A plane beyond all planes.
const NO_HIT = 8.0e6;

struct Ray {
    // Index position at the anchor's plane, a plane in the middle of the volume.
    origin: vec3<real>,
    // Index displacement for one unit of depth.
    along: vec3<real>,
    // v, towards the eye, in world and in eye space.
    v: vec3<real>,
    v_eye: vec3<real>,
    // Eye depth between samples.
    depth_step: real,
    // World distance between samples.
    step: real,
}

// Whether a position lies in the closed box of the volume.
fn in_box(p: vec3<real>) -> bool {
    return all(p >= box_low()) && all(p <= box_high());
}
