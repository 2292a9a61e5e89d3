//! Pictures of what a switch is there for: one small scene each, drawn in each of its ways, side by side.

mod styles;

use crate::files;
use drypoint::job::Job;
use drypoint::output::png::encode_png;
use drypoint::output::read::Image;
use drypoint::output::sheet::{Layout, sheet};
use drypoint::scene::file::{Overrides, load};
use drypoint::scene::picture::{Picture, Provenance};
use std::path::PathBuf;

/// What a scene is drawn with: a label, and keys with their values.
type Way = (&'static str, &'static [(&'static str, &'static str)]);

/// A scene and its ways.
struct Switch {
    /// The scene's file, without its suffix.
    scene: &'static str,
    /// The picture's file, without its suffix.
    picture: &'static str,
    ways: &'static [Way],
}

const SWITCHES: [Switch; 5] = [
    Switch {
        scene: "sphere-frame",
        picture: "switch-sphere-frame",
        ways: &[
            ("sphere_frame = \"eye\"", &[("transfer.sphere_frame", "eye")]),
            ("sphere_frame = \"view\"", &[("transfer.sphere_frame", "view")]),
        ],
    },
    Switch {
        scene: "normal",
        picture: "switch-normal",
        ways: &[
            ("normal = \"outward\"", &[("sampling.normal", "outward")]),
            ("normal = \"facing\"", &[("sampling.normal", "facing")]),
            ("normal = \"gradient\"", &[("sampling.normal", "gradient")]),
        ],
    },
    Switch {
        scene: "mix",
        picture: "switch-mix",
        ways: &[
            ("mix = \"premultiplied\"", &[("transfer.mix", "premultiplied")]),
            ("mix = \"printed\"", &[("transfer.mix", "printed")]),
        ],
    },
    Switch {
        scene: "blend-space",
        picture: "switch-blend-space",
        ways: &[
            ("blend_space = \"linear\"", &[("picture.blend_space", "linear")]),
            ("blend_space = \"srgb\"", &[("picture.blend_space", "srgb")]),
        ],
    },
    Switch {
        scene: "mipmaps",
        picture: "style-mipmaps",
        ways: &[
            ("without", &[("style_mipmaps", "off")]),
            ("[style_mipmaps]", &[]),
            ("without, 256 rays a pixel", &[("style_mipmaps", "off"), ("picture.samples", "16")]),
        ],
    },
];

/// Labels between voxels, which differ along borders alone. This one scene is over a scan.
const LABELS: Switch = Switch {
    scene: "label-lookup",
    picture: "labels-nearest-smooth",
    ways: &[
        ("label_lookup = \"nearest\"", &[("volume.label_lookup", "nearest")]),
        ("label_lookup = \"smooth\"", &[("volume.label_lookup", "smooth")]),
    ],
};

/// Pixels of a picture's cell on the sheet.
const CELL: usize = 300;

/// Writes the styles of the scenes, then every picture.
///
/// # Errors
/// What the scenes, the renderer or the system say.
pub(crate) fn write() -> Result<(), String> {
    styles::write()?;
    for switch in SWITCHES.iter().chain([&LABELS]) {
        let pictures = switch.ways.iter().map(|&(label, settings)| {
            let picture = drawn(switch.scene, settings)?;
            Ok((label.to_owned(), Image::from(&picture)))
        });
        let pictures: Vec<_> = pictures.collect::<Result<_, String>>()?;
        let layout = Layout { columns: Some(pictures.len()), cell: CELL };
        let sheet = sheet(&pictures, layout).map_err(|e| e.to_string())?;
        let bytes = encode_png(&sheet, 8, &Provenance::default()).map_err(|e| e.to_string())?;
        files::write(&format!("pictures/style_transfer_functions/{}.png", switch.picture), &bytes)?;
    }
    Ok(())
}

/// The folder of the scenes and their styles.
fn folder() -> PathBuf {
    files::in_docs("../data/scenes/style_transfer_functions/switches")
}

/// A scene with settings over it.
fn drawn(scene: &str, settings: &[(&str, &str)]) -> Result<Picture, String> {
    let overrides: Overrides = settings.iter().copied().collect();
    let scene = load(&folder().join(format!("{scene}.toml")), &overrides).map_err(|e| e.to_string())?;
    let job = Job::load(scene).map_err(|e| e.to_string())?;
    let (picture, _) = job.renderer().map_err(|e| e.to_string())?.frame(&|_| ());
    Ok(picture)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint::scene::picture::LayerKind;

    /// The share of covered pixels in which a channel differs by an eighth at the least.
    fn differing(a: &Picture, b: &Picture) -> f64 {
        let [a, b] = [a, b].map(|p| &p.layer(LayerKind::Beauty).unwrap().channels);
        let shown = |i: &usize| (0..3).any(|c| a[c][*i] != 1.0 || b[c][*i] != 1.0);
        let differs = |i: &usize| (0..3).any(|c| (a[c][*i] - b[c][*i]).abs() >= 0.125);
        let covered = (0..a[0].len()).filter(shown).count();
        (0..a[0].len()).filter(differs).count() as f64 / covered as f64
    }

    /// Borders move, organs stay: where the scan is, a hundredth of what is shown differs at the least, and most does not.
    #[test]
    fn labels_differ_along_their_borders() {
        if !drypoint::scene::file::data_folders().iter().any(|folder| folder.join("abdomen_ct.nii.gz").is_file()) {
            println!("skipped: no data");
            return;
        }
        let [nearest, smooth] = [0, 1].map(|way| {
            let size = [("picture.size", "[96, 96]"), ("picture.samples", "1")];
            let settings: Vec<_> = size.iter().chain(LABELS.ways[way].1).copied().collect();
            drawn(LABELS.scene, &settings).unwrap()
        });
        let share = differing(&nearest, &smooth);
        assert!((0.01..0.25).contains(&share), "{share}");
    }

    /// A picture of a switch that hardly shows it explains nothing: any two ways differ in a tenth of what is shown.
    #[test]
    fn every_way_of_a_switch_is_another_picture() {
        for switch in &SWITCHES {
            let small = |settings: &[(&'static str, &'static str)]| {
                let size = [("picture.size", "[64, 64]"), ("picture.samples", "1")];
                let settings: Vec<_> = size.into_iter().chain(settings.iter().copied()).collect();
                drawn(switch.scene, &settings).unwrap()
            };
            let pictures: Vec<Picture> = switch.ways.iter().map(|(_, settings)| small(settings)).collect();
            for (i, a) in pictures.iter().enumerate() {
                for (j, b) in pictures.iter().enumerate().skip(i + 1) {
                    let share = differing(a, b);
                    assert!(share > 0.1, "{}: ways {i} and {j} differ in {share}", switch.scene);
                }
            }
            // Mip-maps come nearer to what many rays make; edges stay as coarse as one ray a pixel has them.
            if switch.scene == "mipmaps" {
                let [without, with, many] = &pictures[..] else { panic!("three pictures") };
                assert!(2.0 * differing(with, many) < differing(without, many));
            }
        }
    }
}
