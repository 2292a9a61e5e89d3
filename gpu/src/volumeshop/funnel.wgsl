// Smooth cutaways: a funnel about an object (6.2, 7; [VS-7]). Depths are counted from the plane at the anchor.
// Twin: reference/src/volumeshop/funnel.rs

// The coverage c~ and the mean depth d^ of each pixel of each funnel.
@group(0) @binding(5) var<storage, read> funnel_maps: array<vec2<real>>;

// The pixel in the maps, which reach over the guard band of halos.
var<private> funnel_pixel: vec2<i32>;

fn begin_funnel(pixel: vec2<i32>, part: i32, across: i32) {
    funnel_pixel = clamp(pixel + FUNNEL_MARGIN, vec2(0), vec2(FUNNEL_X, FUNNEL_Y) - 1);
}

// Depths of planes of a ray, and planes at depths.
fn depth_of_plane(ray: Ray, plane: real) -> real {
    return plane * ray.depth_step + params.anchor_steps * (ray.depth_step - params.step);
}

fn plane_at_depth(ray: Ray, depth: real) -> real {
    return (depth - params.anchor_steps * (ray.depth_step - params.step)) / ray.depth_step;
}

// The plane at which a funnel ends: d~ = z_in + min(1, 2 c~)(d^ - z_in), z_in where the ray comes into the volume's box, or that
// of the object where the ray hits it and it is farther.
fn funnel_end(funnel: i32, plane: real) -> real {
    let map = funnel_maps[(funnel * FUNNEL_Y + funnel_pixel.y) * FUNNEL_X + funnel_pixel.x];
    let through = through_box(own_ray, box_low(), box_high());
    if (!(map.x > 1.0e-6) || through.x > through.y) {
        return plane;
    }
    let z_in = depth_of_plane(own_ray, max(through.x, params.near_steps));
    // Rounding does not decide whether a sample at the end itself lies before it.
    return max(plane_at_depth(own_ray, z_in + min(2.0 * map.x, 1.0) * (map.y - z_in)), plane) - params.funnel_slack;
}
