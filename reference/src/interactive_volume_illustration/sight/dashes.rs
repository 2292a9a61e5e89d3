//! Lines in dashes ([HATCH-13]).

use drypoint_scene::marks::{Polyline, Vertex};

/// Cuts lines into dashes of `on` mm with gaps of `off` mm, from the beginning of each line. Both lengths are above
/// 0.
pub fn dashed(lines: &[Polyline], [on, off]: [f64; 2]) -> Vec<Polyline> {
    lines.iter().flat_map(|line| dashes(line, on, off)).collect()
}

/// Returns an upper bound on the number of vertices that [`dashed`] gives.
pub fn dash_vertices(lines: &[Polyline], [on, off]: [f64; 2]) -> f64 {
    // A dash has two ends and the line's vertices between them.
    let of = |line: &Polyline| 2.0 * (line.length() / (on + off) + 1.0) + line.vertices.len() as f64;
    lines.iter().map(of).sum()
}

fn dashes(line: &Polyline, on: f64, off: f64) -> Vec<Polyline> {
    let again = line.vertices.first().filter(|_| line.closed).map(|first| Vertex { t: 1.0, ..*first });
    let vertices: Vec<Vertex> = line.vertices.iter().copied().chain(again).collect();
    let mut parts: Vec<Vec<Vertex>> = Vec::new();
    let mut part: Vec<Vertex> = vertices.first().copied().into_iter().collect();
    // The rest of the current dash or gap, in mm, and whether it is a dash.
    let (mut left, mut drawn) = (on, true);
    for pair in vertices.windows(2) {
        let length = pair[0].at.distance(pair[1].at);
        let mut from = 0.0;
        while length - from > left {
            from += left;
            let place = pair[0].between(&pair[1], from / length);
            if drawn {
                part.push(place);
                parts.push(std::mem::take(&mut part));
            } else {
                part.push(place);
            }
            drawn = !drawn;
            left = if drawn { on } else { off };
        }
        left -= length - from;
        if drawn {
            part.push(pair[1]);
        }
    }
    parts.push(part);
    parts.retain(|part| part.len() > 1);
    parts.into_iter().map(|vertices| Polyline { vertices, closed: false }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::{DVec2, DVec3};

    fn line(closed: bool, places: &[(f64, f64)]) -> Polyline {
        let vertex = |&(x, y): &(f64, f64)| Vertex {
            at: DVec2::new(x, y),
            world: DVec3::new(x, y, 1.0),
            radius: 0.1,
            opacity: 1.0,
            t: x / 10.0,
            color: None,
        };
        Polyline { vertices: places.iter().map(vertex).collect(), closed }
    }

    #[test]
    fn dashes_by_hand() {
        // 10 mm in dashes of 3 and gaps of 1: 0–3, 4–7, 8–10, whatever the vertices.
        for places in [vec![(0.0, 0.0), (10.0, 0.0)], (0..=20).map(|i| (0.5 * f64::from(i), 0.0)).collect()] {
            let found = dashed(&[line(false, &places)], [3.0, 1.0]);
            let ends: Vec<[f64; 2]> =
                found.iter().map(|part| [part.vertices[0].at.x, part.vertices[part.vertices.len() - 1].at.x]).collect();
            assert_eq!(ends, [[0.0, 3.0], [4.0, 7.0], [8.0, 10.0]]);
            assert!(found.iter().flat_map(|part| &part.vertices).all(|v| v.world.x == v.at.x && v.t == v.at.x / 10.0));
        }
        // A corner stays in its dash; the last side of a square is drawn, too: 12 of 16 mm.
        let square = dashed(&[line(true, &[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)])], [3.0, 1.0]);
        assert_eq!((square.len(), square.iter().map(Polyline::length).sum::<f64>()), (4, 12.0));
        let round_the_corner = dashed(&[line(false, &[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0)])], [3.0, 1.0]);
        assert_eq!(round_the_corner[0].vertices.len(), 3);
        assert_eq!(round_the_corner[0].length(), 3.0);
        assert!(dashed(&[line(false, &[])], [3.0, 1.0]).is_empty());
    }
}
