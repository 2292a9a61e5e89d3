// Toon shading: tones with hard steps, by the angle between normal and light (4.4, [HATCH-15]).
// Twin: reference/src/interactive_volume_illustration/tone/toon.rs

struct Tone {
    // The lower bound of L.N + offset; the first tone holds from minus infinity on.
    at: real,
    r: real,
    g: real,
    b: real,
}

struct Toon {
    // L, towards the light.
    light: vec3<real>,
    offset: real,
    // The tones, from the first one up to the end.
    first: i32,
    end: i32,
}

@group(1) @binding(6) var<storage, read> tones: array<Tone>;

// A colour by the tone of a normal.
fn toon(c_u: vec3<real>, n: vec3<real>, lit: Toon) -> vec3<real> {
    let x = dot(n, lit.light) + lit.offset;
    var found = lit.first;
    for (var i = lit.first + 1; i < lit.end; i++) {
        if (!(x > tones[i].at)) {
            break;
        }
        found = i;
    }
    return c_u * vec3<real>(tones[found].r, tones[found].g, tones[found].b);
}

// A sample without a normal has the tone of N = v ([PREC-3]).
fn shaded_in_tones(ray: Ray, a: Attributes, shaded: Shaded, lit: Toon) -> Shaded {
    return Shaded(toon(shaded.rgb, select(ray.v, a.normal, a.has_normal), lit), shaded.alpha);
}
