//! Rows of a file of JSON lines, an object a line.

use super::{ListColumn, RowError, RowReader};
use drypoint_scene::memory::Metered;
use serde_json::{Map, Value};
use std::fs::File;
use std::io::{BufRead, BufReader};

pub(super) struct JsonRows {
    file: BufReader<Metered<File>>,
    text: Vec<u8>,
    row: Map<String, Value>,
    line: u64,
}

impl JsonRows {
    pub(super) fn new(file: Metered<File>) -> Self {
        Self { file: BufReader::new(file), text: Vec::new(), row: Map::new(), line: 0 }
    }
}

impl RowReader for JsonRows {
    fn next(&mut self) -> Result<bool, RowError> {
        loop {
            self.text.clear();
            self.line += 1;
            let wrong = |at: usize, fault: &str| RowError::Row(format!("character {at}"), fault.into());
            let read = self.file.read_until(b'\n', &mut self.text).map_err(RowError::File)?;
            if read == 0 {
                return Ok(false);
            }
            if self.text.trim_ascii().is_empty() {
                continue;
            }
            self.row = serde_json::from_slice(self.text.trim_ascii_end())
                .map_err(|error| wrong(error.column().max(1), "is not one JSON object"))?;
            return Ok(true);
        }
    }

    fn line(&self) -> u64 {
        self.line
    }

    fn has(&self, column: ListColumn) -> bool {
        self.row.contains_key(column.name())
    }

    fn number(&self, column: ListColumn) -> Option<f64> {
        self.row.get(column.name()).and_then(Value::as_f64)
    }

    fn text(&self, column: ListColumn) -> Option<&str> {
        self.row.get(column.name()).and_then(Value::as_str).map(str::trim)
    }

    fn found(&self, column: ListColumn) -> Option<String> {
        self.row.get(column.name()).map(Value::to_string)
    }
}
