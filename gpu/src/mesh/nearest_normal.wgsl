// Normals of meshes ([VS-12]).
// Twin: reference/src/mesh/nearest.rs

// A vector of length 1; 0 for one without direction.
fn unit_vector(v: vec3<real>) -> vec3<real> {
    let size = abs(v);
    let largest = max(max(size.x, size.y), size.z);
    if (!(largest > 0.0)) {
        return vec3<real>();
    }
    let scaled = v / largest;
    return scaled / sqrt(dot(scaled, scaled));
}

// The normal between those of the vertices, or the flat one of the triangle; 0 for none. Which side is seen the triangle
// says: a smooth normal can point away from the eye where the mesh does not.
fn seen_normal(flat_normal: vec3<real>, sum: vec3<real>, v: vec3<real>) -> vec3<real> {
    let smooth_normal = unit_vector(sum);
    let normal = select(flat_normal, smooth_normal, any(smooth_normal != vec3<real>()));
    var seen = dot(normal, v);
    if (any(flat_normal != vec3<real>())) {
        let side = dot(flat_normal, v);
        seen = select(side, -side, dot(flat_normal, normal) < 0.0);
    }
    return select(normal, -normal, seen < 0.0);
}
