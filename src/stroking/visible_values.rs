//! Values that a transfer function shows, for strokes without an iso-value ([HATCH-16]).

use crate::Failure;
use drypoint_reference::transfer::Piecewise;
use drypoint_scene::tables::Scene;
use drypoint_scene::transfer::Function;

/// The opacity of a transfer function, as strokes in what it shows read it ([HATCH-16]).
pub(super) struct VisibleValues<'a> {
    function: &'a Function,
    opacity: Piecewise<f64>,
}

impl<'a> VisibleValues<'a> {
    /// Reads the function of a scene whose strokes are where it shows something.
    pub(super) fn new(scene: &Scene, function: Option<&'a Function>) -> Result<Self, Failure> {
        let at = |key| scene.given.position(key);
        let failure = |what: &str, remedy: &str| Failure::new(what, at("hatching.iso"), remedy);
        let function = function.filter(|_| scene.transfer.is_some()).ok_or_else(|| {
            failure("there is no transfer function that shows where strokes are", "add a [transfer] table")
        })?;
        let (nodes, opacity, None) = function.nodes() else {
            let what =
                "strokes are where a function of the value shows something, and [transfer] is over two quantities";
            return Err(failure(what, "give hatching.iso a value"));
        };
        let opacity = Piecewise::new(nodes, opacity)
            .map_err(|error| Failure::new(error, at("transfer.nodes"), "give them in ascending order"))?;
        Ok(Self { function, opacity })
    }

    /// Whether the function shows something in a closed range of values: at a node inside, or at an end.
    pub(super) fn has(&self, [lo, hi]: [f64; 2]) -> bool {
        let (at, opacity, _) = self.function.nodes();
        let within = at.partition_point(|&a| a < lo)..at.partition_point(|&a| a <= hi);
        opacity[within].iter().any(|&a| a > 0.0) || [lo, hi].into_iter().any(|value| self.opacity(value) > 0.0)
    }

    /// Returns α of a value.
    pub(super) fn opacity(&self, value: f64) -> f64 {
        self.opacity.locate(value).map_or(0.0, |place| place.alpha_u)
    }
}
