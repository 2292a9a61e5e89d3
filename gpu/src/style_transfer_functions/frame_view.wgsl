// The frame of the lit sphere in which silhouettes lie on the rim, also in perspective ([STF-1]).
// Twin: reference/src/style_transfer_functions/frame.rs

// R n, R = I + [w]x + [w]x^2/(1 + v_z), w = v x z: the smallest rotation of v onto +z.
fn on_sphere(n: vec3<real>, v: vec3<real>) -> vec3<real> {
    let w = vec3<real>(v.y, -v.x, 0.0);
    let turned = cross(w, n);
    return n + turned + cross(w, turned) * (1.0 / (1.0 + v.z));
}
