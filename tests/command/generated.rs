//! `schema` and `completions`.

use crate::folder::{Folder, SCENE};
use serde_json::Value;
use std::process::Stdio;

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
    assert!(schema["required"].as_array().unwrap().contains(&"volume".into()));
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

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let folder = Folder::new();
    let mut child = folder.command(["schema"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), &b""[..]));
}
