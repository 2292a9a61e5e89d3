//! The types of values that keys can have.

mod choice;
mod color;
mod length;
mod list;
mod number;
mod path;
mod table;
mod text;
mod vector;

pub(crate) use choice::{Choice, ChoiceOption};
pub(crate) use color::{Colors, nearest_color, parse_color};
pub(crate) use length::{Lengths, On, WORLD_LENGTH};
pub(crate) use list::{FEW, ListOf, MANY};
pub(crate) use number::{Bounds, End, Flag, Number, Whole};
pub(crate) use path::PathTo;
pub(crate) use table::TableOf;
pub(crate) use text::Text;
pub(crate) use vector::{Numbers, Rule, Wholes};
