//! Settings of a session file beside its materials: they apply where no option specifies otherwise.

use std::path::Path;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::loss::{LossOptions, LossSettings, Request};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::content::{ColouredDifference, PictureContent};
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_files::session::Session;
use svbrdf_files::session::window::SessionDisplay;
use svbrdf_files::{Error, convention};

use crate::cli::args::MaterialArgs;
use crate::cli::output::{CommandError, exit};

/// The display and the loss settings of a session.
#[derive(Debug)]
pub struct SessionSettings {
    pub scene: Scene,
    pub convention: Convention,
    pub exposure_ev: f32,
    /// What the window displays, and how.
    pub display: SessionDisplay,
    pub loss: Option<LossSettings>,
}

/// The session, of a file or of a picture, that stands for the ground truth and its predictions; `None` where the ground truth is none.
pub fn given(materials: &MaterialArgs) -> Result<Option<Session>, CommandError> {
    let paths: Vec<_> = materials.paths().collect();
    let Some(given) = materials.ground_truth.as_ref().filter(|_| Session::is_among(&paths)) else {
        return Ok(None);
    };
    let path = &given.path;
    if given.name.is_some() {
        return Err(CommandError::usage("a session names its materials itself; give its path alone"));
    }
    if !materials.predictions.is_empty() {
        return Err(CommandError::usage("a session names its predictions itself; give it alone"));
    }
    let session = Session::read(path)?;
    for file in session.outside(path) {
        let line =
            format!("note: {} lies outside of the folder of the session, which names it", file.display());
        exit::tell(&line);
    }
    for file in session.changed() {
        exit::tell(&format!("note: {} has changed since the picture was saved", file.display()));
    }
    Ok(Some(session))
}

impl SessionSettings {
    /// The settings of `session`, which was read from `path`.
    pub fn new(session: &Session, path: &Path) -> Result<Self, Error> {
        let bad =
            |problem: CoreError| Error::BadSession { path: path.to_owned(), problem: problem.to_string() };
        if let Some(Request::Scenes(sampling)) = session.window.loss.as_ref().map(LossSettings::request) {
            sampling.check().map_err(bad)?;
        }
        Ok(Self {
            scene: session.scene,
            convention: convention::of_loss(&session.convention).map_err(|problem| Error::BadSession {
                path: path.to_owned(),
                problem: problem.to_string(),
            })?,
            exposure_ev: session.exposure,
            display: session.window.display.clone().unwrap_or_default(),
            loss: session.window.loss.clone(),
        })
    }

    /// The quantity and difference that the panes of the window display.
    pub fn content(&self) -> PictureContent {
        let quantity = self.display.quantity;
        PictureContent { quantity, difference: self.display.difference.then(|| self.difference(quantity)) }
    }

    /// The chosen difference of a quantity, and its range.
    pub fn difference(&self, quantity: Quantity) -> ColouredDifference {
        let differences = &self.display.differences;
        ColouredDifference { kind: differences.kind(quantity), range: differences.range(quantity) }
    }

    /// What `options` ask for: over what the session does, where it has settings.
    pub fn request(session: Option<&Self>, options: &LossOptions) -> Result<Request, CoreError> {
        let saved = session.and_then(|session| session.loss.as_ref());
        saved.map_or_else(|| options.request(), |saved| options.over(saved))
    }
}
