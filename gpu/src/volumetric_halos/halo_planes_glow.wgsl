// Emissive halos: the glow behind a plane (3.3, [HALO-7]).
// Twin: reference/src/volumetric_halos/halo_planes.rs

// Whether an emissive halo has an intensity at a place of the images.
fn can_glow(place: i32) -> bool {
    for (var i = 0; i < HALOS; i++) {
        if (halos[i].is_occlusive == 0.0 && intensity_of(i, place) > 0.0) {
            return true;
        }
    }
    return false;
}

// The premultiplied glow of all emissive halos at a place of the images, for one plane; the first one lies in front. A ray
// takes `ratio` reference lengths from plane to plane ([VAL-4]).
fn glow_at(place: i32, ratio: real) -> vec4<real> {
    var front = Front();
    for (var i = 0; i < HALOS; i++) {
        if (halos[i].is_occlusive == 1.0) {
            continue;
        }
        let color = profile_at(i, intensity_of(i, place));
        if (color.a > 0.0) {
            front = over(front, tinted(color.rgb, tint_at(place, i)), corrected(color.a, ratio));
        }
    }
    return vec4<real>(front.rgb, front.opacity);
}
