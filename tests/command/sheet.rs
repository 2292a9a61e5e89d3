//! `sheet`.

use crate::folder::Folder;
use drypoint::output::read::read_image;

#[test]
fn volumes_scenes_and_pictures_stand_on_one() {
    let folder = Folder::new();
    folder.torus();
    folder.scene("");
    folder.good("render scene.toml -o a.png");
    let said = folder.line("sheet torus.nrrd scene.toml a.png -o sheet.png --cell 32 --columns 3");
    assert_eq!((said.code, said.err.as_str()), (Some(0), "sheet.png\n"));
    let image = read_image(&folder.path("sheet.png")).unwrap();
    // Three cells of 32 with margins of 8.
    assert_eq!(image.width, 8 + 3 * (32 + 8));
    let bytes = folder.read("sheet.png");
    folder.good("sheet torus.nrrd scene.toml a.png -o sheet.png --cell 32 --columns 3");
    assert_eq!(folder.read("sheet.png"), bytes);
}

/// A scene keeps its shape: 24×16 in a cell of 48 is 48×32, as the same picture rendered in that size.
#[test]
fn a_scene_fills_its_cell_in_its_own_shape() {
    let folder = Folder::new();
    folder.scene("");
    folder.good("render scene.toml --size 48x32 -o a.png");
    folder.good("sheet scene.toml -o by_scene.png --cell 48");
    folder.good("sheet a.png -o by_picture.png --cell 48");
    let compared = folder.line("compare by_scene.png by_picture.png --json");
    let json: serde_json::Value = serde_json::from_str(&compared.out).unwrap();
    // The labels differ; the picture was quantized once more, by half a step of 8 bits at the most.
    let [a, b] = ["by_scene.png", "by_picture.png"].map(|name| read_image(&folder.path(name)).unwrap());
    let rows = (8 + 32) * a.width;
    let most = (0..rows).map(|i| (a.channels[0].1[i] - b.channels[0].1[i]).abs()).fold(0.0, f64::max);
    assert!(most <= 1.0 / 255.0, "{most} {json}");
}

#[test]
fn what_is_not_there_is_told_before_any_work() {
    let folder = Folder::new();
    folder.torus();
    let suffixes = "check the path; scenes end in .toml, volumes in .nrrd, .nhdr, .nii, .nii.gz, .hdr, .hdr.gz, .img, .img.gz, .mhd, .mha, .raw, .raw.gz";
    let what = "the file cannot be read: No such file or directory (os error 2)";
    assert_eq!(
        folder.refused("sheet torus.nrrd gone.toml gone.png -o sheet.png"),
        format!(
            "error: {what}\n  at: gone.toml\n  try: {suffixes}\nerror: {what}\n  at: gone.png\n  try: {suffixes}\n"
        )
    );
    folder.good("render torus.nrrd --size 8x8 --layers Z -o depth.exr");
    assert_eq!(
        folder.refused("sheet depth.exr -o sheet.png"),
        "error: the picture has no channels R, G and B; it has Z\n  at: depth.exr\n  try: give a picture with colours\n"
    );
    let said = folder.refused("sheet torus.nrrd -o sheet.png --cell 5");
    assert!(said.starts_with("error: invalid value '5' for '--cell <CELL>': 5 is not in 16..=4096\n"), "{said}");
}
