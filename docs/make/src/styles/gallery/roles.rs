//! The names that every theme has, and what each is for.

/// What a name stands for in every theme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Role {
    /// The name of the style.
    pub(crate) name: &'static str,
    /// What it is for, whatever the theme.
    pub(crate) purpose: &'static str,
}

/// All names, in alphabetical order.
pub(crate) const ROLES: [Role; 28] = [
    role("bone", "bone and teeth"),
    role("brain", "grey matter"),
    role("cartoon", "flat shapes: three tones and a stroke of light"),
    role("cartoon-2", "flatter shapes: two tones"),
    role("chalk", "soft shapes, drawn broadly"),
    role("constant", "one colour everywhere, as without light"),
    role("copper", "a second metal, warm"),
    role("engraving", "shapes in fine lines"),
    role("gall", "the gall bladder, and whatever should be green"),
    role("glass", "what is to be seen through: clear in the middle, dense at the edge"),
    role("gut", "stomach and bowel"),
    role("ink", "black on white, strong contrast"),
    role("kidney", "kidneys"),
    role("liver", "the liver"),
    role("lung", "lungs"),
    role("metal", "steel, implants, machines"),
    role("muscle", "flesh in fibres"),
    role("nerve", "nerves, fat, whatever should be yellow"),
    role("pencil", "grey on white, gentle contrast"),
    role("porcelain", "white things that shine"),
    role("skin", "skin over everything else"),
    role("spleen", "the spleen, and whatever should be violet"),
    role("tone", "shape by hue: cool in the shade, warm in the light"),
    role("vein", "veins, and whatever should be blue"),
    role("vessel", "arteries, and whatever should be red"),
    role("watercolour", "transparent colour with soft borders"),
    role("wax", "solid things that light enters"),
    role("xray", "all surfaces at once, as on a radiograph"),
];

const fn role(name: &'static str, purpose: &'static str) -> Role {
    Role { name, purpose }
}
