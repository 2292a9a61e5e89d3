//! Input that cannot be rendered: what is said, that nothing is written, and exit code 2.

use crate::folder::{Folder, SCENE};

/// A folder with good and bad volumes.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.torus();
    let torus = folder.read("torus.nrrd");
    folder.write("cut.nrrd", &torus[..torus.len() / 2]);
    folder.write("torus.nii", &torus);
    folder.write("text.nrrd", "hello world");
    let header = |sizes: &str| {
        format!("NRRD0004\ntype: uint8\ndimension: 3\nsizes: {sizes}\nencoding: raw\nspacings: 1 1 1\n\n12345678")
    };
    folder.write("wide.nrrd", header("4294967296 4294967296 4294967296"));
    folder.write("large.nrrd", header("1000 1000 1000"));
    folder.write("empty.nrrd", "");
    std::fs::create_dir(folder.path("folder.nrrd")).unwrap();
    std::fs::create_dir(folder.path("folder")).unwrap();
    folder
}

#[test]
fn volumes() {
    let folder = folder();
    for (name, expected) in [
        (
            "text.nrrd",
            "error: this is not an NRRD file: it begins with `hello wo`, expected NRRD000\n  at: text.nrrd\n  try: check that the suffix says what the file holds\n",
        ),
        (
            "torus.nii",
            "error: this is not a NIfTI file: it begins with `NRRD0004`, expected the length of its header, 348 or 540\n  at: torus.nii, field sizeof_hdr\n  try: check that the suffix says what the file holds\n",
        ),
        (
            "wide.nrrd",
            "error: dims [4294967296, 4294967296, 4294967296] overflow\n  at: wide.nrrd, line 4, field sizes\n  try: correct the sizes or the axis directions in the header\n",
        ),
        (
            "large.nrrd",
            "error: the data are too short: found 8 bytes, expected 1000000000\n  at: large.nrrd, field sizes\n  try: get the file again, or correct the sizes and the type in the header\n",
        ),
        (
            "empty.nrrd",
            "error: this is not an NRRD file: it begins with ``, expected NRRD000\n  at: empty.nrrd\n  try: check that the suffix says what the file holds\n",
        ),
        ("folder.nrrd", "error: this is not a regular file\n  at: folder.nrrd\n  try: give a file that may be read\n"),
        (
            "missing.nrrd",
            "error: the file cannot be read: No such file or directory (os error 2)\n  at: missing.nrrd\n  try: check the path\n",
        ),
    ] {
        assert_eq!(folder.refused(&format!("render {name} -o out.png")), expected, "{name}");
        assert_eq!(folder.refused(&format!("info {name}")), expected, "{name}");
        assert_eq!(folder.refused(&format!("probe {name} --at 1,1,1")), expected, "{name}");
    }
    // How much of a damaged stream can be decoded is the decoder's affair.
    let said = folder.refused("render cut.nrrd -o out.png");
    let [what, place, remedy] = said.lines().collect::<Vec<_>>()[..] else { panic!("{said}") };
    assert!(what.starts_with("error: the data are too short: found ") && what.ends_with(" bytes, expected 110592"));
    assert_eq!(place, "  at: cut.nrrd, field sizes");
    assert_eq!(remedy, "  try: get the file again, or correct the sizes and the type in the header");
}

#[test]
fn neither_a_scene_nor_a_volume() {
    let folder = folder();
    folder.write("notes.txt", "hello");
    let suffixes = "scenes end in .toml, volumes in .nrrd, .nhdr, .nii, .nii.gz, .hdr, .hdr.gz, .img, .img.gz, .mhd, .mha, .raw, .raw.gz";
    for (name, what, remedy) in [
        ("folder", "a folder is neither a scene nor a volume", "give a file that is in it: "),
        ("missing", "the file cannot be read: No such file or directory (os error 2)", "check the path; "),
    ] {
        let expected = format!("error: {what}\n  at: {name}\n  try: {remedy}{suffixes}\n");
        assert_eq!(folder.refused(&format!("render {name} -o out.png")), expected);
        assert_eq!(folder.refused(&format!("plan {name}")), expected);
    }
}

#[test]
fn raw_voxels_of_another_suffix_are_told_of_the_flag() {
    let folder = folder();
    folder.write("notes.txt", "hello");
    for line in ["render notes.txt -o out.png", "plan notes.txt", "points notes.txt -o out.svg"] {
        let said = folder.refused(line);
        let [what, place, remedy] = said.lines().collect::<Vec<_>>()[..] else { panic!("{said}") };
        assert_eq!([what, place], ["error: the suffix is neither that of a scene nor of a volume", "  at: notes.txt"]);
        assert!(remedy.starts_with("  try: check the path; scenes end in .toml, volumes in .nrrd, "), "{said}");
        assert!(remedy.ends_with("; --raw or a file notes.txt.toml describes raw voxels of any other"), "{said}");
    }
}

#[test]
fn dicom_is_told_what_converts_it() {
    let folder = folder();
    folder.write("slice.dcm", "");
    folder.write("IM0001", [&[0; 128][..], b"DICM"].concat());
    folder.write("scene.toml", "drypoint = 1\n[volume]\nfile = \"slice.dcm\"\n");
    for (name, place) in [("slice.dcm", "slice.dcm"), ("IM0001", "IM0001"), ("scene.toml", "slice.dcm")] {
        let expected = format!(
            "error: this is a DICOM file, and DICOM is not read yet\n  at: {place}\n  try: convert its series to .nii.gz or \
             .nrrd first: dcm2niix, 3D Slicer and ITK-SNAP do that\n"
        );
        assert_eq!(
            folder.refused(&format!("render ./{name} -o out.png")),
            expected.replace("at: ", "at: ./"),
            "{name}"
        );
        if name != "scene.toml" {
            assert_eq!(folder.refused(&format!("info {name}")), expected);
            assert_eq!(folder.refused(&format!("sheet {name} -o out.png")), expected);
        }
    }
}

#[test]
fn a_folder_of_dicom_is_told_what_converts_it() {
    let folder = folder();
    std::fs::create_dir(folder.path("series")).unwrap();
    folder.write("series/IM0001", [&[0; 128][..], b"DICM"].concat());
    let expected = "error: this is a folder of DICOM files, and DICOM is not read yet\n  at: series\n  try: convert its \
                    series to .nii.gz or .nrrd first, such as with dcm2niix -z y -o . series; 3D Slicer and ITK-SNAP do \
                    that, too\n";
    for line in ["render series -o out.png", "info series", "plan series", "points series -o out.svg"] {
        assert_eq!(folder.refused(line), expected, "{line}");
    }
}

#[test]
fn files_that_are_no_scene() {
    let folder = folder();
    folder.write("junk.toml", [0xff, 0x00, 0x9c, 0xfe, b'\n', 0x80]);
    folder.write("empty.toml", "");
    folder.write("broken.toml", "drypoint = 1\n[volume\nfile = \"torus.nrrd\n");
    std::fs::create_dir(folder.path("folder.toml")).unwrap();
    for (name, expected) in [
        (
            "junk.toml",
            "error: the scene cannot be read: it is not text in UTF-8\n  at: junk.toml\n  try: check the file's name and that it is text in UTF-8\n",
        ),
        (
            "empty.toml",
            "error: drypoint is missing\n  at: empty.toml:1:1, key drypoint\n  try: write drypoint = 1, the version of the format that this program reads\n\
             error: the scene is a template: it names no volume\n  at: empty.toml:1:1, key volume\n  try: name a volume after the scene on the command line or by volume of a figure's panel, or write file = \"…\" or phantom = { name = \"…\" } in [volume]\n",
        ),
        (
            "broken.toml",
            "error: not TOML: unclosed table, expected `]`\n  at: broken.toml:2:8\n  try: correct this line: key = value, texts in quotes, tables as [name]\n",
        ),
        (
            "folder.toml",
            "error: the scene cannot be read: Is a directory (os error 21)\n  at: folder.toml\n  try: check the file's name and that it is text in UTF-8\n",
        ),
        (
            "missing.toml",
            "error: the scene cannot be read: No such file or directory (os error 2)\n  at: missing.toml\n  try: check the file's name and that it is text in UTF-8\n",
        ),
    ] {
        assert_eq!(folder.refused(&format!("render {name} -o out.png")), expected, "{name}");
    }
}

#[test]
fn every_fault_of_a_scene_is_told_at_once() {
    let folder = folder();
    folder.write(
        "scene.toml",
        "drypoint = 1\n[volume]\nfile = \"gone.nrrd\"\nrang = [0, 1]\n[camera]\nfov = \"wide\"\n[picture]\nbackground = \
         \"behind.png\"\n[transfer]\nnodes = [{ at = 1, style = \"metall\" }]\n[[mesh]]\nfile = \"plate.ply\"\n",
    );
    let expected = "\
error: gone.nrrd is not there
  at: scene.toml:3:1, key volume.file
  try: write another path; DRYPOINT_DATA lists no folder with it
error: [volume] has no key \"rang\"
  at: scene.toml:4:1, key volume.rang
  try: write \"range\"; the keys here are file, phantom, raw, ids, labels, label_names, label_lookup, range, gradient_range, outside, box, stride, parts
error: camera.fov cannot be \"wide\"
  at: scene.toml:6:7, key camera.fov
  try: write a number above 0 and below 180, in degrees
error: behind.png is not there
  at: scene.toml:8:1, key picture.background
  try: write the path of a picture that is there
error: there is no style \"metall\"
  at: scene.toml:10:28, key transfer.nodes[0].style
  try: write \"metal\"; there is bone, brain, cartoon, cartoon-2, chalk, constant, copper, engraving, gall, glass, gut, ink, kidney, liver, lung, metal, muscle, nerve, pencil, porcelain, skin, spleen, tone, vein, vessel, watercolour, wax, xray
error: plate.ply is not there
  at: scene.toml:12:1, key mesh[0].file
  try: write another path; DRYPOINT_DATA lists no folder with it
";
    assert_eq!(folder.refused("render scene.toml -o out.png"), expected);
    assert_eq!(folder.refused("plan scene.toml"), expected);
    assert_eq!(folder.refused("sheet torus.nrrd scene.toml -o out.png"), expected);
}

#[test]
fn every_file_that_is_not_what_it_should_be_is_told_at_once() {
    let folder = folder();
    folder.good("-q render torus.nrrd --size 20x10 -o oblong.png");
    folder.write(
        "scene.toml",
        "drypoint = 1\n[volume]\nfile = \"text.nrrd\"\n[picture]\nbackground = \"text.nrrd\"\n[styles]\nmine = \
         \"oblong.png\"\n[transfer]\nnodes = [{ at = 1, style = \"mine\" }]\n",
    );
    let expected = "\
error: this is not an NRRD file: it begins with `hello wo`, expected NRRD000
  at: text.nrrd
  try: check that the suffix says what the file holds
error: style `mine`: oblong.png: 20 × 10 texels, but a style is a square picture of a sphere
  at: scene.toml:7:1, key styles.mine
  try: cut the picture to the square around its sphere
error: text.nrrd: neither a PNG nor an EXR file: it begins with the bytes [68, 65, 6c, 6c, 6f, 20, 77, 6f]
  at: scene.toml:5:1, key picture.background
  try: convert the picture to PNG or EXR
";
    assert_eq!(folder.refused("render scene.toml -o out.png"), expected);
}

#[test]
fn what_only_the_renderer_finds_has_its_key_too() {
    let folder = folder();
    folder.scene("[contours]\nkappa = \"exact\"\n[sampling]\nhessian = \"gaussian\"\nscale = \"2000 voxels\"\n");
    assert_eq!(
        folder.refused("render scene.toml"),
        "error: scale = 2000 world units is not between 0 and 1000, which is 1000 voxels\n  at: scene.toml:12:1, key sampling.scale\n  try: make it smaller, or leave it out\n"
    );
    folder.write("scene.toml", SCENE.replace("size = 20", "size = 1048576"));
    let said = folder.refused("render scene.toml");
    assert!(said.starts_with("error: volume.phantom.size cannot be "), "{said}");
}
