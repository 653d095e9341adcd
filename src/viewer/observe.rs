//! What the tests see of the window.

use super::app::App;
use super::message::Message;
use crate::loss::Loss;
use crate::material::Material;
use crate::picture::statistics::Statistics;
use crate::study::Study;

impl App {
    /// The losses of the predictions, once they are complete for the current materials and settings.
    pub fn losses(&self) -> Option<&[Loss]> {
        self.loss.finished(&self.slots, &self.asked())
    }

    /// The study of the chosen pair as far as it has got, and whether it is complete.
    pub fn study(&self) -> Option<(&Study, bool)> {
        let (study, current) =
            self.study.measured(&self.slots, self.state.prediction, &self.state.convention())?;
        current.then_some((study, self.study.task().is_none()))
    }

    /// The statistics of each prediction's difference in the panes, once they are those of the current scene.
    pub fn difference_statistics(&self) -> Option<&[Option<Statistics>]> {
        let distributions = self.difference.distributions(&self.slots, &self.state)?;
        let current = self.difference.is_current(&self.slots, &self.state);
        current.then_some(distributions.statistics.as_slice())
    }

    /// The difference that has the last colour.
    pub fn difference_range(&self) -> f64 {
        self.difference.range(&self.slots, &self.state)
    }

    /// The names of the materials, the ground truth first.
    pub fn names(&self) -> Vec<String> {
        self.slots.slots.iter().map(|s| s.name().to_owned()).collect()
    }

    /// The materials in the window, the ground truth first.
    pub fn materials(&self) -> impl Iterator<Item = &Material<f32>> {
        self.slots.slots.iter().map(|slot| &slot.loaded.material)
    }

    /// Size of the panes and the legend, in pixels.
    pub fn picture_size(&self) -> [u32; 2] {
        self.picture_size
    }

    /// Why a material is not what its files hold now, of each material.
    pub fn problems(&self) -> Vec<Option<&str>> {
        self.slots.slots.iter().map(|slot| slot.problem.as_deref()).collect()
    }

    /// Whether a material is being read.
    pub fn is_reading(&self) -> bool {
        !self.slots.openings.is_empty()
    }

    /// The texts of the messages in the window: errors and results, the latest last.
    pub fn messages(&self) -> Vec<String> {
        self.messages.iter().map(Message::to_string).collect()
    }
}
