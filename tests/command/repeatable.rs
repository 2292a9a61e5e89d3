//! The same scene gives the same bytes: twice, and with any number of threads ([RAY-3]).

use crate::folder::Folder;

#[test]
fn twice_and_with_any_number_of_threads() {
    let folder = Folder::new();
    // 50×40 pixels are 4×3 tiles: more than any of these numbers of threads.
    folder.scene("[contours]\n");
    for suffix in ["png", "exr"] {
        let render = |name: &str, more: &str| {
            folder.good(&format!("render scene.toml --size 50x40 -o {name}.{suffix} {more}"));
            folder.read(&format!("{name}.{suffix}"))
        };
        let first = render("a", "");
        for more in ["", "--threads 1", "--threads 3", "--repeat 2"] {
            assert!(render("b", more) == first, "{suffix} {more}");
        }
    }
}

#[test]
fn pages_do_not_depend_on_threads() {
    let folder = Folder::new();
    folder.good("phantom torus --size 20 --type u8 -o ring.nrrd -q");
    for verb in ["strokes", "points"] {
        let page = |name: &str, more: &str| {
            folder.good(&format!("{verb} ring.nrrd --set picture.width=\"40mm\" -o {name}.csv -q {more}"));
            folder.read(&format!("{name}.csv"))
        };
        let first = page("a", "");
        assert!(first.len() > 1000 && page("b", "--threads 1") == first && page("b", "--threads 3") == first, "{verb}");
    }
}

#[test]
fn counts_do_not_depend_on_threads() {
    let folder = Folder::new();
    folder.scene("[contours]\n");
    let counts = |threads: usize| {
        let mut stats: serde_json::Value =
            serde_json::from_str(&folder.good(&format!("render scene.toml --stats --threads {threads}"))).unwrap();
        stats.as_object_mut().unwrap().remove("seconds");
        stats
    };
    assert_eq!(counts(1), counts(3));
}
