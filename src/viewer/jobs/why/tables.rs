//! Tables of the analyses without a section in the tab, of all predictions one by one.

use std::time::Duration;

use serde_json::json;

use svbrdf_core::loss::{LossOptions, Request};
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::analyses::{ANALYSES, AnyAnalysis};
use svbrdf_evaluate::report::{AnalysisInput, Reader, SceneOptions, Table};

use crate::error::Error;
use crate::jobs::why::one_by_one::OneByOne;
use crate::jobs::why::pair::ComparedPair;
use crate::jobs::work::waker::Waker;

/// The analyses that have a section of their own.
const OWN_SECTIONS: [&str; 3] = ["blame", "scenes", "worst"];

/// The report of an analysis of one prediction.
#[derive(Clone, Debug)]
pub struct AnalysisTable {
    /// The lines about its settings.
    pub heading: String,
    pub table: Table,
}

/// The tables, by analysis.
#[derive(Debug)]
pub struct TableJobs(Vec<(&'static AnyAnalysis, OneByOne<AnalysisTable, Request>)>);

impl Default for TableJobs {
    fn default() -> Self {
        let others = ANALYSES.iter().filter(|analysis| !OWN_SECTIONS.contains(&analysis.name));
        Self(others.map(|analysis| (analysis, OneByOne::default())).collect())
    }
}

impl TableJobs {
    /// Takes over results, and computes the next ones that are missing, of the analyses that are open.
    pub fn follow(
        &mut self,
        waker: &Waker,
        is_open: impl Fn(&'static str) -> bool,
        of: (&[ComparedPair], usize),
        scenes: &Request,
    ) -> Option<Error> {
        let errors = self.0.iter_mut().map(|(analysis, tables)| {
            let analysis = *analysis;
            tables.follow(waker, is_open(analysis.name), of, scenes.clone(), move |pair, scenes, progress| {
                answer(analysis, pair, scenes, progress)
            })
        });
        // Each is followed, whatever another one has met.
        errors.fold(None, |first, error| first.or(error))
    }

    pub fn analyses(&self) -> impl Iterator<Item = &'static AnyAnalysis> {
        self.0.iter().map(|(analysis, _)| *analysis)
    }

    /// The table of this pair; until it is there, the share of the work that is done and its time.
    pub fn get(
        &self,
        analysis: &str,
        pair: &ComparedPair,
        scenes: &Request,
    ) -> Result<&AnalysisTable, Option<(f32, Duration)>> {
        let (_, tables) = self.0.iter().find(|(of, _)| of.name == analysis).ok_or(None)?;
        tables.get(pair, scenes).ok_or_else(|| tables.busy())
    }
}

fn answer(
    analysis: &AnyAnalysis,
    pair: &ComparedPair,
    scenes: Request,
    progress: &Progress,
) -> Result<AnalysisTable, Error> {
    let request = match analysis.scenes.contains(&SceneOptions::Sampled) {
        true => scenes,
        false => analysis.request(&LossOptions { seed: scenes.seed(), ..LossOptions::default() })?,
    };
    let (ground_truth, predictions) = (pair.ground_truth(), vec![pair.prediction()]);
    let input = AnalysisInput { ground_truth, predictions, convention: pair.convention, request };
    let report = analysis.run(&input, json!({}), progress)?;
    Ok(AnalysisTable { heading: report.heading(), table: report.table(Reader::Person) })
}
