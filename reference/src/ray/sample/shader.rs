//! Shaders, which map the attributes of a visible sample to its straight colour and its opacity per reference length.

use super::{EyeAxes, Lit, SampleAttributes, ViewDirs};
use crate::interactive_volume_illustration::ViewOpacity;
use crate::number::{Real, Vec3};
use crate::ray::error::RenderError;
use crate::ray::opacity::Correction;
use crate::shading::Phong;
use crate::style_transfer_functions::{Blend2, Contour, Detail, Spheres, StyleIndex, contour, frame, transparency};
use crate::transfer::{NodePatch, NodePlace};
use crate::volumeshop::ghosting;
use drypoint_scene::counts::Counts;
use drypoint_scene::shot::{Illumination, Lighting, Material, Object, Shot, SphereFrame, StyleParams, Transparency};
use drypoint_scene::space::Grid;
use drypoint_scene::style::Style;
use drypoint_scene::transfer::Function;
use drypoint_scene::view::View;

/// The properties of the picture's camera on which materials depend.
pub(crate) struct Camera<'c> {
    pub(crate) view: &'c View,
    pub(crate) rays_across: usize,
    /// The smallest voxel side of `[volume]`, in world units.
    pub(crate) voxel: f64,
}

impl<'c> Camera<'c> {
    /// The camera of a shot over the grid of `[volume]`.
    pub(in crate::ray) fn new(shot: &'c Shot, grid: &Grid) -> Self {
        Self { view: &shot.view, rays_across: shot.rays_across, voxel: grid.voxel() }
    }
}

/// A material prepared for samples, which gives visible samples their colour.
pub(crate) enum SampleShader<R> {
    /// Colours, unshaded or shaded ([STF-11]).
    Regular {
        /// Linear straight colour of each node.
        colors: Vec<[R; 3]>,
        /// Reflection and light.
        phong: Option<Phong<R>>,
    },
    /// Colours with more than Phong: tones, silhouettes, view-dependent opacity ([HATCH-15]), lighting functions ([VS-5]).
    Illustrated(Illustrated<R>),
    /// Styles (Bruckner and Gröller 2007).
    Style(Styled<R>),
}

/// A regular function with more than Phong.
pub(crate) struct Illustrated<R> {
    /// Linear straight colour of each node.
    pub(crate) colors: Vec<[R; 3]>,
    pub(crate) lit: Lit<R>,
    /// View-dependent opacity. None leaves opacities unchanged.
    pub(crate) view_opacity: Option<ViewOpacity>,
}

/// A style transfer function prepared for samples.
pub(crate) struct Styled<R> {
    /// ift.
    pub(crate) index: StyleIndex,
    /// sft.
    pub(crate) spheres: Spheres<R>,
    /// [STF-10]; none if each lookup reads the style itself.
    pub(crate) detail: Option<Detail<R>>,
    /// [STF-7], [STF-8].
    pub(crate) contour: Option<Contour<R>>,
    /// [STF-9].
    pub(crate) transparency: Transparency,
    /// [STF-1].
    pub(crate) frame: SphereFrame,
    pub(crate) eye_axes: EyeAxes<R>,
}

impl<R: Real> SampleShader<R> {
    /// Prepares the material of a shot's object. `styles` are those that its function names, in order.
    ///
    /// # Errors
    /// The number of styles differs from the number that the function names, or the material is for the other kind of
    /// function.
    pub(crate) fn new(object: &Object, camera: &Camera<'_>, styles: &[Style]) -> Result<Self, RenderError> {
        match (&*object.function, &object.material) {
            (Function::Regular(nodes), Material::Regular(lit)) => {
                let colors = nodes.color.iter().map(|c| c.map(R::from_f64)).collect();
                Ok(Self::regular(colors, lit))
            }
            (Function::Style { nodes, names }, Material::Style(style)) => {
                if names.len() != styles.len() {
                    return Err(RenderError::Styles { named: names.len(), given: styles.len() });
                }
                Ok(Self::Style(Styled::new(&nodes.color, style, styles, camera)))
            }
            _ => Err(RenderError::Material),
        }
    }

    fn regular(colors: Vec<[R; 3]>, lit: &Illumination) -> Self {
        match &lit.lighting {
            Lighting::Flat if lit.is_plain() => Self::Regular { colors, phong: None },
            Lighting::Phong(phong) if lit.is_plain() => Self::Regular { colors, phong: Some(Phong::new(phong)) },
            _ => {
                let view_opacity = ViewOpacity::new(lit.view_opacity);
                Self::Illustrated(Illustrated { colors, lit: Lit::new(lit), view_opacity })
            }
        }
    }

    /// The size of mip chains in bytes. Returns none without mip chains.
    pub(crate) fn mipmap_bytes(&self) -> Option<usize> {
        if let Self::Style(styled) = self { styled.spheres.mipmap_bytes() } else { None }
    }

    /// Takes over the camera's data from the same shot seen by another camera: lights, view, and the size of its pixels.
    pub(crate) fn turn(&mut self, object: &Object, camera: &Camera<'_>) {
        match (self, &object.material) {
            (Self::Regular { phong: Some(phong), .. }, Material::Regular(lit)) => {
                if let Lighting::Phong(params) = &lit.lighting {
                    *phong = Phong::new(params);
                }
            }
            (Self::Illustrated(illustrated), Material::Regular(lit)) => illustrated.lit = Lit::new(lit),
            (Self::Style(styled), Material::Style(style)) => {
                styled.detail = detail(style, camera);
                styled.eye_axes = EyeAxes::new(camera.view);
            }
            _ => {}
        }
    }

    /// Directions of a ray. v points to the eye, in world and in eye space.
    pub(crate) fn view_dirs(&self, v: Vec3<R>, v_eye: Vec3<R>) -> ViewDirs<R> {
        let half = match self {
            Self::Regular { phong: Some(phong), .. } => phong.half_vector(v),
            Self::Illustrated(illustrated) => illustrated.lit.half_vector(v),
            _ => Vec3::zero(),
        };
        ViewDirs { v, v_eye, half }
    }

    /// Straight colour and opacity per reference length. Place and attributes are passed by value, so that only styles
    /// need them in memory.
    #[inline(always)]
    pub(crate) fn shade(
        &self,
        place: impl Between<R>,
        attributes: SampleAttributes<R>,
        dirs: &ViewDirs<R>,
        counts: &mut Counts,
    ) -> ([R; 3], R) {
        match self {
            Self::Regular { colors, phong } => {
                let rgb = place.color(colors);
                let rgb = match (phong, attributes.normal) {
                    (Some(phong), Some(n)) => phong.shade(rgb, n, dirs.half),
                    _ => rgb,
                };
                (rgb, place.alpha_u())
            }
            Self::Illustrated(illustrated) => {
                illustrated.light((place.color(&illustrated.colors), place.alpha_u()), &attributes, dirs)
            }
            Self::Style(styled) => styled.shade(place, attributes, dirs, counts),
        }
    }

    /// Unlit straight colour and opacity per reference length. A style includes its light, so its colour and opacity
    /// are those of [`SampleShader::shade`].
    pub(crate) fn unlit(
        &self,
        place: impl Between<R>,
        attributes: SampleAttributes<R>,
        dirs: &ViewDirs<R>,
        counts: &mut Counts,
    ) -> ([R; 3], R) {
        match self {
            Self::Regular { colors, .. } => (place.color(colors), place.alpha_u()),
            Self::Illustrated(illustrated) => (place.color(&illustrated.colors), place.alpha_u()),
            Self::Style(styled) => styled.shade(place, attributes, dirs, counts),
        }
    }

    /// Applies the light of this material to a colour and an opacity per reference length. A style changes nothing.
    pub(crate) fn light(
        &self,
        (rgb, alpha): ([R; 3], R),
        attributes: &SampleAttributes<R>,
        dirs: &ViewDirs<R>,
    ) -> ([R; 3], R) {
        match (self, attributes.normal) {
            (Self::Regular { phong: Some(phong), .. }, Some(n)) => (phong.shade(rgb, n, dirs.half), alpha),
            (Self::Illustrated(illustrated), _) => illustrated.light((rgb, alpha), attributes, dirs),
            (Self::Regular { .. } | Self::Style(_), _) => (rgb, alpha),
        }
    }

    /// e of [VS-7], which protects a sample from ghosting: the enhancement by illustrative styles and lighting
    /// functions. It is 0 for every other material, and for a sample without a normal.
    pub(crate) fn enhancement(&self, attributes: &SampleAttributes<R>, dirs: &ViewDirs<R>) -> R {
        match (self, attributes.normal) {
            (Self::Style(styled), Some(n)) if styled.transparency == Transparency::Illustrative => {
                let away_from_contour = (n.dot(dirs.v).abs() - styled.tau(attributes)).max(R::ZERO);
                ghosting::enhancement(away_from_contour, attributes.magnitude)
            }
            (Self::Illustrated(illustrated), Some(n)) => {
                let s_alpha = illustrated.lit.opacity_enhancement(n, dirs.half);
                s_alpha.map_or(R::ZERO, |s_alpha| ghosting::enhancement(s_alpha, attributes.magnitude))
            }
            _ => R::ZERO,
        }
    }
}

impl<R: Real> Illustrated<R> {
    #[inline(never)]
    fn light(&self, (c_u, alpha_u): ([R; 3], R), attributes: &SampleAttributes<R>, dirs: &ViewDirs<R>) -> ([R; 3], R) {
        let (rgb, alpha) = self.lit.shade(c_u, alpha_u, attributes, dirs);
        let alpha = match (self.view_opacity, attributes.normal) {
            // |N·v| counts as 1 without a normal ([PREC-3]), and then the exponent is 1.
            (Some(view_opacity), Some(n)) => {
                let corrected = |alpha, n_dot_v: f64| Correction::new(view_opacity.exponent(n_dot_v)).apply(alpha);
                R::monotone([alpha, n.dot(dirs.v).abs()], |[alpha, n_dot_v]| corrected(alpha, n_dot_v))
            }
            _ => alpha,
        };
        (rgb, alpha)
    }
}

impl<R: Real> Styled<R> {
    fn new(of_node: &[usize], style: &StyleParams, styles: &[Style], camera: &Camera<'_>) -> Self {
        let spheres = Spheres::new(styles, style.mix);
        let has_levels = style.level_of_detail.is_some();
        Self {
            index: StyleIndex::new(of_node),
            spheres: if has_levels { spheres.with_mipmaps(styles) } else { spheres },
            detail: detail(style, camera),
            contour: style.contour.map(|c| Contour::new(c.thickness, c.kappa, c.fade)),
            transparency: style.transparency,
            frame: style.frame,
            eye_axes: EyeAxes::new(camera.view),
        }
    }

    /// τ. Without contours T = 0, so τ = 0 ([STF-9]).
    #[inline(always)]
    fn tau(&self, attributes: &SampleAttributes<R>) -> R {
        self.contour.as_ref().map_or(R::ZERO, |c| c.tau(attributes.kappa, attributes.magnitude))
    }

    #[inline(never)]
    fn shade(
        &self,
        place: impl Between<R>,
        attributes: SampleAttributes<R>,
        dirs: &ViewDirs<R>,
        counts: &mut Counts,
    ) -> ([R; 3], R) {
        let n = frame::on_sphere(self.frame, self.eye_axes.normal(&attributes, dirs), dirs.v_eye);
        // |N·v| counts as 1 without a normal ([PREC-3]).
        let n_dot_v = attributes.normal.map_or(R::ONE, |n| n.dot(dirs.v).abs());
        let tau = self.tau(&attributes);
        // A sample without a normal is on no contour, whatever the threshold.
        let on = self.contour.is_some() && attributes.normal.is_some();
        let (x, y) = if on { contour::push(n.x, n.y, n_dot_v, tau) } else { (n.x, n.y) };
        let level =
            self.detail.as_ref().map(|d| d.below_last(attributes.depth, attributes.kappa, attributes.magnitude));
        let [r, g, b, alpha_d] = place.style(&self.index, &self.spheres, [x, y], level, counts);
        if alpha_d == R::ZERO {
            return ([R::ZERO; 3], R::ZERO);
        }
        let share = transparency::share(self.transparency, place.alpha_u(), n_dot_v, tau, attributes.magnitude);
        // The remaining operations would change no bit.
        if alpha_d == R::ONE {
            return ([r, g, b], share);
        }
        ([r / alpha_d, g / alpha_d, b / alpha_d], alpha_d * share)
    }
}

/// The level of detail of a style's material; none: styles are read as they are.
fn detail<R: Real>(style: &StyleParams, camera: &Camera<'_>) -> Option<Detail<R>> {
    style.level_of_detail.map(|level| Detail::new(&level, camera.view, camera.rays_across, camera.voxel))
}

/// A place between the nodes of a function over one quantity or two.
pub(crate) trait Between<R: Real> {
    /// α_u, above 0.
    fn alpha_u(&self) -> R;

    /// The colour between the nodes' linear straight colours, which are interpolated independently of opacity
    /// ([VAL-3]).
    fn color(&self, colors: &[[R; 3]]) -> [R; 3];

    /// The style between the nodes' styles, looked up at (N_x, N_y): linear, premultiplied. `level` is the level of
    /// [`Detail::below_last`] in the mip chains; none looks up the styles themselves.
    fn style(
        &self,
        index: &StyleIndex,
        spheres: &Spheres<R>,
        n: [R; 2],
        level: Option<R>,
        counts: &mut Counts,
    ) -> [R; 4];
}

impl<R: Real> Between<R> for NodePlace<R> {
    #[inline(always)]
    fn alpha_u(&self) -> R {
        self.alpha_u
    }

    #[inline(always)]
    fn color(&self, colors: &[[R; 3]]) -> [R; 3] {
        self.color(colors)
    }

    #[inline(always)]
    fn style(
        &self,
        index: &StyleIndex,
        spheres: &Spheres<R>,
        [x, y]: [R; 2],
        level: Option<R>,
        counts: &mut Counts,
    ) -> [R; 4] {
        let blend = index.blend(self);
        counts.style_lookups += blend.lookups();
        match level {
            None => spheres.lookup(&blend, x, y),
            Some(level) => spheres.lookup_level(&blend, x, y, level),
        }
    }
}

impl<R: Real> Between<R> for NodePatch<R> {
    #[inline]
    fn alpha_u(&self) -> R {
        self.alpha_u
    }

    #[inline]
    fn color(&self, colors: &[[R; 3]]) -> [R; 3] {
        let [a, b] = &self.rows;
        if self.w == R::ZERO { a.color(colors) } else { mixed(a.color(colors), b.color(colors), self.w) }
    }

    #[inline]
    fn style(
        &self,
        index: &StyleIndex,
        spheres: &Spheres<R>,
        [x, y]: [R; 2],
        level: Option<R>,
        counts: &mut Counts,
    ) -> [R; 4] {
        let blend = Blend2::new(index, self);
        counts.style_lookups += blend.lookups();
        match level {
            None => spheres.lookup2(&blend, x, y),
            Some(level) => spheres.lookup2_level(&blend, x, y, level),
        }
    }
}

/// Channel by channel, a + w(b − a).
#[inline(always)]
fn mixed<R: Real>(a: [R; 3], b: [R; 3], w: R) -> [R; 3] {
    [R::lerp(a[0], b[0], w), R::lerp(a[1], b[1], w), R::lerp(a[2], b[2], w)]
}
