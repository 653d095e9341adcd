//! Plan of a loss: steps that are short enough for a driver's watchdog and small enough for its memory.

use std::ops::Range;

/// Invocations that share a block, as in loss.wgsl.
pub(super) const LANES: usize = 64;
/// Texels that an invocation sums, as in loss.wgsl.
const RUN: usize = 64;
/// Texels of a block: of one number that the device gives back.
const TEXELS_PER_BLOCK: usize = LANES * RUN;
/// As in loss.wgsl.
pub(super) const MOST_PREDICTIONS: usize = 4;
/// Planes of a material, as in loss.wgsl.
pub(super) const PLANES: usize = 10;

/// Blocks of the largest band: 2^20 texels, 40 MiB of each material.
const MOST_BLOCKS: usize = 256;
/// Blocks that a step renders, over all scenes and materials: 2^22 texels, 0.3 s for a software driver on two cores. One
/// scene of a large band with many predictions is a little more.
const BLOCKS_PER_STEP: usize = 1024;

/// What is sent and computed at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plan {
    /// Width and height of the materials.
    pub size: [usize; 2],
    pub texels_per_band: usize,
    pub scenes_per_step: usize,
    scenes: usize,
}

impl Plan {
    /// For materials of `size`, of which `predictions` are compared; `limit` is the largest binding in bytes.
    pub(super) fn new(limit: u64, size: [usize; 2], scenes: usize, predictions: usize) -> Self {
        let materials = predictions + 1;
        let block_bytes = materials * PLANES * size_of::<f32>() * TEXELS_PER_BLOCK;
        let that_fit = usize::try_from(limit).unwrap_or(usize::MAX) / block_bytes;
        let needed = blocks(&(0..size[0] * size[1]));
        let blocks = needed.min(MOST_BLOCKS).min(that_fit).max(1);
        Self {
            size,
            texels_per_band: blocks * TEXELS_PER_BLOCK,
            scenes_per_step: (BLOCKS_PER_STEP / (blocks * materials)).clamp(1, scenes.max(1)),
            scenes,
        }
    }

    /// The texels of each band.
    pub(super) fn bands(&self) -> impl Iterator<Item = Range<usize>> {
        pieces(self.size[0] * self.size[1], self.texels_per_band)
    }

    /// The scenes of each step of a band.
    pub(super) fn scenes(&self) -> impl Iterator<Item = Range<usize>> {
        pieces(self.scenes, self.scenes_per_step)
    }

    pub(super) fn steps(&self) -> u64 {
        (self.bands().count() * self.scenes().count()) as u64
    }

    /// Blocks of the largest band.
    pub(super) fn blocks(&self) -> usize {
        self.texels_per_band / TEXELS_PER_BLOCK
    }
}

/// Blocks that `texels` fill or begin to fill.
pub(super) fn blocks(texels: &Range<usize>) -> usize {
    texels.len().div_ceil(TEXELS_PER_BLOCK)
}

/// 0 to `count` in pieces of `most`.
fn pieces(count: usize, most: usize) -> impl Iterator<Item = Range<usize>> {
    (0..count).step_by(most).map(move |start| start..count.min(start + most))
}

#[cfg(test)]
mod tests {
    use super::*;

    const WEBGPU_LIMIT: u64 = 128 << 20;

    #[test]
    fn bands_cover_every_texel_once_in_whole_blocks_that_fit() {
        for size in [[1, 1], [7, 3], [256, 256], [1030, 1100], [8192, 8192], [100_003, 7]] {
            for predictions in 1..=MOST_PREDICTIONS {
                for limit in [WEBGPU_LIMIT, 4 << 20, u64::MAX] {
                    let plan = Plan::new(limit, size, 9, predictions);
                    let mut next = 0;
                    for band in plan.bands() {
                        assert_eq!((band.start, band.start % TEXELS_PER_BLOCK), (next, 0));
                        assert!(((predictions + 1) * PLANES * 4 * band.len()) as u64 <= limit, "{plan:?}");
                        next = band.end;
                    }
                    assert_eq!(next, size[0] * size[1]);
                }
            }
        }
    }

    #[test]
    fn steps_cover_every_scene_once_and_are_short() {
        for (side, scenes) in [(1, 1), (1, 10_000), (256, 9), (8192, 9)] {
            let plan = Plan::new(WEBGPU_LIMIT, [side, side], scenes, 1);
            assert_eq!(plan.scenes().flatten().collect::<Vec<_>>(), (0..scenes).collect::<Vec<_>>());
            assert!(2 * plan.blocks() * plan.scenes_per_step <= BLOCKS_PER_STEP, "{plan:?}");
        }
    }

    #[test]
    fn the_usual_job_is_one_step() {
        assert_eq!(Plan::new(WEBGPU_LIMIT, [256, 256], 9, 1).steps(), 1);
    }
}
