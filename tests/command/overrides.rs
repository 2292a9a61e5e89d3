//! `--set`, and the flags that stand for scene keys.

use crate::folder::{Folder, SCENE};

#[test]
fn off_removes_a_table_as_if_the_file_had_none() {
    let folder = Folder::new();
    folder.scene("[contours]\nthickness = \"3 voxels\"\n");
    folder.write("plain.toml", SCENE);
    folder.good("render scene.toml -o with.png");
    folder.good("render scene.toml --set contours=off -o off.png");
    folder.good("render plain.toml -o plain.png");
    assert_ne!(folder.read("with.png"), folder.read("off.png"));
    assert_eq!(folder.read("plain.png"), folder.read("off.png"));
}

#[test]
fn a_value_goes_over_the_file_s() {
    let folder = Folder::new();
    folder.scene("");
    folder.write("other.toml", SCENE.replace("0.9", "0.25"));
    folder.good("render other.toml -o a.png");
    folder.good("render scene.toml --set transfer.nodes[1].opacity=0.25 -o b.png");
    assert_eq!(folder.read("a.png"), folder.read("b.png"));
    folder.good("render scene.toml --set picture.size=[9,9] --size 24x16 -o c.png");
    folder.good("render scene.toml -o d.png");
    assert_eq!(folder.read("c.png"), folder.read("d.png"), "a flag goes over --set");
}

#[test]
fn paths_of_set_are_relative_to_the_working_directory() {
    let folder = Folder::new();
    folder.torus();
    folder.write("sub/scene.toml", SCENE);
    folder.good("render sub/scene.toml --set volume.file=torus.nrrd");
    let said = folder.refused("render sub/scene.toml --set volume.file=gone.nrrd");
    let expected = "error: gone.nrrd is not there\n  at: --set volume.file=gone.nrrd, key volume.file\n  try: write another path; DRYPOINT_DATA lists no folder with it\n";
    assert_eq!(said, expected);
}

#[test]
fn a_volume_is_looked_for_in_the_folders_of_the_variable() {
    let folder = Folder::new();
    folder.torus();
    folder.write("data/far.nrrd", folder.read("torus.nrrd"));
    folder.write("sub/scene.toml", SCENE.replace("phantom = { name = \"torus\", size = 20 }", "file = \"far.nrrd\""));
    assert!(folder.refused("render sub/scene.toml").starts_with("error: sub/far.nrrd is not there\n"));
    let mut command = folder.command(["render", "sub/scene.toml"]);
    let list = std::env::join_paths([folder.path("empty"), folder.path("data")]).unwrap();
    assert!(command.env("DRYPOINT_DATA", list).output().unwrap().status.success());
}

#[test]
fn what_leads_nowhere_is_refused() {
    let folder = Folder::new();
    folder.scene("");
    for (line, expected) in [
        (
            "--set contours",
            "error: \"contours\" sets nothing\n  at: --set contours\n  try: write key=value, such as camera.fov=40, or contours=off\n",
        ),
        (
            "--set conturs=off",
            "error: a scene has no key \"conturs\"\n  at: --set conturs=off, key conturs\n  try: write \"contours\"; the keys here are drypoint, preset, light, volume, clip, camera, orbit, picture, page, pen, sampling, transfer, styles, shading, contours, style_mipmaps, halo, combine, object, intersection, stipples, hatching, outlines, surface, mesh, box, arrow, fan, label, labels, scale_bar, orientation, legend\n",
        ),
        (
            "--set camera.fov=x --set a --set b",
            "error: \"a\" sets nothing\n  at: --set a\n  try: write key=value, such as camera.fov=40, or contours=off\nerror: \"b\" sets nothing\n  at: --set b\n  try: write key=value, such as camera.fov=40, or contours=off\n",
        ),
        (
            "--set transfer.nodes[7].opacity=1",
            "error: there is no item 7 in a list of 2\n  at: --set transfer.nodes[7].opacity=1, key transfer.nodes[7].opacity\n  try: items count from 0\n",
        ),
        (
            "--size 0x16",
            "error: picture.size cannot be [0, 16]\n  at: --size 0x16\n  try: write a size [width, height], each a whole number from 1 to 1048576, at most 1073741824 pixels in all\n",
        ),
        (
            "--size 99999999999x99999999999",
            "error: picture.size cannot be [99999999999, 99999999999]\n  at: --size 99999999999x99999999999\n  try: write a size [width, height], each a whole number from 1 to 1048576, at most 1073741824 pixels in all\n",
        ),
        (
            "--layers part1",
            "error: there is no part1: the scene has 1 part, counted from 0\n  at: --layers part1\n  try: there is part0 (background)\n",
        ),
        ("--layers halo0", "error: there is no halo \"halo0\"\n  at: --layers halo0\n  try: there is no halo at all\n"),
        (
            "--preset stlye",
            "error: preset cannot be \"stlye\"\n  at: --preset stlye\n  try: write \"style\"; expected is \"style\", \"stipple\", \"stipple-fig1\", \"stipple-fig4\", \"stipple-fig5\", \"stipple-fig6\", \"stipple-fig7\", \"stipple-fig8\", \"stipple-fig9\", \"hatch\", \"hatch-fig4\", \"hatch-fig5\", \"hatch-fig6-left\", \"hatch-fig6-right\", \"outline\", \"toon\", \"hatch-fig2\", \"halo\", \"halo-glow\" or \"halo-lines\"\n",
        ),
    ] {
        assert_eq!(folder.refused(&format!("render scene.toml {line}")), expected, "{line}");
    }
}
