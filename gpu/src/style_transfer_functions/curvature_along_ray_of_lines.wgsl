// The angle between the lines that normals span: one that was flipped towards the eye has not turned ([STF-5]).
// Twin: reference/src/style_transfer_functions/curvature_along_ray.rs

fn turn_cosine(cosine: real) -> real {
    return abs(cosine);
}
