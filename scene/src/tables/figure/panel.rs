//! `[[panel]]` and `[[panel.inset]]`: the pictures of a figure.

use crate::document::check::Check;
use crate::document::declare::{table, unless_empty};
use crate::document::describe::Table;
use crate::document::fault::Problem;
use crate::document::kind::{Bounds, End, FEW, ListOf, MANY, Number, PathTo, TableOf, Text, Whole};
use crate::tables::Corner;
use std::path::PathBuf;

/// The picture of a panel or of an inset.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PanelSource {
    /// A scene or a bare volume that is drawn.
    pub scene: Option<PathBuf>,
    /// The volume that the scene is drawn for, in place of its own.
    pub volume: Option<PathBuf>,
    /// A picture as it is, in place of a scene.
    pub picture: Option<PathBuf>,
    /// Keys that replace those of the scene, each as on the command line.
    pub set: Vec<String>,
}

table! {
    /// One table `[[panel]]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Panel {
        /// The picture.
        source: PanelSource = PanelSource::default();
        /// A scene or a bare volume that is drawn.
        scene: key("SCN-1", SCENE, |p| p.source.scene.clone(), |p, v| p.source.scene = Some(v)).absent("`picture`");
        /// The volume that the scene is drawn for, in place of its own.
        volume: key("VS-11", VOLUME, |p| p.source.volume.clone(), |p, v| p.source.volume = Some(v)).absent("the scene's");
        /// A picture as it is (PNG, EXR), in place of a scene.
        picture: key("IO-2", PICTURE, |p| p.source.picture.clone(), |p, v| p.source.picture = Some(v)).absent("`scene`");
        /// Keys that replace those of the scene, each in the form of `--set`.
        set: key("SCN-1", SETS, |p| unless_empty(&p.source.set), |p, v| p.source.set = v).absent("none");
        /// Text below the panel.
        caption: Option<String> = None, key("IO-7", Text { what: "a caption" }).absent("none");
        /// Columns that the panel takes.
        columns: usize = 1, key("IO-7", Whole { lo: 1, hi: FEW as u64 });
        /// Smaller pictures in corners of the panel.
        insets: Vec<Inset> = Vec::new(),
            key("IO-7", ListOf { what: "a list of insets", most: FEW, each: TableOf(&INSET) }, |p| unless_empty(&p.insets))
            .named("inset").absent("none");
    }
}

table! {
    /// One table `[[panel.inset]]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Inset {
        /// The picture.
        source: PanelSource = PanelSource::default();
        /// A scene or a bare volume that is drawn.
        scene: key("SCN-1", SCENE, |p| p.source.scene.clone(), |p, v| p.source.scene = Some(v)).absent("`picture`");
        /// The volume that the scene is drawn for, in place of its own.
        volume: key("VS-11", VOLUME, |p| p.source.volume.clone(), |p, v| p.source.volume = Some(v)).absent("the scene's");
        /// A picture as it is (PNG, EXR), in place of a scene.
        picture: key("IO-2", PICTURE, |p| p.source.picture.clone(), |p, v| p.source.picture = Some(v)).absent("`scene`");
        /// Keys that replace those of the scene, each in the form of `--set`.
        set: key("SCN-1", SETS, |p| unless_empty(&p.source.set), |p, v| p.source.set = v).absent("none");
        /// The corner of the panel that the inset stands in.
        corner: Corner = Corner::BottomRight, key("IO-7", Corner::KIND);
        /// Its width as a share of the panel's, in which it has to fit.
        share: f64 = 0.35, key("IO-7", SHARE);
    }
}

const SHARE: Number = Number { bounds: Bounds { lo: End::Out(0.0), hi: End::In(1.0) }, unit: "" };
const SCENE: PathTo = PathTo { what: "a scene or a volume" };
const VOLUME: PathTo = PathTo { what: "a volume" };
const PICTURE: PathTo = PathTo { what: "a picture" };
const SETS: ListOf<Text> = ListOf { what: "a list of keys with values", most: MANY, each: Text { what: "key=value" } };

impl PanelSource {
    /// The files that it names.
    pub fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.scene.iter().chain(&self.volume).chain(&self.picture)
    }

    /// Checks that there is one picture, and nothing that a picture as it is does not read.
    fn check(&self, check: &mut Check) {
        if !check.sound(&["scene", "picture", "volume", "set"]) {
            return;
        }
        let contradiction =
            |what: &str, remedy: &str| Problem::Contradiction { what: what.into(), remedy: remedy.into() };
        match self {
            Self { scene: None, picture: None, .. } => check.fault_in(
                "scene",
                Problem::Missing { expected: "scene = \"head.toml\", or picture = \"head.png\"".into() },
            ),
            Self { scene: Some(_), picture: Some(_), .. } => {
                check.fault_in("picture", contradiction("a panel has both scene and picture", "leave one of them out"));
            }
            Self { picture: Some(_), volume, set, .. } if volume.is_some() || !set.is_empty() => {
                let key = if volume.is_some() { "volume" } else { "set" };
                let what = format!("{key} changes a scene, and the panel shows a picture as it is");
                check.fault_in(key, contradiction(&what, "leave it out, or give a scene"));
            }
            _ => {}
        }
    }
}

/// The description of a table `[[panel]]`.
pub(crate) static PANEL: Table<Panel> = Table {
    check: |panel, check| panel.source.check(check),
    ..Panel::description("a panel", "One picture of a figure. Panels stand in rows, in their order.")
};

/// The description of a table `[[panel.inset]]`.
static INSET: Table<Inset> = Table {
    check: |inset, check| inset.source.check(check),
    ..Inset::description("an inset", "A smaller picture in a corner of a panel, such as a detail at a larger scale.")
};
