use super::columns;
use crate::volumeshop::annotations::tests::{ROUNDING, conflict, is_outside, kept, label, page};
use crate::volumeshop::annotations::tests::{random_page, square};
use drypoint_scene::annotations::{AnnotatedPage, Annotation, AnnotationLayout, Hidden, PlacedAnnotation, Relocation};
use drypoint_scene::glam::DVec2;
use drypoint_scene::philox::uniforms;

const WIDE: [DVec2; 2] = [DVec2::new(-100.0, 0.0), DVec2::new(900.0, 600.0)];

/// Random pages: with much room beside the hull, with little, with columns that are full, and with obstacles.
fn random_pages() -> impl Iterator<Item = AnnotatedPage> {
    (0..800).map(|scene| {
        let mut page = random_page(scene);
        match scene % 4 {
            0 => page.frame = WIDE,
            1 => page.frame = [DVec2::new(250.0, 100.0), DVec2::new(550.0, 500.0)],
            2 => page.annotations.iter_mut().for_each(|label| label.size.y *= 3.0),
            _ => {
                page.frame = WIDE;
                page.obstacles = (0..4).map(|i| obstacle(scene, i)).collect();
            }
        }
        page
    })
}

/// An obstacle at the left or at the right end of the wide frame.
fn obstacle(scene: u32, i: u32) -> [DVec2; 2] {
    let [x, y, width, height] = uniforms(14, [scene, i, 0], 0);
    let size = DVec2::new(20.0 + 200.0 * width, 10.0 + 150.0 * height);
    let x = if i.is_multiple_of(2) { -100.0 + 100.0 * x } else { 900.0 - size.x - 100.0 * x };
    let low = DVec2::new(x, 620.0 * y - 20.0);
    [low, low + size]
}

/// Whether the insides of two rectangles overlap.
fn overlap([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    a.cmplt(d).all() && c.cmplt(b).all()
}

/// The bounding box of the hull and the anchors in the frame.
fn bounds(page: &AnnotatedPage) -> [DVec2; 2] {
    let outline = page.outline.iter().map(|point| point.clamp(page.frame[0], page.frame[1]));
    let anchors = page.annotations.iter().map(|label| label.anchor);
    let inside = anchors.filter(|anchor| anchor.clamp(page.frame[0], page.frame[1]) == *anchor);
    outline.chain(inside).fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[lo, hi], p| [lo.min(p), hi.max(p)])
}

fn is_left(place: &PlacedAnnotation) -> bool {
    place.leader[0].x > place.leader[1].x
}

/// The labels of a column that are shown, from the least y to the largest.
fn column(laid: &AnnotationLayout, left: bool) -> Vec<usize> {
    let shown = |i: &usize| laid.annotations[*i].hidden.is_none() && is_left(&laid.annotations[*i]) == left;
    let mut column: Vec<usize> = (0..laid.annotations.len()).filter(shown).collect();
    column.sort_by(|&i, &j| laid.annotations[i].leader[0].y.total_cmp(&laid.annotations[j].leader[0].y));
    column
}

/// The conditions for the least sum of squared vertical shifts (Karush, Kuhn, Tucker): where boxes touch, no upper part
/// of them would rather move up, and no lower part down, unless the frame or an obstacle stops it.
fn check_least(page: &AnnotatedPage, laid: &AnnotationLayout, column: &[usize]) {
    let place = |k: usize| &laid.annotations[column[k]];
    let shift = |k: usize| place(k).leader[0].y - page.annotations[column[k]].anchor.y;
    let x = |low: bool| {
        let ends = column.iter().map(|&i| laid.annotations[i].corners);
        ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], [a, b]| [lo.min(a.x), hi.max(b.x)])[usize::from(!low)]
    };
    let met: Vec<_> = page.obstacles.iter().filter(|[lo, hi]| lo.x < x(false) && x(true) < hi.x).collect();
    let touch = |k: usize| place(k).corners[1].y >= place(k + 1).corners[0].y - ROUNDING;
    let near = |a: f64, b: f64| (a - b).abs() <= ROUNDING;
    let mut first = 0;
    for k in 0..column.len() {
        if k + 1 < column.len() && touch(k) {
            continue;
        }
        let [is_first, is_last] = [
            met.iter().map(|[_, high]| high.y).chain([page.frame[0].y]).any(|y| near(place(first).corners[0].y, y)),
            met.iter().map(|[low, _]| low.y).chain([page.frame[1].y]).any(|y| near(place(k).corners[1].y, y)),
        ];
        for middle in first..=k {
            let above: f64 = (first..=middle).map(shift).sum();
            let below: f64 = (middle..=k).map(shift).sum();
            assert!(is_first || above <= 1e-6, "{above}");
            assert!(is_last || below >= -1e-6, "{below}");
        }
        first = k + 1;
    }
}

/// Whether a box has room between the hull's bounding box and the frame, beyond the gap of a fortieth of the diagonal.
fn has_room(page: &AnnotatedPage, i: usize) -> bool {
    let ([low, high], gap) = (bounds(page), page.frame[0].distance(page.frame[1]) / 40.0);
    (low.x - page.frame[0].x).max(page.frame[1].x - high.x) >= page.annotations[i].size.x + gap
}

/// The laws of a finished layout in columns.
fn check(page: &AnnotatedPage, laid: &AnnotationLayout) {
    let is_nearer = |j: usize, i: usize| (page.annotations[j].depth, j) < (page.annotations[i].depth, i);
    for (i, place) in laid.annotations.iter().enumerate() {
        let mut others = (0..laid.annotations.len()).filter(|&j| j != i && laid.annotations[j].hidden.is_none());
        match place.hidden {
            None => {
                assert_eq!(others.find_map(|j| conflict(page, laid, [i, j], ROUNDING)), None, "{i}");
                assert!(!is_outside(page, i, place), "{i}");
                assert!(!page.obstacles.iter().any(|obstacle| overlap(place.corners, *obstacle)), "{i}");
                assert!(!overlap(place.corners, bounds(page)), "{i}");
                let [low, high] = place.corners;
                let [bend, end] = place.leader;
                assert!(bend.y == end.y && bend.y == low.y / 2.0 + high.y / 2.0);
                assert_eq!(end.x, if is_left(place) { high.x } else { low.x });
                assert!((high - low - page.annotations[i].size).abs().max_element() <= ROUNDING);
            }
            Some(Hidden::Crossing(j)) => assert!(others.any(|k| k == j) && is_nearer(j, i)),
            // Without obstacles the label has no room beside the hull, or nearer labels take it.
            Some(Hidden::NoRoom) => {
                assert!(!page.obstacles.is_empty() || !has_room(page, i) || others.any(|j| is_nearer(j, i)), "{i}")
            }
            Some(Hidden::OutsideFrame) => {}
            Some(hidden) => panic!("{i} {hidden:?}"),
        }
    }
    for left in [true, false] {
        let column = column(laid, left);
        check_least(page, laid, &column);
        let inner: Vec<f64> = column.iter().map(|&i| laid.annotations[i].leader[1].x).collect();
        assert!(inner.windows(2).all(|pair| pair[0] == pair[1]), "{inner:?}");
    }
}

/// Lays a page out, checks the laws, and that laying it out again changes nothing.
fn laid_out(page: &AnnotatedPage, previous: Option<&AnnotationLayout>) -> AnnotationLayout {
    let laid = columns(page, previous);
    check(page, &laid);
    let again = columns(page, Some(&laid));
    assert_eq!((&again.annotations, &again.relocations[..]), (&laid.annotations, &[][..]));
    laid
}

#[test]
fn random_pages_keep_the_laws() {
    // Shown, left out for a crossing, without room, and outside the frame.
    let mut count = [[0; 4]; 4];
    for (k, page) in random_pages().enumerate() {
        let laid = laid_out(&page, None);
        for place in &laid.annotations {
            let reason = match place.hidden {
                None => 0,
                Some(Hidden::Crossing(_)) => 1,
                Some(Hidden::NoRoom) => 2,
                Some(_) => 3,
            };
            count[k % 4][reason] += 1;
        }
    }
    // Frames with room, frames narrower than most hulls, columns that are full, and obstacles.
    assert_eq!(count, [[3167, 0, 1, 0], [949, 6, 1815, 142], [2601, 9, 480, 0], [3245, 2, 3, 0]]);
}

/// Labels of one height that have room beside the hull are all shown up to the columns' height, whatever their anchors.
#[test]
fn labels_of_one_height_are_hidden_only_if_both_columns_are_full() {
    for scene in 0..400 {
        let mut page = random_page(scene);
        page.frame = [DVec2::new(-100.0, 150.0), DVec2::new(900.0, 450.0)];
        page.annotations.iter_mut().for_each(|label| label.size.y = 25.0);
        let inside =
            page.annotations.iter().filter(|label| label.anchor.clamp(page.frame[0], page.frame[1]) == label.anchor);
        assert_eq!(kept(&laid_out(&page, None)), inside.count().min(24), "{scene}");
    }
}

/// A finished layout is a start for other anchors, and the laws hold there, too.
#[test]
fn random_pages_after_another() {
    let pages: Vec<_> = random_pages().collect();
    for pair in pages.windows(2) {
        laid_out(&pair[1], Some(&columns(&pair[0], None)));
    }
}

/// The bounds of the sum of squared motions, for anchors that move up and down by little.
#[test]
fn small_motions_stay_small() {
    let mut compared = 0;
    for (scene, page) in random_pages().enumerate() {
        let mut moved = page.clone();
        for (i, label) in moved.annotations.iter_mut().enumerate() {
            label.anchor.y += uniforms(11, [scene as u32, i as u32, 0], 0)[0] - 0.5;
        }
        let from = columns(&page, None);
        let to = laid_out(&moved, Some(&from));
        let is_comparable = from.annotations.iter().zip(&to.annotations).all(|(a, b)| a.hidden == b.hidden);
        if is_comparable && to.relocations.is_empty() {
            let shown = (0..page.annotations.len()).filter(|&i| to.annotations[i].hidden.is_none());
            let [boxes, anchors] = shown.fold([0.0, 0.0], |[boxes, anchors], i| {
                let square = |a: f64, b: f64| (a - b) * (a - b);
                let [a, b] = [&from, &to].map(|laid| laid.annotations[i].corners[0].y);
                let [p, q] = [&page, &moved].map(|page| page.annotations[i].anchor.y);
                [boxes + square(a, b), anchors + square(p, q)]
            });
            assert!(boxes <= anchors + 1e-9, "{scene}: {boxes} {anchors}");
            compared += 1;
        }
    }
    assert!(compared > 300, "{compared}");
}

/// The closed form of two columns beside a square of side 200: the gap is a fortieth of the diagonal 1000.
#[test]
fn columns_stand_beside_the_hull() {
    let anchors = [(350.0, 350.0), (420.0, 400.0), (450.0, 404.0), (480.0, 480.0)];
    let labels = anchors.iter().map(|&(x, y)| label(x, y, 1.0)).collect();
    let laid = laid_out(&page(labels, square()), None);
    let near = |i: usize, corners: [[f64; 2]; 2], leader: [[f64; 2]; 2]| {
        let place = &laid.annotations[i];
        let found = [place.corners, place.leader].concat();
        let wanted = [corners, leader].concat();
        assert!(found.iter().zip(&wanted).all(|(a, b)| a.distance(DVec2::from(*b)) < 1e-9), "{i}: {place:?}");
    };
    near(0, [[215.0, 340.0], [275.0, 360.0]], [[287.5, 350.0], [275.0, 350.0]]);
    // Two boxes ask for heights 4 apart. They stand 20 apart about the same mean.
    near(1, [[525.0, 382.0], [585.0, 402.0]], [[512.5, 392.0], [525.0, 392.0]]);
    near(2, [[525.0, 402.0], [585.0, 422.0]], [[512.5, 412.0], [525.0, 412.0]]);
    near(3, [[525.0, 470.0], [585.0, 490.0]], [[512.5, 480.0], [525.0, 480.0]]);
    assert_eq!(laid.relocations, []);
}

/// A gap of 1/40 of the frame's diagonal, and a label of 60: each side of the hull needs 60 and the gap.
#[test]
fn a_label_without_room_beside_the_hull_is_hidden() {
    let mut page = page(vec![label(460.0, 400.0, 1.0), label(340.0, 400.0, 1.0)], square());
    page.frame = [DVec2::new(260.0, 0.0), DVec2::new(600.0, 600.0)];
    let laid = laid_out(&page, None);
    // Both stand at the right, where there is room.
    assert!(kept(&laid) == 2 && laid.annotations.iter().all(|place| !is_left(place)));
    page.frame[1].x = 560.0;
    let hidden = laid_out(&page, None).annotations.iter().map(|place| place.hidden).collect::<Vec<_>>();
    assert_eq!(hidden, [Some(Hidden::NoRoom); 2]);
}

/// The margin is 5 % of the width 200.
#[test]
fn a_label_keeps_its_column_by_the_margin() {
    let at = |x: f64| page(vec![label(x, 400.0, 1.0)], square());
    let mut laid = columns(&at(420.0), None);
    for (x, left, relocations) in [
        (390.1, false, vec![]),
        (389.9, true, vec![Relocation::ChangeOfSide(0)]),
        (409.9, true, vec![]),
        (410.1, false, vec![Relocation::ChangeOfSide(0)]),
    ] {
        laid = laid_out(&at(x), Some(&laid));
        assert_eq!((is_left(&laid.annotations[0]), &laid.relocations), (left, &relocations), "{x}");
    }
}

/// A frame of height 100 has room for five labels a column.
#[test]
fn a_full_column_gives_its_labels_nearest_the_middle() {
    let labels = |n: u32| (0..n).map(|i| label(410.0 + 5.0 * f64::from(i), 400.0, f64::from(i))).collect::<Vec<_>>();
    let sheet = |n: u32| AnnotatedPage {
        frame: [DVec2::new(0.0, 350.0), DVec2::new(800.0, 450.0)],
        ..page(labels(n), square())
    };
    let laid = laid_out(&sheet(7), None);
    assert_eq!([column(&laid, true).len(), column(&laid, false).len()], [2, 5]);
    assert!(is_left(&laid.annotations[0]) && is_left(&laid.annotations[1]));
    assert_eq!(laid.relocations[..2], [0, 1].map(Relocation::ChangeOfSide));
    // Both are full with ten. The farthest are left out.
    let laid = laid_out(&sheet(12), None);
    let hidden = laid.annotations.iter().map(|place| place.hidden);
    let wanted = (0..12).map(|i| (i >= 10).then_some(Hidden::NoRoom));
    assert!(hidden.eq(wanted), "{laid:?}");
}

/// By y alone the lines would cross: the upper one of two anchors is far from the column, and a crowd above pushes both
/// boxes down.
#[test]
fn lines_that_cross_are_exchanged() {
    let crowd = (0..8).map(|i| label(470.0 + f64::from(i), 390.0 + f64::from(i) / 8.0, 1.0));
    let labels: Vec<_> = [label(405.0, 400.0, 1.0), label(498.0, 401.0, 1.0)].into_iter().chain(crowd).collect();
    let laid = laid_out(&page(labels, square()), None);
    assert_eq!(kept(&laid), 10);
    assert!(laid.relocations.contains(&Relocation::Exchange(0, 1)), "{:?}", laid.relocations);
}

#[test]
fn hard_cases() {
    let at = |n: u32, x: f64, y: f64| (0..n).map(|i| label(x, y, f64::from(i))).collect::<Vec<_>>();
    // 30 labels with one anchor: all fit in one column of 600.
    assert_eq!(kept(&laid_out(&page(at(30, 400.0, 320.0), square()), None)), 30);
    // A hull that is a line or a point, or nothing but the anchors.
    for outline in [vec![DVec2::new(400.0, 100.0), DVec2::new(400.0, 500.0)], vec![DVec2::splat(300.0)], vec![]] {
        assert_eq!(kept(&laid_out(&page(at(3, 300.0, 300.0), outline), None)), 3);
    }
    // A box larger than the picture, and numbers that are not valid.
    let mut odd = page(at(6, 400.0, 320.0), square());
    odd.outline.push(DVec2::NAN);
    odd.annotations[0].anchor.x = f64::NAN;
    odd.annotations[1].depth = f64::INFINITY;
    odd.annotations[2].size.y = 0.0;
    odd.annotations[3].anchor.x = 801.0;
    odd.annotations[4].size.x = 900.0;
    let laid = columns(&odd, None);
    let [invalid, outside] = [Hidden::Invalid, Hidden::OutsideFrame].map(Some);
    let hidden: Vec<_> = laid.annotations.iter().map(|place| place.hidden).collect();
    assert_eq!(hidden, [invalid, invalid, invalid, outside, outside, None]);
    // The first label has NaN as its place.
    assert_eq!(columns(&odd, Some(&laid)).annotations[1..], laid.annotations[1..]);
    // No labels, no rounds, a frame without extent, numbers near the ends of f64.
    assert_eq!(columns(&page(vec![], square()), None), AnnotationLayout::default());
    laid_out(&AnnotatedPage { rounds: 0, ..random_page(1) }, None);
    let none = columns(&AnnotatedPage { frame: [DVec2::splat(400.0); 2], ..page(at(1, 400.0, 400.0), vec![]) }, None);
    assert_eq!(none.annotations[0].hidden, outside);
    for size in [1e308, 1e-200] {
        let mut page = page(at(3, size, size), vec![DVec2::splat(-size), DVec2::new(size, -size)]);
        page.frame = [DVec2::splat(-1.7 * size), DVec2::splat(1.7 * size)];
        page.annotations.iter_mut().for_each(|label| label.size = DVec2::splat(size / 100.0));
        assert!(columns(&page, None).annotations.iter().all(|place| place.hidden == Some(Hidden::OutOfRange)));
    }
    for frame in [f64::INFINITY, f64::NAN] {
        let frame = [DVec2::splat(-frame), DVec2::splat(frame)];
        let laid = columns(&AnnotatedPage { frame, ..page(at(3, 400.0, 300.0), square()) }, None);
        assert_eq!(kept(&laid), 0);
    }
}

/// An obstacle in the corner of a column takes its own heights from this column alone, and a wide one that the column's
/// labels do not reach takes nothing.
#[test]
fn columns_leave_obstacles_free() {
    let mut page = page(vec![label(460.0, 590.0, 1.0), label(340.0, 590.0, 1.0)], square());
    let y = |page: &AnnotatedPage| {
        laid_out(page, None).annotations.iter().map(|place| place.corners[1].y).collect::<Vec<_>>()
    };
    page.obstacles = vec![[DVec2::new(220.0, 570.0), DVec2::new(300.0, 590.0)]];
    assert_eq!(y(&page), [600.0, 570.0]);
    page.obstacles = vec![[DVec2::new(0.0, 570.0), DVec2::new(210.0, 600.0)]];
    assert_eq!(y(&page), [600.0, 600.0]);
    // A wider label of the column reaches the obstacle.
    page.annotations.push(Annotation { size: DVec2::new(80.0, 20.0), ..label(330.0, 300.0, 1.0) });
    assert_eq!(y(&page), [600.0, 570.0, 310.0]);
}

/// A legend, a bar, a triad and letters take only what they cover: a page of seven labels keeps them all.
#[test]
fn a_full_margin_hides_no_label_that_has_room() {
    for scene in 0..200 {
        let free = AnnotatedPage { frame: WIDE, ..random_page(scene) };
        let mut page = free.clone();
        page.annotations.truncate(7);
        page.obstacles = (0..4).map(|i| obstacle(scene, i)).collect();
        let laid = laid_out(&page, None);
        // Each column has at most two obstacles of 160. Seven labels take at most 210 of its 600.
        assert_eq!(kept(&laid), page.annotations.len(), "{scene}");
    }
}
