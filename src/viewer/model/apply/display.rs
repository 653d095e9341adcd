//! Commands about what the panes show, and how.

use svbrdf_core::picture::quantity::Quantity;
use svbrdf_files::session::window::Framing;

use super::undo;
use crate::model::Model;
use crate::model::command::DisplayCommand;
use crate::model::command::effect::Effect;
use crate::model::exposed::Exposed;
use crate::model::ranges::STOPS;
use crate::model::view::endpoint::{self, Endpoint};
use crate::model::view::framing::{self, Framed};
use crate::model::view::state::{AutoExposure, Layout, Projection, ViewState};

pub(super) fn apply(model: &mut Model, command: DisplayCommand) -> Vec<Effect> {
    let state = &mut model.view;
    match command {
        DisplayCommand::SetQuantity(quantity) => state.display.quantity = quantity,
        DisplayCommand::CycleQuantity(by) => {
            state.display.quantity = cycled(&Quantity::ALL, state.display.quantity, by)
        }
        DisplayCommand::ShowDifference(on) => state.display.difference = on,
        DisplayCommand::SetDifference(kind) => state.display.differences.choose(state.display.quantity, kind),
        DisplayCommand::ChooseErrorMap => state.display.differences.choose_error_map(),
        DisplayCommand::SetRange(range) => state.display.differences.set_range(state.display.quantity, range),
        DisplayCommand::SetLayout(layout) => state.display.layout = layout,
        DisplayCommand::CycleLayout => state.display.layout = cycled(&Layout::ALL, state.display.layout, 1),
        DisplayCommand::ToggleProjection => state.display.projection = state.display.projection.other(),
        DisplayCommand::SetExposure(ev) => set_exposure(state, ev),
        DisplayCommand::StepExposure(by) => set_exposure(state, state.exposure_ev + by),
        DisplayCommand::AutoExposure(auto) => {
            state.display.auto_exposure = auto;
            model.exposed = Exposed::Pending;
        }
        DisplayCommand::ToggleClipping => state.display.show_clipping = !state.display.show_clipping,
        DisplayCommand::ToggleFalseColour => state.display.false_colour = !state.display.false_colour,
        DisplayCommand::SetWipe(at) => state.display.wipe = at.clamp(0.0, 1.0),
        DisplayCommand::ChoosePrediction(index) => {
            if index < model.materials.predictions().len() {
                choose(state, index);
            }
        }
        DisplayCommand::Isolate(map) => (state.display.isolated, state.display.corrected) = (map, None),
        DisplayCommand::Correct(change) => (state.display.isolated, state.display.corrected) = (None, change),
        DisplayCommand::SetOnlyRight(on) => state.display.only_right = on,
        DisplayCommand::StepPrediction(by) => {
            let count = model.materials.predictions().len().max(1) as isize;
            choose(state, (state.display.prediction as isize + by).rem_euclid(count) as usize);
        }
        DisplayCommand::Swap => model.swapped ^= true,
        DisplayCommand::Zoom { factor, at } => frame(model, |framed| framed.zoomed(factor, at)),
        DisplayCommand::Pan(by) => frame(model, |framed| framed.panned(by)),
        DisplayCommand::Fit => fit(state),
        DisplayCommand::OneToOne => show_at(model, 1.0),
        DisplayCommand::SetMagnification(pixels) => show_at(model, pixels),
        DisplayCommand::Reset => {
            *state = state.reset();
            model.exposed = Exposed::Pending;
        }
        DisplayCommand::Undo => return undo::undo(model),
        DisplayCommand::Redo => return undo::redo(model),
    }
    Vec::new()
}

/// Chooses a prediction. A correction is of one prediction.
fn choose(state: &mut ViewState, prediction: usize) {
    if prediction != state.display.prediction {
        (state.display.prediction, state.display.corrected) = (prediction, None);
    }
}

/// Sets the exposure by hand.
fn set_exposure(state: &mut ViewState, ev: f32) {
    state.exposure_ev = ev.clamp(-STOPS, STOPS);
    state.display.auto_exposure = AutoExposure::Off;
}

/// Shows a texel in this many pixels along an axis.
fn show_at(model: &mut Model, pixels: f32) {
    frame(model, |framed| framed.at_scale(pixels));
}

/// Changes the part of the ground truth that the panes show.
fn frame(model: &mut Model, change: impl FnOnce(&Framed<'_>) -> Framing) {
    if let Some(ground_truth) = model.materials.ground_truth() {
        let framed = Framed { state: &model.view, grid: ground_truth.grid(), pane: model.geometry.pane };
        model.view.display.framing = Some(change(&framed));
    }
}

/// Fits the material into its pane. In perspective a view that sees it as a line is raised, too.
fn fit(state: &mut ViewState) {
    state.display.framing = None;
    if state.display.projection == Projection::Perspective {
        endpoint::raise(&mut state.scene, Endpoint::View, framing::LEAST);
    }
}

/// The value `by` places after `value`, around the end.
fn cycled<T: Copy + PartialEq>(all: &[T], value: T, by: isize) -> T {
    let index = all.iter().position(|x| *x == value).unwrap_or(0) as isize;
    all[(index + by).rem_euclid(all.len() as isize) as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cycling_goes_around_both_ends() {
        assert_eq!(cycled(&[1, 2, 3], 3, 1), 1);
        assert_eq!(cycled(&[1, 2, 3], 1, -1), 3);
    }
}
