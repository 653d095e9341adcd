//! Number of texels that the kernel works on at a time.

/// Texels of a tile. Its planes (22 KiB for two materials) stay in the L1 cache. A multiple of two vectors of every
/// instruction set.
pub(crate) const TEXELS: usize = 128;

/// Texels that one thread works on at a time, and whose logarithm the loss takes at once.
pub(crate) const TEXELS_PER_BLOCK: usize = 16 * TEXELS;

/// How far ahead of the current tile memory is prefetched, in texels. The next tile alone would arrive too late.
pub(crate) const AHEAD: usize = 2 * TEXELS;
