//! Edits of what the panes show that need more of the model than the view.

use svbrdf_core::picture::quantity::Quantity;
use svbrdf_files::session::window::Framing;

use crate::model::Model;
use crate::model::framing::Framed;
use crate::model::view::{Exposed, Layout};

/// Shows the quantity `by` places after this one.
pub fn cycle_quantity(model: &mut Model, by: isize) {
    let display = &mut model.view.display;
    display.quantity = cycled(&Quantity::ALL, display.quantity, by);
}

pub fn cycle_layout(model: &mut Model) {
    let display = &mut model.view.display;
    display.layout = cycled(&Layout::ALL, display.layout, 1);
}

/// Changes the exposure by this many stops.
pub fn step_exposure(model: &mut Model, by: f32) {
    model.view.set_exposure(model.view.exposure_ev + by);
}

/// Chooses the prediction in this slot, where there is one.
pub fn choose_slot(model: &mut Model, slot: usize) {
    if let Some(prediction) = model.materials.predictions().iter().position(|one| one.slot == slot) {
        model.view.choose(prediction);
    }
}

/// Chooses a prediction, where there is one of this number.
pub fn choose(model: &mut Model, prediction: usize) {
    if prediction < model.materials.predictions().len() {
        model.view.choose(prediction);
    }
}

/// Chooses the prediction this many places on, around the end.
pub fn step_prediction(model: &mut Model, by: isize) {
    let count = model.materials.predictions().len().max(1) as isize;
    model.view.choose((model.view.display.prediction as isize + by).rem_euclid(count) as usize);
}

/// Magnifies by a factor about a point of the pane (x right, y up in [-1, 1]).
pub fn zoom(model: &mut Model, factor: f32, at: [f32; 2]) {
    frame(model, |framed| framed.zoomed(factor, at));
}

/// Moves the picture by this (x right, y up, in halves of the pane).
pub fn pan(model: &mut Model, by: [f32; 2]) {
    frame(model, |framed| framed.panned(by));
}

/// Shows a texel in this many pixels along an axis.
pub fn magnify(model: &mut Model, pixels: f32) {
    frame(model, |framed| framed.at_scale(pixels));
}

/// Resets light, view, zoom, exposure and clipping marks.
pub fn reset(model: &mut Model) {
    model.view = model.view.reset();
    model.exposed = Exposed::Pending;
}

/// Changes the part of the ground truth that the panes show.
fn frame(model: &mut Model, change: impl FnOnce(&Framed<'_>) -> Framing) {
    if let Some(ground_truth) = model.materials.ground_truth() {
        let framed = Framed { state: &model.view, grid: ground_truth.grid(), pane: model.geometry.pane };
        model.view.display.framing = Some(change(&framed));
    }
}

/// The value `by` places after `value`, around the end.
fn cycled<T: Copy + PartialEq>(all: &[T], value: T, by: isize) -> T {
    let index = all.iter().position(|x| *x == value).unwrap_or(0) as isize;
    all[(index + by).rem_euclid(all.len() as isize) as usize]
}
