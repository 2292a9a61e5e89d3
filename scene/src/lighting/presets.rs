//! Presets of lighting transfer functions (Bruckner and Gröller 2005, 5 and Fig. 5; [VS-5]).

use super::{LightingCell, LightingTable};
use crate::document::declare::choices;
use crate::math;
use serde::{Deserialize, Serialize};

/// Columns and rows of a preset's table. The number is odd, so that N·L = 0, where light ends, is a column.
const SIDE: usize = 257;

/// The deviation of the Gaussian that smooths contours, in N·v.
const CONTOUR_WIDTH: f64 = 0.15;

choices! {
    /// A lighting transfer function that is generated.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum LightingPreset {
        /// Blinn–Phong.
        BlinnPhong = "blinn-phong",
        /// Blinn–Phong with dark contours, which are more opaque where the gradient is strong.
        BlinnPhongContours = "blinn-phong-contours",
        /// Two steps of light, and contours.
        CartoonContours = "cartoon-contours",
        /// Bands of light as on brushed metal, a highlight, and contours.
        MetalContours = "metal-contours",
        /// Blinn–Phong, with opacities divided by 1 − |g|: boundaries stand out.
        Gradient = "gradient",
        /// Light that wraps around: from 0.35 away from the light to 1 towards it, and a highlight.
        Tone = "tone",
    }
}

impl LightingPreset {
    /// Every preset.
    pub const ALL: [Self; 6] = [
        Self::BlinnPhong,
        Self::BlinnPhongContours,
        Self::CartoonContours,
        Self::MetalContours,
        Self::Gradient,
        Self::Tone,
    ];

    /// Its name in scene files.
    pub fn name(self) -> &'static str {
        Self::KIND.options.iter().find(|option| option.value == self).map_or("", |option| option.name)
    }

    /// The preset of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|preset| preset.name() == name)
    }

    /// Whether it has contours.
    pub fn has_contours(self) -> bool {
        matches!(self, Self::BlinnPhongContours | Self::CartoonContours | Self::MetalContours)
    }

    /// Whether opacities depend on |g|: s_α is below 1 somewhere.
    pub fn reads_magnitude(self) -> bool {
        self.has_contours() || self == Self::Gradient
    }

    /// Whether s_a and s_d are made of the constants k_a and k_d.
    pub fn reads_shares(self) -> bool {
        self != Self::Tone
    }

    /// Whether there is a highlight.
    pub fn has_highlight(self) -> bool {
        self != Self::CartoonContours
    }
}

/// A preset with its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LightingModel {
    /// The preset.
    pub preset: LightingPreset,
    /// k_a.
    pub ambient: f64,
    /// k_d.
    pub diffuse: f64,
    /// k_s.
    pub specular: f64,
    /// The exponent of the highlight.
    pub shininess: f64,
    /// c of the contours.
    pub contour_factor: f64,
}

impl LightingModel {
    /// The reflectance at x = N·L, y = N·Ĥ.
    pub fn reflectance(&self, x: f64, y: f64) -> LightingCell {
        let Self { preset, ambient, diffuse, .. } = *self;
        let highlight = || if x <= 0.0 { 0.0 } else { self.specular * math::pow(y.max(0.0), self.shininess) };
        let lit = match preset {
            LightingPreset::BlinnPhong | LightingPreset::BlinnPhongContours | LightingPreset::Gradient => {
                [ambient, diffuse * x.max(0.0), highlight()]
            }
            LightingPreset::CartoonContours => {
                let step = if x > 0.5 {
                    1.0
                } else if x > 0.0 {
                    0.5
                } else {
                    0.0
                };
                [ambient, diffuse * step, 0.0]
            }
            LightingPreset::MetalContours => {
                let bands = 0.5 + 0.5 * math::cos(3.0 * std::f64::consts::PI * x);
                [ambient, diffuse * bands, highlight()]
            }
            LightingPreset::Tone => [0.35, 0.65 * (1.0 + x) / 2.0, highlight()],
        };
        let [a, d, s] = lit;
        if preset == LightingPreset::Gradient {
            return [a, d, s, 0.0];
        }
        if !preset.has_contours() {
            return [a, d, s, 1.0];
        }
        // The band where N·v, which is c·y − x, is near 0.
        let off = (self.contour_factor * y - x) / CONTOUR_WIDTH;
        let rest = 1.0 - math::exp(-0.5 * off * off);
        [a * rest, d * rest, s * rest, rest]
    }

    /// The preset's table.
    pub fn table(&self) -> LightingTable {
        LightingTable::of_function(SIDE, |x, y| self.reflectance(x, y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn model(preset: LightingPreset) -> LightingModel {
        LightingModel { preset, ambient: 0.25, diffuse: 0.5, specular: 0.125, shininess: 2.0, contour_factor: 2.0 }
    }

    #[test]
    fn names_lead_back() {
        for preset in LightingPreset::ALL {
            assert_eq!(LightingPreset::named(preset.name()), Some(preset));
        }
        assert_eq!(LightingPreset::ALL.len(), LightingPreset::KIND.options.len());
        assert_eq!(LightingPreset::named("marble"), None);
    }

    #[test]
    fn reflectances_by_hand() {
        let at = |preset, x, y| model(preset).reflectance(x, y);
        use LightingPreset::{BlinnPhong, CartoonContours, Gradient, MetalContours, Tone};
        assert_eq!(at(BlinnPhong, 0.5, 0.5), [0.25, 0.25, 0.03125, 1.0]);
        assert_eq!(at(BlinnPhong, 0.5, -0.5), [0.25, 0.25, 0.0, 1.0]);
        assert_eq!(at(BlinnPhong, -0.5, 0.5), [0.25, 0.0, 0.0, 1.0]);
        assert_eq!(at(BlinnPhong, 0.0, 1.0), [0.25, 0.0, 0.0, 1.0]);
        assert_eq!(at(Gradient, 0.5, 0.5), [0.25, 0.25, 0.03125, 0.0]);
        // Away from the band, w = exp(−½(2.9/0.15)²) is below 1e−81.
        for (x, d) in [(-1.0, 0.0), (0.0, 0.0), (0.25, 0.25), (0.5, 0.25), (0.51, 0.5)] {
            let c = LightingModel { contour_factor: 5.0, ..model(CartoonContours) };
            assert_eq!(c.reflectance(x, 1.0), [0.25, d, 0.0, 1.0], "{x}");
        }
        let [a, d, s, alpha] =
            LightingModel { contour_factor: 5.0, ..model(MetalContours) }.reflectance(1.0 / 3.0, 1.0);
        assert!(d.abs() < 1e-16);
        assert_eq!([a, s, alpha], [0.25, 0.125, 1.0]);
        assert_eq!(at(Tone, -1.0, 0.0), [0.35, 0.0, 0.0, 1.0]);
        assert_eq!(at(Tone, 1.0, 0.0), [0.35, 0.65, 0.0, 1.0]);
    }

    /// On the contour everything is 0; one deviation beside it the share exp(−½) is missing.
    #[test]
    fn contours_take_all_components() {
        for preset in LightingPreset::ALL.into_iter().filter(|preset| preset.has_contours()) {
            assert_eq!(model(preset).reflectance(0.75, 0.375), [0.0; 4], "{preset:?}");
            let y = 0.375 + 0.5 * CONTOUR_WIDTH;
            let [a, .., alpha] = model(preset).reflectance(0.75, y);
            let rest = 1.0 - (-0.5f64).exp();
            assert!((alpha - rest).abs() < 1e-15 && (a - 0.25 * rest).abs() < 1e-15, "{preset:?}");
        }
    }

    /// A preset says rightly whether opacities depend on |g|, and which constants it reads.
    #[test]
    fn presets_know_what_they_read() {
        for preset in LightingPreset::ALL {
            let cells = |model: LightingModel| model.table().cells().to_vec();
            let table = cells(model(preset));
            assert_eq!(table.iter().any(|cell| cell[3] < 1.0), preset.reads_magnitude(), "{preset:?}");
            let others = [
                (LightingModel { ambient: 0.5, ..model(preset) }, preset.reads_shares()),
                (LightingModel { diffuse: 0.25, ..model(preset) }, preset.reads_shares()),
                (LightingModel { specular: 0.25, ..model(preset) }, preset.has_highlight()),
                (LightingModel { shininess: 3.0, ..model(preset) }, preset.has_highlight()),
                (LightingModel { contour_factor: 1.0, ..model(preset) }, preset.has_contours()),
            ];
            for (other, reads) in others {
                assert_eq!(cells(other) != table, reads, "{preset:?} {other:?}");
            }
        }
    }
}
