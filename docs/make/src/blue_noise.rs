//! `data/blue_noise.bin`: the mask of `ink = "opaque"` ([STIP-5]).

use crate::files::write as write_file;
use drypoint::scene::blue_noise::void_and_cluster;

/// Makes the mask and writes it.
pub(crate) fn write() -> Result<(), String> {
    let bytes: Vec<u8> = void_and_cluster().iter().flat_map(|rank| rank.to_le_bytes()).collect();
    write_file("../data/blue_noise.bin", &bytes)
}
