// The far depths of objects with funnels, on the rays of a picture and of guard bands about it ([VS-7]).
// Twin: reference/src/volumeshop/funnel.rs

// The guard band of each funnel in pixels, and the place of its first depth.
@group(1) @binding(26) var<storage, read> funnel_bands: array<vec2<u32>>;
@group(0) @binding(6) var<storage, read_write> funnel_depths: array<real>;

// A depth where the ray misses the object.
const NO_DEPTH = -3.0e38;

@compute @workgroup_size(8, 8)
fn find_depths(@builtin(global_invocation_id) id: vec3<u32>) {
    let band = vec2<i32>(funnel_bands[id.z]);
    let size = vec2(FUNNEL_X, FUNNEL_Y) + 2 * band.x;
    let at = vec2<i32>(id.xy);
    if (any(at >= size)) {
        return;
    }
    let pixel = at - band.x - FUNNEL_MARGIN;
    let point = point_of(pixel, 0, 1);
    aim_parts(point);
    let ray = ray_through(point.x, point.y);
    begin_ray(ray);
    aim_background(ray);
    let plane = funnel_plane(i32(id.z));
    funnel_depths[band.y + at.y * size.x + at.x] = select(real(NO_DEPTH), depth_of_plane(ray, plane), plane > -NOT_MET);
}
