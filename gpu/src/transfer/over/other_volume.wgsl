// The value of a further volume at a sample's place in the world ([STF-4]).
// Twin: reference/src/transfer/over/other_volume.rs

// A component of the place on its grid: three factors and an offset, from `at` on.
fn further_component(at: i32, p: vec3<real>) -> real {
    return grid_numbers[at] * p.x + grid_numbers[at + 1] * p.y + grid_numbers[at + 2] * p.z + grid_numbers[at + 3];
}

// The place on its grid, if a sample has one.
struct FurtherPlace {
    is_there: bool,
    at: Place,
}

// The place of a position. The list begins with the map from the data's index space. Positions outside the box by less
// than the slack are moved to its border.
fn further_place(first: i32, dims: vec3<i32>, position: vec3<real>) -> FurtherPlace {
    let p = vec3<real>(
        further_component(first, position),
        further_component(first + 4, position),
        further_component(first + 8, position),
    );
    let flat = dims == vec3(1);
    let low = select(vec3<real>(), vec3<real>(-0.5), flat);
    let high = select(vec3<real>(dims - vec3(1)), vec3<real>(0.5), flat);
    let slack = vec3<real>(params.grid_slack);
    if (any(p < low - slack) || any(p > high + slack)) {
        return FurtherPlace();
    }
    let inside = min(max(p, low), high);
    let cell = vec3<i32>(floor(min(max(inside, vec3<real>()), vec3<real>(max(dims, vec3(2)) - vec3(2)))));
    return FurtherPlace(true, Place(cell, select(inside - vec3<real>(cell), vec3<real>(), flat)));
}

// The value, counted from the lowest of the volume, which holds outside its box.
fn further_value(first: i32, dims: vec3<i32>, position: vec3<real>) -> real {
    let place = further_place(first, dims, position);
    if (!place.is_there) {
        return 0.0;
    }
    return on_grid(first + 12, dims, place.at);
}
