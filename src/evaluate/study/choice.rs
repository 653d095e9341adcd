//! The settings that a study measures.

use svbrdf_core::loss::{Precision, Sampling, Texels};
use svbrdf_core::material::Depth;
use svbrdf_core::model::sampler::Sampler;

/// Numbers of random scenes.
const RANDOM: &[usize] = &[9, 90, 900, 9000];
/// Numbers of Sobol scenes: a power of two of each kind for each scrambling.
const SOBOL: &[usize] = &[24, 48, 96, 192, 384, 768, 1536, 3072, 6144, 12_288, 24_576];
/// How many of these are measured on all texels.
const ON_ALL: usize = 9;
/// Numbers of texels per scene, where not all are compared.
const MORE: usize = 1024;
const FEW: usize = 128;

/// One setting of everything that trades time for accuracy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// Near-field and distant scenes, 2 : 1: a multiple of 3.
    pub scenes: usize,
    pub sampler: Sampler,
    pub texels: Texels,
    pub precision: Precision,
    /// How the maps are stored in files.
    pub maps: Depth,
}

/// Choices that differ in their numbers of scenes only: one colour in a plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    Random,
    Sobol,
    MoreTexels,
    FewTexels,
    F64,
    HalfMaps,
    EightBitMaps,
}

impl Default for Choice {
    /// The fewest Sobol scenes, in f32.
    fn default() -> Self {
        Self {
            scenes: 3,
            sampler: Sampler::Sobol,
            texels: Texels::All,
            precision: Precision::F32,
            maps: Depth::Float,
        }
    }
}

impl Choice {
    pub fn near(&self) -> usize {
        self.scenes / 3 * 2
    }

    pub fn distant(&self) -> usize {
        self.scenes / 3
    }

    /// The scenes and texels of this choice for a seed.
    pub fn sampling(&self, seed: u64) -> Sampling {
        let Self { sampler, texels, .. } = *self;
        Sampling { near: self.near(), distant: self.distant(), seed, sampler, texels }
    }

    /// The options of `svbrdf loss` that select this choice, except the maps.
    pub fn options(&self) -> String {
        let sampler = match self.sampler {
            Sampler::Random => String::new(),
            Sampler::Sobol => "--sampler sobol ".to_owned(),
        };
        let texels = match self.texels {
            Texels::All => String::new(),
            Texels::Sampled(count) => format!(" --texels {count}"),
        };
        let precision = if self.precision == Precision::F64 { " --precision f64" } else { "" };
        format!("{sampler}--near {} --distant {}{texels}{precision}", self.near(), self.distant())
    }

    pub fn family(&self) -> Family {
        match *self {
            Self { maps: Depth::Half, .. } => Family::HalfMaps,
            Self { maps: Depth::Eight | Depth::Sixteen, .. } => Family::EightBitMaps,
            Self { precision: Precision::F64, .. } => Family::F64,
            Self { texels: Texels::Sampled(FEW), .. } => Family::FewTexels,
            Self { texels: Texels::Sampled(_), .. } => Family::MoreTexels,
            Self { sampler: Sampler::Sobol, .. } => Family::Sobol,
            Self { sampler: Sampler::Random, .. } => Family::Random,
        }
    }

    /// The choice over the same scenes that is measured over many seeds: f32 with float maps.
    pub(super) fn base(self) -> Self {
        Self { precision: Precision::F32, maps: Depth::Float, ..self }
    }
}

impl Family {
    /// In the order of measurement: those over many seeds first.
    pub const ALL: [Self; 7] = [
        Self::FewTexels,
        Self::MoreTexels,
        Self::Sobol,
        Self::Random,
        Self::F64,
        Self::HalfMaps,
        Self::EightBitMaps,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::Random => "random scenes",
            Self::Sobol => "Sobol scenes",
            Self::MoreTexels => "Sobol, 1024 texels each",
            Self::FewTexels => "Sobol, 128 texels each",
            Self::F64 => "Sobol, f64",
            Self::HalfMaps => "Sobol, half maps",
            Self::EightBitMaps => "Sobol, 8-bit maps",
        }
    }

    /// 8-bit RGB, distinguishable with any colour vision (Okabe and Ito 2008).
    pub fn colour(self) -> [u8; 3] {
        match self {
            Self::Random => [213, 94, 0],
            Self::Sobol => [0, 158, 115],
            Self::MoreTexels => [86, 180, 233],
            Self::FewTexels => [0, 114, 178],
            Self::F64 => [130, 130, 130],
            Self::HalfMaps | Self::EightBitMaps => [204, 121, 167],
        }
    }

    /// The choices, by growing numbers of scenes.
    pub(super) fn choices(self) -> impl Iterator<Item = Choice> {
        let base = Choice::default();
        let on_all = &SOBOL[..ON_ALL];
        let (first, counts) = match self {
            Self::Random => (Choice { sampler: Sampler::Random, ..base }, RANDOM),
            Self::Sobol => (base, on_all),
            Self::MoreTexels => (Choice { texels: Texels::Sampled(MORE), ..base }, SOBOL),
            Self::FewTexels => (Choice { texels: Texels::Sampled(FEW), ..base }, SOBOL),
            Self::F64 => (Choice { precision: Precision::F64, ..base }, on_all),
            Self::HalfMaps => (Choice { maps: Depth::Half, ..base }, on_all),
            Self::EightBitMaps => (Choice { maps: Depth::Eight, ..base }, on_all),
        };
        counts.iter().map(move |&scenes| Choice { scenes, ..first })
    }
}
