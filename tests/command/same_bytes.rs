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
    ("default.png", "render --size 48x36", "5b3e2c6e1619c6343e37eecec06d42966db15824840e0a1a3949b768c701e03f"),
    ("styles.exr", "render styles.toml", "5269dbea9a6eeed3fc51a2bdb8761d1e4977beb383aa5130ab74c9e47d48c974"),
    ("labels.exr", "render labels.toml", "631202d00cc188b8c1d80b6b003853b829e9e61164e0a6090d3431f73209b236"),
    ("phong.exr", "render phong.toml", "a08be2efd242851f301ffce9a7bce1f9af17f2375715387fbfa00ab1aaddc948"),
    (
        "phong.gif",
        "render phong.toml --set orbit.frames=3",
        "d8d35e99e088e70b9ae1d4476ce088677116be08714c1a0f5393df1ad897819c",
    ),
    ("surface.png", "render surface.toml", "47900a6245a86baf78ffb631b586d3009df2ca16f46cc1f06f316ecd9f253fac"),
    ("stipples.svg", "points stipples.toml", "0d2de84835cc79f51db6b70057ad763963919d7ab6b59f14142f544c5d910319"),
    ("stipples.csv", "points stipples.toml", "e898c543bd9685d69982ed67389b58b7e4e52befd0d0d58e9254b68e91fc07c6"),
    ("strokes.svg", "strokes strokes.toml", "9dbdd481a6ec90d1bebc4508651210c83fec74bac3ea9a5081016bf4e7fc7375"),
    ("strokes.pdf", "strokes strokes.toml", "decef8e9fbf135fceb56744fa868ad117ede7845b47da5c8eeabae3a48f146ac"),
    ("strokes.png", "strokes strokes.toml", "02c255faf0b3b9f047247e4cc294c488670996bcd14d11402528e71c2adeaa9d"),
    ("strokes.jsonl", "strokes strokes.toml", "596b5da7b0df44c5b896c1c6a88fe16c88a60acd019593a451c2f95cc0ab67a6"),
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

/// `DRYPOINT_ARM` names the command as built for aarch64-unknown-linux-gnu; `.ci/targets` builds it.
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
