// The median of 3 x 3 seeds, which takes single pixels away before they spread ([HALO-4]).
// Twin: reference/src/volumetric_halos/median.rs

// A column of three in order: its least number, its median and its largest one.
struct Column {
    least: real,
    median: real,
    largest: real,
}

fn median_of_three(a: real, b: real, c: real) -> real {
    return max(min(a, b), min(max(a, b), c));
}

fn ordered_column(a: real, b: real, c: real) -> Column {
    return Column(min(min(a, b), c), median_of_three(a, b, c), max(max(a, b), c));
}

// The median of the largest of three least, the median of three medians, and the least of three largest.
fn median_of_nine(a: Column, b: Column, c: Column) -> real {
    return median_of_three(
        max(max(a.least, b.least), c.least),
        median_of_three(a.median, b.median, c.median),
        min(min(a.largest, b.largest), c.largest),
    );
}

fn seed_column(at: vec2<i32>, layer: i32) -> Column {
    return ordered_column(
        planted_at(at - vec2(0, 1), layer),
        planted_at(at, layer),
        planted_at(at + vec2(0, 1), layer),
    );
}

// Filtered seeds, or seeds as they are; 0 beyond the border.
fn seeds_at(at: vec2<i32>, halo: i32, layer: i32) -> real {
    if (halos[halo].has_median == 0.0 || !is_in_image(at)) {
        return planted_at(at, layer);
    }
    return median_of_nine(
        seed_column(at - vec2(1, 0), layer),
        seed_column(at, layer),
        seed_column(at + vec2(1, 0), layer),
    );
}
