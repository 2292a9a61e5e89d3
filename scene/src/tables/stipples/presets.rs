//! The presets of stippling ([STIP-14]).

use super::{
    Boundary, Curves, CurvesTest, Distance, DotDensity, Even, Interior, Lighting, PointsPerPixel, Resolution,
    Silhouette, Snap, Stipples,
};
use crate::tables::{Iso, Length, LightDirection, Outlines};
use glam::DVec3;

/// A preset that supplies `[stipples]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StipplePreset {
    /// A first picture.
    Plain,
    /// Fig. 1 (b), the engine.
    Fig1,
    /// Fig. 4, the leg.
    Fig4,
    /// Fig. 5, the engine.
    Fig5,
    /// Fig. 6, the bonsai.
    Fig6,
    /// Fig. 7, the aneurysm.
    Fig7,
    /// Fig. 8, the foot.
    Fig8,
    /// Fig. 9, the head.
    Fig9,
}

impl StipplePreset {
    /// The outlines around it.
    pub(crate) fn outlines(self) -> Option<Outlines> {
        (self == Self::Plain).then(|| Outlines { width: Length::Millimetres(0.3), ..Outlines::default() })
    }

    /// The table. Of Fig. 4, 6, 7 and 8 the paper gives the numbers of one effect; the boundaries are those of Fig. 1.
    pub(crate) fn table(self) -> Stipples {
        let boundary = Some(Boundary { gc: 0.39, gs: 0.51, ge: 1.0 });
        let silhouette = Some(Silhouette { sc: 0.279, ss: 0.45, se: 1.11, literal: false });
        let literal = Curves { test: CurvesTest::Literal, ..Curves::default() };
        let plain = Stipples { boundary, ..Stipples::default() };
        let fig1 = Stipples { silhouette, curves: Some(Curves::default()), ..plain.clone() };
        match self {
            // Light makes the tone: of a scientific illustration, white in the light and three quarters black in the
            // shadow.
            Self::Plain => Stipples {
                iso: Some(Iso::Auto),
                hide_behind: Some(Iso::Auto),
                k_max: PointsPerPixel::Auto,
                size: Length::Millimetres(0.3),
                box_side: Some(1),
                snap: Snap::Edge,
                density: DotDensity::Page,
                even: Even::Page,
                boundary: Some(Boundary { gc: 0.75, gs: 0.0, ge: 1.0 }),
                lighting: Some(Lighting { le: 1.0, light: Some(LightDirection::Eye(DVec3::new(-1.0, 1.5, 1.2))) }),
                ..Stipples::default()
            },
            Self::Fig1 => fig1,
            Self::Fig4 => Stipples { resolution: Some(Resolution { re: 1.1, reference: None }), ..plain },
            Self::Fig5 => Stipples { distance: Some(Distance { de: 1.5 }), ..fig1 },
            Self::Fig6 => Stipples { interior: Some(Interior { te: 0.5 }), ..plain },
            Self::Fig7 => Stipples { lighting: Some(Lighting { le: 2.7, light: None }), ..plain },
            Self::Fig8 => Stipples { curves: Some(Curves { eye: 0.0, grad: 0.2, log: 0.12, ..literal }), ..plain },
            Self::Fig9 => Stipples {
                boundary: Some(Boundary { gc: 0.4, gs: 0.0, ge: 10.0 }),
                silhouette: Some(Silhouette { sc: 0.5, ss: 5.0, se: 1.0, literal: false }),
                // k_de is not printed.
                distance: Some(Distance { de: 1.0 }),
                curves: Some(Curves { eye: 0.9, grad: 0.2, log: 0.22, ..literal }),
                ..plain
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::file::{Overrides, parse};
    use crate::tables::{Curves, CurvesTest, Iso, Stipples};
    use std::path::Path;

    fn preset(name: &str) -> Stipples {
        let text = format!("drypoint = 1\npreset = \"{name}\"\n[volume]\nfile = \"a\"\n");
        parse(&text, Path::new("test.toml"), &Overrides::default()).unwrap().stipples.unwrap()
    }

    /// Dots, what hides them and outlines are of one surface; the paper's figures have boundaries and no outlines.
    #[test]
    fn the_plain_preset_is_a_drawing_of_one_surface() {
        let scene = |name: &str| {
            let text = format!("drypoint = 1\npreset = \"{name}\"\n[volume]\nfile = \"a\"\n");
            parse(&text, Path::new("test.toml"), &Overrides::default()).unwrap()
        };
        let plain = scene("stipple");
        let stipples = plain.stipples.unwrap();
        assert_eq!((stipples.iso, stipples.hide_behind), (Some(Iso::Auto), Some(Iso::Auto)));
        assert_eq!(plain.outlines.unwrap().iso, Iso::Auto);
        let figure = scene("stipple-fig1");
        assert!(figure.outlines.is_none() && figure.stipples.unwrap().iso.is_none());
    }

    /// k_gc, k_gs, k_ge; k_sc, k_ss, k_se; k_re, k_de, k_te, k_le; Th_eye, Th_grad, Th_LOG of the literal test.
    type Numbers = (Option<[f64; 3]>, Option<[f64; 3]>, [Option<f64>; 4], Option<[f64; 3]>);

    fn numbers(stipples: &Stipples) -> Numbers {
        let literal = |c: &Curves| (c.test == CurvesTest::Literal).then_some([c.eye, c.grad, c.log]);
        (
            stipples.boundary.as_ref().map(|b| [b.gc, b.gs, b.ge]),
            stipples.silhouette.as_ref().map(|s| [s.sc, s.ss, s.se]),
            [
                stipples.resolution.as_ref().map(|r| r.re),
                stipples.distance.as_ref().map(|d| d.de),
                stipples.interior.as_ref().map(|i| i.te),
                stipples.lighting.as_ref().map(|l| l.le),
            ],
            stipples.curves.as_ref().and_then(literal),
        )
    }

    /// The numbers printed below the paper's figures ([STIP-14]), and no factor that a figure is not about.
    #[test]
    fn figures_have_the_numbers_of_the_paper() {
        let boundary = Some([0.39, 0.51, 1.0]);
        let silhouette = Some([0.279, 0.45, 1.11]);
        let only = |which: usize, k: f64| std::array::from_fn(|i| (i == which).then_some(k));
        let figures: [(&str, Numbers); 7] = [
            ("1", (boundary, silhouette, [None; 4], None)),
            ("4", (boundary, None, only(0, 1.1), None)),
            ("5", (boundary, silhouette, only(1, 1.5), None)),
            ("6", (boundary, None, only(2, 0.5), None)),
            ("7", (boundary, None, only(3, 2.7), None)),
            ("8", (boundary, None, [None; 4], Some([0.0, 0.2, 0.12]))),
            ("9", (Some([0.4, 0.0, 10.0]), Some([0.5, 5.0, 1.0]), only(1, 1.0), Some([0.9, 0.2, 0.22]))),
        ];
        for (figure, expected) in figures {
            let stipples = preset(&format!("stipple-fig{figure}"));
            assert_eq!(numbers(&stipples), expected, "Fig. {figure}");
            assert_eq!(stipples.curves.is_some(), ["1", "5", "8", "9"].contains(&figure), "Fig. {figure}");
        }
    }
}
