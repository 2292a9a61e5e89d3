//! `phantom = { … }` of `[volume]`: a volume of our own ([IO-4]).

use super::layout::{LONGEST_AXIS, SPACING, VOXEL_TYPE};
use crate::document::check::Check;
use crate::document::declare::{keys, unless_empty};
use crate::document::describe::{Kind, Names, Shape, Table};
use crate::document::fault::Problem;
use crate::document::item::Item;
use crate::document::kind::{Bounds, FEW, Number, TableOf, Whole, Wholes};
use crate::document::out::Out;
use crate::nearest::nearest;
pub use crate::phantom::PhantomSource;
use crate::phantom::{self, PhantomError};
use crate::volume::VoxelType;
use serde_json::{Value as Json, json};

/// Voxels of a phantom, at most: 32 GiB in its widest type.
const LARGEST_PHANTOM: u64 = 1 << 32;

/// The description of `phantom = { … }`.
pub(super) static PHANTOM: Table<PhantomSource> = Table {
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
        keys! { PhantomSource {
            /// Which phantom.
            name: key("IO-4", PhantomName).required();
            /// Voxels along x, y, z, or one number for all three.
            size: key("IO-4", PhantomSize);
            /// World units between voxels.
            spacing: key("SPACE-2", SPACING);
            /// Stored type of a voxel; values are rounded to it.
            voxel_type: key("IO-4", VOXEL_TYPE).named("type");
            /// Parameters of the phantom by name.
            params: key("IO-4", TableOf(&PARAMS), |t| unless_empty(&t.params)).named("param").absent("the phantom's own");
        } },
    )
};

/// The parameters must be those of the phantom, and make one together.
fn check_phantom(source: &PhantomSource, check: &mut Check) {
    let Some(about) = phantom::describe().iter().find(|about| about.name == source.name) else { return };
    for (name, value) in &source.params {
        let key = format!("param.{}", crate::document::out::key(name));
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
        let (key, what, remedy) = match error {
            PhantomError::Space(_) => {
                let spacing = Out::numbers(&source.spacing).toml();
                let what = format!("voxels of a spacing of {spacing} are flat, or too small");
                ("spacing", what, "write numbers of which none is 10¹² times another, such as [1, 1, 2]".into())
            }
            _ => ("param", error.to_string(), format!("change the parameters: {}", about.doc)),
        };
        check.fault_in(key, Problem::Contradiction { what, remedy });
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
        most: FEW,
        list: |params: &Vec<(String, f64)>| params.clone(),
        add: |params, name, value| params.push((name, value)),
    }),
    ..Table::new("param", "Parameters of a phantom by name.", Vec::new, &[])
};

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
