// Samples in masked cells show nothing ([PREC-2]).
// Glue: Samples that are passed over.

fn skip_masked(ray: Ray, sample: Sample) -> i32 {
    return sample.k + select(0, 1, is_masked(sample.at.cell));
}
