// The mix of premultiplied lookups ([STF-3]).

fn to_mix(c: vec4<real>) -> vec4<real> {
    return c;
}

fn from_mix(c: vec4<real>) -> vec4<real> {
    return c;
}
