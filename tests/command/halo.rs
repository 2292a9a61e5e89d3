//! `halo`: the halo of a picture of seeds, in numbers ([HALO-4], [HALO-5], [HALO-10]).

use crate::folder::Folder;
use drypoint::output::exr::encode_exr;
use drypoint::output::png::encode_grey_png;
use drypoint::output::read::{decode, read_image};
use drypoint::scene::color::linear_to_srgb;
use drypoint::scene::picture::{Layer, LayerKind, Picture, Provenance};

/// Writes a grey picture.
fn write(folder: &Folder, name: &str, size: [usize; 2], bits: u8, values: &[f64]) {
    folder.write(name, encode_grey_png(size, values, bits).unwrap());
}

/// Intensities of a PNG, whose codes are the numbers, or of an EXR.
fn intensities(folder: &Folder, name: &str) -> Vec<f64> {
    let image = read_image(&folder.path(name)).unwrap();
    let red = image.channel("R").unwrap();
    if name.ends_with(".png") { red.iter().map(|c| linear_to_srgb(*c)).collect() } else { red.to_vec() }
}

/// A picture of 101 × 101 with a square of ones around its middle.
fn square(side: usize) -> Vec<f64> {
    let inside = |t: usize| (50 - side / 2..50 - side / 2 + side).contains(&t);
    (0..101 * 101).map(|t| f64::from(u8::from(inside(t % 101) && inside(t / 101)))).collect()
}

/// The first pixel outside a square on its axis, for δ of Fig. 4, to four digits.
#[test]
fn numbers_of_figure_4() {
    let folder = Folder::new();
    for (side, expected) in [(1, [0.5789, 0.5928, 0.6074, 0.6150]), (32, [0.6700, 0.7025, 0.7376, 0.7562])] {
        write(&folder, "seeds.png", [101, 101], 8, &square(side));
        let outside = 50 * 101 + 50 + side.div_ceil(2);
        for (delta, expected) in [0.70, 0.80, 0.90, 0.95].into_iter().zip(expected) {
            folder.good(&format!("halo seeds.png -o halo.exr --border zero --delta {delta} -q"));
            let h = intensities(&folder, "halo.exr")[outside];
            assert!((h - expected).abs() <= 5e-5, "δ = {delta}, {side} px: {h}");
        }
    }
}

/// One seed in 3 × 3: the centre keeps 1, an edge neighbour has δ/8, a corner δ/16.
#[test]
fn one_pass_by_hand_in_every_format() {
    let folder = Folder::new();
    let mut seeds = [0.0; 9];
    seeds[4] = 1.0;
    write(&folder, "seeds.png", [3, 3], 16, &seeds);
    let line = "halo seeds.png --from seeds --passes 1 --delta 0.8 --border zero -q -o";
    let expected = [0.05, 0.1, 0.05, 0.1, 1.0, 0.1, 0.05, 0.1, 0.05];
    for (name, bits, step) in [("a.png", 16, 1.0 / 65535.0), ("b.png", 8, 1.0 / 255.0), ("c.exr", 8, 1e-8)] {
        folder.good(&format!("{line} {name} --bits {bits}"));
        let h = intensities(&folder, name);
        assert!(h.iter().zip(expected).all(|(h, e)| (h - e).abs() <= 0.5 * step + 1e-9), "{name}: {h:?}");
    }
    // δ = 0 and no pass give the seeds back.
    for more in ["--delta 0", "--passes 0", "--filter none"] {
        let rest = if more.contains("delta") { "--passes 3" } else { "" };
        folder.good(&format!("halo seeds.png --from seeds -q -o same.png {more} {rest}"));
        assert_eq!(folder.read("same.png"), folder.read("seeds.png"), "{more}");
    }
    // A median takes the single pixel away.
    folder.good("halo seeds.png --median -q -o none.png");
    assert_eq!(intensities(&folder, "none.png"), [0.0; 9]);
    // A halo is a picture of seeds again, to the bit in an EXR.
    folder.good("halo c.exr --from seeds --filter none -q -o again.exr");
    assert_eq!(folder.read("again.exr"), folder.read("c.exr"));
}

/// The intensity of a pixel is its luminance times α; a grey is its number.
#[test]
fn intensities_are_luminances() {
    let folder = Folder::new();
    let pixels = [[0.4, 0.4, 0.4, 1.0], [1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.2, 0.2, 0.2, 0.2]];
    let channels = (0..4).map(|c| pixels.iter().map(|p| p[c]).collect()).collect();
    let layers = vec![Layer { kind: LayerKind::Beauty, channels }];
    let picture = Picture { width: 4, height: 1, layers };
    folder.write("seeds.exr", encode_exr(&picture, &Provenance::default()).unwrap());
    folder.good("halo seeds.exr --from seeds --filter none -q -o same.exr");
    let expected = [0.4, 0.2126, 0.7152, 0.2];
    let found = intensities(&folder, "same.exr");
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-7), "{found:?}");
}

/// A picture smaller than the reach, all ones: no gradient by default, an edge along the frame with zeros around.
#[test]
fn pictures_smaller_than_the_reach() {
    let folder = Folder::new();
    for size in [[1, 1], [5, 3]] {
        write(&folder, "ones.png", size, 8, &vec![1.0; size[0] * size[1]]);
        folder.good("halo ones.png --passes 12 -q -o none.png");
        assert!(intensities(&folder, "none.png").iter().all(|h| *h == 0.0));
        folder.good("halo ones.png --from seeds --passes 12 -q -o all.exr");
        assert!(intensities(&folder, "all.exr").iter().all(|h| *h == 1.0));
    }
    folder.good("halo ones.png --border zero -q -o edge.exr");
    assert!(intensities(&folder, "edge.exr")[0] > 0.5);
}

#[test]
fn figures_are_sheets_of_two_columns() {
    let folder = Folder::new();
    write(&folder, "seeds.png", [64, 64], 8, &image());
    folder.good("halo seeds.png --figure stages -q -o stages.png");
    folder.good("halo seeds.png --figure deltas --passes 3 -q -o deltas.png");
    let [stages, deltas] = ["stages.png", "deltas.png"].map(|name| read_image(&folder.path(name)).unwrap());
    assert_eq!((stages.width, deltas.width), (8 + 2 * 72, 8 + 2 * 72));
    assert!((stages.height - 8) * 2 == (deltas.height - 8) * 3, "three rows and two");
    // The first cell is the seeds, pixel by pixel: a grey of a sheet is the code of an intensity.
    let image = decode(&folder.read("stages.png"), &folder.path("stages.png")).unwrap();
    let corner = linear_to_srgb(image.channel("R").unwrap()[(8 + 20) * image.width + 8 + 20]);
    assert_eq!((corner * 255.0).round(), (image_at(20, 20) * 255.0).round());
}

/// A ramp.
fn image_at(x: usize, y: usize) -> f64 {
    (x + y) as f64 / 126.0
}

fn image() -> Vec<f64> {
    (0..64 * 64).map(|t| image_at(t % 64, t / 64)).collect()
}

#[test]
fn faults_are_told_in_three_lines() {
    let folder = Folder::new();
    write(&folder, "seeds.png", [3, 3], 8, &[1.0; 9]);
    folder.write("text.png", "no picture");
    for (line, words) in [
        ("halo gone.png -o a.png", &["the picture cannot be read", "at: gone.png"][..]),
        ("halo text.png -o a.png", &["at: text.png"]),
        ("halo seeds.png", &["--output <FILE>"]),
        ("halo seeds.png -o a.pdf", &["not written as .pdf", "ends in .png or .exr"]),
        ("halo seeds.png -o a_#.png", &["this picture has one"]),
        ("halo seeds.png -o a.exr --figure stages", &["written as PNG"]),
        ("halo seeds.png -o seeds.png", &["would be overwritten"]),
        ("halo seeds.png -o a.png --delta 1.5", &["'1.5' for '--delta <D>': not a number from 0 to 1"]),
        ("halo seeds.png -o a.png --delta -0.1", &["not a number from 0 to 1"]),
        ("halo seeds.png -o a.png --delta nan", &["not a number from 0 to 1"]),
        ("halo seeds.png -o a.png --passes 13", &["'13' for '--passes <N>': 13 is not in 0..=12"]),
        ("halo seeds.png -o a.png --border wrap", &["[possible values: zero, replicate]"]),
        ("halo seeds.png -o a.png --figure stages --from seeds", &["cannot be used with"]),
        ("halo seeds.png -o a.png --memory 1MiB", &["GiB of memory"]),
    ] {
        let said = folder.refused(line);
        assert!(words.iter().all(|word| said.contains(word)), "{line}: {said}");
    }
}
