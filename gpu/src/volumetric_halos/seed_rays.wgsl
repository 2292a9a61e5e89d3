// Rays of seeds. A seed depends on the field at its sample alone, so seeds have rays of their own, in the guard band about the
// picture too, with samples on the same planes.
// Twin: reference/src/ray/composite/seed_rays.rs

// Numbers of a ray of the images: the plane of its next sample, its last one, then what effects keep.
const SEED_KEPT = 2;

@group(2) @binding(2) var<storage, read_write> seed_ray_numbers: array<real>;

fn seed_place(number: i32, ray: i32) -> i32 {
    return number * (IMAGE_X * IMAGE_Y) + ray;
}

// Adds a seed of a halo to those of the group's planes before ([HALO-8]).
fn plant(halo: i32, place: i32, s: real) {
    let at = vector_of(halo, place);
    let before = seed_image[at][halo % 4];
    let sum = select(max(before, s), before + s / halos[halo].every, halos[halo].is_mean == 1.0);
    seed_image[at][halo % 4] = sum;
    set_flag(TILE_SEEDED, tile_of(vec2(place % IMAGE_X, place / IMAGE_X)), 1u);
}

// Starts all rays before all planes.
@compute @workgroup_size(8, 8)
fn halo_start(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = vec2<i32>(id.xy);
    if (at.x >= IMAGE_X || at.y >= IMAGE_Y) {
        return;
    }
    let place = at.y * IMAGE_X + at.x;
    for (var i = place; i < IMAGE_X * IMAGE_Y * HALO_VECTORS; i += IMAGE_X * IMAGE_Y) {
        seed_image[i] = vec4<real>();
        halo_image[i] = vec4<real>();
        occlusion_image[i] = vec4<real>();
    }
    let point = image_point(at);
    let ray = ray_through(point.x, point.y);
    aim_image(at);
    let run = samples_that_seed(ray);
    seed_ray_numbers[seed_place(0, place)] = real(run.x);
    seed_ray_numbers[seed_place(1, place)] = real(run.y);
    keep_seed(place);
    // At first seeds can reach every ray.
    set_flag(TILE_NEAR, tile_of(at), 1u);
    let own = at - GUARD;
    if (is_in_picture(own)) {
        start_ray(own.y * RAYS_X + own.x, ray);
    }
}
