// The angle between normals ([STF-5]).
// Twin: reference/src/style_transfer_functions/curvature_along_ray.rs

fn turn_cosine(cosine: real) -> real {
    return cosine;
}
