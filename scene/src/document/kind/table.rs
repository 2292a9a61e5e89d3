//! Tables inside tables; a scene file itself is one.

use crate::document::check::Check;
use crate::document::describe::{Kind, Section, Shape, Table};
use crate::document::item::Item;
use crate::document::out::Out;
use crate::document::schema;
use serde_json::Value as Json;

/// A table as its description says.
pub(crate) struct TableOf<S: 'static>(pub(crate) &'static Table<S>);

impl<S> Shape for TableOf<S> {
    fn expected(&self) -> String {
        self.0.head().expected()
    }

    fn schema(&self) -> Json {
        schema::table(&self.0.section())
    }

    fn section(&self) -> Option<Section> {
        Some(self.0.section())
    }
}

impl<S> Kind for TableOf<S> {
    type Of = S;

    fn read(&self, item: &Item, check: &mut Check) -> Option<S> {
        check.table(self.0, item)
    }

    fn read_over(&self, item: &Item, supplied: S, check: &mut Check) -> Option<S> {
        check.table_over(self.0, item, Some(supplied))
    }

    fn write(&self, value: &S) -> Out {
        // Loops, which unlike closures are compiled with their table alone.
        let mut entries = Vec::new();
        for key in self.0.keys {
            if let Some(out) = key.field.write(value) {
                entries.push((key.name.to_owned(), out));
            }
        }
        if let Some(open) = self.0.open {
            entries.append(&mut open.write(value));
        }
        Out::Table(entries)
    }
}
