//! Labels of structures, with their leader lines ([VS-10]).

use super::{Annotating, lines, name_of_label};
use crate::Failure;
use crate::picking::point_of_pixel;
use drypoint_output::text::font::extent;
use drypoint_reference::figure::inner_points;
use drypoint_reference::ray::{Picked, Renderer};
use drypoint_reference::volumeshop::annotations::{columns, layout};
use drypoint_scene::annotations::{AnnotatedPage, Annotation, AnnotationLayout, Hidden, PlacedAnnotation};
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::{Dot, Layer, Text};
use drypoint_scene::parallel;
use drypoint_scene::space::Grid;
use drypoint_scene::tables::{BoxShown, LabelAnchor, LabelKey, LabelLayout, LabelTable, LabelsTable, PartName};
use drypoint_scene::view::View;
use drypoint_scene::volume::labels::LabelVolume;

/// Rays along the longer side of the picture that look for structures.
const LOOKS: usize = 160;

/// The accumulated opacity from which a structure hides what lies behind it. A veil before it has no label.
const MOST_LIGHT: f64 = 0.5;

/// A label and the place that it leads to, in world space.
pub(super) struct Anchored {
    text: String,
    world: DVec3,
    /// The part at whose centre the place is; none: the place stays in the world.
    part: Option<PartName>,
}

impl Annotating<'_> {
    /// The labels of a frame, which cover no obstacle. Places are found in the first frame and stay in the world.
    /// Labels of objects stay at their centres.
    pub(super) fn labels(
        &mut self,
        view: &View,
        renderer: Option<&Renderer<'_>>,
        obstacles: Vec<[DVec2; 2]>,
        notes: &mut Vec<String>,
    ) -> Result<Vec<Layer>, Failure> {
        if self.tables().labels.is_empty() {
            return Ok(Vec::new());
        }
        let seen = renderer.map(|renderer| Seen::new(view, renderer));
        if self.anchors.is_none() {
            self.anchors = Some(self.anchored(renderer, seen.as_ref(), notes)?);
        }
        self.follow_parts();
        let table = self.tables().arrangement.clone().unwrap_or_default();
        let pen = self.pen(&table.line, "labels", "labels.pen")?;
        let Some(anchors) = &self.anchors else { return Ok(Vec::new()) };
        let page = self.annotated_page(view, &table, (anchors, seen.as_ref()), obstacles);
        let arrange = match table.layout {
            LabelLayout::Hull => layout,
            LabelLayout::Columns => columns,
        };
        let found = arrange(&page, self.previous.as_ref());
        notes.extend(left_out(&found, &page, anchors));
        // Leader lines with their dots, then text.
        let mut layer = Layer::new(pen);
        let (width, dot, gap) = (layer.pen.width, self.mm(table.dot), self.mm(table.gap));
        let shown = found.annotations.iter().zip(&page.annotations).zip(anchors);
        for ((place, given), label) in shown.filter(|((place, _), _)| place.hidden.is_none()) {
            if self.insets.iter().any(|[lo, hi]| given.anchor.cmpgt(*lo).all() && given.anchor.cmplt(*hi).all()) {
                notes.push(format!("an inset lies over what the label {:?} names", label.text));
            }
            let PlacedAnnotation { corners, leader, opacity, .. } = *place;
            let mut points = vec![given.anchor, leader[0], leader[1]];
            points.dedup();
            if points.len() > 1 {
                layer.lines.push(lines::plain(&points, width, opacity, false));
            }
            if dot > 0.0 {
                layer.dots.push(Dot { at: given.anchor, world: label.world, radius: dot / 2.0, opacity });
            }
            let size = self.mm(table.size);
            let at = DVec2::new(corners[0].x + gap, corners[0].y + gap + extent(&label.text, size).ascent);
            layer.texts.push(Text { characters: label.text.clone(), at, size, opacity: 1.0 });
        }
        self.previous = Some(found);
        Ok(vec![layer])
    }

    /// Moves the places of labels of objects to their centres in the frame.
    fn follow_parts(&mut self) {
        let Self { job, objects, anchors, .. } = self;
        for label in anchors.iter_mut().flatten() {
            let corners = label.part.as_ref().and_then(|part| job.corners(objects, part));
            label.world = corners.map_or(label.world, centre);
        }
    }

    /// The page of a frame with its labels to be placed.
    fn annotated_page(
        &self,
        view: &View,
        table: &LabelsTable,
        (anchors, seen): (&[Anchored], Option<&Seen>),
        obstacles: Vec<[DVec2; 2]>,
    ) -> AnnotatedPage {
        let (size, gap) = (self.mm(table.size), self.mm(table.gap));
        let annotations = anchors.iter().map(|label| {
            let extent = extent(&label.text, size);
            // A point behind the eye is nowhere on the page, and the label is hidden.
            let anchor = view.point_of(label.world).map_or(DVec2::NAN, DVec2::from);
            Annotation {
                anchor: self.page.place(anchor, view.size),
                depth: -view.to_eye(label.world).z,
                size: DVec2::new(extent.advance, extent.ascent + extent.descent) + 2.0 * gap,
            }
        });
        AnnotatedPage {
            annotations: annotations.collect(),
            outline: widened(&self.around(view, seen), self.mm(table.distance)),
            frame: self.page.frame(),
            obstacles,
            rounds: table.rounds,
            least_opacity: table.least_opacity,
        }
    }

    /// Points of the page whose convex hull labels surround: of what is seen, of boxes that are drawn, and of the outlines
    /// of fans. Without rays and outlines it is the volume's box.
    fn around(&self, view: &View, seen: Option<&Seen>) -> Vec<DVec2> {
        let boxes = self.tables().boxes.iter().filter(|table| table.show == BoxShown::Always);
        let boxes = boxes.filter_map(|table| self.corners_of(&table.of)).flatten();
        let mut around = self.on_page(view, &boxes.collect::<Vec<_>>());
        let fans = self.tables().fans.iter().filter_map(|table| self.fan_outlines(view, table));
        around.extend(fans.flat_map(|fan| fan.outlines).flatten());
        around.extend(seen.iter().flat_map(|seen| &seen.ends).map(|&at| self.page.place(at.into(), view.size)));
        if around.is_empty() {
            around = self.on_page(view, &self.job.volume.grid().world_corners());
        }
        around
    }

    /// The labels of the scene, with the places that they lead to.
    fn anchored(
        &self,
        renderer: Option<&Renderer<'_>>,
        seen: Option<&Seen>,
        notes: &mut Vec<String>,
    ) -> Result<Vec<Anchored>, Failure> {
        let tables = &self.tables().labels;
        let largest = seen.map(|seen| &*seen.largest).unwrap_or_default();
        let place = |id: u32| largest.iter().find(|(seen, _)| *seen == id).map(|(_, world)| *world);
        let name = |id: u32| name_of_label(self.job, id);
        let mut found = Vec::new();
        for (i, label) in tables.iter().enumerate() {
            if label.from.is_some() {
                let most = largest.iter().take(label.most);
                found.extend(most.map(|(id, world)| Anchored { text: name(*id), world: *world, part: None }));
                continue;
            }
            let (text, world) = match label {
                LabelTable { at: Some(point), .. } => (None, Some(*point)),
                LabelTable { pixel: Some(pixel), .. } => {
                    let picked = renderer.and_then(|renderer| renderer.pick(point_of_pixel(*pixel)));
                    (None, picked.map(|picked| picked.world))
                }
                LabelTable { object: Some(part), .. } => (Some(part.to_string()), self.corners_of(part).map(centre)),
                _ => {
                    let id = self.id(label, i)?;
                    let world = match label.anchor {
                        LabelAnchor::Seen => place(id),
                        LabelAnchor::Centroid => {
                            self.labels_of_data().and_then(|(labels, grid)| centroid(labels, grid, id))
                        }
                    };
                    (Some(name(id)), world)
                }
            };
            let text = label.text.clone().or(text).unwrap_or_default();
            match world {
                Some(world) => found.push(Anchored { text, world, part: label.object.clone() }),
                None => notes.push(format!("the label {text:?} is left out: nothing is seen of what it names")),
            }
        }
        Ok(found)
    }

    /// The id of the structure that a label names.
    fn id(&self, label: &LabelTable, i: usize) -> Result<u32, Failure> {
        match &label.label {
            Some(LabelKey::Id(id)) => Ok(*id),
            Some(LabelKey::Name(name)) => self.job.label_names.id(name).ok_or_else(|| {
                let place = self.job.scene.given.position(&format!("label[{i}].label"));
                let remedy = crate::job::known_label(name, &self.job.label_names);
                Failure::new(format!("there is no label {name:?}"), place, remedy)
            }),
            None => Ok(0),
        }
    }

    fn labels_of_data(&self) -> Option<(&LabelVolume, Grid)> {
        let labels = self.job.label_volume()?;
        Some((labels, labels.grid_in(self.job.volume.anatomy())))
    }
}

/// Points whose convex hull lies a distance around that of others.
fn widened(points: &[DVec2], distance: f64) -> Vec<DVec2> {
    // The corners of an octagon around each point, which reach as far as a circle along the axes and the diagonals.
    let near = distance * (std::f64::consts::SQRT_2 - 1.0);
    let octagon = [[distance, near], [near, distance], [-near, distance], [-distance, near]].map(DVec2::from);
    points
        .iter()
        .flat_map(|&point| octagon.into_iter().flat_map(move |corner| [point + corner, point - corner]))
        .collect()
}

/// The centre of a box.
fn centre(corners: [DVec3; 8]) -> DVec3 {
    corners.iter().sum::<DVec3>() / 8.0
}

/// The visible structures and their outline in a frame.
struct Seen {
    /// The structures of the label volume, the largest first, with a point on each.
    largest: Vec<(u32, DVec3)>,
    /// The ends of each row of the picture in which something is seen, in pixels.
    ends: Vec<[f64; 2]>,
}

impl Seen {
    /// Looks along rays on a square grid over the picture.
    fn new(view: &View, renderer: &Renderer<'_>) -> Self {
        let [width, height] = view.size.map(|n| n as f64);
        let step = width.max(height) / LOOKS as f64;
        let [columns, rows] = [width, height].map(|side| ((side / step) as usize).max(1));
        let at = |n: usize, side: f64, steps: usize| (n as f64 + 0.5) * side / steps as f64;
        let point = |i: usize| [at(i % columns, width, columns), at(i / columns, height, rows)];
        let picked: Vec<Option<Picked>> = parallel::map(columns * rows, &|i| renderer.pick_from(MOST_LIGHT, point(i)));
        let id = |picked: &Option<Picked>| picked.and_then(|picked| picked.label).filter(|id| *id != 0);
        let ids: Vec<Option<u32>> = picked.iter().map(id).collect();
        let regions = inner_points(&ids, columns).into_iter();
        let largest = regions.filter_map(|region| Some((region.id, picked[region.inner]?.world)));
        let ends = (0..rows).flat_map(|row| {
            let mut hits = (row * columns..(row + 1) * columns).filter(|&i| picked[i].is_some());
            let first = hits.next();
            first.into_iter().chain(hits.next_back()).map(point)
        });
        Self { largest: largest.collect(), ends: ends.collect() }
    }
}

/// The centroid of the voxels of a label, in world space. Returns none if the label has no voxel.
fn centroid(labels: &LabelVolume, grid: Grid, id: u32) -> Option<DVec3> {
    let [nx, ny, nz] = grid.dims();
    let slices = parallel::map(nz, &|z| {
        let (mut sum, mut n) = (DVec3::ZERO, 0u64);
        for i in (0..nx * ny).filter(|i| labels.id(z * nx * ny + i) == id) {
            sum += DVec3::new((i % nx) as f64, (i / nx) as f64, z as f64);
            n += 1;
        }
        (sum, n)
    });
    let (sum, n) = slices.into_iter().fold((DVec3::ZERO, 0), |(sum, n), (s, m)| (sum + s, n + m));
    (n > 0).then(|| grid.to_world(sum / n as f64))
}

/// The labels of a layout that are left out, a sentence each.
fn left_out(found: &AnnotationLayout, page: &AnnotatedPage, labels: &[Anchored]) -> Vec<String> {
    let [low, high] = page.frame;
    let sentence = |((place, given), label): ((&PlacedAnnotation, &Annotation), &Anchored)| {
        let is_outside = given.anchor.clamp(low, high) != given.anchor;
        let why = match place.hidden? {
            Hidden::Overlap(other) => format!("it would overlap {:?}", labels.get(other)?.text),
            Hidden::Crossing(other) => format!("its leader line would cross that of {:?}", labels.get(other)?.text),
            Hidden::OutsideFrame if is_outside => "what it names is outside the picture".into(),
            Hidden::OutsideFrame => "there is no room for it in the picture".into(),
            Hidden::NoRoom => "the columns beside the structure have no room for it".into(),
            Hidden::OutOfRange => "the picture's lengths are too large or too small".into(),
            Hidden::Invalid => "what it names is not before the eye".into(),
        };
        Some(format!("the label {:?} is left out: {why}", label.text))
    };
    found.annotations.iter().zip(&page.annotations).zip(labels).filter_map(sentence).collect()
}
