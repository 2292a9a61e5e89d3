// The images that the rays of a picture share ([HALO-9]).
// Twin: reference/src/volumetric_halos/halo_planes.rs

// Some planes, counted from the anchor as samples are; `end` is the last one counted from the eye.
struct PlaneGroup {
    first: i32,
    last: i32,
    end: i32,
    // Taps of a pass lie q 2^exponent rays apart.
    exponent: i32,
    // Groups counted from 0, and 1 where the groups of all halos end.
    number: i32,
    all_end: i32,
}

@group(2) @binding(0) var<storage, read> plane_group: PlaneGroup;

// Images of all rays with a guard band about the picture: four halos to a vector, a channel each.
@group(2) @binding(3) var<storage, read_write> seed_image: array<vec4<real>>;
@group(2) @binding(4) var<storage, read_write> halo_image: array<vec4<real>>;
@group(2) @binding(5) var<storage, read_write> occlusion_image: array<vec4<real>>;

// The place of a halo's vector at a pixel of the images.
fn vector_of(halo: i32, place: i32) -> i32 {
    return (halo / 4) * (IMAGE_X * IMAGE_Y) + place;
}

// H.
fn intensity_of(halo: i32, place: i32) -> real {
    return halo_image[vector_of(halo, place)][halo % 4];
}

// O.
fn occlusion_of(halo: i32, place: i32) -> real {
    return occlusion_image[vector_of(halo, place)][halo % 4];
}

// Whether a group of M planes ends with plane k, counted from the eye ([HALO-8]).
fn group_ends(k: i32, every: i32) -> bool {
    return (((k + 1) % every) + every) % every == 0;
}

// The pixel that a ray of the images goes through, and the part of it. Rays of the guard band lie before 0 or beyond the last.
fn image_pixel(at: vec2<i32>) -> vec3<i32> {
    let n = rays_across();
    // Whole numbers are divided where they are positive.
    let shifted = at - GUARD + GUARD * n;
    let part = shifted % n;
    return vec3(shifted / n - GUARD, part.y * n + part.x);
}

// The point of the picture that it goes through.
fn image_point(at: vec2<i32>) -> vec2<real> {
    let pixel = image_pixel(at);
    return point_of(pixel.xy, pixel.z, rays_across());
}
