use super::triangle::ShearedLine;
use super::{MeshHit, MeshSearch};
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::mesh::TriangleMesh;
use drypoint_scene::philox;
use drypoint_scene::space::Grid;
use std::collections::BTreeMap;

/// Index space is world space.
fn grid() -> Grid {
    Grid::with_spacing([8, 8, 8], [1.0; 3]).unwrap()
}

/// The unit sphere as an icosahedron whose triangles are cut in four `level` times, its vertices on the sphere.
fn icosphere(level: usize) -> TriangleMesh {
    let g = (1.0 + 5f64.sqrt()) / 2.0;
    let mut positions: Vec<DVec3> = Vec::new();
    for (a, b) in [(1.0, g), (-1.0, g), (1.0, -g), (-1.0, -g)] {
        positions.extend([DVec3::new(0.0, a, b), DVec3::new(a, b, 0.0), DVec3::new(b, 0.0, a)]);
    }
    positions.iter_mut().for_each(|p| *p = p.normalize());
    // Triangles of the icosahedron: triples of vertices that are an edge apart.
    let edge = 2.0 / (g * g + 1.0).sqrt();
    let near = |a: usize, b: usize| (positions[a].distance(positions[b]) - edge).abs() < 1e-9;
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            triangles.extend(
                (b + 1..12).filter(|&c| near(a, b) && near(b, c) && near(c, a)).map(|c| [a, b, c].map(|i| i as u32)),
            );
        }
    }
    assert_eq!(triangles.len(), 20);
    for _ in 0..level {
        let mut middles = BTreeMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                positions.push((positions[a as usize] + positions[b as usize]).normalize());
                positions.len() as u32 - 1
            })
        };
        let cut = |[a, b, c]: [u32; 3]| {
            let [d, e, f] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, d, f], [d, b, e], [f, e, c], [d, e, f]]
        };
        triangles = triangles.into_iter().flat_map(cut).collect();
    }
    let normals = positions.clone();
    TriangleMesh::new(positions, Some(normals), triangles).unwrap()
}

/// Uniform numbers from −1 to 1.
fn number(i: u32, draw: u32) -> f64 {
    2.0 * philox::uniforms(11, [i, draw, 0], 0)[0] - 1.0
}

fn vector(i: u32, draw: u32) -> DVec3 {
    DVec3::new(number(i, draw), number(i, draw + 1), number(i, draw + 2))
}

const ALL: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// The line from an eye to a point within half a radius of the centre meets the sphere at the smaller root of |o + t·d| = 1.
#[test]
fn hits_of_an_icosphere_converge_to_the_sphere_with_order_2() {
    let lines: Vec<[DVec3; 2]> = (0..500)
        .map(|i| {
            let eye = vector(i, 0).normalize() * 3.0;
            [eye, 0.5 * vector(i, 4) - eye]
        })
        .collect();
    let root = |[o, d]: [DVec3; 2]| {
        let (a, b, c) = (d.length_squared(), o.dot(d), o.length_squared() - 1.0);
        c / (-b + (b * b - a * c).sqrt())
    };
    let mut errors = Vec::new();
    for level in 2..=6 {
        let sphere = icosphere(level);
        let (meshes, grid) = ([sphere], grid());
        let search = MeshSearch::new(&meshes, &grid).unwrap();
        let (mut depth, mut normal) = (0f64, 0f64);
        for &line in &lines {
            let hit = search.nearest(line, ALL).unwrap();
            depth = depth.max((hit.t - root(line)).abs() * line[1].length());
            let n = search.normal(&hit, -line[1]).unwrap();
            normal = normal.max(n.distance((line[0] + line[1] * root(line)).normalize()));
        }
        errors.push([depth, normal]);
    }
    println!("largest errors of depth and normal, level 2 to 6: {errors:?}");
    for pair in errors.windows(2) {
        let order = [0, 1].map(|i| (pair[0][i] / pair[1][i]).log2());
        assert!(order.iter().all(|order| (1.8..2.3).contains(order)), "{order:?}: {errors:?}");
    }
    assert!(errors[4][0] < 5e-4, "{errors:?}");
}

/// A plane n·p = h, cut in triangles: every line meets it at t = (h − n·o)/(n·d), in a sheared grid as well.
#[test]
fn a_plane_is_met_at_its_closed_form() {
    let sheared = DMat3::from_cols(DVec3::new(0.5, 0.0, 0.0), DVec3::new(0.2, 1.5, 0.0), DVec3::new(-0.3, 0.4, 3.0));
    for grid in [grid(), Grid::new([8, 8, 8], sheared, DVec3::new(100.0, -50.0, 7.0)).unwrap()] {
        let (n, h) = (DVec3::new(0.3, -0.5, 0.8).normalize(), 2.5);
        let (u, w) = n.any_orthonormal_pair();
        let at = |i: u32, j: u32| n * h + u * (f64::from(i) * 8.0 - 20.0) + w * (f64::from(j) * 8.0 - 20.0);
        let positions = (0..36).map(|i| at(i % 6, i / 6)).collect();
        let cell = |i: u32| [[i, i + 1, i + 6], [i + 7, i + 6, i + 1]];
        let triangles = (0..35).filter(|i| i % 6 < 5 && i / 6 < 5).flat_map(cell).collect();
        let meshes = [TriangleMesh::new(positions, None, triangles).unwrap()];
        let search = MeshSearch::new(&meshes, &grid).unwrap();
        let mut worst = 0f64;
        for i in 0..2000 {
            let to = n * h + u * 19.0 * number(i, 0) + w * 19.0 * number(i, 1);
            let origin = to + vector(i, 2) * 30.0;
            let along = (to - origin) / 7.0;
            let line = [grid.to_index(origin), grid.inverse_axes() * along];
            if n.dot(along).abs() < 0.1 {
                continue;
            }
            let hit = search.nearest(line, ALL).unwrap();
            worst = worst.max((hit.t - (h - n.dot(origin)) / n.dot(along)).abs());
            let normal = search.normal(&hit, -along).unwrap();
            assert!((normal - n * -n.dot(along).signum()).length() < 1e-14);
        }
        println!("largest error of the depth of a plane: {worst:.1e}");
        assert!(worst < 1e-12, "{worst:e}");
    }
}

/// Lines through vertices and edges of a closed mesh, as exactly as they can be aimed.
#[test]
fn no_line_passes_between_triangles() {
    let meshes = [icosphere(3)];
    let (search, mesh) = (MeshSearch::new(&meshes, &grid()).unwrap(), &meshes[0]);
    let mut lines = 0;
    for (i, triangle) in mesh.triangles().iter().enumerate() {
        let [a, b, c] = triangle.map(|i| mesh.positions()[i as usize]);
        for aim in [a, a + (b - a) * 0.5, b + (c - b) * philox::uniforms(3, [i as u32, 0, 0], 0)[0], (a + b + c) / 3.0]
        {
            for origin in [aim * 7.0, aim * 2.0 + vector(i as u32, 0) * 0.3, DVec3::ZERO, aim * 0.25] {
                let hit = search.nearest([origin, aim - origin], [0.0, f64::INFINITY]).expect("a hole");
                assert!((hit.t - 1.0).abs() < 1e-12, "{hit:?}");
                lines += 1;
            }
        }
    }
    assert_eq!(lines, 16 * 1280);
}

/// Triangles that the tree leaves out are met by no line.
#[test]
fn the_tree_finds_what_testing_every_triangle_finds() {
    // Triangles of all sizes, some beside each other and some twice, far from the origin and near it.
    let mut positions: Vec<DVec3> = Vec::new();
    for i in 0..300 {
        let (at, size) = (vector(i, 0) * 50.0, 10f64.powf(2.0 * number(i, 3)));
        positions.extend([0, 3, 6].map(|draw| at + vector(i, 10 + draw) * size));
    }
    let twice = positions[..90].to_vec();
    positions.extend(twice);
    let triangles = (0..positions.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let meshes = [TriangleMesh::new(positions, None, triangles).unwrap(), icosphere(1)];
    let grid = Grid::with_spacing([8, 8, 8], [0.37, 2.0, 1.3]).unwrap();
    let search = MeshSearch::new(&meshes, &grid).unwrap();
    let mut hits = 0;
    for i in 0..4000 {
        let axis = [DVec3::X, DVec3::NEG_Y, DVec3::Z][i as usize % 3];
        let along = if i % 2 == 0 { vector(i, 20) } else { axis };
        let line = [vector(i, 30) * 60.0, along];
        let range = if i % 5 == 0 { [-10.0, 40.0] } else { [0.0, f64::INFINITY] };
        let sheared = ShearedLine::new(line).unwrap();
        let all = search.corners.iter().enumerate().filter_map(|(i, &corners)| Some((sheared.crosses(corners)?.t, i)));
        let first = all.filter(|(t, _)| (range[0]..=range[1]).contains(t)).min_by(|a, b| a.partial_cmp(b).unwrap());
        let found = search.nearest(line, range).map(|hit| (hit.t, search.place(&hit)));
        assert_eq!(found, first, "{i}");
        hits += u32::from(found.is_some());
    }
    assert!((200..3800).contains(&hits), "{hits}");
}

/// 20 000 triangles with the same box are leaves of a balanced tree: ⌈log₂ 20 000⌉ = 15 levels below its root.
#[test]
fn triangles_with_equal_boxes_are_a_balanced_tree() {
    let cube = |i: usize| DVec3::from_array([0, 1, 2].map(|axis| f64::from(u8::from(i >> axis & 1 == 1))));
    // Opposite corners and a point inside: each has the box of the cube.
    let inside = (0..20_000).map(|i| (vector(i, 0) + DVec3::ONE) * 0.5);
    let positions: Vec<DVec3> = (0..8).map(cube).chain(inside).collect();
    let triangles = (0..20_000).map(|i| [i % 4, 7 - i % 4, 8 + i]).collect();
    let meshes = [TriangleMesh::new(positions, None, triangles).unwrap()];
    let search = MeshSearch::new(&meshes, &grid()).unwrap();
    let boxes = search.boxes();
    let (mut level, mut depth) = (vec![0], 0);
    while !level.is_empty() {
        let inner = level.into_iter().filter(|&i: &u32| !boxes[i as usize].is_leaf);
        level = inner.flat_map(|i| [0, 1].map(|child| boxes[i as usize].first + child)).collect();
        depth += usize::from(!level.is_empty());
    }
    assert_eq!(depth, 15);
    for i in 0..50 {
        let line = [vector(i, 20) * 4.0, (vector(i, 30) + DVec3::ONE) * 0.5 - vector(i, 20) * 4.0];
        let sheared = ShearedLine::new(line).unwrap();
        let all = search.corners.iter().enumerate();
        let all = all.filter_map(|(i, &corners)| Some((sheared.crosses(corners)?.t, i)));
        let first = all.min_by(|a, b| a.partial_cmp(b).unwrap());
        assert_eq!(search.nearest(line, ALL).map(|hit| (hit.t, search.place(&hit))), first, "{i}");
        assert!(first.is_some());
    }
}

#[test]
fn degenerate_triangles_and_lines_are_met_nowhere() {
    let flat = |positions: [DVec3; 3]| TriangleMesh::new(positions.to_vec(), None, vec![[0, 1, 2]]).unwrap();
    let grid = grid();
    let nearest =
        |mesh: &TriangleMesh, line| MeshSearch::new(std::slice::from_ref(mesh), &grid).unwrap().nearest(line, ALL);
    let line = [DVec3::new(0.25, 0.25, 5.0), DVec3::NEG_Z];
    assert_eq!(nearest(&flat([DVec3::ZERO, DVec3::X, DVec3::X * 2.0]), line), None);
    assert_eq!(nearest(&flat([DVec3::ONE; 3]), line), None);
    // A line in the plane of the triangle, and one without direction.
    let triangle = flat([DVec3::ZERO, DVec3::X, DVec3::Y]);
    assert_eq!(nearest(&triangle, [DVec3::new(-1.0, 0.25, 0.0), DVec3::X]), None);
    assert_eq!(nearest(&triangle, [DVec3::ZERO, DVec3::ZERO]), None);
    let hit: Option<MeshHit> = nearest(&triangle, line);
    assert_eq!(hit.unwrap().t, 5.0);
    // Beyond the range of f32, in which the tree is built.
    let huge = flat([DVec3::new(-1e60, -1e60, 1e50), DVec3::new(1e60, -1e60, 1e50), DVec3::new(0.0, 1e60, 1e50)]);
    assert_eq!(nearest(&huge, [DVec3::ZERO, DVec3::Z]).unwrap().t, 1e50);
    assert!(MeshSearch::new(&[], &grid).is_none());
}

/// A smooth normal belongs to the side that is seen, although it may point away from the eye.
#[test]
fn normals_are_on_the_side_of_the_eye() {
    let tilted = DVec3::new(3.0, 0.0, 1.0);
    let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
    let meshes = [TriangleMesh::new(corners, Some(vec![tilted; 3]), vec![[0, 1, 2]]).unwrap()];
    let (grid, at) = (grid(), DVec3::new(0.25, 0.25, 0.0));
    let search = MeshSearch::new(&meshes, &grid).unwrap();
    for (v, sign) in [(DVec3::Z, 1.0), (DVec3::NEG_Z, -1.0), (DVec3::new(-1.0, 0.0, 1.0), 1.0)] {
        let hit = search.nearest([at + v, -v], ALL).unwrap();
        let normal = search.normal(&hit, v).unwrap();
        assert!(normal.distance(tilted.normalize() * sign) < 1e-15, "{v}");
    }
}
