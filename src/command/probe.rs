//! `probe`: value, derivatives and curvature at points.

use super::Outcome;
use super::report::print;
use clap::{Args, ValueEnum};
use drypoint::Failure;
use drypoint::reference::field::probe::{Probe as Probed, at_index};
use drypoint::reference::field::{Field, GradientEstimator, HessianEstimator, Kernel, Outside, Reconstruction, Rung};
use drypoint::scene::glam::DVec3;
use drypoint::scene::volume::read;
use serde_json::json;
use std::io::BufRead;
use std::path::PathBuf;

/// Print value, gradient, Hessian, normal and curvatures at points, as one JSON array.
#[derive(Debug, Args)]
pub(super) struct Probe {
    /// A volume
    #[arg(value_name = "VOLUME")]
    volume: PathBuf,
    /// A point; without one, points come from standard input, one a line
    #[arg(long, value_name = "X,Y,Z", num_args = 1.., allow_hyphen_values = true)]
    at: Vec<String>,
    /// The space of the points; derivatives are always in world units
    #[arg(long, value_enum, default_value_t = Space::World)]
    space: Space,
    /// The direction towards the eye, in world space, for the curvature along it
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    view: Option<String>,
    /// Kernel
    #[arg(long, value_enum, default_value_t = KernelName::Trilinear)]
    kernel: KernelName,
    /// Gradient estimator
    #[arg(long, value_enum, default_value_t = GradientName::Central)]
    gradient: GradientName,
    /// Hessian estimator
    #[arg(long, value_enum, default_value_t = HessianName::Auto)]
    hessian: HessianName,
    /// σ of the gaussian Hessian, in world units [default: one voxel]
    #[arg(long, value_name = "LENGTH")]
    scale: Option<f64>,
    /// Which values lie outside
    #[arg(long, value_enum, default_value_t = OutsideName::Low)]
    outside: OutsideName,
}

macro_rules! names {
    ($name:ident of $type:ty { $($variant:ident $text:literal = $value:expr;)* }) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
        enum $name { $(#[value(name = $text)] $variant,)* }
        impl From<$name> for $type {
            fn from(name: $name) -> Self {
                match name { $($name::$variant => $value,)* }
            }
        }
    };
}

/// The space of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Space {
    World,
    Index,
}

names!(KernelName of Kernel {
    Trilinear "trilinear" = Kernel::Trilinear;
    Bspline "bspline" = Kernel::Bspline;
    BsplineSmooth "bspline-smooth" = Kernel::BsplineSmooth;
    Bspline5 "bspline5" = Kernel::Bspline5;
    CatmullRom "catmull-rom" = Kernel::CatmullRom;
});
names!(GradientName of GradientEstimator {
    Central "central" = GradientEstimator::Central;
    Analytic "analytic" = GradientEstimator::Analytic;
    Sobel "sobel" = GradientEstimator::Sobel;
    Regression "regression" = GradientEstimator::Regression;
});
names!(HessianName of HessianEstimator {
    Auto "auto" = HessianEstimator::Auto;
    Analytic "analytic" = HessianEstimator::Analytic;
    Central "central" = HessianEstimator::Central;
    Gaussian "gaussian" = HessianEstimator::Gaussian;
});
names!(OutsideName of Outside {
    Low "low" = Outside::Low;
    High "high" = Outside::High;
});

impl Probe {
    pub(super) fn run(self) -> Outcome {
        let points = self.points()?;
        let view = self.view.as_deref().map(|text| vector(text, "--view")).transpose()?;
        if view.is_some_and(|v| v.length() == 0.0) {
            return Err(
                Failure::new("the view direction has no length", "--view", "give a direction such as 0,0,1").into()
            );
        }
        let volume = read::read(&self.volume, None).map_err(|e| Failure::new(e.what(), e.place(), e.remedy()))?;
        let how = Reconstruction {
            kernel: self.kernel.into(),
            gradient: self.gradient.into(),
            hessian: self.hessian.into(),
            scale: self.scale.unwrap_or_else(|| volume.grid().voxel()),
            outside: self.outside.into(),
        };
        let refused = |e: &dyn std::fmt::Display| {
            Failure::new(e, self.volume.display(), "choose another --kernel, --hessian or --scale")
        };
        let field = Field::<f64>::new(&volume, how, Rung::Hessian).map_err(|e| refused(&e))?;
        let mut objects = Vec::new();
        for point in points {
            let index = match self.space {
                Space::Index => point,
                Space::World => volume.grid().to_index(point),
            };
            let probed = at_index(&field, index, view).ok_or_else(|| {
                let [lo, hi] = volume.grid().index_box();
                Failure::new(
                    "the point lies outside the volume",
                    format!("point {},{},{}", point.x, point.y, point.z),
                    format!("in index space the volume reaches from {lo} to {hi}"),
                )
            })?;
            objects.push(object(&probed, field.hessian_estimator()));
        }
        print(&format!("{:#}\n", serde_json::Value::Array(objects)))
    }

    /// The points of the command line, or of standard input.
    fn points(&self) -> Result<Vec<DVec3>, Failure> {
        if !self.at.is_empty() {
            return self.at.iter().map(|text| vector(text, "--at")).collect();
        }
        let mut points = Vec::new();
        for (i, line) in std::io::stdin().lock().lines().enumerate() {
            let place = format!("standard input, line {}", i + 1);
            let line = line.map_err(|e| Failure::new("standard input cannot be read", &place, e))?;
            if !line.trim().is_empty() {
                points.push(vector(&line, &place)?);
            }
        }
        Ok(points)
    }
}

/// Three finite numbers, separated by commas or spaces.
fn vector(text: &str, place: &str) -> Result<DVec3, Failure> {
    let parts: Result<Vec<f64>, _> =
        text.split([',', ' ', '\t']).filter(|s| !s.is_empty()).map(str::parse::<f64>).collect();
    match parts.as_deref() {
        Ok([x, y, z]) if x.is_finite() && y.is_finite() && z.is_finite() => Ok(DVec3::new(*x, *y, *z)),
        _ => Err(Failure::new(format!("`{}` is no point", text.trim()), place, "write three numbers as X,Y,Z")),
    }
}

/// One point as the JSON object that `probe` prints.
fn object(p: &Probed, estimator: HessianEstimator) -> serde_json::Value {
    let three = |v: DVec3| json!([v.x, v.y, v.z]);
    let h = p.hessian;
    let row = |i: usize| three(h.row(i));
    let mut object = json!({
        "value": p.value,
        "gradient": three(p.gradient),
        "hessian": [row(0), row(1), row(2)],
        "hessian_estimator": format!("{estimator:?}").to_lowercase(),
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
