//! The presets of stippling ([STIP-14]).

use super::{
    Boundary, Curves, CurvesTest, Distance, Interior, Lighting, PointsPerPixel, Resolution, Silhouette, Snap, Stipples,
};
use crate::tables::Length;

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
    /// The table. Of Fig. 4, 6, 7 and 8 the paper gives the numbers of one effect; the boundaries are those of Fig. 1.
    pub(crate) fn table(self) -> Stipples {
        let boundary = Some(Boundary { gc: 0.39, gs: 0.51, ge: 1.0 });
        let silhouette = Some(Silhouette { sc: 0.279, ss: 0.45, se: 1.11, literal: false });
        let literal = Curves { test: CurvesTest::Literal, ..Curves::default() };
        let plain = Stipples { boundary, ..Stipples::default() };
        let fig1 = Stipples { silhouette, curves: Some(Curves::default()), ..plain.clone() };
        match self {
            // Judged on real volumes, on a page of 160 mm: rims dark, faces light, one layer a face.
            Self::Plain => Stipples {
                k_max: PointsPerPixel::Number(6.0),
                size: Length::Millimetres(0.5),
                thin: true,
                snap: Snap::Edge,
                boundary: Some(Boundary { gc: 0.1, gs: 0.51, ge: 1.0 }),
                silhouette: Some(Silhouette { sc: 0.0, ss: 3.0, se: 3.0, literal: false }),
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
