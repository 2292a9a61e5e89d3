// Rays that go on from plane to plane under halos ([HALO-1], [HALO-7]).
// Twin: reference/src/ray/composite/plane_order.rs

// Numbers of a ray between groups of planes: colour, opacity, the plane of its next step, the last plane of its samples;
// then what effects keep. Each number lies in a list of its own, ray by ray.
const RAY_OPACITY = 3;
const RAY_NEXT = 4;
const RAY_LAST = 5;
const RAY_KEPT = 6;

// Beyond every plane.
const NO_PLANE = 8000000;

@group(2) @binding(1) var<storage, read_write> ray_numbers: array<real>;

fn ray_place(number: i32, ray: i32) -> i32 {
    return number * (plane_group.rays_x * plane_group.rays_y) + ray;
}

fn front_of(ray: i32) -> Front {
    let rgb = vec3<real>(ray_numbers[ray_place(0, ray)], ray_numbers[ray_place(1, ray)], ray_numbers[ray_place(2, ray)]);
    return Front(rgb, ray_numbers[ray_place(RAY_OPACITY, ray)]);
}

fn keep_front(ray: i32, front: Front) {
    ray_numbers[ray_place(0, ray)] = front.rgb.r;
    ray_numbers[ray_place(1, ray)] = front.rgb.g;
    ray_numbers[ray_place(2, ray)] = front.rgb.b;
    ray_numbers[ray_place(RAY_OPACITY, ray)] = front.opacity;
}

fn is_in_picture(at: vec2<i32>) -> bool {
    return all(at >= vec2(0)) && at.x < plane_group.rays_x && at.y < plane_group.rays_y;
}

// Notes that something behind these planes would be seen on a ray.
fn set_open(at: vec2<i32>) {
    set_flag(TILE_OPEN, tile_of(at + plane_group.guard), u32(plane_group.number + 1));
}

// Starts a ray of the picture before all planes.
fn start_ray(number: i32, ray: Ray) {
    begin_ray(ray);
    let run = samples_that_show(ray);
    keep_front(number, Front());
    ray_numbers[ray_place(RAY_NEXT, number)] = real(select(end_plane(), run.x, run.x <= run.y));
    ray_numbers[ray_place(RAY_LAST, number)] = real(run.y);
    keep_ray(number);
    begin_watch(number);
}

// Composites a sample under a tint ([VAL-3], [VAL-4]).
fn composite_sample(ray: Ray, sample: Sample, tint: Tint, front: Front) -> Front {
    if (!(sample.place.alpha_u > 0.0)) {
        return front;
    }
    let first = measured_first(ray, sample);
    if (!is_seen(ray, sample, first)) {
        return front;
    }
    let attributes = measured_rest(ray, sample, first);
    let shaded = shown(ray, sample, attributes);
    let alpha = corrected(shaded.alpha, ray.step / params.reference_length * steps_of(sample.k));
    collect(ray, sample, attributes, alpha);
    return over(front, tinted(in_blend_space(shaded.rgb), tint), alpha);
}

// Composites the opaque surface at which a ray ends, under a tint.
fn meet_end(ray: Ray, tint: Tint, front: Front) -> Front {
    let end = ended(ray, Front());
    if (end.opacity < 1.0) {
        return front;
    }
    return opaque_behind(front, tinted(end.rgb, tint));
}

// A ray of the picture while it visits a group's planes.
struct RayOnPlanes {
    number: i32,
    // The plane of its next step; NO_PLANE for a ray that has ended. The last plane of its samples.
    next: i32,
    last: i32,
    front: Front,
    tint: Tint,
    // The glow behind each plane.
    glows: bool,
    glow: vec4<real>,
}

// Whether what lies behind would be seen.
fn is_open(front: Front) -> bool {
    return front.opacity < params.stop_at;
}

// The ray of a pixel of the picture, if these planes show something on it.
fn resume_on_planes(at: vec2<i32>) -> RayOnPlanes {
    var own: RayOnPlanes;
    own.number = at.y * plane_group.rays_x + at.x;
    own.next = NO_PLANE;
    if (ray_numbers[ray_place(RAY_OPACITY, own.number)] >= params.stop_at) {
        return own;
    }
    let place = image_place(at + plane_group.guard, 0);
    watch(own.number, place);
    set_open(at);
    let next = i32(ray_numbers[ray_place(RAY_NEXT, own.number)]);
    own.glows = EMISSIVE && can_glow(place);
    if (next > plane_group.last && !own.glows) {
        return own;
    }
    own.next = next;
    own.last = i32(ray_numbers[ray_place(RAY_LAST, own.number)]);
    own.front = front_of(own.number);
    own.tint = tint_at(place, -1);
    return own;
}

// Keeps a ray for the groups that follow.
fn leave_planes(own: RayOnPlanes) {
    keep_front(own.number, own.front);
    ray_numbers[ray_place(RAY_NEXT, own.number)] = real(own.next);
    keep_ray(own.number);
}

// The mean of a pixel over its rays ([RAY-6]), over the background ([IO-6]).
@compute @workgroup_size(8, 8)
fn halo_pixels(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if (any(pixel >= picture_size())) {
        return;
    }
    let n = rays_across();
    let behind = background_at(pixel.y * picture_size().x + pixel.x);
    var sum = vec4<real>();
    for (var part = 0; part < n * n; part++) {
        let at = pixel * n + vec2(part % n, part / n);
        let number = at.y * plane_group.rays_x + at.x;
        sum += over_background(front_of(number), behind);
        let point = image_point(at + plane_group.guard);
        resume_ray(number, ray_through(point.x, point.y));
        sum_intensities(number);
        end_ray(part);
    }
    write_channels((pixel.y * picture_size().x + pixel.x) * CHANNELS, sum / real(n * n));
}
