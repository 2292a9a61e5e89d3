// Contours that do not fade.

fn contour_threshold(a: Attributes) -> real {
    return contour_tau(a);
}
