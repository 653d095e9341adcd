//! `svbrdf conform`: whether a renderer is that of a convention.

use std::path::PathBuf;

use svbrdf_core::model::grammar::Description;
use svbrdf_evaluate::conform::{RenderedPoints, probes};
use svbrdf_evaluate::report::ConformReport;
use svbrdf_files::disk::atomic::{self, Destination};
use svbrdf_files::{Error, arrays, convention};

use super::args::comparison::names;
use super::args::offered;
use super::job::{Job, NewJob};
use super::output::{CommandError, ReportFormat, exit, stoppable, watched};

/// Tells whose renderer gave out radiances, and in which terms it differs from a convention
///
/// First `--points probe.npz` writes points: `normal`, `diffuse`, `specular`, `roughness`, `base_color`, `metallic`, and `light` and `view`,
/// which lead from the point to light and camera and are not unit. Render each with your code, under one white light, and save the
/// arrays with the result as `radiance`. Ends with exit code 1 where the renderer does not conform.
#[derive(Debug, clap::Args)]
pub struct ConformArgs {
    /// The points with `radiance`, an npz file
    #[arg(value_name = "ANSWER", required_unless_present = "points", conflicts_with = "points")]
    answer: Option<PathBuf>,

    /// Writes the points that are to be rendered, at most 400
    #[arg(long, value_name = "FILE.npz")]
    points: Option<PathBuf>,

    /// Convention that is expected: a name, or a .toml file
    #[arg(long, value_name = "NAME", default_value = "printed", conflicts_with = "points")]
    #[arg(value_parser = offered(str::parse::<String>, names()), hide_possible_values = true)]
    convention: String,

    /// Maps that were read: diffuse and specular, or base_color and metallic [default: whichever fits]
    #[arg(long, value_enum, conflicts_with = "points")]
    workflow: Option<Workflow>,

    /// Writes what was found as a convention, with the loss and the scenes of the expected one
    #[arg(long, value_name = "FILE.toml", conflicts_with = "points")]
    write_convention: Option<PathBuf>,

    /// Output format
    #[arg(long, value_enum, default_value_t, conflicts_with = "points")]
    format: ReportFormat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Workflow {
    Diffuse,
    Metallic,
}

impl ConformArgs {
    pub fn job(self) -> NewJob {
        if let Some(path) = self.points {
            Destination::new(&path, &["npz"], "name of a file of points", "NAME.npz")?;
            return Ok(Box::new(PointsJob(path)));
        }
        let answer = self.answer.ok_or_else(|| CommandError::usage("expected the points with `radiance`"))?;
        if let Some(path) = &self.write_convention {
            Destination::new(path, &["toml"], "name of a convention file", "NAME.toml")?;
        }
        Ok(Box::new(ConformJob {
            answer,
            convention: convention::read(&self.convention)?,
            metallic: self.workflow.map(|workflow| workflow == Workflow::Metallic),
            written: self.write_convention,
            format: self.format,
        }))
    }
}

/// Writes the points.
#[derive(Debug)]
struct PointsJob(PathBuf);

impl Job for PointsJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let arrays = probes().map_err(Error::Internal)?;
        Ok(stoppable(|progress| arrays::write(&self.0, &arrays, progress))?)
    }
}

/// A comparison of an answer with a convention.
#[derive(Debug)]
struct ConformJob {
    answer: PathBuf,
    convention: Description,
    metallic: Option<bool>,
    written: Option<PathBuf>,
    format: ReportFormat,
}

/// Prints the report; fails where the renderer does not conform, after it is printed.
impl Job for ConformJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { answer, convention, metallic, written, format } = *self;
        let problem = |problem| Error::BadArrays { path: answer.clone(), problem };
        let answer = RenderedPoints::new(&arrays::read(&answer)?, metallic).map_err(problem)?;
        let report = watched("searching renderers", |_| ConformReport::new(&answer, &convention));
        exit::put(&format.write(&report)?)?;
        match (written, report.found()) {
            (Some(path), Some(found)) => {
                stoppable(|progress| atomic::write_text(&path, &found.to_string(), progress))?;
            }
            (Some(path), None) => exit::tell(&format!(
                "note: {} is not written: the renderer is none of the grammar",
                path.display()
            )),
            (None, _) => {}
        }
        match report.conforms() {
            true => Ok(()),
            false => Err(CommandError::Failed(format!(
                "the renderer does not conform to {}; the report tells in what",
                convention.name
            ))),
        }
    }
}
