//! A job: what a command compares, resolved once from its arguments before anything is computed.

pub mod materials;
pub mod session;

use std::fmt;
use std::path::PathBuf;

use svbrdf_core::loss::Request;
use svbrdf_core::math::real::Real;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_evaluate::report::{AnalysisInput, stored_normals_note};
use svbrdf_files::session::Session;

use super::args::{ComparisonArgs, Specified};
use super::output::{CommandError, exit};
pub use materials::{MaterialJob, OpenedMaterials, check_heights};
pub use session::SessionSettings;

/// What a command does: its arguments, resolved. Each argument that the mode of the command uses is in it, and no other.
pub trait Job: fmt::Debug {
    /// Computes, prints and writes.
    fn run(self: Box<Self>) -> Result<(), CommandError>;
}

/// A job, or why the arguments of a command make none.
pub type NewJob = Result<Box<dyn Job>, CommandError>;

/// The materials and the convention of a comparison. A session file is read once, here.
#[derive(Debug)]
pub struct ComparisonJob {
    /// As specified, or as in the session, or the default.
    pub convention: Convention,
    pub materials: MaterialJob,
    /// The settings of the session file that stands for the materials.
    pub session: Option<SessionSettings>,
    /// The name or the text of the convention.
    convention_text: String,
}

impl ComparisonJob {
    /// As [`ComparisonJob::new`], of a ground truth with predictions.
    pub fn with_predictions(args: &ComparisonArgs, given: &Specified) -> Result<Self, CommandError> {
        let mut job = Self::new(args, given)?;
        job.materials.check_predictions()?;
        job.materials.is_comparison = true;
        Ok(job)
    }

    pub fn new(args: &ComparisonArgs, given: &Specified) -> Result<Self, CommandError> {
        let file = session::given(&args.materials)?;
        let settings = |(file, path): (_, &PathBuf)| SessionSettings::new(file, path);
        let session = file.as_ref().zip(args.materials.paths().next()).map(settings).transpose()?;
        let of_session = session.as_ref().map(|session| session.convention);
        let chosen = args.convention.as_ref();
        let of_file = file.as_ref().filter(|_| chosen.is_none()).map(|file| file.convention.clone());
        Ok(Self {
            convention: chosen.map(|chosen| chosen.convention).or(of_session).unwrap_or_default(),
            convention_text: of_file.unwrap_or_else(|| chosen.cloned().unwrap_or_default().content()),
            materials: MaterialJob::new(&args.materials, file.as_ref(), given)?,
            session,
        })
    }

    /// The comparison in `scene`, to be opened again.
    pub fn saved(&self, scene: Scene, exposure_ev: f32) -> Session {
        let (sources, convention) = (self.materials.sources(), self.convention_text.clone());
        let mut session = Session::new(sources, scene, convention, exposure_ev);
        session.mask = self.materials.saved_mask();
        session
    }
}

/// What an analysis of the `opened` materials takes. Tells where losses leave out the lengths of stored normals.
pub fn input<'a, T: Real>(
    opened: &'a OpenedMaterials<T>,
    materials: &MaterialJob,
    convention: Convention,
    request: Request,
) -> AnalysisInput<'a, T> {
    if let Some(note) = stored_normals_note(&convention, &opened.storages) {
        exit::tell(&format!("note: {note}"));
    }
    AnalysisInput {
        ground_truth: &opened.ground_truth,
        predictions: opened.predictions.iter().collect(),
        storages: opened.storages.iter().collect(),
        paths: materials.paths.iter().map(|path| Some(path.display().to_string())).collect(),
        convention,
        request,
        few_scenes: false,
        mask: opened.mask.clone(),
    }
}
