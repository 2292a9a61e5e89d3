//! The memory budget: the bytes that may still be allocated.
//!
//! A system that promises more memory than it has may end the process when the memory is used. An allocation that fails
//! aborts the process. Everything that a file or a key can make large therefore asks [`room`] first. A refusal names
//! the bytes needed and the bytes that would fit.

use crate::source::Source;
use std::io::{self, ErrorKind, Read};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

const GIBIBYTE: f64 = (1u64 << 30) as f64;

/// The bytes that the process may have at most, set by [`limit`]; `u64::MAX`: no limit.
static LIMIT: AtomicU64 = AtomicU64::new(u64::MAX);

/// A refusal: the bytes that something needs, and those that are free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoRoom {
    /// Bytes that would be needed.
    pub needed: u64,
    /// Bytes that are free.
    pub free: u64,
}

impl NoRoom {
    /// Returns how many of `n` equal items fit, when all of them together need [`NoRoom::needed`].
    pub fn fitting(&self, n: u64) -> u64 {
        let free = self.free.min(self.needed);
        (u128::from(n) * u128::from(free) / u128::from(self.needed.max(1))) as u64
    }

    /// Returns the largest size of the same shape that fits, when one of `size` needs [`NoRoom::needed`]. A side has at
    /// least one item.
    pub fn fitting_size(&self, size: [usize; 2]) -> [usize; 2] {
        let share = (self.free as f64 / self.needed.max(1) as f64).min(1.0);
        let [a, b] = size.map(|n| ((n as f64 * share.sqrt()) as usize).max(1));
        let most = (size[0] as f64 * size[1] as f64 * share) as usize;
        [a.min((most / b).max(1)), b.min((most / a).max(1))]
    }

    /// Returns the least length that fits, rounded up to three digits; none if nothing fits. A length of `length` needs
    /// [`NoRoom::needed`], and the need grows with the inverse of the length.
    pub fn enlarged(&self, length: f64) -> Option<f64> {
        let fits = length * (self.needed as f64 / self.free as f64).max(1.0);
        let unit = 10f64.powf(fits.log10().floor() - 2.0);
        let rounded = (fits / unit).ceil() * unit;
        // Through its text, without the digits that rounding leaves.
        format!("{rounded:.2e}").parse().ok().filter(|length: &f64| length.is_finite())
    }
}

impl std::fmt::Display for NoRoom {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        // Rounded against the reader's hopes: a need never reads as nothing, and what is free never as enough.
        let [needed, free] = [(self.needed, f64::ceil as fn(f64) -> f64), (self.free, f64::floor)]
            .map(|(bytes, round)| round(bytes as f64 / GIBIBYTE * 100.0) / 100.0);
        write!(f, "{needed:.2} GiB of memory, and {free:.2} GiB are free")
    }
}

impl std::error::Error for NoRoom {}

impl From<NoRoom> for io::Error {
    fn from(no_room: NoRoom) -> Self {
        Self::new(ErrorKind::OutOfMemory, format!("its content needs {no_room}"))
    }
}

/// Limits the memory of this process to `bytes`. All later calls of [`room`] respect the limit.
pub fn limit(bytes: u64) {
    LIMIT.store(bytes, Ordering::Relaxed);
}

/// Checks that `needed` bytes are available now: the budget allows them, the system has them, and the allocator gives
/// them.
///
/// # Errors
/// The number of bytes needed and the number that are free.
pub fn room(needed: u64) -> Result<(), NoRoom> {
    let free = free().unwrap_or(u64::MAX);
    let given = |bytes: u64| usize::try_from(bytes).is_ok_and(|n| Vec::<u8>::new().try_reserve_exact(n).is_ok());
    if needed <= free && given(needed) {
        return Ok(());
    }
    // The allocator may give less than the system has, such as under `ulimit -v`: bisection finds how much.
    let [mut yes, mut no] = [0, needed.min(free).min(isize::MAX as u64)];
    if given(no) {
        return Err(NoRoom { needed, free: no });
    }
    while no - yes > 1 << 20 {
        let middle = yes + (no - yes) / 2;
        *if given(middle) { &mut yes } else { &mut no } = middle;
    }
    Err(NoRoom { needed, free: yes })
}

/// Checks that `n` items of `each` bytes could be had now.
///
/// # Errors
/// See [`room`].
pub fn room_for(n: u64, each: u64) -> Result<(), NoRoom> {
    room(n.saturating_mul(each))
}

/// A reader that asks the memory budget for the space of its content: before the first byte, and again before the
/// content read can double. A file or a pipe without an end is an error of [`ErrorKind::OutOfMemory`].
#[derive(Debug)]
pub struct Metered<R> {
    inner: R,
    /// Bytes in memory for each byte that is read.
    each: u64,
    read: u64,
    /// Bytes that may be read before the budget is asked again.
    granted: u64,
}

impl<R: Read> Metered<R> {
    /// Bytes that are granted without asking.
    const FIRST: u64 = 1 << 20;

    /// Meters a reader whose content takes `each` bytes of memory a byte.
    pub fn new(inner: R, each: u64) -> Self {
        Self { inner, each, read: 0, granted: Self::FIRST }
    }
}

impl<R: Read> Read for Metered<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.read >= self.granted {
            room_for(self.read, self.each)?;
            self.granted = self.read.saturating_mul(2);
        }
        let n = self.inner.read(buffer)?;
        self.read = self.read.saturating_add(n as u64);
        Ok(n)
    }
}

/// Reads a whole file within the memory budget.
///
/// # Errors
/// Errors of the source, and [`ErrorKind::OutOfMemory`] for a file that does not fit.
pub fn read(source: &dyn Source, path: &Path) -> io::Result<Vec<u8>> {
    let mut file = source.open(path)?;
    let length = source.length(path)?.unwrap_or(0);
    room(length)?;
    let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
    (&mut file).take(length).read_to_end(&mut bytes)?;
    // A pipe and a device do not say their length. A list that grows is there twice, the longer one of twice the length.
    Metered::new(file, 3).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Reads a whole file of UTF-8 within the memory budget.
///
/// # Errors
/// The errors of [`read`], and [`ErrorKind::InvalidData`] for bytes that are not UTF-8.
pub fn read_to_string(source: &dyn Source, path: &Path) -> io::Result<String> {
    String::from_utf8(read(source, path)?)
        .map_err(|_| io::Error::new(ErrorKind::InvalidData, "it is not text in UTF-8"))
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
    use crate::source::Disk;

    #[test]
    fn a_little_can_be_had_and_all_there_is_cannot() {
        assert_eq!(room(1 << 20), Ok(()));
        for needed in [1 << 60, u64::MAX] {
            assert_eq!(room(needed).unwrap_err().needed, needed);
        }
        assert_eq!(room_for(u64::MAX, 2).unwrap_err().needed, u64::MAX);
    }

    #[test]
    fn what_has_no_end_is_refused() {
        // 2⁶⁰ bytes a byte: the first question is refused, after the bytes that are granted without asking.
        let mut bytes = Vec::new();
        let error = Metered::new(io::repeat(7), 1 << 60).read_to_end(&mut bytes).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::OutOfMemory);
        assert!(error.to_string().starts_with("its content needs 17179869184.00 GiB of memory"), "{error}");
        assert!(bytes.len() as u64 >= Metered::<io::Empty>::FIRST);
    }

    #[test]
    fn files_are_read_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let bytes: Vec<u8> = (0..3 << 20).map(|i| (i % 251) as u8).collect();
        std::fs::write(&path, &bytes).unwrap();
        assert_eq!(read(&Disk, &path).unwrap(), bytes);
        assert_eq!(read_to_string(&Disk, &path).unwrap_err().kind(), ErrorKind::InvalidData);
        std::fs::write(&path, "κ").unwrap();
        assert_eq!(read_to_string(&Disk, &path).unwrap(), "κ");
        assert_eq!(read(&Disk, &folder.path().join("b")).unwrap_err().kind(), ErrorKind::NotFound);
    }

    #[test]
    fn refusals_by_hand() {
        let no_room = |free| NoRoom { needed: 64 << 30, free };
        assert_eq!(no_room(3 << 29).to_string(), "64.00 GiB of memory, and 1.50 GiB are free");
        assert_eq!(NoRoom { needed: 2, free: 1 }.to_string(), "0.01 GiB of memory, and 0.00 GiB are free");
        assert_eq!(no_room(16 << 30).fitting(100), 25);
        assert_eq!(no_room(16 << 30).fitting_size([100, 50]), [50, 25]);
        assert_eq!((no_room(0).fitting(100), no_room(0).fitting_size([100, 50])), (0, [1, 1]));
        assert_eq!(no_room(48 << 30).fitting_size([100_000_000, 1]), [75_000_000, 1]);
        assert_eq!((no_room(16 << 30).enlarged(0.001), no_room(48 << 30).enlarged(0.01)), (Some(0.004), Some(0.0134)));
        assert_eq!(no_room(0).enlarged(1.0), None);
    }
}
