// Lines before a sample, which belong to no object, hide their part of its coverage.
// Twin: reference/src/ray/composite/layers.rs

fn left_by_lines() -> real {
    return through_lines;
}
