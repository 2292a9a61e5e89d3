//! Faults in the shaders of halos, each of which parts the pictures. Multiplications have theirs in
//! `docs/planted-faults.md`.

use crate::double;
use crate::halos::{FIVE, scene};

/// The least difference that counts as noticed.
const NOTICED: f64 = 1e-4;

/// A fault: the text that is there, the text in its place, keys of the picture, further tables.
type Fault<'a> = (&'a str, &'a str, &'a str, &'a str);

/// Checks that each of some faults is noticed.
fn check(faults: &[Fault<'_>]) {
    let mut missed = Vec::new();
    for (old, new, picture, tables) in faults {
        let Some(found) = double::difference_with(&scene(picture, tables), (old, new)) else { return };
        println!("{new:?}: {found:.1e}");
        if found < NOTICED {
            missed.push(format!("{old} → {new}: {found:e}"));
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

#[test]
fn faults_of_planes_and_tiles_are_noticed() {
    check(&[
        // Planes: one too few, the glow of the plane before, a sample of the next plane, groups that end early.
        (
            "own.next = select(after, k + 1, after == k);",
            "own.next = select(after, k + 2, after == k);",
            "",
            "[[halo]]\n",
        ),
        ("let has_step = k == own.next;", "let has_step = k == own.next + 1;", "", "[[halo]]\n"),
        (
            "return group_of(k + 1, every) != group_of(k, every);",
            "return group_of(k + 2, every) != group_of(k + 1, every);",
            "",
            "[[halo]]\nevery = 4\n",
        ),
        (
            "next_seed = select(after_seed, k + 1, after_seed == k);",
            "next_seed = select(after_seed, k + 2, after_seed == k);",
            "",
            "[[halo]]\nevery = 4\n",
        ),
        ("measured_plane != sample.k", "measured_plane == -NO_PLANE", "", "[[halo]]\nevery = 4\n"),
        // Tiles: out of reach, images that keep what was there, rays that are open.
        (
            "let other = tile - plane_group.tile_reach",
            "let other = tile",
            "",
            "[[halo]]\n[sampling]\nstep = \"0.5 voxel\"\n",
        ),
        (
            "i32(state.seeded) < planes - 1",
            "i32(state.seeded) < planes",
            "",
            "[[halo]]\nkind = \"emissive\"\nseed.focus = { at = [[8, 10, 15]], inner = 9, falloff = 0 }\nspread.passes = 2\nprofile = [{ at = 0, color = \"red\", opacity = 0.5 }]\n",
        ),
        (
            "select(0u, 1u, state.open_near > visited)",
            "select(0u, 1u, state.open_near > visited + 1u)",
            "",
            "[[halo]]\n",
        ),
        ("is_last && state.open <= visited", "is_last && state.open <= visited + 1u", "", "[[halo]]\n"),
        ("seed_layer(halo, planes - 1))] = 0.0;", "seed_layer(halo, planes - 1))] *= 1.0;", "", "[[halo]]\n"),
        ("max(occlusion_image[place], h)", "h", "", "[[halo]]\n"),
        // Images in the memory of workgroups: too narrow a margin, a pass over one that is still read.
        ("margin += taps.j + farther_neighbours(taps);", "margin = taps.j;", "", "[[halo]]\n"),
        (
            "let after = square_before(exponent - 1, halo, tile, free);",
            "let after = square_before(exponent - 1, halo, tile, 0);",
            "",
            "[[halo]]\nspread.passes = 6\n",
        ),
    ]);
}

#[test]
fn faults_of_seeds_are_noticed() {
    check(&[
        // Seeds: the sign of n·v, exponents, kappa, M's division, a maximum in place of a mean, the floor.
        (
            "abs(dot(a.normal, ray.v)), a.magnitude",
            "dot(a.normal, ray.v), a.magnitude",
            "",
            "[[halo]]\nseed.direction = { toward = 0, width = 300 }\n",
        ),
        ("before + s / halos[halo].every", "before + s", "", "[[halo]]\nevery = 4\naccumulate = \"mean\"\n"),
        ("select(max(before, s), before", "select(s, before", "", "[[halo]]\nevery = 4\n"),
        ("return select(s, real(0.0), s < halos[halo].floor);", "return s;", "", "[[halo]]\nfloor = 0.3\n"),
        ("select(result, real(0.0), result < halos[halo].floor)", "result", "", "[[halo]]\nfloor = 0.3\n"),
        ("let shifted = at - plane_group.guard", "let shifted = at + 1 - plane_group.guard", "", "[[halo]]\n"),
        // Factors of seeds: a swapped axis, an angle's side, a distance to a line in place of a segment.
        (
            "t = clamp_01(dot(p - a, along) / square);",
            "t = dot(p - a, along) / square;",
            "",
            "[[halo]]\nseed.focus = { at = [[5, 6, 7], [12, 10, 9]], inner = 6, falloff = 7 }\n",
        ),
        (
            "return 1.0 - beyond / falloff;",
            "return beyond / falloff;",
            "",
            "[[halo]]\nseed.focus = { at = [[20, 10, 15]], inner = 4, falloff = 8 }\n",
        ),
        ("seed_alpha_u = sample.place.alpha_u;", "seed_alpha_u = 1.0;", "", "[[halo]]\n"),
        (
            "lerp(halo_numbers[at + 2], halo_numbers[at + 3]",
            "lerp(halo_numbers[at + 3], halo_numbers[at + 2]",
            "",
            "[[halo]]\nseed.value = [[100, 0], [128, 1], [140, 0]]\n",
        ),
    ]);
}

#[test]
fn faults_of_spreading_are_noticed() {
    check(&[
        // Gradient, median and spreading: weights of taps, a swapped axis, distances, fractions, the mix.
        ("vec2(0, 1), taps)", "vec2(1, 0), taps)", "", "[[halo]]\n"),
        (
            "median_of_three(a.median, b.median, c.median)",
            "a.median",
            "",
            "[[halo]]\nspread.median = true\nexponents = [0.2, 2]\n",
        ),
        ("SOURCE_STAGE + 1) + 2 * exponent + 1", "SOURCE_STAGE + 1) + 1", "", "[[halo]]\n"),
        (
            "return select(1.0 - taps.f, taps.f, farther == 1);",
            "return 1.0 - taps.f;",
            "",
            "[[halo]]\nspread.reach = \"31 %\"\n",
        ),
        ("min(plane_group.from_stage, passes_of(halo) - 1)", "min(plane_group.from_stage, 3)", "", FIVE),
    ]);
}

#[test]
fn faults_of_profiles_and_layers_are_noticed() {
    check(&[
        // Profiles, tints and glows: the order of mixing, weights, what tints what.
        (
            "next - 1);\n        color",
            "next);\n        color",
            "",
            "[[halo]]\nprofile = [{ at = 0, color = \"black\", opacity = 0 }, { at = 1, color = \"red\" }]\n",
        ),
        (
            "for (var i = HALOS - 1; i >= 0; i--)",
            "for (var i = 0; i < HALOS; i++)",
            "",
            "[[halo]]\nprofile = [{ at = 0, color = \"red\", opacity = 0.5 }]\n[[halo]]\n",
        ),
        ("halo_numbers[i32(halos[i].first_tint) + of_halo] == 0.0", "true", "", FIVE),
        ("corrected(color.a, ratio)", "color.a", "", "[[halo]]\nkind = \"emissive\"\n"),
        (
            "own.front = over_premultiplied(own.front, own.glow);",
            "own.front = own.front;",
            "",
            "[[halo]]\nkind = \"emissive\"\n",
        ),
        ("tinted(in_blend_space(shaded.rgb), tint)", "in_blend_space(shaded.rgb)", "", "[[halo]]\n"),
        (
            "tinted(end.rgb, tint)",
            "end.rgb",
            "",
            "[[halo]]\nprofile = [{ at = 0, color = \"red\", opacity = 0.5 }]\n[surface]\niso = 132\n",
        ),
        (
            "return select(last_before_surface() + 1, NO_PLANE",
            "return select(last_before_surface() + 9, NO_PLANE",
            "",
            "[[halo]]\nkind = \"emissive\"\n[surface]\niso = 132\n",
        ),
        // Layers and pixels.
        (
            "max(ray_numbers[ray_place(RAY_KEPT + 21, number)], intensity_of(0, place))",
            "intensity_of(0, place)",
            "layers = [\"beauty\", \"halo0\"]",
            "[[halo]]\n",
        ),
        (
            "ray_sums.is_met = ray_sums.first.depth < NOWHERE;",
            "ray_sums.is_met = false;",
            "layers = [\"beauty\", \"first\"]",
            "[[halo]]\n",
        ),
        ("let at = pixel * n + vec2(part % n, part / n);", "let at = pixel * n;", "samples = 2", "[[halo]]\n"),
    ]);
}
