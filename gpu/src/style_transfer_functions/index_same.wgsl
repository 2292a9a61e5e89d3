// Node k has style k (M = N), for which the paper skips the lookup ([STF-3]).

fn style_of(node: i32) -> i32 {
    return node;
}
