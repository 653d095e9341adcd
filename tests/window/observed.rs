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
    /// The losses of the predictions, once they are complete for the current materials and settings.
    fn losses(&self) -> Option<&[Loss]>;
    /// The statistics of each prediction's difference in the panes, once they are up to date.
    fn difference_statistics(&self) -> Option<&[Option<Statistics>]>;
    /// The statistics, histograms and automatic range of the difference in the panes, once they are up to date.
    fn difference_distributions(&self) -> Option<&Distributions>;
    /// The difference that has the last colour.
    fn difference_range(&self) -> f64;
    /// Every material against the photograph, where the panes compare with one and it is there.
    fn against_photograph(&self) -> Option<&[PhotographComparison]>;
    /// What the panes show, the ground truth first: the materials, or a mixture in the place of one.
    fn displayed_materials(&self) -> Vec<(&str, &Material<f32>)>;
    /// The latest losses of the predictions in one scene, and whether it is the current one.
    fn scene_losses(&self) -> Option<(&[f64], bool)>;
    /// The diagnosis of the chosen prediction, after the floor of the ground truth.
    fn diagnosis(&self) -> Option<&Diagnosis>;
    /// The attribution of the chosen prediction.
    fn attribution(&self) -> Option<&Attribution>;
    /// The listed scenes of the chosen prediction, and the pixels of their thumbnails.
    fn listed_scenes(&self) -> Option<(&[RankedScene], &[Vec<f32>])>;
    /// The worst scene that was found for the chosen prediction.
    fn worst(&self) -> Option<&Worst>;
    /// Whether the worst scene is being searched.
    fn is_searching(&self) -> bool;
    /// The names of the materials, the ground truth first.
    fn names(&self) -> Vec<String>;
    /// The materials in the window, the ground truth first.
    fn materials(&self) -> impl Iterator<Item = &Material<f32>>;
    /// Size of the panes and the legend, in pixels.
    fn picture_size(&self) -> [u32; 2];
    /// Why a material is not what its files hold now, of each material.
    fn problems(&self) -> Vec<Option<&str>>;
    /// Whether a material is being read.
    fn is_reading(&self) -> bool;
    /// The texts of the messages in the window: errors and results, the latest last.
    fn messages(&self) -> Vec<String>;
}

impl Observed for App {
    fn losses(&self) -> Option<&[Loss]> {
        self.parts.jobs.loss.finished(&self.parts.model.materials, &self.parts.model.loss_query())
    }

    fn difference_statistics(&self) -> Option<&[Option<Statistics>]> {
        let (distributions, current) = self.parts.displayed().distributions()?;
        current.then_some(distributions.statistics.as_slice())
    }

    fn difference_distributions(&self) -> Option<&Distributions> {
        let (distributions, current) = self.parts.displayed().distributions()?;
        current.then_some(distributions)
    }

    fn difference_range(&self) -> f64 {
        self.parts.displayed().range()
    }

    fn against_photograph(&self) -> Option<&[PhotographComparison]> {
        self.parts.displayed().photographs().map(|all| all.comparisons.as_slice())
    }

    fn displayed_materials(&self) -> Vec<(&str, &Material<f32>)> {
        self.parts.jobs.panes.displayed.iter().map(|one| (one.name(), one.material())).collect()
    }

    fn scene_losses(&self) -> Option<(&[f64], bool)> {
        self.parts.jobs.scene_loss.get(&self.parts.model.materials.all, &self.parts.model.view)
    }

    fn diagnosis(&self) -> Option<&Diagnosis> {
        let seed = self.parts.model.settings.loss.seed;
        self.parts.jobs.why.diagnosis.get(&pair(self)?, seed).map(|done| &done.diagnosis)
    }

    fn attribution(&self) -> Option<&Attribution> {
        self.parts
            .jobs
            .why
            .attribution
            .get(&pair(self)?, &self.parts.model.settings.loss.seed)
            .map(|done| &done.attribution)
    }

    fn listed_scenes(&self) -> Option<(&[RankedScene], &[Vec<f32>])> {
        let (list, thumbnails) =
            self.parts.jobs.why.scenes.get(&pair(self)?, &self.parts.model.settings.loss.listed_scenes())?;
        Some((list, &thumbnails?.pixels))
    }

    fn worst(&self) -> Option<&Worst> {
        self.parts.jobs.why.search.found(&pair(self)?)
    }

    fn is_searching(&self) -> bool {
        self.parts.jobs.why.search.busy().is_some()
    }

    fn names(&self) -> Vec<String> {
        self.parts.model.materials.all.iter().map(|s| s.name().to_owned()).collect()
    }

    fn materials(&self) -> impl Iterator<Item = &Material<f32>> {
        self.parts.model.materials.all.iter().map(|one| one.material())
    }

    fn picture_size(&self) -> [u32; 2] {
        self.parts.model.geometry.picture
    }

    fn problems(&self) -> Vec<Option<&str>> {
        self.parts.model.materials.all.iter().map(|one| one.problem.as_deref()).collect()
    }

    fn is_reading(&self) -> bool {
        !self.parts.jobs.openings.is_empty()
    }

    fn messages(&self) -> Vec<String> {
        self.parts.model.messages.iter().map(Message::to_string).collect()
    }
}

fn pair(app: &App) -> Option<ComparedPair> {
    ComparedPair::of(&app.parts.model.materials.all, &app.parts.model.view)
}
