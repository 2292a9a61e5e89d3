// Notes a sample of the volume or of a part whose value is evaluated.
// Glue: A choice of halos.
fn note_sample(sample: Sample) {
    visited(sample);
}
