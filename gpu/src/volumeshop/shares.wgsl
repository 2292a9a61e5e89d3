// Selection sets at a place (eq. 1; [VS-3]): how the background and the selections in it share what is there.
// Twin: reference/src/volumeshop/shares.rs

// f of each object that is a selection and taken from the background; 0 of the others.
var<private> memberships: array<real, OBJECTS>;

// The membership of the background's selection set, and the factor of each f.
struct Shares {
    background: real,
    of_each: real,
}

// The shares beside the selections. Zadeh: 1 - max f, and f. Product: max(0, 1 - sum f), and f / max(1, sum f).
fn shares_beside() -> Shares {
    var all = real(0.0);
    for (var i = 0; i < OBJECTS; i++) {
        all = select(max(all, memberships[i]), all + memberships[i], PRODUCT);
    }
    if (PRODUCT) {
        return Shares(max(1.0 - all, 0.0), 1.0 / max(all, 1.0));
    }
    return Shares(1.0 - all, 1.0);
}
