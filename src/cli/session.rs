//! What a session file says beyond its materials: it holds where the command line says nothing.

use svbrdf::error::Error;
use svbrdf::files::session::Session;
use svbrdf::files::session_window::Display;
use svbrdf::loss::{LossSettings, Request};
use svbrdf::model::convention::Convention;
use svbrdf::model::scene::Scene;
use svbrdf::picture::quantity::Quantity;
use svbrdf::picture::shown::{Shown, ShownDifference};

use super::materials::MaterialArgs;

/// The display and the loss settings of a session.
#[derive(Debug)]
pub struct SessionSettings {
    pub scene: Scene,
    pub convention: Convention,
    pub exposure_ev: f32,
    display: Display,
    loss: Option<LossSettings>,
}

impl SessionSettings {
    /// Those of the session file that is given in place of a ground truth.
    ///
    /// # Errors
    /// Those of [`Session::read`], [`Error::UnknownName`] for an unknown convention.
    pub fn of(materials: &MaterialArgs) -> Result<Option<Self>, Error> {
        let Some(path) = materials.ground_truth.as_ref().filter(|path| Session::is_named(path)) else {
            return Ok(None);
        };
        let session = Session::read(path)?;
        Ok(Some(Self {
            scene: session.scene,
            convention: session.convention.parse()?,
            exposure_ev: session.exposure,
            display: session.window.display.unwrap_or_default(),
            loss: session.window.loss,
        }))
    }

    /// What the panes of the window show.
    pub fn shown(&self) -> Shown {
        let quantity = self.display.quantity;
        Shown { quantity, difference: self.display.difference.then(|| self.difference(quantity)) }
    }

    /// The chosen difference of a quantity, and its range.
    pub fn difference(&self, quantity: Quantity) -> ShownDifference {
        let differences = &self.display.differences;
        ShownDifference { kind: differences.kind(quantity), range: differences.range(quantity) }
    }

    /// What is asked of the loss, with this seed where one is specified.
    pub fn request(&self, seed: Option<u64>) -> Option<Request> {
        let settings = self.loss.clone()?;
        Some(LossSettings { seed: seed.unwrap_or(settings.seed), ..settings }.request())
    }
}
