//! Which quantities a sample has to be asked for.

use super::Measured;
use crate::picture::LayerKind;
use crate::plan::{Plan, Quantity, halos_in_effect};
use crate::tables::contours::measured_curvature;
use crate::tables::{Axis, Kappa, Scene};
use crate::transfer::Function;
use serde::{Deserialize, Serialize};

/// Quantities that a visible sample is asked for beyond its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SampleQuery {
    /// The gradient g and the normal.
    pub gradient: bool,
    /// The Hessian H.
    pub hessian: bool,
    /// κ₁ and κ₂, for a layer or an axis.
    pub principal: bool,
    /// κ.
    pub kappa: KappaSource,
}

/// The source of κ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum KappaSource {
    /// Nothing asks for it.
    None,
    /// Two normals along the ray ([STF-5]).
    AlongRay,
    /// The Hessian ([CUR-2]).
    Exact,
}

impl SampleQuery {
    /// The value alone.
    pub const VALUE: Self = Self { gradient: false, hessian: false, principal: false, kappa: KappaSource::None };
    /// The normal, which comes with the gradient.
    pub const NORMAL: Self = Self { gradient: true, ..Self::VALUE };

    /// The quantities beyond those of another query.
    pub fn without(self, other: Self) -> Self {
        Self {
            gradient: self.gradient && !other.gradient,
            hessian: self.hessian && !other.hessian,
            principal: self.principal && !other.principal,
            kappa: if other.kappa == KappaSource::None { self.kappa } else { KappaSource::None },
        }
    }

    /// The part that two quantities of a function need before α_u is known, and the rest ([STF-4]).
    pub fn split(self, over: &[Axis<u32>; 2]) -> (Self, Self) {
        let any = |is: fn(&Axis<u32>) -> bool| over.iter().any(is);
        let along_view = any(|axis| *axis == Axis::AlongView);
        let hessian = any(Axis::is_principal) || along_view && self.kappa == KappaSource::Exact;
        // What one Hessian gives is taken from it at once.
        let kappa = match self.kappa {
            KappaSource::Exact if hessian => KappaSource::Exact,
            KappaSource::AlongRay if along_view => KappaSource::AlongRay,
            _ => KappaSource::None,
        };
        let gradient = hessian || along_view || any(|axis| *axis == Axis::GradientMagnitude);
        let first = Self { gradient, hessian, principal: hessian && self.principal, kappa };
        (first, self.without(first))
    }

    /// The quantities of both queries. κ is the other's where both name one.
    pub fn and(self, other: Self) -> Self {
        Self {
            gradient: self.gradient || other.gradient,
            hessian: self.hessian || other.hessian,
            principal: self.principal || other.principal,
            kappa: if other.kappa == KappaSource::None { self.kappa } else { other.kappa },
        }
    }
}

/// The query of every visible sample, and what the first visible sample of a ray is asked for beyond that.
pub(super) fn of_samples(scene: &Scene, plan: &Plan, function: &Function) -> (SampleQuery, Option<SampleQuery>) {
    let kappa = |needs: &dyn Fn(Quantity) -> bool| kappa(scene, needs);
    let asks_for = |layer| scene.picture.layers.contains(&layer);
    let all = SampleQuery {
        gradient: plan.needs(Quantity::Gradient),
        hessian: plan.needs(Quantity::Hessian),
        principal: asks_for(LayerKind::Curvature) || is_principal(function),
        kappa: kappa(&|quantity| plan.needs(quantity)),
    };
    let principal = asks_for(LayerKind::FirstCurvature) && !all.principal;
    let kappa = match all.kappa {
        KappaSource::None => kappa(&|quantity| plan.needs_at_first(quantity)),
        KappaSource::AlongRay | KappaSource::Exact => KappaSource::None,
    };
    let first = SampleQuery {
        gradient: plan.needs_at_first(Quantity::Gradient) && !all.gradient,
        hessian: principal || kappa == KappaSource::Exact,
        principal,
        kappa,
    };
    (all, (first.gradient || first.hessian || first.kappa != KappaSource::None).then_some(first))
}

/// What samples are asked for beyond their own query where they shade looks that they meet; none: nothing.
pub(super) fn of_meetings(scene: &Scene, plan: &Plan, own: SampleQuery) -> Option<SampleQuery> {
    let asked = SampleQuery {
        gradient: plan.needs_at_meetings(Quantity::Gradient),
        hessian: plan.needs_at_meetings(Quantity::Hessian),
        principal: false,
        kappa: kappa(scene, &|quantity| plan.needs_at_meetings(quantity)),
    };
    let beyond = asked.without(own);
    (beyond != asked.without(asked)).then_some(beyond)
}

/// The query of samples that are asked for their seeds ([HALO-3]): without a normal a sample is no seed.
pub(super) fn of_seeds(scene: &Scene, plan: &Plan, function: &Function) -> SampleQuery {
    let by_opacity = halos_in_effect(scene).any(|(_, halo)| halo.seed.is_by_opacity());
    SampleQuery {
        gradient: true,
        hessian: plan.needs_at_seeds(Quantity::Hessian),
        principal: by_opacity && is_principal(function),
        kappa: kappa(scene, &|quantity| plan.needs_at_seeds(quantity)),
    }
}

/// The κ of samples that need those quantities.
fn kappa(scene: &Scene, needs: &dyn Fn(Quantity) -> bool) -> KappaSource {
    if needs(Quantity::PreviousNormal) {
        KappaSource::AlongRay
    } else if needs(Quantity::Hessian) && scene.contours.as_ref().is_some_and(|c| c.kappa == Kappa::Exact) {
        KappaSource::Exact
    } else {
        KappaSource::None
    }
}

/// Whether a function is over κ₁ or κ₂.
fn is_principal(function: &Function) -> bool {
    function.nodes().2.is_some_and(|rows| rows.over.iter().any(Axis::is_principal))
}

/// The query of layers of normals, of curvatures, and of κ alone on an iso-surface.
pub(super) fn of_layers(scene: &Scene, [normal, curvature, along_view]: [bool; 3]) -> SampleQuery {
    let kappa = match measured_curvature(scene) {
        _ if !(curvature || along_view) => KappaSource::None,
        Measured::Exact => KappaSource::Exact,
        Measured::AlongRay => KappaSource::AlongRay,
    };
    SampleQuery {
        gradient: normal || curvature || along_view,
        hessian: curvature || kappa == KappaSource::Exact,
        principal: curvature,
        kappa,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NONE: SampleQuery = SampleQuery::VALUE;

    #[test]
    fn quantities_ask_first_for_what_they_need() {
        let styled = SampleQuery { gradient: true, hessian: true, principal: true, kappa: KappaSource::Exact };
        let split = |query: SampleQuery, axis| query.split(&[Axis::Value, axis]);
        assert_eq!(split(styled, Axis::Label), (NONE, styled));
        let gradient = SampleQuery { gradient: true, ..NONE };
        assert_eq!(split(styled, Axis::GradientMagnitude), (gradient, SampleQuery { gradient: false, ..styled }));
        // One Hessian gives all that it can.
        assert_eq!(split(styled, Axis::Mean), (styled, NONE));
        assert_eq!(split(styled, Axis::AlongView), (styled, NONE));
        let along_ray = SampleQuery { kappa: KappaSource::AlongRay, ..styled };
        let rest = SampleQuery { kappa: KappaSource::AlongRay, ..NONE };
        assert_eq!(split(along_ray, Axis::K1), (SampleQuery { kappa: KappaSource::None, ..styled }, rest));
        let first = SampleQuery { gradient: true, kappa: KappaSource::AlongRay, ..NONE };
        let rest = SampleQuery { hessian: true, principal: true, ..NONE };
        assert_eq!(split(along_ray, Axis::AlongView), (first, rest));
    }
}
