//! What the tests read of a window.

use svbrdf_core::loss::Loss;
use svbrdf_core::material::Material;
use svbrdf_core::picture::statistics::{Distributions, Statistics};
use svbrdf_evaluate::diagnose::Diagnosis;
use svbrdf_evaluate::photograph::PhotographComparison;
use svbrdf_evaluate::why::{Attribution, RankedScene, Worst};

use svbrdf_viewer::app::App;
use svbrdf_viewer::jobs::why::ComparedPair;
use svbrdf_viewer::model::message::Message;

/// What the tests read of a window.
pub trait Observed {
    fn app(&self) -> &App;

    /// The losses of the predictions, once they are complete for the current materials and settings.
    fn losses(&self) -> Option<&[Loss]> {
        self.app()
            .parts
            .jobs
            .loss
            .finished(&self.app().parts.model.materials, &self.app().parts.model.loss_query())
    }

    /// The statistics of each prediction's difference in the panes, once they are up to date.
    fn difference_statistics(&self) -> Option<&[Option<Statistics>]> {
        let (distributions, current) = self.app().parts.displayed().distributions()?;
        current.then_some(distributions.statistics.as_slice())
    }

    /// The statistics, histograms and automatic range of the difference in the panes, once they are up to date.
    fn difference_distributions(&self) -> Option<&Distributions> {
        let (distributions, current) = self.app().parts.displayed().distributions()?;
        current.then_some(distributions)
    }

    /// The difference that has the last colour.
    fn difference_range(&self) -> f64 {
        self.app().parts.displayed().range()
    }

    /// Every material against the photograph, where the panes compare with one and it is there.
    fn against_photograph(&self) -> Option<&[PhotographComparison]> {
        self.app().parts.displayed().photographs().map(|all| all.comparisons.as_slice())
    }

    /// What the panes show, the ground truth first: the materials, or a mixture in the place of one.
    fn displayed_materials(&self) -> Vec<(&str, &Material<f32>)> {
        self.app().parts.jobs.panes.displayed.iter().map(|one| (one.name(), one.material())).collect()
    }

    /// The latest losses of the predictions in one scene, and whether it is the current one.
    fn scene_losses(&self) -> Option<(&[f64], bool)> {
        self.app()
            .parts
            .jobs
            .scene_loss
            .get(&self.app().parts.model.materials.all, &self.app().parts.model.view)
    }

    /// The diagnosis of the chosen prediction, after the floor of the ground truth.
    fn diagnosis(&self) -> Option<&Diagnosis> {
        let seed = self.app().parts.model.settings.loss.seed;
        self.app().parts.jobs.why.diagnosis.get(&pair(self.app())?, seed).map(|done| &done.diagnosis)
    }

    /// The attribution of the chosen prediction.
    fn attribution(&self) -> Option<&Attribution> {
        self.app()
            .parts
            .jobs
            .why
            .attribution
            .get(&pair(self.app())?, &self.app().parts.model.settings.loss.seed)
            .map(|done| &done.attribution)
    }

    /// The listed scenes of the chosen prediction, and the pixels of their thumbnails.
    fn listed_scenes(&self) -> Option<(&[RankedScene], &[Vec<f32>])> {
        let (list, thumbnails) = self
            .app()
            .parts
            .jobs
            .why
            .scenes
            .get(&pair(self.app())?, &self.app().parts.model.settings.loss.listed_scenes())?;
        Some((list, &thumbnails?.pixels))
    }

    /// The worst scene that was found for the chosen prediction.
    fn worst(&self) -> Option<&Worst> {
        self.app().parts.jobs.why.search.found(&pair(self.app())?)
    }

    /// Whether the worst scene is being searched.
    fn is_searching(&self) -> bool {
        self.app().parts.jobs.why.search.busy().is_some()
    }

    /// The names of the materials, the ground truth first.
    fn names(&self) -> Vec<String> {
        self.app().parts.model.materials.all.iter().map(|s| s.name().to_owned()).collect()
    }

    /// The materials in the window, the ground truth first.
    fn materials(&self) -> impl Iterator<Item = &Material<f32>> {
        self.app().parts.model.materials.all.iter().map(|one| one.material())
    }

    /// Size of the panes and the legend, in pixels.
    fn picture_size(&self) -> [u32; 2] {
        self.app().parts.model.geometry.picture
    }

    /// Why a material is not what its files hold now, of each material.
    fn problems(&self) -> Vec<Option<&str>> {
        self.app().parts.model.materials.all.iter().map(|one| one.problem.as_deref()).collect()
    }

    /// Whether a material is being read.
    fn is_reading(&self) -> bool {
        !self.app().parts.jobs.openings.is_empty()
    }

    /// The texts of the messages in the window: errors and results, the latest last.
    fn messages(&self) -> Vec<String> {
        self.app().parts.model.messages.iter().map(Message::to_string).collect()
    }
}

impl Observed for App {
    fn app(&self) -> &App {
        self
    }
}

fn pair(app: &App) -> Option<ComparedPair> {
    ComparedPair::of(&app.parts.model.materials.all, &app.parts.model.view)
}
