// h_v: the opacity of a transfer function over two quantities ([HALO-2], [STF-4]). What it asks for becomes part of the
// attributes, of invisible samples too, which seed other halos.
// Twin: reference/src/volumetric_halos/seed.rs

fn ask_opacity(ray: Ray, sample: Sample) {
    seed_known = measured_first(ray, sample);
    if (sample.place.alpha_u > 0.0 && is_seen(ray, sample, seed_known)) {
        seed_alpha_u = node_patch.alpha_u;
    }
}
