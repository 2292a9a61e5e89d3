//! The keys of a scene file as a tree, read from the JSON Schema that the format publishes.

use drypoint::scene::file;
use serde_json::Value as Json;

/// A key of the format.
#[derive(Clone, Debug)]
pub struct Node {
    /// Its name.
    pub name: String,
    /// Its documentation.
    pub doc: String,
    /// Its default, if that is a value.
    pub default: Option<Json>,
    /// Whether its table must have it.
    pub is_required: bool,
    /// The values that the schema allows.
    pub kind: Kind,
}

/// The kind of values that the schema allows at a key.
#[derive(Clone, Debug)]
pub enum Kind {
    /// A table with these keys.
    Table(Vec<Node>),
    /// A list of tables with these keys.
    List(Vec<Node>),
    /// A value.
    Value(ValueKind),
}

/// The kinds of values, as far as editors differ.
#[derive(Clone, Debug, PartialEq)]
pub enum ValueKind {
    /// True or false.
    Switch,
    /// A number within bounds; none: any.
    Number {
        /// The least number.
        least: Option<f64>,
        /// The greatest number.
        most: Option<f64>,
        /// Whether it is whole.
        is_whole: bool,
    },
    /// One of some texts, each with its meaning.
    Choice(Vec<(String, String)>),
    /// So many numbers.
    Numbers(usize),
    /// Anything else, as TOML or as a bare text.
    Text,
}

impl Node {
    /// The root of a scene file.
    pub fn scene() -> Self {
        let schema = file::schema();
        Self {
            name: String::new(),
            doc: text(&schema, "description"),
            default: None,
            is_required: true,
            kind: kind(&schema),
        }
    }

    /// Returns the keys of the table, or of each table of the list.
    pub fn children(&self) -> &[Self] {
        match &self.kind {
            Kind::Table(children) | Kind::List(children) => children,
            Kind::Value(_) => &[],
        }
    }

    /// Returns a value that may stand there, for tables that need one.
    pub fn example(&self) -> toml_edit::Value {
        match &self.kind {
            Kind::Table(_) => toml_edit::InlineTable::new().into(),
            Kind::List(_) => toml_edit::Array::new().into(),
            Kind::Value(ValueKind::Switch) => true.into(),
            Kind::Value(ValueKind::Number { least, .. }) => crate::camera::number(least.unwrap_or(0.0).max(0.0)),
            Kind::Value(ValueKind::Choice(choices)) => choices.first().map_or("", |(name, _)| name.as_str()).into(),
            Kind::Value(ValueKind::Numbers(n)) => toml_edit::Value::Array((0..*n).map(|i| i64::from(i == 0)).collect()),
            Kind::Value(ValueKind::Text) => self.name.as_str().into(),
        }
    }
}

fn text(schema: &Json, key: &str) -> String {
    schema[key].as_str().unwrap_or_default().to_owned()
}

/// Returns the kind of a schema.
fn kind(schema: &Json) -> Kind {
    if let Some(children) = children(schema) {
        return Kind::Table(children);
    }
    if let Some(children) = children(&schema["items"]) {
        return Kind::List(children);
    }
    Kind::Value(value_kind(schema))
}

/// Returns the keys of a table's schema.
fn children(schema: &Json) -> Option<Vec<Node>> {
    let required = schema["required"].as_array();
    let is_required = |name: &str| required.is_some_and(|required| required.iter().any(|key| key == name));
    let node = |(name, schema): (&String, &Json)| Node {
        name: name.clone(),
        doc: text(schema, "description"),
        default: schema.get("default").cloned(),
        is_required: is_required(name),
        kind: kind(schema),
    };
    Some(schema["properties"].as_object()?.iter().map(node).collect())
}

fn value_kind(schema: &Json) -> ValueKind {
    let named = |one: &Json| Some((one["const"].as_str()?.to_owned(), text(one, "description")));
    let choices = schema["oneOf"].as_array().and_then(|each| each.iter().map(named).collect::<Option<Vec<_>>>());
    let names = schema["enum"].as_array().and_then(|each| {
        each.iter().map(|name| Some((name.as_str()?.to_owned(), String::new()))).collect::<Option<Vec<_>>>()
    });
    if let Some(choices) = choices.or(names) {
        return ValueKind::Choice(choices);
    }
    let size = ["minItems", "maxItems"].map(|key| schema[key].as_u64());
    match (schema["type"].as_str(), size) {
        (Some("boolean"), _) => ValueKind::Switch,
        (Some("number" | "integer"), _) => ValueKind::Number {
            least: schema["minimum"].as_f64().or(schema["exclusiveMinimum"].as_f64()),
            most: schema["maximum"].as_f64().or(schema["exclusiveMaximum"].as_f64()),
            is_whole: schema["type"] == "integer",
        },
        (Some("array"), [Some(least), Some(most)])
            if least == most && most <= 4 && matches!(schema["items"]["type"].as_str(), Some("number" | "integer")) =>
        {
            ValueKind::Numbers(most as usize)
        }
        _ => ValueKind::Text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn find<'n>(node: &'n Node, path: &str) -> &'n Node {
        path.split('.').fold(node, |node, name| node.children().iter().find(|child| child.name == name).unwrap())
    }

    #[test]
    fn kinds_of_some_keys() {
        let root = Node::scene();
        let value = |path| match &find(&root, path).kind {
            Kind::Value(kind) => kind.clone(),
            other => panic!("{path}: {other:?}"),
        };
        assert_eq!(value("camera.eye"), ValueKind::Numbers(3));
        assert_eq!(value("camera.fov"), ValueKind::Number { least: Some(0.0), most: Some(180.0), is_whole: false });
        assert_eq!(value("sampling.skip_empty"), ValueKind::Switch);
        assert_eq!(value("contours.thickness"), ValueKind::Text);
        let ValueKind::Choice(kernels) = value("sampling.kernel") else { panic!() };
        assert!(kernels.iter().any(|(name, doc)| name == "trilinear" && !doc.is_empty()));
        assert!(matches!(find(&root, "clip").kind, Kind::List(_)));
        assert!(matches!(find(&root, "volume.phantom").kind, Kind::Table(_)));
        assert!(find(&root, "volume.phantom.name").is_required);
    }

    /// Every key has a documentation, and a default that stands where the scene gives nothing.
    #[test]
    fn every_key_is_documented() {
        fn walk(node: &Node, count: &mut usize) {
            *count += 1;
            assert!(!node.doc.is_empty(), "{}", node.name);
            node.children().iter().for_each(|child| walk(child, count));
        }
        let mut count = 0;
        Node::scene().children().iter().for_each(|child| walk(child, &mut count));
        assert!(count > 300, "{count}");
    }
}
