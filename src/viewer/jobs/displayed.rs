//! Displayed difference: of the current scene, from a photograph, or averaged over the scenes of the loss.

use std::sync::Arc;

use svbrdf_core::loss::{Estimate, Request, Sampling};
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::Distributions;

use super::Jobs;
use super::answers::Answered;
use super::panes::RangeKey;
use super::panes::computed_maps::ComputedMaps;
use super::panes::photograph::{ComparePhotograph, DisplayedPhotograph, Photographs};
use crate::model::Model;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::view::ViewState;

/// What the panes display of the model, with the results of the jobs.
#[derive(Clone, Copy, Debug)]
pub struct Displayed<'a> {
    pub model: &'a Model,
    pub jobs: &'a Jobs,
    /// Whether this is a picture that is saved: with a caption and without controls.
    pub is_picture: bool,
}

impl<'a> Displayed<'a> {
    /// What the panes of the window display.
    pub fn of(model: &'a Model, jobs: &'a Jobs) -> Self {
        Self { model, jobs, is_picture: false }
    }

    /// The materials in the panes, the ground truth first: with a replacement of the chosen prediction where one is displayed.
    pub fn materials(self) -> &'a [LoadedMaterial] {
        &self.jobs.panes.displayed
    }

    /// The index of the chosen prediction; the ground truth's where there is no prediction.
    pub fn chosen(self) -> usize {
        (self.view().display.prediction + 1).min(self.materials().len().saturating_sub(1))
    }

    pub fn view(self) -> &'a ViewState {
        &self.model.view
    }

    /// The loss of each prediction in the window, where it is known: of a data set, the same as in its list and its table.
    pub fn losses(self) -> Vec<Option<Estimate>> {
        let (model, jobs) = (self.model, self.jobs);
        let predictions = model.materials.predictions();
        if model.dataset.open.is_none() {
            let found = jobs.loss.complete().unwrap_or_default();
            return (0..predictions.len()).map(|index| Some(found.get(index)?.estimate)).collect();
        }
        let known = |one: &LoadedMaterial| {
            let (case, method) = model.dataset.place(one.slot)?;
            (*jobs.dataset.losses.row(case)?.by_method.get(method)?).map(|known| known.estimate())
        };
        predictions.iter().map(known).collect()
    }

    /// The question about the photograph that is open, beside what the panes display.
    pub fn compared_photograph(self) -> Option<ComparePhotograph> {
        let (photograph, gpu) = (self.jobs.panes.photograph.clone(), self.jobs.gpu.as_ref());
        ComparePhotograph::of(&self.model.photograph, self.materials(), self.view(), photograph, gpu)
    }

    /// The difference in the panes, where no shader computes it and it is there.
    pub fn computed_maps(self) -> Option<&'a ComputedMaps> {
        self.jobs.panes.difference.as_ref().and_then(|(found, _)| found.maps())
    }

    /// The scenes of the error map, where the panes show it.
    pub fn error_map_scenes(self) -> Option<usize> {
        let count = || self.model.settings.loss.listed_scenes().count().unwrap_or(0);
        self.view().is_error_map().then(count)
    }

    /// The photograph, where the panes compare renderings with one. Maps, the error map and FLIP are of the ground truth.
    pub fn photograph(self) -> Option<DisplayedPhotograph<'a>> {
        let is_rendering = self.view().display.quantity == Quantity::Rendering && !self.view().is_computed();
        self.open_photograph().filter(|_| is_rendering && !self.materials().is_empty())
    }

    /// The photograph that is open beside the materials, perhaps at the exposures of an earlier scene.
    pub fn open_photograph(self) -> Option<DisplayedPhotograph<'a>> {
        let (source, now) = (self.model.photograph.source()?, self.compared_photograph()?);
        let photograph = self.jobs.panes.photograph.as_deref().map(|photograph| &photograph.answer);
        let all = self.jobs.panes.photographs.as_ref().filter(|(of, _)| of.is_like(&now));
        Some(DisplayedPhotograph { source, photograph, all: all.map(|(_, all)| &all.answer) })
    }

    /// The photograph beside every material, where the panes compare renderings with one and it is there.
    pub fn photographs(self) -> Option<&'a Arc<Answered<Photographs>>> {
        self.photograph()?.all?;
        self.jobs.panes.photographs.as_ref().map(|(_, all)| all)
    }

    /// The distributions of the difference in the panes, and whether they are up to date.
    pub fn distributions(self) -> Option<(&'a Distributions, bool)> {
        if self.photograph().is_some() {
            let ((of, all), now) = (self.jobs.panes.photographs.as_ref()?, self.compared_photograph()?);
            return of.has_kind_of(&now).then_some((&all.distributions, *of == now));
        }
        let (found, is_current) = self.jobs.panes.difference.as_ref()?;
        Some((found.distributions(), *is_current))
    }

    /// The difference that has the last colour: the range set, or the automatic one.
    pub fn range(self) -> f64 {
        let set = self.view().display.differences.range(self.view().display.quantity);
        set.unwrap_or_else(|| self.auto_range())
    }

    /// The automatic range of the difference. While a mixture or a corrected prediction is displayed it is that of the predictions
    /// themselves, so that all have the same colours.
    pub fn auto_range(self) -> f64 {
        let computed =
            self.jobs.panes.auto_range.as_ref().filter(|(key, _)| *key == RangeKey::of(self.model));
        let pinned = computed.filter(|_| self.view().display.is_replaced()).map(|(_, range)| *range);
        let latest = || self.distributions().map(|(distributions, _)| distributions.auto_range);
        pinned.or_else(latest).unwrap_or_else(|| self.view().difference_kind().default_range())
    }

    /// What the metadata of a picture say where it shows error maps.
    pub fn error_map_text(self) -> Option<String> {
        let loss = &self.model.settings.loss;
        let scenes = match (loss.listed_scenes(), loss.file_scenes()) {
            (Request::Scenes(Sampling { near, distant, seed, sampler, .. }), _) => {
                let sampler = if sampler == Sampler::Sobol { "scrambled Sobol" } else { "random" };
                format!("{near} near-field and {distant} distant scenes, seed {seed}, {sampler}")
            }
            (_, file) => {
                let (count, name) = file.map_or((0, ""), |file| (file.scenes.len(), file.name.as_str()));
                format!("{count} scenes of {name}")
            }
        };
        (self.view().display.difference && self.view().is_error_map()).then(|| {
            format!("mean log difference of each texel over {scenes}; {} the last colour", self.range())
        })
    }

    /// What the metadata of a picture say where it shows differences from a photograph.
    pub fn photograph_text(self) -> Option<String> {
        let kind = self.view().difference_kind();
        let photograph = self.photograph().filter(|_| self.view().display.difference)?;
        let factors = photograph.all?.comparisons.iter().map(|one| one.factor.to_string());
        Some(format!(
            "{} of renderings p from {} as g: {}, multiplied by {}; NaN or gray where it is clipped; {} the last colour",
            kind.name(),
            photograph.source.path.display(),
            kind.unit(),
            factors.collect::<Vec<_>>().join(" | "),
            self.range()
        ))
    }
}
