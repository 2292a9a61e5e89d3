//! Symmetric 3×3 matrices: Hessians and shape operators.

use super::{Arithmetic, Vec3};

/// A symmetric matrix by its six entries.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[allow(missing_docs)]
pub struct Sym3<R> {
    pub xx: R,
    pub xy: R,
    pub xz: R,
    pub yy: R,
    pub yz: R,
    pub zz: R,
}

impl<R: Arithmetic> Sym3<R> {
    /// M v.
    #[inline(always)]
    pub fn apply(self, v: Vec3<R>) -> Vec3<R> {
        Vec3::new(
            self.xx * v.x + self.xy * v.y + self.xz * v.z,
            self.xy * v.x + self.yy * v.y + self.yz * v.z,
            self.xz * v.x + self.yz * v.y + self.zz * v.z,
        )
    }

    /// s M.
    #[inline(always)]
    pub fn scaled(self, s: R) -> Self {
        let Self { xx, xy, xz, yy, yz, zz } = self;
        Self { xx: xx * s, xy: xy * s, xz: xz * s, yy: yy * s, yz: yz * s, zz: zz * s }
    }

    /// aᵀ M b.
    #[inline(always)]
    pub fn form(self, a: Vec3<R>, b: Vec3<R>) -> R {
        a.dot(self.apply(b))
    }
}
