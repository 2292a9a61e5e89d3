//! Formula by formula: each function of the shaders runs over a table of inputs, random ones and hard cases, and is
//! compared with the reference's.

mod elementary;
mod field;
mod over_two;
mod styles;

use crate::gpu;
use drypoint::gpu::{Gpu, Kernel, Precision};
use std::fs;
use std::path::{Path, PathBuf};

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
    kernel: &Kernel<'_>,
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

/// The names of all functions of the shaders, each with its file.
fn functions() -> Vec<(String, PathBuf)> {
    fn walk(folder: &Path, found: &mut Vec<(String, PathBuf)>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                walk(&path, found);
            } else if path.extension().is_some_and(|suffix| suffix == "wgsl") {
                let text = fs::read_to_string(&path).unwrap();
                let names = text.lines().filter_map(|line| line.strip_prefix("fn ")?.split('(').next());
                found.extend(names.map(|name| (name.to_owned(), path.clone())));
            }
        }
    }
    let mut found = Vec::new();
    walk(&Path::new(env!("CARGO_MANIFEST_DIR")).join("gpu/src"), &mut found);
    found.sort();
    found
}
