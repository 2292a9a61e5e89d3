//! Loops on all threads.
//!
//! Loops take their function behind a reference. Rayon's adapters are then compiled only here, and not for every loop
//! of every number type. A call through a reference takes nanoseconds, so an item should be a tile, a row or a run of
//! voxels. Results come in the order of the items, whatever the number of threads.

use rayon::prelude::*;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Number of items in a run, if an item takes a fraction of a microsecond.
pub const RUN: usize = 256;

/// The number of threads that share the work of a loop.
pub fn threads() -> usize {
    rayon::current_num_threads()
}

/// Does work on a thread of the pool, so that the loops inside do not enter the pool one by one.
pub fn in_pool(work: &mut (dyn FnMut() + Send)) {
    rayon::scope(|_| work());
}

/// Calls a function for 0, 1, … n − 1.
pub fn each(n: usize, f: &(dyn Fn(usize) + Sync)) {
    (0..n).into_par_iter().for_each(f);
}

/// Hands each part to a function, with its index.
pub fn each_of<P: Send>(parts: Vec<P>, f: &(dyn Fn(usize, P) + Sync)) {
    let parts: Vec<Mutex<Option<P>>> = parts.into_iter().map(|part| Mutex::new(Some(part))).collect();
    each(parts.len(), &|i| {
        if let Some(part) = parts[i].lock().unwrap_or_else(PoisonError::into_inner).take() {
            f(i, part);
        }
    });
}

/// Hands each run of `size` items to a function, with the run's index. The last run may be shorter.
///
/// # Panics
/// If `size` is 0.
pub fn chunks_mut<T: Send>(items: &mut [T], size: usize, f: &(dyn Fn(usize, &mut [T]) + Sync)) {
    each_of(items.chunks_mut(size).collect(), f);
}

/// The results of a function of 0, 1, … n − 1.
pub fn map<T: Send>(n: usize, f: &(dyn Fn(usize) -> T + Sync)) -> Vec<T> {
    let mut results: Vec<Option<T>> = Vec::with_capacity(n);
    results.resize_with(n, || None);
    each_of(results.iter_mut().collect(), &|i, result| *result = Some(f(i)));
    results.into_iter().flatten().collect()
}

/// The results of a function of each part and its index.
pub fn map_of<P: Send, T: Send>(parts: Vec<P>, f: &(dyn Fn(usize, P) -> T + Sync)) -> Vec<T> {
    let mut results: Vec<Option<T>> = Vec::with_capacity(parts.len());
    results.resize_with(parts.len(), || None);
    each_of(parts.into_iter().zip(&mut results).collect(), &|i, (part, result)| *result = Some(f(i, part)));
    results.into_iter().flatten().collect()
}

/// Splits 0, 1, … n − 1 into runs of `run` numbers. Returns the joined lists that the function appends for the runs.
///
/// # Panics
/// If `run` is 0.
pub fn gather<T: Send>(n: usize, run: usize, f: &(dyn Fn(Range<usize>, &mut Vec<T>) + Sync)) -> Vec<T> {
    let lists = map(n.div_ceil(run), &|i| {
        let mut list = Vec::new();
        f(i * run..n.min((i + 1) * run), &mut list);
        list
    });
    let mut all = Vec::with_capacity(lists.iter().map(Vec::len).sum());
    lists.into_iter().for_each(|mut list| all.append(&mut list));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the number of threads and the length of the last run, results are those of a loop.
    #[test]
    fn results_come_in_the_order_of_the_items() {
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                for n in [0, 1, 7, 1000] {
                    let squares: Vec<usize> = (0..n).map(|i| i * i).collect();
                    assert_eq!(map(n, &|i| i * i), squares);
                    assert_eq!(map_of((0..n).collect(), &|i, part| i * part), squares);
                    assert_eq!(gather(n, 3, &|range, list| list.extend(range.map(|i| i * i))), squares);
                    let mut items = vec![0; n];
                    chunks_mut(&mut items, 3, &|run, items| {
                        (3 * run..).zip(items).for_each(|(i, item)| *item += i * i);
                    });
                    assert_eq!(items, squares);
                }
            });
        }
    }
}
