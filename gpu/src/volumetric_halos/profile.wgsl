// The halo profile (3.3, [HALO-6]): from intensity to colour and opacity.
// Twin: reference/src/volumetric_halos/profile.rs

struct ProfileNode {
    at: real,
    color: vec4<real>,
}

fn profile_node(halo: i32, i: i32) -> ProfileNode {
    let at = i32(halos[halo].first_profile) + 5 * i;
    let rgb = vec3<real>(halo_numbers[at + 1], halo_numbers[at + 2], halo_numbers[at + 3]);
    return ProfileNode(halo_numbers[at], vec4<real>(rgb, halo_numbers[at + 4]));
}

// The straight colour in the blend space, and the opacity; 0 where nothing is seen. Of an intensity of 0 it is 0 whatever
// the nodes say.
fn profile_at(halo: i32, intensity: real) -> vec4<real> {
    let count = i32(halos[halo].profile);
    if (!(intensity > 0.0) || count == 0) {
        return vec4<real>();
    }
    var next = 0;
    while (next < count && intensity >= profile_node(halo, next).at) {
        next++;
    }
    let b = profile_node(halo, min(next, count - 1));
    var color = b.color;
    if (next > 0 && next < count) {
        let a = profile_node(halo, next - 1);
        color = a.color + (intensity - a.at) / (b.at - a.at) * (b.color - a.color);
    }
    return vec4<real>(in_blend_space(color.rgb), halos[halo].opacity * color.a);
}
