//! Strokes in 14 bytes a vertex, in the layout of a graphics card ([HATCH-10]). A place has three numbers of 32 bits,
//! an octahedral normal two of eight bits (Meyer et al. 2010).

use drypoint_scene::glam::{DVec2, DVec3, Vec3};
use drypoint_scene::space::Grid;
use drypoint_scene::strokes::Stroke;

/// Size of a vertex in bytes.
const BYTES: usize = 14;

/// Largest value of a signed byte.
const STEPS: f64 = 127.0;

/// Packed strokes, one vertex after the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PackedStrokes {
    vertices: Vec<[u8; BYTES]>,
    /// Index after the last vertex of each stroke.
    ends: Vec<u32>,
}

impl PackedStrokes {
    /// Packs strokes with places in the grid's index space. There the error of 32 bits is at most 2⁻²⁴ of the grid's
    /// side, wherever the grid lies in the world. A closed stroke repeats its first vertex.
    pub fn new<'s>(strokes: impl Iterator<Item = &'s Stroke>, grid: &Grid) -> Self {
        let mut packed = Self::default();
        for stroke in strokes {
            let again = stroke.vertices.first().filter(|_| stroke.closed);
            for vertex in stroke.vertices.iter().chain(again) {
                let place = grid.to_index(vertex.world).as_vec3();
                let mut bytes = [0; BYTES];
                for (to, x) in bytes.chunks_exact_mut(4).zip(place.to_array()) {
                    to.copy_from_slice(&x.to_le_bytes());
                }
                bytes[12..].copy_from_slice(&octahedral(vertex.normal).map(|b| b as u8));
                packed.vertices.push(bytes);
            }
            packed.ends.push(packed.vertices.len() as u32);
        }
        packed
    }

    /// Size of all vertices and ends in bytes.
    pub fn bytes(&self) -> u64 {
        (size_of_val(&*self.vertices) + size_of_val(&*self.ends)) as u64
    }

    /// Number of vertices of all strokes.
    pub fn vertices(&self) -> u64 {
        self.vertices.len() as u64
    }

    /// The place in index space and the normal of each vertex of a stroke.
    pub fn stroke(&self, number: usize) -> impl Iterator<Item = (Vec3, DVec3)> + '_ {
        let start = number.checked_sub(1).map_or(0, |before| self.ends[before]);
        self.vertices[start as usize..self.ends[number] as usize].iter().map(|bytes| {
            let [x, y, z] = [0, 4, 8].map(|i| f32::from_le_bytes([bytes[i], bytes[i + 1], bytes[i + 2], bytes[i + 3]]));
            (Vec3::new(x, y, z), normal([bytes[12], bytes[13]].map(|b| b as i8)))
        })
    }
}

/// Projects a unit vector onto |x| + |y| + |z| = 1 and unfolds the lower half outwards onto the square.
fn unfolded(n: DVec3) -> DVec2 {
    let p = n / (n.x.abs() + n.y.abs() + n.z.abs());
    if p.z >= 0.0 { DVec2::new(p.x, p.y) } else { folded(DVec2::new(p.x, p.y)) }
}

/// Reflects a point across the square's diagonals.
fn folded(p: DVec2) -> DVec2 {
    DVec2::new((1.0 - p.y.abs()).copysign(p.x), (1.0 - p.x.abs()).copysign(p.y))
}

/// Returns the nearest normal among the four grid corners around a direction.
fn octahedral(n: DVec3) -> [i8; 2] {
    let low = (unfolded(n) * STEPS).floor();
    let corner = |i: u32| {
        let at = low + DVec2::new(f64::from(i & 1), f64::from(i >> 1));
        [at.x, at.y].map(|x| x.clamp(-STEPS, STEPS) as i8)
    };
    let mut best = corner(0);
    for other in [1, 2, 3].map(corner) {
        if normal(other).dot(n) > normal(best).dot(n) {
            best = other;
        }
    }
    best
}

/// Decodes a normal from two bytes.
fn normal(bytes: [i8; 2]) -> DVec3 {
    let p = DVec2::new(f64::from(bytes[0]), f64::from(bytes[1])) / STEPS;
    let z = 1.0 - p.x.abs() - p.y.abs();
    let p = if z >= 0.0 { p } else { folded(p) };
    p.extend(z).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox::uniform;
    use drypoint_scene::strokes::StrokeVertex;

    /// On a face of the octahedron the bytes form equilateral triangles with sides of √2/127. The largest error is
    /// their circumradius, √(2/3)/127. Seen from the origin, at least 1/√3 away, this is √2/127 or 0.638°.
    #[test]
    fn normals_come_back_within_their_step() {
        let mut worst: f64 = 0.0;
        for i in 0..200_000u32 {
            let r = |a: u32| 2.0 * uniform(7, [i, a, 0], 0) - 1.0;
            let n = DVec3::new(r(0), r(1), r(2)).normalize();
            let back = normal(octahedral(n));
            assert!((back.length() - 1.0).abs() < 1e-15);
            worst = worst.max(n.cross(back).length().atan2(n.dot(back)));
        }
        let bound = 2f64.sqrt() / STEPS;
        assert!(worst <= bound && worst >= 0.9 * bound, "{worst} {bound}");
        for axis in DVec3::AXES {
            assert_eq!([axis, -axis].map(|n| normal(octahedral(n))), [axis, -axis]);
        }
    }

    #[test]
    fn places_come_back_within_32_bits_wherever_the_grid_lies() {
        let grid = Grid::with_spacing([256; 3], [0.3, 0.5, 2.0]).unwrap();
        let vertex = |i: u32| {
            let r = |a: u32| 255.0 * uniform(8, [i, a, 0], 0);
            let world = grid.to_world(DVec3::new(r(0), r(1), r(2)));
            StrokeVertex { world, normal: DVec3::Z, u: 0.0 }
        };
        let stroke =
            |from: u32, n: u32, closed| Stroke { vertices: (from..from + n).map(vertex).collect(), closed, key: 0 };
        let strokes = [stroke(0, 5, false), stroke(5, 3, true), stroke(8, 2, false)];
        let packed = PackedStrokes::new(strokes.iter(), &grid);
        assert_eq!((packed.vertices(), packed.bytes()), (11, 11 * 14 + 3 * 4));
        for (i, stroke) in strokes.iter().enumerate() {
            let back: Vec<_> = packed.stroke(i).collect();
            assert_eq!(back.len(), stroke.vertices.len() + usize::from(stroke.closed));
            for ((place, normal), v) in back.iter().zip(stroke.vertices.iter().cycle()) {
                let off = (place.as_dvec3() - grid.to_index(v.world)).abs().max_element();
                assert!(off <= 256.0 * f64::from(f32::EPSILON) / 4.0 && *normal == DVec3::Z, "{off:e}");
            }
        }
    }
}
