//! What the tests read of a window.

use svbrdf_core::loss::Loss;
use svbrdf_core::material::Material;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::statistics::{Distributions, Statistics};
use svbrdf_evaluate::diagnose::Diagnosis;
use svbrdf_evaluate::photograph::PhotographComparison;
use svbrdf_evaluate::why::{Attribution, RankedScene, Worst};
use svbrdf_viewer::frame::App;
use svbrdf_viewer::jobs::answers::content::ComparedPair;
use svbrdf_viewer::jobs::{Jobs, Shown};
use svbrdf_viewer::loss::losses::DrawnLosses;
use svbrdf_viewer::message::Message;
use svbrdf_viewer::model::Model;
use svbrdf_viewer::model::material::loaded::LoadedMaterial;
use svbrdf_viewer::model::view::ViewState;
use svbrdf_viewer::pane::Displayed;
use svbrdf_viewer::why::SceneLosses;
use svbrdf_viewer::why::diagnosis::known_diagnosis;
use svbrdf_viewer::why::maps::Attribute;
use svbrdf_viewer::why::scenes::{DrawScenes, FindWorst, RankScenes};
use svbrdf_viewer::why::thumbnails::MOST;

/// What the tests read of a window.
pub trait Observed {
    fn app(&self) -> &App;

    fn model(&self) -> &Model {
        &self.app().parts.model
    }

    fn view(&self) -> &ViewState {
        &self.model().view
    }

    fn scene(&self) -> Scene {
        self.view().scene
    }

    fn jobs(&self) -> &Jobs {
        &self.app().parts.jobs
    }

    /// What a panel draws, and what it asks.
    fn shown(&self) -> Shown<'_> {
        Shown { model: self.model(), jobs: self.jobs() }
    }

    /// What the panes display.
    fn displayed(&self) -> Displayed<'_> {
        self.app().parts.displayed()
    }

    /// The ground truth and the chosen prediction.
    fn pair(&self) -> Option<ComparedPair> {
        ComparedPair::of(&self.model().materials.all, self.view())
    }

    /// The losses of the predictions, once they are complete for the current materials and settings.
    fn losses(&self) -> Option<Vec<Loss>> {
        DrawnLosses::ask(self.shown()).complete().map(<[Loss]>::to_vec)
    }

    /// The statistics of each prediction's difference in the panes, once they are up to date.
    fn difference_statistics(&self) -> Option<Vec<Option<Statistics>>> {
        Some(self.difference_distributions()?.statistics)
    }

    /// The statistics, histograms and automatic range of the difference in the panes, once they are up to date.
    fn difference_distributions(&self) -> Option<Distributions> {
        let displayed = self.displayed();
        let (distributions, current) = displayed.distributions()?;
        current.then(|| distributions.clone())
    }

    /// The difference that has the last colour.
    fn difference_range(&self) -> f64 {
        self.displayed().range()
    }

    /// Every material against the photograph, where the panes compare with one and it is there.
    fn against_photograph(&self) -> Option<Vec<PhotographComparison>> {
        self.displayed().photographs().map(|all| all.comparisons.clone())
    }

    /// What the panes show, the ground truth first: the materials, or a mixture in the place of one.
    fn displayed_materials(&self) -> Vec<(String, Material<f32>)> {
        let named = |one: &LoadedMaterial| (one.name().to_owned(), one.material().clone());
        self.displayed().materials().iter().map(named).collect()
    }

    /// The latest losses of the predictions in one scene, and whether it is the current one.
    fn scene_losses(&self) -> Option<(Vec<f64>, bool)> {
        let (all, answers) = (&self.model().materials.all, &self.jobs().answers);
        let (losses, is_current) = answers.drawn(&SceneLosses::of(all, self.view())?)?;
        Some((losses.to_vec(), is_current))
    }

    /// The diagnosis of the chosen prediction, after the floor of the ground truth.
    fn diagnosis(&self) -> Option<Diagnosis> {
        let seed = self.model().settings.loss.seed;
        known_diagnosis(&self.jobs().answers, &self.pair()?, seed).map(|found| found.answer.clone())
    }

    /// The attribution of the chosen prediction.
    fn attribution(&self) -> Option<Attribution> {
        let (pair, seed) = (self.pair()?, self.model().settings.loss.seed);
        self.jobs().answers.known(&Attribute { pair, seed }).map(|found| found.answer.clone())
    }

    /// The listed scenes of the chosen prediction, and the pixels of their thumbnails.
    fn listed_scenes(&self) -> Option<(Vec<RankedScene>, Vec<Vec<f32>>)> {
        let (pair, scenes) = (self.pair()?, self.model().settings.loss.listed_scenes());
        let list = self.jobs().answers.known(&RankScenes { pair: pair.clone(), scenes })?;
        let scenes = list.iter().take(MOST).map(|ranked| ranked.scene).collect();
        let thumbnails = self.jobs().answers.known(&DrawScenes { pair, scenes })?;
        Some((list.to_vec(), thumbnails.pixels.clone()))
    }

    /// The worst scene that was found for the chosen prediction.
    fn worst(&self) -> Option<Worst> {
        let (pair, seed) = (self.pair()?, self.model().settings.loss.seed);
        self.jobs().answers.known(&FindWorst { pair, seed }).map(|found| found.answer.clone())
    }

    /// The names of the materials, the ground truth first.
    fn names(&self) -> Vec<String> {
        self.model().materials.all.iter().map(|one| one.name().to_owned()).collect()
    }

    /// The materials in the window, the ground truth first.
    fn materials(&self) -> impl Iterator<Item = &Material<f32>> {
        self.model().materials.all.iter().map(|one| one.material())
    }

    /// Why the material is not what its files hold now.
    fn problem(&self, index: usize) -> Option<&str> {
        self.model().materials.all[index].problem.as_deref()
    }

    /// Whether a material is being read.
    fn is_reading(&self) -> bool {
        !self.model().materials.openings.is_empty()
    }

    /// The texts of the messages in the window: errors and results, the latest last.
    fn messages(&self) -> Vec<String> {
        self.model().messages.iter().map(Message::to_string).collect()
    }
}

impl Observed for App {
    fn app(&self) -> &App {
        self
    }
}

impl Observed for super::Window<'_> {
    fn app(&self) -> &App {
        self.state()
    }
}
