// Rays of seeds. A seed depends on the field at its sample alone, so seeds have rays of their own, in the guard band about the
// picture too, with samples on the same planes.
// Twin: reference/src/ray/composite/seed_rays.rs

// Numbers of a ray of the images: the plane of its next sample, its last one, then what effects keep.
const SEED_KEPT = 2;

@group(2) @binding(2) var<storage, read_write> seed_ray_numbers: array<real>;

fn seed_place(number: i32, ray: i32) -> i32 {
    return number * (plane_group.image_x * plane_group.image_y) + ray;
}

// Adds a seed of a halo to those of the group's planes before ([HALO-8]).
fn plant(halo: i32, place: i32, s: real) {
    let planes = halo_group(halo);
    let at = vec2(place % plane_group.image_x, place / plane_group.image_x);
    let planted = image_place(at, seed_layer(halo, planes));
    let before = seed_image[planted];
    seed_image[planted] = select(max(before, s), before + s / halos[halo].every, halos[halo].is_mean == 1.0);
    set_flag(TILE_SEEDED + halo, tile_of(at), u32(planes));
}

// Starts all rays before all planes.
@compute @workgroup_size(8, 8)
fn halo_start(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = vec2<i32>(id.xy);
    if (!is_in_image(at)) {
        return;
    }
    let place = image_place(at, 0);
    for (var halo = 0; halo < HALOS; halo++) {
        seed_image[image_place(at, 2 * halo)] = 0.0;
        seed_image[image_place(at, 2 * halo + 1)] = 0.0;
        halo_image[image_place(at, halo)] = 0.0;
        occlusion_image[image_place(at, halo)] = 0.0;
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
    let own = at - plane_group.guard;
    if (is_in_picture(own)) {
        start_ray(own.y * plane_group.rays_x + own.x, ray);
    }
}
