//! Which panes there are, and what each shows.

use super::slots::Slot;
use super::state::{Layout, Projection, ViewState};
use crate::gpu::DisplayMode;
use crate::material::Grid;
use crate::picture::camera::Camera;

/// What the panes show, for one frame.
#[derive(Debug)]
pub struct Scenery<'a> {
    pub slots: &'a [Slot],
    pub state: &'a ViewState,
    pub dark: bool,
    pub highlight_follows: bool,
    /// Whether every pane shows the ground truth, as long as a key is held.
    pub peek: bool,
    /// Whether the chosen prediction and the ground truth are swapped.
    pub swapped: bool,
    /// Whether materials are being read.
    pub reading: bool,
}

/// The content of a pane: the slot it shows, the slot that is compared with, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Content {
    pub slot: usize,
    pub reference: usize,
    pub mode: DisplayMode,
}

impl Scenery<'_> {
    /// The slot that the chosen prediction is in; the ground truth's where there is no prediction.
    pub fn chosen(&self) -> usize {
        (self.state.prediction + 1).min(self.slots.len().saturating_sub(1))
    }

    /// The slot that is seen where slot `index` would be.
    fn seen(&self, index: usize) -> usize {
        match index {
            _ if self.peek => 0,
            0 if self.swapped => self.chosen(),
            i if self.swapped && i == self.chosen() => 0,
            i => i,
        }
    }

    pub(super) fn contents(&self) -> Vec<Content> {
        let alone = |slot, mode| Content { slot, reference: 0, mode };
        let chosen = self.seen(self.chosen());
        match self.state.layout {
            Layout::SideBySide => {
                (0..self.slots.len()).map(|i| alone(self.seen(i), DisplayMode::Value)).collect()
            }
            Layout::Single => vec![alone(chosen, DisplayMode::Value)],
            Layout::Difference => vec![alone(chosen, DisplayMode::Difference)],
            Layout::Wipe => vec![Content {
                slot: chosen,
                reference: self.seen(0),
                mode: DisplayMode::Wipe(self.state.wipe * 2.0 - 1.0),
            }],
        }
    }

    pub(super) fn camera(&self, grid: Grid, aspect: f32) -> Camera {
        let fitted = match self.state.projection {
            Projection::Flat => Camera::flat(grid, aspect),
            Projection::Perspective => Camera::of_scene(&self.state.scene, grid, aspect),
        };
        fitted.zoomed(self.state.zoom, self.state.pan)
    }

    /// The name of slot `index` as titles give it.
    pub fn title(&self, index: usize) -> String {
        let name = self.slots[index].name();
        if index == 0 { format!("GROUND TRUTH  {name}") } else { format!("{index}  {name}") }
    }
}
