//! Values at random as the format's own description has them: what is added to the format is drawn without a line more.

use crate::common::random::Random;
use serde_json::Value as Json;
use toml::Value;

/// Something that the description allows: of a number in a bounded range any, else one about the default; of a table each key
/// once in three times.
pub(super) fn value(r: &mut Random, schema: &Json) -> Value {
    if let Some(one) = schema.get("const") {
        return name(one);
    }
    if let Some(names) = schema["enum"].as_array() {
        return name(&r.pick(names));
    }
    if let Some(alternatives) = schema["anyOf"].as_array().or(schema["oneOf"].as_array()) {
        let mut one = r.pick(alternatives);
        if one.get("default").is_none() {
            one["default"] = schema["default"].clone();
        }
        return value(r, &one);
    }
    if let Some(pattern) = schema["pattern"].as_str() {
        return Value::String(text(r, pattern, &schema["default"]));
    }
    match schema["type"].as_str() {
        Some("boolean") => Value::Boolean(r.once_in(2)),
        Some("integer") => Value::Integer(number(r, schema).round() as i64),
        Some("number") => Value::Float(number(r, schema)),
        Some("array") => {
            let items = schema["minItems"].as_u64().unwrap_or(1);
            Value::Array((0..items).map(|_| value(r, &schema["items"])).collect())
        }
        Some("object") => Value::Table(table(r, schema)),
        _ => panic!("{schema}"),
    }
}

/// A table with each of its keys once in three times, and always those that it cannot be without.
fn table(r: &mut Random, schema: &Json) -> toml::Table {
    let required = schema["required"].as_array().map(Vec::as_slice).unwrap_or_default();
    let mut table = toml::Table::new();
    for (key, property) in schema["properties"].as_object().into_iter().flatten() {
        if required.iter().any(|name| name == key) || r.once_in(3) {
            let drawn = if ["pen", "cross_pen"].contains(&key.as_str()) {
                Value::String(r.pick(&["black", "sepia"]).into())
            } else {
                value(r, property)
            };
            table.insert(key.clone(), drawn);
        }
    }
    table
}

fn name(json: &Json) -> Value {
    Value::String(json.as_str().unwrap_or_default().into())
}

/// Between both bounds, or from a third of the default to thrice as much; about 1 where there is neither, of either sign where
/// it may be negative.
fn number(r: &mut Random, schema: &Json) -> f64 {
    let bound = |a: &str, b: &str| schema[a].as_f64().or(schema[b].as_f64());
    let (lo, hi) = (bound("minimum", "exclusiveMinimum"), bound("maximum", "exclusiveMaximum"));
    match (lo, hi) {
        (Some(lo), Some(hi)) if hi < 1e4 => lo + (hi - lo) * r.between(0.01, 0.99),
        (Some(_), _) => about(r, &schema["default"]),
        _ => about(r, &schema["default"]) * r.pick(&[-1.0, 1.0]),
    }
}

/// From a third of a default to thrice as much.
fn about(r: &mut Random, default: &Json) -> f64 {
    let first = |text: &str| text.split_whitespace().next().and_then(|number| number.parse().ok());
    let default: Option<f64> = default.as_f64().or(default.as_str().and_then(first));
    default.filter(|v| *v != 0.0).unwrap_or(1.0) * 3f64.powf(r.between(-1.0, 1.0))
}

fn text(r: &mut Random, pattern: &str, default: &Json) -> String {
    if pattern.starts_with("^#") {
        let [a, b, c] = [0; 3].map(|_| r.below(256));
        format!("#{a:02x}{b:02x}{c:02x}")
    } else if pattern.starts_with("^q") {
        format!("q{:.2}", r.between(0.05, 0.95))
    } else {
        match pattern {
            _ if pattern.contains("deg") => format!("{:.1} deg", r.between(5.0, 90.0)),
            _ if pattern.contains("voxels") => format!("{:.4} voxels", about(r, default)),
            _ => format!("{:.4} {}", about(r, default), r.pick(&["mm", "px"])),
        }
    }
}
