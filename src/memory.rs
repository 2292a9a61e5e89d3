//! Whether there is memory for what is about to be made.
//!
//! A system that promises more memory than it has ends the process when the promise is called in, and an allocation
//! that fails aborts it: so what may be huge is asked for first.

use std::fs;

/// Why there is no room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct NoRoom {
    /// Bytes that would be needed.
    pub(crate) needed: u64,
    /// Bytes that there are, where the system says so.
    pub(crate) free: Option<u64>,
}

impl std::fmt::Display for NoRoom {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} of memory", gibibytes(self.needed))?;
        match self.free {
            Some(free) => write!(f, ", and {} are free", gibibytes(free)),
            None => write!(f, ", more than there is"),
        }
    }
}

/// With two digits behind the point, rounded up: what is needed never reads as nothing.
fn gibibytes(bytes: u64) -> String {
    const GIBIBYTE: f64 = (1u64 << 30) as f64;
    format!("{:.2} GiB", (bytes as f64 / GIBIBYTE * 100.0).ceil() / 100.0)
}

/// Whether so many bytes could be had now: the allocator gives them, and the system has them.
///
/// # Errors
/// What is needed and what there is.
pub(crate) fn room(needed: u64) -> Result<(), NoRoom> {
    let free = free();
    let within = free.is_none_or(|free| needed <= free);
    let given = || usize::try_from(needed).is_ok_and(|n| Vec::<u8>::new().try_reserve_exact(n).is_ok());
    if !within {
        return Err(NoRoom { needed, free });
    }
    if given() { Ok(()) } else { Err(NoRoom { needed, free: None }) }
}

/// Bytes that the system can give without swapping, and no more than a container may have; where Linux says so.
fn free() -> Option<u64> {
    let available = fs::read_to_string("/proc/meminfo").ok().and_then(|text| available(&text));
    let limit = fs::read_to_string("/sys/fs/cgroup/memory.max").ok().and_then(|text| text.trim().parse().ok());
    available.into_iter().chain(limit).min()
}

/// `MemAvailable` of the system's table, in bytes.
fn available(table: &str) -> Option<u64> {
    let line = table.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kibibytes.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_of_the_system_by_hand() {
        let table = "MemTotal:       24117248 kB\nMemFree:         9437184 kB\nMemAvailable:   20971520 kB\n";
        assert_eq!(available(table), Some(20 << 30));
        for other in ["", "MemAvailable: many kB\n", "MemAvailable: 12\n", "MemAvailable: 18446744073709551615 kB\n"] {
            assert_eq!(available(other), None, "{other}");
        }
    }

    #[test]
    fn a_little_can_be_had_and_all_there_is_cannot() {
        assert_eq!(room(1 << 20), Ok(()));
        for needed in [1 << 60, u64::MAX] {
            assert_eq!(room(needed).unwrap_err().needed, needed);
        }
    }

    #[test]
    fn what_is_said() {
        let no_room = |free| NoRoom { needed: 64 << 30, free }.to_string();
        assert_eq!(no_room(Some(3 << 29)), "64.00 GiB of memory, and 1.50 GiB are free");
        assert_eq!(no_room(None), "64.00 GiB of memory, more than there is");
        assert_eq!(gibibytes(1), "0.01 GiB");
    }
}
