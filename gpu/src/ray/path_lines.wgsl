// Lines inside the volume, at their depths on rays ([HATCH-14] d).
// Twin: reference/src/ray/composite/path.rs

// The part of a line in the share of a pixel that a ray stands for.
struct Fragment {
    // The plane, counted from the anchor, with its fraction.
    t: real,
    // Straight linear colour.
    r: real,
    g: real,
    b: real,
    opacity: real,
}

// The first fragment of each ray, row by row, and the end of the last ray's. Those of a ray are ordered by t.
@group(0) @binding(3) var<storage, read> line_starts: array<u32>;
@group(0) @binding(4) var<storage, read> fragments: array<Fragment>;

// The fragments of the ray that are left.
var<private> next_line: i32;
var<private> end_line: i32;
// 1 - A of the lines before them.
var<private> through_lines: real;

fn begin_lines(pixel: vec2<i32>, part: i32, across: i32) {
    // The ray of the lines in whose part of the pixel this ray lies.
    let within = (2 * vec2(part % across, part / across) + 1) * rays_across() / (2 * across);
    let ray = pixel * rays_across() + within;
    let i = ray.y * picture_size().x * rays_across() + ray.x;
    next_line = i32(line_starts[i]);
    end_line = i32(line_starts[i + 1]);
    through_lines = 1.0;
}

fn has_line_before(t: real) -> bool {
    return next_line < end_line && fragments[next_line].t < t;
}

// Lays the next line behind what is there.
fn meet_line(front: Front) -> Front {
    let line = fragments[next_line];
    next_line++;
    let rgb = in_blend_space(vec3<real>(line.r, line.g, line.b));
    if (line.opacity >= 1.0) {
        return opaque_behind(front, rgb);
    }
    through_lines *= 1.0 - line.opacity;
    return over(front, rgb, line.opacity);
}

// Lays so many steps of a sample behind what is there.
fn composite_share(
    front: Front, ray: Ray, sample: Sample, a: Attributes, shaded: Shaded, ratio: real, steps: real,
) -> Front {
    let alpha = corrected(shaded.alpha, ratio * steps);
    collect(ray, sample, a, alpha);
    return over(front, in_blend_space(shaded.rgb), alpha);
}

// Lays a sample behind what is there, after the lines before it. It stands for the way from half a step before it on, which
// is split where a line lies in it: the share before the line, the line, the rest.
fn composite(front: Front, ray: Ray, sample: Sample, a: Attributes, shaded: Shaded, ratio: real) -> Front {
    var seen = front;
    var start = real(sample.k) - 0.5;
    while (seen.opacity < params.stop_at && next_line < end_line && fragments[next_line].t <= start) {
        seen = meet_line(seen);
    }
    let until = start + steps_of(sample.k);
    while (seen.opacity < params.stop_at && has_line_before(until)) {
        let t = fragments[next_line].t;
        if (t > start) {
            seen = composite_share(seen, ray, sample, a, shaded, ratio, t - start);
            start = t;
            if (seen.opacity >= params.stop_at) {
                break;
            }
        }
        seen = meet_line(seen);
    }
    if (seen.opacity < params.stop_at) {
        seen = composite_share(seen, ray, sample, a, shaded, ratio, until - start);
    }
    return seen;
}

// The lines behind the last sample.
fn meet_lines_left(ray: Ray, seen: Front) -> Front {
    var front = seen;
    while (front.opacity < params.stop_at && next_line < end_line) {
        front = meet_line(front);
    }
    return front;
}
