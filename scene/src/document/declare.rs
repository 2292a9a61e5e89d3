//! One declaration for a key of a table: its field, its default, its documentation and its description.
//!
//! The first paragraph of a field's or name's doc comment is also the text of the schema and of the reference page;
//! further paragraphs tell what only code has to know, such as units.

use glam::DVec3;

/// A field that holds the value of a key.
pub(crate) trait Holds<T> {
    /// The key's value; none where it has none.
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

/// The field of a key without default.
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

/// A key that has the name of its field: `key!(Camera.up, "Up in the picture.", "RAY-5", DIRECTION)`. A value that is not
/// in the field alone has a way out and a way in, two closures after the kind.
macro_rules! key {
    ($table:ident.$field:ident, $doc:expr, $tag:literal, $kind:expr) => {
        $crate::document::declare::key!(
            $table.$field,
            $doc,
            $tag,
            $kind,
            |table| $crate::document::declare::Holds::get(&table.$field),
            |table, value| $crate::document::declare::Holds::set(&mut table.$field, value)
        )
    };
    ($table:ident.$field:ident, $doc:expr, $tag:literal, $kind:expr, $get:expr, $set:expr) => {
        $crate::document::describe::Key::new(
            stringify!($field),
            $tag,
            $doc,
            const { &$crate::document::describe::Slot::<$table, _> { kind: $kind, get: $get, set: $set } },
        )
    };
}

/// The struct of a table with its defaults and its description, a key for each field, in their order. A field says its
/// type, its default, and as `key` the rule and the kind of its value; what a [`Key`](super::describe::Key) says beyond
/// that follows.
macro_rules! table {
    (
        $(#[$meta:meta])*
        pub struct $table:ident {
            $($(#[doc = $doc:literal])+ $field:ident: $type:ty = $default:expr,
                key($($how:tt)+)$(.$more:ident($($with:tt)*))*;)+
        }
    ) => {
        $(#[$meta])*
        #[allow(rustdoc::broken_intra_doc_links, reason = "[name] is a table of a scene file")]
        pub struct $table {
            $($(#[doc = $doc])+ pub $field: $type,)+
        }

        impl Default for $table {
            fn default() -> Self {
                Self { $($field: $default),+ }
            }
        }

        impl $table {
            /// The description of a table with these keys and no more to say of itself.
            const fn table(title: &'static str, doc: &'static str) -> $crate::document::describe::Table<Self> {
                $crate::document::describe::Table::new(title, doc, Self::default, const { &[
                    $($crate::document::declare::key!($table.$field, concat!($($doc, "\n"),+), $($how)+)
                        $(.$more($($with)*))*),+
                ] })
            }
        }
    };
}

/// An enum whose values have names in scene files, and their `KIND`. Names of values that are not built yet follow it.
macro_rules! choices {
    (
        $(#[$meta:meta])*
        $visible:vis enum $choice:ident { $($(#[doc = $doc:literal])+ $value:ident = $name:literal,)+ }
        $(later $later:expr)?
    ) => {
        $(#[$meta])*
        #[allow(rustdoc::broken_intra_doc_links, reason = "[name] is a table of a scene file")]
        $visible enum $choice { $($(#[doc = $doc])+ $value,)+ }

        impl $choice {
            /// The values by name.
            pub(crate) const KIND: $crate::document::kind::Choice<Self> = $crate::document::kind::Choice {
                options: &[$($crate::document::kind::ChoiceOption::new(
                    $name,
                    Self::$value,
                    concat!($($doc, "\n"),+),
                )),+],
                later: $crate::document::declare::choices!(later $($later)?),
            };
        }
    };
    (later $later:expr) => { $later };
    (later) => { &[] };
}

pub(crate) use {choices, key, table};
