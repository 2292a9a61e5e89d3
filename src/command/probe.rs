//! The verb `probe`: value, derivatives and curvature at points.

use super::input::{self, KeyFlag, SetArgs};
use super::raw::RawArgs;
use super::report::{Progress, print};
use super::{Outcome, Talk};
use crate::picking::room_to_probe;
use crate::reference::field::probe::{Probe as Probed, at_index, at_world};
use crate::reference::field::{Field, HessianEstimator, Reconstruction, Rung};
use crate::scene::glam::DVec3;
use crate::scene::memory::Metered;
use crate::scene::space::Grid;
use crate::{Failure, Failures};
use clap::{Args, ValueEnum};
use serde_json::json;
use std::io::{BufRead, Read};
use std::path::PathBuf;

/// Print value, gradient, Hessian, normal and curvatures at points, as one JSON array.
///
/// hessian_estimator names the estimator behind hessian, k1, k2, e1, e2, mean, gaussian and kv. At a point without a
/// normal, normal, e1 and e2 are null and the curvatures are 0.
#[derive(Debug, Args)]
pub(super) struct ProbeArgs {
    /// Volume file
    #[arg(value_name = "VOLUME")]
    volume: PathBuf,
    /// Points to evaluate [default: one on each line of standard input]
    #[arg(long, value_name = "X,Y,Z", num_args = 1.., value_parser = vector)]
    at: Vec<DVec3>,
    /// Space of the points; derivatives are always in world units
    #[arg(long, value_enum, default_value_t = Space::World)]
    space: Space,
    /// Direction towards the eye in world space; adds kv, the curvature along it
    #[arg(long, value_name = "X,Y,Z", value_parser = direction)]
    view: Option<DVec3>,
    /// Kernel: trilinear, bspline, bspline-smooth, bspline5 or catmull-rom
    #[arg(long, value_name = "NAME", default_value = "trilinear")]
    kernel: String,
    /// Gradient estimator: central, analytic, sobel or regression
    #[arg(long, value_name = "NAME", default_value = "central")]
    gradient: String,
    /// Hessian estimator: auto, analytic, central or gaussian
    #[arg(long, value_name = "NAME", default_value = "auto")]
    hessian: String,
    /// σ of the gaussian Hessian, in world units or with a unit, such as "2 voxels"
    #[arg(long, value_name = "LENGTH", default_value = "1 voxel")]
    scale: String,
    /// Values outside of surfaces: low or high
    #[arg(long, value_name = "NAME", default_value = "low")]
    outside: String,
    #[command(flatten)]
    raw: RawArgs,
}

/// The space of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Space {
    /// Coordinates of the volume file
    World,
    /// Voxel indices from 0; integers are voxel centres
    Index,
}

impl ProbeArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        // The options go through the walker of scenes, which checks them.
        let settings = input::settings(
            &SetArgs::default(),
            vec![
                KeyFlag::name("sampling.kernel", "--kernel", &self.kernel),
                KeyFlag::name("sampling.gradient", "--gradient", &self.gradient),
                KeyFlag::name("sampling.hessian", "--hessian", &self.hessian),
                KeyFlag::length("sampling.scale", "--scale", &self.scale),
                KeyFlag::name("volume.outside", "--outside", &self.outside),
            ],
        )?;
        let points = if self.at.is_empty() { from_input()? } else { self.at.clone() };
        let _working = Progress::new(talk, "probing");
        let volume = self.raw.read(&self.volume)?;
        let refused = |fault: &dyn std::fmt::Display| {
            Failure::new(fault, self.volume.display(), "choose another --kernel, --hessian or --scale")
        };
        let sampling = settings.sampling;
        let how = Reconstruction {
            kernel: sampling.kernel,
            gradient: sampling.gradient,
            hessian: sampling.hessian,
            scale: sampling.scale.world(volume.grid()).ok_or_else(|| refused(&"--scale is no length in the volume"))?,
            outside: settings.volume.outside,
        };
        room_to_probe(&volume, &how).map_err(|no_room| {
            let what = format!("the coefficients of the volume need {no_room}");
            Failure::new(what, self.volume.display(), "crop or downsample the volume first")
        })?;
        let field = Field::<f64>::new(&volume, how, Rung::Hessian).map_err(|e| refused(&e))?;
        let probe = |point: DVec3| match self.space {
            Space::Index => at_index(&field, point, self.view),
            Space::World => at_world(&field, point, self.view),
        };
        let outside = points.iter().filter(|point| probe(**point).is_none()).take(TOLD);
        Failures::check(outside.map(|point| self.outside_of(volume.grid(), *point)))?;
        // Output has a point a line and is printed in blocks of some thousand bytes.
        let mut text = String::from("[");
        for (i, probed) in points.iter().filter_map(|point| probe(*point)).enumerate() {
            text += if i > 0 { ",\n" } else { "\n" };
            text += &object(&probed, field.hessian_estimator()).to_string();
            if text.len() > PRINTED {
                print(&text)?;
                text.clear();
            }
        }
        print(&(text + "\n]\n"))
    }

    fn outside_of(&self, grid: &Grid, point: DVec3) -> Failure {
        let text = |v: DVec3| format!("{},{},{}", v.x, v.y, v.z);
        let [lo, hi] = grid.index_box();
        let what = match self.space {
            Space::Index => format!("the point {} lies outside the volume", text(point)),
            Space::World => {
                let index = text(grid.to_index(point));
                format!("the point {}, {index} in index space, lies outside the volume", text(point))
            }
        };
        let remedy = format!("in index space the volume reaches from {} to {}", text(lo), text(hi));
        Failure::new(what, self.volume.display(), remedy)
    }
}

/// Longest line of standard input, in bytes. It holds three numbers with every digit that an f64 can have, and blanks.
const LINE: u64 = 4096;

/// Bytes of memory for each byte of standard input. The shortest point has 6 bytes. It becomes a vector in a list that
/// may have grown to twice the needed size.
const POINT_PER_BYTE: u64 = 12;

/// Largest number of points that are reported one by one.
const TOLD: usize = 20;

/// Size of a block of output, in bytes.
const PRINTED: usize = 1 << 16;

/// Reads points from standard input, one on each line. Returns failures for the first bad lines.
fn from_input() -> Result<Vec<DVec3>, Failures> {
    let (mut points, mut failures) = (Vec::new(), Vec::new());
    let mut input = std::io::BufReader::new(Metered::new(std::io::stdin().lock(), POINT_PER_BYTE));
    let mut line = Vec::new();
    for i in 1.. {
        let place = format!("standard input, line {i}");
        line.clear();
        let read = (&mut input).take(LINE).read_until(b'\n', &mut line);
        let n = read.map_err(|error| Failure::new(error, &place, "give fewer points at once"))?;
        if n == 0 || failures.len() == TOLD {
            break;
        }
        if n as u64 == LINE {
            let what = format!("the line has {LINE} bytes or more, and a point is three numbers");
            failures.push(Failure::new(what, place, "give a point a line, as X,Y,Z"));
            break;
        }
        let text = String::from_utf8_lossy(&line);
        match vector(text.trim()) {
            _ if text.trim().is_empty() => {}
            Ok(point) => points.push(point),
            Err(expected) => failures.push(Failure::new(format!("{:?} is no point", text.trim()), place, expected)),
        }
    }
    Failures::check(failures).map(|()| points)
}

/// Parses three finite numbers, separated by commas or spaces.
fn vector(text: &str) -> Result<DVec3, &'static str> {
    let parts: Result<Vec<f64>, _> =
        text.split([',', ' ', '\t']).filter(|s| !s.is_empty()).map(str::parse::<f64>).collect();
    match parts.as_deref() {
        Ok([x, y, z]) if x.is_finite() && y.is_finite() && z.is_finite() => Ok(DVec3::new(*x, *y, *z)),
        _ => Err("a point is three numbers, as X,Y,Z"),
    }
}

/// Parses three numbers, not all 0.
fn direction(text: &str) -> Result<DVec3, &'static str> {
    vector(text).ok().filter(|v| *v != DVec3::ZERO).ok_or("a direction is three numbers that are not all 0, as X,Y,Z")
}

/// Returns a point as the JSON object that `probe` prints.
fn object(p: &Probed, estimator: HessianEstimator) -> serde_json::Value {
    let three = |v: DVec3| json!([v.x, v.y, v.z]);
    let h = p.hessian;
    let row = |i: usize| three(h.row(i));
    let mut object = json!({
        "value": p.value,
        "gradient": three(p.gradient),
        "hessian": [row(0), row(1), row(2)],
        "hessian_estimator": estimator,
        "normal": p.normal.map(three),
        "k1": p.k1,
        "k2": p.k2,
        "e1": p.e1.map(three),
        "e2": p.e2.map(three),
        "mean": p.mean,
        "gaussian": p.gaussian,
    });
    if let (Some(kv), Some(object)) = (p.kv, object.as_object_mut()) {
        object.insert("kv".into(), json!(kv));
    }
    object
}
