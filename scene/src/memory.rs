//! The memory budget: bytes that may still be allocated, asked for before anything large is made.
//!
//! A system that promises more memory than it has ends the process when the promise is called in, and an allocation
//! that fails aborts it. So whatever a file or a key can make large asks [`room`] first, and is refused with what it
//! would need and what would fit.

use std::sync::atomic::{AtomicU64, Ordering};

/// The bytes that the process may have at most, as [`limit`] was told; `u64::MAX`: no limit of its own.
static LIMIT: AtomicU64 = AtomicU64::new(u64::MAX);

/// A refusal: the bytes that something needs, and those that there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoRoom {
    /// Bytes that would be needed.
    pub needed: u64,
    /// Bytes that there are; none where the system does not say.
    pub free: Option<u64>,
}

impl NoRoom {
    /// Returns how many of `n` equal items fit, when all of them together need [`NoRoom::needed`].
    pub fn fitting(&self, n: u64) -> u64 {
        let free = self.free.unwrap_or(0).min(self.needed);
        (u128::from(n) * u128::from(free) / u128::from(self.needed.max(1))) as u64
    }

    /// Returns by what factor two lengths have to be multiplied for their rectangle to fit; from 0 to 1.
    pub fn fitting_scale(&self) -> f64 {
        (self.free.unwrap_or(0) as f64 / self.needed.max(1) as f64).min(1.0).sqrt()
    }
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

impl std::error::Error for NoRoom {}

/// Writes bytes in GiB with two decimals, rounded up, so that a need never reads as nothing.
fn gibibytes(bytes: u64) -> String {
    const GIBIBYTE: f64 = (1u64 << 30) as f64;
    format!("{:.2} GiB", (bytes as f64 / GIBIBYTE * 100.0).ceil() / 100.0)
}

/// Limits the memory of this process to `bytes`, for all of [`room`] from now on.
pub fn limit(bytes: u64) {
    LIMIT.store(bytes, Ordering::Relaxed);
}

/// Checks that so many bytes could be had now: the budget allows them, the system has them, the allocator gives them.
///
/// # Errors
/// The bytes that are needed and those that there are.
pub fn room(needed: u64) -> Result<(), NoRoom> {
    let free = free();
    if free.is_some_and(|free| needed > free) {
        return Err(NoRoom { needed, free });
    }
    let given = usize::try_from(needed).is_ok_and(|n| Vec::<u8>::new().try_reserve_exact(n).is_ok());
    if given { Ok(()) } else { Err(NoRoom { needed, free: None }) }
}

/// Checks that `n` items of `each` bytes could be had now.
///
/// # Errors
/// As [`room`].
pub fn room_for(n: u64, each: u64) -> Result<(), NoRoom> {
    room(n.saturating_mul(each))
}

/// Bytes that the system can give without swapping, within the limits of a container and of [`limit`].
#[cfg(not(target_family = "wasm"))]
fn free() -> Option<u64> {
    use sysinfo::{ProcessRefreshKind, ProcessesToUpdate, System};
    if !sysinfo::IS_SUPPORTED_SYSTEM {
        return None;
    }
    let mut system = System::new();
    system.refresh_memory();
    let container = system.cgroup_limits().map(|limits| limits.total_memory.saturating_sub(limits.rss));
    let limit = LIMIT.load(Ordering::Relaxed);
    let budget = (limit < u64::MAX).then(|| {
        let resident = sysinfo::get_current_pid().ok().and_then(|own| {
            system.refresh_processes_specifics(
                ProcessesToUpdate::Some(&[own]),
                false,
                ProcessRefreshKind::nothing().with_memory(),
            );
            system.process(own).map(sysinfo::Process::memory)
        });
        limit.saturating_sub(resident.unwrap_or(0))
    });
    [Some(system.available_memory()), container, budget].into_iter().flatten().min()
}

/// Bytes that may be had where there is no system to ask: those of [`limit`].
#[cfg(target_family = "wasm")]
fn free() -> Option<u64> {
    Some(LIMIT.load(Ordering::Relaxed)).filter(|&limit| limit < u64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_little_can_be_had_and_all_there_is_cannot() {
        assert_eq!(room(1 << 20), Ok(()));
        for needed in [1 << 60, u64::MAX] {
            assert_eq!(room(needed).unwrap_err().needed, needed);
        }
        assert_eq!(room_for(u64::MAX, 2).unwrap_err().needed, u64::MAX);
    }

    #[test]
    fn refusals_by_hand() {
        let no_room = |free| NoRoom { needed: 64 << 30, free };
        assert_eq!(no_room(Some(3 << 29)).to_string(), "64.00 GiB of memory, and 1.50 GiB are free");
        assert_eq!(no_room(None).to_string(), "64.00 GiB of memory, more than there is");
        assert_eq!(gibibytes(1), "0.01 GiB");
        assert_eq!(no_room(Some(16 << 30)).fitting(100), 25);
        assert_eq!(no_room(Some(16 << 30)).fitting_scale(), 0.5);
        assert_eq!((no_room(None).fitting(100), no_room(None).fitting_scale()), (0, 0.0));
    }
}
