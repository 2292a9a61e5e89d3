//! Constant: f = value. All derivatives are 0.

use super::jet::Scalar;
use super::params::{About, Allowed, Param, Preset};
use super::placed::Formula;

pub(super) const CONSTANT: About = About {
    name: "constant",
    doc: "one value everywhere",
    params: &[Param { name: "value", doc: "that value", default: Preset::Number(100.0), allowed: Allowed::Any }],
    build: |args| {
        let [value] = args.values();
        Ok(args.field(Constant { value }))
    },
};

struct Constant {
    value: f64,
}

impl Formula for Constant {
    fn at<S: Scalar>(&self, _: [S; 3]) -> S {
        S::constant(self.value)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::made;
    use glam::{DMat3, DVec3};

    #[test]
    fn it_is_constant() {
        let (constant, centre) = made("constant", &[("value", -7.25)]);
        let jet = constant.jet(centre + DVec3::new(1.0, 2.0, 3.0));
        assert_eq!((jet.value, jet.gradient, jet.hessian), (-7.25, DVec3::ZERO, DMat3::ZERO));
    }
}
