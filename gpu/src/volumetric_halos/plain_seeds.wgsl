// Seeds as they are; 0 beyond the border.
// Glue: A choice of the median.

fn seeds_at(at: vec2<i32>, halo: i32, layer: i32) -> real {
    return planted_at(at, layer);
}
