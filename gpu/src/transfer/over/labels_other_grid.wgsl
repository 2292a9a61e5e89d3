// Labels on another grid of the same world ([STF-13]).
// Twin: reference/src/labels.rs

// The id at a position of the data's index space; 0 outside the box of the labels. Positions outside it by less than
// the slack are moved to its border.
fn label_at(position: vec3<real>) -> u32 {
    let p = to_labels_x() * position.x + to_labels_y() * position.y + to_labels_z() * position.z + to_labels();
    if (any(p < label_reach_low()) || any(p > label_reach_high())) {
        return 0u;
    }
    return label_on_grid(min(max(p, label_box_low()), label_box_high()));
}
