// Toon shading: tones with hard steps, by the angle between normal and light (4.4, [HATCH-15]).

struct Tone {
    // The lower bound of L.N + offset; the first tone holds from minus infinity on.
    at: real,
    r: real,
    g: real,
    b: real,
}

@group(1) @binding(6) var<storage, read> tones: array<Tone>;

// A colour by the tone of a normal.
fn toon(c_u: vec3<real>, n: vec3<real>) -> vec3<real> {
    let x = dot(n, light()) + params.toon_offset;
    var found = 0;
    for (var i = 1; i < TONES; i++) {
        if (!(x > tones[i].at)) {
            break;
        }
        found = i;
    }
    return c_u * vec3<real>(tones[found].r, tones[found].g, tones[found].b);
}

// A sample without a normal has the tone of N = v ([PREC-3]).
fn shade_toon(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    return Shaded(toon(shaded.rgb, select(ray.v, a.normal, a.has_normal)), shaded.alpha);
}
