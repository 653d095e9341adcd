//! The sampled rendering loss: what is asked for, how far it is, what came out.

use eframe::egui::{self, RichText};

use crate::loss::{Loss, LossParams};
use crate::viewer::command::Command;
use crate::viewer::loss_run::{Done, LossRun};
use crate::viewer::slots::Slots;

/// Most scenes of one kind that the panel lets a person ask for.
const MOST: usize = 100_000;

/// What the section shows.
#[derive(Debug)]
pub struct LossPanel<'a> {
    pub params: &'a LossParams,
    pub auto: bool,
    pub run: &'a LossRun,
    pub slots: &'a Slots,
    pub chosen: usize,
}

impl LossPanel<'_> {
    pub fn ui(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        self.parameters(ui, &mut commands);
        self.controls(ui, &mut commands);
        if self.slots.predictions().is_empty() {
            ui.label("Open a prediction to compare with the ground truth.");
            return commands;
        }
        match self.run.done(self.slots, self.params) {
            Some((done, current)) => self.results(ui, done, current, &mut commands),
            None if self.run.job().is_none() => {
                ui.label("Not computed yet.");
            }
            None => {}
        }
        commands
    }

    fn parameters(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let default = LossParams::default();
        let (mut near, mut distant, mut seed) = (self.params.near, self.params.distant, self.params.seed);
        egui::Grid::new("loss parameters").num_columns(2).show(ui, |ui| {
            ui.label("Near-field scenes");
            super::number(ui, "Near-field scenes", &mut near, default.near, |d| d.speed(0.2).range(0..=MOST));
            ui.end_row();
            ui.label("Distant scenes");
            super::number(ui, "Distant scenes", &mut distant, default.distant, |d| {
                d.speed(0.2).range(0..=MOST)
            });
            ui.end_row();
            ui.label("Seed");
            super::number(ui, "Seed", &mut seed, default.seed, |d| d.speed(0.2))
                .on_hover_text("Names the scenes: the same seed draws the same ones");
            ui.end_row();
        });
        if (near, distant, seed) != (self.params.near, self.params.distant, self.params.seed) {
            commands.push(Command::SetScenes { near, distant, seed });
        }
    }

    fn controls(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        ui.horizontal(|ui| {
            if let Some(job) = self.run.job() {
                if ui.button("Cancel loss").on_hover_text("Esc").clicked() {
                    commands.push(Command::CancelLoss);
                }
                let text = format!("{:.0} s", job.elapsed().as_secs_f32());
                ui.add(egui::ProgressBar::new(job.fraction()).text(text).desired_width(110.0));
            } else {
                let enabled = !self.slots.predictions().is_empty();
                let compute = ui.add_enabled(enabled, egui::Button::new("Compute loss"));
                if compute.on_hover_text("Enter").clicked() {
                    commands.push(Command::ComputeLoss);
                }
            }
            let mut auto = self.auto;
            ui.checkbox(&mut auto, "Auto").on_hover_text("Compute again after every change it depends on");
            if auto != self.auto {
                commands.push(Command::SetAutoLoss(auto));
            }
        });
    }

    fn results(&self, ui: &mut egui::Ui, done: &Done, current: bool, commands: &mut Vec<Command>) {
        if !current {
            ui.label(RichText::new("Out of date: materials or parameters have changed.").weak());
        }
        ui.scope(|ui| {
            if !current {
                ui.set_opacity(0.5);
            }
            for (index, loss) in done.losses.iter().enumerate() {
                if result(ui, index, loss, index == self.chosen).clicked() {
                    commands.push(Command::ChoosePrediction(index));
                }
            }
            ui.label(RichText::new(summary(done)).weak().small());
        });
    }
}

/// One prediction's loss.
fn result(ui: &mut egui::Ui, index: usize, loss: &Loss, chosen: bool) -> egui::Response {
    let name = format!("{}  {}", index + 1, loss.prediction);
    let response =
        ui.add(egui::Button::selectable(chosen, name).truncate()).on_hover_text("Click to compare this one");
    let [mean, error, interval] = loss.estimate.texts();
    egui::Grid::new(("loss result", index)).num_columns(2).show(ui, |ui| {
        ui.label("    loss");
        ui.label(RichText::new(format!("{mean} +- {error}")).monospace().strong()).on_hover_text(
            "Mean over the scenes +- its standard error, which is due to the choice of scenes",
        );
        ui.end_row();
        ui.label("    95%");
        ui.label(RichText::new(interval).monospace());
        ui.end_row();
    });
    response
}

fn summary(done: &Done) -> String {
    let params = &done.params;
    format!(
        "convention {} (epsilon {}), {} near + {} distant scenes, seed {}, f32, {:.1} ms",
        params.convention.name,
        params.convention.epsilon,
        params.near,
        params.distant,
        params.seed,
        done.elapsed.as_secs_f64() * 1e3
    )
}
