//! The state that all panels share: the document, what was read from it, and the frame that shows it.

use crate::camera::Pose;
use crate::document::{Document, Edit};
use crate::following;
use crate::frames::{Answer, Prepared, Request, VolumeData, Worker};
use crate::key::KeyPath;
use crate::probe::{PixelQuery, PixelReport, Prober};
use crate::screen::Screen;
use crate::slice::ValueColors;
use drypoint::gpu::Gpu;
use drypoint::scene::glam::DVec3;
use drypoint::scene::tables::Scene;
use drypoint::{Failure, Failures};
use eframe::egui::{self, TextureId};
use std::sync::Arc;
use toml_edit::Value;

/// The frame in the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    /// The texture.
    pub texture: TextureId,
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// Whether an exact frame follows.
    pub is_coarse: bool,
    /// Seconds of drawing.
    pub seconds: f64,
    /// The serial number of the scene that it shows ([`Session::serial`]).
    pub serial: u64,
}

/// A document with its scene, volume and frame.
pub struct Session {
    /// The document.
    pub document: Document,
    /// The scene of the text when it was last without faults.
    pub scene: Option<Arc<Scene>>,
    /// The scene that is drawn, with nodes and iso-values that were found in the data.
    pub prepared: Option<Arc<Scene>>,
    /// The colours of values in the function of the scene that is drawn.
    pub colors: Option<Arc<ValueColors>>,
    /// The faults of the text, or of drawing it.
    pub failures: Option<Failures>,
    /// Warnings of the scene that is drawn.
    pub warnings: Vec<String>,
    /// The frame; the last good one if the scene has a fault.
    pub shown: Option<Shown>,
    /// Most pixels of the longer side of a frame.
    pub longest: usize,
    /// The card of the window's device, if it draws scenes; it may be software.
    pub card: Option<Gpu>,
    /// A sentence about the last command, for the status line.
    pub notice: String,
    /// The cross-hair in the world, which the picture and the slices share. Like the pointer, it is no part of the scene.
    pub cross: Option<DVec3>,
    /// The last answer about a pixel.
    pub probed: Option<PixelReport>,
    /// The box of each object in the world where it is not moved, x fastest. None while it is not known.
    pub boxes: Vec<Option<[DVec3; 8]>>,
    /// Whether the brush is on.
    pub is_painting: bool,
    /// Whether dabs of a stroke are still to come, which are undone with those before.
    pub is_stroke_open: bool,
    screen: Screen,
    worker: Worker,
    prober: Prober,
    /// The last question about a pixel: the scene's serial number, and the pixel.
    questioned: Option<(u64, [usize; 2])>,
    /// Whether the place of a click is not yet known.
    awaits_click: bool,
    serial: u64,
    /// The serial number at which the document was taken: its scenes have greater ones.
    first: u64,
    /// The volume that was read last. It may be that of an earlier scene.
    loaded: Option<Arc<VolumeData>>,
    /// The document's revision that was read, and the size that was asked for.
    asked: Option<(u64, usize)>,
}

impl Session {
    /// A session of a document. One thread draws its frames, another tells what is seen at pixels.
    pub fn new(document: Document, screen: Screen, card: Option<Gpu>, worker: Worker, prober: Prober) -> Self {
        Self {
            document,
            scene: None,
            prepared: None,
            colors: None,
            failures: None,
            warnings: Vec::new(),
            shown: None,
            longest: 2048,
            card,
            notice: String::new(),
            cross: None,
            probed: None,
            boxes: Vec::new(),
            is_painting: false,
            is_stroke_open: false,
            screen,
            worker,
            prober,
            questioned: None,
            awaits_click: false,
            serial: 0,
            first: 0,
            loaded: None,
            asked: None,
        }
    }

    /// Takes another document. Nothing that was found about the one before is kept, and answers that are still to come
    /// about it are ignored.
    pub fn take(&mut self, document: Document) {
        self.document = document;
        self.serial += 1;
        (self.first, self.asked) = (self.serial, None);
        (self.scene, self.prepared, self.colors, self.failures) = (None, None, None, None);
        (self.shown, self.cross, self.probed) = (None, None, None);
        (self.questioned, self.awaits_click) = (None, false);
        (self.is_painting, self.is_stroke_open) = (false, false);
        self.boxes.clear();
        self.warnings.clear();
        self.notice.clear();
    }

    /// Returns a number that no other document of the session has.
    pub(crate) fn document_number(&self) -> u64 {
        self.first
    }

    /// Returns the volume of the scene; none while it is read.
    pub fn data(&self) -> Option<&Arc<VolumeData>> {
        let scene = self.scene.as_ref()?;
        self.loaded.as_ref().filter(|data| data.table == scene.volume)
    }

    /// Reads the document if it has changed, asks for its frames, and takes the answers.
    pub fn update(&mut self, ctx: &egui::Context) {
        let state = (self.document.revision(), self.longest);
        if self.asked != Some(state) {
            self.asked = Some(state);
            self.serial += 1;
            match self.document.scene() {
                Ok(scene) => {
                    self.worker.ask(Request { revision: self.serial, scene: scene.clone(), longest: self.longest });
                    self.scene = Some(Arc::new(scene));
                    self.failures = None;
                }
                Err(failures) => self.failures = Some(failures),
            }
        }
        let answers: Vec<Answer> = self.worker.answers().collect();
        for answer in answers {
            match answer {
                Answer::Loaded(data) => {
                    let grid = data.volume.grid();
                    let [lo, hi] = grid.index_box();
                    let is_inside = |at: DVec3| at.cmpge(lo).all() && at.cmple(hi).all();
                    self.cross = self.cross.filter(|cross| is_inside(grid.to_index(*cross)));
                    self.loaded = Some(data);
                }
                Answer::Prepared(Prepared { revision, scene, warnings, colors, boxes }) if revision > self.first => {
                    (self.prepared, self.warnings, self.colors) = (Some(scene), warnings, Some(colors));
                    self.boxes = boxes;
                }
                // An exact frame with points and lines may come after frames of later scenes.
                Answer::Drawn(frame)
                    if frame.revision > self.first && self.shown.is_none_or(|shown| shown.serial <= frame.revision) =>
                {
                    let (size, is_coarse, seconds, serial) =
                        (frame.size, frame.is_coarse, frame.seconds, frame.revision);
                    self.screen.show(ctx, frame);
                    self.shown =
                        self.screen.texture().map(|texture| Shown { texture, size, is_coarse, seconds, serial });
                }
                // Later faults of the text are newer.
                Answer::Failed(serial, failures) if serial == self.serial => {
                    self.failures.get_or_insert(failures);
                }
                Answer::Prepared(_) | Answer::Drawn(_) | Answer::Failed(..) => {}
            }
        }
        let reports: Vec<PixelReport> = self.prober.answers().collect();
        reports.into_iter().for_each(|report| self.take_report(report));
    }

    /// Asks what is seen at a pixel of the scene's picture; with `is_click` the cross-hair moves there.
    pub fn ask_pixel(&mut self, pixel: [usize; 2], is_click: bool) {
        let (Some(scene), Some(data)) = (self.scene.clone(), self.data()) else { return };
        let question = (self.serial, pixel);
        // A click is not given up for a pointer that rests.
        if is_click || !self.awaits_click && self.questioned != Some(question) {
            let (serial, volume) = (self.serial, Arc::clone(&data.volume));
            (self.questioned, self.awaits_click) = (Some(question), is_click);
            self.prober.ask(PixelQuery { serial, scene, volume, pixel, is_click });
        }
    }

    /// Takes a report, unless another question was asked after it.
    fn take_report(&mut self, report: PixelReport) {
        if self.questioned != Some((report.serial, report.pixel)) {
            return;
        }
        if report.is_click && std::mem::take(&mut self.awaits_click) {
            match &report.place {
                Ok(Some(place)) => self.cross = Some(place.picked.world),
                Ok(None) => self.notice = "Nothing is seen there".into(),
                Err(failures) => self.notice = failures.to_string(),
            }
        }
        self.probed = Some(report);
    }

    /// Returns a number that grows with every scene that was read.
    pub fn serial(&self) -> u64 {
        self.serial
    }

    /// Whether the exact frame of the document is in the window.
    pub fn is_settled(&self) -> bool {
        let is_asked = self.asked == Some((self.document.revision(), self.longest));
        let is_exact = self.shown.is_some_and(|shown| shown.serial == self.serial && !shown.is_coarse);
        is_asked && (is_exact || self.failures.is_some())
    }

    /// Returns the camera of the document, once its volume is loaded.
    pub fn pose(&self) -> Option<Pose> {
        let (scene, data) = (self.scene.as_ref()?, self.data()?);
        Pose::new(&scene.camera, data.volume.grid(), scene.picture.size).ok()
    }

    /// Moves the camera.
    pub fn move_camera(&mut self, label: &str, to: impl FnOnce(&Pose) -> Pose) {
        if let (Some(from), Some(scene)) = (self.pose(), self.scene.clone()) {
            self.edit_camera(label, to(&from).edits(&scene.camera, &from));
        }
    }

    /// Makes edits of `[camera]`, and those of the selections that follow it ([VS-9]).
    pub fn edit_camera(&mut self, label: &str, edits: Vec<Edit>) {
        let before = self.scene.clone().zip(self.pose());
        self.edit(label, edits);
        self.read();
        // V' is that of the numbers in the text.
        if let (Some((scene, from)), Some(now)) = (before, self.pose())
            && now.view != from.view
        {
            let following = following::edits(&scene, &self.boxes, [&from.view, &now.view]);
            if !following.is_empty() {
                self.edit(label, following);
                self.read();
            }
        }
    }

    /// Reads the scene, so that a second move in the same pass of the window starts where the one before ends.
    fn read(&mut self) {
        if let Ok(scene) = self.document.scene() {
            self.scene = Some(Arc::new(scene));
        }
    }

    /// Gives a key a value. An error goes to the status line.
    pub fn set(&mut self, key: &KeyPath, value: impl Into<Value>) {
        self.edit(&key.to_string(), vec![Edit::set(key.clone(), value)]);
    }

    /// Makes some edits together. An error goes to the status line.
    pub fn edit(&mut self, label: &str, edits: Vec<Edit>) {
        if let Err(error) = self.document.apply(label, edits) {
            self.notice = error.to_string();
        }
    }

    /// Puts a failure into the status line.
    pub fn report(&mut self, failure: &Failure) {
        self.notice = format!("{}: {}", failure.place, failure.what);
    }

    /// Returns the pixels of the frame in the window.
    pub fn image(&self) -> Option<egui::ColorImage> {
        self.screen.image()
    }
}
