//! Programs of others: run where they are, skipped where they are not, but on the machine that tests every change.

use std::path::Path;
use std::process::Command;

/// Runs a program; none, with a line that says so, where it is not installed.
///
/// `package` is where it comes from; none: nobody is bound to have it.
pub(crate) fn run(program: &str, package: Option<&str>, arguments: &[&str], folder: &Path) -> Option<String> {
    match Command::new(program).args(arguments).current_dir(folder).output() {
        Ok(done) => {
            assert!(done.status.success(), "{program}: {}", String::from_utf8_lossy(&done.stderr));
            Some(String::from_utf8_lossy(&done.stdout).into_owned())
        }
        Err(error) => {
            let bound = std::env::var("CI").is_ok_and(|ci| ci == "true");
            assert!(!bound || package.is_none(), "{program} from {package:?} is needed here: {error}");
            println!("skipped: no {program}");
            None
        }
    }
}

/// A picture of 8-bit codes as its red, green and blue.
pub(crate) struct Codes {
    pub(crate) size: [usize; 2],
    pub(crate) rgb: Vec<[f64; 3]>,
}

impl Codes {
    /// From an opaque PNG.
    pub(crate) fn of_png(path: &Path) -> Self {
        use drypoint::output::encode::quantize;
        use drypoint::scene::color::linear_to_srgb;
        let image = drypoint::output::read::read_image(path).unwrap();
        let rgb = image.colors().unwrap().rgb;
        let code = |c: f64| f64::from(quantize(linear_to_srgb(c), 255));
        let rgb = (0..rgb[0].len()).map(|i| [0, 1, 2].map(|c| code(rgb[c][i]))).collect();
        Self { size: [image.width, image.height], rgb }
    }

    /// From a binary PPM.
    pub(crate) fn of_ppm(path: &Path) -> Self {
        let bytes = std::fs::read(path).unwrap();
        // P6, width, height and 255, each ended by one white space.
        let mut words = bytes.splitn(5, |byte| byte.is_ascii_whitespace());
        let mut word = || words.next().unwrap();
        assert_eq!(word(), b"P6");
        let size = [word(), word()].map(|w| std::str::from_utf8(w).unwrap().parse().unwrap());
        assert_eq!(word(), b"255");
        let rgb = word().chunks_exact(3).map(|p| [p[0], p[1], p[2]].map(f64::from)).collect();
        Self { size, rgb }
    }

    /// Means of squares of `n` × `n` pixels.
    pub(crate) fn reduced(&self, n: usize) -> Self {
        let [width, height] = self.size.map(|side| side / n);
        let mean = |i: usize, j: usize, c: usize| {
            let sum: f64 = (0..n * n).map(|k| self.rgb[(j * n + k / n) * self.size[0] + i * n + k % n][c]).sum();
            sum / (n * n) as f64
        };
        let rgb = (0..width * height).map(|p| [0, 1, 2].map(|c| mean(p % width, p / width, c))).collect();
        Self { size: [width, height], rgb }
    }

    /// Mean coverage, from 0 for white paper to 1.
    fn coverage(&self) -> f64 {
        1.0 - self.rgb.iter().flatten().sum::<f64>() / (self.rgb.len() * 3 * 255) as f64
    }

    /// Holds two pictures to what two good rasterizers may differ by: at most 0.5 % of the pixels by more than 32 of 255,
    /// and the mean coverage by less than 0.2 %.
    pub(crate) fn agrees_with(&self, other: &Self) {
        self.is_nearly_everywhere(other);
        self.has_the_ink_of(other);
    }

    /// At most 0.5 % of the pixels differ by more than 32 of 255.
    pub(crate) fn is_nearly_everywhere(&self, other: &Self) {
        let differ = self.far_off(other);
        println!("{:.4} % of the pixels differ", 100.0 * differ);
        assert!(differ <= 0.005, "{differ}");
    }

    /// The share of the pixels that differ by more than 32 of 255.
    pub(crate) fn far_off(&self, other: &Self) -> f64 {
        assert_eq!(self.size, other.size);
        let far = |(a, b): (&[f64; 3], &[f64; 3])| a.iter().zip(b).any(|(a, b)| (a - b).abs() > 32.0);
        self.rgb.iter().zip(&other.rgb).filter(|&pair| far(pair)).count() as f64 / self.rgb.len() as f64
    }

    /// The mean coverages differ by less than 0.2 %.
    pub(crate) fn has_the_ink_of(&self, other: &Self) {
        assert_eq!(self.size, other.size);
        let (ours, theirs) = (self.coverage(), other.coverage());
        println!("mean coverage {ours:.5} and {theirs:.5}");
        assert!((ours - theirs).abs() < 0.002, "{ours} and {theirs}");
        assert!(ours > 0.02, "there is something to see: {ours}");
    }
}
