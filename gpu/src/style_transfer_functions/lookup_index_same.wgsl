// Node k has style k (M = N), for which the paper skips the lookup ([STF-3]).
// Twin: reference/src/style_transfer_functions/lookup.rs

fn style_of(node: i32) -> i32 {
    return node;
}
