//! One declaration for a key of a table: its field, its default, its documentation and its description.
//!
//! The first paragraph of a field's or name's doc comment is also the text of the schema and of the reference page;
//! further paragraphs tell what only code has to know, such as units.

use glam::DVec3;

/// A field that holds the value of a key.
pub(crate) trait Holds<T> {
    /// The key's value, if it has one.
    fn get(&self) -> Option<T>;
    /// Takes a value.
    fn set(&mut self, value: T);
}

impl<T: Clone> Holds<T> for T {
    fn get(&self) -> Option<T> {
        Some(self.clone())
    }

    fn set(&mut self, value: T) {
        *self = value;
    }
}

/// A field of a key without default.
impl<T: Clone> Holds<T> for Option<T> {
    fn get(&self) -> Option<T> {
        self.clone()
    }

    fn set(&mut self, value: T) {
        *self = Some(value);
    }
}

impl Holds<u64> for usize {
    fn get(&self) -> Option<u64> {
        Some(*self as u64)
    }

    fn set(&mut self, value: u64) {
        *self = value as Self;
    }
}

impl Holds<[f64; 3]> for DVec3 {
    fn get(&self) -> Option<[f64; 3]> {
        Some(self.to_array())
    }

    fn set(&mut self, value: [f64; 3]) {
        *self = Self::from_array(value);
    }
}

impl Holds<[f64; 3]> for Option<DVec3> {
    fn get(&self) -> Option<[f64; 3]> {
        self.map(|v| v.to_array())
    }

    fn set(&mut self, value: [f64; 3]) {
        *self = Some(DVec3::from_array(value));
    }
}

/// Returns the value of a list's key; none for an empty list.
pub(crate) fn unless_empty<T: Clone>(list: &[T]) -> Option<Vec<T>> {
    (!list.is_empty()).then(|| list.to_vec())
}

/// The keys of a table, each with its documentation, its rule and the kind of its value. A key without closures is the
/// field of the same name. One closure reads the key's value from the table, a second one writes it there; without
/// the second one the field takes the value. Methods of [`Key`](super::describe::Key) follow.
///
/// The macro is for structs that stand in other files. Any other table is a [`table!`](table).
///
/// ```text
/// keys! { RawLayout {
///     /// Bytes before the first voxel.
///     skip: key("IO-1", BYTES);
///     /// Stored type of a voxel.
///     voxel_type: key("IO-1", VOXEL_TYPE).named("type").required();
/// } }
/// ```
macro_rules! keys {
    ($table:ty { $($(#[doc = $doc:literal])+ $name:ident: key($($how:tt)+)$(.$more:ident($($with:tt)*))*;)+ }) => {
        const {
            &[$($crate::document::declare::keys!(key $table, $name, concat!($($doc, "\n"),+), $($how)+)
                $(.$more($($with)*))*),+]
        }
    };
    (key $table:ty, $name:ident, $doc:expr, $tag:literal, $kind:expr) => {
        $crate::document::declare::keys!(
            key $table,
            $name,
            $doc,
            $tag,
            $kind,
            |table| $crate::document::declare::Holds::get(&table.$name)
        )
    };
    (key $table:ty, $name:ident, $doc:expr, $tag:literal, $kind:expr, $get:expr) => {
        $crate::document::declare::keys!(
            key $table,
            $name,
            $doc,
            $tag,
            $kind,
            $get,
            |table, value| $crate::document::declare::Holds::set(&mut table.$name, value)
        )
    };
    (key $table:ty, $name:ident, $doc:expr, $tag:literal, $kind:expr, $get:expr, $set:expr) => {
        $crate::document::describe::Key::new(
            stringify!($name),
            $tag,
            $doc,
            const { &$crate::document::describe::Slot::<$table, _> { kind: $kind, get: $get, set: $set } },
        )
    };
}

/// The struct of a table, its defaults, and its description. The keys stand in the order in which they are read,
/// written and documented. A field has its type, its default, and its key as in [`keys!`](keys).
///
/// If a field has several keys, or none, field and keys stand on lines of their own. A line without `key` is a field
/// alone, and a line with `key` in place of the type is a key alone.
///
/// ```text
/// table! {
///     /// One table `[[mesh]]`.
///     #[derive(Clone, Debug, PartialEq)]
///     pub struct MeshTable {
///         /// The colour of the mesh.
///         color: Rgba = SILVER, key("VS-12", Colors);
///         /// The place of the mesh in the world.
///         motion: Motion = Motion::NONE;
///         /// The way that the mesh is moved.
///         shift: key("VS-12", WAY, |m| …, |m, v| …).named("move");
///     }
/// }
/// ```
macro_rules! table {
    ($(#[$meta:meta])* $visible:vis struct $table:ident { $($lines:tt)+ }) => {
        $crate::document::declare::table! { sort [$(#[$meta])* $visible $table] {} {} $($lines)+ }
    };
    // The lines become a list of fields and a list of keys.
    (sort $head:tt $fields:tt {$($keys:tt)*}
        $(#[doc = $doc:literal])+ $name:ident: key($($how:tt)+) $(.$more:ident($($with:tt)*))*; $($rest:tt)*
    ) => {
        $crate::document::declare::table! {
            sort $head $fields {$($keys)* $(#[doc = $doc])+ $name: key($($how)+)$(.$more($($with)*))*;} $($rest)*
        }
    };
    (sort $head:tt {$($fields:tt)*} $keys:tt
        $(#[doc = $doc:literal])+ $field:ident: $type:ty = $default:expr; $($rest:tt)*
    ) => {
        $crate::document::declare::table! {
            sort $head {$($fields)* $(#[doc = $doc])+ $field: $type = $default;} $keys $($rest)*
        }
    };
    (sort $head:tt {$($fields:tt)*} {$($keys:tt)*}
        $(#[doc = $doc:literal])+ $field:ident: $type:ty = $default:expr,
            key($($how:tt)+) $(.$more:ident($($with:tt)*))*; $($rest:tt)*
    ) => {
        $crate::document::declare::table! {
            sort $head
            {$($fields)* $(#[doc = $doc])+ $field: $type = $default;}
            {$($keys)* $(#[doc = $doc])+ $field: key($($how)+)$(.$more($($with)*))*;}
            $($rest)*
        }
    };
    (sort [$(#[$meta:meta])* $visible:vis $table:ident]
        {$($(#[doc = $doc:literal])+ $field:ident: $type:ty = $default:expr;)+} {$($keys:tt)+}
    ) => {
        $(#[$meta])*
        #[allow(rustdoc::broken_intra_doc_links, reason = "[name] is a table of a scene file")]
        $visible struct $table {
            $($(#[doc = $doc])+ $visible $field: $type,)+
        }

        impl Default for $table {
            fn default() -> Self {
                Self { $($field: $default),+ }
            }
        }

        impl $table {
            /// The description of a table that consists of its keys only.
            const fn description(title: &'static str, doc: &'static str) -> $crate::document::describe::Table<Self> {
                let keys = $crate::document::declare::keys! { $table { $($keys)+ } };
                $crate::document::describe::Table::new(title, doc, Self::default, keys)
            }
        }
    };
}

/// An enum whose values have names in scene files, which are its serialization, and their `KIND`.
///
/// ```text
/// choices! {
///     /// The distance that `step` is measured along.
///     #[derive(Clone, Copy, PartialEq)]
///     pub enum StepAlong {
///         /// View-aligned planes.
///         Plane = "plane",
///     }
/// }
/// ```
macro_rules! choices {
    (
        $(#[$meta:meta])*
        $visible:vis enum $choice:ident { $($(#[doc = $doc:literal])+ $value:ident = $name:literal,)+ }
    ) => {
        $(#[$meta])*
        #[derive(serde::Serialize)]
        #[allow(rustdoc::broken_intra_doc_links, reason = "[name] is a table of a scene file")]
        $visible enum $choice { $($(#[doc = $doc])+ #[serde(rename = $name)] $value,)+ }

        impl $choice {
            /// The values by name.
            pub(crate) const KIND: $crate::document::kind::Choice<Self> = $crate::document::kind::Choice {
                options: &[$($crate::document::kind::ChoiceOption::new(
                    $name,
                    Self::$value,
                    concat!($($doc, "\n"),+),
                )),+],
            };
        }
    };
}

pub(crate) use {choices, keys, table};
