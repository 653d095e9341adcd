//! Replacement of the chosen prediction in the panes: the prediction with one map alone wrong, or one map alone right, or with a change
//! that a diagnosis found.

use std::sync::Arc;

use svbrdf_core::material::{Map, Material};
use svbrdf_evaluate::diagnose::Change;
use svbrdf_gpu::Gpu;

use crate::error::Error;
use crate::jobs::answers::content::{Content, Given, read_all};
use crate::jobs::answers::{Answers, Question, Work};
use crate::jobs::reading::upload::{Uploaded, Uploads};
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::ReadMaterial;
use crate::model::view::ViewState;

/// What is shown in the place of a prediction.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Replacement {
    /// A mixture with the ground truth.
    Mixture { map: Map, only_right: bool },
    /// The prediction after a change.
    Corrected(Change),
}

/// A replacement of a prediction.
#[derive(Clone, Debug, PartialEq)]
pub struct Replace {
    /// The ground truth and the prediction.
    pair: [Content; 2],
    replacement: Replacement,
    gpu: Given<Option<Gpu>>,
}

impl Question for Replace {
    /// The replacement, and its maps on the adapter.
    type Answer = (Arc<ReadMaterial>, Option<Arc<Uploaded>>);
    const IS_SHORT: bool = true;
    const KEPT: usize = 1;

    fn answer(&self, _: &Work<'_, Self::Answer>) -> Result<Self::Answer, Error> {
        let read = read_all(&self.pair)?;
        let made = Arc::new(self.replacement.made([&read[0], &read[1]])?);
        let uploaded = self.gpu.0.as_ref().map(|gpu| Arc::new(Uploaded::new(gpu, made.material())));
        Ok((made, uploaded))
    }
}

impl Replace {
    /// The replacement that is wanted.
    fn of(materials: &[LoadedMaterial], view: &ViewState, gpu: Option<&Gpu>) -> Option<Self> {
        let [ground_truth, prediction] = [materials.first()?, materials.get(view.display.prediction + 1)?];
        let only_right = view.display.only_right;
        let mixture = view.display.isolated.map(|map| Replacement::Mixture { map, only_right });
        let corrected = view.display.corrected.filter(|change| change.fits(prediction.material().size()));
        let replacement = mixture.or(corrected.map(Replacement::Corrected))?;
        let pair = [ground_truth, prediction].map(Content::of);
        Some(Self { pair, replacement, gpu: Given(gpu.cloned()) })
    }

    /// `materials`, with the replacement in the place of the prediction that it is made of. While another one of the same materials
    /// is made, the one before it stays.
    pub fn displayed(
        answers: &Answers,
        uploads: &mut Uploads,
        gpu: Option<&Gpu>,
        (materials, view): (&[LoadedMaterial], &ViewState),
    ) -> Vec<LoadedMaterial> {
        let mut displayed = materials.to_vec();
        let Some(wanted) = Self::of(materials, view, gpu) else { return displayed };
        let latest = || answers.latest(|one: &Self| one.pair == wanted.pair);
        let found = answers.get(&wanted).ready().map(|made| (wanted.clone(), made)).or_else(latest);
        if let Some((of, made)) = found {
            let (read, uploaded) = &made.answer;
            // Also of a replacement that was not in the panes for a while.
            uploads.extend(uploaded.clone().map(|uploaded| (read.id, uploaded)));
            let replaced = &mut displayed[view.display.prediction + 1];
            let name = of.replacement.name(replaced.name());
            replaced.replace(read.clone(), name);
        }
        displayed
    }
}

impl Replacement {
    fn made(self, [ground_truth, prediction]: [&ReadMaterial; 2]) -> Result<ReadMaterial, Error> {
        let (truth, predicted) = (ground_truth.material(), prediction.material());
        let mixed = |base: &Material<f32>, other, map| base.with_maps_of(other, |of| of == map);
        let material = match self {
            Self::Mixture { map, only_right: true } => mixed(predicted, truth, map)?,
            Self::Mixture { map, only_right: false } => mixed(truth, predicted, map)?,
            Self::Corrected(change) => change.applied(predicted, &prediction.storage)?,
        };
        Ok(prediction.part(material.renamed(predicted.name())))
    }

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
