//! Order of strokes that keeps pen travel short: a tour along a space-filling curve, improved by 2-opt and Or-opt moves
//! between neighbours (Bentley 1992).

mod hilbert;
mod improve;
mod neighbours;
mod tour;

use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{Dot, Polyline};
use tour::{Tour, TourStop};

/// Orders dots for a pen that starts at the page's corner.
pub(super) fn dots(dots: &mut [Dot]) {
    let tour = short_tour(dots.iter().map(|dot| [dot.at; 2]).collect(), DVec2::ZERO);
    let ordered: Vec<Dot> = tour.stops().map(|stop| dots[stop.item]).collect();
    dots.copy_from_slice(&ordered);
}

/// Orders lines for a pen that starts at `from`, and reverses those that are better drawn backwards.
pub(super) fn lines(lines: &mut Vec<Polyline>, from: DVec2) {
    let ends = |line: &Polyline| {
        let [first, last] = [line.vertices.first(), line.vertices.last()].map(|v| v.map(|v| v.at).unwrap_or_default());
        [first, if line.closed { first } else { last }]
    };
    let tour = short_tour(lines.iter().map(ends).collect(), from);
    let mut taken: Vec<Option<Polyline>> = std::mem::take(lines).into_iter().map(Some).collect();
    lines.extend(tour.stops().filter_map(|TourStop { item, turned }| {
        let mut line = taken[item].take()?;
        if turned && !line.closed {
            line.vertices.reverse();
        }
        Some(line)
    }));
}

/// Returns a short tour through strokes given by their two ends. It is never longer than the given order.
fn short_tour(ends: Vec<[DVec2; 2]>, from: DVec2) -> Tour {
    let given = Tour::new(ends, from);
    let mut tour = hilbert::along_curve(&given);
    if given.length() <= tour.length() {
        tour = given.clone();
    }
    improve::improve(&mut tour);
    // Each move gains more than rounding, but the comparison is of whole sums.
    if given.length() < tour.length() { given } else { tour }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::DVec3;
    use drypoint_scene::marks::Vertex;

    struct Draws(u64);

    impl Draws {
        fn unit(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 33) as f64 / (1_u64 << 31) as f64
        }

        fn place(&mut self, side: f64) -> DVec2 {
            DVec2::new(self.unit(), self.unit()) * side
        }
    }

    fn dot(at: DVec2) -> Dot {
        Dot { at, world: DVec3::ZERO, radius: 0.15, opacity: 1.0 }
    }

    fn way(dots: &[Dot]) -> f64 {
        dots.iter().fold((0.0, DVec2::ZERO), |(sum, pen), dot| (sum + pen.distance(dot.at), dot.at)).0
    }

    #[test]
    fn a_random_tour_is_near_the_shortest() {
        // The shortest tour of n places in a square of area A is about 0.7124 √(nA), 0.33 √A more at the border for so
        // few (Johnson and McGeoch 1996); 2-opt with Or-opt and neighbour lists is known to end about 5 % above it.
        let mut draws = Draws(1);
        let mut list: Vec<Dot> = (0..4000).map(|_| dot(draws.place(100.0))).collect();
        let mut before: Vec<_> = list.iter().map(|d| d.at.to_array().map(f64::to_bits)).collect();
        dots(&mut list);
        let shortest = 0.7124 * (4000.0_f64 * 1e4).sqrt() * (1.0 + 0.33 / 4000.0);
        let found = way(&list);
        assert!(found < 1.08 * shortest, "{}", found / shortest);
        let mut after: Vec<_> = list.iter().map(|d| d.at.to_array().map(f64::to_bits)).collect();
        before.sort();
        after.sort();
        assert_eq!(before, after);
    }

    #[test]
    fn never_worse_than_the_order_given() {
        let mut draws = Draws(2);
        // Orders that are the best already: along a line, around a ring, to and fro on a grid.
        let line: Vec<DVec2> = (0..500).map(|i| DVec2::new(f64::from(i) * 0.3, 0.0)).collect();
        let ring: Vec<DVec2> = (0..300)
            .map(|i| f64::from(i) / 300.0 * std::f64::consts::TAU)
            .map(|a| 20.0 * DVec2::from_angle(a))
            .collect();
        let grid: Vec<DVec2> = (0..400)
            .map(|i| DVec2::new(f64::from(if i / 20 % 2 == 0 { i % 20 } else { 19 - i % 20 }), f64::from(i / 20)))
            .collect();
        let noise: Vec<DVec2> = (0..700).map(|_| draws.place(9.0)).collect();
        let same = vec![DVec2::ONE; 300];
        for places in [line, ring, grid, noise, same, vec![DVec2::ONE], vec![], vec![DVec2::ONE, DVec2::ZERO]] {
            let mut list: Vec<Dot> = places.iter().copied().map(dot).collect();
            let before = way(&list);
            dots(&mut list);
            assert!(way(&list) <= before, "{} places: {} after {before}", places.len(), way(&list));
            assert_eq!(list.len(), places.len());
        }
    }

    #[test]
    fn lines_are_turned_where_that_is_shorter() {
        let vertex = |at| Vertex { at, world: DVec3::ZERO, radius: 0.1, opacity: 1.0, t: 0.0, color: None };
        // Level strokes of 10 mm, one below the other, all drawn from the left: to and fro, half of them turn.
        let order = (0..100).map(|i| i * 37 % 100);
        let stroke = |i: u32| {
            let y = f64::from(i) * 0.5;
            Polyline { vertices: vec![vertex(DVec2::new(0.0, y)), vertex(DVec2::new(10.0, y))], closed: false }
        };
        let mut list: Vec<Polyline> = order.map(stroke).collect();
        lines(&mut list, DVec2::ZERO);
        let mut pen = DVec2::ZERO;
        let mut way = 0.0;
        for line in &list {
            way += pen.distance(line.vertices[0].at);
            pen = line.vertices[1].at;
        }
        // 99 ways of 0.5 mm.
        assert!((way - 49.5).abs() < 1e-9, "{way}");
        assert_eq!(list.len(), 100);
    }

    #[test]
    fn random_lines_get_a_shorter_way_and_none_is_lost() {
        let mut draws = Draws(4);
        let vertex = |at| Vertex { at, world: DVec3::ZERO, radius: 0.1, opacity: 1.0, t: 0.0, color: None };
        let mut list: Vec<Polyline> = (0..1500)
            .map(|i| {
                let at = draws.place(100.0);
                let vertices = vec![vertex(at), vertex(at + draws.place(3.0)), vertex(at + draws.place(3.0))];
                Polyline { vertices, closed: i % 7 == 0 }
            })
            .collect();
        let given: f64 = ends_way(&list);
        let mut sums: Vec<u64> = list.iter().map(key).collect();
        lines(&mut list, DVec2::ZERO);
        let mut after: Vec<u64> = list.iter().map(key).collect();
        sums.sort();
        after.sort();
        assert_eq!(sums, after);
        // In random order about half the side between two; in a tour about 0.7 √(A/n) = 1.8 mm.
        assert!(ends_way(&list) < 1500.0 * 1.8 && given > 1500.0 * 40.0, "{} of {given}", ends_way(&list));
    }

    fn key(line: &Polyline) -> u64 {
        line.vertices.iter().fold(0, |sum: u64, v| sum.wrapping_add(v.at.x.to_bits() ^ v.at.y.to_bits()))
    }

    fn ends_way(list: &[Polyline]) -> f64 {
        let mut pen = DVec2::ZERO;
        let mut way = 0.0;
        for line in list {
            way += pen.distance(line.vertices[0].at);
            pen = line.vertices[if line.closed { 0 } else { line.vertices.len() - 1 }].at;
        }
        way
    }
}
