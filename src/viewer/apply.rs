//! Commands, carried out: the only place where the model changes.

use eframe::egui;

use super::app::App;
use super::command::Command;
use super::panels::open::OpenWindow;
use super::save;
use super::settings::Settings;
use super::slots::Target;
use super::state::{self, Layout, ViewState};
use super::worker::Job;
use crate::files::read::EXTENSIONS;
use crate::material::Material;
use crate::model::brdf::Model;
use crate::model::scene::{Scene, SceneFile};
use crate::picture::content::Shown;
use crate::render::render_texel;

/// Least and greatest magnification.
const ZOOM: std::ops::RangeInclusive<f32> = 0.1..=400.0;
/// Greatest exposure either way, in stops.
const STOPS: f32 = 20.0;
/// Most texels that are rendered to normalize the exposure.
const NORMALIZING_TEXELS: usize = 20_000;

impl App {
    /// Carries out one command.
    pub fn apply(&mut self, ctx: &egui::Context, command: Command) {
        if let Some(command) = self.apply_to_materials(ctx, command)
            && let Some(command) = self.apply_to_scene(ctx, command)
            && let Some(command) = self.apply_to_display(command)
        {
            self.apply_to_window(ctx, command);
        }
    }

    /// Carries out a command about files and materials; returns any other one.
    fn apply_to_materials(&mut self, ctx: &egui::Context, command: Command) -> Option<Command> {
        let gpu = self.gpu.as_ref().map(|g| &g.gpu);
        match command {
            Command::Open { paths, replace, read } => {
                self.read = read;
                let target = if replace { Target::Everything } else { Target::Predictions };
                self.slots.open(ctx, gpu, paths.into_iter().map(|p| (p, read)).collect(), target);
            }
            Command::OpenBuiltIn => self.slots.open_built_in(ctx, gpu),
            Command::Reload => self.slots.reload(ctx, gpu, None),
            Command::ReadAs { slot, read } => self.slots.read_as(ctx, gpu, slot, read),
            Command::Keep { slot } => {
                let kept = self.slots.keep(ctx, gpu, slot);
                self.say(kept.err().map(|error| error.to_string()));
            }
            Command::ClosePrediction(index) => self.close_prediction(index),
            Command::MakeGroundTruth(index) => self.slots.make_ground_truth(index),
            Command::Browse { folder } => self.browsing = Some(browse(ctx, folder)),
            Command::SetWatch(on) => self.settings.watch = on,
            Command::SetFit(on) => self.slots.rules.fit = on,
            Command::ComputeLoss => {
                let asked = self.asked();
                self.loss.start(ctx, &self.slots, &asked);
            }
            Command::CancelLoss => self.loss.cancel(),
            Command::ShowStudy(on) => {
                self.study_window = on;
                if on {
                    let (prediction, convention) = (self.state.prediction, self.state.convention());
                    self.study.keep_up(ctx, &self.slots, prediction, &convention);
                } else {
                    self.study.cancel();
                }
            }
            Command::StartStudy => {
                let (prediction, convention) = (self.state.prediction, self.state.convention());
                self.study.start(ctx, &self.slots, prediction, &convention);
            }
            Command::CancelStudy => self.study.cancel(),
            Command::ChooseSetting(setting) => {
                self.settings.loss = setting.put_into(&self.settings.loss);
            }
            Command::CopyLoss => {
                if let Some((shown, _)) = self.loss.shown() {
                    ctx.copy_text(shown.report.text());
                }
            }
            Command::SaveView(path) => self.saving = Some(save::start(ctx, &self.slots, &self.state, path)),
            other => return Some(other),
        }
        None
    }

    /// Carries out a command about light and view; returns any other one.
    fn apply_to_scene(&mut self, ctx: &egui::Context, command: Command) -> Option<Command> {
        let scene = &mut self.state.scene;
        match command {
            Command::SetScene(new) => *scene = new,
            Command::SetFoot(end, at) => state::set_foot(scene, end, at),
            Command::PutHighlight(at) => state::put_highlight(scene, at),
            Command::ScaleHeight(end, factor) => state::scale_height(scene, end, factor),
            Command::ScaleDistance(end, factor) => state::scale_distance(scene, end, factor),
            Command::Orbit { end, sideways, upwards } => state::orbit(scene, end, sideways, upwards),
            Command::CopyScene => ctx.copy_text(scene_text(*scene)),
            Command::PasteScene(text) => match pasted_scene(&text) {
                Ok(pasted) => *scene = pasted,
                Err(problem) => self.say([problem]),
            },
            other => return Some(other),
        }
        None
    }

    /// Carries out a command about what is displayed and how; returns any other one.
    fn apply_to_display(&mut self, command: Command) -> Option<Command> {
        let state = &mut self.state;
        match command {
            Command::SetShown(shown) => state.shown = shown,
            Command::CycleShown(by) => state.shown = cycled(&Shown::ALL, state.shown, by),
            Command::SetLayout(layout) => state.layout = layout,
            Command::CycleLayout => state.layout = cycled(&Layout::ALL, state.layout, 1),
            Command::ToggleProjection => state.projection = state::other_projection(state.projection),
            Command::SetExposure(ev) => state.exposure_ev = ev.clamp(-STOPS, STOPS),
            Command::StepExposure(by) => state.exposure_ev = (state.exposure_ev + by).clamp(-STOPS, STOPS),
            Command::Normalize => {
                if let Some(slot) = self.slots.ground_truth() {
                    let ev = normalizing_exposure(&slot.loaded.material, state);
                    state.exposure_ev = ev.clamp(-STOPS, STOPS);
                }
            }
            Command::ToggleClipping => state.show_clipping = !state.show_clipping,
            Command::SetWipe(at) => state.wipe = at.clamp(0.0, 1.0),
            Command::SetConvention(name) => state.convention = name.to_owned(),
            Command::ChoosePrediction(index) => {
                if index < self.slots.predictions().len() {
                    state.prediction = index;
                }
            }
            Command::Zoom { factor, at } => zoom(state, factor, at),
            Command::Pan([x, y]) => state.pan = [state.pan[0] + x, state.pan[1] + y],
            Command::Fit => (state.zoom, state.pan) = (1.0, [0.0; 2]),
            Command::OneToOne => self.one_to_one(),
            Command::Reset => *state = state.reset(),
            Command::Undo => {
                if let Some(earlier) = self.undoer.undo(&self.state) {
                    self.state = earlier.clone();
                }
            }
            Command::Redo => {
                if let Some(later) = self.undoer.redo(&self.state) {
                    self.state = later.clone();
                }
            }
            other => return Some(other),
        }
        None
    }

    /// Carries out a command about the window itself.
    fn apply_to_window(&mut self, ctx: &egui::Context, command: Command) {
        let settings: &mut Settings = &mut self.settings;
        match command {
            Command::ToggleHighlightFollows => settings.highlight_follows = !settings.highlight_follows,
            Command::SetAutoLoss(on) => settings.auto_loss = on,
            Command::SetLoss(loss) => settings.loss = loss,
            Command::SetDark(on) => settings.dark = on,
            Command::ToggleSidePanel => settings.side_panel = !settings.side_panel,
            Command::SwapSides => self.swapped = !self.swapped,
            Command::SetHelp(on) => self.help = on,
            Command::ShowOpen(on) => {
                self.open_window = on.then(|| OpenWindow::from(self.read));
            }
            Command::ShowSave(on) => self.save_window = on.then(Default::default),
            Command::DismissMessage => self.dismiss(),
            // Everything else was carried out before.
            _ => {}
        }
        ctx.request_repaint();
    }

    /// Closes the material in slot `index`; the prediction that is looked at stays the same.
    fn close_prediction(&mut self, index: usize) {
        self.slots.close(index);
        let state = &mut self.state;
        if index <= state.prediction {
            state.prediction = state.prediction.saturating_sub(1);
        }
        state.prediction = state.prediction.min(self.slots.predictions().len().saturating_sub(1));
    }

    fn one_to_one(&mut self) {
        if let Some(slot) = self.slots.ground_truth() {
            self.state.zoom = self.viewport.one_to_one_zoom(slot.loaded.material.grid());
            self.state.pan = [0.0; 2];
        }
    }
}

/// The value `by` places after `value`, around the end.
fn cycled<T: Copy + PartialEq>(all: &[T], value: T, by: isize) -> T {
    let index = all.iter().position(|x| *x == value).unwrap_or(0) as isize;
    all[(index + by).rem_euclid(all.len() as isize) as usize]
}

/// Magnifies so that what is seen at `at` stays there.
fn zoom(state: &mut ViewState, factor: f32, at: [f32; 2]) {
    let zoom = (state.zoom * factor).clamp(*ZOOM.start(), *ZOOM.end());
    let grown = zoom / state.zoom;
    for (pan, at) in state.pan.iter_mut().zip(at) {
        *pan = at - (at - *pan) * grown;
    }
    state.zoom = zoom;
}

/// The exposure at which the brightest 1% of the rendering's texels just clip.
fn normalizing_exposure(material: &Material<f32>, state: &ViewState) -> f32 {
    let model = Model::from(&state.convention());
    let rays = state.scene.rays();
    let texels = material.width() * material.height();
    let mut brightest: Vec<f32> = (0..texels)
        .step_by(texels.div_ceil(NORMALIZING_TEXELS))
        .map(|i| {
            let rgb = render_texel(material, &model, &rays, i % material.width(), i / material.width());
            rgb.into_iter().fold(0.0, f32::max)
        })
        .collect();
    brightest.sort_by(f32::total_cmp);
    match brightest.get(brightest.len() * 99 / 100) {
        Some(&white) if white > 0.0 => -white.log2(),
        _ => 0.0,
    }
}

/// The scene as a scene file of one scene.
fn scene_text(scene: Scene) -> String {
    serde_json::to_string_pretty(&SceneFile { scenes: vec![scene] }).unwrap_or_default()
}

/// The first scene of a scene file, or a scene alone.
fn pasted_scene(text: &str) -> Result<Scene, String> {
    let scene = serde_json::from_str::<SceneFile>(text)
        .ok()
        .and_then(|file| file.scenes.first().copied())
        .or_else(|| serde_json::from_str(text).ok())
        .ok_or("the clipboard holds no scene: copy one from here or from a scene file first")?;
    scene.check().map_err(|problem| format!("the pasted scene cannot be rendered: {problem}"))?;
    Ok(scene)
}

/// Asks for files or folders with the system's dialog, without the window waiting.
fn browse(ctx: &egui::Context, folder: bool) -> Job<Vec<std::path::PathBuf>> {
    let dialog = rfd::AsyncFileDialog::new().set_title("Open materials");
    Job::start(ctx, move |_| {
        let chosen = if folder {
            pollster::block_on(dialog.pick_folders())
        } else {
            pollster::block_on(dialog.add_filter("materials", &EXTENSIONS).pick_files())
        };
        Ok(chosen.unwrap_or_default().iter().map(|handle| handle.path().to_owned()).collect())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zooming_keeps_what_is_under_the_pointer() {
        let mut state = ViewState { pan: [0.2, -0.3], ..ViewState::default() };
        let at = [0.5, 0.1];
        let before = [(at[0] - state.pan[0]) / state.zoom, (at[1] - state.pan[1]) / state.zoom];
        zoom(&mut state, 2.5, at);
        let after = [(at[0] - state.pan[0]) / state.zoom, (at[1] - state.pan[1]) / state.zoom];
        assert!((before[0] - after[0]).abs() < 1e-6 && (before[1] - after[1]).abs() < 1e-6);
    }

    #[test]
    fn a_copied_scene_can_be_pasted() {
        let scene = ViewState::default().scene;
        assert_eq!(pasted_scene(&scene_text(scene)), Ok(scene));
        assert!(pasted_scene("{\"scenes\": []}").is_err());
        let below = scene_text(Scene { light: [0.0, 0.0, -1.0], ..scene });
        assert!(pasted_scene(&below).unwrap_err().contains("above the plane"));
    }

    #[test]
    fn cycling_goes_around_both_ends() {
        assert_eq!(cycled(&[1, 2, 3], 3, 1), 1);
        assert_eq!(cycled(&[1, 2, 3], 1, -1), 3);
    }
}
