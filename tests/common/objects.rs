//! Scenes of objects as texts: selections, data of their own, and looks of the shells that they are taken from.

// Each binary uses its own part.
#![allow(dead_code)]

use std::path::{Path, PathBuf};

/// A scene of shells under Blinn–Phong.
pub(crate) const SHELLS: &str = r##"
drypoint = 1
[volume]
phantom = { name = "shells", size = 24 }
[picture]
size = [40, 32]
samples = 1
background = "#203040"
LAYERS
[transfer]
kind = "regular"
nodes = [{ at = 20, color = "#c08040", opacity = 0 }, { at = 255, color = "#4080c0", opacity = 0.4 }]
[shading]
"##;

/// A selection volume with soft memberships, and a volume of its own beside it, each on another grid than the picture's volume.
pub(crate) struct Files {
    folder: tempfile::TempDir,
}

impl Files {
    pub(crate) fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let files = Self { folder };
        // A ball whose membership falls from 1 to 0, on 12³ voxels over the middle of the shells.
        let ball = |[x, y, z]: [f64; 3]| {
            let r = [x - 5.0, y - 6.0, z - 5.5].map(|d| d * d).iter().sum::<f64>().sqrt();
            (1.6 - r / 3.5).clamp(0.0, 1.0)
        };
        files.write("soft.nrrd", ball, 1.5, [4.0, 3.0, 3.5]);
        files.write("own.nrrd", |at| 40.0 + 200.0 * ball(at), 0.8, [10.0, 5.0, 9.0]);
        files
    }

    /// Writes a volume of 12³ voxels of f32.
    fn write(&self, name: &str, value: impl Fn([f64; 3]) -> f64, spacing: f64, [x, y, z]: [f64; 3]) {
        let mut bytes = format!(
            "NRRD0005\ntype: float\ndimension: 3\nspace dimension: 3\nsizes: 12 12 12\nencoding: raw\nendian: little\n\
             space directions: ({spacing},0,0) (0,{spacing},0) (0,0,{spacing})\nspace origin: ({x},{y},{z})\n\n"
        )
        .into_bytes();
        for i in 0..12 * 12 * 12 {
            let at = [i % 12, i / 12 % 12, i / 144].map(f64::from);
            bytes.extend_from_slice(&(value(at) as f32).to_le_bytes());
        }
        std::fs::write(self.path(name), bytes).unwrap();
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The picture of an intersection, of 3 by 2 pixels.
    pub(crate) fn picture(&self) -> PathBuf {
        let path = self.path("meeting.png");
        let mut encoder = png::Encoder::new(std::fs::File::create(&path).unwrap(), 3, 2);
        encoder.set_color(png::ColorType::Rgba);
        let pixels: Vec<u8> = (0..24u8).map(|i| i.wrapping_mul(67) | 0x40).collect();
        encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
        path
    }

    /// A table of an object that selects with the soft volume.
    pub(crate) fn soft(&self, more: &str) -> String {
        object("a", &format!("selection = {}\n{more}", quoted(&self.path("soft.nrrd"))))
    }

    /// A table of an object with data of its own.
    pub(crate) fn own(&self, more: &str) -> String {
        object("b", &format!("volume = {}\n{more}", quoted(&self.path("own.nrrd"))))
    }
}

pub(crate) fn quoted(path: &Path) -> String {
    format!("{:?}", path.display().to_string())
}

pub(crate) fn object(name: &str, rest: &str) -> String {
    format!("[[object]]\nname = \"{name}\"\n{rest}\n")
}

pub(crate) fn shells(more: &str) -> String {
    SHELLS.replace("LAYERS\n", "") + more
}

/// A motion that turns, shrinks and shifts.
pub(crate) const MOVED: &str =
    "move = [9, -4, 3]\nrotate = { axis = [1, 2, 0.5], angle = 40 }\nscale = [0.9, 1.2, 0.8]";

/// Operators of fuzzy sets by products.
pub(crate) const PRODUCT: &str = "[combine]\nfuzzy = \"product\"\n";

/// The shells in illustrative styles with contours by κ along the ray.
pub(crate) fn styled(more: &str) -> String {
    let nodes = "[transfer]\nnodes = [{ at = 20, style = \"wax\", opacity = 0 }, { at = 255, style = \"skin\", opacity = 0.5 }]\n\
                 [contours]\nkappa = \"ray\"\n";
    let scene = shells("");
    let (before, _) = scene.split_once("[transfer]").unwrap();
    format!("{before}{nodes}{more}")
}

/// The shells by their value and their gradient magnitude.
pub(crate) fn two_quantities(more: &str) -> String {
    let scene = shells("");
    let (before, _) = scene.split_once("[transfer]").unwrap();
    let nodes = |low: &str, high: &str, opacity: f64| {
        format!(
            "nodes = [{{ at = 20, color = \"{low}\", opacity = 0 }}, {{ at = 255, color = \"{high}\", opacity = {opacity} }}]"
        )
    };
    format!(
        "{before}[transfer]\nkind = \"regular\"\nover = [\"value\", \"gradient-magnitude\"]\n\
         rows = [{{ at = 0, {} }}, {{ at = 20, {} }}]\n[shading]\n{more}",
        nodes("#c08040", "#4080c0", 0.2),
        nodes("#80ff40", "#ff80c0", 0.6)
    )
}
