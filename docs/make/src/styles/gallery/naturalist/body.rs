//! The tissues of a body in the pigments of a naturalist's paint box.

use super::tinted::Tinted;

/// What most tissues share.
const BASE: Tinted = Tinted {
    pigment: 0x808080,
    load: 1.0,
    shadow: 0x5a5a86,
    warm: (0xf3c99a, 0.25),
    bare: 0.75,
    pencil: 0.30,
    mottle: 0.10,
};

/// Raw umber, thin, over much pencil.
pub(super) const BONE: Tinted =
    Tinted { pigment: 0xd9cfb6, load: 0.30, shadow: 0x6a6880, warm: (0xf0e4c8, 0.20), bare: 0.3, pencil: 0.75, ..BASE };
/// Rose madder dulled with much grey.
pub(super) const BRAIN: Tinted =
    Tinted { pigment: 0xb09894, load: 0.80, warm: (0xe8d0c0, 0.25), shadow: 0x70657d, pencil: 0.45, ..BASE };
/// Sap green.
pub(super) const GALL: Tinted =
    Tinted { pigment: 0x6f8a35, load: 1.05, shadow: 0x3f6470, warm: (0xe3d68a, 0.45), ..BASE };
/// Naples yellow and a little light red.
pub(super) const GUT: Tinted =
    Tinted { pigment: 0xe09a55, load: 0.95, shadow: 0x7d6a80, warm: (0xf0c3a8, 0.35), ..BASE };
/// Burnt sienna.
pub(super) const KIDNEY: Tinted =
    Tinted { pigment: 0xb9623a, load: 1.05, shadow: 0x66476b, warm: (0xe9a070, 0.35), ..BASE };
/// Brown madder.
pub(super) const LIVER: Tinted =
    Tinted { pigment: 0x8a3c2d, load: 1.05, shadow: 0x54415f, warm: (0xd98f62, 0.35), mottle: 0.16, ..BASE };
/// Pale rose with lamp black in specks.
pub(super) const LUNG: Tinted =
    Tinted { pigment: 0xe8859a, load: 0.88, shadow: 0x6f6c9a, warm: (0xf4cdc0, 0.3), bare: 0.3, mottle: 0.34, ..BASE };
/// Madder lake.
pub(super) const MUSCLE: Tinted =
    Tinted { pigment: 0xa4464a, load: 0.95, shadow: 0x5c3f62, warm: (0xd9a094, 0.35), bare: 0.45, ..BASE };
/// Gamboge.
pub(super) const NERVE: Tinted =
    Tinted { pigment: 0xe6bb36, load: 1.05, shadow: 0x8a7a5e, warm: (0xf5dd7c, 0.4), ..BASE };
/// A thin flesh wash, vermilion in the half-tone.
pub(super) const SKIN: Tinted = Tinted {
    pigment: 0xe9b79a,
    load: 0.42,
    shadow: 0x6f6f8f,
    warm: (0xea9c86, 0.38),
    bare: 0.35,
    pencil: 0.45,
    ..BASE
};
/// Caput mortuum.
pub(super) const SPLEEN: Tinted =
    Tinted { pigment: 0x7d4663, load: 1.05, shadow: 0x4c4d7d, warm: (0xc98fa0, 0.35), ..BASE };
/// Prussian blue.
pub(super) const VEIN: Tinted =
    Tinted { pigment: 0x3f6fa6, load: 1.05, shadow: 0x3d3f78, warm: (0x9cc4d2, 0.35), ..BASE };
/// Carmine.
pub(super) const VESSEL: Tinted =
    Tinted { pigment: 0xcf2b22, load: 1.10, shadow: 0x6a2f48, warm: (0xf07848, 0.45), bare: 0.9, ..BASE };
/// Sepia, the light left bare.
pub(super) const WAX: Tinted = Tinted {
    pigment: 0xa98a62,
    load: 0.60,
    shadow: 0x52443c,
    warm: (0xe8d6b4, 0.20),
    bare: 0.6,
    pencil: 0.30,
    mottle: 0.05,
};
/// Bare paper shaded with cobalt.
pub(super) const PORCELAIN: Tinted = Tinted {
    pigment: 0xc3cfe0,
    load: 0.42,
    shadow: 0x5f79ab,
    warm: (0xdfe6ea, 0.2),
    bare: 1.0,
    pencil: 0.12,
    mottle: 0.0,
};
