//! Robustness of the order of methods over a data set.

use rayon::prelude::*;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::loss::{ALL_SCENES_TARGET, check_same_size};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error as FilesError;
use svbrdf_files::read::ReadOptions;

use super::bootstrap::{FEWEST, interval_of_mean};
use super::evaluate::open;
use super::record::{Case, DatasetReading, DatasetSettings};
use crate::error::Error;
use crate::report::{Compared, RobustReport};
use crate::robust::{Answered, RobustInput};

/// The answers about the materials of a data set.
#[derive(Clone, Debug)]
pub struct DatasetAnswers {
    /// The materials that all methods have, each with the answers about its predictions in the order of the methods.
    pub materials: Vec<(String, Vec<Answered>)>,
    /// The others, and the reason.
    pub failures: Vec<(String, String)>,
}

/// Asks the questions of [`RobustInput`] about the first prediction of every method for each of `cases`, in parallel. A material is one
/// step of `progress`.
///
/// # Errors
/// [`FilesError::NotADataSet`] for fewer than [`FEWEST`] materials; as [`RobustInput::answers`].
pub fn robust(
    cases: &[Case],
    settings: &DatasetSettings,
    reading: &DatasetReading,
    progress: &Progress,
) -> Result<DatasetAnswers, Error> {
    // What is missing is known before anything is computed.
    let is_whole = |case: &&Case| case.candidates.iter().all(|candidate| candidate.missing.is_none());
    enough(cases.iter().filter(is_whole).count(), settings)?;
    let (convention, seeds) = (settings.convention.convention, settings.seeds());
    progress.begin(cases.len() as u64);
    let of_case = |case: &Case| {
        let seed = seeds.get(case.index).copied().unwrap_or(settings.seed);
        let answers = answers(case, settings, reading, (convention, seed), progress)?;
        progress.step()?;
        Ok((case.material.clone(), answers))
    };
    let found = cases.par_iter().map(of_case).collect::<Result<Vec<_>, Error>>()?;
    let mut of = DatasetAnswers { materials: Vec::new(), failures: Vec::new() };
    for (material, answers) in found {
        match answers {
            Ok(answers) => of.materials.push((material, answers)),
            Err(problem) => of.failures.push((material, problem)),
        }
    }
    Ok(of)
}

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

impl DatasetAnswers {
    /// The report of the means over the materials, with paired intervals over them.
    ///
    /// # Errors
    /// [`FilesError::NotADataSet`] for fewer than [`FEWEST`] materials: they have no interval.
    pub fn report(self, settings: &DatasetSettings) -> Result<RobustReport, Error> {
        enough(self.materials.len(), settings)?;
        let (materials, answers): (Vec<_>, Vec<_>) = self.materials.into_iter().unzip();
        let Convention { name: convention, epsilon, .. } = settings.convention.convention;
        let ground_truth = settings.source.path().display().to_string();
        let compared = Compared { ground_truth, size: [0; 2], convention, epsilon };
        let methods: Vec<&str> = settings.methods.iter().map(String::as_str).collect();
        Ok(RobustReport::of_answers(compared, &methods, &over_materials(&answers)).over(materials))
    }
}

/// The answers to each question as means over the materials, with paired intervals over them.
fn over_materials(all: &[Vec<Answered>]) -> Vec<Answered> {
    let over = |(place, first): (usize, &Answered)| {
        let scores: Vec<&[f64]> = all.iter().map(|material| material[place].scores.as_slice()).collect();
        let methods = 0..first.scores.len();
        let paired = |a: usize, b: usize| scores.iter().map(|one| one[a] - one[b]).collect::<Vec<_>>();
        let mean = |a: usize| scores.iter().map(|one| one[a]).sum::<f64>() / scores.len() as f64;
        let row = |a: usize| methods.clone().map(|b| interval_of_mean(&paired(a, b))).collect();
        Answered {
            question: first.question.clone(),
            scores: methods.clone().map(mean).collect(),
            differences: methods.clone().map(row).collect(),
        }
    };
    all.first().into_iter().flatten().enumerate().map(over).collect()
}

/// The answers about a material, or why it cannot be asked about.
fn answers(
    case: &Case,
    settings: &DatasetSettings,
    reading: &DatasetReading,
    (convention, seed): (Convention, u64),
    progress: &Progress,
) -> Result<Result<Vec<Answered>, String>, Error> {
    let material = |path, options: &ReadOptions| Ok(open(path, options, reading.strict).found?.material);
    let opened = || -> Result<_, String> {
        let truth = material(&case.ground_truth, &reading.ground_truths)
            .map_err(|problem: String| format!("ground truth: {problem}"))?;
        let of_method = |method: &String| {
            let candidate = case.candidates.iter().find(|candidate| candidate.method == *method);
            let candidate = candidate.ok_or_else(|| "no prediction".to_owned())?;
            candidate.missing.clone().map_or(Ok(()), Err)?;
            let found = material(&candidate.path, reading.of_method(method))?;
            check_same_size(&truth, &found).map_err(|problem: CoreError| problem.to_string())?;
            Ok(found)
        };
        let named =
            |method: &String| of_method(method).map_err(|problem: String| format!("{method}: {problem}"));
        let predictions = settings.methods.iter().map(named).collect::<Result<Vec<_>, _>>()?;
        Ok((truth, predictions))
    };
    let (truth, predictions) = match opened() {
        Ok(opened) => opened,
        Err(problem) => return Ok(Err(problem)),
    };
    let target_error = settings.target_error.unwrap_or(ALL_SCENES_TARGET);
    let predictions = predictions.iter().collect();
    let input = RobustInput { ground_truth: &truth, predictions, convention, target_error, seed };
    Ok(Ok(input.answers(&progress.part())?))
}
