//! The content of a page: a figure, reports, how the files were read, and how to repeat it.

use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::Error;
use svbrdf_evaluate::analyses::{BlameReport, LossReport};
use svbrdf_evaluate::report::{Analysis as _, AnalysisInput, NoOptions};
use svbrdf_evaluate::why::{RankedScene, worst_on_all_texels};
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
    /// The findings of a comparison, whose predictions all have the same scenes.
    ///
    /// # Errors
    /// Those of [`LossReport::run`] and [`BlameReport::run`].
    pub fn new(input: &AnalysisInput<'_>, progress: &Progress) -> Result<Self, Error> {
        let loss = LossReport::run(input, &NoOptions {}, progress)?;
        let worst = input
            .comparing(|comparison| Ok(worst_on_all_texels(&comparison, &loss.outcome, SCENES, progress)?))?;
        let blame = BlameReport::run(input, &NoOptions {}, progress)?;
        Ok(Self { loss, blame, worst })
    }
}

/// The content of a report.
#[derive(Clone, Debug)]
pub struct PageReport<'a> {
    /// The ground truth, then the predictions, of one size.
    pub materials: &'a [&'a Material<f32>],
    /// Whether they are gray outside of a mask.
    pub is_masked: bool,
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
