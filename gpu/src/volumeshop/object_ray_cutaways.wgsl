// Cutaways on a ray: the background before objects is removed or fades ([VS-7]).
// Twin: reference/src/ray/composite/object_ray.rs

// The first sample that each cutaway leaves.
var<private> cut_ends: array<i32, CUTAWAYS>;

// The first sample that a cutaway leaves, which ends at a plane.
fn cut_end(plane: real) -> i32 {
    return i32(ceil(plane));
}

// Whether a cutaway fades the background at sample k.
fn is_before_cut(k: i32) -> bool {
    for (var i = 0; i < CUTAWAYS; i++) {
        if (k < cut_ends[i]) {
            return true;
        }
    }
    return false;
}

// Whether a cutaway removes the background at sample k.
fn is_ghosted_away(k: i32) -> bool {
    for (var i = 0; i < CUTAWAYS; i++) {
        if (k < cut_ends[i] && ghosting_of(i) >= 1.0) {
            return true;
        }
    }
    return false;
}

// The factor by which cutaways fade the background at sample k.
fn ghosted(k: i32, a: Attributes) -> real {
    var factor = real(1.0);
    if (is_before_cut(k)) {
        let e = enhancement(own_ray, a);
        for (var i = 0; i < CUTAWAYS; i++) {
            if (k < cut_ends[i]) {
                factor *= ghosting_factor(ghosting_of(i), e);
            }
        }
    }
    return factor;
}
