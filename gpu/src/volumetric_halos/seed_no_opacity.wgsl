// Seeds that do not ask for the opacity.

fn ask_opacity(ray: Ray, sample: Sample) {
}
