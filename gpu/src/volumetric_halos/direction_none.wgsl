// Seeds of all directions.
// Twin: reference/src/volumetric_halos/direction.rs

fn seed_direction(halo: i32, h: real, ray: Ray, a: Attributes) -> real {
    return h;
}
