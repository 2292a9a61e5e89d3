//! `schema` and `completions`.

use crate::folder::{Folder, SCENE};
use serde_json::Value;

#[test]
fn the_schema_knows_every_table_and_no_other() {
    let folder = Folder::new();
    let schema: Value = serde_json::from_str(&folder.good("schema")).unwrap();
    assert!(schema["$schema"].as_str().unwrap().contains("json-schema.org"));
    assert_eq!(schema["type"], "object");
    assert_eq!(schema["additionalProperties"], false);
    for table in ["volume", "camera", "picture", "sampling", "transfer", "styles", "shading", "contours"] {
        assert!(schema["properties"][table].is_object(), "{table}");
    }
    // A template has no volume.
    assert_eq!(schema["required"], serde_json::json!(["drypoint"]));
    // What the schema calls a key, the command takes.
    folder.write("scene.toml", SCENE);
    for table in schema["properties"].as_object().unwrap().keys() {
        let said = folder.line(&format!("plan scene.toml --set {table}=12345"));
        assert!(!said.err.contains("has no key"), "{table}: {}", said.err);
    }
}

#[test]
fn completions_name_every_verb() {
    let folder = Folder::new();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = folder.good(&format!("completions {shell}"));
        for word in ["render", "completions", "layers", "quiet"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
    folder.write("complete.bash", folder.good("completions bash"));
    // Where there is a bash, it must be able to read it.
    let bash = std::process::Command::new("bash").arg("-n").arg(folder.path("complete.bash")).status();
    assert!(bash.is_err() || bash.unwrap().success());
}
