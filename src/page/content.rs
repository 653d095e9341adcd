//! The content of a page: a figure, reports, how the files were read, and how to repeat it.

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::analyses::{BlameReport, LossReport};
use svbrdf_evaluate::report::Compared;
use svbrdf_evaluate::why::{RankedScene, attribute, worst_on_all_texels};
use svbrdf_files::Error;
use svbrdf_files::session::window::SessionDisplay;

/// Worst scenes of the page.
const SCENES: usize = 6;

/// What the figure displays at first.
#[derive(Clone, Debug)]
pub struct View {
    pub scene: Scene,
    /// In stops.
    pub exposure_ev: f32,
    pub display: SessionDisplay,
}

/// The results of a comparison.
#[derive(Clone, Debug)]
pub struct Findings {
    pub loss: LossReport,
    pub blame: BlameReport,
    /// The worst scenes of the loss, worst first, with their losses on all texels.
    pub worst: Vec<RankedScene>,
}

impl Findings {
    /// The findings of `request`, which every prediction has in the same scenes.
    ///
    /// # Errors
    /// Those of [`Comparison::run`] and [`attribute`].
    pub fn new(
        ground_truth: &Material<f32>,
        predictions: &[&Material<f32>],
        convention: Convention,
        request: &Request,
        progress: &Progress,
    ) -> Result<Self, Error> {
        let comparison = Comparison::new(ground_truth, predictions, convention)?;
        let outcome = comparison.run(request, progress)?;
        let worst = worst_on_all_texels(&comparison, &outcome, SCENES, progress)?;
        let loss = LossReport::new(&comparison, request, outcome);
        let one =
            |prediction: &&Material<f32>| attribute(ground_truth, prediction, &convention, request, progress);
        let attributions = predictions.iter().map(one).collect::<Result<_, _>>()?;
        let blame = BlameReport::new(Compared::new(ground_truth, &convention), request, attributions);
        Ok(Self { loss, blame, worst })
    }
}

/// The content of a report.
#[derive(Clone, Debug)]
pub struct PageReport<'a> {
    /// The ground truth, then the predictions, of one size.
    pub materials: &'a [&'a Material<f32>],
    pub convention: Convention,
    pub view: View,
    /// `None`: the figure alone.
    pub findings: Option<Findings>,
    /// For each material the assumptions and notes of reading it; empty: not written.
    pub readings: Vec<Vec<String>>,
    /// The command that makes it again; `None`: not written.
    pub command: Option<String>,
    /// Most bytes of the file: maps are halved until it fits.
    pub max_bytes: usize,
}
