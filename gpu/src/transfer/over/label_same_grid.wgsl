// Labels on the data's own grid ([STF-13]).

fn label_at(position: vec3<real>) -> u32 {
    return label_on_grid(position);
}
