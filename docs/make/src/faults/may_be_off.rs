//! Multiplications whose results may be 1 % too large without a difference beyond rounding, and why.

use super::planting::Multiplication;

const SERIES: &str = "a last term of a series: 1 % of it is below eight last places of f64";
const GUARD: &str = "a margin against rounding: a box that is passed closely counts as met, and its triangle decides";

const PLACE: &str = "a place in a list, of integers, when a picture is shown in a window";
const SKIPPED: &str = "fewer planes are passed over, and those between show nothing";
const ALIKE: &str = "all weights grow alike, and their sums are only compared with each other";
const CLEAR: &str = "guards a division: a set is there only where one of its objects has an opacity";
const SEARCH: &str = "another step to the same root";
const EXTREMA: &str = "parts of a cubic end beside its extrema: only two roots that all but touch lie in one part";
const GUESS: &str = "a first cell, from which the right one is found step by step";
const BESIDE: &str = "a bound of 2⁻²⁶, below which a normal along v has no direction in the picture";
const SIGN: &str = "only its sign is used";
const DOTS: &str = "draws no picture: hidden dots, which `tests/gpu/points.rs` compares";

/// A module, a part of its line around the operator, and the reason.
const MAY_BE_OFF: &[(&str, &str, &str)] = &[
    ("field/gradient/central_filtered", "0.5 * (between", "in `gpu-fast` alone, which has no bounds"),
    ("mesh/end", ")) * found.weights", "the sum becomes a vector of length 1"),
    ("mesh/tree", "params.mesh_slack * (abs", GUARD),
    ("mesh/tree", "params.mesh_slack * abs(enter)", GUARD),
    ("mesh/tree", "params.mesh_slack * abs(leave)", GUARD),
    ("number/math", "sum * q + 1.0 / 21.0", SERIES),
    ("number/math", "sum * q + 1.0 / 19.0", SERIES),
    ("number/math", "sum * q - 1.0 / 19.0", SERIES),
    ("number/math", "sum * q + 1.0 / 17.0", SERIES),
    ("number/math", "sum * q + 1.0 / 15.0", SERIES),
    ("number/math", "sum * r + 1.0 / 6227020800.0", SERIES),
    ("number/math", "sum * r + 1.0 / 479001600.0", SERIES),
    ("number/math", "sum * r + 1.0 / 39916800.0", SERIES),
    ("number/math", "y * LOG2_E", "the range is reduced by another whole number, and the rest makes up for it"),
    ("ray/brick_occupancy", "ray.along * ray", SKIPPED),
    ("ray/present", "pixel.y * size.x", PLACE),
    ("ray/present", ") * CHANNELS", PLACE),
    ("surface/cubic", "2.0 * d1 + d2", EXTREMA),
    ("surface/cubic", "d1 * d1 - d0", EXTREMA),
    ("surface/cubic", "d0 * d2", EXTREMA),
    ("surface/cubic_bracket", "0.5 * (hi - lo)", SEARCH),
    ("surface/cubic_bracket", "(hi - lo) * (left", SEARCH),
    ("surface/cubic_bracket", "right * 0.5", SEARCH),
    ("surface/cubic_bracket", "left * 0.5", SEARCH),
    ("surface/first_root_stepped", ")) * (leaves", SEARCH),
    ("surface/first_root_stepped", "* 4.0", SEARCH),
    ("surface/first_root_stepped", "(leaves - enters) * (real", SEARCH),
    ("surface/first_root_stepped", "before * side_of", SIGN),
    ("surface/first_root_trilinear", "before * side_of", SIGN),
    ("surface/traversal", "walk.along[a] * enters.t", GUESS),
    ("transfer/over/labels_smooth", "w.x * w.y", ALIKE),
    ("transfer/over/labels_smooth", "w.y * w.z", ALIKE),
    ("volume_stippling/hidden", "line.along * t", DOTS),
    ("volume_stippling/hidden", "voxel_x() * n.x", DOTS),
    ("volume_stippling/hidden", "voxel_y() * n.y", DOTS),
    ("volume_stippling/hidden", "voxel_z() * n.z", DOTS),
    ("volume_stippling/hidden", "voxel_along(out) * params", DOTS),
    ("volume_stippling/hidden_clipped", "line.along * kept", DOTS),
    ("volumeshop/sets_fractions", "mu * 0.5", CLEAR),
    ("volumetric_halos/direction", "n.x * n.x + n.y", BESIDE),
    ("volumetric_halos/direction", "n.y * n.y) <=", BESIDE),
    ("volumetric_halos/seed_bricks", "ray.along[axis] * ray", SKIPPED),
];

/// The entries of the list that stand for no multiplication.
pub(super) fn unused(all: &[Multiplication]) -> impl Iterator<Item = String> {
    let is_used = |(module, part): (&str, &str)| all.iter().any(|fault| is_at(fault, module, part));
    let unused = MAY_BE_OFF.iter().filter(move |(module, part, _)| !is_used((module, part)));
    unused.map(|(module, part, _)| format!("{module}.wgsl: no multiplication is {part}"))
}

/// The reason why no scene need notice a fault.
pub(super) fn reason(fault: &Multiplication) -> Option<&'static str> {
    let entry = MAY_BE_OFF.iter().find(|(module, part, _)| is_at(fault, module, part));
    entry.map(|(.., reason)| *reason)
}

/// Whether a part of a line has the multiplication as its first one.
fn is_at(fault: &Multiplication, module: &str, part: &str) -> bool {
    let operator = part.find('*').unwrap_or_default();
    fault.module == module && fault.text.match_indices(part).any(|(at, _)| at + operator == fault.column)
}
