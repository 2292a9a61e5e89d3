// Rays that go on from plane to plane under halos ([HALO-1], [HALO-7]).

// Numbers of a ray between groups of planes: colour, opacity, the plane of its next step, the last plane of its samples;
// then what effects keep. Each number lies in a list of its own, ray by ray.
const RAY_OPACITY = 3;
const RAY_NEXT = 4;
const RAY_LAST = 5;
const RAY_KEPT = 6;

// Beyond every plane.
const NO_PLANE = 8000000;

@group(2) @binding(1) var<storage, read_write> ray_numbers: array<real>;

// The plane of the step that comes after the sample that was visited.
var<private> plane_after: i32;

fn ray_place(number: i32, ray: i32) -> i32 {
    return number * (RAYS_X * RAYS_Y) + ray;
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
    return all(at >= vec2(0)) && at.x < RAYS_X && at.y < RAYS_Y;
}

// Notes that something behind these planes would be seen on a ray.
fn set_open(at: vec2<i32>) {
    set_flag(TILE_OPEN, tile_of(at + GUARD), u32(plane_group.number + 1));
}

// Starts a ray of the picture before all planes.
fn start_ray(number: i32, ray: Ray) {
    begin_ray(ray);
    let run = samples_left(ray, samples_inside(ray));
    keep_front(number, Front());
    ray_numbers[ray_place(RAY_NEXT, number)] = real(select(end_plane(), run.x, run.x <= run.y));
    ray_numbers[ray_place(RAY_LAST, number)] = real(run.y);
    keep_ray(number);
    begin_watch(number);
}

// Composites sample k under a tint ([VAL-3], [VAL-4]).
fn visit_sample(ray: Ray, k: i32, tint: Tint, front: Front) -> Front {
    var sample: Sample;
    sample.k = k;
    sample.position = position(ray, k);
    sample.at = locate(sample.position);
    plane_after = next_plane(ray, sample);
    if (plane_after > k) {
        // What lies before that plane shows nothing.
        return front;
    }
    plane_after = k + 1;
    sample.s = value_at(sample.at);
    sample.place = node_place(locate_value(sample.s));
    if (!(sample.place.alpha_u > 0.0)) {
        return front;
    }
    let first = measured_first(ray, sample);
    if (!is_seen(ray, sample, first)) {
        return front;
    }
    let attributes = measured_rest(ray, sample, first);
    let shaded = shown(ray, sample, attributes);
    let alpha = corrected(shaded.alpha, ray.step / params.reference_length * steps_of(k));
    collect(ray, sample, attributes, alpha);
    return over(front, tinted(in_blend_space(shaded.rgb), tint), alpha);
}

// Composites the opaque surface at which a ray ends, under a tint.
fn meet_end(ray: Ray, tint: Tint, front: Front) -> Front {
    let end = ended(ray, Front());
    if (end.opacity < 1.0) {
        return front;
    }
    return Front(front.rgb + (1.0 - front.opacity) * tinted(end.rgb, tint), 1.0);
}

// Composites the planes of a group on a ray of the picture: at each one its sample, then the glow of the groups before.
fn go_on(at: vec2<i32>) {
    let number = at.y * RAYS_X + at.x;
    if (ray_numbers[ray_place(RAY_OPACITY, number)] >= params.stop_at) {
        return;
    }
    let place = (at.y + GUARD) * IMAGE_X + at.x + GUARD;
    watch(number, place);
    let glows = EMISSIVE && can_glow(place);
    var next = i32(ray_numbers[ray_place(RAY_NEXT, number)]);
    if (next > plane_group.last && !glows) {
        set_open(at);
        return;
    }
    let point = image_point(at + GUARD);
    let ray = ray_through(point.x, point.y);
    var glow = vec4<real>();
    if (glows) {
        glow = glow_at(place, ray.step / params.reference_length);
    }
    var front = front_of(number);
    let last = i32(ray_numbers[ray_place(RAY_LAST, number)]);
    let tint = tint_at(place, -1);
    resume_ray(number, ray);
    for (var k = plane_group.first; k <= plane_group.last && front.opacity < params.stop_at; k++) {
        if (!glows) {
            k = max(k, next);
            if (k > plane_group.last) {
                break;
            }
        }
        if (k == next) {
            if (k <= last) {
                front = visit_sample(ray, k, tint, front);
                next = select(end_plane(), plane_after, plane_after <= last);
            } else {
                front = meet_end(ray, tint, front);
                next = NO_PLANE;
            }
        }
        if (glows && front.opacity < params.stop_at) {
            front = over_premultiplied(front, glow);
        }
    }
    keep_front(number, front);
    ray_numbers[ray_place(RAY_NEXT, number)] = real(next);
    keep_ray(number);
    if (front.opacity < params.stop_at) {
        set_open(at);
    }
}

// The mean of a pixel over its rays ([RAY-6]), over the background ([IO-6]).
@compute @workgroup_size(8, 8)
fn halo_pixels(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if (pixel.x >= WIDTH || pixel.y >= HEIGHT) {
        return;
    }
    let n = RAYS_ACROSS;
    let behind = background_at(pixel.y * WIDTH + pixel.x);
    var sum = vec4<real>();
    for (var part = 0; part < n * n; part++) {
        let at = pixel * n + vec2(part % n, part / n);
        let number = at.y * RAYS_X + at.x;
        sum += over_background(front_of(number), behind);
        let point = image_point(at + GUARD);
        resume_ray(number, ray_through(point.x, point.y));
        sum_intensities(number);
        end_ray(part);
    }
    write_channels((pixel.y * WIDTH + pixel.x) * CHANNELS, sum / real(n * n));
}
