//! Edges of pictures by hand.

use super::*;

/// Channels of a picture from a function of column and row.
fn beauty([width, height]: [usize; 2], color: impl Fn(usize, usize) -> Rgba) -> Vec<Vec<f64>> {
    (0..4).map(|c| (0..width * height).map(|at| color(at % width, at / width)[c]).collect()).collect()
}

/// The pixels at edges, as column and row.
fn edges(beauty: &[Vec<f64>], size: [usize; 2], contrast: f64) -> Vec<[usize; 2]> {
    let found = pixels_at_edges(beauty, size, contrast);
    (0..found.len()).filter(|&at| found[at]).map(|at| [at % size[0], at / size[0]]).collect()
}

#[test]
fn a_lone_pixel_and_its_eight_neighbours() {
    let size = [7, 6];
    let alone = beauty(size, |x, y| if [x, y] == [3, 2] { [1.0, 0.0, 0.0, 1.0] } else { [0.0, 0.0, 0.0, 1.0] });
    let around: Vec<_> = (1..4).flat_map(|y| (2..5).map(move |x| [x, y])).collect();
    assert_eq!(edges(&alone, size, 0.5), around);
    // The largest difference there is parts nothing from it.
    assert!(edges(&alone, size, 1.0).is_empty());
    let corner = beauty(size, |x, y| if [x, y] == [6, 5] { [0.0; 4] } else { [0.0, 0.0, 0.0, 1.0] });
    assert_eq!(edges(&corner, size, 0.5), [[5, 4], [6, 4], [5, 5], [6, 5]]);
    assert_eq!(edges(&beauty([1, 1], |_, _| [0.3; 4]), [1, 1], 0.0), [[0; 2]; 0]);
}

/// The contrast is that of the encoded picture, without what no display shows.
#[test]
fn contrast_is_of_displayed_colours() {
    // 0.0031308 in linear light is 0.04045 in sRGB, and 0.2140 is ½.
    let at = |linear: f64, alpha: f64, contrast: f64| {
        let two = beauty([2, 1], |x, _| if x == 0 { [0.0, 0.0, 0.0, 1.0] } else { [0.0, linear, 0.0, alpha] });
        edges(&two, [2, 1], contrast).len()
    };
    assert_eq!([at(0.003_130_8, 1.0, 0.0404), at(0.003_130_8, 1.0, 0.0405)], [2, 0]);
    assert_eq!([at(0.214_041_1, 1.0, 0.499), at(0.214_041_1, 1.0, 0.501)], [2, 0]);
    assert_eq!([at(-3.0, 1.0, 0.0), at(0.0, 0.95, 0.04), at(0.0, 0.95, 0.06)], [0, 2, 0]);
    let light = beauty([2, 1], |x, _| [1.0 + x as f64, 1.0, 1.0, 1.0]);
    assert!(edges(&light, [2, 1], 0.0).is_empty());
}

/// Rows are looked at in chunks, which do not show: in each picture one edge lies between two rows, wherever that is.
#[test]
fn an_edge_between_chunks_is_seen_from_both_sides() {
    let size = [1 << 10, 40];
    for row in 1..40 {
        let halves = beauty(size, |_, y| if y < row { [0.0; 4] } else { [1.0; 4] });
        let found = edges(&halves, size, 0.0625);
        assert_eq!(found.len(), 2 * size[0]);
        assert!(found.iter().all(|[_, y]| *y == row - 1 || *y == row));
    }
}
