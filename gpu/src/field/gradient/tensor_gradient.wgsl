// Gradients of separable kernels ([REC-2]).
// Twin: reference/src/field/tensor.rs

// The gradient along the index axes, by n taps along each axis; `cell` counts from the texture's border.
fn tensor_gradient(numbers: texture_3d<f32>, cell: vec3<i32>, n: i32, taps: array<Taps, 3>) -> vec3<real> {
    var w = taps;
    let corner = cell - vec3(n / 2 - 1);
    let first = texel_at(numbers, cell);
    var sum = vec3<real>();
    for (var k = 0; k < n; k++) {
        var plane = vec3<real>();
        for (var j = 0; j < n; j++) {
            // Sums along x: of the value, and of the derivative.
            var s0 = real(0.0);
            var s1 = real(0.0);
            for (var i = 0; i < n; i++) {
                let c = texel_at(numbers, corner + vec3(i, j, k)) - first;
                s0 += c * w[0].value[i];
                s1 += c * w[0].first[i];
            }
            plane += vec3<real>(s1 * w[1].value[j], s0 * w[1].first[j], s0 * w[1].value[j]);
        }
        sum += vec3<real>(plane.x * w[2].value[k], plane.y * w[2].value[k], plane.z * w[2].first[k]);
    }
    return sum;
}
