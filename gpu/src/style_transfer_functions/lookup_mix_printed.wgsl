// The mix of straight colour and opacity as 4.1 prints it ([STF-3]): a transparent style still lends its colour.
// Twin: reference/src/style_transfer_functions/lookup.rs

fn to_mix(c: vec4<real>) -> vec4<real> {
    return unpremultiply(c);
}

fn from_mix(c: vec4<real>) -> vec4<real> {
    return premultiply(c);
}
