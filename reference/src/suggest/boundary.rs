//! Selection of the surfaces in a volume's first picture.

use super::levels::{LEVELS, Level, Levels};
use drypoint_scene::shot::Outside;
use drypoint_scene::volume::Volume;

/// A surface to show, in data values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ValueSurface {
    /// The value that separates inside from outside.
    pub value: f64,
    /// The change of the values in one voxel across the surface, at least a few levels.
    pub step: f64,
}

/// The surfaces of a first picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FirstSurfaces {
    /// The opaque surface: the content's own, or one inside the content.
    pub main: ValueSurface,
    /// A translucent hull, if there is something inside it.
    pub hull: Option<ValueSurface>,
    /// Whether the content consists of thin parts: vessels, shells, flames.
    pub thin: bool,
    /// Whether most of the opaque surface's rise happens within a voxel. The trilinear kernel shows the cells there as teeth.
    pub steep: bool,
}

/// A local maximum of the score.
#[derive(Clone, Copy, Debug)]
struct ScorePeak {
    /// Distance from the outside, as a share of the range.
    share: f64,
    score: f64,
    level: Level,
}

/// Number of levels to either side above which a maximum stands.
const REACH: usize = 6;
/// Least score and strength of a surface, as shares of the best ones.
const SIGNIFICANT: [f64; 2] = [0.15, 0.1];
/// Least share of the voxels that content fills.
const SOMETHING: f64 = 1e-3;
/// Share of the box's faces above which a cut surface is a view of the box.
const BOXED: f64 = 0.5;
/// Share of the box's faces below which a surface counts as not cut by the box.
const FREE: f64 = 0.1;
/// Dark content is accepted if its surface has this many times the score of every bright one.
const BETTER: f64 = 2.0;
/// Least ratio of the volumes inside two surfaces that belong to one body.
const SAME_BODY: f64 = 0.6;
/// A kernel's share of its hull's volume.
const KERNEL: [f64; 2] = [0.05, 0.5];
/// Simplicity below which a kernel is clutter, and a body consists of thin parts.
const CLUTTER: f64 = 1.0 / 70.0;
const THIN: f64 = 1.0 / 35.0;
/// Agreement below which a kernel is noise.
const NOISE: f64 = 0.3;
/// Least agreement of a field for which a lower value is worth showing around its main surface.
const SMOOTH: f64 = 0.94;
/// Volume of such a field's hull, as a multiple of the main surface's.
const HULL: f64 = 2.2;
/// Largest share of the box that the hull fills. The walls of the box would cut a larger one.
const ROOM: f64 = 0.3;
/// Least step, as a share of the range. A ramp across one or two integers would show the rounding.
const LEAST_STEP: f64 = 0.03;
/// Share of the range above which a change in one voxel across a surface is steep.
const STEEP: f64 = 0.3;
/// Least distance of a surface from the outermost and the innermost value, as a share of its step.
const EDGE: f64 = 0.5;
/// Skin against air, and bone, in Hounsfield units.
const SKIN_AND_BONE: [f64; 2] = [-350.0, 190.0];

impl FirstSurfaces {
    /// Finds the surfaces of a volume with an unknown outside. Low values are outside, unless high values surround a
    /// better surface of low ones.
    pub(super) fn judge(levels: Option<&Levels>, volume: &Volume) -> (Self, Outside) {
        let dark = levels.map(Levels::mirrored).filter(|mirrored| {
            let known = levels.is_some_and(|levels| skin_and_bone(volume, Outside::Low, levels).is_some());
            !known && is_surrounded(&peaks(mirrored), levels.map(peaks).as_deref().unwrap_or_default())
        });
        match dark {
            Some(mirrored) => (Self::find(Some(&mirrored), volume, Outside::High), Outside::High),
            None => (Self::find(levels, volume, Outside::Low), Outside::Low),
        }
    }

    /// Finds the surfaces with the greatest product of area, squared sharpness and simplicity. Sharpness excludes
    /// noise, simplicity excludes clutter, and the box must not cut much of the surface. The outermost one is the
    /// content's. One inside it, with a part of its volume, is the kernel that shows through it.
    pub(super) fn find(levels: Option<&Levels>, volume: &Volume, outside: Outside) -> Self {
        let Some(levels) = levels else {
            // A constant volume: everything is content.
            let [value, _] = volume.range();
            // The nodes around the value must be finite numbers, too.
            let step = value.abs().max(1.0).min(2.0 * (f64::MAX - value.abs()));
            let main = ValueSurface { value, step };
            return Self { main, hull: None, thin: false, steep: false };
        };
        if let Some(known) = skin_and_bone(volume, outside, levels) {
            return known;
        }
        let peaks = peaks(levels);
        let body = body(&peaks).unwrap_or(ScorePeak { share: 0.5, score: 0.0, level: *levels.at(0.5) });
        let surface = |share| surface(levels, share);
        let thin = body.level.simplicity < THIN;
        let steep = |level: &Level| level.step > STEEP && level.agreement > NOISE;
        if let Some(kernel) = kernel(&peaks, &body) {
            let (main, hull) = (surface(kernel.share), Some(surface(body.share)));
            return Self { main, hull, thin, steep: steep(&kernel.level) };
        }
        let hull = hull(levels, &body).map(surface);
        Self { main: surface(body.share), hull, thin, steep: steep(&body.level) }
    }

    /// The surface at which content begins: the hull, or the main surface.
    pub(super) fn outermost(&self) -> ValueSurface {
        self.hull.unwrap_or(self.main)
    }
}

fn surface(levels: &Levels, share: f64) -> ValueSurface {
    let step = levels.at(share).step.max(LEAST_STEP);
    // Content that is cut out of a background of one value has an edge that rises in one voxel, and every value of
    // the rise is an edge. A value well above the bottom is the smoothest, and only below the top is something inside
    // visible.
    let share = share.max(EDGE * step).min(1.0 - EDGE * step);
    let step = step.min(share.min(1.0 - share) / EDGE);
    ValueSurface { value: levels.value(share), step: levels.difference(step) }
}

/// Whether the best surface that the box hardly cuts is better than the best one from the other side.
fn is_surrounded(dark: &[ScorePeak], bright: &[ScorePeak]) -> bool {
    let best = |peaks: &[ScorePeak]| peaks.iter().map(|peak| peak.score).fold(0.0, f64::max);
    body(dark).is_some_and(|body| body.level.cut < FREE) && best(dark) > BETTER * best(bright)
}

/// The surfaces of a patient's CT, recognized by its scale, on which skin and bone are known.
fn skin_and_bone(volume: &Volume, outside: Outside, levels: &Levels) -> Option<FirstSurfaces> {
    let [lo, hi] = volume.range();
    let hounsfield = volume.anatomy().is_some() && lo < -900.0 && hi > 500.0 && outside == Outside::Low;
    let [skin, bone] = SKIN_AND_BONE.map(|value| (value, levels.share(value)));
    // A scan that is cut out of a body has no skin to show, and a wax head has no bone.
    let whole = hounsfield && levels.at(skin.1).cut < BOXED && levels.at(bone.1).inside > SOMETHING;
    let [hull, main] = [skin, bone].map(|(value, share)| ValueSurface { value, ..surface(levels, share) });
    whole.then_some(FirstSurfaces { main, hull: Some(hull), thin: false, steep: false })
}

/// Area times (step · agreement)², weighted. The weights favour surfaces that enclose much with little area and that
/// the box does not cut.
fn score(level: &Level) -> f64 {
    let open = 1.0 - level.cut;
    strength(level) * level.simplicity * level.simplicity.sqrt() * (open * open) * (open * open)
}

fn strength(level: &Level) -> f64 {
    let confirmed = level.step * level.agreement;
    level.area * (confirmed * confirmed)
}

/// Local maxima of the smoothed score, from the outside inwards.
fn peaks(levels: &Levels) -> Vec<ScorePeak> {
    let scores: Vec<f64> = levels.all().iter().map(score).collect();
    let mean = |b: usize| {
        let near = &scores[b.saturating_sub(3)..(b + 4).min(LEVELS)];
        near.iter().sum::<f64>() / near.len() as f64
    };
    let smooth: Vec<f64> = (0..LEVELS).map(mean).collect();
    let most = |range: &[f64]| range.iter().copied().fold(0.0, f64::max);
    let strongest = levels.all().iter().map(strength).fold(0.0, f64::max);
    let all: Vec<ScorePeak> = (0..LEVELS)
        .filter(|&b| {
            let (before, after) = (b.saturating_sub(REACH)..b, b + 1..(b + 1 + REACH).min(LEVELS));
            smooth[b] >= most(&smooth[before]) && smooth[b] > most(&smooth[after])
        })
        .map(|b| ScorePeak { share: (b as f64 + 1.0) / LEVELS as f64, score: smooth[b], level: levels.all()[b] })
        .filter(|peak| peak.level.inside > SOMETHING && strength(&peak.level) > SIGNIFICANT[1] * strongest)
        .collect();
    let open: Vec<ScorePeak> = all.iter().filter(|peak| peak.level.cut < BOXED).copied().collect();
    let mut chosen = if open.is_empty() { all } else { open };
    let best = chosen.iter().map(|peak| peak.score).fold(0.0, f64::max);
    chosen.retain(|peak| peak.score >= SIGNIFICANT[0] * best);
    chosen
}

/// The outermost surface; of several around nearly the same volume, the best.
fn body(peaks: &[ScorePeak]) -> Option<ScorePeak> {
    let first = peaks.first()?;
    let of_the_body = peaks.iter().filter(|peak| peak.level.inside >= SAME_BODY * first.level.inside);
    of_the_body.copied().reduce(|best, peak| if peak.score > best.score { peak } else { best })
}

/// The best surface well inside the body.
fn kernel(peaks: &[ScorePeak], body: &ScorePeak) -> Option<ScorePeak> {
    let [least, most] = KERNEL.map(|share| share * body.level.inside);
    let inside = peaks.iter().filter(|peak| {
        let clear = peak.level.simplicity > CLUTTER && peak.level.agreement > NOISE;
        peak.share > body.share && clear && (least..=most).contains(&peak.level.inside)
    });
    inside.copied().reduce(|best, peak| if peak.score > best.score { peak } else { best })
}

/// A lower value of a smooth field whose surface lies well around the body's and is as simple.
fn hull(levels: &Levels, body: &ScorePeak) -> Option<f64> {
    if body.level.agreement < SMOOTH {
        return None;
    }
    let share = (1..LEVELS)
        .rev()
        .map(|b| b as f64 / LEVELS as f64)
        .find(|&share| share < body.share && levels.at(share).inside >= HULL * body.level.inside)?;
    let level = levels.at(share);
    let free = level.inside < ROOM && levels.at(share - LEAST_STEP).cut < 0.01;
    let clear = free && level.simplicity >= body.level.simplicity && level.agreement >= SMOOTH;
    clear.then_some(share)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{radius, volume};
    use super::*;
    use drypoint_scene::volume::Anatomy;

    fn find(volume: &Volume, outside: Outside) -> FirstSurfaces {
        FirstSurfaces::find(Levels::of(volume, outside).as_ref(), volume, outside)
    }

    fn edge(d: f64) -> f64 {
        1.0 / (1.0 + (-d / 0.7).exp())
    }

    #[test]
    fn a_ball_in_noise_is_found_between_the_two() {
        // A deterministic ripple of ±5 around 20 outside and around 200 inside.
        let ripple = |p: [usize; 3]| ((p[0] * 7 + p[1] * 13 + p[2] * 29) % 11) as f64 - 5.0;
        let ball = volume(|p| ripple(p) + if radius(p) < 10.0 { 200.0 } else { 20.0 });
        let b = find(&ball, Outside::Low);
        assert!(b.main.value > 25.0 && b.main.value < 195.0 && b.hull.is_none() && !b.thin, "{b:?}");
    }

    #[test]
    fn a_kernel_inside_a_shell_is_shown_through_it() {
        let nested = |p| 100.0 * edge(13.0 - radius(p)) + 100.0 * edge(7.0 - radius(p));
        let b = find(&volume(nested), Outside::Low);
        let hull = b.hull.unwrap();
        assert!(hull.value > 20.0 && hull.value < 80.0 && b.main.value > 110.0 && b.main.value < 190.0, "{b:?}");
        // Mirrored values give the same surfaces.
        let mirrored = find(&volume(|p| -nested(p)), Outside::High);
        assert!((mirrored.main.value + b.main.value).abs() < 1.0 && mirrored.hull.is_some(), "{mirrored:?}");
    }

    fn judge(volume: &Volume) -> (FirstSurfaces, Outside) {
        FirstSurfaces::judge(Levels::of(volume, Outside::Low).as_ref(), volume)
    }

    #[test]
    fn dark_content_in_bright_surroundings_is_content() {
        let ripple = |p: [usize; 3]| ((p[0] * 7 + p[1] * 13 + p[2] * 29) % 11) as f64 - 5.0;
        let fields: [&dyn Fn([usize; 3]) -> f64; 4] = [
            &|p| 90.0 * edge(10.0 - radius(p)),
            &|p| 150.0 * edge(10.0 - radius(p)) + ripple(p),
            &|p| 10.0 - radius(p),
            &|p| 100.0 * edge(12.0 - radius(p)) + 100.0 * edge(6.0 - radius(p)),
        ];
        for (i, field) in fields.into_iter().enumerate() {
            let (bright, outside) = judge(&volume(field));
            let (dark, mirrored) = judge(&volume(|p| 200.0 - field(p)));
            assert_eq!((outside, mirrored), (Outside::Low, Outside::High), "{i}");
            // A level of 256 where a value lies on the border of two.
            let near = |a: ValueSurface, b: ValueSurface| {
                (a.value + b.value - 200.0).abs() < 1.0 && (a.step - b.step).abs() < 1.0
            };
            assert!(near(bright.main, dark.main), "{i}: {bright:?} {dark:?}");
            assert_eq!((bright.hull.is_some(), bright.thin), (dark.hull.is_some(), dark.thin), "{i}");
        }
    }

    #[test]
    fn surfaces_lie_between_the_values() {
        let grid = drypoint_scene::space::Grid::with_spacing([2; 3], [1.0; 3]).unwrap();
        let sums = (0..8).map(|i| 100 * (i % 2 + i / 2 % 2 + i / 4)).collect();
        let corner = Volume::new(grid, drypoint_scene::volume::Voxels::I16(sums), 1.0, 0.0).unwrap();
        // One neighbour differs from the next by 100: half of that below 300.
        let (b, _) = judge(&corner);
        assert!(b.main.value + 0.5 * b.main.step <= 300.0 + 1e-9, "{b:?}");
        // Nodes are finite even if the difference of the values overflows.
        for huge in [volume(|p| if radius(p) < 9.0 { 1.7e308 } else { -1.7e308 }), volume(|_| f64::MAX)] {
            let main = judge(&huge).0.main;
            assert!([-0.1, 0.25].iter().all(|steps| (main.value + steps * main.step).is_finite()), "{main:?}");
        }
    }

    #[test]
    fn a_constant_volume_is_all_content() {
        let b = find(&volume(|_| 7.0), Outside::Low);
        assert!(b.main.value == 7.0 && b.main.step > 0.0 && b.hull.is_none());
    }

    #[test]
    fn what_fills_the_box_is_looked_into() {
        // Tissue up to the walls, with a hole that is sharper than the dense ball in it.
        let centred = |p: [usize; 3], at: usize| (0..3).map(|a| (p[a] as f64 - at as f64).powi(2)).sum::<f64>().sqrt();
        let v = volume(|p| 100.0 - 100.0 * edge(4.0 - centred(p, 8)) + 60.0 * edge(6.0 - centred(p, 20)));
        let b = find(&v, Outside::Low);
        assert!(b.outermost().value > 105.0 && b.outermost().value < 155.0, "{b:?}");
    }

    #[test]
    fn skin_and_bone_are_known_on_the_scale_of_hounsfield() {
        let patient = volume(|p| match radius(p) {
            r if r < 5.0 => 900.0,
            r if r < 13.0 => 40.0,
            _ => -1000.0,
        });
        let b = find(&patient.clone().with_anatomy(Some(Anatomy::LeftPosteriorSuperior)), Outside::Low);
        assert_eq!((b.hull.map(|hull| hull.value), b.main.value), (Some(-350.0), 190.0));
        // Without a patient the numbers mean nothing.
        assert_ne!(find(&patient, Outside::Low).main.value, 190.0);
    }
}
