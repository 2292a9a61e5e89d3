// Notes a sample of the volume or of a part whose value is evaluated.
fn note_sample(sample: Sample) {
    visited(sample);
}
