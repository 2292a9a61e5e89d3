//! The theme `studio`: lacquer, enamel, chrome and crystal before a camera.

mod body;
mod drawn;
mod glossy;
mod metal;
mod satin;

use super::Painted;

/// The theme in a sentence.
pub(super) const SPIRIT: &str =
    "Lacquer, enamel, chrome and crystal before a camera: a soft box, a strip light, black flags.";

/// What is made of each name.
pub(super) const PAINTERS: &[Painted] = &[
    ("bone", "polished ivory", |n| (body::BONE.paint(n), 1.0)),
    ("brain", "grey plasticine with some rose", |n| (body::BRAIN.paint(n), 1.0)),
    ("cartoon", "vinyl: N·L cut at 0.50 and −0.05, the soft box as a stroke", drawn::cartoon),
    ("cartoon-2", "cut paper: N·L cut at 0.15", drawn::cartoon_2),
    ("chalk", "white plaster", |n| (body::PLASTER.paint(n), 1.0)),
    ("constant", "a grey card, RGB (184, 184, 184)", drawn::constant),
    ("copper", "brushed copper: the room smeared across the scratches", metal::copper),
    ("engraving", "machined aluminium: grooves around the tool's axis, two fans of light", metal::engraving),
    ("gall", "bottle-green lacquer", |n| (body::GALL.paint(n), 1.0)),
    (
        "glass",
        "crystal: the room on its front and upside down through it; α_d = 0.05 + 0.88 (1 − N_z)^1.1",
        drawn::glass,
    ),
    ("gut", "apricot silicone", |n| (body::GUT.paint(n), 1.0)),
    ("ink", "a silver print in hard light", drawn::ink),
    ("kidney", "glazed terracotta", |n| (body::KIDNEY.paint(n), 1.0)),
    ("liver", "oxblood glaze", |n| (body::LIVER.paint(n), 1.0)),
    ("lung", "frosted rose quartz", |n| (body::LUNG.paint(n), 1.0)),
    ("metal", "chrome: the room in the mirrored ray R = 2N_z N − v", metal::metal),
    ("muscle", "burgundy satin", satin::muscle),
    ("nerve", "yellow enamel", |n| (body::NERVE.paint(n), 1.0)),
    ("pencil", "a sculptor's grey clay", |n| (body::CLAY.paint(n), 1.0)),
    ("porcelain", "hard white glaze", |n| (body::PORCELAIN.paint(n), 1.0)),
    ("skin", "silicone, in which red wanders farthest", |n| (body::SKIN.paint(n), 1.0)),
    ("spleen", "aubergine enamel", |n| (body::SPLEEN.paint(n), 1.0)),
    ("tone", "a white ball between two gels, amber and blue", drawn::tone),
    ("vein", "cobalt enamel", |n| (body::VEIN.paint(n), 1.0)),
    ("vessel", "red lacquer", |n| (body::VESSEL.paint(n), 1.0)),
    ("watercolour", "frosted gelatine, lit from behind", drawn::watercolour),
    ("wax", "jade", |n| (body::WAX.paint(n), 1.0)),
    ("xray", "film on a light box; α_d rises from 0.03 in the middle to 1", drawn::xray),
];
