// Sums of a separable kernel over the numbers around a cell ([REC-1]). They run over differences to the number at the
// cell's first voxel, so a constant field has exactly its value, and derivatives that are exactly 0.
// Twin: reference/src/field/tensor.rs

// Weights of a kernel's taps along one axis: for the value and for its derivatives. Kernels of four taps use the first four.
struct Taps {
    value: array<real, 6>,
    first: array<real, 6>,
    second: array<real, 6>,
}

// The number in a voxel of a texture.
fn texel_at(numbers: texture_3d<f32>, i: vec3<i32>) -> real {
    return number_of(textureLoad(numbers, i, 0));
}

// The sum of w_x w_y w_z c over n taps along each axis; `cell` counts from the texture's border.
fn tensor_value(numbers: texture_3d<f32>, cell: vec3<i32>, n: i32, taps: array<Taps, 3>) -> real {
    var w = taps;
    let corner = cell - vec3(n / 2 - 1);
    let first = texel_at(numbers, cell);
    var sum = real(0.0);
    for (var k = 0; k < n; k++) {
        var plane = real(0.0);
        for (var j = 0; j < n; j++) {
            var row = real(0.0);
            for (var i = 0; i < n; i++) {
                row += (texel_at(numbers, corner + vec3(i, j, k)) - first) * w[0].value[i];
            }
            plane += row * w[1].value[j];
        }
        sum += plane * w[2].value[k];
    }
    return first + sum;
}
