//! Watershed, against an independent program ([VS-6]).

use drypoint::reference::volumeshop::painting::{Marker, basins};
use serde_json::Value;
use std::path::Path;

/// Basins that scikit-image finds in small reliefs, with and without equal values, with and without walls;
/// `tests/oracles/watershed.py` made them.
#[test]
fn basins_are_those_of_scikit_image() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/oracles/watershed.json");
    let cases: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let numbers = |list: &Value| -> Vec<usize> {
        list.as_array().unwrap().iter().map(|n| n.as_u64().unwrap() as usize).collect()
    };
    for case in cases.as_array().unwrap() {
        let dims: [usize; 3] = numbers(&case["dims"]).try_into().unwrap();
        let (relief, walls) = (numbers(&case["relief"]), numbers(&case["walls"]));
        let index = |[x, y, z]: [usize; 3]| (z * dims[1] + y) * dims[0] + x;
        let markers: Vec<Marker> = numbers(&case["markers"])
            .into_iter()
            .zip(1..)
            .map(|(i, basin)| Marker { voxel: [i % dims[0], i / dims[0] % dims[1], i / dims[0] / dims[1]], basin })
            .collect();
        let found =
            basins(dims, &markers, &|voxel| !walls.contains(&index(voxel)), &mut |voxel| relief[index(voxel)] as f64);
        let found: Vec<usize> = found.unwrap().into_iter().map(|basin| basin as usize).collect();
        assert_eq!(found, numbers(&case["basins"]), "{dims:?}");
        assert!((1..=4).all(|basin| found.contains(&basin)));
    }
    assert_eq!(cases.as_array().unwrap().len(), 6);
}
