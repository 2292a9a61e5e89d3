// The place at which a ray first meets a mesh ([VS-12]).
// Twin: reference/src/mesh/nearest.rs

// Planes from the anchor beyond which meshes are not searched: neighbouring planes fall together farther away.
const FARTHEST_MESH = 4.0e6;

// A box about triangles, in index space.
struct MeshBox {
    low_x: real,
    low_y: real,
    low_z: real,
    high_x: real,
    high_y: real,
    high_z: real,
}

// The boxes as a tree, each before those inside it.
@group(1) @binding(27) var<storage, read> mesh_boxes: array<MeshBox>;
// For each box the next one behind all those inside it, and its triangle if there are none; then for each triangle its three
// corners and its mesh.
@group(1) @binding(28) var<storage, read> mesh_words: array<u32>;
// Vectors: the vertices in index space, their unit normals in the world, 0 for none, the unit normals of triangles, the linear
// colours of meshes.
@group(1) @binding(29) var<storage, read> mesh_numbers: array<real>;

// The triangle that a ray meets first; -1 for none.
struct MeshHit {
    triangle: i32,
    t: real,
    weights: vec3<real>,
}

fn mesh_vector(i: i32) -> vec3<real> {
    return vec3<real>(mesh_numbers[3 * i], mesh_numbers[3 * i + 1], mesh_numbers[3 * i + 2]);
}

// A number of a triangle: 0 to 2 its corners, 3 its mesh.
fn triangle_word(triangle: i32, word: i32) -> i32 {
    return i32(mesh_words[2 * MESH_BOXES + 4 * triangle + word]);
}

// The first triangle on a ray in start..=end. Of several at one place it is the first one of the list.
fn nearest_triangle(ray: Ray, start: real, end: real) -> MeshHit {
    let along = ray.along * ray.depth_step;
    let inverse = inverse_of(along);
    let line = sheared_ray(ray.origin, along);
    var best = MeshHit(-1, end, vec3<real>());
    var i = 0;
    while (i < MESH_BOXES) {
        let box = mesh_boxes[i];
        let low = vec3<real>(box.low_x, box.low_y, box.low_z);
        let high = vec3<real>(box.high_x, box.high_y, box.high_z);
        let behind = i32(mesh_words[2 * i]);
        if (!meets_box(ray.origin, inverse, low, high, start, best.t)) {
            i = behind;
            continue;
        }
        i++;
        if (i < behind) {
            continue;
        }
        let triangle = i32(mesh_words[2 * i - 1]);
        let a = mesh_vector(triangle_word(triangle, 0));
        let b = mesh_vector(triangle_word(triangle, 1));
        let c = mesh_vector(triangle_word(triangle, 2));
        let found = triangle_hit(line, a, b, c);
        let is_nearer = found.t < best.t || (found.t == best.t && (best.triangle < 0 || triangle < best.triangle));
        if (found.is_met && found.t >= start && is_nearer) {
            best = MeshHit(triangle, found.t, found.weights);
        }
    }
    is_unfinished = is_unfinished || i < MESH_BOXES;
    return best;
}
