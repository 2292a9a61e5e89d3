// The paper's frame of the lit sphere: the eye-space normal itself ([STF-1]).
// Twin: reference/src/style_transfer_functions/frame.rs

fn on_sphere(n: vec3<real>, v: vec3<real>) -> vec3<real> {
    return n;
}
