// h_p over the distance to a point or a polyline, in world space (3.1, [HALO-2]).
// Twin: reference/src/volumetric_halos/focus.rs

// A point of a polyline, from voxel (0, 0, 0).
fn focus_point(first: i32, i: i32) -> vec3<real> {
    let at = first + 3 * i;
    return vec3<real>(halo_numbers[at], halo_numbers[at + 1], halo_numbers[at + 2]);
}

// The distance of p to the segment from a to b.
fn distance_to_segment(p: vec3<real>, a: vec3<real>, b: vec3<real>) -> real {
    let along = b - a;
    let square = dot(along, along);
    var t = real(0.0);
    if (square > 0.0) {
        t = clamp_01(dot(p - a, along) / square);
    }
    let away = p - (a + along * t);
    return sqrt(dot(away, away));
}

// The distance to the point, or to the nearest segment of the polyline.
fn distance_to_focus(p: vec3<real>, first: i32, points: i32) -> real {
    let start = focus_point(first, 0);
    var nearest = distance_to_segment(p, start, start);
    for (var i = 1; i < points; i++) {
        nearest = min(nearest, distance_to_segment(p, focus_point(first, i - 1), focus_point(first, i)));
    }
    return nearest;
}

// h_p = clamp(1 - (distance - inner)/falloff); a step at `inner` for falloff 0.
fn focus_at(distance: real, inner: real, falloff: real) -> real {
    let beyond = distance - inner;
    if (beyond <= 0.0) {
        return 1.0;
    }
    if (beyond >= falloff) {
        return 0.0;
    }
    return 1.0 - beyond / falloff;
}

fn by_focus(halo: i32, sample: Sample, h: real) -> real {
    let points = i32(halos[halo].points);
    if (points == 0) {
        return h;
    }
    let p = sample.position;
    let way = halo_axis_x() * p.x + halo_axis_y() * p.y + halo_axis_z() * p.z;
    let distance = distance_to_focus(way, i32(halos[halo].first_point), points);
    return h * focus_at(distance, halos[halo].inner, halos[halo].falloff);
}
