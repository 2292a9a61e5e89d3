//! The theme `naturalist`: pencil, pen and watercolour on cream paper, as a field book of the nineteenth century.

mod body;
mod drawn;
mod muscle;
mod things;
mod tinted;

use super::Painted;

/// The theme in a sentence.
pub(super) const SPIRIT: &str =
    "Pencil, pen and watercolour on cream paper, as in a field book of the nineteenth century.";

/// What is made of each name.
pub(super) const PAINTERS: &[Painted] = &[
    ("bone", "raw umber, thin, over pencil", |n| (body::BONE.paint(n), 1.0)),
    ("brain", "rose madder dulled with much grey", |n| (body::BRAIN.paint(n), 1.0)),
    ("cartoon", "a stencil print: N·L cut at 0.46 and −0.02", drawn::cartoon),
    ("cartoon-2", "a woodcut of two blocks: N·L cut at 0.28", drawn::cartoon_2),
    ("chalk", "black and white chalk on blue paper, which is the half-tone", drawn::chalk),
    ("constant", "ochre, RGB (203, 179, 137)", drawn::constant),
    ("copper", "burnt sienna and umber, the highest light bare paper", things::copper),
    ("engraving", "a copper plate coloured by hand: sepia parallels of two axes under green", drawn::engraving),
    ("gall", "sap green", |n| (body::GALL.paint(n), 1.0)),
    ("glass", "a wash that thickens outwards, lights in white; α_d = 0.05 + 0.8 (1 − N_z)^0.9", drawn::glass),
    ("gut", "Naples yellow and light red", |n| (body::GUT.paint(n), 1.0)),
    ("ink", "iron-gall ink from a quill: parallels of two axes over a thin wash", drawn::ink),
    ("kidney", "burnt sienna", |n| (body::KIDNEY.paint(n), 1.0)),
    ("liver", "brown madder, uneven", |n| (body::LIVER.paint(n), 1.0)),
    ("lung", "pale rose in spots", |n| (body::LUNG.paint(n), 1.0)),
    ("metal", "Payne's grey with hard borders over the height of the mirrored ray", things::metal),
    ("muscle", "madder lake in fibres", muscle::shade),
    ("nerve", "gamboge", |n| (body::NERVE.paint(n), 1.0)),
    ("pencil", "a hard pencil: parallels of two axes, nothing rubbed", drawn::pencil),
    ("porcelain", "bare paper shaded with cobalt", |n| (body::PORCELAIN.paint(n), 1.0)),
    ("skin", "a thin flesh wash, vermilion in the half-tone", |n| (body::SKIN.paint(n), 1.0)),
    ("spleen", "caput mortuum", |n| (body::SPLEEN.paint(n), 1.0)),
    ("tone", "ochre from the light and indigo from the shade run together", drawn::tone),
    ("vein", "Prussian blue", |n| (body::VEIN.paint(n), 1.0)),
    ("vessel", "carmine", |n| (body::VESSEL.paint(n), 1.0)),
    ("watercolour", "green earth and indigo in glazes that settle in the grain", drawn::watercolour),
    ("wax", "sepia, the light left bare", |n| (body::WAX.paint(n), 1.0)),
    ("xray", "a cyanotype: Prussian blue as deep as the way through a shell is long", drawn::xray),
];
