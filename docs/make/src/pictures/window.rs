//! Pictures of the window, which the program itself draws: under Xvfb, beside this program, and on the CPU.

use drypoint::output::read::read_image;
use drypoint::scene::picture::{Layer, LayerKind, Picture};
use std::path::Path;
use std::process::Command;

/// Xvfb with a screen that is larger than the window.
const DISPLAY: [&str; 3] = ["-a", "-s", "-screen 0 1440x900x24"];

/// The window that shows a scene beside a panel, once the picture is exact and the panel shows all.
///
/// # Errors
/// `xvfb-run` or `drypoint-viewer` is missing or fails, or the system fails.
pub(super) fn picture(scene: &Path, panel: &str) -> Result<Picture, String> {
    let folder = tempfile::tempdir().map_err(|e| e.to_string())?;
    let file = folder.path().join("window.png");
    let viewer = std::env::current_exe().map_err(|e| e.to_string())?.with_file_name("drypoint-viewer");
    let mut command = Command::new("xvfb-run");
    // A folder of its own: no look, view or size of a user's window is in the picture.
    command.args(DISPLAY).arg(viewer).arg(scene).env("XDG_STATE_HOME", folder.path());
    let output = command.args(["--backend", "reference", "--panel", panel, "--screenshot"]).arg(&file).output();
    let output = output.map_err(|e| format!("xvfb-run: {e}"))?;
    let image = read_image(&file).map_err(|e| format!("{e}\n{}", String::from_utf8_lossy(&output.stderr)))?;
    let (width, height) = (image.width, image.height);
    let channels = image.channels.into_iter().map(|(_, values)| values).collect();
    Ok(Picture { width, height, layers: vec![Layer { kind: LayerKind::Beauty, channels }] })
}
