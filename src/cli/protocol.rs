//! `svbrdf metrics --protocol`: published evaluations, as their released code computes them.

use std::path::{Path, PathBuf};

use svbrdf_core::loss::check_same_size;
use svbrdf_core::material::{Material, Planes};
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::metrics::{Metric, matfusion_renderings, of_matfusion};
use svbrdf_evaluate::report::MetricsReport;
use svbrdf_files::Error;
use svbrdf_files::export::write_npy;
use svbrdf_files::read::MaterialPath;
use svbrdf_files::source::{MaterialSource, Place};

use super::job::MaterialJob;
use super::output::report::ReportFormat;
use super::output::{CommandError, exit, watched};

#[derive(Debug, clap::Args)]
pub struct ProtocolArgs {
    /// Computes what the released code of a publication computes, without neural networks
    #[arg(long, value_name = "NAME")]
    pub protocol: Option<Protocol>,

    /// Writes the renderings of the protocol, a file of NumPy for each material, into a folder: for LPIPS and the like
    #[arg(long, value_name = "FOLDER")]
    pub renderings: Option<PathBuf>,
}

/// A published evaluation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Protocol {
    /// Sartor and Peers 2023, score.py: RMSE of the four maps, L1 of a rendering with the flash at the camera
    Matfusion,
}

/// A material of the protocol.
struct ProtocolMaterial {
    name: String,
    /// With normals as stored.
    planes: Planes<f64>,
    size: [usize; 2],
}

/// Prints the metrics of the protocol to stdout.
///
/// # Errors
/// Where a material cannot be read or used, or renderings cannot be written.
pub fn run(args: &ProtocolArgs, job: &MaterialJob, format: ReportFormat) -> Result<(), CommandError> {
    let all = opened(job)?;
    let (truth, predictions) = (&all[0], &all[1..]);
    if let Some(folder) = &args.renderings {
        write_renderings(folder, &all)?;
    }
    let of = |prediction: &ProtocolMaterial| -> Result<(String, Vec<Metric>), Error> {
        let metrics = watched("rendering", |progress| {
            of_matfusion(&truth.planes, &prediction.planes, truth.size, progress)
        })?;
        Ok((prediction.name.clone(), metrics))
    };
    let results = predictions.iter().map(of).collect::<Result<_, _>>()?;
    Ok(exit::put(&format.write(&MetricsReport::matfusion(&truth.name, truth.size, results))?)?)
}

/// The ground truth, then the predictions, of one size.
fn opened(job: &MaterialJob) -> Result<Vec<ProtocolMaterial>, CommandError> {
    let materials: Vec<Material<f64>> = job.open::<f64>()?.into_all();
    for prediction in &materials[1..] {
        check_same_size(&materials[0], prediction)?;
    }
    let stored = |(source, material): (&MaterialSource, &Material<f64>)| -> Result<_, CommandError> {
        let (name, size) = (material.name().to_owned(), material.size());
        let planes = match &source.place {
            Place::Path(path) => {
                MaterialPath::new(path, &source.options).planes_as_stored(&Progress::default())?.0
            }
            Place::BuiltIn(_) => material.planes().clone(),
        };
        Ok(ProtocolMaterial { name, planes, size })
    };
    job.sources().iter().zip(&materials).map(stored).collect()
}

/// Writes the renderings of every material; the folder is made.
fn write_renderings(folder: &Path, materials: &[ProtocolMaterial]) -> Result<(), Error> {
    let remedy = "check that the folder above it is there and writable";
    std::fs::create_dir_all(folder).map_err(|source| Error::Unwritable {
        path: folder.to_owned(),
        source,
        remedy,
    })?;
    for (index, material) in materials.iter().enumerate() {
        let name: String = material
            .name
            .chars()
            .map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' })
            .collect();
        let path = folder.join(format!("{index}_{name}.npy"));
        watched(&format!("writing {}", path.display()), |progress| {
            let renderings = matfusion_renderings(&material.planes, material.size, progress)?;
            write_npy(&path, &renderings, &progress.part())
        })?;
    }
    Ok(())
}
