//! `[[object]]`: a selection of the data, which can be moved away from its ghost, and cutaways for it ([VS-2], [VS-7]).

mod ghost;
mod motion;
mod part_name;
mod scene_of;
mod strokes;
mod table;

pub use ghost::GhostTable;
pub(crate) use motion::{Factors, Matrix, ROTATION};
pub use motion::{Motion, Rotation};
pub use part_name::PartName;
pub(crate) use part_name::PartNames;
pub use scene_of::Role;
pub use strokes::{Brush, Connectivity, PaintMode, PaintStroke, PaintTarget};
pub(crate) use table::TABLE;
pub use table::{Cut, InteractionState, ObjectTable};
