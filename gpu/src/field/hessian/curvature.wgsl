// Curvature of the iso-surface through a place ([CUR-1], [CUR-2]).
// Twin: reference/src/field/curvature.rs

// G in the tangent plane: -H/|g|, turned for values that rise outwards. P drops out of forms in tangent vectors.
struct Shape {
    // The outward normal.
    n: vec3<real>,
    square: vec3<real>,
    mixed: vec3<real>,
    scale: real,
}

// A column of H along the index axes, in the world and as that of the moved field.
fn world_column(h: vec3<real>) -> vec3<real> {
    return moved_gradient(world_gradient(h));
}

// D^-T H D^-1, times a power of two, of the moved field.
fn world_shape(volume_gradient: vec3<real>, second: Second) -> Shape {
    let g = moved_gradient(volume_gradient);
    let s = second.square;
    let m = second.mixed;
    // The rows of H, each to the world.
    let x = world_column(vec3<real>(s.x, m.z, m.y));
    let y = world_column(vec3<real>(m.z, s.y, m.x));
    let z = world_column(vec3<real>(m.y, m.x, s.z));
    let a = world_column(vec3<real>(x.x, y.x, z.x));
    let b = world_column(vec3<real>(x.y, y.y, z.y));
    let c = world_column(vec3<real>(x.z, y.z, z.z));
    let scale = params.outside_sign / length_of(g);
    return Shape(g * scale, vec3<real>(a.x, b.y, c.z), vec3<real>(b.z, a.z, a.y), scale);
}

// a^T G b of tangent vectors, in 1/(world length).
fn form(shape: Shape, a: vec3<real>, b: vec3<real>) -> real {
    let m = shape.mixed;
    let h_b = vec3<real>(
        shape.square.x * b.x + m.z * b.y + m.y * b.z,
        m.z * b.x + shape.square.y * b.y + m.x * b.z,
        m.y * b.x + m.x * b.y + shape.square.z * b.z,
    );
    return params.curvature_unit * (shape.scale * dot(a, h_b));
}

// The entries a, b, c of G in an orthonormal tangent frame (Duff et al., Building an Orthonormal Basis, Revisited, 2017).
fn block_of(shape: Shape) -> vec3<real> {
    let n = shape.n;
    let sign = select(real(1.0), real(-1.0), n.z < 0.0);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    let t = vec3<real>(1.0 + sign * n.x * n.x * a, sign * b, -(sign * n.x));
    let u = vec3<real>(b, sign + n.y * n.y * a, -n.y);
    return vec3<real>(form(shape, t, t), form(shape, t, u), form(shape, u, u));
}

// The principal curvatures, larger first: m +- the length of ((a - c)/2, b).
fn principal_curvatures(shape: Shape) -> vec2<real> {
    let abc = block_of(shape);
    let m = (abc.x + abc.z) * 0.5;
    let h = (abc.x - abc.z) * 0.5;
    let r = sqrt(h * h + abc.y * abc.y);
    return vec2<real>(m + r, m - r);
}

// The normal curvature along Pv, and the mean curvature where Pv is lost to rounding ([CUR-2]).
fn curvature_along_view(shape: Shape, v: vec3<real>) -> real {
    // n x (v x n) is Pv without the cancellation of v - n (n.v).
    let across = cross(v, shape.n);
    let length = length_of(across);
    if (length <= params.no_direction) {
        let abc = block_of(shape);
        return (abc.x + abc.z) * 0.5;
    }
    let t = cross(shape.n, across) / length;
    return form(shape, t, t);
}
