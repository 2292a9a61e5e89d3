// The halos of a picture ([HALO-1]).
// Glue: A buffer.

// The parameters of a halo. Lists lie in `halo_numbers`, from a first number on.
struct Halo {
    // 1 for occlusive halos, 0 for emissive ones.
    is_occlusive: real,
    // M, and 1 where seeds come together as their mean.
    every: real,
    is_mean: real,
    // Seeds: h_v (0: one, 1: the opacity, 2: nodes), nodes, labels, points and their distances, directions.
    value: real,
    first_node: real,
    nodes: real,
    first_label: real,
    labels: real,
    first_point: real,
    points: real,
    inner: real,
    falloff: real,
    has_direction: real,
    toward_x: real,
    toward_y: real,
    half_width: real,
    softness: real,
    // a; 1 for seeds by curvature; b or T; the largest |n.v|.
    gradient_exponent: real,
    by_curvature: real,
    side: real,
    most_frontal: real,
    floor: real,
    // Spreading: delta, 1 for the gradient, 1 for a median before.
    delta: real,
    from_gradient: real,
    has_median: real,
    // The profile: nodes and the factor of opacities.
    first_profile: real,
    profile: real,
    opacity: real,
    // A number for each halo: 1 for those that this one tints.
    first_tint: real,
}

@group(1) @binding(30) var<storage, read> halos: array<Halo>;
@group(1) @binding(31) var<storage, read> halo_numbers: array<real>;
