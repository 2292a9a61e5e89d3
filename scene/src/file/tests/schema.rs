//! The schema takes what the parser takes.

use super::round_trip::FULL_OF_KEYS;
use super::*;
use serde_json::{Value, json};

/// Whether a value is as a schema says, for the words that ours is made of; `pattern` is left to the parser's tests.
fn valid(schema: &Value, value: &Value) -> bool {
    let Value::Object(words) = schema else { return schema == &json!(true) };
    words.iter().all(|(word, rule)| match word.as_str() {
        "type" => match rule.as_str().unwrap() {
            "object" => value.is_object(),
            "array" => value.is_array(),
            "string" => value.is_string(),
            "boolean" => value.is_boolean(),
            "integer" => value.is_i64() || value.is_u64(),
            "number" => value.is_number(),
            other => panic!("type {other}"),
        },
        "const" => rule == value,
        "enum" => rule.as_array().unwrap().contains(value),
        "anyOf" => rule.as_array().unwrap().iter().any(|s| valid(s, value)),
        "oneOf" => rule.as_array().unwrap().iter().filter(|s| valid(s, value)).count() == 1,
        "minimum" => value.as_f64().is_none_or(|v| v >= rule.as_f64().unwrap()),
        "maximum" => value.as_f64().is_none_or(|v| v <= rule.as_f64().unwrap()),
        "exclusiveMinimum" => value.as_f64().is_none_or(|v| v > rule.as_f64().unwrap()),
        "exclusiveMaximum" => value.as_f64().is_none_or(|v| v < rule.as_f64().unwrap()),
        "minLength" => value.as_str().is_none_or(|s| s.len() as u64 >= rule.as_u64().unwrap()),
        "minItems" => value.as_array().is_none_or(|a| a.len() as u64 >= rule.as_u64().unwrap()),
        "maxItems" => value.as_array().is_none_or(|a| a.len() as u64 <= rule.as_u64().unwrap()),
        "items" => value.as_array().is_none_or(|a| a.iter().all(|v| valid(rule, v))),
        "required" => rule.as_array().unwrap().iter().all(|name| value.get(name.as_str().unwrap()).is_some()),
        "maxProperties" => value.as_object().is_none_or(|o| o.len() as u64 <= rule.as_u64().unwrap()),
        "properties" => {
            value.as_object().is_none_or(|o| o.iter().all(|(name, v)| rule.get(name).is_none_or(|s| valid(s, v))))
        }
        "additionalProperties" => value.as_object().is_none_or(|o| {
            let known = |name: &str| schema["properties"].get(name).is_some();
            o.iter().filter(|(name, _)| !known(name)).all(|(_, v)| valid(rule, v))
        }),
        "pattern" | "description" | "default" | "title" | "examples" | "$schema" => true,
        other => panic!("the tests do not know the word {other}"),
    })
}

fn json_of(text: &str) -> Value {
    serde_json::to_value(text.parse::<toml::Table>().unwrap()).unwrap()
}

/// The word of a schema, or what has it among the schemas of which one holds; a list's items, a table itself.
fn either<'a>(schema: &'a Value, word: &str) -> &'a Value {
    let all = schema["anyOf"].as_array().into_iter().flatten();
    let has = all.chain([schema]).find(|schema| schema.get(word).is_some()).unwrap_or(schema);
    if word == "items" { &has[word] } else { has }
}

#[test]
fn every_key_is_in_the_schema_with_its_documentation_and_default() {
    let schema = schema();
    for (path, key) in every_key() {
        let mut at = &schema;
        for step in path.split('.') {
            let (name, is_item) = step.strip_suffix("[0]").map_or((step, false), |name| (name, true));
            at = &at["properties"][name];
            if is_item {
                at = either(either(at, "items"), "properties");
            }
        }
        let doc = at["description"].as_str().unwrap_or_else(|| panic!("{path} is not in the schema"));
        assert!(doc.starts_with(&key.doc), "{path}: {doc}");
        if let Some(default) = at.get("default") {
            assert!(valid(at, default), "{path}: its default {default} is not as {at}");
        }
    }
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    assert_eq!(schema["properties"]["camera"]["properties"]["fov"]["default"], 30);
    assert_eq!(schema["properties"]["sampling"]["properties"]["step"]["default"], "0.5 voxels");
}

#[test]
fn scenes_are_as_the_schema_says() {
    let schema = schema();
    assert!(valid(&schema, &json_of(FULL_OF_KEYS)));
    assert!(valid(&schema, &json_of(HEAD)));
    let scenes =
        ["", "[contours]\n", "[shading]\n", "[transfer]\nkind = \"regular\"\nnodes = [{ at = 1, color = \"red\" }]\n"];
    for rest in scenes {
        assert!(valid(&schema, &json_of(&write_full(&scene(rest)))), "{rest}");
    }
}

#[test]
fn what_the_parser_refuses_the_schema_refuses() {
    let schema = schema();
    for rest in [
        "[camera]\nfvo = 40\n",
        "[camera]\nfov = 180\n",
        "[camera]\nup = [0, 1]\n",
        "[contour]\n",
        "[[mesh]]\n",
        "[[halo]]\nevery = 0\n",
        "[sampling]\nkernel = \"trilinaer\"\n",
        "[sampling]\nskip_empty = 1\n",
        "[picture]\nbits = 12\n",
        "[picture]\nlayers = []\n",
        "[picture]\nsamples = 1.5\n",
        "[transfer]\nnodes = [{ style = \"wax\" }]\n",
        "[transfer]\nnodes = [{ at = 1, style = \"wax\", opacity = 2 }]\n",
        "[transfer]\ntable = 1\n",
        "[styles]\nwax = 3\n",
        "light = 3\n",
    ] {
        faults(rest);
        assert!(!valid(&schema, &json_of(&format!("{HEAD}{rest}"))), "{rest}");
    }
    assert!(!valid(&schema, &json!({ "drypoint": 2, "volume": { "file": "a" } })));
    assert!(!valid(&schema, &json!({ "volume": { "file": "a" } })));
    assert!(valid(&schema, &json!({ "drypoint": 1 })), "a template");
}
