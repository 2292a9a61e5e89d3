//! The presets of volumetric halos ([HALO-1]).

use crate::color::{Rgba, opaque};
use crate::tables::{
    Background, Exponents, Halo, HaloKind, Length, ProfileNode, Scene, SeedBy, SeedDirection, Seeding, Shading,
    Spreading, Transfer, TransferKind,
};

/// A preset that supplies `[[halo]]`, an automatic function of colours, and what belongs to them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HaloPreset {
    /// Dark rims before what lies behind.
    Dark,
    /// A bright glow before a dark background.
    Glow,
    /// Lines and gaps alone, as in Fig. 10 (d) ([HALO-11]).
    Lines,
}

impl HaloPreset {
    /// Puts the preset's tables into a scene. Widths are shares of the picture's height, so that a small picture looks
    /// like a large one.
    pub(crate) fn supply(self, scene: &mut Scene) {
        scene.transfer = Some(Transfer::automatic(TransferKind::Regular));
        match self {
            Self::Dark => {
                scene.shading = Some(Shading::default());
                scene.halos = vec![rim(), shade()];
            }
            Self::Glow => {
                scene.picture.background = Background::Color(opaque([18.0, 22.0, 30.0]));
                scene.shading = Some(Shading::default());
                scene.halos = vec![glow()];
            }
            Self::Lines => scene.halos = vec![lines(), gap()],
        }
    }
}

/// A thin dark line where one surface lies before another.
fn rim() -> Halo {
    Halo {
        name: "rim".into(),
        floor: 0.02,
        spread: fine(),
        ..halo(HaloKind::Occlusive, 1.0, opaque([0.0; 3]), [(0.05, 0.0), (0.25, 0.85)])
    }
}

/// A soft shade on what lies behind.
fn shade() -> Halo {
    Halo {
        name: "shade".into(),
        spread: wide(0.97, 8.0),
        ..halo(HaloKind::Occlusive, 2.0, opaque([0.0; 3]), [(0.01, 0.0), (0.15, 0.45)])
    }
}

/// Light around everything.
fn glow() -> Halo {
    Halo {
        name: "glow".into(),
        spread: wide(0.98, 8.0),
        ..halo(HaloKind::Emissive, 2.0, opaque([255.0, 226.0, 168.0]), [(0.02, 0.0), (0.2, 0.05)])
    }
}

/// Black contours, before the background too. Strong boundaries seed them whatever their opacity, so that glass has
/// contours, too: a full circle of directions is a factor of 1. The high power of the gradient leaves noise out.
fn lines() -> Halo {
    let mut lines = Halo {
        name: "lines".into(),
        exponents: Exponents::Numbers([2.0, 32.0]),
        floor: 0.05,
        spread: fine(),
        ..halo(HaloKind::Emissive, 2.0, opaque([0.0; 3]), [(0.06, 0.0), (0.2, 1.0)])
    };
    lines.seed.direction = Some(SeedDirection { width: 360.0, ..SeedDirection::default() });
    lines
}

/// A gap of paper between the contours of a near surface and the colours behind it.
fn gap() -> Halo {
    Halo {
        name: "gap".into(),
        floor: 0.03,
        spread: wide(0.97, 6.0),
        ..halo(HaloKind::Occlusive, 1.5, opaque([255.0; 3]), [(0.05, 0.0), (0.25, 0.8)])
    }
}

/// A halo of one colour. Its seeds lie in a band of a depth in voxels. Its opacity over the intensity goes through two
/// points.
fn halo(kind: HaloKind, voxels: f64, [r, g, b, _]: Rgba, profile: [(f64, f64); 2]) -> Halo {
    Halo {
        kind,
        accumulate: kind.accumulation(),
        seed: Seeding { by: SeedBy::Curvature, thickness: Length::Voxels(voxels), ..Seeding::default() },
        exponents: Exponents::Numbers([1.0, 32.0]),
        profile: profile.map(|(at, opacity)| ProfileNode { at, rgb: [r, g, b], opacity }).into(),
        ..Halo::default()
    }
}

/// The spreading of a thin line, in a share of the picture's height. It takes two passes: with four, their number would
/// fall in small pictures, and lines would be thinner.
fn fine() -> Spreading {
    Spreading { passes: 2, reach: Some(Length::Percent(1.0)), ..Spreading::default() }
}

/// A soft halo with a reach in per cent of the picture's height. It takes six passes: the taps of four would lie some
/// pixels apart, and show as dots around small things.
fn wide(delta: f64, reach: f64) -> Spreading {
    Spreading { delta, passes: 6, reach: Some(Length::Percent(reach)), ..Spreading::default() }
}

#[cfg(test)]
mod tests {
    use crate::file::{Overrides, parse, write_full};
    use crate::plan::{Plan, Quantity};
    use crate::tables::{HaloKind, Scene, TransferKind};
    use std::path::Path;

    fn scene(preset: &str, rest: &str) -> Scene {
        let text = format!("drypoint = 1\npreset = \"{preset}\"\n[volume]\nfile = \"a\"\n{rest}");
        parse(&text, Path::new("test.toml"), &Overrides::default()).unwrap_or_else(|faults| panic!("{faults}"))
    }

    #[test]
    fn presets_supply_halos_and_a_function_of_colours() {
        for (preset, names, shaded) in [
            ("halo", &["rim", "shade"][..], true),
            ("halo-glow", &["glow"], true),
            ("halo-lines", &["lines", "gap"], false),
        ] {
            let scene = scene(preset, "");
            assert_eq!(scene.halos.iter().map(|halo| &halo.name).collect::<Vec<_>>(), names, "{preset}");
            assert_eq!(scene.transfer.as_ref().map(|transfer| transfer.kind), Some(TransferKind::Regular));
            assert_eq!(scene.shading.is_some(), shaded);
            let plan = Plan::new(&scene);
            // A picture without light has gradients at seeds alone.
            assert_eq!(plan.needs(Quantity::Gradient), shaded, "{preset}");
            assert!(plan.needs_at_seeds(Quantity::Gradient) && plan.idle_keys.is_empty());
            let full = write_full(&scene);
            assert_eq!(parse(&full, Path::new("full"), &Overrides::default()).unwrap(), scene, "{full}");
        }
        assert_ne!(scene("halo-glow", "").picture.background, scene("halo", "").picture.background);
    }

    #[test]
    fn tables_of_the_file_take_the_places_of_the_presets() {
        let own = scene("halo", "[[halo]]\nkind = \"emissive\"\n[transfer]\n");
        assert_eq!((own.halos.len(), own.halos[0].kind), (1, HaloKind::Emissive));
        assert_eq!(own.transfer.unwrap().kind, TransferKind::Style);
        let text = "drypoint = 1\npreset = \"halo\"\n[volume]\nfile = \"a\"\n";
        let set = |setting| parse(text, Path::new("s"), &[setting].into_iter().collect()).unwrap().halos;
        assert_eq!(set(("halo.0", "off")), scene("halo", "").halos[1..]);
        assert_eq!(set(("halo", "off")), []);
        let every = set(("halo.1.every", "4"));
        assert_eq!((every[0].every, every[1].every, &every[1].name), (1, 4, &"shade".to_owned()));
        assert_eq!(set(("halo[1].profile[0].at", "0.005"))[1].profile[0].at, 0.005);
    }
}
