//! Styles and opacities of the surfaces in a first picture.

use super::boundary::{FirstSurfaces, ValueSurface};
use drypoint_scene::color::srgb_to_linear;
use drypoint_scene::math;
use drypoint_scene::tables::{Node, NodeColor, Outside, TransferKind};
use drypoint_scene::volume::Volume;

/// A style, and its colour for a transfer function without styles.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SurfaceStyle {
    style: &'static str,
    srgb: [f64; 3],
}

const SKIN: SurfaceStyle = SurfaceStyle { style: "skin", srgb: [0.91, 0.68, 0.55] };
const BONE: SurfaceStyle = SurfaceStyle { style: "bone", srgb: [0.93, 0.89, 0.80] };
const GLASS: SurfaceStyle = SurfaceStyle { style: "glass", srgb: [0.22, 0.62, 0.70] };
const WAX: SurfaceStyle = SurfaceStyle { style: "wax", srgb: [0.91, 0.75, 0.52] };
const VESSEL: SurfaceStyle = SurfaceStyle { style: "vessel", srgb: [0.76, 0.20, 0.17] };
const TONE: SurfaceStyle = SurfaceStyle { style: "tone", srgb: [0.75, 0.68, 0.62] };

/// The styles of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Palette {
    hull: SurfaceStyle,
    main: SurfaceStyle,
}

impl Palette {
    /// Selects the styles: skin and bone for patients, red for thin branches such as vessels, wax under glass for
    /// anything else.
    pub(super) fn of(volume: &Volume, boundary: &FirstSurfaces) -> Self {
        match (volume.anatomy().is_some(), boundary.hull.is_some()) {
            (true, true) => Self { hull: SKIN, main: BONE },
            (false, true) => Self { hull: GLASS, main: WAX },
            (_, false) if boundary.thin => Self { hull: GLASS, main: VESSEL },
            (true, false) => Self { hull: SKIN, main: SKIN },
            (false, false) => Self { hull: GLASS, main: WAX },
        }
    }
}

/// The largest opacity of a hull in one voxel.
const HULL: f64 = 0.22;

/// The opacity of the opaque surface in one voxel.
const SOLID: f64 = 0.95;

/// Nodes of the transfer function. A hull is a thin layer, transparent on both sides. The main surface is opaque from
/// its value inwards.
pub(super) fn nodes(boundary: &FirstSurfaces, palette: Palette, kind: TransferKind, outside: Outside) -> Vec<Node> {
    let inwards = if outside == Outside::Low { 1.0 } else { -1.0 };
    let node = |surface: &ValueSurface, steps: f64, look: SurfaceStyle, opacity: f64| {
        let color = match kind {
            TransferKind::Style => NodeColor::Style(look.style.into()),
            TransferKind::Regular => NodeColor::Color(look.srgb.map(srgb_to_linear)),
        };
        Node { at: short(surface.value + inwards * steps * surface.step, surface.step), color, opacity }
    };
    let main = &boundary.main;
    let mut nodes = Vec::new();
    if let Some(hull) = &boundary.hull {
        // The layer ends where the main surface begins.
        let gap = (main.value - hull.value).abs() - RAMP[0] * main.step;
        let half = (LAYER * hull.step).min(gap.max(0.0)) / hull.step;
        nodes.push(node(hull, -half, palette.hull, 0.0));
        nodes.push(node(hull, 0.0, palette.hull, HULL));
        nodes.push(node(hull, half, palette.hull, 0.0));
    }
    nodes.push(node(main, -RAMP[0], palette.main, 0.0));
    nodes.push(node(main, RAMP[1], palette.main, SOLID));
    if outside == Outside::High {
        nodes.reverse();
    }
    nodes
}

/// The value at which a surface becomes visible: the start of the opaque surface, or the middle of a hull's layer.
pub(super) fn first_seen(boundary: &FirstSurfaces, outside: Outside) -> f64 {
    let (surface, steps) = match &boundary.hull {
        Some(hull) => (hull, 0.5 * LAYER),
        None => (&boundary.main, RAMP[0]),
    };
    let outwards = if outside == Outside::Low { -1.0 } else { 1.0 };
    surface.value + outwards * steps * surface.step
}

/// Rounds a value to about a hundredth of a step, to a power of ten, as a person would write it.
pub(super) fn short(value: f64, step: f64) -> f64 {
    let digits = (2.0 - math::log2(step) / math::log2(10.0)).ceil();
    // The decimal text removes rounding digits. Integers beyond 15 digits cannot be shortened.
    if !(0.0..=15.0).contains(&digits) {
        return if digits < 0.0 { value.round() } else { value };
    }
    format!("{value:.*}", digits as usize).parse().unwrap_or(value)
}

/// Half the thickness of a hull's layer, in voxels.
const LAYER: f64 = 0.45;

/// Extent of an opaque surface's ramp outwards and inwards, in voxels. It is small outwards, where a hull's own
/// matter may come close.
const RAMP: [f64; 2] = [0.1, 0.25];

/// The surface of all labels, on values from 0 to 1.
pub(super) fn label_nodes() -> Vec<Node> {
    let node = |at, opacity| Node { at, color: NodeColor::Style(TONE.style.into()), opacity };
    vec![node(0.4, 0.0), node(0.6, SOLID)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_ascend_from_transparent_to_opaque() {
        let hull = Some(ValueSurface { value: 40.0, step: 20.0 });
        for main in [ValueSurface { value: 100.0, step: 40.0 }, ValueSurface { value: 45.0, step: 40.0 }] {
            let low = FirstSurfaces { main, hull, thin: false, steep: false };
            let palette = Palette { hull: GLASS, main: WAX };
            let nodes = nodes(&low, palette, TransferKind::Style, Outside::Low);
            assert!(nodes.windows(2).all(|pair| pair[0].at <= pair[1].at), "{nodes:?}");
            assert_eq!([nodes[0].opacity, nodes[2].opacity, nodes[3].opacity], [0.0; 3]);
        }
    }

    #[test]
    fn values_are_short() {
        // A hundredth of the step is 0.2386, so one digit; 0.00055, so four; 5, none.
        assert_eq!(short(48.853_446, 23.86), 48.9);
        assert_eq!(short(0.123_456_7, 0.055), 0.1235);
        assert_eq!(short(-349.7, 500.0), -350.0);
        assert_eq!(short(1e20, 1e18), 1e20);
        assert_eq!(short(1.5e-20, 1e-20), 1.5e-20);
    }

    #[test]
    fn mirrored_values_have_mirrored_nodes() {
        let main =
            |value| FirstSurfaces { main: ValueSurface { value, step: 4.0 }, hull: None, thin: true, steep: false };
        let palette = Palette { hull: GLASS, main: WAX };
        let low = nodes(&main(10.0), palette, TransferKind::Regular, Outside::Low);
        let mut high = nodes(&main(-10.0), palette, TransferKind::Regular, Outside::High);
        high.reverse();
        let pairs = low.iter().zip(&high);
        assert!(pairs.clone().count() == 2 && pairs.into_iter().all(|(a, b)| a.at == -b.at && a.opacity == b.opacity));
    }
}
