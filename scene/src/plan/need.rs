//! The content of a plan: needs, passes, keys without effect.

use super::Pass;
use crate::document::Place;
use crate::lighting::{ContourRule, LightingPreset};
use crate::quantity::Quantity;
use crate::space::Grid;
use crate::tables::Scene;
use crate::view::View;
use std::fmt;

/// The samples of a ray that a need is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Samples {
    /// Every visible sample.
    Visible,
    /// The first visible sample alone: layers `first.*` ([IO-6]).
    First,
    /// The samples that are asked for seeds of halos, visible or not ([HALO-2]).
    Seeds,
    /// The visible samples of an object's selection or ghost ([VS-2]).
    Part,
    /// The samples of a selection or ghost that are asked for seeds of halos.
    PartSeeds,
    /// The samples at which an intersection is shaded by the set with the larger μ ([VS-4]).
    Meetings,
}

/// A quantity that an effect needs.
#[derive(Clone, Debug, PartialEq)]
pub struct Need {
    /// The quantity.
    pub quantity: Quantity,
    /// The samples that need it.
    pub samples: Samples,
    /// The effect that needs it.
    pub effect: String,
    /// The index, from 0, of the item that needs the quantity, if the effect is one of a list of tables. A prerequisite
    /// is listed once for the whole picture, so that it may stand with another item.
    pub item: Option<usize>,
    /// The key or table that asked, such as `contours.kappa` or `pen[0].width`.
    pub key: String,
    /// The place of the key in the scene, or else that of the table around it; none for a default.
    pub place: Option<Place>,
}

impl Need {
    /// Returns the work that the need adds to a picture.
    pub fn adds(&self) -> &'static str {
        match self.samples {
            Samples::Visible | Samples::Part | Samples::Meetings => self.quantity.adds(),
            Samples::First => self.quantity.adds_at_first(),
            Samples::Seeds | Samples::PartSeeds => self.quantity.adds_at_seeds(),
        }
    }
}

/// A pass that an effect needs.
#[derive(Clone, Debug, PartialEq)]
pub struct PassNeed {
    /// The pass.
    pub pass: Pass,
    /// Whether only a volume of integers needs the pass. [`Plan::settle`] then decides.
    pub integer_only: bool,
    /// The effect that needs it.
    pub effect: String,
    /// The item that needs it, if the effect is one of a list of tables; items count from 0.
    pub item: Option<usize>,
    /// The key or table that asked, such as `contours.kappa` or `pen[0].width`.
    pub key: String,
    /// The place of the key in the scene, or else that of the table around it; none for a default.
    pub place: Option<Place>,
}

/// A key or table that the scene says and that has no effect beside its neighbours ([SCN-4]).
#[derive(Clone, Debug, PartialEq)]
pub struct IdleKey {
    /// The key, such as `camera.fov` or `pen[0].tone`.
    pub key: String,
    /// Place of the key in the scene.
    pub place: Place,
    /// The reason why the key has no effect.
    pub why: String,
}

/// The needs of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Quantities at samples, ordered by quantity.
    pub needs: Vec<Need>,
    /// Passes, in their order.
    pub passes: Vec<PassNeed>,
    /// Keys without effect.
    pub idle_keys: Vec<IdleKey>,
    /// The values of nodes that are given in another unit, for each function whose node values are known.
    pub nodes: Vec<NodesPlan>,
    /// The points of stipples, if they have been counted.
    pub points: Option<PointsPlan>,
    /// Flaws that the picture may have.
    pub warnings: Vec<String>,
}

/// The values that a transfer function's nodes have in a volume ([VS-11]).
#[derive(Clone, Debug, PartialEq)]
pub struct NodesPlan {
    /// The key of the nodes' unit, such as `transfer.unit` or `object[0].transfer.unit`.
    pub key: String,
    /// The object in whose own data the values of the picture's function are found; none for the data of the function
    /// itself.
    pub within: Option<usize>,
    /// The name of the nodes' unit.
    pub unit: &'static str,
    /// The places of nodes in that unit, each with its value.
    pub values: Vec<[f64; 2]>,
}

/// The number of stipple points, which depends on the volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PointsPlan {
    /// Voxels above the threshold.
    pub voxels: u64,
    /// Points of each voxel: N_max, and more in thin layers of voxels that are not cubes ([STIP-3], [STIP-4]).
    pub each: u64,
    /// Bytes of points, voxels and order while points are made.
    pub bytes: u64,
}

impl Plan {
    /// Whether an effect of the scene needs that quantity at every visible sample.
    pub fn needs(&self, quantity: Quantity) -> bool {
        self.needs_at(quantity, &[Samples::Visible])
    }

    /// Whether an effect of the scene needs that quantity at the first visible sample of a ray, or at every one.
    pub fn needs_at_first(&self, quantity: Quantity) -> bool {
        self.needs_at(quantity, &[Samples::Visible, Samples::First])
    }

    /// Whether a halo needs that quantity at samples that are asked for seeds.
    pub fn needs_at_seeds(&self, quantity: Quantity) -> bool {
        self.needs_at(quantity, &[Samples::Seeds])
    }

    /// Whether a material that the volume meets needs that quantity at samples that the volume shades.
    pub fn needs_at_meetings(&self, quantity: Quantity) -> bool {
        self.needs_at(quantity, &[Samples::Meetings])
    }

    /// Whether an effect of the scene needs that quantity at any sample.
    pub fn needs_anywhere(&self, quantity: Quantity) -> bool {
        self.needs_at(quantity, &[Samples::Visible, Samples::First, Samples::Seeds, Samples::Meetings])
    }

    /// Whether all pixels have equally many rays, whatever they show ([RAY-7]).
    pub fn has_equal_rays(&self) -> bool {
        Pass::OF_EQUAL_RAYS.into_iter().any(|pass| self.has_pass(pass))
    }

    fn needs_at(&self, quantity: Quantity, samples: &[Samples]) -> bool {
        self.needs.iter().any(|need| need.quantity == quantity && samples.contains(&need.samples))
    }

    /// Whether an effect of the scene reads a gradient anywhere: at samples, or on the iso-surface.
    pub fn reads_gradients(&self) -> bool {
        self.shows_gradients() || self.needs_at_seeds(Quantity::Gradient)
    }

    /// Whether an effect of the scene reads a gradient where something is seen.
    pub fn shows_gradients(&self) -> bool {
        self.needs_at_first(Quantity::Gradient) || self.needs(Quantity::SurfaceNormal)
    }

    /// Whether something reads the labels of `volume.labels`.
    pub fn reads_labels(&self) -> bool {
        let labels = [Quantity::Label, Quantity::LabelDistance];
        labels.into_iter().any(|quantity| self.needs_anywhere(quantity)) || self.has_pass(Pass::DotLabels)
    }

    /// Whether an effect of the scene needs that pass.
    pub fn has_pass(&self, pass: Pass) -> bool {
        self.passes.iter().any(|need| need.pass == pass)
    }

    /// The plan for a picture's metadata ([IO-2]): effects, their needs, and the keys that asked, one a line. Places
    /// and notes for the author are left out, so that the text depends on the scene alone and not on its file.
    pub fn summary(&self) -> String {
        let needs = self.needs.iter().map(|n| (&n.effect, n.quantity.name(), &n.key));
        let passes = self.passes.iter().map(|p| (&p.effect, p.pass.name(), &p.key));
        let lines = needs.chain(passes).map(|(effect, needs, key)| format!("{effect}: {needs}, because of {key}\n"));
        lines.collect()
    }

    /// Warns if the eye of a perspective view lies in the box of the volume. The part behind the eye is then not seen.
    pub fn warn_eye(&mut self, view: &View, grid: &Grid) {
        let [lo, hi] = grid.index_box();
        let eye = grid.to_index(view.eye);
        if view.perspective && eye.cmpge(lo).all() && eye.cmple(hi).all() {
            let why = "the camera is inside the volume: what lies behind it is not seen; move camera.eye away, or leave \
                       it out for a view of the whole";
            self.warnings.push(why.into());
        }
    }

    /// Warns if the longest distance between samples along a ray exceeds a voxel ([RAY-1]). Both are in world units.
    pub fn warn_step(&mut self, longest_step: f64, voxel: f64) {
        if longest_step > voxel {
            // Digits of a length that nobody means are no help.
            let length = |x: f64| if x < 1e6 { format!("{x:.4}") } else { format!("{x:.4e}") };
            self.warnings.push(format!(
                "samples are up to {} apart along a ray, further than a voxel ({}): structures between them are missed; \
                 make sampling.step smaller",
                length(longest_step),
                length(voxel)
            ));
        }
    }

    /// Warns if contours with the exact factor c miss the silhouette in the corners of a perspective picture ([VS-5]).
    /// The factor is exact at the picture's centre. Angles below a tenth of a degree are not reported.
    pub fn warn_contours(&mut self, scene: &Scene, view: &View) {
        let Some(shading) = scene.shading.as_ref().filter(|_| self.needs(Quantity::GradientMagnitudeRange)) else {
            return;
        };
        let has_contours = shading.lighting_preset().is_some_and(LightingPreset::has_contours);
        if !has_contours || !view.perspective || shading.contour != ContourRule::Exact {
            return;
        }
        let light = view.towards(shading.light.unwrap_or(scene.light));
        let factor = ContourRule::Exact.factor(light.dot(-view.forward));
        let [width, height] = view.size.map(|n| n as f64);
        let corners = [(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)];
        let error = |(i, j)| ContourRule::error(factor, light.dot(view.direction_to_world(view.ray(i, j).v)));
        let largest = corners.map(error).into_iter().fold(0.0, f64::max);
        if largest >= 0.1 {
            self.warnings.push(format!(
                "contours of shading.preset miss the silhouette by up to {largest:.1}° in the picture's corners: they are \
                 exact in its centre; an orthographic camera has no such error"
            ));
        }
    }
}

impl fmt::Display for Plan {
    /// Writes the effect, its needs, the work that they add, and the line of the scene that asked.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let because = |key: &str, place: &Option<Place>| match place {
            Some(Place::File { line, .. }) => format!("{key} (line {line})"),
            Some(Place::Set(_)) => format!("{key} (--set)"),
            Some(Place::Chosen) => format!("{key} (chosen for this volume)"),
            None => format!("{key} (default)"),
        };
        let head = ["effect", "needs", "adds", "because of"].map(String::from);
        let needs = self
            .needs
            .iter()
            .map(|n| [n.effect.clone(), n.quantity.name().into(), n.adds().into(), because(&n.key, &n.place)]);
        let passes = self
            .passes
            .iter()
            .map(|p| [p.effect.clone(), p.pass.name().into(), p.pass.adds().into(), because(&p.key, &p.place)]);
        let rows: Vec<[String; 4]> = std::iter::once(head).chain(needs).chain(passes).collect();
        // Longer names, which a scene may give to objects, stand out of their columns.
        const WIDEST: usize = 200;
        let width: [usize; 4] =
            std::array::from_fn(|i| rows.iter().map(|row| row[i].chars().count().min(WIDEST)).max().unwrap_or(0));
        for [effect, needs, adds, because] in &rows {
            let [a, b, c, _] = width;
            writeln!(f, "{effect:a$}  {needs:b$}  {adds:c$}  {because}")?;
        }
        for NodesPlan { key, within, unit, values } in &self.nodes {
            let lines = values.iter().map(|[at, value]| format!("  {at} is {value}"));
            let within = within.map(|object| format!(" in object[{object}].volume")).unwrap_or_default();
            list(f, &format!("{key} = {unit:?}{within}"), lines)?;
        }
        if let Some(PointsPlan { voxels, each, bytes }) = self.points {
            let points = voxels.saturating_mul(each);
            writeln!(
                f,
                "\npoints\n  {voxels} voxels with {each} each: {points} points, {bytes} bytes while they are made"
            )?;
        }
        let idle = self.idle_keys.iter().map(|key| {
            let place = Some(key.place.clone());
            format!("  {}: {}", because(&key.key, &place), key.why)
        });
        list(f, "without effect", idle)?;
        list(f, "warnings", self.warnings.iter().map(|warning| format!("  {warning}")))
    }
}

fn list(f: &mut fmt::Formatter<'_>, title: &str, lines: impl Iterator<Item = String>) -> fmt::Result {
    for (i, line) in lines.enumerate() {
        if i == 0 {
            writeln!(f, "\n{title}")?;
        }
        writeln!(f, "{line}")?;
    }
    Ok(())
}
