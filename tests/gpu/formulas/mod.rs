//! Formula by formula: each function of the shaders runs over a table of inputs, random ones and hard cases, and is
//! compared with the reference's.

mod elementary;
mod field;
mod halos;
mod lighting;
mod meshes;
mod over_two;
mod samples;
mod styles;
mod volumeshop;

use crate::gpu;
use drypoint::gpu::{Gpu, Precision, ShaderKernel};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The text of modules, by their paths in `gpu/src` without suffix.
pub(crate) fn modules(names: &[&str]) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("gpu/src");
    let text = |name: &&str| {
        let path = folder.join(format!("{name}.wgsl"));
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    };
    names.iter().map(text).collect::<Vec<_>>().join("\n")
}

/// The largest errors of a kernel's results against `truth`, in f64 and in f32. An error is measured in units of `scale`
/// of the row, the truth and the place of the result. Inputs are such that f32 holds them.
pub(crate) fn errors<const N: usize, const M: usize>(
    gpu: &Gpu,
    kernel: &ShaderKernel<'_>,
    table: &[[f64; N]],
    truth: impl Fn(&[f64; N]) -> [f64; M],
    scale: impl Fn(&[f64; N], &[f64; M], usize) -> f64,
) -> [f64; 2] {
    let rounded: Vec<[f64; N]> = table.iter().map(|row| row.map(|x| f64::from(x as f32))).collect();
    let flat: Vec<f64> = rounded.iter().flatten().copied().collect();
    [Precision::Double, Precision::Single].map(|precision| {
        if precision == Precision::Double && !gpu.has_double() {
            println!("skipped: {} has no f64", gpu.name());
            return 0.0;
        }
        let found = kernel.run(gpu, precision, N, &flat).unwrap_or_else(|error| panic!("{error}"));
        let mut largest: f64 = 0.0;
        for (row, found) in rounded.iter().zip(found.chunks_exact(M)) {
            let expected = truth(row);
            for i in 0..M {
                let error = (found[i] - expected[i]).abs() / scale(row, &expected, i);
                assert!(!error.is_nan(), "{row:?}: {} and {}", found[i], expected[i]);
                largest = largest.max(error);
            }
        }
        largest
    })
}

/// Numbers in [0, 1), the same in every run.
pub(crate) fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// The functions of the shaders: name, and text up to the next one.
fn functions() -> Vec<(String, String)> {
    fn walk(folder: &Path, suffix: &str, take: &mut dyn FnMut(String)) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                walk(&path, suffix, take);
            } else if path.extension().is_some_and(|found| found == suffix) {
                take(fs::read_to_string(&path).unwrap());
            }
        }
    }
    let mut found: Vec<(String, String)> = Vec::new();
    walk(&Path::new(env!("CARGO_MANIFEST_DIR")).join("gpu/src"), "wgsl", &mut |text| {
        for function in text.split("\nfn ").skip(1) {
            found.push((function.split('(').next().unwrap().to_owned(), function.to_owned()));
        }
    });
    // Alternatives have one name: the texts of all of them count.
    let mut merged = BTreeMap::<String, String>::new();
    found.into_iter().for_each(|(name, text)| merged.entry(name).or_default().push_str(&text));
    merged.into_iter().collect()
}

/// Functions without a table: those that only put others together, and those that read the volume. Pictures and planted
/// faults hold them.
const HELD_BY_PICTURES: &[&str] = &[
    "add_seed",
    "aim_again",
    "aim_background",
    "aim_image",
    "aim_objects",
    "aim_part",
    "aim_selection",
    "ask_before",
    "ask_opacity",
    "background_at",
    "background_set",
    "banded",
    "before_at",
    "begin_count",
    "begin_coverage",
    "begin_funnel",
    "begin_lines",
    "begin_sums",
    "begins_with_seeds",
    "between_nodes",
    "by_label",
    "can_be_inside",
    "can_glow",
    "cap_surface",
    "cap_surface_by_style",
    "cast_ray",
    "cast_samples",
    "clip_run",
    "collect_coverage",
    "collect_coverage_without_meshes",
    "collect_layers",
    "color_at",
    "color_of",
    "column_of",
    "composite",
    "composite_sample",
    "composite_share",
    "count_sample",
    "crosses",
    "cut_end",
    "cut_surface",
    "deal_meeting",
    "depth_of_plane",
    "difference",
    "difference_in",
    "difference_taps",
    "dilate",
    "displayed",
    "draw",
    "draw_pixel",
    "draw_refined",
    "end_at_surface",
    "end_count",
    "end_lines_at_surface",
    "end_plane",
    "enhancement",
    "enter_box",
    "eye_normal",
    "far_side",
    "farther_neighbours",
    "filtered",
    "find_depths",
    "find_fractions",
    "find_mesh",
    "find_shares",
    "find_surface",
    "first_color",
    "first_root",
    "flag_place",
    "foot_of",
    "forget_fractions",
    "forget_normal",
    "forget_sample",
    "forget_surface",
    "fraction_of_object",
    "front_of",
    "funnel_end",
    "ghosted",
    "glow_at",
    "gradient_at",
    "halo_group",
    "halo_pixels",
    "halo_planes",
    "halo_spread",
    "halo_start",
    "has_ended_loops",
    "has_line_before",
    "has_normal",
    "has_sample",
    "hull",
    "image_at",
    "image_pixel",
    "image_place",
    "image_point",
    "in_box",
    "index_second",
    "intensity_of",
    "is_alone",
    "is_at_edge",
    "is_before_cut",
    "is_crossed",
    "is_cut_away",
    "is_ghosted_away",
    "is_hidden",
    "is_in_image",
    "is_in_part",
    "is_in_picture",
    "is_in_selection",
    "is_inside_surface",
    "is_masked",
    "is_near_open",
    "is_open",
    "join_seeds",
    "keep_found",
    "keep_front",
    "last_before_surface",
    "last_member",
    "leave_planes",
    "leave_surface",
    "leaves_block",
    "left_by_lines",
    "light_background",
    "light_part",
    "line_from",
    "look_at_part",
    "look_here",
    "look_to_sow",
    "looked_up",
    "magnitude_in_range",
    "magnitude_of_gradient",
    "map_funnels",
    "mean_of",
    "measure_along_ray",
    "measure_along_ray_at_surface",
    "measure_curvature",
    "measure_cut",
    "measure_gradient",
    "measure_gradient_once",
    "measure_magnitude",
    "meet",
    "meet_end",
    "meet_line",
    "meet_lines_left",
    "meet_mesh",
    "meet_surface",
    "meeting",
    "meets_surface",
    "membership_at",
    "mesh_vector",
    "nearest_triangle",
    "neighbour_weight",
    "next_of_background",
    "next_shown",
    "next_sown",
    "no_samples",
    "node_color",
    "normal_of",
    "note_sample",
    "occlusion_of",
    "opacity_between",
    "own_steps",
    "part_membership",
    "part_set",
    "part_takes",
    "pass_brick",
    "pass_masked",
    "passed",
    "passes_of",
    "picture_size",
    "pixel_of",
    "pixel_of_tile",
    "place_of",
    "place_of_halo",
    "place_on",
    "place_part",
    "plane_at_depth",
    "plant",
    "planted_at",
    "point_of",
    "polar",
    "pool_coverage",
    "pool_sums",
    "position",
    "present",
    "ray_place",
    "ray_through",
    "rays_across",
    "refine",
    "refined_part",
    "resume_on_planes",
    "sample_on",
    "samples_inside",
    "samples_that_seed",
    "samples_that_show",
    "search_cell",
    "seed_column",
    "seed_direction",
    "seed_gradient",
    "seed_layer",
    "seed_place",
    "seeds_at",
    "seek",
    "seen_part",
    "selection_share",
    "set_flag",
    "set_open",
    "shade_mesh",
    "shade_style",
    "shade_surface_by_phong",
    "shade_surface_by_toon",
    "shade_surface_silhouette",
    "share_before_surface",
    "show_cap",
    "show_sample",
    "show_styled_cap",
    "side_of",
    "skip_brick",
    "skip_masked",
    "skip_seed_brick",
    "smooth_rows",
    "source_of",
    "sow",
    "sow_background",
    "sow_beside",
    "sow_part",
    "sow_sample",
    "span_within",
    "spread_tile",
    "square_at",
    "square_before",
    "start_ray",
    "steps_to",
    "sums_go_on",
    "surface_normal",
    "take_if_largest",
    "take_out_of_selections",
    "take_value",
    "taps_of",
    "tensor_second",
    "test",
    "through_box",
    "tile_of",
    "tile_state",
    "tint_at",
    "together",
    "triangle_word",
    "unlit_background",
    "unlit_part",
    "voxel_along",
];

/// A function is covered by a table if a test calls it, or a function that a test calls does.
#[test]
fn every_function_has_a_table_or_is_listed() {
    let mut tests = String::new();
    for entry in fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/gpu/formulas")).unwrap() {
        tests.push_str(&fs::read_to_string(entry.unwrap().path()).unwrap());
    }
    let functions = functions();
    let calls = |text: &str, name: &str| {
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        text.match_indices(&format!("{name}(")).any(|(at, _)| !text[..at].ends_with(is_word))
    };
    let mut covered: Vec<&str> =
        functions.iter().filter(|(name, _)| calls(&tests, name)).map(|(name, _)| name.as_str()).collect();
    let mut next = 0;
    while next < covered.len() {
        let text = functions.iter().find(|(name, _)| *name == covered[next]).map_or("", |(_, text)| text);
        let called = functions.iter().filter(|(name, _)| !covered.contains(&name.as_str()) && calls(text, name));
        let called: Vec<&str> = called.map(|(name, _)| name.as_str()).collect();
        covered.extend(called);
        next += 1;
    }
    let missing: Vec<&str> =
        functions.iter().map(|(name, _)| name.as_str()).filter(|name| !covered.contains(name)).collect();
    assert_eq!(missing, HELD_BY_PICTURES);
}
