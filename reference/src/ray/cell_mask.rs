//! Empty-space skipping cell by cell ([RAY-2]), for kernels whose values are expensive.

use crate::field::{CELLS, Field, Kernel};
use crate::number::Real;
use drypoint_scene::transfer::Function;
use drypoint_scene::volume::{BRICK, Bricks};
use std::sync::{Arc, OnceLock};

/// The cells in which a transfer function can be visible. The cells of a brick are tested when the first ray reaches
/// it.
pub(super) struct CellMask {
    function: Arc<Function>,
    /// Bricks along x, y, z.
    dims: [usize; 3],
    /// One bit for each cell of each brick, x fastest.
    seen: Vec<OnceLock<u64>>,
}

const _: () = assert!(CELLS == u64::BITS as usize);

impl CellMask {
    /// A mask without tested cells. Returns none for the trilinear kernel, whose values are cheap.
    pub(super) fn new(bricks: &Bricks, kernel: Kernel, function: &Arc<Function>) -> Option<Self> {
        let seen = || bricks.ranges.iter().map(|_| OnceLock::new()).collect();
        (kernel != Kernel::Trilinear).then(|| Self { function: function.clone(), dims: bricks.dims, seen: seen() })
    }

    /// Bytes in memory.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.seen.as_slice())
    }

    /// Whether a sample in a cell of the field can show something.
    #[inline(always)]
    pub(super) fn can_show<R: Real>(&self, field: &Field<'_, R>, cell: [usize; 3]) -> bool {
        let brick = cell.map(|i| i / BRICK);
        let at = (brick[2] * self.dims[1] + brick[1]) * self.dims[0] + brick[0];
        let seen = self.seen[at].get_or_init(|| self.look(field, brick));
        let [x, y, z] = cell.map(|i| i % BRICK);
        seen >> ((z * BRICK + y) * BRICK + x) & 1 == 1
    }

    #[cold]
    fn look<R: Real>(&self, field: &Field<'_, R>, brick: [usize; 3]) -> u64 {
        let rounded = |at| R::from_f64(at).to_f64();
        let ranges = field.cell_ranges(brick);
        let bit = |(i, &range)| u64::from(self.function.can_be_visible(range, None, rounded)) << i;
        ranges.iter().enumerate().map(bit).fold(0, |all, bit| all | bit)
    }
}
