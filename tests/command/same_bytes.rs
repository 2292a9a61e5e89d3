//! The same bytes on every machine: hashes of a small file of each kind of output. An ARM build of the command writes
//! them too, under `qemu-aarch64`.

use crate::folder::Folder;
use sha2::{Digest, Sha256};
use std::process::Command;

/// Scenes, of which each has the lines that all share before its own.
const SCENES: &[(&str, &str)] = &[
    (
        "styles",
        "[picture]\nsize = [40, 30]\nlayers = [\"beauty\", \"Z\", \"normal\", \"curvature.KV\", \"counts\"]\n[sampling]\nkernel = \"bspline\"\n\
         [transfer]\nnodes = [{ at = 90, style = \"wax\", opacity = 0 }, { at = 160, style = \"bone\", opacity = 0.7 }]\n\
         [contours]\nthickness = \"1 voxel\"\n",
    ),
    (
        "labels",
        "labels = \"labels.nrrd\"\n[picture]\nsize = [40, 30]\n[camera]\nprojection = \"perspective\"\n\
         [transfer]\nkind = \"regular\"\nover = [\"value\", \"label\"]\n\
         rows = [{ at = [7], nodes = [{ at = 90, color = \"#e0c080\", opacity = 0 }, { at = 160, color = \"#e0c080\", opacity = 0.5 }] }, \
         { at = [9], nodes = [{ at = 90, color = \"#4080c0\", opacity = 0 }, { at = 160, color = \"#4080c0\", opacity = 0.5 }] }]\n",
    ),
    (
        "phong",
        "[picture]\nsize = [40, 30]\nsamples = 2\nblend_space = \"linear\"\n[transfer]\nkind = \"regular\"\nnodes = [{ at = 90, color = \"#e0c080\", opacity = 0 }, { at = 160, color = \"#c04020\", opacity = 0.6 }]\n\
         [shading]\nmodel = \"phong\"\n",
    ),
    (
        "surface",
        "[picture]\nsize = [40, 30]\nbits = 16\nbackground = \"#f0e8d8\"\n\
         [sampling]\nnumber = \"f32\"\ngradient = \"regression\"\n[surface]\niso = 120\nlook = \"toon\"\n",
    ),
    (
        "stipples",
        "[picture]\nwidth = \"40 mm\"\nheight = \"30 mm\"\ndpi = 100\n[stipples]\nk_max = 0.2\n[stipples.curves]\n",
    ),
    (
        "strokes",
        "[picture]\nwidth = \"40 mm\"\nheight = \"30 mm\"\ndpi = 100\n[hatching]\niso = 120\nwidth = \"0.3 mm\"\n[outlines]\niso = 120\n",
    ),
];

/// The files, what writes them, and the SHA-256 of their bytes.
const FILES: &[(&str, &str, &str)] = &[
    ("default.png", "render --size 48x36", "40e980049ac6450806f5362791233d3fddc1a6e41ce54314692f9acf8b6ab999"),
    ("styles.exr", "render styles.toml", "e91927de1fcdb1e9dd2cecafedddf831526d46fd1f4bd2fde1ec5dc6169ef4fc"),
    ("labels.exr", "render labels.toml", "4c140080bd17747e4aa6bb8d9df06d577ed9c5edcfaa3dd278d777acf8874397"),
    ("phong.exr", "render phong.toml", "6850685d47654ad861b3aebd1b33068d76fa64450a13572db54bc1c456a17dc1"),
    ("surface.png", "render surface.toml", "c1c6e2e4e7603045576bacd68fd1a0e238e4d08409eb0694f0703774628c8a76"),
    ("stipples.svg", "points stipples.toml", "64c6415ee3291863c4e403bf913ad873eab34236cb75483e96704e04dabf5efb"),
    ("stipples.csv", "points stipples.toml", "e898c543bd9685d69982ed67389b58b7e4e52befd0d0d58e9254b68e91fc07c6"),
    ("strokes.svg", "strokes strokes.toml", "c5aa798db358e6798b53a1b00510f7e85fddc661d3f2a14aa59a8737b5d6c84f"),
    ("strokes.pdf", "strokes strokes.toml", "cedb38b79d079c2cca331deb05058c346118343f4cea0f05e2629362355b63a8"),
    ("strokes.png", "strokes strokes.toml", "3b7380cdd85ce492d08af7d9702f622e912a195add12cb33baacb2c581f1b9d3"),
    ("strokes.jsonl", "strokes strokes.toml", "a4328ee23f71973e17fdfc1b2f2493b5fc04c82f0c74423b4b661c6ebc426b5a"),
    (
        "phantom.nrrd",
        "phantom marschner-lobb --size 20 --type f32",
        "89d738014ac49658815c002862a40945616a37e78032a7a88a928ee1f2c1e3dd",
    ),
];

/// Writes all files with a command that runs the binary, and returns their hashes.
fn hashes(run: impl Fn(&Folder) -> Command) -> Vec<String> {
    let folder = Folder::new();
    let labels: Vec<u8> = (0..24 * 24 * 24).map(|i| if i % 24 < 12 { 7 } else { 9 }).collect();
    let head = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 24 24 24\nspacings: 1 1 1\nencoding: raw\n\n";
    folder.write("labels.nrrd", [head.as_bytes(), &labels].concat());
    for (name, own) in SCENES {
        let shared = "drypoint = 1\n[volume]\nphantom = { name = \"torus\", size = 24 }\n";
        folder.write(&format!("{name}.toml"), format!("{shared}{own}"));
    }
    let hash = |(name, line, _): &(&str, &str, &str)| {
        let said = run(&folder).args(line.split(' ')).args(["-o", name, "-q"]).output().unwrap();
        assert!(said.status.success(), "{name}: {}", String::from_utf8_lossy(&said.stderr));
        Sha256::digest(folder.read(name)).iter().map(|byte| format!("{byte:02x}")).collect()
    };
    FILES.iter().map(hash).collect()
}

fn check(found: &[String], machine: &str) {
    let lines = FILES.iter().zip(found).map(|((name, line, _), hash)| format!("    ({name:?}, {line:?}, {hash:?}),\n"));
    let expected: Vec<&str> = FILES.iter().map(|(_, _, hash)| *hash).collect();
    assert!(found == expected, "on {machine} the files have the hashes\n{}", lines.collect::<String>());
}

#[test]
fn on_this_machine() {
    check(&hashes(|folder| folder.command([""; 0])), "this machine");
}

/// `DRYPOINT_ARM` names the command as built for aarch64-unknown-linux-gnu; `.ci/run` builds it.
#[test]
fn on_arm_under_qemu() {
    let Some(arm) = std::env::var_os("DRYPOINT_ARM") else {
        println!("skipped: DRYPOINT_ARM names no ARM build of the command");
        return;
    };
    let run = |folder: &Folder| {
        let mut command = Command::new("qemu-aarch64");
        command.args(["-L", "/usr/aarch64-linux-gnu"]).arg(&arm).current_dir(folder.path(""));
        command
    };
    check(&hashes(run), "aarch64");
}
