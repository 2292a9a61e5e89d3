//! The mean of lines, that is of directions without sign ([HATCH-4]).

use drypoint_scene::glam::DVec3;

/// The least difference of the two largest eigenvalues of a mean of e eᵀ, whose sum is 1. Below it, the corners agree
/// on a plane at best.
const GAP: f64 = 0.2;

/// The share of the weight that corners with a direction must exceed.
const HALF: f64 = 0.5;

/// Number of steps of Halley's method. Each is shorter than the one before, and two are enough if the eigenvalues
/// have a gap.
const STEPS: u32 = 24;

/// Length of a step after which the next one is rounding. With a gap, the next is at most 75 times its third power.
const LAST: f64 = 1e-6;

/// A weighted sum of directions; the full weight is 1.
#[derive(Clone, Debug)]
pub(super) struct LineMean {
    weight: f64,
    /// The direction by which signs are chosen. Without it, the tensor e eᵀ is summed.
    like: Option<DVec3>,
    vector: DVec3,
    /// The tensor Σ w e eᵀ: xx, yy, zz, and yz, xz, xy.
    tensor: [DVec3; 2],
}

impl LineMean {
    pub(super) fn new(like: Option<DVec3>) -> Self {
        Self { weight: 0.0, like, vector: DVec3::ZERO, tensor: [DVec3::ZERO; 2] }
    }

    #[inline]
    pub(super) fn add(&mut self, e: DVec3, weight: f64) {
        self.weight += weight;
        match self.like {
            Some(like) => self.vector += e * if e.dot(like) < 0.0 { -weight } else { weight },
            None => {
                self.tensor[0] += e * e * weight;
                self.tensor[1] += DVec3::new(e.y * e.z, e.x * e.z, e.x * e.y) * weight;
            }
        }
    }

    /// Adds the directions of the corners whose bits are set, with their weights and in their order.
    #[inline]
    pub(super) fn add_all(&mut self, has: u8, corners: &[DVec3; 8], weights: &[f64; 8]) {
        let mut sum = self.clone();
        for (i, (&e, &weight)) in corners.iter().zip(weights).enumerate() {
            sum.add(e, if has >> i & 1 == 1 { weight } else { 0.0 });
        }
        *self = sum;
    }

    /// The sum of the added weights.
    pub(super) fn weight(&self) -> f64 {
        self.weight
    }

    /// The mean direction, of length 1. Returns none if half the weight is missing or if the directions disagree.
    pub(super) fn direction(&self) -> Option<DVec3> {
        if self.weight <= HALF {
            return None;
        }
        match self.like {
            Some(_) => self.vector.try_normalize(),
            None => {
                let [d, o] = self.tensor;
                dominant(d, o)
            }
        }
    }
}

/// The eigenvector of the largest eigenvalue of a matrix T without negative eigenvalues. `d` is the diagonal, `o`
/// holds the entries yz, xz, xy. Returns none if the next eigenvalue is nearer than the gap times the trace t.
///
/// The roots of the characteristic polynomial λ³ − tλ² + mλ − det are not negative. The two smaller ones have the sum
/// t − λ, so their squares sum to at least (t − λ)²/2. All squares sum to t² − 2m. Hence λ is at most (t + √(4t² −
/// 12m))/3. Halley's method descends from there. The adjugate of T − λI is then a multiple of v vᵀ.
#[inline]
fn dominant(d: DVec3, o: DVec3) -> Option<DVec3> {
    const THIRD: f64 = 1.0 / 3.0;
    let minors = DVec3::new(d.y * d.z - o.x * o.x, d.x * d.z - o.y * o.y, d.x * d.y - o.z * o.z);
    let (t, m) = (d.x + d.y + d.z, minors.x + minors.y + minors.z);
    let det = d.x * minors.x - o.z * (o.z * d.z - o.x * o.y) + o.y * (o.z * o.x - d.y * o.y);
    let mut largest = (t + (4.0 * t * t - 12.0 * m).max(0.0).sqrt()) * THIRD;
    for _ in 0..STEPS {
        let p = ((largest - t) * largest + m) * largest - det;
        let slope = (3.0 * largest - 2.0 * t) * largest + m;
        let step = p * slope / (slope * slope - p * (3.0 * largest - t));
        if step <= 0.0 || step.is_nan() {
            break;
        }
        largest -= step;
        if step < LAST * t {
            break;
        }
    }
    // The other two eigenvalues have the sum s and the product m − λs.
    let s = t - largest;
    let other = 0.5 * s + (0.25 * s * s - (m - largest * s)).max(0.0).sqrt();
    if largest - other < GAP * t {
        return None;
    }
    let d = d - largest;
    let x = DVec3::new(d.y * d.z - o.x * o.x, o.x * o.y - o.z * d.z, o.z * o.x - d.y * o.y);
    let y = DVec3::new(x.y, d.x * d.z - o.y * o.y, o.y * o.z - d.x * o.x);
    let z = DVec3::new(x.z, y.z, d.x * d.y - o.z * o.z);
    // Diagonal entries are squares of v's components times a positive number.
    let column = if x.x >= y.y && x.x >= z.z {
        x
    } else if y.y >= z.z {
        y
    } else {
        z
    };
    Some(column * (1.0 / column.length()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox::uniform;

    fn unit(i: u32, a: u32) -> DVec3 {
        let r = |b: u32| 2.0 * uniform(3, [i, 3 * a + b, 0], 0) - 1.0;
        DVec3::new(r(0), r(1), r(2)).normalize()
    }

    fn of(parts: &[(DVec3, f64)]) -> LineMean {
        let mut mean = LineMean::new(None);
        parts.iter().for_each(|&(e, w)| mean.add(e, w));
        mean
    }

    /// A tensor with the eigenvalues λ₁, λ₂, λ₃ of an orthonormal frame. The eigenvector is exact to rounding divided
    /// by the gap; below a gap of 0.2 there is none.
    #[test]
    fn the_dominant_eigenvector_is_that_of_the_frame() {
        let mut given = 0;
        for i in 0..20_000 {
            let (a, b) = (unit(i, 0), unit(i, 1));
            let n = a.cross(b).normalize();
            let c = n.cross(a);
            let r = |k: u32| uniform(4, [i, k, 0], 0);
            let second = if i % 3 == 0 { 1e-9 * r(0) } else { 0.5 * r(0) };
            let third = second * if i % 2 == 0 { r(1) } else { 0.0 };
            let first = 1.0 - second - third;
            if first < second {
                continue;
            }
            let found = of(&[(a, first), (c, second), (n, third)]).direction();
            if (first - second - GAP).abs() < 1e-12 {
                continue;
            }
            assert_eq!(found.is_some(), first - second > GAP, "{first} {second} {third}");
            if let Some(v) = found {
                given += 1;
                // The entries of T − λI are off by some roundings of 1, their minors by those over the gap squared.
                assert!(v.cross(a).length() <= 16.0 * f64::EPSILON / (GAP * GAP), "{:e}", v.cross(a).length());
                assert!((v.length() - 1.0).abs() <= 4.0 * f64::EPSILON);
            }
        }
        assert!(given > 12_000, "{given}");
    }

    /// Worked by hand. Two lines at ±45° from x with equal weights have the mean diag(½, ½, 0) and no direction. At
    /// ±30° the mean is diag(¾, ¼, 0), and the direction is x.
    #[test]
    fn lines_by_hand() {
        let at = |degrees: f64| DVec3::new(degrees.to_radians().cos(), degrees.to_radians().sin(), 0.0);
        assert_eq!(of(&[(at(45.0), 0.5), (at(-45.0), 0.5)]).direction(), None);
        let x = of(&[(at(30.0), 0.5), (-at(-30.0), 0.5)]).direction().unwrap();
        assert!((x.x.abs() - 1.0).abs() < 1e-15 && x.y.abs() < 1e-15);
        assert_eq!(of(&[(DVec3::Z, 1.0)]).direction().map(|v| v.z.abs()), Some(1.0));
        // Half is missing, or nearly.
        assert_eq!(of(&[(DVec3::Z, 0.5)]).direction(), None);
        assert!(of(&[(DVec3::Z, 0.51)]).direction().is_some());
        let mut flipped = LineMean::new(Some(DVec3::X));
        flipped.add(at(40.0), 0.5);
        flipped.add(-at(-40.0), 0.5);
        assert!((flipped.direction().unwrap() - DVec3::X).length() < 1e-15);
    }

    /// The signs of the added directions do not change a bit.
    #[test]
    fn signs_do_not_show() {
        for i in 0..1000 {
            let parts: Vec<_> = (0..8).map(|a| (unit(i, a) + 2.0 * unit(i, 9), 0.125)).collect();
            let turned = |(a, &(e, w)): (usize, &(DVec3, f64))| (if i >> a & 1 == 1 { -e } else { e }, w);
            let signed: Vec<_> = parts.iter().enumerate().map(turned).collect();
            assert_eq!(of(&parts).direction(), of(&signed).direction());
        }
    }
}
