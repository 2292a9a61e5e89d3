// Occlusive halos: the tint of samples behind them (3.3, [HALO-7]).
// Twin: reference/src/volumetric_halos/halo_planes.rs

// A mix of colours with those of halos: c <- keep c + add, in the blend space.
struct Tint {
    keep: real,
    add: vec3<real>,
}

fn tinted(rgb: vec3<real>, tint: Tint) -> vec3<real> {
    return tint.keep * rgb + tint.add;
}

// Mixes a colour in, after the ones before: c <- (1 - m) c + m c_h.
fn mix_in(tint: Tint, rgb: vec3<real>, m: real) -> Tint {
    return Tint((1.0 - m) * tint.keep, (1.0 - m) * tint.add + m * rgb);
}

// The tint of all occlusive halos at a place of the images, or of those that tint the halo `of_halo`. The first of the list is
// mixed last.
fn tint_at(place: i32, of_halo: i32) -> Tint {
    var tint = Tint(1.0, vec3<real>());
    for (var i = HALOS - 1; i >= 0; i--) {
        if (halos[i].is_occlusive == 0.0) {
            continue;
        }
        let o = occlusion_of(i, place);
        if (!(o > 0.0) || (of_halo >= 0 && halo_numbers[i32(halos[i].first_tint) + of_halo] == 0.0)) {
            continue;
        }
        let color = profile_at(i, o);
        if (color.a > 0.0) {
            tint = mix_in(tint, color.rgb, color.a);
        }
    }
    return tint;
}
