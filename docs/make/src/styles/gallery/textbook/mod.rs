//! The theme `textbook`: gouache on white paper, warm light and violet shade, as plates of modern anatomy.

mod drawn;
mod gouache;
mod muscle;
mod things;
mod tissue;

use super::Painted;

/// The theme in a sentence.
pub(super) const SPIRIT: &str =
    "Gouache on white paper, as plates of modern anatomy: warm light, violet shade, wet highlights.";

/// What is made of each name.
pub(super) const PAINTERS: &[Painted] = &[
    ("bone", "dry and matt: ivory light, ochre half-tone, violet-grey shadow", |n| (tissue::BONE.paint(n), 1.0)),
    ("brain", "grey with some rose, moist", |n| (tissue::BRAIN.paint(n), 1.0)),
    ("cartoon", "N·L cut at 0.52 and 0.02 into three greens, a bent ellipse of light", drawn::cartoon),
    ("cartoon-2", "N·L cut at 0.23 into apricot and brick", drawn::cartoon_2),
    ("chalk", "red chalk: the paper's tooth where half of it is covered, the shadow rubbed in", drawn::chalk),
    ("constant", "sand, RGB (216, 185, 138)", drawn::constant),
    ("copper", "the mirrored ray's height in copper bands", things::copper),
    ("engraving", "parallels of two axes, as wide as the place is dark", drawn::engraving),
    ("gall", "green and wet", |n| (tissue::GALL.paint(n), 1.0)),
    ("glass", "α_d = 0.06 + 0.9 (1 − N_z)^0.95 and the highlight", things::glass),
    ("gut", "apricot, wet", |n| (tissue::GUT.paint(n), 1.0)),
    ("ink", "three washes of Indian ink at N·L of 0.76, 0.40 and 0.02, with wandering borders", drawn::ink),
    ("kidney", "firm red-brown under a smooth capsule", |n| (tissue::KIDNEY.paint(n), 1.0)),
    ("liver", "dark red-brown, finely grained", |n| (tissue::LIVER.paint(n), 1.0)),
    ("lung", "rose, spongy, spotted with grey", |n| (tissue::LUNG.paint(n), 1.0)),
    ("metal", "the mirrored ray R = 2N_z N − v in bands over its height: sky, horizon, floor", things::metal),
    ("muscle", "deep red with fibres across the picture", muscle::shade),
    ("nerve", "warm yellow", |n| (tissue::NERVE.paint(n), 1.0)),
    ("pencil", "graphite strokes half rubbed away with a stump", drawn::pencil),
    ("porcelain", "white glaze, blue in its shadow", |n| (tissue::PORCELAIN.paint(n), 1.0)),
    ("skin", "the shadow line is its reddest place", |n| (tissue::SKIN.paint(n), 1.0)),
    ("spleen", "plum purple, wet", |n| (tissue::SPLEEN.paint(n), 1.0)),
    ("tone", "cool to warm over ½ + ½ N·L, after Gooch et al. 1998", drawn::tone),
    ("vein", "anatomists' blue, wet", |n| (tissue::VEIN.paint(n), 1.0)),
    ("vessel", "arterial crimson, wet", |n| (tissue::VESSEL.paint(n), 1.0)),
    ("watercolour", "ultramarine in three glazes, exp(−KD), dark where they dried", drawn::watercolour),
    ("wax", "N·L wrapped by 0.36: an orange shadow line, a glowing far edge", |n| (tissue::WAX.paint(n), 1.0)),
    ("xray", "indigo; α_d rises from 0.03 in the middle to 1", drawn::xray),
];
