// Masked cells are not inside an iso-surface ([PREC-2]).
// Glue: A choice of the mask.

fn can_be_inside(cell: vec3<i32>) -> bool {
    return !is_masked(cell);
}
