//! What is painted: three spheres on a table, by the light of a window at the upper left.
//!
//! Parallel projection, so that spheres are circles. The world's unit is a pixel; x to the right, y up, z to the viewer;
//! the table is the plane y = 0. A tone is how light a place looks, from 0 (ink) to 1 (paper), as sRGB codes are.

use super::SIZE;
use drypoint::scene::glam::DVec3;
use drypoint::scene::math::{atan2, cos, exp, sin};
use std::f64::consts::{PI, TAU};

/// How far the view looks down, in radians.
const DOWN: f64 = 0.28;

/// Front and back of the table, z.
const TABLE: [f64; 2] = [850.0, -220.0];

/// Half the angle under which the window is seen, as a slope.
const WINDOW: f64 = 0.16;

/// Towards the window.
fn light() -> DVec3 {
    DVec3::new(-0.55, 0.72, 0.5).normalize()
}

/// What a sphere is made of.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Finish {
    /// Matt white.
    Plaster,
    /// A mirror.
    Polished,
    /// Drawn in lines with a pen.
    Hatched,
}

/// A sphere by its circle in the picture; it rests on the table.
#[derive(Clone, Copy)]
pub(super) struct Sphere {
    pub(super) name: &'static str,
    pub(super) finish: Finish,
    /// Middle of the circle, in pixels from the left and from the top.
    pub(super) middle: [f64; 2],
    pub(super) radius: f64,
}

impl Sphere {
    fn centre(&self) -> DVec3 {
        let height = SIZE[1] as f64 / 2.0 - self.middle[1];
        let z = (self.radius * cos(DOWN) - height) / sin(DOWN);
        DVec3::new(self.middle[0] - SIZE[0] as f64 / 2.0, self.radius, z)
    }

    /// The nearest distance ahead at which a ray meets it.
    fn hit(&self, from: DVec3, along: DVec3) -> Option<f64> {
        let to = self.centre() - from;
        let middle = to.dot(along);
        let across = self.radius * self.radius - (to.length_squared() - middle * middle);
        (across > 0.0).then(|| middle - across.sqrt()).filter(|t| *t > 1e-6)
    }
}

/// All that is painted.
pub(super) struct Room<'a> {
    pub(super) spheres: &'a [Sphere],
}

/// A tone, and how the crayon went there: coarsely on the table and the wall, finely on the spheres.
#[derive(Clone, Copy)]
pub(super) struct Tone {
    pub(super) value: f64,
    pub(super) grain: f64,
    /// The direction of the crayon, in radians from the line to the right, y down.
    pub(super) stroke: f64,
}

impl Room<'_> {
    /// What is seen at a place of the picture; `turn` in [0, 1) turns the pattern of shadow rays.
    pub(super) fn at(&self, x: f64, y: f64, turn: f64) -> Tone {
        let along = DVec3::new(0.0, -sin(DOWN), -cos(DOWN));
        let up = DVec3::new(0.0, cos(DOWN), -sin(DOWN));
        let [width, height] = SIZE.map(|n| n as f64);
        let from = DVec3::X * (x - width / 2.0) + up * (height / 2.0 - y) - along * 4000.0;
        if let Some((sphere, t)) = self.first(from, along) {
            let place = from + along * t;
            let n = (place - sphere.centre()) / sphere.radius;
            return match sphere.finish {
                Finish::Plaster => Tone { value: self.plaster(place, n, turn), grain: 0.5, stroke: 0.9 },
                Finish::Polished => Tone { value: self.mirror(place, n, along, turn), grain: 0.3, stroke: 0.2 },
                Finish::Hatched => Tone { value: hatched(n, -along), grain: 0.15, stroke: 0.0 },
            };
        }
        let t = -from.y / along.y;
        let place = from + along * t;
        if place.z < TABLE[1] {
            return Tone { value: wall(x / width, y / height), grain: 0.9, stroke: -0.75 };
        }
        if place.z > TABLE[0] {
            // Below the edge of the table its front is in the shade.
            let below = (place.z - TABLE[0]) * sin(DOWN);
            let lip = if below < 5.0 { 0.34 } else { 0.0 };
            return Tone { value: 0.13 + lip + 0.05 * exp(-below / 30.0), grain: 0.9, stroke: 0.0 };
        }
        Tone { value: self.table(place, turn), grain: 0.8, stroke: 0.03 }
    }

    fn first(&self, from: DVec3, along: DVec3) -> Option<(&Sphere, f64)> {
        let hits = self.spheres.iter().filter_map(|sphere| sphere.hit(from, along).map(|t| (sphere, t)));
        hits.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The share of the window that is seen from a place.
    fn lit(&self, place: DVec3, turn: f64) -> f64 {
        const RAYS: usize = 16;
        let l = light();
        let side = l.cross(DVec3::Y).normalize();
        let other = side.cross(l);
        let free = |k: &usize| {
            // A spiral of even density over a disk.
            let r = ((*k as f64 + 0.5) / RAYS as f64).sqrt() * WINDOW;
            let angle = PI * (3.0 - 5f64.sqrt()) * *k as f64 + TAU * turn;
            let along = (l + side * (r * cos(angle)) + other * (r * sin(angle))).normalize();
            self.spheres.iter().all(|sphere| sphere.hit(place + along * 1e-3, along).is_none())
        };
        (0..RAYS).filter(free).count() as f64 / RAYS as f64
    }

    /// How open the sky is above a place of the table: what each sphere takes of it.
    fn open(&self, place: DVec3) -> f64 {
        let taken = |sphere: &Sphere| {
            let to = sphere.centre() - place;
            let d = to.length();
            (to.y / d).max(0.0) * (sphere.radius / d).powi(2)
        };
        self.spheres.iter().map(|sphere| 1.0 - taken(sphere).min(0.97)).product()
    }

    fn table(&self, place: DVec3, turn: f64) -> f64 {
        // Darker with the distance from the window, and towards the back.
        let falloff = 1.0 - 0.16 * ((place.x + 512.0) / 1024.0).clamp(0.0, 1.0);
        let depth = 1.0 - 0.14 * ((TABLE[0] - place.z) / (TABLE[0] - TABLE[1]));
        (0.22 + 0.1 * self.open(place) + 0.56 * self.lit(place, turn))
            * falloff
            * depth
            * (0.55 + 0.45 * self.open(place))
    }

    fn plaster(&self, place: DVec3, n: DVec3, turn: f64) -> f64 {
        let facing = n.dot(light());
        let direct = if facing > 0.0 { facing * self.lit(place + n * 1e-3, turn) } else { 0.0 };
        // The sky from above, and what comes back from the table into the lower side.
        let sky = 0.5 + 0.5 * n.y;
        let back = (0.5 - 0.5 * n.y) * smooth(-0.1, 0.8, n.dot(DVec3::new(0.45, -0.72, 0.1).normalize()) * 0.5 + 0.4);
        (0.05 + 0.08 * sky + 0.26 * back + 0.84 * smooth(-0.08, 1.0, direct)).min(1.0)
    }

    fn mirror(&self, place: DVec3, n: DVec3, along: DVec3, turn: f64) -> f64 {
        let r = along - n * (2.0 * along.dot(n));
        let from = place + n * 1e-3;
        let seen = match self.first(from, r) {
            Some((sphere, t)) => {
                let hit = from + r * t;
                let m = (hit - sphere.centre()) / sphere.radius;
                match sphere.finish {
                    Finish::Hatched => hatched(m, -r),
                    Finish::Plaster | Finish::Polished => self.plaster(hit, m, turn),
                }
            }
            None if r.y < 0.0 => {
                let hit = from - r * (from.y / r.y);
                let on = hit.z < TABLE[0] && hit.z > TABLE[1] && hit.x.abs() < 620.0;
                // Past its edges there is the floor.
                if on { 0.94 * self.table(hit, turn) } else { 0.1 + 0.08 * (-r.y) }
            }
            None => window(r),
        };
        // The rim of a polished ball mirrors what is behind it, and is a little dull.
        let facing = (-along.dot(n)).clamp(0.0, 1.0);
        0.04 + 0.92 * seen * (0.55 + 0.45 * smooth(0.0, 0.35, facing))
    }
}

/// The wall behind: dark above, lighter where the light of the window falls past the spheres.
fn wall(u: f64, v: f64) -> f64 {
    let (du, dv) = (u - 0.74, v - 0.36);
    0.2 + 0.3 * exp(-(du * du / 0.16 + dv * dv / 0.05)) + 0.1 * v
}

/// The room as a mirror sees it: a window of four panes at the upper left, walls and a ceiling in the half-dark.
fn window(r: DVec3) -> f64 {
    let l = light();
    let side = DVec3::Y.cross(l).normalize();
    let up = l.cross(side);
    let ahead = r.dot(l);
    if ahead > 0.0 {
        let [u, v] = [r.dot(side) / ahead, r.dot(up) / ahead];
        let bar = u.abs() < 0.035 || v.abs() < 0.03;
        if u.abs() < 0.42 && v.abs() < 0.36 {
            return if bar { 0.3 } else { 1.0 };
        }
        if u.abs() < 0.5 && v.abs() < 0.43 {
            return 0.5;
        }
    }
    // Corners of the room, soft, so that the mirror has something upright in it.
    let azimuth = atan2(r.x, r.z);
    let corner = 0.5 + 0.5 * cos(2.0 * azimuth + 0.9);
    0.14 + 0.16 * corner + 0.26 * r.y * r.y
}

/// Parallel lines on a ball, wider where it is darker, and a second set across them in the dark. A function of the
/// normal alone.
fn hatched(n: DVec3, v: DVec3) -> f64 {
    let facing = n.dot(light());
    let dark =
        1.0 - smooth(-0.35, 0.95, facing) - 0.28 * smooth(0.3, 0.95, -n.y + 0.25 * n.x) * smooth(0.2, -0.5, facing);
    let line = |axis: DVec3, lines: f64, width: f64| {
        // Planes through a pole on the far side of the ball draw meridians that follow its form.
        let side = axis.cross(v).normalize();
        let other = side.cross(axis);
        let angle = atan2(n.dot(side), n.dot(other)) / PI * lines;
        let off = (angle - angle.floor() - 0.5).abs() * 2.0;
        1.0 - smooth(width - 0.2, width + 0.2, off)
    };
    let first = line(DVec3::new(0.62, 0.62, -0.3).normalize(), 24.0, 0.86 * dark);
    let second = line(DVec3::new(-0.78, 0.5, -0.2).normalize(), 24.0, 1.3 * (dark - 0.5));
    let rim = smooth(0.26, 0.1, n.dot(v));
    let ink = 1.0 - (1.0 - 0.85 * first * smooth(0.03, 0.16, dark)) * (1.0 - 0.75 * second * smooth(0.5, 0.62, dark));
    0.97 - 0.88 * (1.0 - (1.0 - ink) * (1.0 - 0.9 * rim))
}

/// t²(3 − 2t) between two places, in either order.
pub(super) fn smooth(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
