// What a sample is: its place, its value, its attributes, and what it shows.
// Glue: Types.

struct Sample {
    // The plane, counted from the anchor.
    k: i32,
    // Its way behind the plane, in steps.
    offset: real,
    position: vec3<real>,
    at: Place,
    // The value, in the units of the numbers.
    s: real,
    place: NodePlace,
}

// The attributes beyond the value. Those that the scene does not ask for keep their neutral values.
struct Attributes {
    // World gradient, times a power of two.
    gradient: vec3<real>,
    has_normal: bool,
    normal: vec3<real>,
    // |g| of [VAL-2].
    magnitude: real,
    // The scene's curvature; 0 where there is no normal.
    kappa: real,
    // The principal curvatures.
    principal: vec2<real>,
}

// A straight colour, and the opacity per reference length.
struct Shaded {
    rgb: vec3<real>,
    alpha: real,
}
