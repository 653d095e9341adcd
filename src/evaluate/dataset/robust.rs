//! Robustness of the order of methods over a data set.

use svbrdf_core::loss::{ALL_SCENES_TARGET, Comparison, Request};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::parallel;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error as FilesError;

use super::bootstrap::interval_of_median;
use super::evaluate::Evaluation;
use super::opened::materials_of;
use super::reading::DatasetReading;
use super::record::{Case, DatasetSettings};
use crate::error::Error;
use crate::report::Compared;
use crate::robust::{RobustReport, Scores, answers};

/// Asks the questions of [`RobustReport::new`] about the first prediction of every method for each of `cases`, in parallel, and reports the
/// means over the materials that all methods have. `tell` has a line for each other material. A material is one step of `progress`.
///
/// # Errors
/// [`FilesError::NotADataSet`] for fewer than 6 materials; as [`RobustReport::new`].
pub fn robust(
    cases: &[Case],
    settings: &DatasetSettings,
    reading: &DatasetReading,
    tell: impl Fn(&str),
    progress: &Progress,
) -> Result<RobustReport, Error> {
    // What is missing is known before anything is computed.
    let is_whole = |case: &&Case| case.candidates.iter().all(|candidate| candidate.missing.is_none());
    enough(cases.iter().filter(is_whole).count(), settings)?;
    let evaluation = Evaluation::new(settings, reading, None, progress)?;
    progress.begin(cases.len() as u64);
    let of_case = |index: usize| {
        let answers = of_material(&cases[index], &evaluation)?;
        progress.step()?;
        Ok::<_, Error>(answers)
    };
    let (mut materials, mut all) = (Vec::new(), Vec::new());
    let found = parallel::try_map(cases.len(), of_case)?;
    for (case, answers) in cases.iter().zip(found) {
        match answers {
            Ok(answers) => {
                materials.push(case.material.clone());
                all.push(answers);
            }
            Err(problem) => tell(&format!("{} is left out: {problem}", case.material)),
        }
    }
    enough(materials.len(), settings)?;
    let Convention { name: convention, epsilon, .. } = settings.convention.convention;
    let ground_truth = settings.source.path().display().to_string();
    let compared = Compared { ground_truth, size: [0; 2], masked: None, convention, epsilon };
    Ok(RobustReport::of_answers(compared, materials, &settings.methods, &over_materials(&all)))
}

/// The fewest materials whose signs can be significant.
const FEWEST: usize = 6;

/// Refuses fewer than [`FEWEST`] materials.
fn enough(count: usize, settings: &DatasetSettings) -> Result<(), FilesError> {
    if count >= FEWEST {
        return Ok(());
    }
    Err(FilesError::NotADataSet {
        path: settings.source.path().to_owned(),
        expected: format!("at least {FEWEST} materials that all methods have"),
        found: count.to_string(),
        remedy: "add materials, or ask about the predictions of one material",
    })
}

/// The answers to each question as means over the materials, with paired intervals over them.
fn over_materials(all: &[Vec<Scores>]) -> Vec<Scores> {
    let over = |(place, first): (usize, &Scores)| {
        let scores = || all.iter().map(|material| &material[place].scores);
        let mean = |a: usize| scores().map(|one| one[a]).sum::<f64>() / all.len() as f64;
        let paired = |a: usize, b: usize| scores().map(|one| one[a] - one[b]).collect::<Vec<_>>();
        let interval = |a, b| interval_of_median(&paired(a, b));
        Scores::new(first.question.clone(), (0..first.scores.len()).map(mean).collect(), interval)
    };
    all.first().into_iter().flatten().enumerate().map(over).collect()
}

/// The answers about a material, or why it cannot be asked about.
fn of_material(case: &Case, evaluation: &Evaluation<'_>) -> Result<Result<Vec<Scores>, String>, Error> {
    let Evaluation { settings, progress, .. } = evaluation;
    let materials = match opened(case, evaluation) {
        Ok(opened) => opened,
        Err(problem) => return Ok(Err(problem)),
    };
    let predictions: Vec<_> = materials[1..].iter().collect();
    let comparison = Comparison::new(&materials[0], &predictions, settings.convention.convention)?;
    let target = settings.scenes.target().unwrap_or(ALL_SCENES_TARGET);
    let usual = Request::Accuracy { target, seed: evaluation.seed(case) };
    Ok(Ok(answers(&comparison, &usual, &progress.part())?))
}

/// The ground truth, then the first prediction of every method.
fn opened(case: &Case, evaluation: &Evaluation<'_>) -> Result<Vec<Material<f32>>, String> {
    let methods = &evaluation.settings.methods;
    let of_method = |method: &String| case.candidates.iter().find(|one| one.method == *method);
    let candidates: Vec<_> = methods.iter().map(of_method).collect();
    let found = materials_of(case, &candidates, evaluation.reading).materials;
    let names = std::iter::once("ground truth").chain(methods.iter().map(String::as_str));
    let named = |(one, name): (Result<_, String>, &str)| one.map_err(|problem| format!("{name}: {problem}"));
    found.into_iter().zip(names).map(named).collect()
}
