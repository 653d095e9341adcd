//! Replacement of the chosen prediction in the panes: the prediction with one map alone wrong, or one map alone right, or with a change
//! that a diagnosis found.

use std::sync::Arc;

use svbrdf_core::material::{Map, Material};
use svbrdf_evaluate::diagnose::Change;
use svbrdf_gpu::Gpu;

use crate::error::Error;
use crate::jobs::Shown;
use crate::jobs::answers::content::{Content, Given, read_all};
use crate::jobs::answers::{Pace, Question, Work};
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::ReadMaterial;

/// What is shown in the place of a prediction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Replacement {
    /// A mixture with the ground truth.
    Mixture { map: Map, only_right: bool },
    /// The prediction after a change.
    Corrected(Change),
}

/// A replacement of a prediction.
#[derive(Clone, Debug, PartialEq)]
struct Replace {
    /// The ground truth and the prediction.
    pair: [Content; 2],
    replacement: Replacement,
    gpu: Given<Option<Gpu>>,
}

impl Question for Replace {
    /// The replacement, and what it is.
    type Answer = (Arc<ReadMaterial>, Replacement);
    const PACE: Pace = Pace::AtOnce;
    const KEPT: usize = 1;

    fn is_like(&self, earlier: &Self) -> bool {
        self.pair == earlier.pair
    }

    fn answer(&self, _: &Work<'_, Self::Answer>) -> Result<Self::Answer, Error> {
        let read = read_all(&self.pair)?;
        let (truth, prediction) = (read[0].material(), read[1].material());
        let mixed = |base: &Material<f32>, other, map| base.with_maps_of(other, |of| of == map);
        let material = match self.replacement {
            Replacement::Mixture { map, only_right: true } => mixed(prediction, truth, map)?,
            Replacement::Mixture { map, only_right: false } => mixed(truth, prediction, map)?,
            Replacement::Corrected(change) => change.applied(prediction, &read[1].storage)?,
        };
        let made = read[1].part(material.renamed(prediction.name()), self.gpu.0.as_ref());
        Ok((Arc::new(made), self.replacement))
    }
}

impl Replace {
    /// The replacement that is wanted.
    fn of(shown: Shown<'_>) -> Option<Self> {
        let (materials, display) = (&shown.model.materials.all, &shown.model.view.display);
        let [ground_truth, prediction] = [materials.first()?, materials.get(display.prediction + 1)?];
        let only_right = display.only_right;
        let mixture = display.isolated.map(|map| Replacement::Mixture { map, only_right });
        let corrected = display.corrected.filter(|change| change.fits(prediction.material().size()));
        let replacement = mixture.or(corrected.map(Replacement::Corrected))?;
        let pair = [ground_truth, prediction].map(Content::of);
        Some(Self { pair, replacement, gpu: Given(shown.jobs.gpu.clone()) })
    }
}

/// The materials in the window, with the replacement in the place of the prediction that it is made of. While another one of the same
/// materials is made, the one before it stays.
pub fn displayed(shown: Shown<'_>) -> Vec<LoadedMaterial> {
    let mut displayed = shown.model.materials.all.clone();
    let found = Replace::of(shown).and_then(|wanted| shown.jobs.answers.drawn(&wanted));
    if let Some((made, _)) = found {
        let (read, replacement) = &made.answer;
        let replaced = &mut displayed[shown.model.view.display.prediction + 1];
        replaced.replace(read.clone(), replacement.name(replaced.name()));
    }
    displayed
}

impl Replacement {
    /// The name of the replacement of the prediction `name`.
    fn name(self, name: &str) -> String {
        match self {
            Self::Mixture { map, only_right } => {
                let side = if only_right { "right" } else { "wrong" };
                format!("{name}, only its {} {side}", map.name())
            }
            Self::Corrected(change) => format!("{name}, {change}"),
        }
    }
}
