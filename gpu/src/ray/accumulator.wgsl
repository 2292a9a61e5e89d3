// The one over ([VAL-3]).
// Twin: reference/src/accumulator.rs

// Premultiplied colour and opacity of what lies in front.
struct Front {
    rgb: vec3<real>,
    opacity: real,
}

// Lays a straight colour of opacity alpha behind what is there: w = (1 - A) alpha, C + w c, A + w.
fn over(front: Front, rgb: vec3<real>, alpha: real) -> Front {
    let w = (1.0 - front.opacity) * alpha;
    return Front(front.rgb + w * rgb, front.opacity + w);
}

// Lays an opaque straight colour behind what is there.
fn opaque_behind(front: Front, rgb: vec3<real>) -> Front {
    return Front(front.rgb + (1.0 - front.opacity) * rgb, 1.0);
}

// Lays a premultiplied colour behind what is there ([IO-6]).
fn over_premultiplied(front: Front, behind: vec4<real>) -> Front {
    let through = 1.0 - front.opacity;
    return Front(front.rgb + through * behind.rgb, front.opacity + through * behind.a);
}
