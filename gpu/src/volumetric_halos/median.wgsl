// The median of 3 x 3 seeds, which takes single pixels away before they spread ([HALO-4]).
// Twin: reference/src/volumetric_halos/median.rs

// The filtered seeds; 0 beyond the border.
fn seeds_at(x: i32, y: i32, layer: i32) -> vec4<real> {
    return before_at(x, y, layer);
}

fn seeds_before_median(x: i32, y: i32, layer: i32) -> vec4<real> {
    if (x < 0 || y < 0 || x >= IMAGE_X || y >= IMAGE_Y) {
        return vec4<real>();
    }
    return seed_image[layer + y * IMAGE_X + x];
}

// A column of three in order: its least number, its median and its largest one.
struct Column {
    least: vec4<real>,
    median: vec4<real>,
    largest: vec4<real>,
}

fn median_of_three(a: vec4<real>, b: vec4<real>, c: vec4<real>) -> vec4<real> {
    return max(min(a, b), min(max(a, b), c));
}

fn ordered_column(a: vec4<real>, b: vec4<real>, c: vec4<real>) -> Column {
    return Column(min(min(a, b), c), median_of_three(a, b, c), max(max(a, b), c));
}

// The median of the largest of three least, the median of three medians, and the least of three largest.
fn median_of_nine(a: Column, b: Column, c: Column) -> vec4<real> {
    return median_of_three(
        max(max(a.least, b.least), c.least),
        median_of_three(a.median, b.median, c.median),
        min(min(a.largest, b.largest), c.largest),
    );
}

fn seed_column(x: i32, y: i32, layer: i32) -> Column {
    return ordered_column(
        seeds_before_median(x, y - 1, layer),
        seeds_before_median(x, y, layer),
        seeds_before_median(x, y + 1, layer),
    );
}

@compute @workgroup_size(8, 8)
fn halo_median(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_id) own: vec3<u32>) {
    let at = vec3(listed_pixel(group, own), i32(group.z));
    if (at.x >= IMAGE_X || at.y >= IMAGE_Y) {
        return;
    }
    let layer = at.z * (IMAGE_X * IMAGE_Y);
    let median = median_of_nine(
        seed_column(at.x - 1, at.y, layer),
        seed_column(at.x, at.y, layer),
        seed_column(at.x + 1, at.y, layer),
    );
    var result = seeds_before_median(at.x, at.y, layer);
    for (var c = 0; c < min(4, HALOS - 4 * at.z); c++) {
        result[c] = select(result[c], median[c], halos[4 * at.z + c].has_median == 1.0);
    }
    image_after[layer + at.y * IMAGE_X + at.x] = result;
}
