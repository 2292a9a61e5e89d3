// The samples of a picture with objects: each set shows and seeds by its own ([VS-2]).
// Glue: The samples of a picture, to show and to seed.

// The samples at which the background can seed.
var<private> own_seeds: vec2<i32>;
// Whether samples are looked up for their seeds: those are not counted.
var<private> is_sowing: bool;

fn note_sample(sample: Sample) {
    if (!is_sowing) {
        visited(sample);
    }
}

// Aims the rays of the objects at a place of the images.
fn aim_image(at: vec2<i32>) {
    let pixel = image_pixel(at);
    begin_part(pixel.xy, pixel.z, rays_across());
}

fn samples_that_seed(ray: Ray) -> vec2<i32> {
    aim_background(ray);
    own_seeds = seeds_left(ray, own_box);
    end_cutaways();
    return run_of_parts(own_seeds);
}

fn samples_that_show(ray: Ray) -> vec2<i32> {
    own_run = samples_left(ray, own_box);
    return all_left(ray, run_of_parts(own_run));
}

// Aims a ray that goes on; the ends of cutaways are kept.
fn aim_again(ray: Ray) {
    aim_background(ray);
    own_seeds = seeds_left(ray, own_box);
    own_run = samples_left(ray, own_box);
}

// The first plane that can show or seed something of the background, within a span without parts.
fn next_of_background(run: vec2<i32>, span: Span, k: i32, next: i32) -> i32 {
    if (k < run.x) {
        return min(run.x, span.end + 1);
    }
    return select(min(next, span.end + 1), span.end + 1, k > run.y);
}

fn next_shown(ray: Ray, sample: Sample, last: i32) -> i32 {
    let span = span_from(sample.k, last);
    if (span.is_mixed) {
        return sample.k;
    }
    return next_of_background(own_run, span, sample.k, next_plane(ray, sample));
}

fn next_sown(ray: Ray, sample: Sample, last: i32) -> i32 {
    let span = span_from(sample.k, last);
    if (span.is_mixed) {
        return sample.k;
    }
    return next_of_background(own_seeds, span, sample.k, next_seed_plane(ray, sample));
}

fn looked_up(sample: Sample) -> Sample {
    return sample;
}

fn show_sample(ray: Ray, sample: Sample, tint: Tint, front: Front) -> Front {
    let found = together(sample.k);
    if (!(found.shaded.alpha > 0.0)) {
        return front;
    }
    let alpha = corrected(found.shaded.alpha, ray.step / params.reference_length * steps_of(sample.k));
    collect(ray, found.sample, found.a, alpha);
    return over(front, tinted(in_blend_space(found.shaded.rgb), tint), alpha);
}

fn sow_sample(ray: Ray, sample: Sample, place: i32) {
    is_sowing = true;
    sow_objects(sample.k);
    is_sowing = false;
    for (var halo = 0; halo < HALOS; halo++) {
        let s = seeds_together[halo];
        seeds_together[halo] = 0.0;
        if (s > 0.0 && s >= halos[halo].floor) {
            plant(halo, place, s);
        }
    }
}

fn add_seed(halo: i32, place: i32, s: real) {
    seeds_of_set[halo] = s;
}

// Takes in the seeds of a set: s = max over sets of min(mu of its selection set, s of the set), faded by a factor.
fn join_seeds(weight: real, factor: real) {
    for (var halo = 0; halo < HALOS; halo++) {
        seeds_together[halo] = max(seeds_together[halo], min(weight, seeds_of_set[halo] * factor));
        seeds_of_set[halo] = 0.0;
    }
}

// The seeds of the background's set, whose selection set has this membership; a cutaway fades them.
fn sow_background(k: i32, weight: real) {
    if (!(weight > 0.0) || k < own_seeds.x || k > own_seeds.y || is_ghosted_away(k) || !look_here(k)) {
        return;
    }
    here.place = node_place(locate_value(here.s));
    sow(own_ray, here, 0);
    var most = real(0.0);
    for (var halo = 0; halo < HALOS; halo++) {
        most = max(most, seeds_of_set[halo]);
    }
    var factor = real(1.0);
    if (most > 0.0 && is_before_cut(k)) {
        factor = ghosted(k, measured_rest(own_ray, here, measured_first(own_ray, here)));
    }
    join_seeds(weight, factor);
}
