//! The options of `svbrdf rank`.

use std::path::{Path, PathBuf};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::text::printable;
use svbrdf_evaluate::analyses::RankReport;
use svbrdf_evaluate::dataset::{Pick, Shard};
use svbrdf_evaluate::metrics::MetricSelection;
use svbrdf_evaluate::report::Report;
use svbrdf_files::Error;
use svbrdf_files::disk::inputs::check_output_of;
use svbrdf_files::export::{check_place, write_text};
use svbrdf_page::Figures;

use crate::cli::args::protocol::{MaskArgs, ProtocolArgs};
use crate::cli::args::scenes::{FixedNumber, SceneArgs};
use crate::cli::args::{ComparisonArgs, Specified, offered, values};
use crate::cli::output::{CommandError, exit, stoppable};

/// Ranks predictions of one ground truth, or methods over a data set, by their rendering loss
///
/// All predictions are rendered in the same scenes. Paired differences tell which are worse than the best; predictions of one group
/// cannot be told from its best. Patterns such as 'out/*.png' are expanded. With --dataset, GT and every PRED are folders: their materials are matched by name, and every
/// PRED is a method. With --pairs, GT is a CSV table with the columns ground_truth, prediction and, where needed, method and material.
#[derive(Debug, clap::Args)]
pub struct RankArgs {
    /// GT is a folder of ground truths, and every PRED that of a method
    #[arg(long, conflicts_with = "pairs", requires = "ground_truth")]
    pub dataset: bool,

    /// GT is a CSV table of pairs
    #[arg(long, requires = "ground_truth")]
    pub pairs: bool,

    /// Asks whether the order survives other conventions, epsilons and scenes
    #[arg(long)]
    pub robust: bool,

    #[command(flatten)]
    pub of_data_set: DataSetArgs,

    /// Fails with exit code 1, after the result is printed, if a mean loss is larger than this
    #[arg(long, value_name = "LOSS", value_parser = values::loss, allow_hyphen_values = true)]
    pub fail_above: Option<f64>,

    #[command(flatten)]
    pub scenes: SceneArgs<RankReport>,

    #[command(flatten)]
    pub output: OutputArgs,

    /// Writes figures of materials beside the page: all, or worst:N, of the N largest mean losses
    #[arg(long, value_name = "all|worst:N")]
    #[arg(value_parser = offered(str::parse::<Figures>, ["all", "worst:20"]), hide_possible_values = true)]
    pub figures: Option<Figures>,

    #[command(flatten)]
    pub mask: MaskArgs,

    #[command(flatten)]
    pub comparison: ComparisonArgs,
}

/// What the ranking of a data set has beside that of predictions.
#[derive(Debug, clap::Args)]
pub struct DataSetArgs {
    /// Folder of known losses of a data set, to which the others are added
    #[arg(long, value_name = "DIR")]
    pub results: Option<PathBuf>,

    /// Evaluates the i-th of n parts of a data set; without it, the same command prints the table of all parts
    #[arg(long, value_name = "I/N", requires = "results")]
    pub shard: Option<Shard>,

    /// Which of several predictions of a material counts: the first (fixed), the mean of all, or the best
    #[arg(long, value_name = "fixed|mean|best", default_value = "fixed")]
    #[arg(value_parser = offered(str::parse::<Pick>, ["fixed", "mean", "best"]), hide_possible_values = true)]
    pub pick: Pick,

    /// Adds metrics of the maps of a data set, or those of these words
    ///
    /// Of names such as =rmse_normal,psnr: RMSE, L1, angles and SSIM of each material, and their means; of renderings where they are named, in --near, --distant, --lights
    /// or --scenes.
    #[arg(long, value_name = "WORDS,...", num_args = 0..=1, require_equals = true, value_delimiter = ',', hide_possible_values = true)]
    #[arg(value_parser = offered(word, MetricSelection::words()), default_missing_value = "", conflicts_with = "protocol")]
    pub metrics: Option<Vec<String>>,

    #[command(flatten)]
    pub protocol: ProtocolArgs,

    /// Compares all methods over the materials that all of them have
    ///
    /// Without it, those with the most materials are compared, and the others stand below.
    #[arg(long, hide_short_help = true)]
    pub common: bool,

    /// Adds the marks of `svbrdf diagnose` to a data set
    ///
    /// How many materials of each method have which error of exposure, alignment or reading, and how many losses the ground truth
    /// does not resolve.
    #[arg(long, hide_short_help = true)]
    pub diagnose: bool,
}

/// A word of a name of metrics; none stands for all.
fn word(text: &str) -> Result<String, CoreError> {
    let selection =
        MetricSelection::try_from(if text.is_empty() { Vec::new() } else { vec![text.to_owned()] });
    selection.map(|_| text.to_owned())
}

impl RankArgs {
    /// The word of metrics that stands behind `--metrics` without a sign of equality, and so in the place of the ground truths.
    pub fn word_of_metrics(&self) -> Option<&str> {
        let first = self.comparison.materials.paths().next()?;
        let is_open = self.of_data_set.metrics.as_ref().is_some_and(|words| *words == [""]);
        first.to_str().filter(|text| is_open && word(text).is_ok() && !first.exists())
    }
}

/// The format of the ranking, and the file that it is written to.
#[derive(Clone, Debug, clap::Args)]
pub struct OutputArgs {
    /// Output format [default: as --output ends, or text]
    #[arg(long, value_enum)]
    format: Option<RankFormat>,

    /// Output file [default: stdout; html needs one]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

impl OutputArgs {
    pub fn format(&self) -> RankFormat {
        let extension = self.output.as_ref().and_then(|path| path.extension());
        let of_name = extension.and_then(|extension| match extension.to_ascii_lowercase().to_str()? {
            "json" => Some(RankFormat::Json),
            "csv" => Some(RankFormat::Csv),
            "tex" => Some(RankFormat::Latex),
            "html" | "htm" => Some(RankFormat::Html),
            _ => None,
        });
        self.format.or(of_name).unwrap_or_default()
    }

    /// Checks where the output goes, before anything is computed.
    pub fn check<P: AsRef<Path>>(&self, inputs: impl IntoIterator<Item = P>) -> Result<(), CommandError> {
        let Some(path) = &self.output else { return Ok(()) };
        check_output_of(path, inputs)?;
        let extension = path.extension().map(|extension| extension.to_ascii_lowercase());
        let is_known = |extension: &std::ffi::OsStr| KNOWN.iter().any(|known| extension == *known);
        if self.format.is_none() && extension.is_some_and(|extension| !is_known(&extension)) {
            let path = path.display();
            return Err(CommandError::Usage(format!(
                "{path}: a ranking is written as .txt, .json, .csv, .tex or .html; spreadsheets open .csv"
            )));
        }
        Ok(check_place(path)?)
    }

    /// In this format, to no file.
    pub fn printed(format: RankFormat) -> Self {
        Self { format: Some(format), output: None }
    }

    /// A report in its format.
    pub fn text<R: Report>(&self, report: &R, latex: impl FnOnce(&R) -> String) -> Result<String, Error> {
        Ok(match self.format() {
            RankFormat::Text => printable(&report.text()),
            RankFormat::Json => report.json()?,
            RankFormat::Csv => report.csv()?,
            RankFormat::Latex => latex(report),
            RankFormat::Html => return Err(Error::Internal("HTML is not printed".to_owned())),
        })
    }

    /// Writes `report` in its format: to the file, or to stdout. `latex` makes the table for a paper.
    pub fn put<R: Report>(&self, report: &R, latex: impl FnOnce(&R) -> String) -> Result<(), Error> {
        let text = self.text(report, latex)?;
        match &self.output {
            Some(path) => stoppable(|progress| write_text(path, &text, progress)),
            None => exit::put(&text),
        }
    }
}

/// Endings of names of rankings.
const KNOWN: [&str; 7] = ["txt", "md", "json", "csv", "tex", "html", "htm"];

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum RankFormat {
    #[default]
    Text,
    Json,
    Csv,
    /// A table for a paper: the best and what ties with it in bold
    Latex,
    /// A page of a data set: the verdict, the table, and a sheet of the materials with links to figures
    Html,
}

/// The error of losses that are above a limit, if any is.
pub fn check_limit(
    limit: Option<f64>,
    losses: impl IntoIterator<Item = (String, f64)>,
) -> Result<(), CommandError> {
    let Some(limit) = limit else { return Ok(()) };
    let above = losses.into_iter().find(|(_, loss)| loss.is_nan() || *loss > limit);
    let problem = |(name, loss)| format!("{name} has a loss of {loss:.6}, above the limit of {limit}");
    above.map(problem).map_or(Ok(()), |problem| Err(CommandError::Failed(problem)))
}

/// Refuses scenes beside `--robust`.
pub fn refuse_scenes(given: &Specified) -> Result<(), CommandError> {
    given.refuse::<SceneArgs<FixedNumber>>("--robust asks about other scenes itself")
}
