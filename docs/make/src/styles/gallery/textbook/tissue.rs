//! The tissues of a body in the colours of medical plates: warm in the light, and in the shade the violet and blue
//! that the page throws back.

use super::gouache::Gouache;

/// Dry and matt: a long half-tone of ochre, a shadow that turns to violet grey.
pub(super) const BONE: Gouache = Gouache {
    body: [0x443845, 0x745f62, 0xb09478, 0xdec9a8, 0xf5ebd6, 0xfffaef],
    wrap: 0.42,
    bounce: (0xb7a9b6, 0.85),
    sheen: (0xfffdf6, 0.30, 14.0),
    wet: 0.0,
    mottle: 0.035,
    line: (0x2a1b18, 0x5c4632),
};

/// Fresh grey matter: grey with some rose, moist.
pub(super) const BRAIN: Gouache = Gouache {
    body: [0x4f3a45, 0x80666a, 0xaf938c, 0xcfb8ac, 0xe6d6ca, 0xf5ece2],
    wrap: 0.40,
    bounce: (0xb59cab, 0.80),
    sheen: (0xfff4ec, 0.24, 20.0),
    wet: 0.55,
    mottle: 0.03,
    line: (0x33161d, 0x6e3b3a),
};

/// The gall bladder's green, wet.
pub(super) const GALL: Gouache = Gouache {
    body: [0x1c2b1d, 0x365024, 0x5d7a31, 0x8ba34a, 0xb9c574, 0xdbe0a2],
    wrap: 0.38,
    bounce: (0x6d8c86, 0.75),
    sheen: (0xf4f6cf, 0.26, 24.0),
    wet: 0.85,
    mottle: 0.025,
    line: (0x111b10, 0x36451c),
};

/// Stomach and bowel: apricot, wet.
pub(super) const GUT: Gouache = Gouache {
    body: [0x5a2f26, 0x9e5a37, 0xd48a52, 0xedb07a, 0xf6d0a4, 0xfde7ca],
    wrap: 0.42,
    bounce: (0xb58d9b, 0.80),
    sheen: (0xfff2e4, 0.26, 22.0),
    wet: 0.70,
    mottle: 0.03,
    line: (0x36141a, 0x763a2b),
};

/// Firm and red-brown under a smooth capsule.
pub(super) const KIDNEY: Gouache = Gouache {
    body: [0x3f1a17, 0x78331f, 0xa9552f, 0xcd7f4e, 0xe4a877, 0xf4cfa6],
    wrap: 0.36,
    bounce: (0x8c6375, 0.80),
    sheen: (0xffe4cf, 0.28, 24.0),
    wet: 0.80,
    mottle: 0.02,
    line: (0x22090c, 0x551f18),
};

/// Dark red-brown, finely grained, under a capsule that shines.
pub(super) const LIVER: Gouache = Gouache {
    body: [0x260c13, 0x4a181b, 0x6f2823, 0x8f4133, 0xb0664e, 0xcf967a],
    wrap: 0.34,
    bounce: (0x77506a, 0.80),
    sheen: (0xffd9c2, 0.26, 26.0),
    wet: 0.80,
    mottle: 0.05,
    line: (0x1a070a, 0x451a14),
};

/// Rose, spongy and matt, spotted with grey.
pub(super) const LUNG: Gouache = Gouache {
    body: [0x5c3047, 0x9c5069, 0xd48091, 0xecabb2, 0xf8cfd0, 0xfde7e4],
    wrap: 0.46,
    bounce: (0xab9bc0, 0.85),
    sheen: (0xfff3f0, 0.22, 14.0),
    wet: 0.25,
    mottle: 0.075,
    line: (0x33151f, 0x733a46),
};

/// Deep red flesh in fibres.
pub(super) const MUSCLE: Gouache = Gouache {
    body: [0x350f17, 0x651b20, 0x933233, 0xb75a53, 0xd48c7f, 0xeab9a9],
    wrap: 0.38,
    bounce: (0x8d5a75, 0.75),
    sheen: (0xffe0d0, 0.26, 18.0),
    wet: 0.35,
    mottle: 0.03,
    line: (0x21070c, 0x5c1a1a),
};

/// The yellow of nerves in every plate.
pub(super) const NERVE: Gouache = Gouache {
    body: [0x5b3d13, 0x93691a, 0xc99a2b, 0xe8c34c, 0xf6de82, 0xfdf1b9],
    wrap: 0.42,
    bounce: (0xb09a78, 0.75),
    sheen: (0xfffbe0, 0.30, 20.0),
    wet: 0.55,
    mottle: 0.02,
    line: (0x33220c, 0x745217),
};

/// Living skin with blood under it: the shadow line is the most saturated place, since light that has wandered through
/// tissue comes out red.
pub(super) const SKIN: Gouache = Gouache {
    body: [0x5a2a2b, 0x9c4a3c, 0xcf7a5c, 0xe8aa89, 0xf5cfb2, 0xfde5d0],
    wrap: 0.45,
    bounce: (0xb48fa0, 0.80),
    sheen: (0xfff1e6, 0.34, 18.0),
    wet: 0.12,
    mottle: 0.02,
    line: (0x3c1413, 0x7d3a2b),
};

/// Plum purple, pulpy, under a smooth capsule.
pub(super) const SPLEEN: Gouache = Gouache {
    body: [0x271226, 0x4d2140, 0x783a58, 0x9c5d74, 0xbd8794, 0xd9b1b6],
    wrap: 0.36,
    bounce: (0x6d6a97, 0.80),
    sheen: (0xf6dfe6, 0.26, 24.0),
    wet: 0.75,
    mottle: 0.03,
    line: (0x180818, 0x441a33),
};

/// The blue that stands for veins.
pub(super) const VEIN: Gouache = Gouache {
    body: [0x14193f, 0x25336a, 0x3a5794, 0x6284b6, 0x97b1d2, 0xc6d6e8],
    wrap: 0.36,
    bounce: (0x72719e, 0.80),
    sheen: (0xeaf3fb, 0.28, 24.0),
    wet: 0.85,
    mottle: 0.02,
    line: (0x0b0e2a, 0x21305a),
};

/// Arterial crimson, wet.
pub(super) const VESSEL: Gouache = Gouache {
    body: [0x3a0812, 0x7c0f18, 0xb92018, 0xdd4128, 0xee7850, 0xf7a882],
    wrap: 0.36,
    bounce: (0xa2526b, 0.80),
    sheen: (0xffd4bf, 0.28, 24.0),
    wet: 0.90,
    mottle: 0.02,
    line: (0x24040b, 0x5f1013),
};

/// Honey-coloured anatomical wax: light enters and comes out elsewhere, so the shadow line is soft and orange and the
/// far edge glows.
pub(super) const WAX: Gouache = Gouache {
    body: [0x54240e, 0x8a461c, 0xc88746, 0xecc083, 0xf9e5bd, 0xfff4de],
    wrap: 0.36,
    bounce: (0xf0a25a, 0.55),
    sheen: (0xfff6e2, 0.34, 20.0),
    wet: 0.45,
    mottle: 0.012,
    line: (0x44200c, 0x7f4a20),
};

/// White glaze, blue in its shadow.
pub(super) const PORCELAIN: Gouache = Gouache {
    body: [0x39466b, 0x6e7fa4, 0xabb8cd, 0xd9e0e8, 0xf2f4f5, 0xfffefb],
    wrap: 0.40,
    bounce: (0xc6c0c9, 0.80),
    sheen: (0xffffff, 0.40, 26.0),
    wet: 0.95,
    mottle: 0.0,
    line: (0x1b2138, 0x4b5878),
};
