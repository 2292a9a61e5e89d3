// A material whose opacity nothing enhances ([VS-7]).
// Twin: reference/src/volumeshop/ghosting.rs

fn enhancement(ray: Ray, a: Attributes) -> real {
    return 0.0;
}
