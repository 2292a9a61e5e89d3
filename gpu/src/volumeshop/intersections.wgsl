// Intersection transfer functions (eqs. 6, 7; [VS-4]): the colour and the opacity of places where two objects meet.
// Twin: reference/src/volumeshop/intersections.rs

// The opacity from both opacities, after Porter and Duff (1984): a the selection's, b the other's.
fn opacity_of_both(preset: i32, a: real, b: real) -> real {
    switch preset {
        case 0: { return clamp_01(max(a, b)); }
        case 1: { return clamp_01(1.0 - (1.0 - a) * (1.0 - b)); }
        case 2: { return clamp_01(a * b); }
        case 3: { return clamp_01(a * (1.0 - b)); }
        case 4: { return clamp_01(b); }
        case 5: { return clamp_01(a * (1.0 - b) + b * (1.0 - a)); }
        default: { return clamp_01(min(a + b, 1.0)); }
    }
}

// The mean of two colours by their opacities, and an opacity; transparent where both are.
fn mean_color(a: Shaded, b: Shaded, alpha: real) -> Shaded {
    let sum = a.alpha + b.alpha;
    if (!(sum > 0.0)) {
        return Shaded();
    }
    return Shaded((a.rgb * a.alpha + b.rgb * b.alpha) / sum, alpha);
}

// A colour, and its opacity times another one.
fn of_color(rgb: vec3<real>, alpha: real, opacity: real) -> Shaded {
    return Shaded(rgb, opacity * alpha);
}
