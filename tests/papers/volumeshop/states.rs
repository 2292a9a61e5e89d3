//! Selections while `[orbit]` turns the camera (6.3, [VS-9]): in the world, before the eye, or pinned to their pixel.

use super::motions::VOLUME;
use super::{difference, drawn, job_of, scene_of, seen};
use drypoint::drawing::Drawing;
use drypoint::job::Job;
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;
use drypoint::scene::glam::DVec2;
use drypoint::scene::marks::Marks;
use drypoint::scene::picture::Picture;

/// The background is not seen. The object is all of the specimen, which ends inside its box.
const LOOK: &str = "[transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 0 }]\n[shading]\n";
const OBJECT: &str = "[[object]]\nname = \"part\"\n[object.transfer]\nkind = \"regular\"\n\
    nodes = [{ at = 60, color = \"#c08040\", opacity = 0 }, { at = 200, color = \"#4080c0\", opacity = 0.4 }]\n\
    [object.ghost.transfer]\nkind = \"regular\"\nnodes = [{ at = 0, color = \"red\", opacity = 0 }]\n";
const CAMERAS: [&str; 2] =
    ["[camera]\ndirection = [1, 0.4, -0.3]\n", "[camera]\ndirection = [0, 1, 0]\nprojection = \"orthographic\"\n"];
/// Cameras far away, so that labels have room.
const FAR: [&str; 2] = ["[camera]\neye = [-160, -60, 90]\n", "[camera]\nprojection = \"orthographic\"\nheight = 150\n"];
const ORBIT: &str = "[orbit]\nframes = 5\ndegrees = 300\n";
const STATES: [&str; 3] = ["integrated", "decoupled", "pinned"];

/// The object with further keys.
fn object(keys: &str) -> String {
    OBJECT.replace("name = \"part\"\n", &format!("name = \"part\"\n{keys}\n"))
}

/// The pictures of all frames, and what is laid over them.
fn frames_of(job: &Job) -> Vec<(Picture, Option<Marks>)> {
    let mut counts = Counts::default();
    let marking = Marking::new(job, &mut counts, &|_| ()).unwrap();
    let mut drawing = Drawing::new(job, &marking, &mut counts).unwrap();
    let frames = 0..drawing.frames();
    frames.map(|i| drawing.frame(i, &|_| ()).unwrap().0).map(|frame| (frame.picture.unwrap(), frame.marks)).collect()
}

fn frames(text: &str) -> Vec<Picture> {
    frames_of(&job_of(text)).into_iter().map(|(picture, _)| picture).collect()
}

/// Without a turn of the camera M' = M: the first frame, and its metadata, are those of the scene without `[orbit]`.
#[test]
fn an_integrated_selection_and_the_first_frame_are_as_without_states() {
    for motion in ["", "move = [3, 1, 2]", "rotate = { angle = 360 }\nghosting = 0.5"] {
        let text = |keys: &str| scene_of(VOLUME, &format!("{LOOK}{}{}", CAMERAS[0], object(keys)));
        let plain = frames(&(text(motion) + ORBIT));
        let all = STATES.map(|state| text(&format!("{motion}\ninteraction = \"{state}\"")));
        assert!(frames(&(all[0].clone() + ORBIT)) == plain, "{motion}");
        for still in all {
            let turning = still.clone() + ORBIT;
            assert!(frames(&turning)[0] == plain[0] && drawn(&still).0 == plain[0], "{turning}");
            assert_eq!(job_of(&turning).provenance(), job_of(&still).provenance(), "{turning}");
        }
    }
}

/// V'·M' = V·M, and head light turns with the eye: all frames are one picture. Positions of 40 units are off by 10⁻¹⁴ or
/// so, and nothing along a ray is steeper than 10³ a unit.
#[test]
fn a_decoupled_selection_alone_is_one_picture_while_the_world_turns() {
    for camera in CAMERAS {
        for motion in ["", "move = [3, 1, 2]\nscale = [1, -1.2, 0.8]"] {
            let all = |state: &str| {
                let keys = format!("{motion}\ninteraction = \"{state}\"");
                frames(&scene_of(VOLUME, &format!("{LOOK}{camera}{ORBIT}{}", object(&keys))))
            };
            let (still, turned) = (all("decoupled"), all("integrated"));
            assert!(seen(&still[0]) > 10.0);
            for i in 1..5 {
                let off = difference(&still[0], &still[i]);
                assert!(off < 1e-9, "frame {i}: {off:e}\n{camera}{motion}");
                assert!(difference(&turned[0], &turned[i]) > 0.02, "frame {i}\n{camera}{motion}");
            }
        }
    }
}

/// The camera looks along y and turns by 90° about z: to the eye the way (5, 1, 2) is (−1, 5, 2) then. A decoupled selection
/// turns, too; a pinned one does not.
#[test]
fn a_quarter_turn_by_hand() {
    for lens in ["", "projection = \"orthographic\"\n"] {
        let text = |keys: &str| {
            let camera = format!("[camera]\ndirection = [0, 1, 0]\n{lens}");
            scene_of(VOLUME, &format!("{LOOK}{camera}[orbit]\nframes = 4\n{}", object(keys)))
        };
        let way = "move = [-1, 5, 2]";
        for (state, after) in [("decoupled", format!("{way}\nrotate = {{ angle = 90 }}")), ("pinned", way.into())] {
            let seen_now = frames(&text(&format!("move = [5, 1, 2]\ninteraction = \"{state}\"")));
            let by_hand = frames(&text(&after));
            let off = difference(&seen_now[1], &by_hand[1]);
            assert!(seen(&by_hand[1]) > 10.0 && off < 1e-9, "{state}: {off:e}");
            assert!(difference(&seen_now[0], &by_hand[0]) > 0.02, "{state}");
        }
    }
}

/// The head of an arrow to the centre of a selection is at the same place of the page in each frame, unless the selection
/// stays in the world; so is the dot of its label.
#[test]
fn arrows_and_labels_end_where_the_selection_is() {
    let laid = "[[arrow]]\nhead = \"2 px\"\nbend = 0\noccluded = false\n[labels]\nsize = \"3 px\"\n\
                distance = \"1 px\"\ngap = \"0 px\"\ndot = \"1 px\"\n[[label]]\nobject = \"part\"\ntext = \"a\"\n";
    for (state, stays) in STATES.into_iter().zip([false, true, true]) {
        for camera in FAR {
            let keys = format!("move = [9, 3, 12]\ninteraction = \"{state}\"");
            let job = job_of(&large(&format!("{camera}{}{laid}", object(&keys))));
            let ends: Vec<[DVec2; 2]> = frames_of(&job).into_iter().map(|(_, marks)| ends(&marks.unwrap())).collect();
            let apart = |end: &[DVec2; 2]| (0..2).map(|i| end[i].distance(ends[0][i])).fold(0.0, f64::max);
            let most = ends.iter().map(apart).fold(0.0, f64::max);
            // Places on the page are rounded to a hundredth of a millimetre.
            assert_eq!(most < 0.02, stays, "{state}: {most}\n{camera}");
            assert!(stays || most > 0.2, "{state}: {most}\n{camera}");
        }
    }
}

/// An orbit in a picture with room for what is laid over it.
fn large(rest: &str) -> String {
    scene_of(VOLUME, &format!("{LOOK}{ORBIT}{rest}")).replace("[24, 20]", "[96, 80]")
}

/// The tip of the only arrow, and the dot of the only label.
fn ends(marks: &Marks) -> [DVec2; 2] {
    let areas = marks.layers.iter().flat_map(|layer| &layer.areas);
    let dots = marks.layers.iter().flat_map(|layer| &layer.dots);
    [areas.map(|area| area.outlines[0][0]).next().unwrap(), dots.map(|dot| dot.at).next().unwrap()]
}

/// An arrow between the boxes of two decoupled selections is one shape in all frames.
#[test]
fn an_arrow_keeps_its_tip_at_the_box_of_a_decoupled_selection() {
    let other =
        "[[object]]\nname = \"other\"\nvalue = [[0, 0], [1, 0]]\nmove = [0, -30, 30]\ninteraction = \"decoupled\"\n";
    let arrow = "[[arrow]]\nfrom = \"other\"\nto = \"part\"\nends = \"box\"\nhead = \"2 px\"\noccluded = false\n";
    let keys = "move = [5, 30, 4]\nscale = 0.3\ninteraction = \"decoupled\"";
    let job = job_of(&large(&format!("{}{}{other}{arrow}", FAR[0], object(keys))));
    let all: Vec<Marks> = frames_of(&job).into_iter().map(|(_, marks)| marks.unwrap()).collect();
    let head = |marks: &Marks| {
        let areas = marks.layers.iter().flat_map(|layer| &layer.areas);
        areas.flat_map(|area| area.outlines.concat()).collect::<Vec<DVec2>>()
    };
    for marks in &all[1..] {
        let [first, now] = [&all[0], marks].map(head);
        let apart = first.iter().zip(&now).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        assert!(first.len() == 4 && apart < 0.02, "{first:?}, {now:?}");
    }
}
