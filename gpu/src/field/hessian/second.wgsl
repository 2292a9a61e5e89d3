// First and second derivatives of one field, which belong together ([REC-3], [CUR-1]).
// Glue: A type.

struct Second {
    // Along the index axes.
    gradient: vec3<real>,
    // The entries xx, yy, zz and yz, xz, xy.
    square: vec3<real>,
    mixed: vec3<real>,
}
