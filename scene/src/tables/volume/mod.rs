//! `[volume]`: the data that is seen.

mod gradient_range;
mod layout;
mod parts;
mod phantom;
mod raw;
mod subset;

pub use gradient_range::GradientRange;
pub(crate) use gradient_range::quantile;
pub use parts::{Keep, PartsTable};
pub use phantom::PhantomSource;
pub use raw::RawLayout;

use crate::document::declare::{choices, table};
use crate::document::describe::{Instead, Table};
use crate::document::fault::Problem;
use crate::document::kind::{Bounds, Numbers, PathTo, Rule, TableOf};
use crate::quantity::Quantity;
use crate::volume::Subset;
pub(crate) use gradient_range::Quantile;
use phantom::PHANTOM;
use raw::RAW;
use std::path::PathBuf;
use subset::{IndexBox, Strides};

table! {
    /// The table `[volume]`. The default names no volume: it is that of a template.
    #[derive(Clone, Debug, PartialEq)]
    pub struct VolumeTable {
        /// Source of the voxels.
        source: VolumeSource = VolumeSource::File { path: PathBuf::new(), raw: None };
        /// A volume file: NRRD, NIfTI, MetaImage or raw voxels.
        file: key("IO-1", PathTo { what: "a volume" },
            |t| match &t.source {
                VolumeSource::File { path, .. } => Some(path.clone()).filter(|path| path.as_os_str() != ""),
                VolumeSource::Phantom(_) => None,
            },
            |t, path| t.source = VolumeSource::File { path, raw: None }).absent("`phantom` in its place");
        /// A volume with known truth, made by the program.
        phantom: key("IO-4", TableOf(&PHANTOM),
            |t| match &t.source {
                VolumeSource::File { .. } => None,
                VolumeSource::Phantom(phantom) => Some(phantom.clone()),
            },
            |t, phantom| t.source = VolumeSource::Phantom(phantom)).absent("`file` in its place");
        /// Layout of a file without a header. FILE.toml beside it may hold the same.
        raw: key("IO-1", TableOf(&RAW),
            |t| match &t.source {
                VolumeSource::File { raw, .. } => raw.clone(),
                VolumeSource::Phantom(_) => None,
            },
            |t, layout| {
                if let VolumeSource::File { raw, .. } = &mut t.source {
                    *raw = Some(layout);
                }
            }).absent("the file's header, or FILE.toml beside it");
        /// Meaning of the values: quantities, or the ids of parts that are shown as one.
        ids: Ids = Ids::Values, key("STF-13", Ids::KIND);
        /// A label volume beside the data: which part each voxel belongs to, as whole numbers from 0. It may lie on
        /// another grid; outside its box the label is 0.
        ///
        /// The path is resolved like that of the volume.
        labels: Option<PathBuf> = None, key("STF-13", PathTo { what: "a label volume" }).absent("no labels");
        /// The names of the labels: a CSV file with an id and a name on each line.
        label_names: Option<PathBuf> = None,
            key("STF-13", PathTo { what: "a table of names" }).absent("labels have no names");
        /// Which label lies between voxels.
        label_lookup: LabelLookup = LabelLookup::Nearest, key("STF-13", LabelLookup::KIND).needs(&[Quantity::Label]);
        /// The values that `unit = "normalized"` maps to 0 and 1.
        range: Option<[f64; 2]> = None,
            key("VAL-1", Numbers { what: "a range [lo, hi]", bounds: Bounds::ANY, rule: Rule::Ascending })
                .absent("the volume's own");
        /// The gradient that |g| = 1 stands for: a quantile of ‖g‖ over the voxels with a normal, or [lo, hi] in value per world
        /// unit.
        gradient_range: GradientRange = GradientRange::Quantile(0.999), key("VAL-2", Quantile);
        /// Which values lie outside a surface.
        outside: Outside = Outside::Low, key("NORM-1", Outside::KIND);
        /// The voxels that are read.
        subset: Subset = Subset::default();
        /// The voxels to read: first and last index along x, y, z, from 0 and both included. The picture is that of a file
        /// with just these voxels, each at its place in the world.
        box_ranges: key("VOL-1", IndexBox, |t| t.subset.ranges, |t, v| t.subset.ranges = Some(v))
            .named("box").absent("the whole volume");
        /// Steps between the voxels to read: one for all axes, or three for x, y, z. 2 reads every second voxel.
        stride: key("VOL-1", Strides, |t| Some(t.subset.stride), |t, v| t.subset.stride = v);
        /// Connected parts that are kept.
        parts: Option<PartsTable> = None, key("VOL-2", TableOf(&parts::TABLE)).absent("everything is kept");
    }
}

/// Source of the voxels.
#[derive(Clone, Debug, PartialEq)]
pub enum VolumeSource {
    /// A volume file, already resolved against the scene's folder.
    File {
        /// Path to open.
        path: PathBuf,
        /// Layout of a file without header.
        raw: Option<RawLayout>,
    },
    /// A phantom of our own ([IO-4]).
    Phantom(PhantomSource),
}

choices! {
    /// Meaning of the values of a volume.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Ids {
        /// Each value stands for itself.
        Values = "values",
        /// Every value above 0 counts as 1, every other as 0; the surface lies at 0.5.
        Mask = "mask",
    }
}

choices! {
    /// Which label lies between voxels ([STF-13]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum LabelLookup {
        /// That of the nearest voxel.
        Nearest = "nearest",
        /// That with the highest sum of trilinear weights among the eight voxels around: borders are not blocky.
        Smooth = "smooth",
    }
}

choices! {
    /// Which values lie outside ([NORM-1]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum Outside {
        /// Values fall towards the outside.
        Low = "low",
        /// Values rise towards the outside.
        High = "high",
    }
}

impl VolumeTable {
    /// The table with every default, for a source.
    pub fn new(source: VolumeSource) -> Self {
        Self { source, ..Self::default() }
    }
}

/// The fault of a template that is drawn without a volume ([VS-11]).
pub(super) fn no_volume() -> Problem {
    Problem::Contradiction {
        what: "the scene is a template: it names no volume".into(),
        remedy:
            "name a volume after the scene on the command line or by volume of a figure's panel, or write file = \"…\" \
                 or phantom = { name = \"…\" } in [volume]"
                .into(),
    }
}

/// The description of `[volume]`.
pub(crate) static TABLE: Table<VolumeTable> = Table {
    instead: &[Instead { one: "phantom", others: &["file"] }],
    check: |_, check| {
        if !check.has("file") && !check.has("phantom") {
            check.fault_in("file", no_volume());
        }
    },
    ..VolumeTable::description(
        "[volume]",
        "The data that is seen: a file, or a phantom of our own. A file that is not there is looked for in the folders \
         that DRYPOINT_DATA lists.",
    )
};
