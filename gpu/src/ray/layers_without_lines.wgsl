// No lines lie before samples.
// Twin: reference/src/ray/composite/layers.rs

fn left_by_lines() -> real {
    return 1.0;
}
