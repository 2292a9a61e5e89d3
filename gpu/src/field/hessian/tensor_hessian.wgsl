// Hessians of separable kernels ([REC-3]).
// Twin: reference/src/field/tensor.rs

// Gradient and Hessian along the index axes, by n taps along each axis; `cell` counts from the texture's border.
fn tensor_second(numbers: texture_3d<f32>, cell: vec3<i32>, n: i32, taps: array<Taps, 3>) -> Second {
    var w = taps;
    let corner = cell - vec3(n / 2 - 1);
    let first = texel_at(numbers, cell);
    var sum = Second();
    for (var k = 0; k < n; k++) {
        // Sums over y and x, named by the derivatives in (x, y).
        var s00 = real(0.0);
        var s10 = real(0.0);
        var s01 = real(0.0);
        var s20 = real(0.0);
        var s11 = real(0.0);
        var s02 = real(0.0);
        for (var j = 0; j < n; j++) {
            var row = vec3<real>();
            for (var i = 0; i < n; i++) {
                let c = texel_at(numbers, corner + vec3(i, j, k)) - first;
                row += c * vec3<real>(w[0].value[i], w[0].first[i], w[0].second[i]);
            }
            s00 += row.x * w[1].value[j];
            s10 += row.y * w[1].value[j];
            s20 += row.z * w[1].value[j];
            s01 += row.x * w[1].first[j];
            s11 += row.y * w[1].first[j];
            s02 += row.x * w[1].second[j];
        }
        let value = w[2].value[k];
        let slope = w[2].first[k];
        sum.gradient += vec3<real>(s10 * value, s01 * value, s00 * slope);
        sum.square += vec3<real>(s20 * value, s02 * value, s00 * w[2].second[k]);
        sum.mixed += vec3<real>(s01 * slope, s10 * slope, s11 * value);
    }
    return sum;
}
