//! Clips ([RAY-8]): what is read, written and refused.

use super::*;
use crate::tables::{Clip, ClipSpace, PartName};
use glam::DVec3;

const PLANE: &str = "[[clip]]\npoint = [1, 2, 3]\nnormal = [0, 0, -2]\n";

#[test]
fn planes_and_boxes_are_read_and_written() {
    let text = format!(
        "{PLANE}space = \"index\"\napplies = [\"background\"]\ncap = \"#ff000080\"\n\
         [[clip]]\nbox = [[0, 5], [-1, 1], [2, 2]]\nstyle = \"wax\"\n"
    );
    let read = scene(&text);
    let plane = Clip {
        point: Some(DVec3::new(1.0, 2.0, 3.0)),
        normal: Some(DVec3::new(0.0, 0.0, -2.0)),
        space: ClipSpace::Index,
        applies: vec![PartName::Background],
        cap: Some([1.0, 0.0, 0.0, 128.0 / 255.0]),
        ..Clip::default()
    };
    let extent = Some([[0.0, 5.0], [-1.0, 1.0], [2.0, 2.0]]);
    assert_eq!(read.clips, [plane, Clip { extent, style: Some("wax".into()), ..Clip::default() }]);
    let full = write_full(&read);
    assert_eq!(parse(&full, Path::new("scene.toml"), &Overrides::default()).unwrap(), read, "{full}");
}

/// The command line takes clips out, one by one or all, and a box takes the place of a plane.
#[test]
fn clips_are_taken_out_and_changed() {
    let text = format!("{HEAD}{PLANE}[[clip]]\nbox = [[0, 1], [0, 1], [0, 1]]\n");
    let set = |settings: &[(&str, &str)]| {
        let scene = parse(&text, Path::new("scene.toml"), &settings.iter().copied().collect());
        scene.unwrap_or_else(|faults| panic!("{faults}")).clips
    };
    let both = set(&[]);
    assert_eq!(set(&[("clip.0", "off")]), both[1..]);
    assert_eq!(set(&[("clip.1", "off")]), both[..1]);
    assert_eq!(set(&[("clip", "off")]), []);
    let boxed = set(&[("clip.0.box", "[[0, 1], [0, 1], [0, 1]]")]);
    assert_eq!(boxed, [both[1].clone(), both[1].clone()]);
}

#[test]
fn wrong_clips_say_what_is_wrong() {
    for (clip, told) in [
        (
            "point = [1, 2, 3]\nnormal = [0, 0, 0]\n",
            "clip[0].normal cannot be [0, 0, 0]\n  at scene.toml:6:10, key clip[0].normal\n  write a direction \
             [x, y, z], not all 0",
        ),
        (
            "cap = \"red\"\n",
            "clip[0].point is missing\n  at scene.toml:4:1, key clip[0].point\n  write point = [x, y, z] and normal = \
             [x, y, z], or box = [[x0, x1], [y0, y1], [z0, z1]]",
        ),
        (
            "point = [1, 2, 3]\n",
            "clip[0].normal is missing\n  at scene.toml:4:1, key clip[0].normal\n  write normal = [x, y, z], which points \
             to the side that is cut away",
        ),
        (
            "normal = [1, 2, 3]\n",
            "clip[0].point is missing\n  at scene.toml:4:1, key clip[0].point\n  write point = [x, y, z], which lies on \
             the plane",
        ),
        (
            "normal = [1, 2, 3]\nbox = [[0, 1], [0, 1], [0, 1]]\n",
            "a clip has both box and normal\n  at scene.toml:6:1, key clip[0].box\n  keep box or normal",
        ),
        (
            "box = [[0, 1], [0, 1], [2, 1]]\n",
            "clip[0].box cannot be a list of 3\n  at scene.toml:5:7, key clip[0].box\n  write a box [[x0, x1], [y0, y1], \
             [z0, z1]], the lower number first on each axis",
        ),
        (
            "box = [[0, 1], [0, 1], [0, 1]]\napplies = [\"liver\"]\n",
            "there is no part \"liver\"\n  at scene.toml:6:12, key clip[0].applies[0]\n  there is background",
        ),
        (
            "box = [[0, 1], [0, 1], [0, 1]]\ncap = \"red\"\nstyle = \"wax\"\n",
            "a clip has both style and cap\n  at scene.toml:7:1, key clip[0].style\n  keep style or cap",
        ),
    ] {
        assert_eq!(faults(&format!("[[clip]]\n{clip}")), told);
    }
    let style = faults("[[clip]]\nbox = [[0, 1], [0, 1], [0, 1]]\nstyle = \"waxx\"\n");
    let start = "there is no style \"waxx\"\n  at scene.toml:6:9, key clip[0].style\n  write \"wax\"; ";
    assert!(style.starts_with(start), "{style}");
}
