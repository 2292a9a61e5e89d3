// Masked cells contain no surface ([PREC-2]).
// Glue: Cells that are passed over.

fn pass_masked(cell: vec3<i32>) -> i32 {
    return select(0, 1, is_masked(cell));
}
