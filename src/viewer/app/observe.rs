//! Observations of a window, for programs that drive it.

use svbrdf_core::loss::{Estimate, Loss};
use svbrdf_core::material::Material;
use svbrdf_core::picture::statistics::{Distributions, Histogram, Statistics};
use svbrdf_evaluate::diagnose::Diagnosis;
use svbrdf_evaluate::photograph::PhotographComparison;
use svbrdf_evaluate::study::Study;
use svbrdf_evaluate::why::{Attribution, Hemisphere, RankedScene, Worst};

use super::App;
use crate::jobs::training::RunView;
use crate::jobs::why::ComparedPair;
use crate::model::message::Message;

/// How the values of one channel of a material are distributed.
type ValueDistribution<'a> = (&'a Histogram, Option<Statistics>);

impl App {
    /// The losses of the predictions, once they are complete for the current materials and settings.
    pub fn losses(&self) -> Option<&[Loss]> {
        self.parts.jobs.loss.finished(&self.parts.model.materials, &self.parts.model.loss_query())
    }

    /// The study of the chosen pair as far as it has got, and whether it is complete.
    pub fn study(&self) -> Option<(&Study, bool)> {
        let (study, current) = self.parts.jobs.study.measured(
            &self.parts.model.materials,
            self.parts.model.view.display.prediction,
            &self.parts.model.view.convention(),
        )?;
        current.then_some((study, self.parts.jobs.study.job().is_none()))
    }

    /// The statistics of each prediction's difference in the panes, once they are up to date.
    pub fn difference_statistics(&self) -> Option<&[Option<Statistics>]> {
        let (distributions, current) = self.parts.displayed().distributions()?;
        current.then_some(distributions.statistics.as_slice())
    }

    /// The statistics, histograms and automatic range of the difference in the panes, once they are up to date.
    pub fn difference_distributions(&self) -> Option<&Distributions> {
        let (distributions, current) = self.parts.displayed().distributions()?;
        current.then_some(distributions)
    }

    /// For each channel of the quantity, histogram and statistics of the values of every material, once they are up to date.
    pub fn value_distributions(&self) -> Option<Vec<Vec<ValueDistribution<'_>>>> {
        let (values, current) =
            self.parts.jobs.panes.histograms.get(&self.parts.jobs.panes.displayed, &self.parts.model.view)?;
        current.then(|| {
            let channel = values.iter();
            channel.map(|all| all.iter().map(|one| (&one.histogram, one.statistics)).collect()).collect()
        })
    }

    /// The difference that has the last colour.
    pub fn difference_range(&self) -> f64 {
        self.parts.displayed().range()
    }

    /// Every material against the photograph, where the panes compare with one and it is there.
    pub fn against_photograph(&self) -> Option<&[PhotographComparison]> {
        self.parts.displayed().photographs().map(|all| all.comparisons.as_slice())
    }

    /// The corners of the material in the photograph; `None` for the whole picture, or without a photograph.
    pub fn photograph_corners(&self) -> Option<[[f64; 2]; 4]> {
        self.parts.model.photograph.source().and_then(|source| source.corners).map(|corners| corners.0)
    }

    /// The number of photographs in the filmstrip, once they have been read.
    pub fn filmstrip_length(&self) -> Option<usize> {
        let super::parts::Parts { model, jobs, .. } = &self.parts;
        let displayed = jobs.photograph.displayed(&model.photograph, self.parts.displayed().materials())?;
        displayed.filmstrip.map(|strip| strip.count())
    }

    /// What the panes show, the ground truth first: the materials, or a mixture in the place of one.
    pub fn displayed_materials(&self) -> Vec<(&str, &Material<f32>)> {
        self.parts.jobs.panes.displayed.iter().map(|one| (one.name(), one.material())).collect()
    }

    /// The latest losses of the predictions in one scene, and whether it is the current one.
    pub fn scene_losses(&self) -> Option<(&[f64], bool)> {
        self.parts.jobs.scene_loss.get(&self.parts.model.materials.all, &self.parts.model.view)
    }

    fn pair(&self) -> Option<ComparedPair> {
        ComparedPair::of(&self.parts.model.materials.all, &self.parts.model.view)
    }

    /// The diagnosis of the chosen prediction, after the floor of the ground truth.
    pub fn diagnosis(&self) -> Option<&Diagnosis> {
        let seed = self.parts.model.settings.loss.seed;
        self.parts.jobs.why.diagnosis.get(&self.pair()?, seed).map(|done| &done.diagnosis)
    }

    /// The attribution of the chosen prediction.
    pub fn attribution(&self) -> Option<&Attribution> {
        self.parts
            .jobs
            .why
            .attribution
            .get(&self.pair()?, &self.parts.model.settings.loss.seed)
            .map(|done| &done.attribution)
    }

    /// The listed scenes of the chosen prediction, and the pixels of their thumbnails.
    pub fn listed_scenes(&self) -> Option<(&[RankedScene], &[Vec<f32>])> {
        let (list, thumbnails) =
            self.parts.jobs.why.scenes.get(&self.pair()?, &self.parts.model.settings.loss.listed_scenes())?;
        Some((&list.ranked, &thumbnails?.pixels))
    }

    /// The map over directions of all predictions that is shown for the current scene, and the same before it is final.
    pub fn direction_map(&self) -> Option<&Hemisphere> {
        let (map, current) = self.parts.jobs.why.directions.get(
            &ComparedPair::all(&self.parts.model.materials.all, &self.parts.model.view),
            self.parts.model.why.moved,
            &self.parts.model.view.scene,
        )?;
        current.then_some(&map.map)
    }

    /// The worst scene that was found for the chosen prediction.
    pub fn worst(&self) -> Option<&Worst> {
        self.parts.jobs.why.search.found(&self.pair()?)
    }

    /// Whether the worst scene is being searched.
    pub fn is_searching(&self) -> bool {
        self.parts.jobs.why.search.busy().is_some()
    }

    /// The training runs in the window: the place of the prediction, the numbers of the steps, and the step that is shown.
    pub fn training_runs(&self) -> Vec<(usize, Vec<u64>, u64)> {
        let views = self
            .parts
            .jobs
            .training
            .views(&self.parts.model.materials.all, self.parts.model.training.requested.as_ref());
        let numbers = |view: &RunView<'_>| view.run.steps.iter().map(|step| step.number).collect();
        views.iter().map(|view| (view.index, numbers(view), view.number)).collect()
    }

    /// The losses of the steps of the run in this place, as far as they are known.
    pub fn step_losses(&self, index: usize) -> Vec<Option<Result<Estimate, String>>> {
        let views = self
            .parts
            .jobs
            .training
            .views(&self.parts.model.materials.all, self.parts.model.training.requested.as_ref());
        let view = views.iter().find(|view| view.index == index);
        view.map_or(Vec::new(), |view| view.losses.iter().map(|loss| loss.cloned()).collect())
    }

    /// The names of the materials, the ground truth first.
    pub fn names(&self) -> Vec<String> {
        self.parts.model.materials.all.iter().map(|s| s.name().to_owned()).collect()
    }

    /// The materials in the window, the ground truth first.
    pub fn materials(&self) -> impl Iterator<Item = &Material<f32>> {
        self.parts.model.materials.all.iter().map(|one| one.material())
    }

    /// Size of the panes and the legend, in pixels.
    pub fn picture_size(&self) -> [u32; 2] {
        self.parts.model.geometry.picture
    }

    /// Why a material is not what its files hold now, of each material.
    pub fn problems(&self) -> Vec<Option<&str>> {
        self.parts.model.materials.all.iter().map(|one| one.problem.as_deref()).collect()
    }

    /// Whether a material is being read.
    pub fn is_reading(&self) -> bool {
        !self.parts.jobs.openings.is_empty()
    }

    /// Whether a frame has panicked.
    pub fn has_crashed(&self) -> bool {
        self.crash.has_crashed()
    }

    /// The texts of the messages in the window: errors and results, the latest last.
    pub fn messages(&self) -> Vec<String> {
        self.parts.model.messages.iter().map(Message::to_string).collect()
    }
}
