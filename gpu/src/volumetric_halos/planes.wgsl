// The visit of a group's planes: rays of the picture composite them, and rays of the images seed ([HALO-1], [HALO-7]). On
// each plane a ray composites its sample, then the glow of the groups before, then it seeds; neither asks for what the
// other does, and a sample that is visited for both is measured once.
// Glue: An entry point.

@compute @workgroup_size(8, 8)
fn halo_planes(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = vec2<i32>(id.xy);
    if (!is_in_image(at)) {
        return;
    }
    let place = image_place(at, 0);
    var own: RayOnPlanes;
    own.next = NO_PLANE;
    if (is_in_picture(at - plane_group.guard)) {
        own = resume_on_planes(at - plane_group.guard);
    }
    let visits = own.next <= plane_group.last || own.glows;
    var next_seed = i32(seed_ray_numbers[seed_place(0, place)]);
    let last_seed = i32(seed_ray_numbers[seed_place(1, place)]);
    let seeds = next_seed <= min(last_seed, plane_group.last) && is_near_open(at);
    if (!visits && !seeds) {
        return;
    }
    if (!seeds) {
        next_seed = NO_PLANE;
    }
    let point = image_point(at);
    let ray = ray_through(point.x, point.y);
    aim_image(at);
    resume_seed(place, ray);
    if (visits) {
        resume_ray(own.number, ray);
    }
    aim_again(ray);
    if (own.glows) {
        own.glow = glow_at(place, ray.step / params.reference_length);
    }
    for (var k = plane_group.first; k <= plane_group.last; k++) {
        if (!own.glows) {
            // Samples before it show and seed nothing.
            k = max(k, min(own.next, next_seed));
            if (k > plane_group.last) {
                break;
            }
        }
        let has_step = k == own.next;
        if (has_step && k > own.last) {
            own.front = meet_end(ray, own.tint, own.front);
            own.next = NO_PLANE;
        }
        if ((has_step && k <= own.last) || k == next_seed) {
            var sample = sample_on(ray, k);
            // The planes up to these show and seed nothing.
            let after = select(k, next_shown(ray, sample, own.last), has_step);
            let after_seed = select(k, next_sown(ray, sample, last_seed), k == next_seed);
            let shows = has_step && k <= own.last && after == k;
            let sows = k == next_seed && after_seed == k;
            if (shows || sows) {
                sample = looked_up(sample);
            }
            if (shows) {
                own.front = show_sample(ray, sample, own.tint, own.front);
            }
            if (has_step && k <= own.last) {
                own.next = select(after, k + 1, after == k);
                if (own.next > own.last) {
                    own.next = end_plane();
                }
            }
            if (sows) {
                sow_sample(ray, sample, place);
            }
            if (k == next_seed) {
                next_seed = select(after_seed, k + 1, after_seed == k);
                if (next_seed > last_seed) {
                    next_seed = NO_PLANE;
                }
            }
        }
        if (own.glows && is_open(own.front)) {
            own.front = over_premultiplied(own.front, own.glow);
        }
        if (visits && !is_open(own.front)) {
            // The front hides all that follows.
            own.next = NO_PLANE;
            own.glows = false;
        }
    }
    if (visits) {
        leave_planes(own);
    }
    if (seeds) {
        seed_ray_numbers[seed_place(0, place)] = real(next_seed);
    }
}
