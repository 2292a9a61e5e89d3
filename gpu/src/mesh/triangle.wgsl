// The intersection of a ray with a triangle, watertight (Woop, Benthin and Wald 2013; [VS-12]).
// Twin: reference/src/mesh/triangle.rs

// A ray turned so that it runs along the third axis: axes are permuted so that its largest component comes last, and corners
// are sheared along it. A corner has the same coordinates in every triangle that has it.
struct ShearedRay {
    origin: vec3<real>,
    axes: vec3<i32>,
    // along.x/along.z, along.y/along.z and 1/along.z.
    shear: vec3<real>,
}

// A place in a triangle: the plane counted from the anchor with its fraction, and weights of the corners of the sum 1.
struct TriangleHit {
    is_met: bool,
    t: real,
    weights: vec3<real>,
}

// The ray origin + t along.
fn sheared_ray(origin: vec3<real>, along: vec3<real>) -> ShearedRay {
    let size = abs(along);
    var z = 0;
    if (size.y > size.x) {
        z = 1;
    }
    if (size.z > size[z]) {
        z = 2;
    }
    let axes = vec3((z + 1) % 3, (z + 2) % 3, z);
    let inverse = 1.0 / along[z];
    return ShearedRay(origin, axes, vec3<real>(along[axes.x] / along[z], along[axes.y] / along[z], inverse));
}

// The first two coordinates of a point, and its distance along the third axis.
fn sheared(line: ShearedRay, point: vec3<real>) -> vec3<real> {
    let p = point - line.origin;
    let z = p[line.axes.z];
    return vec3<real>(p[line.axes.x] - line.shear.x * z, p[line.axes.y] - line.shear.y * z, z);
}

// Twice the area that the ray spans with an edge. The ends are taken in one order and by one expression, so that the triangle
// on the other side of the edge has exactly the negative, even where a driver fuses a product with the difference.
fn edge_area(p: vec3<real>, q: vec3<real>) -> real {
    let is_ordered = p.x < q.x || (p.x == q.x && p.y < q.y);
    let first = select(q, p, is_ordered);
    let second = select(p, q, is_ordered);
    let area = second.x * first.y - second.y * first.x;
    return select(-area, area, is_ordered);
}

// The place at which the ray crosses a triangle, edges and corners included, from either side. None for a triangle without
// an area as the ray sees it.
fn triangle_hit(line: ShearedRay, corner_a: vec3<real>, corner_b: vec3<real>, corner_c: vec3<real>) -> TriangleHit {
    let a = sheared(line, corner_a);
    let b = sheared(line, corner_b);
    let c = sheared(line, corner_c);
    let areas = vec3<real>(edge_area(b, c), edge_area(c, a), edge_area(a, b));
    let sum = areas.x + areas.y + areas.z;
    if ((any(areas < vec3<real>()) && any(areas > vec3<real>())) || sum == 0.0) {
        return TriangleHit();
    }
    let weights = areas / sum;
    return TriangleHit(true, dot(weights, vec3<real>(a.z, b.z, c.z)) * line.shear.z, weights);
}
