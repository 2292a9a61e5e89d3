//! The layout of labels in two columns beside the picture.

mod sheet;
mod stack;

#[cfg(test)]
mod tests;

use super::hull::turns;
use super::layout::{by_depth, opacity, unplaced};
use drypoint_scene::annotations::{AnnotatedPage, AnnotationLayout, Hidden, PlacedAnnotation, Relocation};
use drypoint_scene::glam::DVec2;
use sheet::{Sheet, Side, Standing};

/// The largest coordinate of a frame, and the reciprocal of its smallest size. Products of a page's lengths are finite
/// and not 0.
const LARGEST: f64 = 1e150;

/// Places the labels of a page in two columns, at the left and at the right of the hull's bounding box.
///
/// - A column is flush at its inner edge, at a gap from the bounding box. A label that has no room there is hidden.
/// - Obstacles between a column's inner edge and the outer edge of its widest label part the column into free intervals
///   of y. Each box stands in one of them.
/// - A label stands in the column on its anchor's side of the box's middle. A label that fits in one column alone
///   stands there. A column that is full gives its labels nearest the middle to the other one.
/// - Labels of a column are in the order of their anchors' y. Labels whose lines cross are exchanged.
/// - The boxes of a column stand where the sum of squared vertical distances from their anchors is least.
/// - A leader line runs straight to its bend, which is level with the middle of its box, then horizontally.
/// - Labels have priority by depth, then by the list. If they do not all fit without a conflict, each label is shown
///   that fits together with the nearer labels that are shown.
///
/// Which labels are shown is a function of the page alone. A label keeps its column in the previous layout until its
/// anchor is beyond the middle by 5 % of the bounding box's width. If labels that are shown have conflicts in these
/// columns, all columns are those without a previous layout. A layout from a finished one changes nothing.
///
/// Anchors may move while the labels that are shown, their columns, their free intervals and their order stay. Then the
/// sum of the boxes' squared vertical motions is at most the sum of the anchors' squared vertical motions.
pub fn columns(page: &AnnotatedPage, previous: Option<&AnnotationLayout>) -> AnnotationLayout {
    let all = &page.annotations;
    let mut places: Vec<PlacedAnnotation> = all.iter().map(|annotation| unplaced(annotation, page.frame)).collect();
    let order = by_depth(all, &places);
    let (Some(&nearest), Some(&farthest)) = (order.first(), order.last()) else {
        return AnnotationLayout { annotations: places, relocations: Vec::new() };
    };
    let sheet = Sheet::new(page, order.iter().map(|&i| all[i]).collect());
    let is_large = page.frame.iter().any(|corner| corner.abs().max_element() > LARGEST);
    let is_small = (page.frame[1] - page.frame[0]).max_element() < LARGEST.recip();
    let mut fitting = Vec::new();
    for (label, &i) in order.iter().enumerate() {
        match sheet.fits(label) {
            _ if is_large => places[i].hidden = Some(Hidden::OutOfRange),
            _ if all[i].size.cmpgt(page.frame[1] - page.frame[0]).any() => {
                places[i].hidden = Some(Hidden::OutsideFrame)
            }
            _ if is_small => places[i].hidden = Some(Hidden::OutOfRange),
            [false, false] => places[i].hidden = Some(Hidden::NoRoom),
            _ => fitting.push(label),
        }
    }
    let before: Vec<Option<&PlacedAnnotation>> =
        order.iter().map(|&i| previous?.annotations.get(i).filter(|place| place.home.is_some())).collect();
    let was = |labels: &[usize]| labels.iter().map(|&label| before[label].and_then(side)).collect::<Vec<_>>();
    let (shown, left_out) = sheet.choose(&fitting);
    let kept = sheet.arrange(&shown, &was(&shown)).filter(|standing| sheet.are_free(standing));
    let standing = kept.or_else(|| sheet.arrange(&shown, &vec![None; shown.len()])).unwrap_or_default();
    let relocations = relocations(&sheet, &standing, &before, &order);
    let hidden = left_out.iter().flat_map(|&(label, reason)| {
        let (side, reason) = (sheet.side(label, before[label].and_then(side)), named(reason, &order));
        sheet.column(side, &[label]).into_iter().flatten().map(move |standing| (standing, Some(reason)))
    });
    for (Standing { label, slant: [anchor, bend], end, corners, .. }, hidden) in
        standing.into_iter().map(|standing| (standing, None)).chain(hidden)
    {
        let [t, home] = [bend, DVec2::new(bend.x, anchor.y)].map(|at| turns(at - sheet.middle));
        let leader = [bend, end];
        places[order[label]] = PlacedAnnotation { t, home: Some(home), corners, leader, opacity: 0.0, hidden };
    }
    for &i in &order {
        let depths = [nearest, farthest].map(|i| all[i].depth);
        places[i].opacity = opacity(all[i].depth, depths, page.least_opacity);
    }
    AnnotationLayout { annotations: places, relocations }
}

/// The column of a label in a previous layout.
fn side(place: &PlacedAnnotation) -> Option<Side> {
    let home = place.home?;
    Some(if (0.25..=0.75).contains(&home) { Side::Left } else { Side::Right })
}

/// A reason that names labels by their places in the list, from one that names them by priority.
fn named(reason: Hidden, order: &[usize]) -> Hidden {
    match reason {
        Hidden::Overlap(label) => Hidden::Overlap(order[label]),
        Hidden::Crossing(label) => Hidden::Crossing(order[label]),
        Hidden::NoRoom | Hidden::OutsideFrame | Hidden::OutOfRange | Hidden::Invalid => reason,
    }
}

/// Changes of column, and pairs of labels of one column that are exchanged.
///
/// Labels without a previous place come from the column on their anchor's side. Without a previous layout, labels of a
/// column come from the order of their anchors' y.
fn relocations(
    sheet: &Sheet<'_>,
    standing: &[Standing],
    before: &[Option<&PlacedAnnotation>],
    order: &[usize],
) -> Vec<Relocation> {
    let was = |label: usize| before[label].and_then(side);
    let changed = standing.iter().filter(|at| at.side != was(at.label).unwrap_or_else(|| sheet.side(at.label, None)));
    let mut relocations: Vec<_> = changed.map(|at| Relocation::ChangeOfSide(order[at.label])).collect();
    let is_first = before.iter().all(Option::is_none);
    let height = |at: &Standing| match before[at.label] {
        Some(place) => (place.hidden.is_none() && side(place) == Some(at.side)).then_some(place.leader[0].y),
        None => is_first.then_some(at.slant[0].y),
    };
    for (j, b) in standing.iter().enumerate() {
        for a in standing[..j].iter().filter(|a| a.side == b.side) {
            if height(a).zip(height(b)).is_some_and(|(a, b)| a > b) {
                let [i, j] = [order[a.label], order[b.label]];
                relocations.push(Relocation::Exchange(i.min(j), i.max(j)));
            }
        }
    }
    relocations
}
