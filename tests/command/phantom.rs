//! `phantom`.

use crate::folder::Folder;

#[test]
fn every_phantom_is_listed_and_can_be_written_and_read() {
    let folder = Folder::new();
    let list = folder.good("phantom --list");
    let names: Vec<&str> = list.lines().filter(|line| !line.starts_with(' ')).collect();
    assert!(names.contains(&"torus") && names.contains(&"marschner-lobb") && names.len() >= 15, "{list}");
    for name in names {
        folder.good(&format!("-q phantom {name} --size 9,8,7 --type f32 -o a.nrrd"));
        assert!(folder.good("info a.nrrd").contains("dims       9 × 8 × 7"), "{name}");
    }
    assert_eq!(folder.line("phantom torus --size 4 -o b.nrrd").err, "b.nrrd\n");
}

#[test]
fn what_cannot_be_is_refused() {
    let folder = Folder::new();
    let names = "sphere, ellipsoid, torus, cylinder, plane, saddle, monkey-saddle, marschner-lobb, hydrogen, shepp-logan, shells, tube-tree, machined-part, noise, white-noise, constant, specimen";
    for (line, expected) in [
        (
            "tors",
            format!("error: invalid value 'tors' for '[NAME]' [possible values: {names}]\n  at: drypoint phantom\n  try: write torus; `drypoint phantom --help` tells what there is\n"),
        ),
        (
            "torus --type u9",
            "error: invalid value 'u9' for '--type <TYPE>' [possible values: u8, i8, u16, i16, u32, i32, u64, i64, f32, f64]\n  at: drypoint phantom\n  try: `drypoint phantom --help` tells what there is\n".into(),
        ),
        (
            "torus --param Q=3",
            "error: phantom `torus` has no parameter `Q`, did you mean `R`?; parameters: R, r, w, high\n  at: drypoint phantom torus\n  try: `drypoint phantom --list` lists phantoms and parameters\n".into(),
        ),
        (
            "torus --param R",
            "error: invalid value 'R' for '--param <K=V>': a parameter is a name and a number, such as R=40\n  at: drypoint phantom\n  try: `drypoint phantom --help` tells what there is\n".into(),
        ),
        (
            "torus --size 4,5",
            "error: 2 numbers for three axes\n  at: --size\n  try: give one, or three as X,Y,Z\n".into(),
        ),
        (
            "torus --size 0",
            "error: axis 0 has no voxels\n  at: drypoint phantom torus\n  try: give other numbers with --size or --spacing\n".into(),
        ),
    ] {
        assert_eq!(folder.refused(&format!("phantom {line} -o a.nrrd")), expected, "{line}");
    }
    let said = folder.refused("phantom torus --size 1000000 --type f64 -o a.nrrd");
    assert!(
        said.starts_with("error: 1000000 × 1000000 × 1000000 voxels need 7450580596.93 GiB of memory, and "),
        "{said}"
    );
    assert!(said.ends_with("  at: drypoint phantom torus\n  try: ask for fewer voxels with --size\n"), "{said}");
    assert_eq!(
        folder.refused("phantom torus -o a.png"),
        "error: a phantom is written as NRRD\n  at: a.png\n  try: give a name that ends in .nrrd\n"
    );
}
