// A selection by the data's value ([VS-2]).
// Twin: reference/src/volumeshop/membership.rs

fn membership_at(steps: real, s: real) -> real {
    return locate_value(s).alpha_u;
}
