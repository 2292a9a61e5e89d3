// The halos of a picture and the images that its rays share ([HALO-1], [HALO-9]).

// The parameters of a halo. Lists lie in `halo_numbers`, from a first number on.
struct Halo {
    // 1 for occlusive halos, 0 for emissive ones.
    is_occlusive: real,
    // M, and 1 where seeds come together as their mean.
    every: real,
    is_mean: real,
    // Seeds: h_v (0: one, 1: the opacity, 2: nodes), nodes, labels, points and their distances, directions.
    value: real,
    first_node: real,
    nodes: real,
    first_label: real,
    labels: real,
    first_point: real,
    points: real,
    inner: real,
    falloff: real,
    has_direction: real,
    toward_x: real,
    toward_y: real,
    half_width: real,
    softness: real,
    // a; 1 for seeds by curvature; b or T; the largest |n.v|.
    gradient_exponent: real,
    by_curvature: real,
    side: real,
    most_frontal: real,
    floor: real,
    // Spreading: N, delta, 1 for the gradient, 1 for a median before.
    passes: real,
    delta: real,
    from_gradient: real,
    has_median: real,
    // The profile: nodes and the factor of opacities.
    first_profile: real,
    profile: real,
    opacity: real,
    // A number for each halo: 1 for those that this one tints.
    first_tint: real,
}

@group(1) @binding(30) var<storage, read> halos: array<Halo>;
@group(1) @binding(31) var<storage, read> halo_numbers: array<real>;

// Some planes, counted from the anchor as samples are; `end` is the last one counted from the eye.
struct PlaneGroup {
    first: i32,
    last: i32,
    end: i32,
    // HaloTaps of a pass lie q 2^exponent rays apart.
    exponent: i32,
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

// Whether a group of a halo ends with these planes ([HALO-8]).
fn group_ends(halo: i32) -> bool {
    let every = i32(halos[halo].every);
    return (((plane_group.end + 1) % every) + every) % every == 0;
}

// The point of the picture that a ray of the images goes through. Rays of the guard band lie before 0 or beyond the last.
fn image_point(at: vec2<i32>) -> vec2<real> {
    let n = RAYS_ACROSS;
    // Whole numbers are divided where they are positive.
    let shifted = at - GUARD + GUARD * n;
    let pixel = shifted / n - GUARD;
    let part = shifted % n;
    return point_of(pixel, part.y * n + part.x, n);
}
