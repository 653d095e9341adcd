//! Methods over many materials.

use std::path::{Path, PathBuf};

use svbrdf_core::progress::Progress;
use svbrdf_evaluate::KeptAnswer;
use svbrdf_evaluate::dataset::{
    self, Case, DatasetReading, DatasetReport, DatasetSettings, MaterialResult, Pick, Shard,
};
use svbrdf_evaluate::metrics::MetricSelection;
use svbrdf_evaluate::report::Report as _;
use svbrdf_evaluate::robust::RobustReport;
use svbrdf_files::disk::atomic::write_text;
use svbrdf_page::{Figures, check_destination, material_views, ranking};

use super::args::{DataSetArgs, OutputArgs, RankArgs, RankFormat, check_limit, refuse_scenes};
use super::cases::{reading, source};
use crate::cli::args::{Specified, refuse};
use crate::cli::job::{Job, NewJob};
use crate::cli::output::{COMMIT, CommandError, exit, stoppable, warn_of, watched_on};

/// A ranking of methods over a data set.
#[derive(Debug)]
struct ManyJob {
    settings: DatasetSettings,
    reading: DatasetReading,
    cases: Vec<Case>,
    shard: Option<Shard>,
    results: Option<PathBuf>,
    pick: Pick,
    verbose: bool,
    fail_above: Option<f64>,
    /// Whether the order under other questions is asked for: below the ranking of a page, or alone.
    robust: bool,
    output: Output,
}

/// Where the ranking goes.
#[derive(Debug)]
enum Output {
    Text(OutputArgs),
    Page { path: PathBuf, figures: Option<Figures> },
}

pub fn job(args: RankArgs, given: &Specified) -> NewJob {
    Ok(Box::new(new(args, given)?))
}

/// What the ranking of these arguments writes in a format.
pub fn written(mut args: RankArgs, given: &Specified, format: RankFormat) -> Result<String, CommandError> {
    args.output = OutputArgs::printed(RankFormat::Json);
    // The words are those of a document, which names no place that is written; and what is known already is no check.
    args.of_data_set.results = None;
    let robust = std::mem::take(&mut args.robust);
    let (job, progress) = (new(args, given)?, Progress::default());
    let cases = part(job.shard, job.cases.clone());
    let (report, _) = job.report(&cases, true, &progress)?;
    Ok(match format {
        RankFormat::Html => {
            let robust =
                robust.then(|| asked(&cases, &report.settings, &report.reading, &progress)).transpose()?;
            let views = material_views(&report, &cases, None, Path::new(""), &progress)?;
            ranking(&report, &views, robust.as_ref())
        }
        format => OutputArgs::printed(format).text(&report, DatasetReport::latex)?,
    })
}

fn new(args: RankArgs, given: &Specified) -> Result<ManyJob, CommandError> {
    if args.robust {
        refuse_scenes(given)?;
    }
    let source = source(&args.comparison.materials, args.pairs)?;
    let cases = source.cases()?;
    let output = output(&args, given, &cases)?;
    let DataSetArgs { results, shard, pick, metrics, protocol, common, diagnose } = args.of_data_set;
    let mask = args.mask.mask;
    let typed = args.scenes.options()?;
    let (convention, options) = protocol.decided(args.comparison.convention.as_ref(), typed, given)?;
    let protocol = protocol.protocol.map(|one| *one);
    let words = |words: Vec<String>| words.into_iter().filter(|word| !word.is_empty()).collect::<Vec<_>>();
    let metrics = metrics.map(|given| MetricSelection::try_from(words(given))).transpose()?;
    let request = options.request()?;
    let settings = DatasetSettings::new(source, convention.unwrap_or_default(), request, &cases);
    let settings = settings.following(&options, metrics, protocol.clone())?;
    let DatasetSettings { scenes, metrics, .. } = &settings;
    if scenes.target().is_some() && metrics.as_ref().is_some_and(MetricSelection::needs_scenes) {
        let problem = "metrics of renderings need scenes; give --near and --distant, --lights or --scenes";
        return Err(CommandError::usage(problem));
    }
    refuse(
        mask.is_some() && diagnose,
        "diagnose",
        "a diagnosis is of all texels, and not of those of a mask",
    )?;
    refuse(mask.is_some() && args.robust, "robust", "the order under other questions is over all texels")?;
    let settings = DatasetSettings { diagnose, common, ..settings };
    let given = &args.comparison.materials.reading;
    let reading = DatasetReading { mask, ..reading(given, &settings.methods)? };
    let reading = protocol.iter().fold(reading, DatasetReading::over);
    let (verbose, fail_above, robust) = (given.both.verbose, args.fail_above, args.robust);
    Ok(ManyJob { settings, reading, cases, shard, results, pick, verbose, fail_above, robust, output })
}

/// Where the ranking goes, before anything is computed: to a file that replaces no material and no list, or to stdout.
fn output(args: &RankArgs, given: &Specified, cases: &[Case]) -> Result<Output, CommandError> {
    let output = &args.output;
    let predictions = cases.iter().flat_map(|case| case.candidates.iter().map(|one| &one.path));
    let materials = cases.iter().map(|case| &case.ground_truth).chain(predictions);
    output.check(materials.chain(args.comparison.materials.paths()))?;
    if output.format() != RankFormat::Html {
        refuse(args.figures.is_some(), "figures", "only --format html has figures beside it")?;
        if args.robust {
            let reason = "the order under other questions has no results folder, no samples, no metrics, no marks, no limit and no remarks";
            given.refuse::<DataSetArgs>(reason)?;
            refuse(args.comparison.materials.reading.both.verbose, "verbose", reason)?;
            refuse(args.fail_above.is_some(), "fail-above", reason)?;
        }
        return Ok(Output::Text(output.clone()));
    }
    let missing = || CommandError::usage("--format html writes a file; give --output NAME.html");
    let path = output.output.clone().ok_or_else(missing)?;
    check_destination(&path)?;
    Ok(Output::Page { path, figures: args.figures })
}

/// Prints the ranking, or writes the page; fails where a loss is above a limit, after that.
impl Job for ManyJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let writes = self.results.is_some() || matches!(self.output, Output::Page { .. });
        let evaluate = |progress: &Progress| self.evaluate(progress);
        if writes { stoppable(evaluate) } else { evaluate(&Progress::default()) }
    }
}

impl ManyJob {
    fn evaluate(self, progress: &Progress) -> Result<(), CommandError> {
        let Self { settings, reading, shard, robust, .. } = &self;
        if let (true, Output::Text(output)) = (*robust, &self.output) {
            let reading = dataset::decided(&self.cases, reading.clone(), progress)?;
            let report = asked(&self.cases, settings, &reading, progress)?;
            return Ok(output.put(&report, RobustReport::latex)?);
        }
        let (strict, is_part) = (reading.strict, shard.is_some());
        let cases = part(*shard, self.cases.clone());
        let is_table = !matches!(&self.output, Output::Text(output) if output.format() == RankFormat::Text);
        let (report, unkept) = self.report(&cases, is_table, progress)?;
        tell_reading(self.verbose, &self.output, &report);
        match self.output {
            Output::Page { path, figures } => {
                write_page(&path, (figures, self.robust), &report, &cases, progress)?;
            }
            Output::Text(output) => output.put(&report, DatasetReport::latex)?,
        }
        // The others of a part are failed predictions, which the table of all parts counts.
        if !is_part {
            check_any(&report)?;
        }
        warn_of(report.missed(), strict)?;
        unkept.map_or(Ok(()), |problem| Err(CommandError::Failed(problem)))?;
        let means = report.methods.into_iter().filter(|summary| summary.materials > 0);
        check_limit(self.fail_above, means.map(|summary| (summary.method, summary.mean)))
    }

    /// The ranking of `cases`, with digests of their files where it is a table that is kept, and what could not be added to the results folder.
    fn report(
        &self,
        cases: &[Case],
        is_table: bool,
        progress: &Progress,
    ) -> Result<(DatasetReport, Option<String>), CommandError> {
        let Self { settings, reading, results, pick, .. } = self;
        let reading = dataset::decided(cases, reading.clone(), progress)?;
        let KeptAnswer { answer: results, notes, unkept } =
            watched_on(progress, "comparing materials", |progress| {
                dataset::run(cases, settings, &reading, results.as_deref(), progress)
            })?;
        notes.iter().for_each(|note| exit::tell(&format!("note: {note}")));
        for (material, prediction, problem) in failures(&results) {
            exit::tell(&format!("note: {material}, {prediction}: {problem}"));
        }
        let mut report = DatasetReport::new(settings.clone(), reading, results, *pick);
        report.repetition = report.repetition.at(COMMIT);
        if is_table {
            report.files = dataset::digests(cases, progress)?;
        }
        Ok((report, unkept))
    }
}

/// Writes the page, with thumbnails and figures of the materials `cases`, and where asked for whether the order survives.
fn write_page(
    path: &Path,
    (figures, robust): (Option<Figures>, bool),
    report: &DatasetReport,
    cases: &[Case],
    progress: &Progress,
) -> Result<(), CommandError> {
    let DatasetReport { settings, reading, .. } = report;
    let robust = robust.then(|| asked(cases, settings, reading, progress)).transpose()?;
    let views = watched_on(progress, "rendering materials", |progress| {
        material_views(report, cases, figures, path, progress)
    })?;
    Ok(write_text(path, &ranking(report, &views, robust.as_ref()), progress)?)
}

/// Whether the order survives other questions; materials that are left out are reported.
fn asked(
    cases: &[Case],
    settings: &DatasetSettings,
    reading: &DatasetReading,
    progress: &Progress,
) -> Result<RobustReport, CommandError> {
    let tell = |note: &str| exit::tell(&format!("note: {note}"));
    let ask = |progress: &Progress| dataset::robust(cases, settings, reading, tell, progress);
    Ok(watched_on(progress, "asking about the order", ask)?)
}

/// The cases of a shard, which is reported.
fn part(shard: Option<Shard>, cases: Vec<Case>) -> Vec<Case> {
    let Some(shard) = shard else { return cases };
    let all = cases.len();
    let part = shard.part(cases);
    let Shard { number, of } = shard;
    exit::tell(&format!("note: part {number} of {of}: {} of {all} materials", part.len()));
    part
}

/// Reports how the files were read: with `--verbose` every remark; otherwise the doubts, where the format does not print them.
fn tell_reading(verbose: bool, output: &Output, report: &DatasetReport) {
    if verbose {
        report.remarks().for_each(|(name, remark)| exit::tell(&format!("note: {name}: {}", remark.text)));
    } else if !matches!(output, Output::Text(output) if output.format() == RankFormat::Text) {
        report.conditions().iter().for_each(|condition| exit::tell(&format!("note: {condition}")));
    }
}

/// The error of a data set without any loss.
fn check_any(report: &DatasetReport) -> Result<(), CommandError> {
    if report.methods.iter().any(|summary| summary.materials > 0) {
        return Ok(());
    }
    let failed = failures(&report.results).count();
    match failures(&report.results).next() {
        Some((material, method, problem)) => Err(CommandError::Failed(format!(
            "no prediction has a loss: {failed} of {failed} failed, the first of them, {material}, {method}: {problem}; \
             correct the predictions"
        ))),
        None => Ok(()),
    }
}

/// The predictions without a loss: material, method and what is wrong.
fn failures(results: &[MaterialResult]) -> impl Iterator<Item = (&str, &str, &str)> {
    results.iter().flat_map(|result| {
        let failed = result.predictions.iter().filter_map(|p| Some((p, p.error.as_ref()?)));
        failed.map(|(p, problem)| (result.material.as_str(), p.method.as_str(), problem.as_str()))
    })
}
