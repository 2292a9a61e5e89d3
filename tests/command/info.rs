//! `info`.

use crate::folder::Folder;

#[test]
fn for_a_person_and_for_a_program() {
    let folder = Folder::new();
    folder.good("-q phantom constant --size 4,3,2 --spacing 1,2,0.5 --type i16 --param value=-7 -o a.nrrd");
    let text = folder.good("info a.nrrd");
    for line in [
        "dims       4 × 3 × 2",
        "type       i16, 48 B",
        "spacing    1  2  0.5",
        "range      -7 … -7",
        "invalid    0 (NaN or infinite)",
    ] {
        assert!(text.lines().any(|l| l == line), "{line}\n{text}");
    }
    assert!(text.ends_with('\n'));
    let json: serde_json::Value = serde_json::from_str(&folder.good("info --json a.nrrd")).unwrap();
    assert_eq!(json["file"], "a.nrrd");
    assert_eq!(json["type"], "i16");
    assert_eq!(json["dims"], serde_json::json!([4, 3, 2]));
    assert_eq!(json["histogram"]["bins"][0], 24);
    assert_eq!(json["invalid"], 0);
}
