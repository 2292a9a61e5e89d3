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
        let keys = self.0.keys.iter().filter_map(|key| key.field.write(value).map(|out| (key.name.to_owned(), out)));
        let open = self.0.open.map(|open| open.write(value)).unwrap_or_default();
        Out::Table(keys.chain(open).collect())
    }
}
