// Gradients by central differences, for every kernel ([REC-2]).

fn index_gradient(at: Place) -> vec3<real> {
    return central_gradient(at);
}
