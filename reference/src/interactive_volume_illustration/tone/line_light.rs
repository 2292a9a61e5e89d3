//! Light on a line (Banks 1994; 4.3.1; [HATCH-12]).
//!
//! A line has no single normal: all vectors at right angles to its tangent T are normals. The normal that faces the
//! light most counts, with N·L = √(1 − (L·T)²). So two numbers determine the brightness of a line, L·T and V·T. T and
//! −T give the same result. N of the surface under the line selects between its two colours.

use drypoint_scene::color::Rgba;
use drypoint_scene::glam::DVec3;
use drypoint_scene::math::pow;

/// Diffuse and specular light on a line, each in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineLightTerms {
    /// √(1 − (L·T)²)^p.
    pub diffuse: f64,
    /// max(0, √(1 − (L·T)²)·√(1 − (V·T)²) − (L·T)(V·T))^s.
    pub specular: f64,
}

impl LineLightTerms {
    /// The terms for L·T and V·T. L and V point towards the light and the eye; all vectors have length 1. The
    /// exponent p reduces the excess brightness that comes from choosing the brightest normal.
    pub fn new(l_t: f64, v_t: f64, p: f64, s: f64) -> Self {
        let across = |x: f64| (1.0 - x * x).max(0.0).sqrt();
        let (n_l, n_v) = (across(l_t), across(v_t));
        Self { diffuse: pow(n_l, p), specular: pow((n_l * n_v - l_t * v_t).clamp(0.0, 1.0), s) }
    }
}

/// Both terms tabulated over (L·T, V·T) in [−1, 1]², with bilinear interpolation: the paper's texture.
#[derive(Clone, Debug, PartialEq)]
pub struct LineLightTable {
    side: usize,
    /// Nodes in rows of equal V·T.
    nodes: Vec<LineLightTerms>,
}

impl LineLightTable {
    /// A table with `side` nodes along each side, at least two.
    pub fn new(side: usize, p: f64, s: f64) -> Self {
        let side = side.max(2);
        let at = |i: usize| -1.0 + 2.0 * i as f64 / (side - 1) as f64;
        let nodes = (0..side * side).map(|i| LineLightTerms::new(at(i % side), at(i / side), p, s)).collect();
        Self { side, nodes }
    }

    /// Interpolates bilinearly at L·T and V·T.
    pub fn at(&self, l_t: f64, v_t: f64) -> LineLightTerms {
        let cell = |x: f64| {
            let x = (0.5 * (x + 1.0)).clamp(0.0, 1.0) * (self.side - 1) as f64;
            let i = (x as usize).min(self.side - 2);
            (i, x - i as f64)
        };
        let ((i, s), (j, t)) = (cell(l_t), cell(v_t));
        let mix = |a: LineLightTerms, b: LineLightTerms, s: f64| LineLightTerms {
            diffuse: a.diffuse + (b.diffuse - a.diffuse) * s,
            specular: a.specular + (b.specular - a.specular) * s,
        };
        let row = |j: usize| mix(self.nodes[i + j * self.side], self.nodes[i + 1 + j * self.side], s);
        mix(row(j), row(j + 1), t)
    }
}

/// Parameters of the light on lines.
#[derive(Clone, Debug, PartialEq)]
pub struct LineLight {
    /// k_d, the share of the colour that diffuse light shows.
    pub diffuse: f64,
    /// p.
    pub p: f64,
    /// k_s, the strength of the white specular light.
    pub specular: f64,
    /// s.
    pub s: f64,
    /// Colour of lines where the surface faces the eye; linear, straight.
    pub front: Rgba,
    /// Colour of lines where the surface turns away; linear, straight.
    pub back: Rgba,
    /// Whether max(0, N·L) multiplies the light, so that a surface lies in its own shadow.
    pub self_shadow: bool,
    /// A table of the same p and s that replaces the exact terms.
    pub table: Option<LineLightTable>,
}

impl LineLight {
    /// Returns the colour of a line of tangent `t` on a surface of normal `n`. L points towards the light, V towards
    /// the eye; all vectors have length 1 and are in one space.
    ///
    /// Each of the two colours is lit, c·k_d·diffuse + k_s·specular under white light, and they are mixed by ½ +
    /// ½N·V. The result is linear and straight; no channel is above 1.
    pub fn color(&self, l: DVec3, v: DVec3, t: DVec3, n: DVec3) -> Rgba {
        let (l_t, v_t) = (l.dot(t).clamp(-1.0, 1.0), v.dot(t).clamp(-1.0, 1.0));
        let terms = match &self.table {
            Some(table) => table.at(l_t, v_t),
            None => LineLightTerms::new(l_t, v_t, self.p, self.s),
        };
        let shadow = if self.self_shadow { n.dot(l).clamp(0.0, 1.0) } else { 1.0 };
        let (diffuse, specular) = (self.diffuse * terms.diffuse, self.specular * terms.specular);
        let faces = (0.5 + 0.5 * n.dot(v)).clamp(0.0, 1.0);
        let mixed = |i: usize| self.back[i] + (self.front[i] - self.back[i]) * faces;
        let lit = |i: usize| (shadow * (mixed(i) * diffuse + specular)).min(1.0);
        [lit(0), lit(1), lit(2), mixed(3)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox::uniform;

    const P: f64 = 4.8;

    fn light() -> LineLight {
        LineLight {
            diffuse: 0.7,
            p: 2.0,
            specular: 0.3,
            s: 2.0,
            front: [0.0, 0.0, 1.0, 1.0],
            back: [1.0, 1.0, 0.0, 1.0],
            self_shadow: false,
            table: None,
        }
    }

    fn vector(k: u32) -> DVec3 {
        let r = |a| 2.0 * uniform(12, [k, a, 0], 0) - 1.0;
        DVec3::new(r(0), r(1), r(2)).normalize()
    }

    #[test]
    fn hand_worked_terms() {
        // The light at right angles to the line and V along it: nothing shines.
        assert_eq!(LineLightTerms::new(0.0, 1.0, P, 20.0), LineLightTerms { diffuse: 1.0, specular: 0.0 });
        // Both at right angles: as bright as it gets, whatever p and s.
        assert_eq!(LineLightTerms::new(0.0, 0.0, P, 20.0), LineLightTerms { diffuse: 1.0, specular: 1.0 });
        // Along the line no light is caught.
        assert_eq!(LineLightTerms::new(1.0, 0.0, P, 20.0).diffuse, 0.0);
        // L·T = 0.6, V·T = 0: 0.8^p and 0.8^s; V·T = −0.6: 0.64 + 0.36 = 1; V·T = 0.6: 0.64 − 0.36 = 0.28.
        let near = |a: f64, b: f64| (a - b).abs() < 1e-15;
        let side = LineLightTerms::new(0.6, 0.0, 3.0, 2.0);
        assert!(near(side.diffuse, 0.512) && near(side.specular, 0.64), "{side:?}");
        assert!(near(LineLightTerms::new(0.6, -0.6, 3.0, 2.0).specular, 1.0));
        assert!(near(LineLightTerms::new(0.6, 0.6, 3.0, 2.0).specular, 0.0784));
        // 0.8·0.6 − 0.6·0.8 = 0. Beyond it, where the printed power would have a negative base, the term stays 0.
        assert!(LineLightTerms::new(0.6, 0.8, 3.0, 2.0).specular < 1e-30);
        assert_eq!(LineLightTerms::new(0.8, 0.8, 3.0, 2.0).specular, 0.0);
        // Rounding that leaves [−1, 1] gives no NaN.
        assert_eq!(
            LineLightTerms::new(1.0 + 1e-15, -1.0 - 1e-15, P, 1.0),
            LineLightTerms { diffuse: 0.0, specular: 1.0 }
        );
    }

    /// With a = cos α and b = cos β: √(1−a²)√(1−b²) − ab = −cos(α + β). The value is below 0 where light and eye are
    /// on the same side of the line, near it. T and −T look alike.
    #[test]
    fn a_line_has_no_direction_and_highlights_are_clamped() {
        let light = light();
        let mut dark = 0;
        for k in 0..2000 {
            let [l, v, t, n] = [0, 1, 2, 3].map(|i| vector(4 * k + i));
            assert_eq!(light.color(l, v, t, n), light.color(l, v, -t, n));
            let terms = LineLightTerms::new(l.dot(t), v.dot(t), P, 20.0);
            let sum = l.dot(t).acos() + v.dot(t).acos();
            assert!((terms.specular - (-sum.cos()).max(0.0).powi(20)).abs() < 1e-9);
            assert!((0.0..=1.0).contains(&terms.diffuse) && (0.0..=1.0).contains(&terms.specular));
            dark += u32::from(terms.specular == 0.0);
        }
        assert!(dark > 200, "{dark}");
    }

    /// A search through all normals of a line finds the one that faces the light most. Banks' closed form is its N·L,
    /// and the reflection of L about it gives V·R.
    #[test]
    fn the_brightest_normal_is_the_one_in_the_plane_of_light_and_line() {
        for k in 0..50 {
            let [l, v, t] = [0, 1, 2].map(|i| vector(4 * k + i));
            let (x, y) = t.any_orthonormal_pair();
            let normals = (0..36_000).map(|i| {
                let (sin, cos) = (f64::from(i) / 100.0).to_radians().sin_cos();
                x * cos + y * sin
            });
            let most = normals.map(|n| n.dot(l)).fold(0.0, f64::max);
            assert!((LineLightTerms::new(l.dot(t), v.dot(t), 1.0, 1.0).diffuse - most).abs() < 1e-7);
            // With V in the plane of L and T, the highlight equals V·R.
            let n = (l - t * l.dot(t)).normalize();
            let r = n * (2.0 * n.dot(l)) - l;
            assert!((LineLightTerms::new(l.dot(t), r.dot(t), 1.0, 1.0).specular - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn two_sides_and_the_surfaces_own_shadow() {
        let (z, x) = (DVec3::Z, DVec3::X);
        let mut light = light();
        light.specular = 0.0;
        // Facing the eye: front alone. Facing away: back alone. At right angles: half of each. k_d is 0.7, and L·T =
        // 0.
        assert_eq!(light.color(z, z, x, z), [0.0, 0.0, 0.7, 1.0]);
        assert_eq!(light.color(z, z, x, -z), [0.7, 0.7, 0.0, 1.0]);
        assert_eq!(light.color(z, z, x, DVec3::Y), [0.35, 0.35, 0.35, 1.0]);
        light.specular = 0.5;
        assert_eq!(light.color(z, z, x, z), [0.5, 0.5, 1.0, 1.0]);
        // N·L = ½ halves both terms, and what turns away from the light has none.
        light.self_shadow = true;
        let n = DVec3::new(0.0, 0.75f64.sqrt(), 0.5);
        light.specular = 0.0;
        let [r, g, b, _] = light.color(z, z, x, n);
        assert!((r - 0.5 * 0.7 * 0.25).abs() < 1e-15 && r == g && (b - 0.5 * 0.7 * 0.75).abs() < 1e-15);
        assert_eq!(light.color(z, z, x, -z)[..3], [0.0; 3]);
        // A higher p darkens lines that light strikes at a slant.
        let slanted = |p| LineLight { p, ..self::light() }.color(z, x, DVec3::new(0.6, 0.0, 0.8), x)[2];
        assert!(slanted(1.0) > slanted(2.0) && slanted(2.0) > slanted(P));
    }

    /// The largest error of tables at 4n² places, everywhere and where the function is smooth.
    fn errors(side: usize, within: f64) -> [f64; 2] {
        let table = LineLightTable::new(side, P, 20.0);
        let (mut diffuse, mut specular) = (0.0f64, 0.0f64);
        for i in 0..1001 {
            for j in 0..1001 {
                let at = |i: i32| within * (f64::from(i) / 500.0 - 1.0);
                let (exact, found) = (LineLightTerms::new(at(i), at(j), P, 20.0), table.at(at(i), at(j)));
                diffuse = diffuse.max((exact.diffuse - found.diffuse).abs());
                specular = specular.max((exact.specular - found.specular).abs());
            }
        }
        [diffuse, specular]
    }

    /// A table with half the step has a quarter of the error where the function is smooth. At the border √(1 − x²)
    /// has an infinite slope. The power 4.8 tames it in the diffuse term, but 20 does not in the specular one, whose
    /// largest error falls by less than half. The bounds are measurements, rounded up; the documents list them.
    #[test]
    fn the_table_converges() {
        let all = [33, 65, 129].map(|side| errors(side, 0.9));
        for pair in all.windows(2) {
            for (coarse, fine) in pair[0].iter().zip(pair[1]) {
                assert!((3.5..4.5).contains(&(coarse / fine)), "{all:?}");
            }
        }
        let [inside, whole, finer] = [errors(64, 0.9), errors(64, 1.0), errors(127, 1.0)];
        assert!(inside[0] < 7e-4 && inside[1] < 0.024 && whole[0] < 7e-4 && whole[1] < 0.24, "{inside:?} {whole:?}");
        assert!((3.5..4.5).contains(&(whole[0] / finer[0])), "{whole:?} {finer:?}");
        assert!((1.3..2.0).contains(&(whole[1] / finer[1])), "{whole:?} {finer:?}");
        // Exact at its nodes.
        assert_eq!(LineLightTable::new(5, P, 20.0).at(0.5, -1.0), LineLightTerms::new(0.5, -1.0, P, 20.0));
    }
}
