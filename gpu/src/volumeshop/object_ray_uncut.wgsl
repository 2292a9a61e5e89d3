// A ray without cutaways ([VS-7]).
// Twin: reference/src/ray/composite/object_ray.rs

fn is_before_cut(k: i32) -> bool {
    return false;
}

fn is_ghosted_away(k: i32) -> bool {
    return false;
}

fn ghosted(k: i32, a: Attributes) -> real {
    return 1.0;
}
