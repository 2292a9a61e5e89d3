//! Numbers and sizes of a voxel's dots, from its share of points: eqs. 2 and 4 ([STIP-5], [STIP-6]).

use drypoint_scene::blue_noise;
use drypoint_scene::shot::stipples::Ink;

/// The dots of a voxel, a prefix of its list of points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct VoxelDots {
    /// Number of dots that are drawn completely.
    pub(super) whole: usize,
    /// Opacity of the next dot; at 0 it is not drawn.
    pub(super) fading: f64,
    /// The dots' diameter over S_max, or over the nib.
    pub(super) size: f64,
}

/// N_i = N_max·T of eq. 2, and the size S_i = S_max·‖∇V_i‖·T_r·T_d·T_t as `size`, over S_max.
pub(super) fn dots(each: usize, share: f64, size: f64, ink: Ink, cell: [u32; 3]) -> VoxelDots {
    // A share of NaN, from 0·∞ of unbounded factors, draws nothing: `max` returns the other operand.
    let n = (each as f64 * share).max(0.0).min(each as f64);
    match ink {
        Ink::Fade => {
            let whole = n.floor();
            let fading = if (whole as usize) < each { n - whole } else { 0.0 };
            VoxelDots { whole: whole as usize, fading, size }
        }
        Ink::Opaque => VoxelDots { whole: ((n + blue_noise::at(cell)) as usize).min(each), fading: 0.0, size },
    }
}

/// Converts a voxel's share for a pen, which has one size. The number of dots changes so that the ink's area
/// N_i·(S_i/nib)² stays. Returns the share and the dots' diameter over the nib. If the list has too few points, dots
/// become larger. `ink` is T·(S_i/S_max)², `per_nib` S_max/nib.
pub(super) fn with_nib(ink: f64, per_nib: f64) -> (f64, f64) {
    let share = ink * (per_nib * per_nib);
    if share > 1.0 { (1.0, share.sqrt()) } else { (share, 1.0) }
}

/// Number of a voxel's points that are candidates for dots chosen on the page ([STIP-19]), and the number of dots for
/// which each stands. There are four candidates for each wanted dot, as far as the list reaches.
pub(super) fn candidates(each: usize, share: f64, cell: [u32; 3]) -> (usize, f64) {
    let wanted = (each as f64 * share).max(0.0).min(each as f64);
    let many = OVERSAMPLING * wanted;
    if many < each as f64 {
        (dots(each, many / each as f64, 1.0, Ink::Opaque, cell).whole, 1.0 / OVERSAMPLING)
    } else {
        (each, wanted / each as f64)
    }
}

/// Candidates per dot. Sample elimination works well with three to five.
const OVERSAMPLING: f64 = 4.0;

#[cfg(test)]
mod tests {
    use super::*;

    const CELL: [u32; 3] = [1, 2, 3];

    #[test]
    fn the_whole_part_is_drawn_and_the_next_one_fades() {
        assert_eq!(dots(8, 0.40625, 0.5, Ink::Fade, CELL), VoxelDots { whole: 3, fading: 0.25, size: 0.5 });
        assert_eq!(dots(8, 1.0, 1.0, Ink::Fade, CELL), VoxelDots { whole: 8, fading: 0.0, size: 1.0 });
        assert_eq!(dots(8, 0.0, 1.0, Ink::Fade, CELL), VoxelDots { whole: 0, fading: 0.0, size: 1.0 });
        assert_eq!(dots(8, 1f64.next_up(), 1.0, Ink::Fade, CELL).whole, 8);
    }

    #[test]
    fn a_share_that_is_no_number_draws_nothing() {
        for ink in [Ink::Fade, Ink::Opaque] {
            assert_eq!(dots(8, f64::NAN, 1.0, ink, CELL), VoxelDots { whole: 0, fading: 0.0, size: 1.0 });
            assert_eq!(dots(8, with_nib(f64::NAN, 1.0).0, 1.0, ink, CELL).whole, 0);
            assert_eq!(dots(8, f64::INFINITY, 1.0, ink, CELL).whole, 8);
            assert_eq!(dots(8, -0.5, 1.0, ink, CELL).whole, 0);
        }
    }

    /// One ulp from an integer the dot is either drawn or not, up to rounding: no dot flickers.
    #[test]
    fn next_to_an_integer_nothing_jumps() {
        for each in [1usize, 7, 10_000] {
            for k in [1, each.div_ceil(2), each] {
                let share = k as f64 / each as f64;
                for share in [share.next_down(), share, share.next_up()] {
                    let VoxelDots { whole, fading, .. } = dots(each, share, 1.0, Ink::Fade, CELL);
                    // In units of dots: the product errs by an ulp, which is half a unit roundoff of k.
                    assert!((whole as f64 + fading - k as f64).abs() <= 4.0 * f64::EPSILON * k as f64, "{each} {k}");
                    assert!(
                        fading <= 4.0 * f64::EPSILON * each as f64 || fading >= 1.0 - 4.0 * f64::EPSILON * each as f64
                    );
                }
            }
        }
    }

    /// The mean count over a tile of the mask is N_i.
    #[test]
    fn opaque_counts_have_the_right_mean() {
        for share in [0.0, 0.125, 0.3125, 0.5, 1.0] {
            let mut sum = 0;
            for i in 0..32u32.pow(3) {
                sum += dots(4, share, 1.0, Ink::Opaque, [i % 32, i / 32 % 32, i / 1024]).whole;
            }
            assert_eq!(sum as f64 / 32f64.powi(3), 4.0 * share);
        }
    }

    #[test]
    fn a_pen_keeps_the_area_of_ink() {
        // Half of the dots at half the size, S_max twice the nib: as many dots of the nib.
        assert_eq!(with_nib(0.5 * 0.25, 2.0), (0.5, 1.0));
        // At full size the area is four times as large: twice as many nibs as the list has, so each has twice the
        // area.
        assert_eq!(with_nib(0.5, 2.0), (1.0, 2f64.sqrt()));
        for (ink, per_nib) in [(0.147, 1.3), (0.729, 3.0), (0.004, 0.5)] {
            let (share, size) = with_nib(ink, per_nib);
            let d = dots(100, share, size, Ink::Fade, CELL);
            let area = (d.whole as f64 + d.fading) * d.size * d.size;
            assert!((area - 100.0 * ink * per_nib * per_nib).abs() < 1e-9);
        }
    }

    /// The mean number of dots for which candidates stand is N_i over a tile of the mask, however short the list is.
    #[test]
    fn candidates_stand_for_all_dots() {
        for share in [0.0, 0.03125, 0.125, 0.25, 0.5, 1.0] {
            let mut sum = 0.0;
            for i in 0..32u32.pow(3) {
                let (count, dots) = candidates(8, share, [i % 32, i / 32 % 32, i / 1024]);
                assert!(count <= 8 && dots <= 1.0);
                sum += count as f64 * dots;
            }
            assert_eq!(sum / 32f64.powi(3), 8.0 * share, "{share}");
        }
        assert_eq!(candidates(8, f64::NAN, CELL).0, 0);
    }
}
