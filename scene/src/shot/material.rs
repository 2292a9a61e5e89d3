//! Materials of samples, and the light on colours.

use super::{Kappa, Mix, ShotError, SphereFrame, Transparency};
use crate::lighting::{ContourRule, LightingModel, LightingPreset, LightingTable};
use crate::space::Grid;
use crate::tables::{
    LightDirection, Scene, Shading, ShadingModel, SilhouetteShading, Surface, SurfaceLook, Tone, ToonShading,
};
use crate::transfer::Function;
use crate::view::View;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::sync::Arc;

/// From the attributes of a sample to its straight colour and its opacity per reference length.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Material {
    /// Colours of the function's nodes.
    Regular(Illumination),
    /// Styles of the function's nodes (Bruckner and Gröller 2007).
    Style(StyleParams),
}

/// The illumination of a colour.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Illumination {
    /// The reflection of light.
    pub lighting: Lighting,
    /// The offset of the test (N·V)² + offset > ½, where silhouettes are black ([HATCH-15]); none: no silhouettes.
    pub silhouette: Option<f64>,
    /// s: the growth of the opacity of samples that are seen from the side ([HATCH-15]); 0: opacities are as they are.
    pub view_opacity: f64,
    /// The light as the scene gives it: L of `lighting` follows from it and from the view.
    pub light: LightDirection,
    /// The rule by which the contour factor of a lighting preset follows from the light.
    pub contour: ContourRule,
}

/// A reflection of light.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Lighting {
    /// Not at all.
    Flat,
    /// By Blinn and Phong ([STF-11]).
    Phong(PhongParams),
    /// In tones ([HATCH-15]).
    Toon(ToonParams),
    /// By a lighting transfer function, which also changes opacities ([VS-5]).
    Function(LightingParams),
}

/// Blinn–Phong reflection.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhongParams {
    /// k_a.
    pub ambient: f64,
    /// k_d.
    pub diffuse: f64,
    /// k_s.
    pub specular: f64,
    /// The exponent s.
    pub shininess: f64,
    /// L: the unit vector towards the light, in world space.
    pub light: DVec3,
}

/// A lighting transfer function.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LightingParams {
    /// The source of the table.
    pub source: LightingSource,
    /// s_min, the least divisor of opacities.
    pub divisor_floor: f64,
    /// L: the unit vector towards the light, in world space.
    pub light: DVec3,
}

/// The source of a lighting table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LightingSource {
    /// A preset.
    Preset(LightingModel),
    /// A picture.
    File {
        /// Its file.
        path: PathBuf,
        /// The table in it.
        table: Arc<LightingTable>,
    },
}

impl LightingSource {
    /// The table.
    pub fn table(&self) -> Arc<LightingTable> {
        match self {
            Self::Preset(model) => Arc::new(model.table()),
            Self::File { table, .. } => table.clone(),
        }
    }
}

/// Tones with hard steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ToonParams {
    /// L: the unit vector towards the light, in world space.
    pub light: DVec3,
    /// The offset that is added to L·N.
    pub offset: f64,
    /// Factors of colours, each from its place in L·N + offset on, in ascending order. The first tone holds from −∞ on.
    pub tones: Vec<Tone>,
}

/// The parameters of a function of styles beside its nodes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StyleParams {
    /// The mix of two styles ([STF-3]).
    pub mix: Mix,
    /// The rule by which α_u and α_d become α ([STF-9]).
    pub transparency: Transparency,
    /// The frame of the lit sphere ([STF-1]).
    pub frame: SphereFrame,
    /// Contours; none: none ([STF-7], [STF-8]).
    pub contour: Option<ContourParams>,
    /// The level of detail in mip-maps ([STF-10]); none: styles are read as they are.
    pub level_of_detail: Option<LevelOfDetail>,
}

/// Style contours.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContourParams {
    /// T in world units.
    pub thickness: f64,
    /// Which κ, or which constant threshold.
    pub kappa: Kappa,
    /// Both ends in |g| between which contours fade in; none: they do not.
    pub fade: Option<[f64; 2]>,
}

/// The level of detail of styles ([STF-10]).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LevelOfDetail {
    /// b_κ; 0 where the picture has no κ.
    pub curvature_bias: f64,
    /// b_g.
    pub gradient_bias: f64,
    /// ω₀, in radians per voxel.
    pub turn: f64,
}

impl Material {
    /// The material of a scene.
    pub(super) fn new(scene: &Scene, function: &Function, grid: &Grid, view: &View) -> Result<Self, ShotError> {
        if matches!(function, Function::Regular(_)) {
            return Ok(Self::Regular(match &scene.shading {
                Some(shading) => Illumination::of_shading(shading, scene, view)?,
                None => Illumination::FLAT,
            }));
        }
        let contour = scene.contours.as_ref().map(|c| {
            let thickness = c.thickness.world(grid).ok_or(ShotError::Length { key: "contours.thickness" })?;
            Ok::<_, ShotError>(ContourParams { thickness, kappa: c.kappa, fade: c.fade })
        });
        let transfer = scene.transfer.as_ref();
        Ok(Self::Style(StyleParams {
            mix: transfer.map_or(Mix::Premultiplied, |t| t.mix),
            transparency: transfer.map_or(Transparency::Illustrative, |t| t.transparency),
            frame: transfer.map_or(SphereFrame::Eye, |t| t.sphere_frame),
            contour: contour.transpose()?,
            level_of_detail: scene.style_mipmaps.as_ref().map(|table| LevelOfDetail {
                curvature_bias: table.measured_curvature_bias(scene),
                gradient_bias: table.gradient_bias,
                turn: table.turn,
            }),
        }))
    }
}

impl Material {
    /// Points the light where another view has it. Styles are lit in eye space.
    pub(super) fn turn(&mut self, view: &View) {
        if let Self::Regular(illumination) = self {
            illumination.turn(view);
        }
    }
}

impl Illumination {
    /// Colours as they are.
    pub const FLAT: Self = Self {
        lighting: Lighting::Flat,
        silhouette: None,
        view_opacity: 0.0,
        light: LightDirection::Head,
        contour: ContourRule::Exact,
    };

    /// Whether it is reflection alone: no silhouettes, opacities as they are.
    pub fn is_plain(&self) -> bool {
        self.silhouette.is_none() && self.view_opacity <= 0.0
    }

    /// By a table `[shading]`.
    fn of_shading(shading: &Shading, scene: &Scene, view: &View) -> Result<Self, ShotError> {
        let light = shading.light.unwrap_or(scene.light);
        let lighting = match (shading.model, shading.tones()) {
            (ShadingModel::Function, _) => Lighting::Function(LightingParams::new(shading, light, view)?),
            (_, Some(tones)) => Lighting::Toon(ToonParams::new(&tones, light, view)),
            (_, None) => Lighting::Phong(PhongParams::new(shading, light, view)),
        };
        let (silhouette, view_opacity) = (offset(shading.silhouette), shading.view_opacity);
        Ok(Self { lighting, silhouette, view_opacity, light, contour: shading.contour })
    }

    /// By the look of an iso-surface, with the light and the constants of `[shading]` or their defaults.
    pub(super) fn of_surface(surface: &Surface, scene: &Scene, view: &View) -> Self {
        let light = scene.shading.as_ref().and_then(|shading| shading.light).unwrap_or(scene.light);
        let lighting = match (surface.tones(), surface.look) {
            (Some(tones), _) => Lighting::Toon(ToonParams::new(&tones, light, view)),
            (None, SurfaceLook::Phong) => {
                Lighting::Phong(PhongParams::new(&scene.shading.clone().unwrap_or_default(), light, view))
            }
            (None, _) => Lighting::Flat,
        };
        Self { lighting, silhouette: offset(surface.silhouette), light, ..Self::FLAT }
    }

    /// The light on meshes: Blinn–Phong, with the constants of `[shading]` or their defaults.
    pub(super) fn of_mesh(scene: &Scene, view: &View) -> Self {
        let shading = scene.shading.clone().unwrap_or_default();
        let light = shading.light.unwrap_or(scene.light);
        Self { lighting: Lighting::Phong(PhongParams::new(&shading, light, view)), light, ..Self::FLAT }
    }

    /// Points the light where another view has it.
    pub(super) fn turn(&mut self, view: &View) {
        let towards = view.towards(self.light);
        match &mut self.lighting {
            Lighting::Flat => {}
            Lighting::Phong(phong) => phong.light = towards,
            Lighting::Toon(toon) => toon.light = towards,
            Lighting::Function(function) => {
                function.light = towards;
                if let LightingSource::Preset(model) = &mut function.source {
                    model.contour_factor = contour_factor(self.contour, towards, view);
                }
            }
        }
    }
}

/// c of a lighting preset ([VS-5]), of v at the picture's centre.
fn contour_factor(rule: ContourRule, light: DVec3, view: &View) -> f64 {
    rule.factor(light.dot(-view.forward))
}

/// The offset of a table of silhouettes.
fn offset(silhouette: Option<SilhouetteShading>) -> Option<f64> {
    silhouette.map(|table| table.offset)
}

impl PhongParams {
    fn new(shading: &Shading, light: LightDirection, view: &View) -> Self {
        let &Shading { ambient, diffuse, specular, shininess, .. } = shading;
        Self { ambient, diffuse, specular, shininess, light: view.towards(light) }
    }
}

impl LightingParams {
    /// By the table of a file as it was read, or by a preset for this light and view ([VS-5]).
    fn new(shading: &Shading, light: LightDirection, view: &View) -> Result<Self, ShotError> {
        let light = view.towards(light);
        let source = match (shading.lighting_file(), shading.lighting_preset()) {
            (Some(file), _) => {
                let table = file.table.clone().ok_or(ShotError::NoLightingTable)?;
                LightingSource::File { path: file.path.clone(), table }
            }
            (None, preset) => {
                let &Shading { ambient, diffuse, specular, shininess, .. } = shading;
                let preset = preset.unwrap_or(LightingPreset::BlinnPhong);
                let contour_factor = contour_factor(shading.contour, light, view);
                let model = LightingModel { preset, ambient, diffuse, specular, shininess, contour_factor };
                LightingSource::Preset(model)
            }
        };
        Ok(Self { source, divisor_floor: shading.divisor_floor, light })
    }
}

impl ToonParams {
    fn new(table: &ToonShading, light: LightDirection, view: &View) -> Self {
        Self { light: view.towards(light), offset: table.offset, tones: table.tones.clone() }
    }
}
