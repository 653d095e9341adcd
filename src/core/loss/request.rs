//! Requests: the scenes of a loss, its accuracy, or its time.

use std::fmt;
use std::str::FromStr;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::model::convention::Convention;
use crate::model::sampler::Sampler;
use crate::model::scene::Scene;

/// The target of [`Request::over_all_scenes`]: half of the 95% interval, as a share of the loss.
pub const ALL_SCENES_TARGET: f64 = 0.01;

/// What decides the scenes of a loss.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Request {
    /// Numbers of sampled scenes. The default: 6 near-field and 3 distant random ones, on all texels.
    Scenes(Sampling),
    /// As many scenes as every loss needs to be known this well.
    Accuracy {
        /// Half of the 95% interval, as a share of the loss.
        target: f64,
        /// Names the scenes.
        seed: u64,
    },
    /// As many scenes as fit into a time.
    Time {
        budget: Duration,
        /// Names the scenes.
        seed: u64,
    },
    /// These scenes, on all texels.
    Listed(Vec<Scene>),
}

impl Request {
    /// The loss over all scenes, known to +-1% at 95% confidence: what a loss over a few scenes estimates. With the most scenes that there
    /// may be, intervals may be wider.
    pub const fn over_all_scenes(seed: u64) -> Self {
        Self::Accuracy { target: ALL_SCENES_TARGET, seed }
    }

    /// The scenes, where neither an accuracy nor a time decides them.
    ///
    /// # Errors
    /// As [`Sampling::check`].
    pub fn scenes(&self, convention: &Convention) -> Result<Option<Vec<Scene>>, Error> {
        match self {
            Self::Scenes(sampling) => sampling.scenes(convention).map(Some),
            Self::Listed(scenes) => Ok(Some(scenes.clone())),
            Self::Accuracy { .. } | Self::Time { .. } => Ok(None),
        }
    }

    /// The number of scenes, where neither an accuracy nor a time decides it.
    pub fn count(&self) -> Option<usize> {
        match self {
            Self::Scenes(sampling) => Some(sampling.near + sampling.distant),
            Self::Listed(scenes) => Some(scenes.len()),
            Self::Accuracy { .. } | Self::Time { .. } => None,
        }
    }

    /// The scenes and texels, where they are sampled and neither an accuracy nor a time decides them.
    pub fn sampling(&self) -> Option<Sampling> {
        match self {
            Self::Scenes(sampling) => Some(*sampling),
            _ => None,
        }
    }

    /// The accuracy: half of the 95% interval, as a share of the loss; `None` where scenes or a time are asked for.
    pub fn target(&self) -> Option<f64> {
        match *self {
            Self::Accuracy { target, .. } => Some(target),
            _ => None,
        }
    }

    /// The same of the scenes of another seed.
    #[must_use]
    pub fn of_seed(self, seed: u64) -> Self {
        match self {
            Self::Scenes(sampling) => Self::Scenes(Sampling { seed, ..sampling }),
            Self::Accuracy { target, .. } => Self::Accuracy { target, seed },
            Self::Time { budget, .. } => Self::Time { budget, seed },
            listed => listed,
        }
    }

    /// What names the scenes; `None` where they are listed.
    pub fn seed(&self) -> Option<u64> {
        match self {
            Self::Scenes(Sampling { seed, .. }) | Self::Accuracy { seed, .. } | Self::Time { seed, .. } => {
                Some(*seed)
            }
            Self::Listed(_) => None,
        }
    }
}

impl Default for Request {
    fn default() -> Self {
        Self::Scenes(Sampling::default())
    }
}

/// Sampled scenes, and the texels that each is compared on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Sampling {
    /// N_S, the number of near-field scenes.
    pub near: usize,
    /// N_D, the number of distant scenes.
    pub distant: usize,
    /// Names the scenes: the i-th scene of a kind depends on it and on i alone.
    pub seed: u64,
    pub sampler: Sampler,
    pub texels: Texels,
}

impl Default for Sampling {
    fn default() -> Self {
        Self { near: 6, distant: 3, seed: 0, sampler: Sampler::Random, texels: Texels::All }
    }
}

impl Sampling {
    /// Most scenes of a loss, of both kinds together.
    pub const MAX_SCENES: usize = 10_000_000;

    /// The scenes that are listed one by one where no others are asked for.
    pub const LISTED: Self =
        Self { near: 128, distant: 64, seed: 0, sampler: Sampler::Sobol, texels: Texels::All };

    /// Whether there are scenes, and no more than [`Sampling::MAX_SCENES`].
    ///
    /// # Errors
    /// [`Error::SceneCount`].
    pub fn check(&self) -> Result<(), Error> {
        let count = self.near.saturating_add(self.distant);
        if count == 0 || count > Self::MAX_SCENES {
            return Err(Error::SceneCount { count, most: Self::MAX_SCENES });
        }
        Ok(())
    }

    /// The scenes: near-field ones before distant ones.
    ///
    /// # Errors
    /// As [`Sampling::check`].
    pub fn scenes(&self, convention: &Convention) -> Result<Vec<Scene>, Error> {
        self.check()?;
        Ok(self.sampler.scenes(self.seed, self.near, self.distant, convention))
    }
}

/// Which texels of the materials are compared in a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Texels {
    #[default]
    All,
    /// An independent random subset of this many texels per scene, at least one; all where the maps have no more.
    Sampled(usize),
}

impl Texels {
    /// The number of sampled texels of a map of `size` (width, height); `None` where all are compared.
    pub fn sampled(self, [width, height]: [usize; 2]) -> Option<usize> {
        match self {
            Self::Sampled(count) if count < width * height => Some(count),
            _ => None,
        }
    }
}

impl FromStr for Texels {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        match (text, text.parse()) {
            ("all", _) => Ok(Self::All),
            (_, Ok(count)) if count > 0 => Ok(Self::Sampled(count)),
            _ => Err(Error::unknown_name("number of texels", text, "all, or a number such as 256")),
        }
    }
}

impl fmt::Display for Texels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::All => f.write_str("all"),
            Self::Sampled(count) => count.fmt(f),
        }
    }
}

crate::choices! {
    /// The precision of materials and renderings.
    #[derive(Default)]
    Precision, "precision":
    #[default]
    F32 = "f32",
    F64 = "f64",
}
