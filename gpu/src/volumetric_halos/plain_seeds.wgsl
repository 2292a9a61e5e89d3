// Seeds as they are; 0 beyond the border.
// Glue: A choice of the median.

fn seeds_at(x: i32, y: i32, layer: i32) -> vec4<real> {
    if (x < 0 || y < 0 || x >= IMAGE_X || y >= IMAGE_Y) {
        return vec4<real>();
    }
    return seed_image[layer + y * IMAGE_X + x];
}
