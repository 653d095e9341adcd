//! Commands about what the panes show, and how.

use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::Model as BrdfModel;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::render::render_texel;
use svbrdf_core::statistics::quantile;

use super::undo;
use crate::viewer::model::Model;
use crate::viewer::model::command::DisplayCommand;
use crate::viewer::model::command::effect::Effect;
use crate::viewer::model::ranges::{STOPS, ZOOM};
use crate::viewer::model::view::state::{Layout, ViewState};

/// Most texels that are rendered to find the automatic exposure.
const AUTO_EXPOSURE_TEXELS: usize = 20_000;

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
        DisplayCommand::SetExposure(ev) => state.exposure_ev = ev.clamp(-STOPS, STOPS),
        DisplayCommand::StepExposure(by) => {
            state.exposure_ev = (state.exposure_ev + by).clamp(-STOPS, STOPS);
        }
        DisplayCommand::AutoExposure => {
            if let Some(ground_truth) = model.materials.ground_truth() {
                let ev = auto_exposure(ground_truth.material(), state);
                state.exposure_ev = ev.clamp(-STOPS, STOPS);
            }
        }
        DisplayCommand::ToggleClipping => state.display.show_clipping = !state.display.show_clipping,
        DisplayCommand::ToggleTiled => state.display.tiled = !state.display.tiled,
        DisplayCommand::ToggleFalseColour => state.display.false_colour = !state.display.false_colour,
        DisplayCommand::SetWipe(at) => state.display.wipe = at.clamp(0.0, 1.0),
        DisplayCommand::ChoosePrediction(index) => {
            if index < model.materials.predictions().len() {
                state.display.prediction = index;
            }
        }
        DisplayCommand::Isolate(map) => state.display.isolated = map,
        DisplayCommand::SetOnlyRight(on) => state.display.only_right = on,
        DisplayCommand::StepPrediction(by) => {
            let count = model.materials.predictions().len().max(1) as isize;
            state.display.prediction = (state.display.prediction as isize + by).rem_euclid(count) as usize;
        }
        DisplayCommand::Swap => model.swapped ^= true,
        DisplayCommand::Zoom { factor, at } => zoom(state, factor, at),
        DisplayCommand::Pan([x, y]) => {
            state.display.pan = [state.display.pan[0] + x, state.display.pan[1] + y]
        }
        DisplayCommand::Fit => (state.display.zoom, state.display.pan) = (1.0, [0.0; 2]),
        DisplayCommand::OneToOne => one_to_one(model),
        DisplayCommand::Reset => *state = state.reset(),
        DisplayCommand::Undo => return undo::undo(model),
        DisplayCommand::Redo => return undo::redo(model),
    }
    Vec::new()
}

fn one_to_one(model: &mut Model) {
    if let Some(ground_truth) = model.materials.ground_truth() {
        model.view.display.zoom = model.geometry.one_to_one_zoom(ground_truth.grid());
        model.view.display.pan = [0.0; 2];
    }
}

/// The value `by` places after `value`, around the end.
fn cycled<T: Copy + PartialEq>(all: &[T], value: T, by: isize) -> T {
    let index = all.iter().position(|x| *x == value).unwrap_or(0) as isize;
    all[(index + by).rem_euclid(all.len() as isize) as usize]
}

/// Magnifies so that the point of the material at `at` stays there.
fn zoom(state: &mut ViewState, factor: f32, at: [f32; 2]) {
    let zoom = (state.display.zoom * factor).clamp(*ZOOM.start(), *ZOOM.end());
    let grown = zoom / state.display.zoom;
    for (pan, at) in state.display.pan.iter_mut().zip(at) {
        *pan = at - (at - *pan) * grown;
    }
    state.display.zoom = zoom;
}

/// The exposure at which the brightest 1% of the rendering's texels just clip.
fn auto_exposure(material: &Material<f32>, state: &ViewState) -> f32 {
    let model = BrdfModel::from(&state.convention());
    let rays = state.scene.rays();
    let texels = material.width() * material.height();
    let mut brightest: Vec<f32> = (0..texels)
        .step_by(texels.div_ceil(AUTO_EXPOSURE_TEXELS))
        .map(|i| {
            let rgb = render_texel(material, &model, &rays, i % material.width(), i / material.width());
            rgb.into_iter().fold(0.0, f32::max)
        })
        .collect();
    match quantile(&mut brightest, 0.99) {
        Some(white) if white > 0.0 => -(white as f32).log2(),
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zooming_keeps_the_point_under_the_pointer() {
        let mut state = ViewState::default();
        state.display.pan = [0.2, -0.3];
        let at = [0.5, 0.1];
        let before = [
            (at[0] - state.display.pan[0]) / state.display.zoom,
            (at[1] - state.display.pan[1]) / state.display.zoom,
        ];
        zoom(&mut state, 2.5, at);
        let after = [
            (at[0] - state.display.pan[0]) / state.display.zoom,
            (at[1] - state.display.pan[1]) / state.display.zoom,
        ];
        assert!((before[0] - after[0]).abs() < 1e-6 && (before[1] - after[1]).abs() < 1e-6);
    }

    #[test]
    fn cycling_goes_around_both_ends() {
        assert_eq!(cycled(&[1, 2, 3], 3, 1), 1);
        assert_eq!(cycled(&[1, 2, 3], 1, -1), 3);
    }
}
