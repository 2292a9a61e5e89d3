//! The JSON object of `--stats` ([PLAN-2]).

use crate::Failure;
use crate::cost::median;
use crate::scene::counts::Counts;
use serde_json::{Map, Value, json};

/// Times of the frames of `--repeat`.
pub(super) struct FrameTimes {
    /// Seconds of each frame, in ascending order; at least one.
    wall: Vec<f64>,
    /// Processor seconds of all frames together, if the system reports them.
    cpu: Option<f64>,
}

impl FrameTimes {
    /// Collects the seconds of each frame, at least one, and the processor seconds of all.
    pub(super) fn new(mut wall: Vec<f64>, cpu: Option<f64>) -> Self {
        wall.sort_by(f64::total_cmp);
        Self { wall, cpu }
    }
}

/// Returns the counts on one line, with `times` if frames were repeated. Work that was not done has the count 0 and is
/// never left out.
pub(super) fn line(mut counts: Counts, times: Option<&FrameTimes>) -> Result<String, Failure> {
    for quantity in ["differences", "gradients"] {
        counts.preprocess.entry(quantity.into()).or_default();
    }
    let samples = counts.samples as f64;
    let mut object: Map<String, Value> = match serde_json::to_value(counts) {
        Ok(Value::Object(object)) => object,
        _ => return Err(Failure::new("the counts cannot be written as JSON", "--stats", "leave --stats out")),
    };
    if let Some(times) = times {
        object.insert("median_s".into(), json!(median(&times.wall)));
        object.insert("min_s".into(), json!(times.wall[0]));
        object.insert("cpu_s".into(), json!(times.cpu.map(|all| all / times.wall.len() as f64)));
        object.insert("samples_M".into(), json!(samples / 1e6));
    }
    Ok(format!("{}\n", Value::Object(object)))
}

/// Returns the processor seconds of this process, if the system has a process table.
pub(super) fn cpu_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // Fields 14 and 15 (user and system time in ticks of 1/100 s), counted after the name in parentheses.
    let mut fields = stat.rsplit_once(')')?.1.split_whitespace().skip(11);
    let (user, system) = (fields.next()?.parse::<f64>().ok()?, fields.next()?.parse::<f64>().ok()?);
    Some((user + system) / 100.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_by_hand() {
        let median = |wall: &[f64]| median(&FrameTimes::new(wall.to_vec(), None).wall);
        assert_eq!(median(&[3.0]), 3.0);
        assert_eq!(median(&[4.0, 1.0]), 2.5);
        assert_eq!(median(&[9.0, 1.0, 2.0]), 2.0);
    }
}
