//! What `[[halo]]` reads, and each thing that it refuses.

use super::*;
use crate::file::{Overrides, parse, write_full};
use crate::tables::{LabelKey, Length, Scene};
use glam::DVec3;
use std::path::Path;

/// The scene of a `[[halo]]` and what follows.
fn read(rest: &str) -> Result<Scene, String> {
    let files = "file = \"a.nrrd\"\nlabels = \"l.nrrd\"\nlabel_names = \"l.csv\"\n";
    let text = format!("drypoint = 1\n[volume]\n{files}[[halo]]\n{rest}");
    parse(&text, Path::new("scene.toml"), &Overrides::default()).map_err(|faults| faults.to_string())
}

fn halo(rest: &str) -> Halo {
    read(rest).unwrap_or_else(|faults| panic!("{faults}")).halos.swap_remove(0)
}

/// The table of the format's page, with all that it names.
const FULL: &str = "name = \"dark rim\"
kind = \"occlusive\"
seed.value = [[80, 0], [120, 1]]
seed.direction = { toward = 90, width = 60, softness = 20 }
seed.focus = { at = [[128, 128, 64]], inner = 20, falloff = 30 }
seed.labels = [12, \"liver\"]
seed.by = \"power\"
exponents = \"contour\"
spread = { from = \"gradient\", passes = 4, delta = 0.8, median = false, reach = \"3 mm\" }
profile = [ { at = 0.2, color = \"black\", opacity = 0 }, { at = 0.6, color = \"#ff000080\", opacity = 0.5 } ]
opacity = 1.0
floor = 0.00392156862745098
every = 1
accumulate = \"max\"
tints = [\"glow\"]
[[halo]]
name = \"glow\"
kind = \"emissive\"
";

#[test]
fn keys_mean_what_they_say() {
    let scene = read(FULL).unwrap();
    let node = |at, red, opacity| ProfileNode { at, rgb: [red, 0.0, 0.0], opacity };
    let expected = Halo {
        name: "dark rim".into(),
        seed: Seeding {
            value: Some(SeedValue::Nodes(vec![[80.0, 0.0], [120.0, 1.0]])),
            direction: Some(SeedDirection { toward: 90.0, width: 60.0, softness: 20.0 }),
            focus: Some(HaloFocus {
                points: FocusPoints::World(vec![DVec3::new(128.0, 128.0, 64.0)]),
                inner: Length::World(20.0),
                falloff: Length::World(30.0),
            }),
            labels: Some(vec![LabelKey::Id(12), LabelKey::Name("liver".into())]),
            ..Seeding::default()
        },
        spread: Spreading { reach: Some(Length::Millimetres(3.0)), ..Spreading::default() },
        // The opacity of a colour multiplies the node's.
        profile: vec![node(0.2, 0.0, 0.0), node(0.6, 1.0, 0.5 * (128.0 / 255.0))],
        tints: vec!["glow".into()],
        ..Halo::default()
    };
    assert_eq!(scene.halos[0], expected);
    assert_eq!((scene.halos[1].kind, scene.halos[1].accumulate), (HaloKind::Emissive, HaloAccumulation::Mean));
    let full = write_full(&scene);
    assert_eq!(parse(&full, Path::new("full.toml"), &Overrides::default()).unwrap(), scene, "{full}");
    // The default profile is the one that the page prints.
    assert_eq!(halo("").profile, [node(0.2, 0.0, 0.0), node(0.6, 0.0, 0.8)]);
}

#[test]
fn dotted_keys_and_tables_are_the_same() {
    let dotted = halo("seed.by = \"curvature\"\nseed.thickness = 2\nspread.passes = 3\n");
    assert_eq!(dotted, halo("seed = { by = \"curvature\", thickness = 2 }\nspread = { passes = 3 }\n"));
    assert_eq!(dotted, halo("[halo.seed]\nby = \"curvature\"\nthickness = 2\n[halo.spread]\npasses = 3\n"));
}

#[test]
fn exponents_have_names() {
    assert_eq!(halo("").exponents.numbers(), [0.125, 32.0]);
    assert_eq!(halo("exponents = \"printed\"\n").exponents.numbers(), [32.0, 0.125]);
    assert_eq!(halo("exponents = [0, 4]\n").exponents.numbers(), [0.0, 4.0]);
}

#[test]
fn a_halo_without_a_name_has_its_number() {
    let scene = read("[[halo]]\nname = \"rim\"\n[[halo]]\n").unwrap();
    assert_eq!(scene.halos.iter().map(|halo| halo.name.as_str()).collect::<Vec<_>>(), ["halo 0", "rim", "halo 2"]);
}

#[test]
fn seeds_are_by_opacity_where_nothing_else_says_which() {
    for (seed, by_opacity) in [
        ("", true),
        ("seed.by = \"curvature\"\n", true),
        ("seed.labels = [1]\n", false),
        ("seed.direction.toward = 9\n", false),
        ("seed.focus.at = [[1, 2, 3]]\n", false),
        ("seed.value = [[1, 1]]\n", false),
        ("seed = { value = \"opacity\", labels = [1] }\n", true),
    ] {
        assert_eq!(halo(seed).seed.is_by_opacity(), by_opacity, "{seed}");
    }
}

#[test]
fn pixels_of_a_focus_become_points() {
    let mut focus = halo("seed.focus.pixels = [[1.5, 2], [3, 4]]\n").seed.focus.unwrap();
    assert_eq!(focus.pixels(), Some(&[[1.5, 2.0], [3.0, 4.0]][..]));
    focus.set_points(vec![DVec3::ONE]);
    assert_eq!((focus.pixels(), &focus.points), (None, &FocusPoints::World(vec![DVec3::ONE])));
}

#[test]
fn names_of_labels_become_ids() {
    let mut seed = halo("seed.labels = [3, \"liver\", \"lver\", \"heart\"]\n").seed;
    let unknown = seed.resolve_labels(|name| (name == "liver").then_some(5)).unwrap_err();
    assert_eq!(unknown, [(2, "lver".into()), (3, "heart".into())]);
    assert_eq!(seed.labels.unwrap()[..2], [LabelKey::Id(3), LabelKey::Id(5)]);
}

#[test]
fn a_wrong_halo_says_what_was_expected() {
    for (rest, what, remedy) in [
        (
            "kind = \"emisive\"\n",
            "halo[0].kind cannot be \"emisive\"",
            "write \"emissive\"; expected is \"emissive\" or",
        ),
        ("name = \"\"\n", "halo[0].name cannot be \"\"", "write the name of a halo in quotes"),
        ("seed.value = \"alpha\"\n", "halo[0].seed.value cannot be \"alpha\"", "write \"opacity\", or a list of pairs"),
        ("seed.value = []\n", "halo[0].seed.value cannot be []", "write \"opacity\", or a list of pairs"),
        (
            "seed.value = [[1, 0.5], [2, 1.5]]\n",
            "halo[0].seed.value[1] cannot be [2, 1.5]",
            "write [value, number], the number from 0 to 1",
        ),
        (
            "seed.value = [[2, 0], [1, 1]]\n",
            "pair 1 at 1 stands after pair 0 at 2",
            "put the pairs in non-decreasing order of the value",
        ),
        (
            "seed.direction.width = -1\n",
            "halo[0].seed.direction.width cannot be -1",
            "write a number of at least 0, in deg",
        ),
        (
            "seed.focus = {}\n",
            "halo[0].seed.focus.at is missing",
            "write at = [[x, y, z]] or pixels = [[x, y]] in halo[0]",
        ),
        (
            "seed.focus = { at = [[1, 2, 3]], pixels = [[1, 2]] }\n",
            "seed.focus of a halo has both pixels and at",
            "keep pixels or at",
        ),
        ("seed.focus.at = [[1, 2]]\n", "halo[0].seed.focus.at[0] cannot be [1, 2]", "write a point [x, y, z]"),
        (
            "seed.focus.pixels = [[-1, 2]]\n",
            "halo[0].seed.focus.pixels[0] cannot be [-1, 2]",
            "write a pixel [x, y], each",
        ),
        (
            "seed.focus = { at = [[1, 2, 3]], inner = \"3 mm\" }\n",
            "halo[0].seed.focus.inner cannot be \"3 mm\"",
            "write a length of at least 0: a number in world units, or such as \"2 voxels\"",
        ),
        (
            "seed.labels = [-1]\n",
            "halo[0].seed.labels[0] cannot be -1",
            "write a whole number from 0 to 4294967295, or the",
        ),
        ("seed.by = \"angle\"\n", "halo[0].seed.by cannot be \"angle\"", "write \"power\" or \"curvature\""),
        (
            "exponents = [-1, 2]\n",
            "halo[0].exponents cannot be [-1, 2]",
            "write \"contour\", \"printed\", or two numbers [a,",
        ),
        ("exponents = \"contur\"\n", "halo[0].exponents cannot be \"contur\"", "write \"contour\"; expected is"),
        ("spread.passes = 13\n", "halo[0].spread.passes cannot be 13", "write a whole number from 0 to 12"),
        ("spread.delta = 1.5\n", "halo[0].spread.delta cannot be 1.5", "write a number from 0 to 1"),
        (
            "spread.reach = \"2 voxels\"\n",
            "halo[0].spread.reach cannot be \"2 voxels\"",
            "write a length above 0 with its unit, such as \"3 mm\", \"20 px\" or \"4 %\"",
        ),
        ("profile = []\n", "halo[0].profile cannot be []", "write a list of nodes with at least one"),
        (
            "profile = [{ at = 2, color = \"red\" }]\n",
            "halo[0].profile[0].at cannot be 2",
            "write a number from 0 to 1",
        ),
        ("profile = [{ at = 0 }]\n", "halo[0].profile[0].color is missing", "write color = a colour"),
        (
            "profile = [{ at = 0.5, color = \"red\" }, { at = 0.2, color = \"red\" }]\n",
            "node 1 at 0.2 stands after node 0 at 0.5",
            "put the nodes in non-decreasing order of `at`",
        ),
        ("opacity = 2\n", "halo[0].opacity cannot be 2", "write a number from 0 to 1"),
        ("floor = -1\n", "halo[0].floor cannot be -1", "write a number from 0 to 1"),
        ("every = 1025\n", "halo[0].every cannot be 1025", "write a whole number from 1 to 1024"),
        ("accumulate = \"sum\"\n", "halo[0].accumulate cannot be \"sum\"", "write \"max\" or \"mean\""),
        ("object = \"tumour\"\n", "there is no part \"tumour\"", "there is background"),
        ("seeds = {}\n", "a halo has no key \"seeds\"", "write \"seed\"; the keys here are name, kind, seed, "),
        (
            "name = \"a\"\n[[halo]]\nname = \"a\"\n",
            "halo[0] and halo[1] are both called \"a\"\n  at scene.toml:9:1, key halo[1].name",
            "give each halo a name of its own",
        ),
        (
            "name = \"halo 1\"\n[[halo]]\n",
            "halo[0] and halo[1] are both called \"halo 1\"\n  at scene.toml:7:1, key halo[0].name",
            "give each halo a name of its own",
        ),
        (
            "tints = [\"glwo\"]\n[[halo]]\nname = \"glow\"\nkind = \"emissive\"\n",
            "there is no emissive halo \"glwo\"\n  at scene.toml:7:10, key halo[0].tints[0]",
            "write \"glow\"; there is glow",
        ),
        ("tints = [\"halo 0\"]\n", "there is no emissive halo \"halo 0\"", "there is no emissive halo at all"),
        (
            "[sampling]\nstep_along = \"ray\"\n",
            "sampling.step_along = \"ray\" has no planes, and [[halo]] spreads seeds on planes\n  at scene.toml:8:1, key \
             sampling.step_along",
            "write step_along = \"plane\", or leave [[halo]] out",
        ),
        (
            "[picture]\nlayers = [\"beauty\", \"halo1\"]\n",
            "there is no halo \"halo1\"\n  at scene.toml:8:21, key picture.layers[1]",
            "there is halo0",
        ),
        (
            "[picture]\nlayers = [\"halo0.H\"]\n",
            "picture.layers[0] cannot be \"halo0.H\"",
            "write \"halo0\"; expected is",
        ),
        (
            "[picture]\nlayers = [\"halo00\"]\n",
            "picture.layers[0] cannot be \"halo00\"",
            "write \"halo0\"; expected is",
        ),
        ("[picture]\nlayers = [\"halo0\", \"halo0\"]\n", "picture.layers has \"halo0\" twice", "leave one of them out"),
    ] {
        let told = read(rest).expect_err(rest);
        let remedies: Vec<&str> = told.lines().skip(2).step_by(3).collect();
        assert!(told.starts_with(what), "{rest}: {told}");
        assert!(remedies[0].starts_with(&format!("  {remedy}")), "{rest}: {told}");
        assert_eq!(remedies.len(), 1, "{rest}: {told}");
    }
}

#[test]
fn labels_need_their_files() {
    let told = |volume: &str, labels: &str| {
        let text = format!("drypoint = 1\n[volume]\nfile = \"a\"\n{volume}[[halo]]\nseed.labels = {labels}\n");
        parse(&text, Path::new("s"), &Overrides::default()).err().map(|faults| faults.to_string())
    };
    let without = told("", "[1]").unwrap();
    assert!(
        without.starts_with("halo[0].seed.labels are given, and the scene has no labels\n  at s:5:6, "),
        "{without}"
    );
    let unnamed = told("labels = \"l.nrrd\"\n", "[1, \"liver\"]").unwrap();
    let expected = "\"liver\" is the name of a label, and the scene has no names of them\n  at s:6:19, key \
                    halo[0].seed.labels[1]\n";
    assert!(unnamed.starts_with(expected), "{unnamed}");
    assert_eq!(told("labels = \"l.nrrd\"\n", "[1]"), None);
}

#[test]
fn one_of_several_is_taken_away() {
    let text = format!("drypoint = 1\n[volume]\nfile = \"a\"\nlabels = \"l\"\nlabel_names = \"n\"\n[[halo]]\n{FULL}");
    let set = |key: &str| parse(&text, Path::new("s"), &[(key, "off")].into_iter().collect());
    assert_eq!(set("halo.0").unwrap().halos.iter().map(|h| h.name.as_str()).collect::<Vec<_>>(), ["glow"]);
    assert_eq!(set("halo").unwrap().halos, []);
    let told = set("halo.1").unwrap_err().to_string();
    assert!(told.starts_with("there is no emissive halo \"glow\""), "{told}");
    assert_eq!(set("halo.1.kind").unwrap_err().iter().count(), 1, "an occlusive halo is nothing to tint");
}
