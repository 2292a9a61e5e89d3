// Gradients by central differences, for every kernel ([REC-2]).
// Glue: The gradient of samples by central differences.

fn index_gradient(at: Place) -> vec3<real> {
    return central_gradient(at);
}
