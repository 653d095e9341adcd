//! From a request to losses.

use super::adaptive::{self, Goal};
use super::batches;
use super::comparison::{Comparison, Compute};
use super::outcome::Outcome;
use super::request::{Request, Sampling};
use super::texels::scene_losses;
use crate::error::Error;
use crate::model::scene::Scene;
use crate::progress::Progress;

impl<T: Compute> Comparison<'_, T> {
    /// The losses that `request` asks for. All predictions see the same scenes and texels.
    ///
    /// The result does not depend on the number of threads.
    ///
    /// # Errors
    /// [`Error::SceneCount`], [`Error::UnusableScene`], [`Error::Cancelled`].
    pub fn run(&self, request: &Request, progress: &Progress) -> Result<Outcome, Error> {
        match request {
            Request::Scenes(sampling) => {
                let scenes = sampling.scenes(self.convention())?;
                let losses = scene_losses(self, sampling, [0, 0], &scenes, progress)?;
                let pilot = self.pilot(sampling, progress)?;
                Ok(self.outcome(Some(*sampling), scenes, losses, pilot))
            }
            Request::Listed(scenes) => {
                check(scenes)?;
                let losses = self.backend().scene_losses(self, scenes, None, progress)?;
                Ok(self.outcome(None, scenes.clone(), losses, None))
            }
            Request::Accuracy { .. } | Request::Time { .. } => self.stream(request, progress, |_| ()),
        }
    }

    /// As [`Comparison::run`]; `update` sees outcomes over growing numbers of scenes, the final one at last.
    ///
    /// For [`Request::Scenes`] each is to the bit what a request for as many scenes gives. For [`Request::Accuracy`] the
    /// first is that of a pilot. Listed scenes are computed in one go. Cancelled accuracies and times return the latest
    /// outcome, if there is any.
    ///
    /// # Errors
    /// As [`Comparison::run`]; [`Error::Cancelled`] may come after updates.
    pub fn stream(
        &self,
        request: &Request,
        progress: &Progress,
        mut update: impl FnMut(&Outcome),
    ) -> Result<Outcome, Error> {
        match *request {
            Request::Scenes(sampling) => batches::run(self, &sampling, progress, update),
            Request::Accuracy { target, seed } => {
                adaptive::run(self, Goal::RelativeError(target), seed, progress, update)
            }
            Request::Time { budget, seed } => adaptive::run(self, Goal::Time(budget), seed, progress, update),
            Request::Listed(_) => {
                let outcome = self.run(request, progress)?;
                update(&outcome);
                Ok(outcome)
            }
        }
    }
}

/// Whether scenes can be rendered.
fn check(scenes: &[Scene]) -> Result<(), Error> {
    if scenes.is_empty() {
        return Err(Error::SceneCount { count: 0, most: Sampling::MAX_SCENES });
    }
    scenes.iter().try_for_each(Scene::check_usable)
}
