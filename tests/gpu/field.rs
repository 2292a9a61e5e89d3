//! The field between voxels, up to its border, in pictures: kernels, gradients, curvatures, masked voxels, iso-surfaces.

use crate::double::agrees;
use std::fmt::Write;
use std::path::Path;

/// A volume file of bumps and noise on a sheared grid: u8, or f32 with some voxels that are not numbers.
pub(crate) fn volume([nx, ny, nz]: [usize; 3], kind: &str) -> String {
    let mut next = crate::formulas::random(11);
    let number = |x: usize, y: usize, z: usize, r: f64| {
        let c = |i: usize, n: usize| (i as f64 + 0.5) / n as f64 - 0.5;
        let [x, y, z] = [c(x, nx), c(y, ny), c(z, nz)];
        (230.0 * (1.0 - 2.0 * (x * x + y * y + z * z)) + 24.0 * r).clamp(1.0, 255.0)
    };
    let mut data = Vec::new();
    for (i, [x, y, z]) in (0..nx * ny * nz).map(|i| (i, [i % nx, i / nx % ny, i / (nx * ny)])) {
        let value = number(x, y, z, next());
        match kind {
            "uchar" => data.push(value as u8),
            _ if kind == "masked" && i % 41 == 17 => data.extend(f32::NAN.to_le_bytes()),
            _ => data.extend((value as f32).to_le_bytes()),
        }
    }
    let stored = if kind == "uchar" { "uchar" } else { "float" };
    let mut header = format!("NRRD0004\ntype: {stored}\ndimension: 3\nsizes: {nx} {ny} {nz}\nencoding: raw\n");
    let _ = write!(header, "endian: little\nspace dimension: 3\n");
    let _ = write!(header, "space directions: (0.7,0,0) (0.1,1.1,0) (0,-0.2,1.6)\nspace origin: (3,-2,1)\n\n");
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("field-{nx}-{ny}-{nz}-{kind}.nrrd"));
    std::fs::write(&path, [header.as_bytes(), &data].concat()).unwrap();
    path.to_str().unwrap().to_owned()
}

/// A scene of such a volume, seen obliquely.
pub(crate) fn scene(dims: [usize; 3], kind: &str, more: &str) -> String {
    let file = volume(dims, kind);
    format!(
        r##"
drypoint = 1
[volume]
file = "{file}"
[camera]
direction = [-0.5, 0.4, -0.8]
[transfer]
kind = "regular"
nodes = [{{ at = 90, color = "#804020", opacity = 0.02 }}, {{ at = 170, color = "#ffcc88", opacity = 0.3 }},
         {{ at = 240, color = "#88ccff", opacity = 0.7 }}]
[picture]
size = [40, 32]
samples = 1
background = "#203040"
{more}
"##
    )
}

/// Compares a scene of each volume.
pub(crate) fn compare(name: &str, volumes: &[([usize; 3], &str)], more: &str) {
    for &(dims, kind) in volumes {
        agrees(&format!("{name} {dims:?} {kind}"), &scene(dims, kind, more));
    }
}

const KERNELS: [&str; 5] = ["trilinear", "bspline", "bspline-smooth", "bspline5", "catmull-rom"];

/// Axes with an inside, with borders alone, and of one voxel.
const VOLUMES: [([usize; 3], &str); 4] =
    [([11, 9, 8], "uchar"), ([9, 8, 10], "float"), ([6, 2, 3], "float"), ([9, 1, 6], "float")];

#[test]
fn kernels() {
    for kernel in KERNELS {
        let more = format!("[shading]\n[sampling]\nkernel = \"{kernel}\"\ngradient = \"analytic\"\n");
        compare(&format!("{kernel}, analytic gradient"), &VOLUMES, &more);
    }
}

#[test]
fn gradients() {
    for gradient in ["central", "sobel", "regression"] {
        for kernel in ["trilinear", "bspline5"] {
            let more = format!("[shading]\n[sampling]\nkernel = \"{kernel}\"\ngradient = \"{gradient}\"\n");
            compare(&format!("{kernel}, {gradient}"), &VOLUMES, &more);
        }
    }
}

/// Curvatures in layers, by each Hessian.
#[test]
fn curvatures() {
    let layers = "layers = [\"beauty\", \"curvature\", \"first.curvature\", \"gradient\", \"normal\"]\n";
    for (kernel, hessian) in [
        ("trilinear", "central"),
        ("trilinear", "gaussian"),
        ("bspline", "analytic"),
        ("bspline5", "analytic"),
        ("bspline", "gaussian"),
        ("catmull-rom", "auto"),
    ] {
        let more = format!("{layers}[shading]\n[sampling]\nkernel = \"{kernel}\"\nhessian = \"{hessian}\"\n");
        compare(&format!("{kernel}, {hessian} Hessian"), &VOLUMES[..2], &more);
        compare(&format!("{kernel}, {hessian} Hessian"), &VOLUMES[3..], &more);
    }
}

#[test]
fn masked_voxels() {
    let masked = [([11, 9, 8], "masked")];
    compare("masked", &masked, "[shading]\n");
    compare("masked", &masked, "[shading]\n[sampling]\nkernel = \"bspline\"\n");
    compare("surface, masked", &masked, "[shading]\n[surface]\niso = 150\nlook = \"phong\"\n");
}

#[test]
fn surfaces() {
    let phong = "[shading]\n[surface]\niso = 150\nlook = \"phong\"\ncolor = \"#d8b4cc\"\n";
    for kernel in KERNELS {
        compare(&format!("surface, {kernel}"), &VOLUMES, &format!("{phong}[sampling]\nkernel = \"{kernel}\"\n"));
    }
    let layers = "layers = [\"beauty\", \"Z\", \"depth\", \"first\", \"normal\"]\n";
    compare("surface, layers", &VOLUMES[..2], &format!("{layers}{phong}"));
    compare("surface, shells", &VOLUMES[..2], &format!("{phong}[sampling]\nstep_along = \"ray\"\n"));
    compare("surface, white", &VOLUMES[..2], "[shading]\n[surface]\niso = 150\n");
    for (dims, kind) in VOLUMES {
        let text = scene(dims, kind, phong);
        let (start, end) = (text.find("[transfer]").unwrap(), text.find("[picture]").unwrap());
        agrees(&format!("surface alone {dims:?} {kind}"), &format!("{}{}", &text[..start], &text[end..]));
    }
}

/// Iso-surfaces that planes cut open, with and without caps, alone and in the volume.
#[test]
fn cut_surfaces() {
    let phong = "[shading]\n[surface]\niso = 150\nlook = \"phong\"\ncolor = \"#d8b4cc\"\n";
    let plane = "[[clip]]\npoint = [4.3, 3.1, 4.2]\nnormal = [0.3, -0.3, 1]\nspace = \"index\"\n";
    let cap = format!("{plane}cap = \"#ff3010a0\"\n");
    let bounds = "[[clip]]\nbox = [[1.5, 6.8], [0.7, 5.2], [1.2, 6.4]]\nspace = \"index\"\ncap = \"#30ff10\"\n";
    let styled = format!("{plane}style = \"wax\"\n");
    let layers = "layers = [\"beauty\", \"Z\", \"depth\", \"first\", \"normal\", \"curvature\"]\n";
    for (name, more) in [
        ("cut surface", format!("{phong}{plane}")),
        ("cut surface, cap", format!("{phong}{cap}")),
        ("cut surface, box", format!("{phong}{bounds}{plane}")),
        ("cut surface, style", format!("{phong}{styled}")),
        ("cut surface, layers", format!("{layers}{phong}{cap}")),
        ("cut surface, B-spline", format!("{phong}{cap}[sampling]\nkernel = \"bspline\"\n")),
        ("cut surface, shells", format!("{phong}{cap}[sampling]\nstep_along = \"ray\"\n")),
    ] {
        compare(name, &[VOLUMES[1], ([11, 9, 8], "masked")], &more);
    }
    for (dims, kind) in [VOLUMES[0], ([11, 9, 8], "masked")] {
        let text = scene(dims, kind, &format!("{phong}{cap}")).replace("[camera]\n", "outside = \"high\"\n[camera]\n");
        let alone =
            format!("{}{}", &text[..text.find("[transfer]").unwrap()], &text[text.find("[picture]").unwrap()..]);
        for text in [text, alone] {
            agrees(&format!("cut surface, high outside {dims:?} {kind}"), &text);
        }
    }
}

/// κ along the ray, in layers of an iso-surface alone and in a volume, whole and cut.
#[test]
fn curvature_along_the_ray_at_surfaces() {
    let layers = "layers = [\"beauty\", \"curvature.KV\", \"first.curvature.KV\"]\n";
    let cut = "[[clip]]\npoint = [4.3, 3.1, 4.2]\nnormal = [0.3, -0.3, 1]\nspace = \"index\"\n";
    let surface = "[shading]\n[surface]\niso = 150\nlook = \"phong\"\n";
    for more in ["", cut, "[sampling]\nnormal = \"facing\"\n"] {
        for (dims, kind) in &VOLUMES[1..3] {
            let text = scene(*dims, kind, &format!("{layers}{surface}{more}"));
            let alone =
                format!("{}{}", &text[..text.find("[transfer]").unwrap()], &text[text.find("[picture]").unwrap()..]);
            for text in [text, alone] {
                agrees(&format!("κ at surfaces {dims:?} {kind}"), &text);
            }
        }
    }
}

/// An iso-surface with a light of its own in a volume with another one.
#[test]
fn lights_of_surfaces() {
    let shaded = "[shading]\nshininess = 8\n";
    let tones = |at: [f64; 2]| format!("offset = 0.1\ntones = [[{}, \"#503020\"], [{}, \"#ffe0c0\"]]\n", at[0], at[1]);
    let toon = format!("[shading]\nmodel = \"toon\"\n[shading.toon]\n{}", tones([0.0, 0.3]));
    let silhouette = |of: &str, offset: f64| format!("[{of}.silhouette]\noffset = {offset}\n");
    let surface = |look: &str| format!("[surface]\niso = 150\nlook = \"{look}\"\ncolor = \"#d8b4cc\"\n");
    let in_tones = format!("{}[surface.toon]\n{}", surface("toon"), tones([0.0, 0.6]));
    for (name, more) in [
        ("toon in Phong", format!("{shaded}{in_tones}")),
        ("Phong in toon", format!("{toon}{}", surface("phong"))),
        ("toon in toon", format!("{toon}{in_tones}")),
        ("Phong in Phong", format!("{shaded}{}", surface("phong"))),
        ("toon in flat", in_tones.clone()),
        ("white in toon", format!("{toon}{}", surface("white"))),
        (
            "silhouettes of both",
            format!("{shaded}{}{}{}", silhouette("shading", 0.1), surface("phong"), silhouette("surface", 0.3)),
        ),
        ("silhouettes of the surface", format!("{shaded}{}{}", surface("white"), silhouette("surface", 0.3))),
        ("silhouettes of the volume", format!("{shaded}{}{}", silhouette("shading", 0.3), surface("phong"))),
        ("view opacity", format!("[shading]\nview_opacity = 0.5\n{in_tones}")),
        (
            "toon, cut",
            format!(
                "{shaded}{in_tones}[[clip]]\npoint = [4.3, 3.1, 4.2]\nnormal = [0.3, -0.3, 1]\nspace = \"index\"\ncap = \"#ff301080\"\n"
            ),
        ),
    ] {
        compare(name, &VOLUMES[1..2], &more);
    }
}
