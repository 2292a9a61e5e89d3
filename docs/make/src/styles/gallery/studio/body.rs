//! The tissues of a body as a model maker casts them: lacquer, silicone, wax and clay before the camera.

use super::glossy::Glossy;

/// What most have: some scatter, a clear coat.
const CAST: Glossy =
    Glossy { body: 0x808080, scatter: [0.30, 0.18, 0.14], coat: 0.055, blur: 0.05, mottle: 0.0, dark: 0x101010 };

/// Polished ivory.
pub(super) const BONE: Glossy =
    Glossy { body: 0xf3e6cb, scatter: [0.42, 0.34, 0.24], coat: 0.035, blur: 0.30, mottle: 0.03, dark: 0x2a1d12 };
/// Grey plasticine with some rose.
pub(super) const BRAIN: Glossy =
    Glossy { body: 0xcdb8ad, scatter: [0.34, 0.24, 0.20], coat: 0.03, blur: 0.45, dark: 0x2a1218, ..CAST };
/// Bottle-green lacquer.
pub(super) const GALL: Glossy = Glossy { body: 0x5f9a3c, scatter: [0.10, 0.30, 0.08], dark: 0x07160a, ..CAST };
/// Apricot silicone.
pub(super) const GUT: Glossy =
    Glossy { body: 0xf0b27c, scatter: [0.45, 0.25, 0.15], coat: 0.04, blur: 0.16, dark: 0x35140a, ..CAST };
/// Terracotta with a glaze.
pub(super) const KIDNEY: Glossy = Glossy { body: 0xd0693c, scatter: [0.30, 0.10, 0.06], dark: 0x260c06, ..CAST };
/// Oxblood glaze.
pub(super) const LIVER: Glossy = Glossy { body: 0x7c1f1c, scatter: [0.26, 0.06, 0.05], dark: 0x1a0507, ..CAST };
/// Frosted rose quartz.
pub(super) const LUNG: Glossy =
    Glossy { body: 0xf3a0b4, scatter: [0.60, 0.40, 0.42], coat: 0.03, blur: 0.5, mottle: 0.06, dark: 0x331521 };
/// Nerves in yellow enamel.
pub(super) const NERVE: Glossy =
    Glossy { body: 0xf7c531, scatter: [0.34, 0.26, 0.06], blur: 0.04, dark: 0x2e1d03, ..CAST };
/// Silicone as for the screen: red travels farthest.
pub(super) const SKIN: Glossy =
    Glossy { body: 0xf2bd9c, scatter: [0.62, 0.26, 0.16], coat: 0.03, blur: 0.34, mottle: 0.015, dark: 0x34120c };
/// Aubergine enamel.
pub(super) const SPLEEN: Glossy = Glossy { body: 0x86417a, scatter: [0.22, 0.08, 0.20], dark: 0x140619, ..CAST };
/// Cobalt enamel.
pub(super) const VEIN: Glossy =
    Glossy { body: 0x2f66c4, scatter: [0.05, 0.10, 0.28], blur: 0.04, dark: 0x050b24, ..CAST };
/// Red lacquer.
pub(super) const VESSEL: Glossy =
    Glossy { body: 0xdb2218, scatter: [0.28, 0.04, 0.03], coat: 0.06, blur: 0.035, dark: 0x1f0305, ..CAST };
/// Hard white porcelain.
pub(super) const PORCELAIN: Glossy =
    Glossy { body: 0xeef1f4, scatter: [0.20, 0.22, 0.25], coat: 0.06, blur: 0.02, mottle: 0.0, dark: 0x141a24 };
/// Jade: light enters it, and green comes out.
pub(super) const WAX: Glossy =
    Glossy { body: 0x86c79a, scatter: [0.40, 0.62, 0.46], coat: 0.045, blur: 0.06, mottle: 0.12, dark: 0x0b2218 };
/// White plaster.
pub(super) const PLASTER: Glossy =
    Glossy { body: 0xe9e4dc, scatter: [0.06, 0.06, 0.06], coat: 0.0, blur: 0.5, mottle: 0.05, dark: 0x1d1a18 };
/// A sculptor's grey clay.
pub(super) const CLAY: Glossy =
    Glossy { body: 0xa9a6a3, scatter: [0.14, 0.14, 0.14], coat: 0.035, blur: 0.6, mottle: 0.04, dark: 0x161617 };
