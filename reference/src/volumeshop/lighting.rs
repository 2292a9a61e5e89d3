//! Lighting transfer functions (5, eq. 8; [VS-5]): colours and opacities from a table over (N·L, N·Ĥ).

use crate::bilinear::{cell, mix};
use crate::number::{Arithmetic, Real, Vec3};
use crate::shading::half_vector;
use drypoint_scene::shot::LightingParams;

/// A lighting table under a light; vectors are in world space.
#[derive(Clone, Debug, PartialEq)]
pub struct LightingFunction<R> {
    width: usize,
    height: usize,
    /// Cells, row by row from the top.
    cells: Vec<[R; 4]>,
    /// L: the unit vector towards the light.
    light: Vec3<R>,
    /// s_min.
    divisor_floor: R,
}

/// The reflectance of one normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflectance<R> {
    /// s_a.
    pub ambient: R,
    /// s_d.
    pub diffuse: R,
    /// s_s.
    pub specular: R,
    /// s_α.
    pub opacity: R,
}

impl<R: Real> LightingFunction<R> {
    /// Prepares the table of a shot.
    pub fn new(params: &LightingParams) -> Self {
        let table = params.source.table();
        Self {
            width: table.width(),
            height: table.height(),
            cells: table.cells().iter().map(|cell| cell.map(R::from_f64)).collect(),
            light: Vec3::from_glam(params.light),
            divisor_floor: R::from_f64(params.divisor_floor),
        }
    }

    /// Ĥ for a direction to the eye, 0 where L = −v.
    #[inline(always)]
    pub fn half_vector(&self, v: Vec3<R>) -> Vec3<R> {
        half_vector(self.light, v)
    }

    /// The reflectance of a normal: the table at (N·L, N·Ĥ).
    #[inline]
    pub fn reflectance(&self, n: Vec3<R>, half: Vec3<R>) -> Reflectance<R> {
        self.at(n.dot(self.light), n.dot(half))
    }

    /// The table at (x, y), both clamped to [−1, 1]: bilinear, x then y.
    #[inline]
    pub(super) fn at(&self, x: R, y: R) -> Reflectance<R> {
        let half_steps = |n: usize| R::from_f64((n - 1) as f64) * R::HALF;
        let (i, wx) = cell((x + R::ONE) * half_steps(self.width), self.width);
        let (j, wy) = cell((R::ONE - y) * half_steps(self.height), self.height);
        // A single column or row has no neighbour, and the neighbour's weight is 0.
        let (right, down) = (usize::from(self.width > 1), usize::from(self.height > 1));
        let row = |j: usize| {
            let at = j * self.width + i;
            mix(self.cells[at], self.cells[at + right], wx)
        };
        let [ambient, diffuse, specular, opacity] = mix(row(j), row(j + down), wy);
        Reflectance { ambient, diffuse, specular, opacity }
    }

    /// α = clamp₀₁(α_u / max(s_min, min(1, s_α + (1 − |N|)))), with |N| = |g| of [VAL-2] (eq. 8).
    #[inline]
    pub fn opacity(&self, alpha_u: R, reflectance: &Reflectance<R>, magnitude: R) -> R {
        (alpha_u / divisor(reflectance.opacity, magnitude).max(self.divisor_floor)).clamp_01()
    }
}

impl<R: Real> Reflectance<R> {
    /// c = (s_a + s_d)·c_u + s_s, without a clamp (eq. 8).
    #[inline]
    pub fn color(&self, c_u: [R; 3]) -> [R; 3] {
        let share = self.ambient + self.diffuse;
        c_u.map(|c| share * c + self.specular)
    }
}

/// min(1, s_α + (1 − |N|)), by which eq. 8 divides opacities.
#[inline(always)]
fn divisor<A: Arithmetic>(s_alpha: A, magnitude: A) -> A {
    let one = magnitude.one();
    (s_alpha + (one - magnitude)).min(one)
}

#[cfg(test)]
mod tests;
