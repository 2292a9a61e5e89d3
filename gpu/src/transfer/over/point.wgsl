// The distance to a point, in world units ([STF-4]).
// Twin: reference/src/transfer/over/point.rs

// `offset` leads from the point to voxel (0, 0, 0).
fn distance_from(position: vec3<real>, offset: vec3<real>) -> real {
    let way = world_axis_x() * position.x + world_axis_y() * position.y + world_axis_z() * position.z + offset;
    return sqrt(dot(way, way));
}
