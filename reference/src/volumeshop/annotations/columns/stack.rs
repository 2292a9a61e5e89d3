//! Boxes on top of each other, as near as possible to the heights that they ask for.

/// Returns the lower ends of intervals that do not overlap, in the given order and between two bounds.
///
/// `wanted` has the middle that each interval asks for, and its length. The sum of squared distances of the middles from
/// what they ask for is least, and no other heights have that sum. The lengths have to fit between the bounds.
///
/// With the lengths before each interval subtracted, the lower ends only have to ascend. So this is an isotonic
/// regression, and pooling adjacent violators solves it. Bounds clamp its solution.
pub(super) fn stack(wanted: &[[f64; 2]], [low, high]: [f64; 2]) -> Vec<f64> {
    let mut before = 0.0;
    // Blocks of touching intervals: the sum of what they ask for, and their number.
    let mut blocks: Vec<(f64, usize)> = Vec::with_capacity(wanted.len());
    for &[middle, length] in wanted {
        let mut block = (middle - length / 2.0 - before, 1);
        before += length;
        while let Some(&(sum, n)) = blocks.last() {
            if sum / n as f64 <= block.0 / block.1 as f64 {
                break;
            }
            block = (sum + block.0, n + block.1);
            blocks.pop();
        }
        blocks.push(block);
    }
    let last = high - before;
    let starts = blocks.iter().flat_map(|&(sum, n)| std::iter::repeat_n((sum / n as f64).min(last).max(low), n));
    // The end of an interval is the start of the next one in a block, in the arithmetic of the boxes.
    let (mut before, mut end) = (0.0, low);
    let lower = starts.zip(wanted).map(|(start, &[_, length])| {
        let lower = f64::max(start + before, end);
        (before, end) = (before + length, lower + length);
        lower
    });
    lower.collect()
}
