// Contours that do not fade.
// Twin: reference/src/style_transfer_functions/contour.rs

fn contour_threshold(a: Attributes) -> real {
    return contour_tau(a);
}
