//! The scenes and texels of a loss: the part of its settings that a point of the study can replace.

use super::loss_request::{Ask, LossSettings};
use crate::loss::Texels;
use crate::model::sampler::Sampler;
use crate::study::Choice;

/// How many scenes and texels a loss samples, and from what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampling {
    pub near: usize,
    pub distant: usize,
    pub sampler: Sampler,
    pub texels: Texels,
}

impl Sampling {
    /// That of `settings`; `None` where the loss chooses its own number of scenes.
    pub fn of(settings: &LossSettings) -> Option<Self> {
        let LossSettings { near, distant, sampler, texels, .. } = *settings;
        (settings.ask == Ask::Scenes).then_some(Self { near, distant, sampler, texels })
    }

    /// `settings` with this sampling.
    pub fn put_into(self, settings: &LossSettings) -> LossSettings {
        let Self { near, distant, sampler, texels } = self;
        LossSettings { ask: Ask::Scenes, near, distant, sampler, texels, ..settings.clone() }
    }
}

impl From<&Choice> for Sampling {
    fn from(choice: &Choice) -> Self {
        Self {
            near: choice.near(),
            distant: choice.distant(),
            sampler: choice.sampler,
            texels: choice.texels,
        }
    }
}
