//! The JSON Schema of scene files, for editors ([IO-3]).

use super::describe::{Section, SectionKey};
use super::out::Out;
use serde_json::{Map, Value, json};

/// The JSON Schema (2020-12) of a document.
pub(crate) fn document(title: &str, root: &Section) -> Value {
    let mut schema = table(root);
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!(title);
    schema
}

/// The schema of a table.
pub(crate) fn table(section: &Section) -> Value {
    let properties: Map<String, Value> = section.keys.iter().map(|key| (key.name.to_owned(), property(key))).collect();
    let required: Vec<&str> = section.keys.iter().filter(|key| key.required).map(|key| key.name).collect();
    let others = match &section.open {
        None => json!(false),
        Some(open) => with(open.shape.schema(), "description", json!(open.doc)),
    };
    let mut schema = json!({
        "type": "object",
        "description": section.doc,
        "properties": properties,
        "additionalProperties": others,
    });
    if let Some(open) = &section.open {
        schema["maxProperties"] = json!(section.keys.len() + open.most);
    }
    if !required.is_empty() {
        schema["required"] = json!(required);
    }
    schema
}

fn property(key: &SectionKey) -> Value {
    let mut doc = key.doc.clone();
    if !key.absent.is_empty() {
        doc += &format!(" Without the key: {}.", key.absent);
    }
    if !key.tag.is_empty() {
        doc += &format!(" [{}]", key.tag);
    }
    let schema = with(key.shape.schema(), "description", json!(doc));
    match &key.default {
        // The defaults of a table stand with its keys.
        None | Some(Out::Table(_)) => schema,
        Some(default) => with(schema, "default", default.json()),
    }
}

fn with(mut schema: Value, name: &str, value: Value) -> Value {
    schema[name] = value;
    schema
}
