// Colours over two quantities ([STF-4]).
// Glue: A choice of the function.

fn node_color(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    var rgb = color_at(node_patch.below);
    if (node_patch.w != 0.0) {
        rgb = lerp3(rgb, color_at(node_patch.above), node_patch.w);
    }
    return Shaded(rgb, node_patch.alpha_u);
}
