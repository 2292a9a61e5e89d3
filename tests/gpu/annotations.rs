//! Annotations over a card's pictures: those of the reference.

use crate::double::load;
use crate::gpu;
use drypoint::drawing::Drawing;
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;

const SCENE: &str = r##"drypoint = 1
[volume]
phantom = { name = "torus", size = 24 }
[picture]
size = [60, 48]
[orbit]
frames = 2
degrees = 40
[transfer]
kind = "regular"
nodes = [{ at = 90, color = "#804020", opacity = 0 }, { at = 140, color = "#88ccff", opacity = 0.2 }]
[[box]]
width = "1 px"
[[arrow]]
from = [0, 0, 0]
to = [20, 20, 20]
head = "4 px"
[labels]
size = "6 px"
[[label]]
pixel = [20, 24]
text = "a"
"##;

/// The lines are hidden, and the picked place is found, by the same rays of the reference from the camera of each frame.
#[test]
fn annotations_are_those_of_the_reference() {
    let Some(gpu) = gpu() else { return };
    let job = load(SCENE);
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_| {}).unwrap_or_else(|failure| panic!("{failure}"));
    let mut frames = Drawing::new(&job, &marking, &mut counts).unwrap_or_else(|failure| panic!("{failure}"));
    let mut on_gpu = Drawing::on(&job, &marking, Some(&gpu), &mut counts).unwrap_or_else(|failure| panic!("{failure}"));
    let mut before = None;
    for i in 0..2 {
        let [truth, drawn] = [&mut frames, &mut on_gpu].map(|frames| {
            let (frame, _) = frames.frame(i, &|_| {}).unwrap_or_else(|failure| panic!("{failure}"));
            (frame.marks.unwrap(), frame.notes)
        });
        assert_eq!(truth, drawn, "frame {i}");
        let lines = truth.0.layers.iter().flat_map(|layer| &layer.lines).flat_map(|line| &line.vertices);
        assert!(lines.filter(|vertex| vertex.color.is_some()).count() > 10, "some lines are seen through the volume");
        assert_ne!(before.replace(truth.0), Some(drawn.0), "the camera turns");
    }
}
