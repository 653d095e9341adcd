//! Points of the unit cube for scenes: random, or scrambled Sobol sequences.

use rand::rngs::ChaCha8Rng;
use rand::{Rng as _, SeedableRng as _};

use super::convention::Convention;
use super::scene::{self, Kind, Scene};

/// Independent scramblings of the Sobol sequence per seed.
///
/// Each gives an estimate; the error of the loss follows from their spread. With few scramblings, Student's t is wide;
/// with many, each is short and gains less from the sequence. Where the variance falls as n^-1.6, 8 gives about the
/// shortest intervals (estimated, not measured).
pub const REPLICATES: usize = 8;

/// The longest Sobol sequence of the library. A longer replicate continues with another scrambling.
const POINTS_PER_SCRAMBLING: usize = 1 << 16;

crate::choices! {
    /// How scenes are sampled.
    #[derive(Default)]
    #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
    Sampler, "sampler":
    /// Independent uniform points: [`scene::sample`].
    #[default]
    Random = "random",
    /// [`REPLICATES`] independently scrambled Sobol sequences (Owen 1995, by Burley's hash of 2020) in turn: scene i
    /// of a kind is point i / 8 of sequence i mod 8. Best where each has a power of two of points.
    Sobol = "sobol",
}

impl Sampler {
    /// The scenes of a seed: `near` near-field ones, then `distant` distant ones.
    ///
    /// The i-th scene of either kind depends on (`self`, `seed`, i, `convention`) only.
    pub fn scenes(self, seed: u64, near: usize, distant: usize, convention: &Convention) -> Vec<Scene> {
        match self {
            Self::Random => scene::sample(seed, near, distant, convention),
            Self::Sobol => {
                let near =
                    (0..near).map(|i| Scene::near_from_point(near_order(sobol(seed, 0, i)), convention));
                let distant = (0..distant)
                    .map(|i| Scene::distant_from_point(distant_order(sobol(seed, 1, i)), convention));
                near.chain(distant).collect()
            }
        }
    }

    /// Which independent unit the `index`-th scene of a kind belongs to: itself, or its scrambling.
    pub fn unit(self, index: usize) -> usize {
        match self {
            Self::Random => index,
            Self::Sobol => index % REPLICATES,
        }
    }

    /// `count` texels of a map of `size` (width, height), as row * width + column, for the `index`-th scene of a kind.
    ///
    /// Every texel is as likely as any other, within one part in 2^64 of all, and may come more than once. They are
    /// points of Roberts' sequence R2 (2018, The unreasonable effectiveness of quasirandom sequences), shifted at random
    /// (Cranley and Patterson 1976). The scenes of one unit share a shift and take turns, so that together they see
    /// the map evenly.
    pub fn texels(
        self,
        seed: u64,
        kind: Kind,
        index: usize,
        count: usize,
        [width, height]: [usize; 2],
    ) -> Vec<usize> {
        /// 2^64 over the plastic number, and over its square.
        const STEP: [u64; 2] = [0xc13f_a9a9_02a6_328f, 0x91e1_0da5_c79e_7b1c];
        let (unit, first) = match self {
            Self::Random => (index, 0),
            Self::Sobol => (index % REPLICATES, index / REPLICATES * count),
        };
        let stream = match (self, kind) {
            (Self::Sobol, Kind::Near) => 4,
            (Self::Sobol, Kind::Distant) => 5,
            (Self::Random, Kind::Near) => 6,
            (Self::Random, Kind::Distant) => 7,
        };
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(stream);
        generator.set_word_pos(4 * unit as u128);
        let shift = [generator.next_u64(), generator.next_u64()];
        let cell = |shift: u64, step: u64, point: usize, cells: usize| {
            let at = shift.wrapping_add(step.wrapping_mul(point as u64));
            ((u128::from(at) * cells as u128) >> 64) as usize
        };
        let texel =
            |point| cell(shift[1], STEP[1], point, height) * width + cell(shift[0], STEP[0], point, width);
        (first..first + count).map(texel).collect()
    }

    /// The values of the scenes of one kind, by independent unit.
    pub(crate) fn units(self, scenes: &[Scene], values: &[f64], kind: Kind) -> Vec<Vec<f64>> {
        let of_kind = scenes.iter().zip(values).filter(|(scene, _)| scene.kind == kind);
        let mut units: Vec<Vec<f64>> = Vec::new();
        for (index, (_, &value)) in of_kind.enumerate() {
            let unit = self.unit(index);
            if unit == units.len() {
                units.push(Vec::new());
            }
            units[unit].push(value);
        }
        units
    }
}

/// The `index`-th Sobol point of stream `stream` (0 near-field scenes, 1 distant ones) of `seed`, in (0, 1).
fn sobol<const N: usize>(seed: u64, stream: u64, index: usize) -> [f64; N] {
    /// Half the distance between two numbers of the sequence, which is in [0, 1).
    const HALF_STEP: f64 = 1.0 / (1u64 << 25) as f64;
    let (replicate, point) = (index % REPLICATES, index / REPLICATES);
    let (turn, point) = (point / POINTS_PER_SCRAMBLING, point % POINTS_PER_SCRAMBLING);
    let scrambling = scrambling(seed, stream, (turn * REPLICATES + replicate) as u64);
    std::array::from_fn(|dimension| {
        f64::from(sobol_burley::sample(point as u32, dimension as u32, scrambling)) + HALF_STEP
    })
}

/// Puts a scrambled Sobol point, whose first dimensions are the most even together, in the order of
/// [`Scene::near_from_point`]. This order gave the smallest errors of all 720 on four pairs of materials.
fn near_order([light, view, y, u1, x, u2]: [f64; 6]) -> [f64; 6] {
    [x, y, u1, u2, view, light]
}

/// The same for [`Scene::distant_from_point`]. The light's azimuth is counted from the view's, which keeps it uniform:
/// highlights depend on the angle between the two and hardly on either.
fn distant_order([view_u2, view_u1, light_u1, between]: [f64; 4]) -> [f64; 4] {
    [view_u1, view_u2, light_u1, (view_u2 + between).fract()]
}

/// The seed of a scrambling: bits of a ChaCha8 stream that [`scene::sample`] does not use.
fn scrambling(seed: u64, stream: u64, index: u64) -> u32 {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(2 + stream);
    generator.set_word_pos(u128::from(index));
    generator.next_u32()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How far the least and the most frequent of 7 x 5 texels are from the mean.
    fn unevenness(draw: impl Fn(u64) -> Vec<usize>) -> f64 {
        let mut counts = [0usize; 35];
        (0..20_000).flat_map(draw).for_each(|texel| counts[texel] += 1);
        let mean = counts.iter().sum::<usize>() as f64 / 35.0;
        counts.iter().map(|&count| (count as f64 / mean - 1.0).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn every_texel_is_as_likely_as_any_other() {
        let draw =
            |sampler: Sampler, kind| move |seed| sampler.texels(seed, kind, (seed % 17) as usize, 20, [7, 5]);
        for sampler in [Sampler::Random, Sampler::Sobol] {
            for kind in [Kind::Near, Kind::Distant] {
                let found = unevenness(draw(sampler, kind));
                assert!(found < 0.05, "{sampler}, {kind:?}: {found}");
            }
        }
        let faulty =
            |seed| draw(Sampler::Sobol, Kind::Near)(seed).into_iter().map(|texel| texel.max(1)).collect();
        assert!(unevenness(faulty) > 0.5, "the first texel never comes");
    }

    #[test]
    fn scenes_have_texels_of_their_own_and_a_unit_sees_the_map_evenly() {
        let draw = |sampler: Sampler, kind, index| sampler.texels(3, kind, index, 64, [256, 256]);
        for sampler in [Sampler::Random, Sampler::Sobol] {
            assert_eq!(draw(sampler, Kind::Near, 1), draw(sampler, Kind::Near, 1));
            assert_ne!(draw(sampler, Kind::Near, 0), draw(sampler, Kind::Near, 1));
            assert_ne!(draw(sampler, Kind::Near, 0), draw(sampler, Kind::Near, REPLICATES));
            assert_ne!(draw(sampler, Kind::Near, 0), draw(sampler, Kind::Distant, 0));
        }
        // 4 scenes of 64 texels: in nearly every one of 12 x 12 cells, of which independent texels miss 17%.
        let mut cells = std::collections::HashSet::new();
        for scene in 0..4 {
            let texels = draw(Sampler::Sobol, Kind::Near, scene * REPLICATES);
            cells.extend(texels.iter().map(|texel| (texel % 256 * 12 / 256, texel / 256 * 12 / 256)));
        }
        assert!(cells.len() >= 140, "{}", cells.len());
    }
}
