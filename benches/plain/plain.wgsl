// A plain volume caster, as textbooks have it: fixed steps through the whole box, a table of colours, Phong shading with a light
// at the eye, early end. It skips nothing and proves nothing.

struct Params {
    eye: vec4<f32>,
    forward: vec4<f32>,
    right: vec4<f32>,
    up: vec4<f32>,
    dims: vec4<f32>,
    // ambient, diffuse, specular, shininess
    phong: vec4<f32>,
    // width, height, step in voxels, 1 if shaded
    picture: vec4<f32>,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var volume: texture_3d<f32>;
@group(0) @binding(2) var unit: sampler;
// Straight colour and the opacity of a step, for values from 0 to 1.
@group(0) @binding(3) var<storage, read> table: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read_write> picture: array<vec4<f32>>;

fn texel(i: vec3<i32>) -> f32 {
    return textureLoad(volume, clamp(i, vec3(0), vec3<i32>(params.dims.xyz) - 1), 0).r;
}

fn value(p: vec3<f32>) -> f32 {
    if (BY_UNIT) {
        return textureSampleLevel(volume, unit, (p + 0.5) / params.dims.xyz, 0.0).r;
    }
    let f = floor(p);
    let c = vec3<i32>(f);
    let w = p - f;
    let a = mix(texel(c), texel(c + vec3(1, 0, 0)), w.x);
    let b = mix(texel(c + vec3(0, 1, 0)), texel(c + vec3(1, 1, 0)), w.x);
    let d = mix(texel(c + vec3(0, 0, 1)), texel(c + vec3(1, 0, 1)), w.x);
    let e = mix(texel(c + vec3(0, 1, 1)), texel(c + vec3(1, 1, 1)), w.x);
    return mix(mix(a, b, w.y), mix(d, e, w.y), w.z);
}

fn gradient(p: vec3<f32>) -> vec3<f32> {
    let x = vec3(1.0, 0.0, 0.0);
    return 0.5 * vec3(
        value(p + x) - value(p - x),
        value(p + x.yxy) - value(p - x.yxy),
        value(p + x.yyx) - value(p - x.yyx),
    );
}

@compute @workgroup_size(8, 8)
fn draw(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = params.picture.xy;
    if (any(vec2<f32>(id.xy) >= size)) {
        return;
    }
    let off = vec2(f32(id.x) + 0.5 - 0.5 * size.x, 0.5 * size.y - f32(id.y) - 0.5);
    let d = normalize(params.forward.xyz + params.right.xyz * off.x + params.up.xyz * off.y);
    let a = -params.eye.xyz / d;
    let b = (params.dims.xyz - 1.0 - params.eye.xyz) / d;
    let low = min(a, b);
    let high = max(a, b);
    let near = max(max(low.x, low.y), max(low.z, 0.0));
    let far = min(high.x, min(high.y, high.z));
    let top = f32(arrayLength(&table) - 1);
    var seen = vec4<f32>();
    for (var t = near; t <= far; t += params.picture.z) {
        let p = params.eye.xyz + d * t;
        let at = value(p) * top;
        let i = u32(at);
        let shown = mix(table[i], table[min(i + 1, u32(top))], at - f32(i));
        if (shown.a <= 0.0) {
            continue;
        }
        var rgb = shown.rgb;
        if (params.picture.w > 0.0) {
            let g = gradient(p);
            let facing = abs(dot(g, d)) / max(length(g), 1e-12);
            rgb = rgb * (params.phong.x + params.phong.y * facing) + params.phong.z * pow(facing, params.phong.w);
        }
        seen += (1.0 - seen.a) * shown.a * vec4(rgb, 1.0);
        if (seen.a >= 0.999) {
            break;
        }
    }
    picture[id.y * u32(size.x) + id.x] = seen;
}
