// The samples of a picture without objects: each shows and seeds by the volume alone.
// Glue: The samples of a picture, to show and to seed.

fn aim_image(at: vec2<i32>) {
}

fn samples_that_seed(ray: Ray) -> vec2<i32> {
    return seeds_left(ray, samples_inside(ray));
}

fn samples_that_show(ray: Ray) -> vec2<i32> {
    return samples_left(ray, samples_inside(ray));
}

// Aims a ray that goes on.
fn aim_again(ray: Ray) {
    forget_sample();
}

// The first plane from a sample on that can show something, and that can seed.
fn next_shown(ray: Ray, sample: Sample, last: i32) -> i32 {
    return next_plane(ray, sample);
}

fn next_sown(ray: Ray, sample: Sample, last: i32) -> i32 {
    return next_seed_plane(ray, sample);
}

fn looked_up(sample: Sample) -> Sample {
    var found = sample;
    found.s = value_at(sample.at);
    found.place = node_place(locate_value(found.s));
    return found;
}

fn show_sample(ray: Ray, sample: Sample, tint: Tint, front: Front) -> Front {
    visited(sample);
    return composite_sample(ray, sample, tint, front);
}

fn sow_sample(ray: Ray, sample: Sample, place: i32) {
    sow(ray, sample, place);
}

fn add_seed(halo: i32, place: i32, s: real) {
    plant(halo, place, s);
}
