// Seeds that do not ask for the opacity.
// Twin: reference/src/volumetric_halos/seed.rs

fn ask_opacity(ray: Ray, sample: Sample) {
}
