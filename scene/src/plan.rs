//! What a scene calls for, and why ([PLAN-1], [PLAN-3]). What is not in the plan is not computed.
//!
//! The rules stand with the tables: each says what its effect needs and which line of the scene asked for it. Here
//! they are gathered and closed under what one quantity needs of another.

mod pass;

pub use crate::quantity::Quantity;
pub use pass::Pass;

use crate::file::Place;
use crate::space::Grid;
use crate::tables::Scene;
use crate::tables::scene::sections;
use crate::tables::{GradientEstimator, Kernel};
use crate::view::View;
use std::fmt;

/// A quantity that an effect needs.
#[derive(Clone, Debug, PartialEq)]
pub struct Need {
    /// What is needed.
    pub quantity: Quantity,
    /// Whether only the first visible sample of each ray needs it: layers `first.*` ([IO-6]).
    pub first_only: bool,
    /// The effect that needs it.
    pub effect: String,
    /// The item that needs it, if the effect is one of a list of tables; items count from 0. Needs are closed for the
    /// picture as a whole, so an item's prerequisites may stand with another item.
    pub item: Option<usize>,
    /// The key or table that asked, such as `contours.kappa` or `pen[0].width`.
    pub key: String,
    /// The place of the key in the scene, or else that of the table around it; none for a default.
    pub place: Option<Place>,
}

impl Need {
    /// What it adds to a picture's work.
    pub fn adds(&self) -> &'static str {
        if self.first_only { self.quantity.adds_at_first() } else { self.quantity.adds() }
    }
}

/// A pass that an effect needs.
#[derive(Clone, Debug, PartialEq)]
pub struct PassNeed {
    /// What is needed.
    pub pass: Pass,
    /// Whether only a volume of integers needs it: the scene leaves it to the volume ([`Plan::settle`]).
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
    /// Where the scene says it.
    pub place: Place,
    /// Why it has no effect.
    pub why: String,
}

/// What a scene calls for.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Quantities at samples, ordered by quantity.
    pub needs: Vec<Need>,
    /// Passes, in their order.
    pub passes: Vec<PassNeed>,
    /// Keys without effect.
    pub idle_keys: Vec<IdleKey>,
    /// The points of stipples, where they have been counted.
    pub points: Option<PointsPlan>,
    /// What the picture may lack.
    pub warnings: Vec<String>,
}

/// How many points stipples have, which takes a look at the volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PointsPlan {
    /// Voxels above the threshold.
    pub voxels: u64,
    /// Points of each: N_max, and more in thin layers of voxels that are not cubes ([STIP-3], [STIP-4]).
    pub each: u64,
    /// Bytes while they are made: points, voxels, order.
    pub bytes: u64,
}

impl Plan {
    /// The plan of a scene. It depends on the scene alone; what the scene leaves to the volume is in it until
    /// [`Plan::settle`].
    pub fn new(scene: &Scene) -> Self {
        Self::of(scene, Drawn { volume: scene.draws_volume(), points: true, strokes: true })
    }

    /// The plan of a scene's points and lines alone, whether or not it draws the volume too.
    pub fn of_marks(scene: &Scene) -> Self {
        Self::of(scene, Drawn { volume: false, points: true, strokes: true })
    }

    /// The plan of a scene's stipples alone.
    pub fn of_points(scene: &Scene) -> Self {
        Self::of(scene, Drawn { volume: false, points: true, strokes: false })
    }

    /// The plan of a scene's strokes alone.
    pub fn of_strokes(scene: &Scene) -> Self {
        Self::of(scene, Drawn { volume: false, points: false, strokes: true })
    }

    fn of(scene: &Scene, drawn: Drawn) -> Self {
        let sections = sections(scene);
        let mut asks = Asks { scene, drawn, at: At::default(), needs: Vec::new(), passes: Vec::new() };
        if drawn.volume {
            asks.pass(Pass::Rays, "picture", "picture.samples");
        }
        for (at, section) in &sections {
            asks.at = at.clone();
            (section.asks)(scene, &mut asks);
        }
        asks.close();
        for (at, section) in &sections {
            asks.at = at.clone();
            (section.serves)(scene, &mut asks);
        }
        asks.close();
        asks.needs.sort_by_key(|need| need.quantity);
        asks.passes.sort_by_key(|need| need.pass);
        let (idle_keys, points, warnings) = (Vec::new(), None, Vec::new());
        let mut plan = Self { needs: asks.needs, passes: asks.passes, idle_keys, points, warnings };
        let mut idle = Idle { scene, at: At::default(), keys: Vec::new() };
        for (at, section) in sections {
            idle.at = at;
            (section.idle)(scene, &plan, &mut idle);
        }
        plan.idle_keys = idle.sorted();
        plan.warn_outlines(scene);
        plan
    }

    /// Whether an effect of the scene needs that quantity at every visible sample.
    pub fn needs(&self, quantity: Quantity) -> bool {
        self.needs.iter().any(|need| need.quantity == quantity && !need.first_only)
    }

    /// Whether an effect of the scene needs that quantity at the first visible sample of a ray, or at every one.
    pub fn needs_at_first(&self, quantity: Quantity) -> bool {
        self.needs.iter().any(|need| need.quantity == quantity)
    }

    /// Whether an effect of the scene reads a gradient anywhere: at samples, or on the iso-surface.
    pub fn reads_gradients(&self) -> bool {
        self.needs_at_first(Quantity::Gradient) || self.needs(Quantity::SurfaceNormal)
    }

    /// Whether something reads the labels of `volume.labels`.
    pub fn reads_labels(&self) -> bool {
        self.needs(Quantity::Label) || self.needs(Quantity::LabelDistance) || self.has_pass(Pass::DotLabels)
    }

    /// Whether an effect of the scene needs that pass.
    pub fn has_pass(&self, pass: Pass) -> bool {
        self.passes.iter().any(|need| need.pass == pass)
    }

    /// Takes out what the scene leaves to the volume and this one does not need: smoothing with `hessian = "auto"`, which
    /// is for files of integers ([REC-3]).
    pub fn settle(&mut self, scene: &Scene, integer: bool) {
        if integer || !self.passes.iter().any(|need| need.integer_only) {
            return;
        }
        self.passes.retain(|need| !need.integer_only);
        let mut idle = Idle { scene, at: At::default(), keys: std::mem::take(&mut self.idle_keys) };
        idle.key("sampling.scale", "hessian = \"auto\" smooths integers only, and the file has none");
        self.idle_keys = idle.sorted();
    }

    /// Effects, what they need, and the keys that asked, one a line: the plan as a picture's metadata has it ([IO-2]).
    /// Without places and notes for the author, so that every file that says the same scene has the same.
    pub fn summary(&self) -> String {
        let needs = self.needs.iter().map(|n| (&n.effect, n.quantity.name(), &n.key));
        let passes = self.passes.iter().map(|p| (&p.effect, p.pass.name(), &p.key));
        let lines = needs.chain(passes).map(|(effect, needs, key)| format!("{effect}: {needs}, because of {key}\n"));
        lines.collect()
    }

    /// Warns where outlines follow a gradient that jumps at the faces of cells, the derivative of the trilinear kernel:
    /// N·v changes its sign without being 0 ([HATCH-18], [REC-2]).
    fn warn_outlines(&mut self, scene: &Scene) {
        let sampling = &scene.sampling;
        if self.has_pass(Pass::Outlines)
            && (sampling.kernel, sampling.gradient) == (Kernel::Trilinear, GradientEstimator::Analytic)
        {
            let why = "sampling.gradient = \"analytic\" jumps at the faces of cells with sampling.kernel = \"trilinear\": \
                       outlines are broken there; another gradient or kernel closes them";
            self.warnings.push(why.into());
        }
    }

    /// Warns where the eye of a perspective view lies in the box of the volume: nobody sees what is behind it.
    pub fn warn_eye(&mut self, view: &View, grid: &Grid) {
        let [lo, hi] = grid.index_box();
        let eye = grid.to_index(view.eye);
        if view.perspective && eye.cmpge(lo).all() && eye.cmple(hi).all() {
            let why = "the camera is inside the volume: what lies behind it is not seen; move camera.eye away, or leave \
                       it out for a view of the whole";
            self.warnings.push(why.into());
        }
    }

    /// Warns where the longest distance between samples along a ray exceeds a voxel ([RAY-1]), both in world units.
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
}

/// What of a scene is drawn, as far as it has it.
#[derive(Clone, Copy, Debug)]
struct Drawn {
    volume: bool,
    points: bool,
    strokes: bool,
}

/// A table of a scene, or an item of a list of tables.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct At {
    /// Its key from the top, such as `contours` or `pen[0]`; empty for the top itself.
    pub(crate) key: String,
    /// Its number, if it is an item of a list of tables; items count from 0.
    pub(crate) item: Option<usize>,
}

impl At {
    /// A key of the table, from the top.
    pub(crate) fn inner(&self, key: &str) -> String {
        format!("{}.{key}", self.key)
    }
}

/// Collects what the effects of a scene need.
#[derive(Debug)]
pub(crate) struct Asks<'a> {
    scene: &'a Scene,
    drawn: Drawn,
    /// The table whose hook runs.
    pub(crate) at: At,
    needs: Vec<Need>,
    passes: Vec<PassNeed>,
}

impl Asks<'_> {
    /// An effect needs a quantity at every visible sample, because of a key.
    pub(crate) fn need(&mut self, quantity: Quantity, effect: &str, key: &str) {
        self.need_where(quantity, false, effect, key);
    }

    /// An effect needs a quantity at the first visible sample of each ray alone, or at every one, because of a key.
    pub(crate) fn need_where(&mut self, quantity: Quantity, first_only: bool, effect: &str, key: &str) {
        let place = self.place(key);
        let item = self.at.item;
        self.needs.push(Need { quantity, first_only, effect: effect.into(), item, key: key.into(), place });
    }

    /// An effect needs a pass, because of a key.
    pub(crate) fn pass(&mut self, pass: Pass, effect: &str, key: &str) {
        self.pass_where(pass, false, effect, key);
    }

    /// An effect needs a pass, if the file is of integers or in any case, because of a key.
    pub(crate) fn pass_where(&mut self, pass: Pass, integer_only: bool, effect: &str, key: &str) {
        let place = self.place(key);
        let item = self.at.item;
        self.passes.push(PassNeed { pass, integer_only, effect: effect.into(), item, key: key.into(), place });
    }

    /// Where the scene says a key, or else the table around it.
    fn place(&self, key: &str) -> Option<Place> {
        let outer = key.rsplit_once(['.', '[']).map(|(outer, _)| outer);
        let given = &self.scene.given;
        let said = given.place(key).or_else(|| outer.and_then(|outer| given.place(outer)));
        said.cloned().or_else(|| given.is_chosen(key).then_some(Place::Chosen))
    }

    /// Whether the volume itself is drawn.
    pub(crate) fn casts_rays(&self) -> bool {
        self.passes.iter().any(|need| need.pass == Pass::Rays)
    }

    /// Whether stipples are drawn, if the scene has some.
    pub(crate) fn draws_points(&self) -> bool {
        self.drawn.points
    }

    /// Whether strokes are drawn, if the scene has some.
    pub(crate) fn draws_strokes(&self) -> bool {
        self.drawn.strokes
    }

    /// Whether someone needed a pass.
    pub(crate) fn has_pass(&self, pass: Pass) -> bool {
        self.passes.iter().any(|need| need.pass == pass)
    }

    /// The first that needed a quantity, if anyone does.
    pub(crate) fn first(&self, quantity: Quantity) -> Option<&Need> {
        self.needs.iter().find(|need| need.quantity == quantity)
    }

    /// Adds what the needed quantities are made of, for whoever needed them first: where they are needed.
    fn close(&mut self) {
        for (quantity, first_only) in Quantity::ALL.into_iter().rev().flat_map(|q| [(q, false), (q, true)]) {
            let is = |need: &Need, quantity| need.quantity == quantity && need.first_only == first_only;
            let need = self.needs.iter().find(|need| is(need, quantity));
            if let (Some(need), Some(prerequisite)) = (need, quantity.prerequisite())
                && !self.needs.iter().any(|n| is(n, prerequisite) || (n.quantity == prerequisite && !n.first_only))
            {
                let need = Need { quantity: prerequisite, ..need.clone() };
                self.needs.push(need);
            }
        }
    }
}

/// Collects keys without effect.
#[derive(Debug)]
pub(crate) struct Idle<'a> {
    scene: &'a Scene,
    /// The table whose hook runs.
    pub(crate) at: At,
    keys: Vec<IdleKey>,
}

impl Idle<'_> {
    /// Whether the scene says a key or table.
    pub(crate) fn says(&self, key: &str) -> bool {
        self.scene.given.contains(key)
    }

    /// In the order of the scene.
    fn sorted(mut self) -> Vec<IdleKey> {
        self.keys.sort_by(|a, b| (&a.place, &a.key).cmp(&(&b.place, &b.key)));
        self.keys
    }

    /// Lists a key or table that has no effect, if the scene says it.
    pub(crate) fn key(&mut self, key: &str, why: &str) {
        if let Some(place) = self.scene.given.place(key) {
            self.keys.push(IdleKey { key: key.into(), place: place.clone(), why: why.into() });
        }
    }
}

impl fmt::Display for Plan {
    /// Effect, what it needs, what that adds, and which line of the scene asked.
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
        let width: [usize; 4] =
            std::array::from_fn(|i| rows.iter().map(|row| row[i].chars().count()).max().unwrap_or(0));
        for [effect, needs, adds, because] in &rows {
            let [a, b, c, _] = width;
            writeln!(f, "{effect:a$}  {needs:b$}  {adds:c$}  {because}")?;
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

#[cfg(test)]
mod tests;
