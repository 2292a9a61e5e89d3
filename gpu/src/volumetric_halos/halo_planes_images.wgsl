// The images that the rays of a picture share ([HALO-9]).
// Twin: reference/src/volumetric_halos/halo_planes.rs

// The planes of a dispatch, and the sizes of the images.
struct PlaneGroup {
    // Counted from the anchor, as samples are.
    first: i32,
    last: i32,
    // The last plane, and the first one of all, counted from the eye.
    end: i32,
    begin: i32,
    // Groups counted from 0.
    number: i32,
    // The stages of spreading, the last one included: SOURCE_STAGE, then the exponents of passes.
    from_stage: i32,
    to_stage: i32,
    // Rays of the picture, rays of the images, and those of the guard band on each side.
    rays_x: i32,
    rays_y: i32,
    image_x: i32,
    image_y: i32,
    guard: i32,
    // Tiles across and down, and in each direction those that the guard band reaches.
    tiles_x: i32,
    tiles_y: i32,
    tile_reach: i32,
}

@group(2) @binding(0) var<storage, read> plane_group: PlaneGroup;

// Images of all rays with a guard band about the picture, a layer each halo; seeds have two layers, for groups of planes in turn.
@group(2) @binding(3) var<storage, read_write> seed_image: array<real>;
@group(2) @binding(4) var<storage, read_write> halo_image: array<real>;
@group(2) @binding(5) var<storage, read_write> occlusion_image: array<real>;

fn is_in_image(at: vec2<i32>) -> bool {
    return all(at >= vec2(0)) && at.x < plane_group.image_x && at.y < plane_group.image_y;
}

// The place of a pixel in a layer of the images.
fn image_place(at: vec2<i32>, layer: i32) -> i32 {
    return (layer * plane_group.image_y + at.y) * plane_group.image_x + at.x;
}

// The place in a halo's layer.
fn place_of_halo(halo: i32, place: i32) -> i32 {
    return halo * (plane_group.image_x * plane_group.image_y) + place;
}

// H.
fn intensity_of(halo: i32, place: i32) -> real {
    return halo_image[place_of_halo(halo, place)];
}

// O.
fn occlusion_of(halo: i32, place: i32) -> real {
    return occlusion_image[place_of_halo(halo, place)];
}

// The group of M planes in which plane k lies, counted from the eye ([HALO-8]).
fn group_of(k: i32, every: i32) -> i32 {
    // Division rounds towards 0.
    return select(k, k - every + 1, k < 0) / every;
}

// Whether a group of M planes ends with plane k.
fn group_ends(k: i32, every: i32) -> bool {
    return group_of(k + 1, every) != group_of(k, every);
}

// The group of a halo to which these planes belong, counted from 2.
fn halo_group(halo: i32) -> i32 {
    let every = i32(halos[halo].every);
    return group_of(plane_group.end, every) - group_of(plane_group.begin, every) + 2;
}

// The layer of a halo's seeds in a group of planes.
fn seed_layer(halo: i32, group: i32) -> i32 {
    return 2 * halo + (group & 1);
}

// The pixel that a ray of the images goes through, and the part of it. Rays of the guard band lie before 0 or beyond the last.
fn image_pixel(at: vec2<i32>) -> vec3<i32> {
    let n = rays_across();
    // Whole numbers are divided where they are positive.
    let shifted = at - plane_group.guard + plane_group.guard * n;
    let part = shifted % n;
    return vec3(shifted / n - plane_group.guard, part.y * n + part.x);
}

// The point of the picture that it goes through.
fn image_point(at: vec2<i32>) -> vec2<real> {
    let pixel = image_pixel(at);
    return point_of(pixel.xy, pixel.z, rays_across());
}
