//! Commands about what the panes show, and how.

use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::Model as BrdfModel;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::render::render_texel;
use svbrdf_core::statistics::quantile;
use svbrdf_files::session_window::Framing;

use super::undo;
use crate::viewer::model::Model;
use crate::viewer::model::command::DisplayCommand;
use crate::viewer::model::command::effect::Effect;
use crate::viewer::model::ranges::STOPS;
use crate::viewer::model::view::endpoint::{self, Endpoint};
use crate::viewer::model::view::framing::{self, Framed};
use crate::viewer::model::view::state::{Layout, Projection, ViewState};

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
        DisplayCommand::Zoom { factor, at } => frame(model, |framed| framed.zoomed(factor, at)),
        DisplayCommand::Pan(by) => frame(model, |framed| framed.panned(by)),
        DisplayCommand::Fit => fit(state),
        DisplayCommand::OneToOne => frame(model, |framed| framed.at_scale(1.0)),
        DisplayCommand::Reset => *state = state.reset(),
        DisplayCommand::Undo => return undo::undo(model),
        DisplayCommand::Redo => return undo::redo(model),
    }
    Vec::new()
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
    fn cycling_goes_around_both_ends() {
        assert_eq!(cycled(&[1, 2, 3], 3, 1), 1);
        assert_eq!(cycled(&[1, 2, 3], 1, -1), 3);
    }
}
