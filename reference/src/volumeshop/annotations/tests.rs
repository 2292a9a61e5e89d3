use super::{columns, layout};
use drypoint_scene::annotations::{AnnotatedPage, Annotation, AnnotationLayout, Hidden, PlacedAnnotation, Relocation};
use drypoint_scene::glam::{DMat3, DVec2, DVec3};
use drypoint_scene::philox::uniforms;

const FRAME: [DVec2; 2] = [DVec2::ZERO, DVec2::new(800.0, 600.0)];

/// Penetration that rounding allows where boxes touch the hull, in the page's units.
pub(super) const ROUNDING: f64 = 1e-9;

pub(super) fn page(annotations: Vec<Annotation>, outline: Vec<DVec2>) -> AnnotatedPage {
    AnnotatedPage { annotations, outline, frame: FRAME, obstacles: Vec::new(), rounds: 256, least_opacity: 0.25 }
}

/// A label of 60 × 20.
pub(super) fn label(x: f64, y: f64, depth: f64) -> Annotation {
    Annotation { anchor: DVec2::new(x, y), depth, size: DVec2::new(60.0, 20.0) }
}

/// A scene of 1 to 30 labels whose anchors are weighted means of the points of the outline.
pub(super) fn random_page(scene: u32) -> AnnotatedPage {
    let draw = |k: u32, i: u32| uniforms(10, [scene, k, i], 0);
    let [count, corners, wide, high] = draw(0, 0);
    let half = DVec2::new(20.0 + 280.0 * wide, 20.0 + 200.0 * high);
    let outline = (0..3 + (corners * 20.0) as u32).map(|i| {
        let [x, y, ..] = draw(1, i);
        DVec2::new(400.0, 300.0) + half * (DVec2::new(x, y) * 2.0 - 1.0)
    });
    let outline: Vec<DVec2> = outline.collect();
    let annotations = (0..1 + (count * 30.0) as u32).map(|i| {
        let [a, b, c, depth] = draw(2, i);
        let [p, q, width, height] = draw(3, i);
        let weights = DVec3::new(a, b, c) / (a + b + c).max(1e-3);
        let pick = |u: f64| outline[(u * outline.len() as f64) as usize];
        let anchor = pick(p) * weights.x + pick(q) * weights.y + outline[0] * weights.z;
        let size = DVec2::new(20.0 + 100.0 * width, 10.0 + 20.0 * height);
        Annotation { anchor, depth: (depth * 8.0).floor(), size }
    });
    page(annotations.collect(), outline.clone())
}

/// Whether a line separates two convex polygons. Segments and points are polygons, too.
fn are_apart(a: &[DVec2], b: &[DVec2], tolerance: f64) -> bool {
    let edges = |p: &[DVec2]| (0..p.len()).map(|i| p[(i + 1) % p.len()] - p[i]).collect::<Vec<_>>();
    let edges = edges(a).into_iter().chain(edges(b)).chain([a[0] - b[0]]);
    edges.flat_map(|edge| [edge, edge.perp()]).any(|axis| {
        let Some(axis) = axis.try_normalize() else { return false };
        let range = |p: &[DVec2]| {
            let along = p.iter().map(|p| axis.dot(*p));
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        };
        let ([a0, a1], [b0, b1]) = (range(a), range(b));
        a1 <= b0 + tolerance || b1 <= a0 + tolerance
    })
}

fn corners([lower, upper]: [DVec2; 2]) -> [DVec2; 4] {
    [lower, DVec2::new(upper.x, lower.y), upper, DVec2::new(lower.x, upper.y)]
}

/// All triangles of some points. Together they cover the convex hull.
fn triangles(points: &[DVec2]) -> Vec<[DVec2; 3]> {
    let n = points.len();
    (0..n)
        .flat_map(|i| (0..i).flat_map(move |j| (0..j).map(move |k| [i, j, k])))
        .map(|t| t.map(|i| points[i]))
        .collect()
}

/// The conflict of two placed labels, found from their geometry alone.
pub(super) fn conflict(
    page: &AnnotatedPage,
    layout: &AnnotationLayout,
    [i, j]: [usize; 2],
    tolerance: f64,
) -> Option<Hidden> {
    let [a, b] = [i, j].map(|i| &layout.annotations[i]);
    let lines = [i, j].map(|i| {
        let [hull, end] = layout.annotations[i].leader;
        [[page.annotations[i].anchor, hull], [hull, end]]
    });
    if !are_apart(&corners(a.corners), &corners(b.corners), tolerance) {
        return Some(Hidden::Overlap(j));
    }
    // Lines from one anchor may meet there, but not run on top of each other or end at one point.
    let is_fork = |[a, b]: [DVec2; 2], [c, d]: [DVec2; 2]| {
        let (first, second) = (b - a, d - c);
        let is_along = first.perp_dot(second).abs() <= 1e-9 * first.length() * second.length();
        a == c && b != d && !(is_along && first.dot(second) > 0.0)
    };
    let in_box = |lines: [[DVec2; 2]; 2], place: &PlacedAnnotation| {
        lines.iter().any(|line| !are_apart(line, &corners(place.corners), tolerance))
    };
    let cross = lines[0].iter().enumerate().any(|(s, a)| {
        lines[1].iter().enumerate().any(|(t, b)| !(are_apart(a, b, tolerance) || s == 0 && t == 0 && is_fork(*a, *b)))
    });
    (cross || in_box(lines[0], b) || in_box(lines[1], a)).then_some(Hidden::Crossing(j))
}

pub(super) fn is_outside(page: &AnnotatedPage, i: usize, place: &PlacedAnnotation) -> bool {
    let points = [page.annotations[i].anchor, place.leader[0], place.corners[0], place.corners[1]];
    points.into_iter().any(|p| p.cmplt(page.frame[0]).any() || p.cmpgt(page.frame[1]).any())
}

/// The laws of a finished layout.
fn check(page: &AnnotatedPage, laid: &AnnotationLayout) {
    for (i, place) in laid.annotations.iter().enumerate() {
        assert!((0.0..1.0).contains(&place.t), "{place:?}");
        let mut kept = (0..laid.annotations.len()).filter(|&j| j != i && laid.annotations[j].hidden.is_none());
        match place.hidden {
            None => {
                assert!(kept.all(|j| conflict(page, laid, [i, j], ROUNDING).is_none()), "{i}");
                assert!(!is_outside(page, i, place));
                let hull = triangles(&page.outline);
                assert!(hull.iter().all(|triangle| are_apart(triangle, &corners(place.corners), ROUNDING)), "{i}");
            }
            Some(Hidden::OutsideFrame) => assert!(is_outside(page, i, place)),
            Some(met @ (Hidden::Overlap(j) | Hidden::Crossing(j))) => {
                // Two that touch may be in conflict or not.
                assert!(
                    [ROUNDING, -ROUNDING].map(|t| conflict(page, laid, [i, j], t)).contains(&Some(met)),
                    "{i} {met:?}"
                );
                assert!(kept.any(|kept| kept == j) && page.annotations[j].depth <= page.annotations[i].depth);
            }
            Some(hidden) => panic!("{i} {hidden:?}"),
        }
    }
}

/// Lays a page out twice, checks the laws, and that nothing is left to change.
fn laid_out(page: &AnnotatedPage) -> AnnotationLayout {
    let laid = layout(page, None);
    check(page, &laid);
    let again = layout(page, Some(&laid));
    assert!(again.annotations == laid.annotations);
    assert_eq!(again.relocations, []);
    assert_eq!(layout(page, None), laid);
    laid
}

pub(super) fn kept(layout: &AnnotationLayout) -> usize {
    layout.annotations.iter().filter(|place| place.hidden.is_none()).count()
}

#[test]
fn random_scenes_keep_the_laws() {
    for scene in 0..400 {
        laid_out(&random_page(scene));
    }
}

/// A finished layout is a start for other anchors, and the laws hold there, too.
#[test]
fn random_scenes_after_another() {
    for scene in 0..400 {
        let from = random_page(scene);
        let mut page = random_page(scene + 1);
        page.annotations.truncate(from.annotations.len());
        let moved = layout(&page, Some(&layout(&from, None)));
        check(&page, &moved);
        let again = layout(&page, Some(&moved));
        assert!(again.annotations == moved.annotations && again.relocations.is_empty(), "{scene}");
    }
}

/// Only the order of labels of equal depth matters. Here the list is sorted from the farthest to the nearest.
#[test]
fn ties_of_depth_are_in_the_order_of_the_list() {
    for scene in 0..200 {
        let page = random_page(scene);
        let mut order: Vec<usize> = (0..page.annotations.len()).collect();
        order.sort_by(|&i, &j| page.annotations[j].depth.total_cmp(&page.annotations[i].depth));
        let sorted =
            AnnotatedPage { annotations: order.iter().map(|&i| page.annotations[i]).collect(), ..page.clone() };
        for arrange in [layout, columns] {
            let [laid, sorted] = [&page, &sorted].map(|page| arrange(page, None).annotations);
            for (k, mut place) in sorted.into_iter().enumerate() {
                place.hidden = place.hidden.map(|hidden| match hidden {
                    Hidden::Overlap(met) => Hidden::Overlap(order[met]),
                    Hidden::Crossing(met) => Hidden::Crossing(order[met]),
                    other => other,
                });
                assert_eq!(place, laid[order[k]], "{scene}");
            }
        }
    }
    // The first of two labels of one anchor stays at its home, whatever its size.
    for first in [0, 1] {
        let mut labels = vec![label(400.0, 480.0, 1.0); 2];
        labels[0].size.x = 50.0;
        labels.rotate_left(first);
        let laid = layout(&page(labels, square()), None);
        assert_eq!([0, 1].map(|i| Some(laid.annotations[i].t) == laid.annotations[i].home), [true, false]);
    }
}

/// A square of side 200 about (400, 400).
pub(super) fn square() -> Vec<DVec2> {
    corners([DVec2::splat(300.0), DVec2::splat(500.0)]).to_vec()
}

fn assert_near(a: [DVec2; 2], b: [[f64; 2]; 2]) {
    let b = b.map(DVec2::from);
    assert!(a[0].distance(b[0]).max(a[1].distance(b[1])) < 1e-9, "{a:?} {b:?}");
}

#[test]
fn labels_stand_at_the_nearest_hull_points() {
    let page = page(vec![label(350.0, 480.0, 1.0), label(450.0, 480.0, 2.0)], square());
    let laid = layout(&page, None);
    assert_eq!(laid.relocations, []);
    assert_near(laid.annotations[0].corners, [[320.0, 500.0], [380.0, 520.0]]);
    assert_near(laid.annotations[0].leader, [[350.0, 500.0]; 2]);
    assert_eq!([0, 1].map(|i| laid.annotations[i].opacity), [1.0, 0.25]);
}

/// Two labels keep their sides past each other. Then their lines run on top of each other.
#[test]
fn lines_that_cross_are_exchanged() {
    let at = |a: f64, b: f64| page(vec![label(a, 400.0, 1.0), label(b, 400.0, 2.0)], square());
    let start = layout(&at(410.0, 390.0), None);
    let [right, left] = [0, 1].map(|i| start.annotations[i].t);
    let crossed = layout(&at(395.0, 405.0), Some(&start));
    assert_eq!(crossed.relocations, [Relocation::Exchange(0, 1)]);
    assert_eq!([0, 1].map(|i| crossed.annotations[i].t), [left, right]);
    assert_eq!(layout(&at(395.0, 405.0), Some(&crossed)).relocations, []);
}

/// A label that was hidden is shown once there is room, and a label that is shown may move for it.
#[test]
fn a_label_that_was_hidden_takes_part() {
    for scene in 0..200 {
        let page = random_page(scene);
        let mut hidden = layout(&page, None);
        for (i, place) in hidden.annotations.iter_mut().enumerate() {
            place.hidden = place.hidden.or((i % 2 == 0).then_some(Hidden::OutsideFrame));
        }
        assert_eq!(layout(&page, Some(&hidden)).annotations, layout(&page, None).annotations, "{scene}");
    }
}

#[test]
fn few_rounds_are_a_finished_layout() {
    for scene in 0..25 {
        for rounds in [0, 1, 3, usize::MAX] {
            laid_out(&AnnotatedPage { rounds, ..random_page(scene) });
        }
    }
}

/// Lines from one anchor on the hull's border do not run along the border on top of each other.
#[test]
fn labels_of_an_anchor_on_the_border() {
    let laid = laid_out(&page((0..6).map(|i| label(450.0, 500.0, f64::from(i))).collect(), square()));
    let shown: Vec<_> = laid.annotations.iter().filter(|place| place.hidden.is_none()).collect();
    let on_top_edge = |sign: f64| {
        let along = shown.iter().map(|place| place.leader[0] - DVec2::new(450.0, 500.0));
        along.filter(|way| way.y.abs() < 1e-9 && way.x * sign > 1e-9).count()
    };
    assert!(shown.len() >= 3 && on_top_edge(1.0) <= 1 && on_top_edge(-1.0) <= 1, "{shown:?}");
}

/// The bottom edge's minimum ends at its right vertex. The label follows the next edge to its foot, and reports it.
#[test]
fn a_minimum_that_vanishes_is_reported() {
    let hull = [[100.0, 300.0], [300.0, 300.0], [550.0, 500.0], [100.0, 550.0]].map(DVec2::from);
    let at = |x: f64| page(vec![label(x, 360.0, 1.0)], hull.to_vec());
    let mut layout = super::layout(&at(250.0), None);
    let mut reported = Vec::new();
    for x in 251..313 {
        let next = super::layout(&at(f64::from(x)), Some(&layout));
        let way = next.annotations[0].leader[0].distance(layout.annotations[0].leader[0]);
        assert_eq!(way > 0.05 * hull[0].distance(hull[2]), !next.relocations.is_empty(), "{x} {way}");
        reported.extend(next.relocations.iter().map(|relocation| (x, *relocation)));
        layout = next;
    }
    assert_eq!(reported, [(300, Relocation::ChangeOfSide(0))]);
}

#[test]
fn thirty_labels_with_one_anchor() {
    let labels = (0..30).map(|i| label(400.0, 320.0, f64::from(i))).collect();
    let laid = laid_out(&page(labels, square()));
    assert_eq!(kept(&laid), 24);
}

/// Prints the time of a layout. It is meant for an optimized build.
#[test]
#[ignore = "prints times"]
fn time_of_thirty_labels() {
    let mut crowd = page((0..30).map(|i| label(400.0, 320.0, f64::from(i))).collect(), square());
    for rounds in [0, 16, 64, 256] {
        crowd.rounds = rounds;
        for arrange in [layout, columns] {
            let start = std::time::Instant::now();
            (0..20).for_each(|_| drop(arrange(&crowd, None)));
            println!("30 labels, {rounds} rounds: {:?}", start.elapsed() / 20);
        }
    }
    let mut slowest = [std::time::Duration::ZERO; 2];
    for page in (0..400).map(random_page) {
        for (k, arrange) in [layout, columns].into_iter().enumerate() {
            let start = std::time::Instant::now();
            arrange(&page, None);
            slowest[k] = slowest[k].max(start.elapsed());
        }
    }
    println!(
        "shown in random pages: {}",
        (0..400).map(|scene| kept(&layout(&random_page(scene), None))).sum::<usize>()
    );
    println!("slowest random pages: {slowest:?}");
}

#[test]
fn the_farther_of_two_labels_is_nudged() {
    let page = page(vec![label(400.0, 480.0, 2.0), label(400.0, 480.0, 1.0)], square());
    let laid = laid_out(&page);
    // At t = ¼ + k/256 the hull point is 100 tan(2πk/256) from the middle: at least a box's 60 from k = 23 on.
    assert_eq!([0, 1].map(|i| laid.annotations[i].t), [0.25 + 23.0 / 256.0, 0.25]);
    assert_eq!(laid.relocations, [Relocation::Nudge(0)]);
}

#[test]
fn a_label_keeps_its_side_by_the_margin() {
    // 5 % of the diameter √2·200 are 14.14.
    let at = |x: f64| page(vec![label(x, 400.0, 1.0)], square());
    let start = layout(&at(480.0), None);
    let follow = |layout: &mut AnnotationLayout, x: f64| {
        *layout = super::layout(&at(x), Some(layout));
        (layout.annotations[0].leader[0], layout.relocations.clone())
    };
    let mut layout = start;
    let [left, right] = [300.0, 500.0].map(|x| DVec2::new(x, 400.0));
    for (x, side, relocations) in [
        (410.0, right, vec![]),
        (393.0, right, vec![]),
        (392.9, left, vec![Relocation::ChangeOfSide(0)]),
        (407.0, left, vec![]),
        (407.1, right, vec![Relocation::ChangeOfSide(0)]),
    ] {
        let (at, reported) = follow(&mut layout, x);
        assert!(at.distance(side) < 1e-9 && reported == relocations, "{x}: {at} {reported:?}");
    }
}

#[test]
fn lines_fade_with_depth() {
    let depths = [3.0, 1.0, 2.0, 5.0];
    let labels = depths.iter().enumerate().map(|(i, &depth)| label(320.0 + 50.0 * i as f64, 400.0, depth));
    let laid = layout(&page(labels.collect(), square()), None);
    assert_eq!([0, 1, 2, 3].map(|i| laid.annotations[i].opacity), [0.625, 1.0, 0.8125, 0.25]);
    let equal = layout(&page(vec![label(350.0, 400.0, 7.0), label(450.0, 400.0, 7.0)], square()), None);
    assert_eq!([0, 1].map(|i| equal.annotations[i].opacity), [1.0; 2]);
}

/// A box with 12 anchors turns by a degree a step. Jumps are motions by more than 5 % of the hull's diameter.
#[test]
fn labels_of_a_turning_box_move_smoothly() {
    let half = DVec3::new(180.0, 150.0, 120.0);
    let turned = |degree: u32| {
        let turn = DMat3::from_rotation_x(0.4) * DMat3::from_rotation_y(f64::from(degree).to_radians());
        let project = |p: DVec3| turn * (p * half) * DVec3::new(1.0, 1.0, -1.0) + DVec3::new(400.0, 300.0, 1000.0);
        let bit = |i: usize, axis: usize| if i >> axis & 1 == 0 { -1.0 } else { 1.0 };
        let outline = (0..8).map(|i| project(DVec3::new(bit(i, 0), bit(i, 1), bit(i, 2))).truncate());
        let labels = (0..12).map(|i| {
            let [x, y, z, width] = uniforms(3, [5, i, 0], 0);
            let at = project((DVec3::new(x, y, z) * 2.0 - 1.0) * 0.95);
            Annotation { anchor: at.truncate(), depth: at.z, size: DVec2::new(30.0 + 60.0 * width, 16.0) }
        });
        page(labels.collect(), outline.collect())
    };
    let mut layout = super::layout(&turned(0), None);
    let (mut hidden, mut jumps, mut steps) = (12 - kept(&layout), 0, 0);
    for degree in 1..=360 {
        let page = turned(degree % 360);
        let next = super::layout(&page, Some(&layout));
        check(&page, &next);
        hidden += 12 - kept(&next);
        let pairs = page.outline.iter().flat_map(|a| page.outline.iter().map(|b| a.distance(*b)));
        let diameter = pairs.fold(0.0, f64::max);
        let mut jumped = false;
        for (i, [a, b]) in layout.annotations.iter().zip(&next.annotations).map(|(a, b)| [a, b]).enumerate() {
            let is_far = a.leader[0].distance(b.leader[0]) > 0.05 * diameter;
            if a.hidden.is_none() && b.hidden.is_none() && is_far {
                assert!(next.relocations.iter().any(|relocation| match *relocation {
                    Relocation::Exchange(j, k) => i == j || i == k,
                    Relocation::Nudge(j) | Relocation::Return(j) | Relocation::ChangeOfSide(j) => i == j,
                }));
                (jumps, jumped) = (jumps + 1, true);
            }
        }
        steps += usize::from(jumped);
        layout = next;
    }
    // Each jump is reported as the end of a conflict or a change of side.
    assert!([hidden, jumps, steps] == [0, 116, 72], "{hidden} {jumps} {steps}");
}

#[test]
fn hard_cases() {
    let at = |n: u32, x: f64, y: f64| (0..n).map(|i| label(x, y, f64::from(i))).collect::<Vec<_>>();
    // A box larger than the picture.
    let mut large = page(at(2, 400.0, 320.0), square());
    large.annotations[0].size = DVec2::new(900.0, 20.0);
    let laid = laid_out(&large);
    assert_eq!([0, 1].map(|i| laid.annotations[i].hidden), [Some(Hidden::OutsideFrame), None]);
    // A hull that is a line, a point, or nothing but the anchors.
    for outline in [vec![DVec2::new(200.0, 300.0), DVec2::new(500.0, 350.0)], vec![DVec2::splat(300.0)], vec![]] {
        let labels: Vec<_> = [0.1, 0.5, 0.8].map(|s| label(200.0 + 300.0 * s, 300.0 + 50.0 * s, s)).to_vec();
        let labels = if outline.len() == 1 { at(3, 300.0, 300.0) } else { labels };
        assert!(kept(&laid_out(&page(labels, outline))) >= 2);
    }
    // Numbers that are not finite, negative sizes, anchors outside the frame.
    let mut odd = page(at(5, 400.0, 320.0), square());
    odd.outline.push(DVec2::NAN);
    odd.annotations[0].anchor.x = f64::NAN;
    odd.annotations[1].depth = f64::INFINITY;
    odd.annotations[2].size.y = -1.0;
    odd.annotations[3].anchor.x = 801.0;
    let laid = layout(&odd, None);
    let invalid = Some(Hidden::Invalid);
    assert_eq!(
        [0, 1, 2, 3, 4].map(|i| laid.annotations[i].hidden),
        [invalid, invalid, invalid, Some(Hidden::OutsideFrame), None]
    );
    assert_eq!(layout(&odd, Some(&laid)).annotations[4], laid.annotations[4]);
    // Boxes without extent, no rounds, no labels, a frame without extent, numbers near the end of f64.
    let mut points = page(at(3, 400.0, 320.0), square());
    points.annotations[1].size.x = 0.0;
    points.annotations[2].size = DVec2::ZERO;
    assert_eq!([0, 1, 2].map(|i| layout(&points, None).annotations[i].hidden), [None, invalid, invalid]);
    laid_out(&AnnotatedPage { rounds: 0, ..random_page(1) });
    assert_eq!(layout(&page(vec![], square()), None), AnnotationLayout::default());
    let none = layout(&AnnotatedPage { frame: [DVec2::splat(400.0); 2], ..page(at(2, 400.0, 400.0), vec![]) }, None);
    assert_eq!(none.annotations.iter().map(|place| place.hidden).collect::<Vec<_>>(), [Some(Hidden::OutsideFrame); 2]);
    let mut huge = page(at(3, 1e308, 1e308), vec![DVec2::splat(-1e308), DVec2::new(1e308, -1e308)]);
    huge.frame = [DVec2::splat(-1.7e308), DVec2::splat(1.7e308)];
    assert!(layout(&huge, None).annotations.iter().all(|place| place.hidden == Some(Hidden::OutOfRange)));
    let mut tiny = page(at(2, 1e-200, 1e-200), vec![DVec2::ZERO, DVec2::new(2e-200, 0.0), DVec2::new(0.0, 2e-200)]);
    tiny.frame = [DVec2::splat(-1e-199), DVec2::splat(1e-199)];
    tiny.annotations.iter_mut().for_each(|label| label.size = DVec2::splat(1e-201));
    assert!(layout(&tiny, None).annotations.iter().all(|place| place.hidden == Some(Hidden::OutOfRange)));
    // Depths whose difference is not finite.
    let depths = [-1e308, 0.0, 1e308].map(|depth| label(350.0 + depth / 1e307, 400.0, depth));
    let deep = layout(&page(depths.to_vec(), square()), None);
    assert_eq!([0, 1, 2].map(|i| deep.annotations[i].opacity), [1.0, 0.625, 0.25]);
}

/// A label whose home is covered stands beside the obstacle; without room beside it it is hidden.
#[test]
fn labels_cover_no_obstacle() {
    let mut page = random_page(3);
    let free = layout(&page, None);
    let i = free.annotations.iter().position(|place| place.hidden.is_none()).unwrap();
    page.obstacles = vec![free.annotations[i].corners];
    let found = layout(&page, None);
    for place in found.annotations.iter().filter(|place| place.hidden.is_none()) {
        let [[lo, hi], [low, high]] = [place.corners, page.obstacles[0]];
        assert!(!(lo.cmplt(high).all() && low.cmplt(hi).all()), "{place:?}");
    }
    let at_home = found.annotations[i];
    assert!(at_home.hidden.is_some() || at_home.corners != free.annotations[i].corners);
    page.obstacles = vec![page.frame];
    let none = layout(&page, None);
    assert!(none.annotations.iter().all(|place| matches!(place.hidden, Some(Hidden::OutsideFrame | Hidden::Invalid))));
}
