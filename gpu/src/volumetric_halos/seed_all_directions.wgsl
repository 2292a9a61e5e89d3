// Seeds of all directions.

fn seed_direction(halo: i32, h: real, ray: Ray, a: Attributes) -> real {
    return h;
}
