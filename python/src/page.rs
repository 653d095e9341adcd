//! The report, and the figure alone, as HTML.

use std::path::PathBuf;

use pyo3::prelude::*;
use serde_json::Value;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::report::Report as _;
use svbrdf_files::disk::atomic::write_text;
use svbrdf_files::session::window::SessionDisplay;
use svbrdf_page::{About, Findings, Repetition, Report, View, check_destination, exposure};

use crate::asked::Asked;
use crate::errors::{Error, exception};
use crate::material::CoreMaterial;
use crate::model::SceneTuple;
use crate::work;

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
    /// The texts of its authors as JSON, or the path of a TOML file with them; neither: [`About::default`].
    about: (Option<String>, Option<PathBuf>),
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
    ground_truth: &CoreMaterial,
    predictions: Vec<PyRef<'_, CoreMaterial>>,
    asked: Asked,
    of_page: PageAsked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<PageItems> {
    if let Some(path) = &of_page.path {
        check_destination(path).map_err(exception)?;
    }
    let (view, about) = (of_page.view()?, of_page.about()?);
    let request = of_page.call.is_some().then(|| asked.request()).transpose()?;
    let convention = asked.convention()?;
    let materials = asked.singles(ground_truth, &predictions);
    work::run(py, progress, |progress| {
        let findings = match (materials.as_slice(), &request) {
            ([ground_truth, predictions @ ..], Some(request)) if !predictions.is_empty() => {
                let predictions: Vec<_> = predictions.iter().collect();
                Some(Findings::new(ground_truth, &predictions, convention, request, progress)?)
            }
            _ => None,
        };
        of_page.items(&materials.iter().collect::<Vec<_>>(), convention, (view, about), findings, progress)
    })
}

impl PageAsked {
    fn view(&self) -> PyResult<View> {
        let scene = self.scene.scene()?;
        scene.check_usable().map_err(exception)?;
        let layout = self.layout.parse().map_err(exception)?;
        let display = SessionDisplay { layout, ..SessionDisplay::default() };
        Ok(View { scene, exposure_ev: 0.0, display })
    }

    fn about(&self) -> PyResult<About> {
        match &self.about {
            (Some(texts), _) => serde_json::from_str::<Value>(texts)
                .and_then(serde_json::from_value)
                .map_err(|problem| Error::new_err(format!("about: {problem}"))),
            (None, Some(path)) => About::read(path).map_err(exception),
            (None, None) => Ok(About::default()),
        }
    }

    fn items(
        self,
        materials: &[&Material<f32>],
        convention: Convention,
        (view, about): (View, About),
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
            about,
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
