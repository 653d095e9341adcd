//! Where the points of the unit cube come from that scenes are functions of.

use std::fmt;
use std::str::FromStr;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use serde::{Deserialize, Serialize};

use crate::convention::Convention;
use crate::error::Error;
use crate::scene::{self, Kind, Scene};

/// Independent scramblings that the Sobol scenes of one seed come from.
///
/// Each gives an estimate of its own, and the error of the loss is seen in how these differ. With few, Student's t is
/// wide; with many, each is short and gains less from the sequence. At the gain that was measured, 8 gives the
/// shortest intervals, and 4 to 16 nearly as short.
pub const REPLICATES: usize = 8;

/// The longest Sobol sequence that the library makes. A longer replicate goes on with another scrambling.
const POINTS_PER_SCRAMBLING: usize = 1 << 16;

/// How scenes are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Sampler {
    /// Independent uniform points: [`scene::sample`].
    #[default]
    Random,
    /// [`REPLICATES`] independently scrambled Sobol sequences (Owen 1995, by Burley's hash of 2020) in turn: scene i
    /// of a kind is point i / 8 of sequence i mod 8. Best where each has a power of two of points.
    Sobol,
}

impl Sampler {
    /// The scenes of a seed: `near` near-field ones, then `distant` distant ones.
    ///
    /// The i-th scene of either kind depends on (`self`, `seed`, i, `convention`) only.
    pub fn scenes(self, seed: u64, near: usize, distant: usize, convention: &Convention) -> Vec<Scene> {
        match self {
            Self::Random => scene::sample(seed, near, distant, convention),
            Self::Sobol => {
                let near = (0..near).map(|i| Scene::near_from_point(sobol(seed, 0, i), convention));
                let distant = (0..distant).map(|i| Scene::distant_from_point(sobol(seed, 1, i), convention));
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

/// The point of the `index`-th Sobol scene of stream `stream` (0 near-field, 1 distant) of `seed`, in (0, 1).
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

/// The seed of a scrambling: bits of a ChaCha8 stream that [`scene::sample`] does not use.
fn scrambling(seed: u64, stream: u64, index: u64) -> u32 {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(2 + stream);
    generator.set_word_pos(u128::from(index));
    generator.next_u32()
}

impl FromStr for Sampler {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        match name {
            "random" => Ok(Self::Random),
            "sobol" => Ok(Self::Sobol),
            _ => Err(Error::UnknownName {
                what: "sampler",
                found: name.to_owned(),
                known: "random, sobol".to_owned(),
            }),
        }
    }
}

impl fmt::Display for Sampler {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Random => "random",
            Self::Sobol => "sobol",
        })
    }
}
