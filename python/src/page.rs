//! The report, and the figure alone, as HTML.

use std::path::PathBuf;

use pyo3::prelude::*;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::report::Report as _;
use svbrdf_files::disk::atomic::write_text;
use svbrdf_files::session::window::SessionDisplay;
use svbrdf_page::{Findings, Repetition, Report, View, check_destination, exposure};

use crate::asked::Asked;
use crate::errors::{Error, exception};
use crate::model::SceneTuple;
use crate::work;

/// The largest exposure of a figure, in stops, in either direction.
const MOST_STOPS: f32 = 16.0;

/// The parts of a page, and what its figure begins with.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub struct PageAsked {
    scene: SceneTuple,
    /// In stops; `None`: automatic.
    exposure: Option<f32>,
    layout: String,
    max_bytes: usize,
    /// Of each material the assumptions and notes of reading it.
    readings: Vec<Vec<String>>,
    /// The call that makes the report; `None`: the figure alone.
    call: Option<String>,
    /// The file that is written; `None`: the text is returned.
    path: Option<PathBuf>,
}

/// A page.
#[derive(Debug, IntoPyObject)]
pub struct PageItems {
    /// Empty where a file was written.
    html: String,
    /// What its size has cost, and what is known less well than requested.
    warnings: Vec<String>,
}

/// The report of `predictions` against `ground_truth`.
#[pyfunction]
pub fn page(
    py: Python<'_>,
    asked: Asked<'_>,
    of_page: PageAsked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<PageItems> {
    if let Some(path) = &of_page.path {
        check_destination(path).map_err(exception)?;
    }
    let view = of_page.view()?;
    let request = of_page.call.is_some().then(|| asked.request()).transpose()?;
    let convention = asked.convention()?;
    let materials = asked.singles();
    let materials: Vec<&Material<f32>> = materials.iter().collect();
    work::run(py, progress, |progress| {
        let of = |request| Findings::new(materials[0], &materials[1..], convention, request, progress);
        let findings = request.as_ref().map(of).transpose()?;
        of_page.items(&materials, convention, view, findings, progress)
    })
}

impl PageAsked {
    fn view(&self) -> PyResult<View> {
        let scene = self.scene.scene()?;
        scene.check_usable().map_err(exception)?;
        let layout = self.layout.parse().map_err(exception)?;
        let display = SessionDisplay { layout, ..SessionDisplay::default() };
        if self.exposure.is_some_and(|exposure| !(-MOST_STOPS..=MOST_STOPS).contains(&exposure)) {
            return Err(Error::new_err(format!(
                "exposure: expected stops from -{MOST_STOPS} to {MOST_STOPS}"
            )));
        }
        Ok(View { scene, exposure_ev: 0.0, display })
    }

    fn items(
        self,
        materials: &[&Material<f32>],
        convention: Convention,
        view: View,
        findings: Option<Findings>,
        progress: &Progress,
    ) -> Result<PageItems, svbrdf_evaluate::Error> {
        let exposure_ev = self.exposure.unwrap_or_else(|| exposure(materials[0], &view.scene, &convention));
        let missed = findings.iter().flat_map(|findings| findings.loss.missed());
        let mut warnings: Vec<String> = missed.map(|missed| missed.to_string()).collect();
        let report = Report {
            materials,
            convention,
            view: View { exposure_ev, ..view },
            findings,
            readings: self.readings,
            repetition: self.call.map(|command| Repetition { command, session: None }),
            max_bytes: self.max_bytes,
        };
        let page = report.page(progress)?;
        if let Some([width, height]) = page.reduced_to {
            warnings.push(format!(
                "the maps of the figure are reduced to {width} x {height} texels for max_size={}; findings are of all texels",
                self.max_bytes
            ));
        }
        let html = match &self.path {
            Some(path) => write_text(path, &page.html, progress).map(|()| String::new())?,
            None => page.html,
        };
        Ok(PageItems { html, warnings })
    }
}
