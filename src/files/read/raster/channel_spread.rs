//! Channel spread: how far the channels of a picture differ.

use rayon::prelude::*;

use super::samples::Samples;

/// The largest difference between the channels of a texel.
pub(crate) fn channel_spread(channels: &[Samples]) -> f64 {
    const CHUNK: usize = 1 << 16;
    /// Texels that stay in the nearest cache.
    const FEW: usize = 1 << 9;
    let Some((first, others)) = channels.split_first().filter(|(_, others)| !others.is_empty()) else {
        return 0.0;
    };
    let largest = |number: usize| {
        let (mut low, mut high, mut other) = ([0.0; FEW], [0.0; FEW], [0.0; FEW]);
        let end = first.len().min((number + 1) * CHUNK);
        let mut largest = 0.0_f32;
        for start in (number * CHUNK..end).step_by(FEW) {
            let count = FEW.min(end - start);
            let (low, high, other) = (&mut low[..count], &mut high[..count], &mut other[..count]);
            first.read_stored(start, low);
            high.copy_from_slice(low);
            for channel in others {
                channel.read_stored(start, other);
                for ((low, high), value) in low.iter_mut().zip(&mut *high).zip(&*other) {
                    (*low, *high) = (low.min(*value), high.max(*value));
                }
            }
            largest = low.iter().zip(&*high).map(|(low, high)| high - low).fold(largest, f32::max);
        }
        largest
    };
    let chunks = (0..first.len().div_ceil(CHUNK)).into_par_iter();
    f64::from(chunks.map(largest).reduce(|| 0.0, f32::max)) / first.top()
}
