//! Rows of a CSV file.

use super::{ListColumn, RowError, RowReader};
use crate::list::COLUMNS;
use csv::{ByteRecord, Position, Reader};
use drypoint_scene::memory::Metered;
use std::fs::File;

pub(super) struct CsvRows {
    table: Reader<Metered<File>>,
    /// Position of each of [`ListColumn::NAMES`] in a row; none where the file does not have it.
    at: [Option<usize>; ListColumn::NAMES.len()],
    row: ByteRecord,
    line: u64,
}

impl CsvRows {
    /// Reads the header.
    pub(super) fn new(file: Metered<File>) -> Result<Self, RowError> {
        // Rows of a different length are reported by the column that is missing.
        let mut table = csv::ReaderBuilder::new().flexible(true).from_reader(file);
        let header = table.byte_headers().map_err(broken)?;
        let find = |name: &str| header.iter().position(|column| column.trim_ascii() == name.as_bytes());
        let at = ListColumn::NAMES.map(find);
        let with_strokes = if at[ListColumn::Stroke as usize].is_some() { &["t"][..] } else { &[] };
        if let Some(absent) = COLUMNS.iter().chain(with_strokes).find(|name| find(name).is_none()) {
            return Err(RowError::Row(absent.to_string(), format!("the column {absent} is missing")));
        }
        Ok(Self { table, at, row: ByteRecord::new(), line: 1 })
    }

    fn bytes(&self, column: ListColumn) -> Option<&[u8]> {
        self.at[column as usize].and_then(|at| self.row.get(at))
    }
}

/// Returns the error of a file whose rest cannot be read.
fn broken(error: csv::Error) -> RowError {
    match error.into_kind() {
        csv::ErrorKind::Io(source) => RowError::File(source),
        _ => RowError::Row("x".into(), "the rest is no CSV".into()),
    }
}

impl RowReader for CsvRows {
    fn next(&mut self) -> Result<bool, RowError> {
        let is_row = self.table.read_byte_record(&mut self.row).map_err(broken)?;
        self.line = self.row.position().map_or(0, Position::line);
        Ok(is_row)
    }

    fn line(&self) -> u64 {
        self.line
    }

    fn has(&self, column: ListColumn) -> bool {
        self.at[column as usize].is_some()
    }

    fn number(&self, column: ListColumn) -> Option<f64> {
        self.text(column).and_then(|text| text.parse().ok())
    }

    fn text(&self, column: ListColumn) -> Option<&str> {
        self.bytes(column).and_then(|bytes| std::str::from_utf8(bytes).ok()).map(str::trim)
    }

    fn found(&self, column: ListColumn) -> Option<String> {
        self.bytes(column).map(|bytes| format!("{:?}", String::from_utf8_lossy(bytes)))
    }
}
