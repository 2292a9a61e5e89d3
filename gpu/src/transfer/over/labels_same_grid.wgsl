// Labels on the data's own grid ([STF-13]).
// Twin: reference/src/labels.rs

fn label_at(position: vec3<real>) -> u32 {
    return label_on_grid(position);
}
