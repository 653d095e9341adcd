//! Edits of what the panes show that need more of the model than the view, and the automatic exposure.

use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::exposure;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_files::session::window::Framing;
use svbrdf_files::source::Place;

use crate::model::Model;
use crate::model::framing::Framed;
use crate::model::view::{AutoExposure, Exposed, Layout, STOPS};

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

/// Computes the exposure where its state asks for it. Called in every frame.
pub fn follow_exposure(model: &mut Model) {
    let Some(ground_truth) = model.materials.ground_truth() else { return };
    let is_here = |place: &Place| model.materials.all.iter().any(|one| one.read.source.place == *place);
    let now = Exposed::For {
        ground_truth: ground_truth.read.source.place.clone(),
        scene: model.view.scene,
        convention: model.view.convention(),
    };
    let is_due = match (model.view.display.auto_exposure, &model.exposed) {
        (AutoExposure::Off, _) | (AutoExposure::Once, Exposed::Restored) => false,
        (AutoExposure::Once, Exposed::For { ground_truth, .. }) => !is_here(ground_truth),
        (AutoExposure::Follow, exposed) => *exposed != now,
        (AutoExposure::Once, Exposed::Pending) => true,
    };
    if is_due {
        let convention = model.view.convention().drawn();
        let ev = exposure::automatic(ground_truth.material(), &model.view.scene, &convention);
        model.view.exposure_ev = ev.clamp(-STOPS, STOPS);
    }
    if is_due || model.exposed == Exposed::Restored {
        model.exposed = now;
    }
}

/// Chooses how the exposure is automatic; it is computed at once.
pub fn choose_exposure(model: &mut Model, auto: AutoExposure) {
    (model.view.display.auto_exposure, model.exposed) = (auto, Exposed::Pending);
}

/// Shows a scene that was picked from a list, and exposes for it where the exposure is automatic.
pub fn choose_scene(model: &mut Model, scene: Scene) {
    model.view.scene = scene;
    if model.view.display.auto_exposure == AutoExposure::Once {
        model.exposed = Exposed::Pending;
    }
}
