// h_v: the opacity of the transfer function ([HALO-2]).
// Twin: reference/src/volumetric_halos/seed.rs

fn ask_opacity(ray: Ray, sample: Sample) {
    seed_alpha_u = sample.place.alpha_u;
}
