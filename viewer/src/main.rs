//! The window of Drypoint.
//!
//! `drypoint-viewer [FILE] [--backend NAME] [--panel TITLE] [--screenshot PNG]`: FILE is a scene or a volume. Without one the window shows the example.

use drypoint::gpu::Gpu;
use drypoint_viewer::app::{Backend, Viewer};
use drypoint_viewer::open;
use drypoint_viewer::state::State;
use eframe::egui::{self, ViewportBuilder};
use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

/// How the program is called.
const USAGE: &str = "Usage: drypoint-viewer [FILE] [--backend NAME] [--panel TITLE] [--screenshot PNG]

Opens a window in which a volume is turned and its scene file edited.
  FILE              a scene (.toml) or a volume; without one the example
  --backend NAME    what draws the frames: auto, gpu or reference; auto is gpu where there is a graphics card
  --panel TITLE     opens this panel beside the picture, such as Objects
  --screenshot PNG  writes a picture of the window once the frame is exact, and ends
";

fn main() -> ExitCode {
    let (mut file, mut screenshot, mut panel, mut backend) = (None, None, None, Backend::Auto);
    let mut arguments = std::env::args_os().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.to_str() {
            Some("--help" | "-h") => {
                print!("{USAGE}");
                return ExitCode::SUCCESS;
            }
            Some("--version" | "-V") => {
                println!("drypoint-viewer {}", env!("CARGO_PKG_VERSION"));
                return ExitCode::SUCCESS;
            }
            Some("--backend") => match arguments.next().as_ref().and_then(|name| name.to_str()) {
                Some("auto") => backend = Backend::Auto,
                Some("gpu") => backend = Backend::Card,
                Some("reference") => backend = Backend::Reference,
                _ => {
                    eprint!("error: --backend is auto, gpu or reference\n{USAGE}");
                    return ExitCode::from(2);
                }
            },
            Some("--panel") => panel = arguments.next().and_then(|title| title.into_string().ok()),
            Some("--screenshot") => screenshot = arguments.next().map(PathBuf::from),
            Some(option) if option.starts_with('-') => {
                eprint!("error: there is no option {option}\n{USAGE}");
                return ExitCode::from(2);
            }
            _ => file = Some(PathBuf::from(argument)),
        }
    }
    match run(file, backend, panel, screenshot) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn run(
    file: Option<PathBuf>,
    backend: Backend,
    panel: Option<String>,
    screenshot: Option<PathBuf>,
) -> Result<(), Box<dyn std::error::Error>> {
    let document = match &file {
        Some(file) => open::open(file)?,
        None => open::example(),
    };
    let mut state = State::read(State::folder());
    file.iter().for_each(|file| state.opened(file));
    let setup = WgpuSetupCreateNew {
        device_descriptor: Arc::new(Gpu::descriptor),
        ..WgpuSetupCreateNew::without_display_handle()
    };
    let options = eframe::NativeOptions {
        viewport: ViewportBuilder::default()
            .with_app_id("drypoint-viewer")
            .with_title("Drypoint")
            .with_inner_size([1360.0, 860.0])
            .with_drag_and_drop(true),
        wgpu_options: WgpuConfiguration { wgpu_setup: WgpuSetup::CreateNew(setup), ..Default::default() },
        ..Default::default()
    };
    let create = move |creation: &eframe::CreationContext<'_>| {
        let render = creation.wgpu_render_state.clone();
        let mut viewer = Viewer::new(&creation.egui_ctx, render, backend, document, state);
        panel.into_iter().for_each(|title| viewer.open_panel(&title));
        screenshot.into_iter().for_each(|path| viewer.take_screenshot(path));
        Ok(Box::new(Window(viewer)) as Box<dyn eframe::App>)
    };
    Ok(eframe::run_native("Drypoint", options, Box::new(create))?)
}

/// The viewer as a window of the system.
struct Window(Viewer);

impl eframe::App for Window {
    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        self.0.ui(ui);
    }
}
