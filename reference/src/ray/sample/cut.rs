//! Cuts: places where a ray leaves the region that clip planes cut away ([RAY-8]).

use super::{EyeAxes, SampleAttributes, ViewDirs};
use crate::number::{Real, Vec3};
use crate::ray::error::RenderError;
use crate::style_transfer_functions::{SphereMap, frame};
use drypoint_scene::clip::ClipPlanes;
use drypoint_scene::shot::{Cap, Clipping, SphereFrame};
use drypoint_scene::style::Style;

/// Clip planes and their caps, prepared for rays.
pub(crate) struct PreparedClip<R> {
    pub(crate) planes: ClipPlanes,
    caps: Vec<PreparedCap<R>>,
    frame: SphereFrame,
}

/// A cap.
enum PreparedCap<R> {
    /// A straight linear colour, and the factor of the opacity on a cut.
    Color([R; 3], R),
    /// A lit sphere.
    Style(SphereMap),
}

/// A cut, seen along a ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CutFace<R> {
    /// The plane's normal, turned to the eye.
    pub(crate) normal: Vec3<R>,
    /// The straight linear colour of the cap, and the factor of the opacity. None if the cut shows its own colour.
    cap: Option<([R; 3], R)>,
}

/// The first sample of a ray behind a cut. It is evaluated on the plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CutSample<R> {
    /// k.
    pub(crate) k: i64,
    /// The eye depth at which the ray meets the plane.
    pub(crate) depth: R,
    pub(crate) face: CutFace<R>,
}

impl<R: Real> PreparedClip<R> {
    /// Prepares the planes of a shot with the styles of their caps, in their order.
    ///
    /// # Errors
    /// The number of styles differs from the number that caps name.
    pub(crate) fn new(clipping: &Clipping, styles: &[Style]) -> Result<Self, RenderError> {
        let named = clipping.styles.len();
        if named != styles.len() {
            return Err(RenderError::Styles { named, given: styles.len() });
        }
        let cap = |cap: &Cap| match *cap {
            Cap::Color { rgb, opacity } => PreparedCap::Color(rgb.map(R::from_f64), R::from_f64(opacity)),
            Cap::Style(place) => PreparedCap::Style(SphereMap::new(&styles[place])),
        };
        let caps = clipping.caps.iter().map(cap).collect();
        Ok(Self { planes: clipping.planes.clone(), caps, frame: clipping.frame })
    }

    /// The cut at a plane, given by its index, on a ray with these directions.
    pub(crate) fn face(&self, plane: usize, dirs: &ViewDirs<R>, eye_axes: &EyeAxes<R>) -> CutFace<R> {
        let plane = &self.planes.0[plane];
        let n = Vec3::<R>::from_glam(plane.normal);
        let normal = if n.dot(dirs.v) < R::ZERO { n * -R::ONE } else { n };
        let cap = plane.cap.map(|cap| match &self.caps[cap] {
            PreparedCap::Color(rgb, opacity) => (*rgb, *opacity),
            PreparedCap::Style(map) => {
                let attributes = SampleAttributes { normal: Some(normal), ..SampleAttributes::neutral() };
                let n = frame::on_sphere(self.frame, eye_axes.normal(&attributes, dirs), dirs.v_eye);
                let [r, g, b, opacity] = map.sample(n.x, n.y);
                let straight = |c: R| if opacity > R::ZERO { c / opacity } else { R::ZERO };
                ([r, g, b].map(straight), opacity)
            }
        });
        CutFace { normal, cap }
    }
}

impl<R: Real> CutFace<R> {
    /// The attributes of a place on the cut: those of the field, except that N is the plane's normal, and κ = 0.
    #[inline]
    pub(crate) fn attributes(&self, of_field: SampleAttributes<R>) -> SampleAttributes<R> {
        SampleAttributes { normal: Some(self.normal), kappa: R::ZERO, ..of_field }
    }

    /// The straight colour and the opacity of a sample on the cut, from those of the sample itself.
    #[inline]
    pub(crate) fn shade(&self, (rgb, alpha): ([R; 3], R)) -> ([R; 3], R) {
        self.cap.map_or((rgb, alpha), |(cap, opacity)| (cap, alpha * opacity))
    }

    /// The colour of an opaque surface on the cut: the cap over its own colour.
    #[inline]
    pub(crate) fn over(&self, own: [R; 3]) -> [R; 3] {
        let Some((cap, opacity)) = self.cap else { return own };
        std::array::from_fn(|c| R::lerp(own[c], cap[c], opacity))
    }
}
