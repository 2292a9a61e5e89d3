// A material whose opacity nothing enhances ([VS-7]).

fn enhancement(ray: Ray, a: Attributes) -> real {
    return 0.0;
}
