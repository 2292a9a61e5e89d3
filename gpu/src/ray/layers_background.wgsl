// The volume alone is all that a sample shows.
// Twin: reference/src/ray/composite/layers.rs

fn fraction_of_object(object: i32, k: i32) -> real {
    return select(real(0.0), real(1.0), object == 0);
}
