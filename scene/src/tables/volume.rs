//! `[volume]`: the data that is seen.

use crate::file::check::Check;
use crate::file::describe::{Instead, Key, Kind, Names, Shape, Slot, Table};
use crate::file::fault::Problem;
use crate::file::item::{Item, Value};
use crate::file::kind::{Bounds, Choice, ChoiceOption, Number, Numbers, PathTo, Rule, TableOf, Whole, Wholes};
use crate::file::out::Out;
use crate::nearest::nearest;
use crate::phantom;
use crate::plan::{Pass, Quantity};
use crate::tables::{NormalSide, Unit};
use crate::volume::VoxelType;
use serde_json::{Value as Json, json};
use std::path::PathBuf;

/// The table `[volume]`.
#[derive(Clone, Debug, PartialEq)]
pub struct VolumeTable {
    /// Where the voxels come from.
    pub source: VolumeSource,
    /// What the values mean.
    pub ids: Ids,
    /// The file of the label volume beside the data, resolved as the volume's ([STF-13]).
    pub labels: Option<PathBuf>,
    /// The table of its labels' names.
    pub label_names: Option<PathBuf>,
    /// Which label lies between voxels.
    pub label_lookup: LabelLookup,
    /// The value range of `normalized` ([VAL-1]); none: the volume's own.
    pub range: Option<[f64; 2]>,
    /// The range of ‖g‖ that |g| maps to [0, 1] ([VAL-2]).
    pub gradient_range: GradientRange,
    /// Which values lie outside a surface ([NORM-1]).
    pub outside: Outside,
}

/// Where the voxels come from.
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

/// Layout of raw voxels.
#[derive(Clone, Debug, PartialEq)]
pub struct RawLayout {
    /// Voxels along x, y, z.
    pub size: [usize; 3],
    /// Stored type.
    pub voxel_type: VoxelType,
    /// Whether the bytes of a number come highest first.
    pub big_endian: bool,
    /// World units between voxels.
    pub spacing: [f64; 3],
    /// Bytes before the first voxel.
    pub skip: u64,
}

/// A phantom by name.
#[derive(Clone, Debug, PartialEq)]
pub struct PhantomSource {
    /// Which phantom.
    pub name: String,
    /// Voxels along x, y, z.
    pub size: [usize; 3],
    /// World units between voxels.
    pub spacing: [f64; 3],
    /// Stored type.
    pub voxel_type: VoxelType,
    /// Parameters by name; those not given have their defaults.
    pub params: Vec<(String, f64)>,
}

/// What the values of a volume mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ids {
    /// A quantity: between two values lie all that are between them.
    Values,
    /// Ids of parts, between which nothing lies: what has an id above 0 is 1, all else 0.
    Mask,
}

/// Which label lies between voxels ([STF-13]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LabelLookup {
    /// That of the nearest voxel.
    Nearest,
    /// That with the highest sum of trilinear weights among the eight voxels around.
    Smooth,
}

/// What |g| = 1 stands for ([VAL-2]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GradientRange {
    /// lo = 0, hi the quantile of ‖g‖ over the voxels with a normal; `"max"` is the quantile 1.
    Quantile(f64),
    /// lo and hi in value per world unit.
    Fixed([f64; 2]),
}

/// Which values lie outside ([NORM-1]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// Values fall towards the outside: N = −g/‖g‖.
    Low,
    /// Values rise towards the outside: N = +g/‖g‖.
    High,
}

impl VolumeTable {
    /// The table with every default, for a source.
    pub fn new(source: VolumeSource) -> Self {
        Self {
            source,
            ids: Ids::Values,
            labels: None,
            label_names: None,
            label_lookup: LabelLookup::Nearest,
            range: None,
            gradient_range: GradientRange::Quantile(0.999),
            outside: Outside::Low,
        }
    }
}

/// Voxels along an axis of a phantom or of raw data, at most: the product of three stays below 2⁶⁴.
const LONGEST_AXIS: u64 = 1 << 20;

/// Voxels of a phantom, at most: 32 GiB in its widest type.
const LARGEST_PHANTOM: u64 = 1 << 32;

/// Stored types by name.
const VOXEL_TYPE: Choice<VoxelType> = Choice {
    options: &[
        ChoiceOption::new("u8", VoxelType::U8, "Unsigned 8-bit."),
        ChoiceOption::new("i8", VoxelType::I8, "Signed 8-bit."),
        ChoiceOption::new("u16", VoxelType::U16, "Unsigned 16-bit."),
        ChoiceOption::new("i16", VoxelType::I16, "Signed 16-bit."),
        ChoiceOption::new("u32", VoxelType::U32, "Unsigned 32-bit."),
        ChoiceOption::new("i32", VoxelType::I32, "Signed 32-bit."),
        ChoiceOption::new("u64", VoxelType::U64, "Unsigned 64-bit."),
        ChoiceOption::new("i64", VoxelType::I64, "Signed 64-bit."),
        ChoiceOption::new("f32", VoxelType::F32, "IEEE 754 binary32."),
        ChoiceOption::new("f64", VoxelType::F64, "IEEE 754 binary64."),
    ],
    later: &[],
};

/// World units between voxels.
const SPACING: Numbers<3> = Numbers { what: "a spacing [x, y, z]", bounds: Bounds::POSITIVE, rule: Rule::Free };

/// The description of `[volume]`.
pub(crate) static TABLE: Table<VolumeTable> = Table {
    instead: &[Instead { one: "phantom", others: &["file"] }],
    check: |_, check| {
        if !check.has("file") && !check.has("phantom") {
            let expected = "file = \"…\", or phantom = { name = \"…\" }".into();
            check.fault_in("file", Problem::Missing { expected });
        }
    },
    serves: |scene, asks| {
        if let (GradientRange::Quantile(_), Some(need)) =
            (scene.volume.gradient_range, asks.first(Quantity::GradientMagnitudeRange))
        {
            let effect = need.effect.clone();
            asks.pass(Pass::GradientRange, &effect, "volume.gradient_range");
        }
    },
    idle: |scene, plan, idle| {
        if matches!(scene.volume.source, VolumeSource::Phantom(_)) {
            idle.key("volume.raw", "a phantom has no file");
        }
        let stippled = scene.stipples.is_some();
        if !stippled && scene.transfer.as_ref().is_some_and(|transfer| transfer.unit != Unit::Normalized) {
            idle.key("volume.range", "only transfer.unit = \"normalized\" is measured in it");
        }
        let why = match scene.volume.labels {
            Some(_) if plan.reads_labels() => None,
            Some(_) => Some("nothing reads a label"),
            None => Some("volume.labels names no label volume"),
        };
        if let Some(why) = why {
            for key in ["volume.labels", "volume.label_names", "volume.label_lookup"] {
                idle.key(key, why);
            }
        }
        if !stippled && !plan.needs(Quantity::GradientMagnitudeRange) {
            idle.key("volume.gradient_range", "nothing reads |g|");
        }
        let turned = scene.sampling.normal == NormalSide::Outward || plan.needs_at_first(Quantity::Hessian);
        if !(stippled || scene.has_strokes() || turned && plan.reads_gradients()) {
            idle.key("volume.outside", "nothing reads an outward normal or a signed curvature");
        }
    },
    ..Table::new(
        "[volume]",
        "The data that is seen: a file, or a phantom of our own. A file that is not there is looked for in the folders \
         that DRYPOINT_DATA lists.",
        || VolumeTable::new(VolumeSource::File { path: PathBuf::new(), raw: None }),
        &[
            Key::new(
                "file",
                "IO-1",
                "A volume file: NRRD, NIfTI, MetaImage or raw voxels.",
                &Slot {
                    kind: PathTo { what: "a volume" },
                    get: |t: &VolumeTable| match &t.source {
                        VolumeSource::File { path, .. } => Some(path.clone()).filter(|path| path.as_os_str() != ""),
                        VolumeSource::Phantom(_) => None,
                    },
                    set: |t, path| t.source = VolumeSource::File { path, raw: None },
                },
            )
            .absent("`phantom` in its place"),
            Key::new(
                "phantom",
                "IO-4",
                "A volume with known truth, made by the program.",
                &Slot {
                    kind: TableOf(&PHANTOM),
                    get: |t: &VolumeTable| match &t.source {
                        VolumeSource::File { .. } => None,
                        VolumeSource::Phantom(phantom) => Some(phantom.clone()),
                    },
                    set: |t, phantom| t.source = VolumeSource::Phantom(phantom),
                },
            )
            .absent("`file` in its place"),
            Key::new(
                "raw",
                "IO-1",
                "Layout of a file without a header. FILE.toml beside it may hold the same.",
                &Slot {
                    kind: TableOf(&RAW),
                    get: |t: &VolumeTable| match &t.source {
                        VolumeSource::File { raw, .. } => raw.clone(),
                        VolumeSource::Phantom(_) => None,
                    },
                    set: |t, layout| {
                        if let VolumeSource::File { raw, .. } = &mut t.source {
                            *raw = Some(layout);
                        }
                    },
                },
            )
            .absent("the file's header, or FILE.toml beside it"),
            Key::new(
                "ids",
                "STF-13",
                "What the values mean: quantities, or the ids of parts that are shown as one.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("values", Ids::Values, "Each value stands for itself."),
                            ChoiceOption::new(
                                "mask",
                                Ids::Mask,
                                "Every value above 0 counts as 1, every other as 0; the surface lies at 0.5.",
                            ),
                        ],
                        later: &[],
                    },
                    get: |t: &VolumeTable| Some(t.ids),
                    set: |t, v| t.ids = v,
                },
            ),
            Key::new(
                "labels",
                "STF-13",
                "A label volume beside the data: which part each voxel belongs to, as whole numbers from 0. It may lie on \
                 another grid; outside its box the label is 0.",
                &Slot {
                    kind: PathTo { what: "a label volume" },
                    get: |t: &VolumeTable| t.labels.clone(),
                    set: |t, path| t.labels = Some(path),
                },
            )
            .absent("no labels"),
            Key::new(
                "label_names",
                "STF-13",
                "The names of the labels: a CSV file with an id and a name on each line.",
                &Slot {
                    kind: PathTo { what: "a table of names" },
                    get: |t: &VolumeTable| t.label_names.clone(),
                    set: |t, path| t.label_names = Some(path),
                },
            )
            .absent("labels have no names"),
            Key::new(
                "label_lookup",
                "STF-13",
                "Which label lies between voxels.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("nearest", LabelLookup::Nearest, "That of the nearest voxel."),
                            ChoiceOption::new(
                                "smooth",
                                LabelLookup::Smooth,
                                "That with the highest sum of trilinear weights among the eight voxels around: borders \
                                 are not blocky.",
                            ),
                        ],
                        later: &[],
                    },
                    get: |t: &VolumeTable| Some(t.label_lookup),
                    set: |t, v| t.label_lookup = v,
                },
            )
            .needs(&[Quantity::Label]),
            Key::new(
                "range",
                "VAL-1",
                "The values that `unit = \"normalized\"` maps to 0 and 1.",
                &Slot {
                    kind: Numbers { what: "a range [lo, hi]", bounds: Bounds::ANY, rule: Rule::Ascending },
                    get: |t: &VolumeTable| t.range,
                    set: |t, v| t.range = Some(v),
                },
            )
            .absent("the volume's own"),
            Key::new(
                "gradient_range",
                "VAL-2",
                "What |g| = 1 stands for: a quantile of ‖g‖ over the voxels with a normal, or [lo, hi] in value per \
                 world unit.",
                &Slot {
                    kind: Quantile,
                    get: |t: &VolumeTable| Some(t.gradient_range),
                    set: |t, v| t.gradient_range = v,
                },
            ),
            Key::new(
                "outside",
                "NORM-1",
                "Which values lie outside a surface.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("low", Outside::Low, "Values fall towards the outside."),
                            ChoiceOption::new("high", Outside::High, "Values rise towards the outside."),
                        ],
                        later: &[],
                    },
                    get: |t: &VolumeTable| Some(t.outside),
                    set: |t, v| t.outside = v,
                },
            ),
        ],
    )
};

/// The description of `phantom = { … }`.
static PHANTOM: Table<PhantomSource> = Table {
    check: check_phantom,
    ..Table::new(
        "phantom",
        "A volume with known truth.",
        || PhantomSource {
            name: String::new(),
            size: [128; 3],
            spacing: [1.0; 3],
            voxel_type: VoxelType::U8,
            params: Vec::new(),
        },
        &[
            Key::new(
                "name",
                "IO-4",
                "Which phantom.",
                &Slot { kind: PhantomName, get: |t: &PhantomSource| Some(t.name.clone()), set: |t, v| t.name = v },
            )
            .required(),
            Key::new(
                "size",
                "IO-4",
                "Voxels along x, y, z, or one number for all three.",
                &Slot { kind: PhantomSize, get: |t: &PhantomSource| Some(t.size), set: |t, v| t.size = v },
            ),
            Key::new(
                "spacing",
                "SPACE-2",
                "World units between voxels.",
                &Slot { kind: SPACING, get: |t: &PhantomSource| Some(t.spacing), set: |t, v| t.spacing = v },
            ),
            Key::new(
                "type",
                "IO-4",
                "Stored type of a voxel; values are rounded to it.",
                &Slot { kind: VOXEL_TYPE, get: |t: &PhantomSource| Some(t.voxel_type), set: |t, v| t.voxel_type = v },
            ),
            Key::new(
                "param",
                "IO-4",
                "Parameters of the phantom by name.",
                &Slot {
                    kind: TableOf(&PARAMS),
                    get: |t: &PhantomSource| Some(t.params.clone()).filter(|params| !params.is_empty()),
                    set: |t, v| t.params = v,
                },
            )
            .absent("the phantom's own"),
        ],
    )
};

/// The parameters must be those of the phantom, and make one together.
fn check_phantom(source: &PhantomSource, check: &mut Check) {
    let Some(about) = phantom::describe().iter().find(|about| about.name == source.name) else { return };
    for (name, value) in &source.params {
        let key = format!("param.{}", crate::file::out::key(name));
        match about.params.iter().find(|param| param.name == name) {
            None => {
                let known = about.params.iter().map(|param| param.name);
                let nearest = nearest(name, known.clone()).map(Into::into);
                let known = known.map(Into::into).collect();
                let table = format!("the phantom {:?}", about.name);
                check.fault_in(&key, Problem::UnknownKey { table, name: name.clone(), nearest, known });
            }
            Some(param) if !param.allowed.holds(*value) => {
                let (found, expected) = (value.to_string(), param.allowed.to_string());
                check.fault_in(&key, Problem::Value { found, expected, nearest: None });
            }
            Some(_) => {}
        }
    }
    if check.sound(&["size", "spacing", "type", "param"])
        && let Err(error) = phantom::of_source(source)
    {
        let remedy = format!("change the parameters: {}", about.doc);
        check.fault_in("param", Problem::Contradiction { what: error.to_string(), remedy });
    }
}

/// The name of a phantom.
struct PhantomName;

impl Shape for PhantomName {
    fn expected(&self) -> String {
        format!("the name of a phantom: {}", phantom::names().join(", "))
    }

    fn schema(&self) -> Json {
        json!({ "enum": phantom::names() })
    }
}

impl Kind for PhantomName {
    type Of = String;

    fn read(&self, item: &Item, check: &mut Check) -> Option<String> {
        let Some(name) = item.text() else { return check.wrong(item, self.expected()) };
        if phantom::names().contains(&name) {
            return Some(name.to_owned());
        }
        check.wrong_name(item, self.expected(), nearest(name, phantom::names()).map(Into::into))
    }

    fn write(&self, value: &String) -> Out {
        Out::Text(value.clone())
    }
}

/// The description of `param = { … }`.
static PARAMS: Table<Vec<(String, f64)>> = Table {
    open: Some(&Names {
        kind: Number { bounds: Bounds::ANY, unit: "" },
        doc: "A parameter of the phantom.",
        list: |params: &Vec<(String, f64)>| params.clone(),
        add: |params, name, value| params.push((name, value)),
    }),
    ..Table::new("param", "Parameters of a phantom by name.", Vec::new, &[])
};

/// The description of `raw = { … }`.
static RAW: Table<RawLayout> = Table::new(
    "raw",
    "Layout of a file without a header.",
    || RawLayout { size: [0; 3], voxel_type: VoxelType::U8, big_endian: false, spacing: [1.0; 3], skip: 0 },
    &[
        Key::new(
            "size",
            "IO-1",
            "Voxels along x, y, z; x is fastest.",
            &Slot {
                kind: Wholes {
                    what: "a size [x, y, z]",
                    each: Whole { lo: 1, hi: LONGEST_AXIS },
                    product: u64::MAX >> 4,
                    of_what: "voxels",
                },
                get: |t: &RawLayout| Some(t.size),
                set: |t, v| t.size = v,
            },
        )
        .required(),
        Key::new(
            "type",
            "IO-1",
            "Stored type of a voxel.",
            &Slot { kind: VOXEL_TYPE, get: |t: &RawLayout| Some(t.voxel_type), set: |t, v| t.voxel_type = v },
        )
        .required(),
        Key::new(
            "endian",
            "IO-1",
            "Order of the bytes of a number.",
            &Slot {
                kind: Choice {
                    options: &[
                        ChoiceOption::new("little", false, "Lowest byte first."),
                        ChoiceOption::new("big", true, "Highest byte first."),
                    ],
                    later: &[],
                },
                get: |t: &RawLayout| Some(t.big_endian),
                set: |t, v| t.big_endian = v,
            },
        ),
        Key::new(
            "spacing",
            "SPACE-2",
            "World units between voxels.",
            &Slot { kind: SPACING, get: |t: &RawLayout| Some(t.spacing), set: |t, v| t.spacing = v },
        ),
        Key::new(
            "skip",
            "IO-1",
            "Bytes before the first voxel.",
            &Slot {
                kind: Whole { lo: 0, hi: i64::MAX as u64 },
                get: |t: &RawLayout| Some(t.skip),
                set: |t, v| t.skip = v,
            },
        ),
    ],
);

/// The size of a phantom: `128` or `[x, y, z]`.
struct PhantomSize;

impl PhantomSize {
    const AXES: Wholes<3> = Wholes {
        what: "a size, a whole number or [x, y, z]",
        each: Whole { lo: 1, hi: LONGEST_AXIS },
        product: LARGEST_PHANTOM,
        of_what: "voxels in all",
    };
}

impl Shape for PhantomSize {
    fn expected(&self) -> String {
        Self::AXES.expected()
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [Self::AXES.each.schema(), Self::AXES.schema()] })
    }
}

impl Kind for PhantomSize {
    type Of = [usize; 3];

    fn read(&self, item: &Item, check: &mut Check) -> Option<[usize; 3]> {
        let size = match Self::AXES.each.of(item) {
            Some(n) => Self::AXES.fits([n; 3]),
            None => Self::AXES.of(item),
        };
        size.or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, &[x, y, z]: &[usize; 3]) -> Out {
        if x == y && y == z { Out::Whole(x as u64) } else { Self::AXES.write(&[x, y, z]) }
    }
}

/// `"q0.999"`, `"max"` or `[lo, hi]`.
struct Quantile;

impl Quantile {
    const RANGE: Numbers<2> = Numbers { what: "a range [lo, hi]", bounds: Bounds::NOT_NEGATIVE, rule: Rule::Ascending };
}

impl Shape for Quantile {
    fn expected(&self) -> String {
        "a quantile from \"q0\" to \"q1\", \"max\", or a range [lo, hi] of at least 0, the lower one first".into()
    }

    fn schema(&self) -> Json {
        let quantile = json!({ "type": "string", "pattern": r"^(max|q(0(\.[0-9]*)?|1(\.0*)?|\.[0-9]+))$" });
        json!({ "anyOf": [quantile, Self::RANGE.schema()] })
    }
}

impl Kind for Quantile {
    type Of = GradientRange;

    fn read(&self, item: &Item, check: &mut Check) -> Option<GradientRange> {
        let range = match &item.value {
            Value::Text(text) if text == "max" => Some(GradientRange::Quantile(1.0)),
            Value::Text(text) => quantile(text).map(GradientRange::Quantile),
            _ => Self::RANGE.of(item).map(GradientRange::Fixed),
        };
        range.or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &GradientRange) -> Out {
        match *value {
            GradientRange::Quantile(1.0) => Out::Text("max".into()),
            GradientRange::Quantile(q) => Out::Text(format!("q{q}")),
            GradientRange::Fixed(range) => Out::numbers(&range),
        }
    }
}

/// The number of `"q0.999"`: digits and a point only, at most 1.
pub(crate) fn quantile(text: &str) -> Option<f64> {
    let digits = text.strip_prefix('q')?;
    let plain = digits.bytes().all(|b| b.is_ascii_digit() || b == b'.');
    digits.parse().ok().filter(|q| plain && Bounds::UNIT.contain(*q))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles() {
        for (text, q) in [("q0.999", Some(0.999)), ("q0", Some(0.0)), ("q1", Some(1.0)), ("q.5", Some(0.5))] {
            assert_eq!(quantile(text), q, "{text}");
        }
        for text in ["", "q", "0.5", "q1.1", "q-0", "qnan", "q1e-3", "p50", "Q0.5"] {
            assert_eq!(quantile(text), None, "{text}");
        }
    }
}
